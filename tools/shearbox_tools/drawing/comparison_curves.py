# SPDX-License-Identifier: GPL-2.0-or-later
"""Diagrams of ensembles over each other, one for each stress; ensembles differ by colour and by dashes."""

from collections.abc import Sequence

from matplotlib import rc_context
from matplotlib.figure import Figure

from ..analysis.ensemble_results import Ensemble
from ..analysis.mean_curve import Band, MeanCurve
from .curves import DISPLACEMENT
from .ensemble_curves import POINTS, Limits, scales_of
from .style import ALL_LOOKS, AXIS_COLOUR, RC, Look, as_uri, diagram

Line = tuple[str, Look, MeanCurve]


def draw_comparison(names: Sequence[str], ensembles: Sequence[Ensemble]) -> dict[str, str]:
    """SVG as data: URIs: 'stress SIGMA' and 'lid SIGMA' of every stress that any ensemble has."""
    every = [curve for ensemble in ensembles for curve in ensemble.curves.values()]
    ratio, lid = scales_of(every)
    pictures = {}
    with rc_context(RC):
        for sigma in sorted({curve.sigma for curve in every}):
            lines = [
                (name, look, ensemble.curves[sigma])
                for name, look, ensemble in zip(names, ALL_LOOKS, ensembles)
                if sigma in ensemble.curves
            ]
            stress = [(line, line[2].tau, sigma) for line in lines]
            pictures[f"stress {sigma:g}"] = as_uri(_overlaid(stress, sigma, "τ/σ (–)", ratio))
            rise = [(line, line[2].lid, 1.0) for line in lines]
            pictures[f"lid {sigma:g}"] = as_uri(_overlaid(rise, sigma, "lid, up + (mm)", lid))
    return pictures


def _overlaid(lines: Sequence[tuple[Line, Band, float]], sigma: float, title: str, limits: Limits) -> Figure:
    """Means, each band over its number, with the standard error where there are several specimens."""
    figure, axes = diagram(DISPLACEMENT, title)
    for (name, look, curve), band, over in lines:
        rows = slice(None, None, -(-len(curve.displacement) // POINTS))
        s, mean = curve.displacement[rows], band.mean[rows] / over
        if curve.count > 1:
            width = band.error[rows] / over
            axes.fill_between(s, mean - width, mean + width, color=look.colour, alpha=0.18, lw=0)
        axes.plot(s, mean, color=look.colour, ls=look.dashes, lw=1.5, label=f"{name} ({curve.count})")
    axes.axhline(0, color=AXIS_COLOUR, lw=0.8)
    axes.set(xlim=(0, max(curve.displacement[-1] for (_, _, curve), _, _ in lines)), ylim=limits)
    axes.legend(
        loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=5, title=f"{sigma:g} kPa", alignment="left",
        columnspacing=1.2, handlelength=2.8,
    )  # fmt: skip
    return figure
