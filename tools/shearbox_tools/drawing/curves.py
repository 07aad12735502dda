# SPDX-License-Identifier: GPL-2.0-or-later
"""The report's diagrams against shear displacement: raw rows faint, their fit strong."""

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.polynomial import Legendre

from ..analysis.peak import steepest
from ..analysis.polynomial import Fit, end_zone
from ..analysis.results import Results
from ..analysis.shear import Shear
from .style import AXIS_COLOUR, Look, diagram, looks, name_stresses

DISPLACEMENT = "shear displacement (mm)"
MARKS = 5  # on a curve
MARGIN = 0.05  # of the height of a diagram, above and below the curves

OTHERS = {  # further columns that have a diagram each, if they are there: what they are called, and what they are
    "inertial": (
        "inertial number I (–)",
        "Inertial number between the sides, floor and lid: shear rate times √(mean mass of a grain / mean stress).",
    ),
    "coordination": (
        "coordination number (–)",
        "Contacts of a grain, with grains and walls: mean between the sides, floor and lid.",
    ),
    "solid_fraction": (
        "solid fraction (–)",
        "Area of the grains between the sides, floor and lid over that of this rectangle.",
    ),
    "sides_upper_kPa": (
        "load on the upper sides (kPa)",
        "Vertical force with which the sides of the upper half press the grains down, over width and thickness of the box.",
    ),
    "trm": (
        "TRM so far: above 1 grains spin (–)",
        "Rotation rate of motion: what a grain has turned at its rim over its path since the start (eq. 6 of the paper); mean of "
        "the grains.",
    ),
    "kinetic_J": ("kinetic energy (J)", "Kinetic energy of the grains, of their motion and their spin."),
}


def stress(results: Results) -> Figure:
    """Shear stress; its peak is a large hollow mark, that of the smoothed data a cross."""
    figure, axes = diagram(DISPLACEMENT, "shear stress τ (kPa)")
    for k, (shear, look) in enumerate(_each(results)):
        _draw_rows(axes, shear, "tau_kPa", look)
        _draw_fit(axes, shear, shear.tau.series, look, k)
        _draw_peak(axes, shear.peak.position, shear.peak.value, look)
        axes.plot(shear.smoothed.position, shear.smoothed.value, "x", ms=7, mew=1.5, color=look.colour, zorder=5)
    _finish(axes, results, [s.data["tau_kPa"][s.rows] for s in results.shears])
    return figure


def lid(results: Results) -> Figure:
    """Vertical displacement of the lid, upward positive."""
    figure, axes = diagram(DISPLACEMENT, "lid displacement, up + (mm)")
    for k, (shear, look) in enumerate(_each(results)):
        _draw_rows(axes, shear, "lid_mm", look)
        _draw_fit(axes, shear, shear.lid.series, look, k)
        _draw_peak(axes, shear.peak.position, shear.lid.series(shear.peak.position), look)
    _finish(axes, results, [s.data["lid_mm"][s.rows] for s in results.shears])
    return figure


def dilatancy(results: Results) -> Figure:
    """Slope of the fitted lid displacement, and the dilation angle; a star is the steepest point."""
    figure, axes = diagram(DISPLACEMENT, "dilatancy rate, lid/shear (mm/mm)")
    heights = []
    for k, (shear, look) in enumerate(_each(results)):
        rate, zone = shear.lid.series.deriv(), end_zone(shear.lid.span)
        _draw_fit(axes, shear, rate, look, k, zone)
        if not shear.peak.at_boundary:  # where the slope of the fit is not held, and beyond the diagram
            _draw_peak(axes, shear.peak.position, rate(shear.peak.position), look)
        axes.plot(*steepest(shear.lid), "*", ms=10, color=look.colour, mec="white", mew=0.6, zorder=5)
        heights.append(rate(np.linspace(zone, shear.lid.span - zone, 200)))
    _finish(axes, results, heights)
    angle = axes.secondary_yaxis("right", functions=(_degrees, _slope))
    angle.set_ylabel("dilation angle ψ (°)")
    return figure


def stress_ratios(results: Results) -> dict[str, Figure]:
    """τ/σ by the lid, and by the shear plane where it is known of all stresses: on the same scale."""
    ratios: dict[str, Callable[[Shear, np.ndarray], np.ndarray]] = {"lid": _by_lid}
    if results.knows_plane:
        ratios["plane"] = _by_plane
    places = [(shear, _places(shear.tau, shear)) for shear in results.shears]
    heights = [ratio(shear, s) for ratio in ratios.values() for shear, s in places]
    return {name: _stress_ratio(results, name, ratio, heights) for name, ratio in ratios.items()}


def other_columns(results: Results) -> dict[str, Figure]:
    """A diagram for each of the other columns that the tables of all stresses have and that are not zero all along, by its name."""
    there = [name for name in OTHERS if all(name in shear.data for shear in results.shears)]
    names = [name for name in there if any(np.any(shear.data[name][shear.rows]) for shear in results.shears)]
    return {name: _column(results, name) for name in names}


def _stress_ratio(
    results: Results, name: str, ratio: Callable[[Shear, np.ndarray], np.ndarray], heights: list[np.ndarray]
) -> Figure:
    figure, axes = diagram(DISPLACEMENT, "τ/σ, σ of the lid (–)" if name == "lid" else "τ/σ on the shear plane (–)")
    for k, (shear, look) in enumerate(_each(results)):
        s = _places(shear.tau, shear)
        axes.plot(s, ratio(shear, s), look.mark, **_line(look, k, len(s)))
        peak = shear.plane.peak if name == "plane" and shear.plane else shear.peak
        _draw_peak(axes, peak.position, float(ratio(shear, np.array(peak.position))), look)
    _finish(axes, results, heights)
    return figure


def _by_lid(shear: Shear, s: np.ndarray) -> np.ndarray:
    return shear.tau.series(s) / shear.sigma


def _by_plane(shear: Shear, s: np.ndarray) -> np.ndarray:
    assert shear.plane is not None
    return shear.plane.tau.series(s) / shear.plane.sigma.series(s)


def _column(results: Results, name: str) -> Figure:
    figure, axes = diagram(DISPLACEMENT, OTHERS[name][0])
    for k, (shear, look) in enumerate(_each(results)):
        s, y = shear.data["displacement_mm"][shear.rows], shear.data[name][shear.rows]
        axes.plot(s, y, look.mark, **_line(look, k, len(s), 1.2))
    _finish(axes, results, [s.data[name][s.rows] for s in results.shears])
    return figure


def _each(results: Results) -> list[tuple[Shear, Look]]:
    of = looks([shear.sigma for shear in results.shears])
    return [(shear, of[shear.sigma]) for shear in results.shears]


def _places(fit: Fit, shear: Shear, zone: float = 0) -> np.ndarray:
    return np.linspace(max(zone, shear.data["displacement_mm"][shear.rows][0]), fit.span - zone, 400)


def _line(look: Look, number: int, points: int, width: float = 1.8) -> dict[str, Any]:
    """Of the curve of that number: its marks stand between those of the others."""
    every = points // MARKS
    return {
        "color": look.colour,
        "ls": look.dashes,
        "lw": width,
        "ms": 4.5,
        "markevery": ((number % 4) * every // 4 + every // 8, every),
    }


def _draw_rows(axes: Axes, shear: Shear, column: str, look: Look) -> None:
    axes.plot(shear.data["displacement_mm"], shear.data[column], color=look.colour, lw=0.5, alpha=0.45, zorder=1)


def _draw_fit(axes: Axes, shear: Shear, series: Legendre, look: Look, number: int, zone: float = 0) -> None:
    s = _places(shear.tau, shear, zone)
    axes.plot(s, series(s), look.mark, **_line(look, number, len(s)))


def _draw_peak(axes: Axes, position: float, value: float, look: Look) -> None:
    axes.plot(
        position, value, look.mark, ms=8.5, color="white", mec=look.colour, mew=1.8, zorder=4, clip_on=False
    )  # fmt: skip


def _finish(axes: Axes, results: Results, heights: list[np.ndarray]) -> None:
    """Axes as high as the curves at full speed: spikes of start and stop do not widen them."""
    low, high = min(0.0, *(h.min() for h in heights)), max(0.0, *(h.max() for h in heights))
    margin = MARGIN * (high - low) or 1.0  # a curve may be zero all along
    axes.set_ylim(low - margin * (low < 0), high + margin)
    axes.set_xlim(0, results.identity["travel_mm"])
    axes.axhline(0, color=AXIS_COLOUR, lw=0.8, zorder=1)
    name_stresses(axes, looks([shear.sigma for shear in results.shears]))


def _degrees(rate: np.ndarray) -> np.ndarray:
    return np.degrees(np.arctan(rate))


def _slope(angle: np.ndarray) -> np.ndarray:
    return np.tan(np.radians(np.clip(angle, -89, 89)))
