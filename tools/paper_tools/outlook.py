# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's outlook: strength, dilatancy and rotation against what it leaves for later, a campaign each.

An entry of such a campaign is FAMILY_VALUE, such as single_35 of the friction angle; the one with the paper's value is the model's
in the campaign of all models.
"""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from shearbox_tools.base.files import write_text
from shearbox_tools.drawing.style import OTHER_LOOKS, RC

from .effects import Effect, difference, mean, paired, slope_of_each, unknown
from .figures import legend_above
from .over_groups import slope
from .specimens import ANGLES, Group

# and the models of the campaign of all that have the paper's value
FAMILIES = {"single": "A_4-8", "triple": "A_2-4_triple", "row": "A_4-8", "close": "A_4-8"}
PANELS = {
    "phi": "φ by the lid (°)",
    "phi_plane": "φ by the shear plane (°)",
    "dilation_deg": "ψ at the peak (°)",
    "trm": "TRM (–)",
}
COHESIONS = {"c": "c by the lid (kPa)", "c_plane": "c by the shear plane (kPa)"}
SAME_SOLID = 1e-4  # how much solid fractions of one packing differ, consolidated with other contacts: 2e-5
TABLE = [
    "phi",
    "phi_plane",
    "c",
    "c_plane",
    "dilation_deg",
    "late_rate",
    "trm",
    "mean",
    "mean_plane",
    "end",
    "inertial",
    "solid",
]


@dataclass(frozen=True)
class Sweep:
    """A campaign: title, the axis of its values, the paper's value and whether the models of the campaign of all have it, whether the
    axis is logarithmic, and what is drawn."""

    name: str
    title: str
    axis: str
    paper: float
    in_models: bool = True
    logarithmic: bool = False
    panels: Mapping[str, str] = field(default_factory=lambda: PANELS)


SWEEPS = (
    Sweep("rate", "Loading rate", "shear speed (mm/s)", 2, in_models=False, logarithmic=True),
    Sweep(
        "inertia", "Roller effect: moment of inertia", "moment of inertia over that of discs (–)", 1, logarithmic=True
    ),
    Sweep("rolling", "Roller effect: rolling resistance", "coefficient of rolling resistance (–)", 0),
    Sweep("shape", "Roller effect: grains of several discs, in a row or close together", "discs of a grain (–)", 1),
    Sweep("friction", "φ and the friction angle between grains", "φ_μ (degrees)", 27),
    Sweep("cohesion", "Cohesive contacts", "pull-off force of two discs (N)", 0, panels=COHESIONS | PANELS),
)


@dataclass(frozen=True)
class Point:
    """All specimens with one value of what is varied."""

    family: str
    value: float
    group: Group

    def effect(self, name: str) -> Effect:
        """Mean of a number over its specimens."""
        return mean(f"{self.family}, {self.value:g}", self.group.values(name), name in ANGLES)


@dataclass(frozen=True)
class Study:
    """A sweep with its points, in order, the slopes of its trends, and the file of its figure."""

    sweep: Sweep
    points: list[Point]
    trends: list[tuple[str, Effect]]
    picture: Path


def study(sweep: Sweep, groups: Mapping[str, Group], models: Mapping[str, Group], folder: Path) -> Study | None:
    """What there is of a sweep, drawn into the folder; None if nothing but the paper's value."""
    if not groups:
        return None
    points = [Point(*_family_and_value(name), group) for name, group in groups.items()]
    families = sorted({point.family for point in points})
    if sweep.in_models:
        points += [Point(f, sweep.paper, models[FAMILIES[f]]) for f in families if FAMILIES[f] in models]
    points.sort(key=lambda point: (point.family, point.value))
    folder.mkdir(parents=True, exist_ok=True)
    picture, numbers = folder / f"{sweep.name}.svg", folder / f"{sweep.name}.csv"
    with rc_context(RC):
        _figure(sweep, points).savefig(picture, metadata={"Date": None})
    write_text(numbers, _csv(sweep, points))
    trends = [(name, _trend(sweep, f, points, name)) for f in families for name in sweep.panels]
    return Study(sweep, points, trends, picture)


def _family_and_value(name: str) -> tuple[str, float]:
    family, _, value = name.rpartition("_")
    return family, float(value)


def _trend(sweep: Sweep, family: str, points: list[Point], name: str) -> Effect:
    """Per unit of the axis, or tenfold if that is logarithmic; packing by packing where all values have the same ones."""
    some = [(point.value, point.group) for point in points if point.family == family]
    if sweep.logarithmic:
        some = [(float(np.log10(value)), group) for value, group in some]
    label = f"{family}: {sweep.panels[name]} per {'tenfold' if sweep.logarithmic else 'unit'}"
    if all(_shared(some[0][1], group) for _, group in some):
        return slope_of_each(label, _lines(some, name))
    return slope(label, [(x, group.linear(name)) for x, group in some])


def _lines(groups: list[tuple[float, Group]], name: str) -> list[tuple[np.ndarray, np.ndarray]]:
    """Of each seed the places and values that are known."""
    lines: dict[int, list[tuple[float, float]]] = {}
    for x, group in groups:
        for one in group.specimens:
            if np.isfinite(value := one.mean(name)):
                lines.setdefault(one.seed, []).append((x, value))
    return [(x, y) for x, y in (np.array(line).T for line in lines.values())]


def _shared(one: Group, other: Group) -> list[int]:
    """Seeds of which both have the same packing. Other grains, or other contacts while they are packed, make another one."""
    solid = {of.seed: of.mean("solid") for of in one.specimens}
    common = [of for of in other.specimens if of.seed in solid]
    same = [of.seed for of in common if abs(solid[of.seed] - of.mean("solid")) < SAME_SOLID]
    return same if len(same) == len(common) else []  # of one of several it may be chance


def _change(base: Point | None, point: Point, name: str) -> Effect:
    """Less that of the paper's value, of the same packings if there are any."""
    if base is None or base is point:
        return unknown(name)
    if not (shared := _shared(base.group, point.group)):
        return difference(name, base.group.linear(name), point.group.linear(name))
    of_both = [{one.seed: one.mean(name) for one in of.group.specimens} for of in (base, point)]
    pairs = np.array([[values[seed] for values in of_both] for seed in shared])
    pairs = pairs[np.all(np.isfinite(pairs), axis=1)]
    return paired(name, *pairs.T) if len(pairs) else unknown(name)


def _figure(sweep: Sweep, points: list[Point]) -> Figure:
    panels = _known_panels(sweep, points)
    figure = Figure(figsize=(2.4 * len(panels), 2.9), layout="constrained")
    for axes, (name, label) in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels.items()):
        for look, family in zip(OTHER_LOOKS, sorted({point.family for point in points})):
            every = [(point.value, point.effect(name)) for point in points if point.family == family]
            some = [(value, effect) for value, effect in every if effect.count]
            reach = [[e.value - e.low for _, e in some], [e.high - e.value for _, e in some]]
            axes.errorbar([value for value, _ in some], [e.value for _, e in some], reach, fmt=look.mark,
                          color=look.colour, ls=look.dashes, lw=1.2, ms=4, capsize=2, label=family)  # fmt: skip
        axes.set(xlabel=sweep.axis, ylabel=label)
        axes.xaxis.label.set_fontsize(7.5)
        if sweep.logarithmic:
            axes.set_xscale("log")
    handles, labels = axes.get_legend_handles_labels()
    legend_above(figure, dict(zip(labels, handles)))
    return figure


def _known_panels(sweep: Sweep, points: list[Point]) -> dict[str, str]:
    """Those with two values or more; of one there is nothing to see. The last one, if there is none."""
    known = {name: sum(len(point.group.values(name)) > 0 for point in points) > 1 for name in sweep.panels}
    return {name: label for name, label in sweep.panels.items() if known[name]} or dict(
        [list(sweep.panels.items())[-1]]
    )


def _csv(sweep: Sweep, points: list[Point]) -> str:
    """A line for each point: means with their intervals, over so many specimens, and how they differ from the paper's value."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    ends = ("", "_low", "_high", "_specimens")
    table.writerow(
        [
            "family",
            "value",
            "specimens",
            *(f"{name}{kind}{end}" for name in TABLE for kind in ("", "_change") for end in ends),
        ]
    )
    bases = {point.family: point for point in points if point.value == sweep.paper}
    for point in points:
        base = bases.get(point.family)
        effects = [effect for name in TABLE for effect in (point.effect(name), _change(base, point, name))]
        cells = [f"{v:.6g}" for e in effects for v in (e.value, e.low, e.high, e.count)]
        table.writerow([point.family, f"{point.value:g}", len(point.group.specimens), *cells])
    return text.getvalue()
