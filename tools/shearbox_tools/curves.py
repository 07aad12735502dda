# SPDX-License-Identifier: GPL-2.0-or-later
"""The report's diagrams."""

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .features import steepest_dilatancy
from .polynomial import end_zone
from .results import Results
from .shear import Shear
from .strength import Line
from .style import RC, as_uri, colours

SIZE = (5.6, 3.7)  # inches
DISPLACEMENT = "shear displacement (mm)"


def draw_curves(results: Results) -> dict[str, str]:
    """The diagrams by name, each an SVG as a data: URI."""
    with rc_context(RC):
        return {
            "strength": as_uri(_strength(results), "svg"),
            "stress": as_uri(_stress(results), "svg"),
            "lid": as_uri(_lid(results), "svg"),
            "rate": as_uri(_rate(results), "svg"),
        }


def _axes(x: str, y: str) -> tuple[Figure, Axes]:
    figure = Figure(figsize=SIZE, layout="constrained")
    axes = figure.add_subplot()
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    return figure, axes


def _palette(results: Results) -> dict[float, str]:
    return colours([shear.sigma for shear in results.shears])


def _strength(results: Results) -> Figure:
    """sigma-tau line through the peaks of the polynomials with its 95 % band, and the peaks of the smoothed data."""
    figure, axes = _axes("normal stress σ (kPa)", "peak shear stress τ (kPa)")
    end = 1.12 * max(shear.sigma for shear in results.shears)
    if results.line and not results.doubts:
        _draw_line(axes, results.line, end)
    for shear in results.shears:
        axes.errorbar(
            shear.sigma, shear.peak.value, shear.peak.value_error, fmt="o", ms=6, capsize=4, lw=1.4,
            color=_palette(results)[shear.sigma], mfc="white" if shear.peak.at_boundary or shear.doubt else None, zorder=3,
        )  # fmt: skip
        axes.plot(shear.sigma, shear.smoothed.value, "x", ms=6, color=_palette(results)[shear.sigma], zorder=4)
    axes.set_xlim(0, end)
    lowest = min(shear.peak.value - shear.peak.value_error for shear in results.shears)
    highest = max(shear.peak.value + shear.peak.value_error for shear in results.shears)
    axes.set_ylim(min(0, 1.25 * lowest), 1.25 * highest)
    return figure


def _draw_line(axes: Axes, line: Line, end: float) -> None:
    sigma = np.linspace(0, end, 100)
    tau, band = line.c_kPa + line.slope * sigma, line.band(sigma)
    label = (
        f"τ = c + σ tan φ\nφ = {line.phi_deg:.1f} ± {line.phi_half_width_deg:.1f}° (fit alone)\n"
        f"c = {line.c_kPa:.1f} ± {line.c_half_width_kPa:.1f} kPa"
    )
    axes.plot(sigma, tau, color="#555d66", lw=1.4, label=label.replace("-", "−"))
    axes.fill_between(sigma, tau - band, tau + band, color="#555d66", alpha=0.13, lw=0, label="95 % band of the fit")
    axes.legend(loc="upper left")


def _stress(results: Results) -> Figure:
    """tau against displacement: raw faint, fit strong, its peak ringed, that of the smoothed data crossed."""
    figure, axes = _axes(DISPLACEMENT, "shear stress τ (kPa)")
    for shear in results.shears:
        _draw_curve(axes, shear, "tau_kPa", _palette(results)[shear.sigma])
        marker = "D" if shear.peak.at_boundary else "o"
        axes.plot(shear.peak.position, shear.peak.value, marker, ms=5.5, color="white", zorder=4, clip_on=False,
                  mec=_palette(results)[shear.sigma], mew=1.6)  # fmt: skip
        axes.plot(shear.smoothed.position, shear.smoothed.value, "x", ms=6, color=_palette(results)[shear.sigma])
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    _finish(axes, results)
    return figure


def _lid(results: Results) -> Figure:
    """Lid displacement (dilatancy, upward positive) against shear displacement."""
    figure, axes = _axes(DISPLACEMENT, "lid displacement, up (mm)")
    for shear in results.shears:
        _draw_curve(axes, shear, "lid_mm", _palette(results)[shear.sigma])
    axes.axhline(0, color="#8a929b", lw=0.8)
    _finish(axes, results)
    return figure


def _rate(results: Results) -> Figure:
    """Slope of the fitted lid displacement; its steepest point and the position of the stress peak are marked."""
    figure, axes = _axes(DISPLACEMENT, "dilatancy rate, lid/shear (mm/mm)")
    for shear in results.shears:
        colour, lid = _palette(results)[shear.sigma], shear.lid
        s = np.linspace(end_zone(lid.span), lid.span - end_zone(lid.span), 300)
        axes.plot(s, lid.series.deriv()(s), color=colour, lw=1.7)
        axes.plot(*steepest_dilatancy(lid), "^", ms=6, color=colour)
        if not shear.peak.at_boundary:
            rate = lid.series.deriv()(shear.peak.position)
            axes.plot(shear.peak.position, rate, "o", ms=5.5, color="white", mec=colour, mew=1.6)
    axes.axhline(0, color="#8a929b", lw=0.8)
    _finish(axes, results)
    return figure


def _draw_curve(axes: Axes, shear: Shear, column: str, colour: str) -> None:
    fit = shear.tau if column == "tau_kPa" else shear.lid
    s = np.linspace(shear.data["displacement_mm"][shear.rows][0], fit.span, 400)
    axes.plot(shear.data["displacement_mm"], shear.data[column], color=colour, lw=0.6, alpha=0.35)
    axes.plot(s, fit.series(s), color=colour, lw=2)


def _finish(axes: Axes, results: Results) -> None:
    for shear in results.shears:
        axes.plot([], [], color=_palette(results)[shear.sigma], lw=2, label=f"{shear.sigma:g} kPa")
    axes.set_xlim(0, results.identity["travel_mm"])
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0), columnspacing=1.4)
