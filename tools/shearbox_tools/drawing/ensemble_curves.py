# SPDX-License-Identifier: GPL-2.0-or-later
"""Diagrams of ensembles. A stress has a diagram of its own, and all of them the same scales: bands would hide each other."""

from collections.abc import Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from ..analysis.ensemble_results import Ensemble
from ..analysis.mean_curve import Band, MeanCurve
from .style import AXIS_COLOUR, INK, LINE_COLOUR, RC, Look, as_uri, diagram, looks

POINTS = 400  # of a line, at most
MARGIN = 0.06  # of a scale, above and below what is shown

Limits = tuple[float, float]


def draw_ensembles(ensembles: Sequence[Ensemble]) -> list[dict[str, str]]:
    """For each ensemble its diagrams, SVG as data: URIs: 'stress SIGMA', 'lid SIGMA', 'strength'."""
    every = [curve for ensemble in ensembles for curve in ensemble.curves.values()]
    ratio, lid = scales_of(every)
    drawn = []
    with rc_context(RC):
        for ensemble in ensembles:
            pictures = {"strength": as_uri(_strength(ensemble))}
            look = looks(list(ensemble.curves))
            for sigma, curve in ensemble.curves.items():
                stress = _curve(curve, curve.tau, sigma, "τ/σ (–)", look[sigma], ratio)
                pictures[f"stress {sigma:g}"] = as_uri(stress)
                rise = _curve(curve, curve.lid, 1.0, "lid, up (mm)", look[sigma], lid)
                pictures[f"lid {sigma:g}"] = as_uri(rise)
            drawn.append(pictures)
    return drawn


def scales_of(curves: Sequence[MeanCurve]) -> tuple[Limits, Limits]:
    """Of the stress ratio and of the lid's rise: 0 and all of the curves are seen."""
    return _limits([(curve.tau, curve.sigma) for curve in curves]), _limits([(curve.lid, 1.0) for curve in curves])


def _limits(bands: Sequence[tuple[Band, float]]) -> Limits:
    """Each band is over its number."""
    ends = [
        edge / over
        for band, over in bands
        for edge in (band.mean - np.nan_to_num(band.deviation), band.mean + np.nan_to_num(band.deviation))
    ]
    low, high = min(0.0, *(end.min() for end in ends)), max(0.0, *(end.max() for end in ends))
    margin = MARGIN * (high - low) or 1.0  # curves may be zero all along
    return low - margin, high + margin


def _curve(curve: MeanCurve, band: Band, over: float, name: str, look: Look, limits: Limits) -> Figure:
    """Mean with both bands; light is the scatter of specimens, dark the error of the mean."""
    figure, axes = diagram("shear displacement (mm)", name)
    rows = slice(None, None, -(-len(curve.displacement) // POINTS))
    s, mean = curve.displacement[rows], band.mean[rows] / over
    if curve.count > 1:
        for half, alpha, label in (
            (band.deviation, 0.18, "± standard deviation of specimens"),
            (band.error, 0.45, "± standard error of the mean"),
        ):
            width = half[rows] / over
            axes.fill_between(s, mean - width, mean + width, color=look.colour, alpha=alpha, lw=0, label=label)
    axes.plot(
        s,
        mean,
        color=INK,
        ls=look.dashes,
        lw=1.3,
        label=f"mean of {curve.count}" if curve.count > 1 else "one specimen",
    )
    axes.axhline(0, color=AXIS_COLOUR, lw=0.8)
    axes.set(xlim=(0, s[-1]), ylim=limits)
    axes.legend(
        loc="lower left", bbox_to_anchor=(-0.02, 1.0), fontsize=7, title=f"{curve.sigma:g} kPa", alignment="left"
    )
    return figure


def _strength(ensemble: Ensemble) -> Figure:
    """Peaks of all specimens, their means, and the mean line where there is one."""
    figure, axes = diagram("normal stress σ (kPa)", "peak shear stress τ (kPa)")
    look = looks(list(ensemble.shears))
    end = 1.12 * max(ensemble.shears)
    for sigma, shears in ensemble.shears.items():
        peaks = [shear.peak.value for shear in shears]
        axes.plot([sigma] * len(peaks), peaks, look[sigma].mark, ms=4, mfc="none", mec=look[sigma].colour, alpha=0.8)
        axes.plot(sigma, np.mean(peaks), "_", ms=16, mew=2, color=look[sigma].colour)
    axes.plot([], [], "o", ms=4, mfc="none", mec=INK, label="peak of a specimen")
    axes.plot([], [], "_", ms=14, mew=2, color=INK, label="mean of the peaks")
    if ensemble.strength:
        s, phi, c = np.array([0, end]), ensemble.strength.phi_deg, ensemble.strength.c_kPa
        label = f"φ = {phi.value:.1f}° [{phi.low:.1f}, {phi.high:.1f}], c = {c.value:.1f} kPa".replace("-", "−")
        axes.plot(s, c.value + s * np.tan(np.radians(phi.value)), color=LINE_COLOUR, lw=1.3, label=label)
    axes.set_xlim(0, end)
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    axes.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), fontsize=7, alignment="left")
    return figure
