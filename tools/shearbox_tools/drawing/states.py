# SPDX-License-Identifier: GPL-2.0-or-later
"""The report's diagrams of states of stress: strength, stress paths, stress ratio against dilatancy rate."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..analysis.peak import Peak
from ..analysis.plane import NORMAL, SHEAR
from ..analysis.polynomial import end_zone
from ..analysis.results import Results
from ..analysis.shear import Shear
from ..analysis.smoothed import smooth
from ..analysis.strength import Line
from ..analysis.stress_dilatancy import rowe_ratio
from .style import AXIS_COLOUR, LINE_COLOUR, Look, diagram, looks, name_stresses

BEYOND = 1.1  # the diagrams end at so many times the greatest stress
LEAST_WIDTH = 0.8  # of a diagram of equal scales, of its height
PLANE_DASHES = (0, (6, 2))  # of lines by the shear plane


def strength(results: Results) -> Figure:
    """Peaks and Coulomb's line through them with its 95 % band, by the lid and by the shear plane."""
    figure, axes = diagram("normal stress σ (kPa)", "peak shear stress τ (kPa)")
    of = _looks(results)
    for shear in results.shears:
        _draw_peaks(axes, shear, of[shear.sigma])
    _equal_scales(axes)
    for line, by, dashes in _lines(results):
        _draw_line(axes, line, by, dashes)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), handlelength=3.2)
    return figure


def stress_paths(results: Results) -> Figure:
    """τ against σ, both smoothed, from start to end: felt by the lid (thin), and on the shear plane (thick)."""
    figure, axes = diagram("normal stress σ (kPa)", "shear stress τ (kPa)")
    of = _looks(results)
    for shear in results.shears:
        _draw_path(axes, shear, ("sigma_kPa", "tau_kPa"), shear.peak, of[shear.sigma], 1.0)
        if shear.plane:
            _draw_path(axes, shear, (NORMAL, SHEAR), shear.plane.peak, of[shear.sigma], 2.2)
    _equal_scales(axes)
    for line, _, dashes in _lines(results):
        end = axes.get_xlim()[1]
        axes.plot([0, end], [line.c_kPa, line.c_kPa + line.slope * end], color=LINE_COLOUR, lw=1, ls=dashes, zorder=1)
    name_stresses(axes, of)
    return figure


def stress_dilatancy(results: Results) -> Figure:
    """τ/σ of the lid against the slope of its displacement, and Rowe's relation for the mean φ_cv of the ends."""
    figure, axes = diagram("dilatancy rate, lid/shear (mm/mm)", "stress ratio τ/σ (–)")
    of = _looks(results)
    rates = []
    for shear in results.shears:
        look, slope, zone = of[shear.sigma], shear.lid.series.deriv(), end_zone(shear.lid.span)
        s = np.linspace(zone, shear.lid.span - zone, 400)
        axes.plot(slope(s), shear.tau.series(s) / shear.sigma, color=look.colour, ls=look.dashes, lw=1.6)
        axes.plot(shear.at_peak.rate, shear.at_peak.ratio, look.mark, **_hollow(look))
        axes.plot(shear.at_end.rate, shear.at_end.ratio, look.mark, ms=5.5, color=look.colour, zorder=4)
        rates += [slope(s), [shear.at_peak.rate, shear.at_end.rate]]
    _draw_rowe(axes, results, np.concatenate([*rates, [0]]))
    axes.set_ylim(bottom=min(0, axes.get_ylim()[0]))
    axes.axvline(0, color=AXIS_COLOUR, lw=0.8, zorder=1)
    name_stresses(axes, of)
    return figure


def _looks(results: Results) -> dict[float, Look]:
    return looks([shear.sigma for shear in results.shears])


def _hollow(look: Look) -> dict[str, Any]:
    return {"ms": 8.5, "color": "white", "mec": look.colour, "mew": 1.8, "zorder": 4}


def _lines(results: Results) -> list[tuple[Line, str, Any]]:
    """Coulomb's lines that can be told, what their normal stress is that of, and their dashes."""
    lines = ((results.strength, "lid", "-"), (results.plane_strength, "shear plane", PLANE_DASHES))
    return [(line, by, dashes) for line, by, dashes in lines if line]


def _draw_peaks(axes: Axes, shear: Shear, look: Look) -> None:
    """Of the polynomial: by the lid, hollow if it is not judged or none, and by the plane, always hollow; of the
    smoothed data a cross."""
    peak, colour = shear.peak, look.colour
    face = "white" if peak.at_boundary or shear.doubt else None
    bars = {"fmt": look.mark, "capsize": 3, "lw": 1.2, "color": colour, "zorder": 3}
    axes.errorbar(shear.sigma, peak.value, peak.value_error, ms=6, mfc=face, **bars)
    axes.plot(shear.sigma, shear.smoothed.value, "x", ms=7, mew=1.5, color=colour, zorder=4)
    if shear.plane:
        plane, of = shear.plane, shear.plane.peak
        axes.errorbar(
            plane.sigma_at_peak, of.value, of.value_error, plane.sigma_at_peak_error, ms=5, mfc="white", **bars
        )


def _draw_line(axes: Axes, line: Line, by: str, dashes: Any) -> None:
    """With its band, from its intercept on."""
    sigma = np.linspace(0, axes.get_xlim()[1], 100)
    tau, band = line.c_kPa + line.slope * sigma, line.band(sigma)
    label = (
        f"{by}: φ = {line.phi_deg:.1f} ± {line.phi_half_width_deg:.1f}°, "
        f"c = {line.c_kPa:.1f} ± {line.c_half_width_kPa:.1f} kPa"
    )
    axes.plot(sigma, tau, color=LINE_COLOUR, lw=1.4, ls=dashes, label=label.replace("-", "−"), zorder=2)
    axes.fill_between(sigma, tau - band, tau + band, color=LINE_COLOUR, alpha=0.12, lw=0, zorder=1)
    if line.c_kPa >= axes.get_ylim()[0]:
        axes.plot(0, line.c_kPa, "_", ms=12, mew=1.8, color=LINE_COLOUR, clip_on=False, zorder=3)


def _draw_path(axes: Axes, shear: Shear, columns: tuple[str, str], peak: Peak, look: Look, width: float) -> None:
    """Of two columns, normal and shear stress, with the peak hollow and the end filled."""
    sigma, tau = (smooth(shear.data[name][shear.rows]) for name in columns)
    axes.plot(sigma, tau, color=look.colour, ls=look.dashes, lw=width)
    top = int(np.argmin(np.abs(shear.data["displacement_mm"][shear.rows] - peak.position)))
    axes.plot(sigma[top], tau[top], look.mark, **_hollow(look))
    axes.plot(sigma[-1], tau[-1], look.mark, ms=5.5, color=look.colour, zorder=4)


def _draw_rowe(axes: Axes, results: Results, rates: np.ndarray) -> None:
    angles = [a for a in (s.at_end.critical_by_rowe_deg for s in results.shears) if a is not None]
    if not angles:
        return
    rate, angle = np.linspace(rates.min(), rates.max(), 100), float(np.mean(angles))
    axes.plot(rate, rowe_ratio(rate, angle), color=LINE_COLOUR, lw=1.2, zorder=2)
    axes.annotate(f"Rowe, φ_cv = {angle:.1f}°", (0.98, 0.03), xycoords="axes fraction", ha="right", color=LINE_COLOUR)


def _equal_scales(axes: Axes) -> None:
    """So that the angle of a line is that of the sand; from 0 on, and below where the data are."""
    data = axes.dataLim
    top = BEYOND * max(0, data.y1) or 1.0  # kPa
    axes.set_xlim(min(0, data.x0), max(BEYOND * data.x1, LEAST_WIDTH * top))
    axes.set_ylim(min(0, data.y0), top)
    axes.set_aspect("equal")
