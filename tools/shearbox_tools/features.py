# SPDX-License-Identifier: GPL-2.0-or-later
"""The three features of a direct shear test on sand (the paper's section 2.4), judged by rule instead of by eye.

The thresholds are this project's choice, shown with every verdict.
"""

from dataclasses import dataclass

import numpy as np

from .peak import Peak, turning_points
from .polynomial import Fit, end_zone
from .strength import Line

LEAST_R_SQUARED = 0.98
LEAST_STRESS_AT_STEEPEST = 0.9


@dataclass(frozen=True)
class Verdict:
    """Whether a feature is there (None: cannot be judged) and the numbers that say so."""

    holds: bool | None
    reason: str


def proportional(sigma: np.ndarray, tau_peak: np.ndarray, line: Line | None) -> Verdict:
    """Feature 1: the peak stress rises with every step of sigma, and a line explains R^2 >= 0.98 of it."""
    if line is None or len(sigma) < 3:
        return Verdict(None, f"needs at least 3 stresses, there are {len(sigma)}")
    rises = bool(np.all(np.diff(tau_peak) > 0))
    ratios = ", ".join(f"{ratio:.2f}" for ratio in tau_peak / sigma)
    reason = (
        f"τ_peak {'rises' if rises else 'does not rise'} with every σ; R² of the line {line.r_squared:.3f} "
        f"(≥ {LEAST_R_SQUARED}); τ_peak/σ = {ratios}"
    )
    return Verdict(rises and line.r_squared >= LEAST_R_SQUARED, reason)


def dilates(lid: Fit, peak: Peak) -> Verdict:
    """Feature 2: when tau has grown to its peak the lid (mm) is above its start by more than two standard errors."""
    height = float(lid.series(peak.position))
    error = float(lid.error(peak.position)[0])
    before = np.linspace(0, peak.position, 101)
    lowest = float(min(0.0, np.min(lid.series(before))))
    reason = (
        f"lid at the peak {height:+.3f} ± {error:.3f} mm (> 2 standard errors above 0), "
        f"{height - lowest:.3f} mm above its lowest point on the way"
    )
    return Verdict(height > 2 * error, reason)


def steepest_dilatancy(lid: Fit) -> tuple[float, float]:
    """Position (mm) and rate (mm/mm) of the steepest rise of the lid, away from the ends of the fit.

    The highest turning point of the rate; where it has none, the greater of its values at the two end zones.
    """
    rate = lid.series.deriv()
    ends = (end_zone(lid.span), lid.span - end_zone(lid.span))
    inside = [s for s in turning_points(rate) if ends[0] < s < ends[1]]
    position = max(inside or ends, key=rate)
    return float(position), float(rate(position))


def peak_at_steepest(tau: Fit, peak: Peak, lid: Fit) -> Verdict:
    """Feature 3: where the lid rises fastest, tau is at least 90 % of its peak."""
    position, rate = steepest_dilatancy(lid)
    share = float(tau.series(position)) / peak.value
    reason = (
        f"steepest dilatancy {rate:.3f} mm/mm at {position:.2f} mm, where τ is {100 * share:.0f} % of its peak "
        f"(≥ {100 * LEAST_STRESS_AT_STEEPEST:.0f} %), which is at {peak.position:.2f} mm"
    )
    return Verdict(rate > 0 and share >= LEAST_STRESS_AT_STEEPEST, reason)
