# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures 3 to 20 of the paper, each beside its numbers as CSV: means of the specimens with the standard error of the mean."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from shearbox_tools.files import write_text
from shearbox_tools.mean_curve import as_csv
from shearbox_tools.style import OTHER_LOOKS, RC, SIZE, Look, diagram, looks, name_stresses

from .findings import BOXES, COARSE, FINE, FINEST, TRIPLE
from .specimens import Group

EVERY = 5  # row of a curve that is drawn
SIZES = {COARSE: "4–8 mm", FINE: "2–4 mm", FINEST: "2 mm"}
SHAPES = {COARSE: "single, 4–8 mm", FINE: "single, 2–4 mm", TRIPLE: "three discs of 2–4 mm"}
_LOOKS = dict(zip((COARSE, FINE, FINEST, TRIPLE), OTHER_LOOKS))
_PAPER_ORDER = [f"{box}_{size}" for size in (COARSE, FINE, TRIPLE) for box in BOXES] + [
    f"{box}_{FINEST}" for box in "AB"
]
NUMBER_OF = {name: 3 + k for k, name in enumerate(_PAPER_ORDER)}  # of the figure of a model

LEGEND_INCHES = 0.3

Groups = Mapping[str, Group]


@dataclass(frozen=True)
class Picture:
    """A figure: number in the paper, title, files of its parts (SVG), width of a part in inches."""

    number: int
    title: str
    parts: list[Path]
    width: float


def draw(groups: Groups, folder: Path) -> list[Picture]:
    """Those for which there are specimens, written into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with rc_context(RC):
        pictures = [_model(groups[name], NUMBER_OF[name], folder) for name in _PAPER_ORDER if name in groups]
        pictures += [
            _strengths(groups, SIZES, 17, "Shear strength against normal stress, by size", folder),
            _strengths(groups, SHAPES, 18, "Shear strength against normal stress, by shape", folder),
            _rotation(groups, SIZES, 19, "TRM, by size", folder),
            _rotation(groups, SHAPES, 20, "TRM, by shape", folder),
        ]
    return pictures


def _model(group: Group, number: int, folder: Path) -> Picture:
    """Shear stress and rise of the lid against the shear displacement."""
    curves, parts = group.ensemble.curves, []
    for part, name in (("a", "shear stress τ (kPa)"), ("b", "vertical displacement, up (mm)")):
        figure, axes = diagram("horizontal displacement (mm)", name)
        look = looks(list(curves))
        for sigma, curve in curves.items():
            band = curve.tau if part == "a" else curve.lid
            s, mean, error = (values[::EVERY] for values in (curve.displacement, band.mean, band.error))
            _with_error(axes, s, mean, error, look[sigma])
        axes.axhline(0, color="#8a929b", lw=0.8)
        axes.set_xlim(0, 8)
        name_stresses(axes, look)
        parts.append(_written(figure, folder / f"fig{number:02d}{part}.svg"))
    table = folder / f"fig{number:02d}.csv"
    write_text(table, as_csv(list(curves.values()), EVERY))
    return Picture(number, f"{group.model}, mean of {len(group.specimens)}", parts, SIZE[0])


def _with_error(
    axes: Axes, x: np.ndarray, y: np.ndarray, error: np.ndarray, look: Look, label: str | None = None
) -> None:
    """A line with marks, and the standard error of the mean around it, if there is one."""
    if np.all(np.isfinite(error)):
        axes.fill_between(x, y - error, y + error, color=look.colour, alpha=0.22, lw=0)
    every = max(1, len(x) // 8)
    axes.plot(x, y, look.mark, color=look.colour, ls=look.dashes, lw=1.3, ms=3.5, markevery=every, label=label)


def _panels(groups: Groups, kinds: Mapping[str, str], y: str, rows: int = 1) -> tuple[Figure, np.ndarray, list[str]]:
    """Diagrams side by side, one for each box of which there are two kinds or more, on the same scales."""
    boxes = [box for box in BOXES if sum(f"{box}_{kind}" in groups for kind in kinds) > 1]
    figure = Figure(figsize=(2.6 * max(1, len(boxes)) + 0.6, 2.9 * rows + 0.4), layout="constrained")
    axes = figure.subplots(rows, max(1, len(boxes)), sharex=True, sharey=True, squeeze=False)
    for column, box in zip(axes.T, boxes):
        column[0].set_title(f"box {box}", fontsize=9)
    axes[0, 0].set_ylabel(y)
    return figure, axes, boxes


def _strengths(groups: Groups, kinds: Mapping[str, str], number: int, title: str, folder: Path) -> Picture:
    """Mean of the peaks with its standard error; in the second row by the stresses on the shear plane."""
    figure, axes, boxes = _panels(groups, kinds, "τ at its peak (kPa)", 2)
    lines = ["box,kind,by,specimens,sigma_kPa,tau_kPa,standard_error_kPa"]
    for k, box in enumerate(boxes):
        for row, by in enumerate(("lid", "plane")):
            for kind in (kind for kind in kinds if f"{box}_{kind}" in groups):
                sigma, tau, error = _points(groups[f"{box}_{kind}"], by)
                look = _LOOKS[kind]
                axes[row, k].errorbar(sigma, tau, error, fmt=look.mark, color=look.colour, ls=look.dashes, lw=1.2, ms=4,
                                      capsize=2, label=kinds[kind])  # fmt: skip
                count = len(groups[f"{box}_{kind}"].specimens)
                lines += [f"{box},{kind},{by},{count},{s:.8g},{t:.8g},{e:.8g}" for s, t, e in zip(sigma, tau, error)]
        axes[1, k].set_xlabel("σ (kPa)")
    axes[1, 0].set_ylabel("the same on the shear plane (kPa)")
    axes[0, 0].set_xlim(left=0)
    axes[0, 0].set_ylim(bottom=0)
    return _finished(figure, axes, number, title, lines, folder)


def _points(group: Group, by: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean normal and shear stress (kPa) at the peaks, and the standard error of the latter, by stress."""
    points = []
    for shears in group.ensemble.shears.values():
        planes = [shear.plane for shear in shears if shear.plane]
        on_plane = [(plane.sigma_at_peak, plane.peak.value) for plane in planes]
        both = [(s.sigma, s.peak.value) for s in shears] if by == "lid" else on_plane
        sigma, tau = np.array(both).T
        error = np.std(tau, ddof=1) / np.sqrt(len(tau)) if len(tau) > 1 else np.nan
        points.append((np.mean(sigma), np.mean(tau), error))
    sigma, tau, error = np.array(points).T
    return sigma, tau, error


def _rotation(groups: Groups, kinds: Mapping[str, str], number: int, title: str, folder: Path) -> Picture:
    """TRM so far against the shear displacement, in the mean over the stresses."""
    figure, axes, boxes = _panels(groups, kinds, "TRM so far (–)")
    lines = ["box,kind,specimens,displacement_mm,trm,standard_error"]
    for k, box in enumerate(boxes):
        for kind in (kind for kind in kinds if f"{box}_{kind}" in groups):
            group = groups[f"{box}_{kind}"]
            s, value, error = _mean_trm(group)
            _with_error(axes[0, k], s, value, error, _LOOKS[kind], kinds[kind])
            lines += [
                f"{box},{kind},{len(group.specimens)},{x:.6g},{y:.6g},{e:.6g}" for x, y, e in zip(s, value, error)
            ]
        axes[0, k].set_xlabel("horizontal displacement (mm)")
    axes[0, 0].axhline(1, color="#8a929b", lw=0.8)
    axes[0, 0].set_xlim(0, 8)
    axes[0, 0].set_ylim(bottom=0)
    return _finished(figure, axes, number, title, lines, folder)


def _mean_trm(group: Group) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    s = np.linspace(0.2, 7.9, 78)
    rows = np.array([
        np.mean([np.interp(s, x.data["displacement_mm"], x.data["trm"]) for x in run.shears], axis=0)
        for run in group.ensemble.specimens
    ])  # fmt: skip
    error = rows.std(axis=0, ddof=1) / np.sqrt(len(rows)) if len(rows) > 1 else np.full(len(s), np.nan)
    return s, rows.mean(axis=0), error


def _finished(figure: Figure, axes: np.ndarray, number: int, title: str, lines: Sequence[str], folder: Path) -> Picture:
    handles = {label: h for a in axes.flat for h, label in zip(*a.get_legend_handles_labels())}
    legend_above(figure, handles)
    table = folder / f"fig{number:02d}.csv"
    write_text(table, "\n".join(lines) + "\n")
    return Picture(number, title, [_written(figure, folder / f"fig{number:02d}.svg")], figure.get_figwidth())


def legend_above(figure: Figure, handles: Mapping[str, Any]) -> None:
    """One legend for all diagrams of a figure, with room of its own."""
    engine = figure.get_layout_engine()
    assert engine is not None
    engine.set(rect=(0, 0, 1, 1 - LEGEND_INCHES / figure.get_figheight()))
    figure.legend(handles.values(), handles.keys(), loc="upper center", ncols=len(handles))


def _written(figure: Figure, file: Path) -> Path:
    figure.savefig(file, metadata={"Date": None})
    return file
