# SPDX-License-Identifier: GPL-2.0-or-later
"""The three features of a direct shear test on sand (the paper's section 2.4), judged by rule instead of by eye.

The thresholds are this project's choice, shown with every verdict.
"""

import sys

import numpy as np

from ..base.verdict import Verdict, told_apart
from .peak import Peak, steepest
from .polynomial import Fit
from .strength import Line

LEAST_R_SQUARED = 0.98
LEAST_STANDARD_ERRORS = 2
LEAST_PERCENT_AT_STEEPEST = 90


def proportional(sigma: np.ndarray, tau_peak: np.ndarray, line: Line | None) -> Verdict:
    """Feature 1: the peak stress rises with every step of sigma, and a line explains R^2 >= 0.98 of it."""
    if line is None or len(sigma) < 3:
        return Verdict(None, f"needs at least 3 stresses, there are {len(sigma)}")
    rise = float(np.min(np.diff(tau_peak)))
    ratios = ", ".join(f"{ratio:.2f}" for ratio in tau_peak / sigma)
    reason = (
        f"least rise of τ_peak from one σ to the next {told_apart(rise, 0, 1, '+')} kPa (> 0); "
        f"R² of the line {told_apart(line.r_squared, LEAST_R_SQUARED, 3)} (≥ {LEAST_R_SQUARED}); τ_peak/σ = {ratios}"
    )
    return Verdict(rise > 0 and line.r_squared >= LEAST_R_SQUARED, reason)


def dilates(lid: Fit, peak: Peak) -> Verdict:
    """Feature 2: when tau has grown to its peak the lid (mm) is above its start by more than two standard errors."""
    height = float(lid.series(peak.position))
    error = max(float(lid.error(peak.position)[0]), sys.float_info.min)
    before = np.linspace(0, peak.position, 101)
    lowest = float(min(0.0, np.min(lid.series(before))))
    reason = (
        f"lid at the peak {height:+.3f} ± {error:.3f} mm, {told_apart(height / error, LEAST_STANDARD_ERRORS, 1)} "
        f"standard errors above 0 (> {LEAST_STANDARD_ERRORS}), {height - lowest:.3f} mm above its lowest point on the way"
    )
    return Verdict(height / error > LEAST_STANDARD_ERRORS, reason)


def peak_at_steepest(tau: Fit, peak: Peak, lid: Fit) -> Verdict:
    """Feature 3: where the lid rises fastest, tau is at least 90 % of its peak."""
    if peak.value <= 0:
        return Verdict(None, f"τ at its peak is {told_apart(peak.value, 0, 0)} kPa: there is no share of it")
    position, rate = steepest(lid)
    percent = 100 * float(tau.series(position)) / peak.value
    reason = (
        f"steepest dilatancy {told_apart(rate, 0, 3)} mm/mm at {position:.2f} mm, where τ is "
        f"{told_apart(percent, LEAST_PERCENT_AT_STEEPEST, 0)} % of its peak (≥ {LEAST_PERCENT_AT_STEEPEST} %), "
        f"which is at {peak.position:.2f} mm"
    )
    return Verdict(rate > 0 and percent >= LEAST_PERCENT_AT_STEEPEST, reason)
