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

from shearbox_tools.analysis.mean_curve import Band, MeanCurve, as_csv, band_of
from shearbox_tools.base.files import write_text
from shearbox_tools.drawing.style import AXIS_COLOUR, OTHER_LOOKS, RC, SIZE, Look, diagram, looks, name_stresses

from .findings import BOXES, COARSE, FINE, FINEST, TRIPLE
from .specimens import CURVES, PLACES, Group

SIZES = {COARSE: "4–8 mm", FINE: "2–4 mm", FINEST: "2 mm"}
SHAPES = {COARSE: "single, 4–8 mm", FINE: "single, 2–4 mm", TRIPLE: "three discs of 2–4 mm"}
_LOOKS = dict(zip((COARSE, FINE, FINEST, TRIPLE), OTHER_LOOKS))
_PAPER_ORDER = [f"{box}_{size}" for size in (COARSE, FINE, TRIPLE) for box in BOXES] + [
    f"{box}_{FINEST}" for box in "AB"
]
NUMBER_OF = {name: 3 + k for k, name in enumerate(_PAPER_ORDER)}  # of the figure of a model

LEGEND_INCHES = 0.3
LEAST_WIDTH = 5.0  # inches: that of a legend of three entries

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
        drawn = {name: group for name, group in groups.items() if group.drawn}
        pictures = [_model(drawn[name], NUMBER_OF[name], folder) for name in _PAPER_ORDER if name in drawn]
        pictures += [
            _strengths(groups, SIZES, 17, "Shear strength against normal stress, by size", folder),
            _strengths(groups, SHAPES, 18, "Shear strength against normal stress, by shape", folder),
            _rotation(drawn, SIZES, 19, "TRM, by size", folder),
            _rotation(drawn, SHAPES, 20, "TRM, by shape", folder),
        ]
    return pictures


def _model(group: Group, number: int, folder: Path) -> Picture:
    """Shear stress and rise of the lid against the shear displacement."""
    curves, parts = mean_curves(group), []
    speed = _speeds({group.name: group}, [group.name])
    for part, name in (("a", "shear stress τ (kPa)"), ("b", "vertical displacement, up (mm)")):
        figure, axes = diagram("horizontal displacement (mm)", name)
        look = looks([curve.sigma for curve in curves])
        for curve in curves:
            band = curve.tau if part == "a" else curve.lid
            _with_error(axes, curve.displacement, band.mean, band.error, look[curve.sigma])
        axes.axhline(0, color=AXIS_COLOUR, lw=0.8)
        axes.set_xlim(0, 8)
        axes.set_title(speed, fontsize=8, loc="right")
        name_stresses(axes, look)
        parts.append(_written(figure, folder / f"fig{number:02d}{part}.svg"))
    write_text(folder / f"fig{number:02d}.csv", as_csv(curves))
    return Picture(number, f"{group.model}, mean of {len(group.drawn)}", parts, SIZE[0])


def _speeds(groups: Groups, names: Sequence[str]) -> str:
    """At which the models of these names were sheared."""
    speeds = sorted({groups[name].speed for name in names if name in groups})
    return f"{', '.join(f'{speed:g}' for speed in speeds)} mm/s"


def mean_curves(group: Group) -> list[MeanCurve]:
    """Means over the specimens, a stress each, of what is known."""
    curves = []
    for sigma in group.stresses:
        known = np.array([one.curves[sigma] for one in group.drawn if sigma in one.curves])
        if not len(known):
            continue
        whole = np.all(np.isfinite(known), axis=(0, 1))  # places that all have reached
        tau, lid = (band_of(known[:, CURVES.index(name), whole]) for name in ("tau_kPa", "lid_mm"))
        curves.append(MeanCurve(sigma, len(known), PLACES[whole], tau, lid))
    return curves


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
    width = max(LEAST_WIDTH, 2.6 * len(boxes) + 0.6)
    figure = Figure(figsize=(width, 2.9 * rows + 0.4), layout="constrained")
    axes = figure.subplots(rows, max(1, len(boxes)), sharex=True, sharey=True, squeeze=False)
    for column, box in zip(axes.T, boxes):
        column[0].set_title(f"box {box}, {_speeds(groups, [f'{box}_{kind}' for kind in kinds])}", fontsize=9)
    axes[0, 0].set_ylabel(y)
    return figure, axes, boxes


def _strengths(groups: Groups, kinds: Mapping[str, str], number: int, title: str, folder: Path) -> Picture:
    """Mean of the peaks with its standard error; in the second row by the stresses on the shear plane."""
    figure, axes, boxes = _panels(groups, kinds, "τ at its peak (kPa)", 2)
    lines = ["box,kind,by,specimens,sigma_kPa,tau_kPa,standard_error_kPa"]
    for k, box in enumerate(boxes):
        for row, by in enumerate(("lid", "plane")):
            for kind in (kind for kind in kinds if f"{box}_{kind}" in groups):
                if not (points := _points(groups[f"{box}_{kind}"], by)):
                    continue
                look = _LOOKS[kind]
                _, sigma, tau, error = np.array(points).T
                bars = error if np.all(np.isfinite(error)) else None
                axes[row, k].errorbar(sigma, tau, bars, fmt=look.mark, color=look.colour, ls=look.dashes, lw=1.2, ms=4,
                                      capsize=2, label=kinds[kind])  # fmt: skip
                lines += [f"{box},{kind},{by},{n},{s:.8g},{t:.8g},{e:.8g}" for n, s, t, e in points]
        axes[1, k].set_xlabel("σ (kPa)")
    axes[1, 0].set_ylabel("the same on the shear plane (kPa)")
    axes[0, 0].set_xlim(left=0)
    axes[0, 0].set_ylim(bottom=0)
    return _finished(figure, axes, number, title, lines, folder)


def _points(group: Group, by: str) -> list[tuple[int, float, float, float]]:
    """How many specimens, mean normal and shear stress (kPa) at the peaks, and the standard error of the latter, by stress."""
    points = []
    for sigma in group.stresses:
        tests = group.tests_at(sigma)
        if by == "lid":
            peaks = np.array([(sigma, sigma * test["peak"]) for test in tests])
        else:
            ratios = [(test["plane_load"], test["peak_plane"]) for test in tests]
            peaks = np.array([(sigma * load, sigma * load * peak) for load, peak in ratios])
        known = peaks[np.all(np.isfinite(peaks), axis=1)]
        if count := len(known):
            error = np.std(known[:, 1], ddof=1) / np.sqrt(count) if count > 1 else np.nan
            load, tau = known.mean(axis=0)
            points.append((count, float(load), float(tau), float(error)))
    return points


def _rotation(groups: Groups, kinds: Mapping[str, str], number: int, title: str, folder: Path) -> Picture:
    """TRM so far against the shear displacement, in the mean over the stresses."""
    figure, axes, boxes = _panels(groups, kinds, "TRM so far (–)")
    lines = ["box,kind,specimens,displacement_mm,trm,standard_error"]
    for k, box in enumerate(boxes):
        for kind in (kind for kind in kinds if f"{box}_{kind}" in groups):
            group = groups[f"{box}_{kind}"]
            trm = _mean_trm(group)
            _with_error(axes[0, k], PLACES, trm.mean, trm.error, _LOOKS[kind], kinds[kind])
            table = zip(PLACES, trm.mean, trm.error)
            lines += [f"{box},{kind},{len(group.drawn)},{x:.6g},{y:.6g},{e:.6g}" for x, y, e in table]
        axes[0, k].set_xlabel("horizontal displacement (mm)")
    for one in axes.flat:
        one.axhline(1, color=AXIS_COLOUR, lw=0.8)
    axes[0, 0].set_xlim(0, 8)
    axes[0, 0].set_ylim(bottom=0)
    return _finished(figure, axes, number, title, lines, folder)


def _mean_trm(group: Group) -> Band:
    """Over the specimens, of each the mean over its stresses."""
    trm = CURVES.index("trm")
    return band_of([np.mean([curves[trm] for curves in one.curves.values()], axis=0) for one in group.drawn])


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
