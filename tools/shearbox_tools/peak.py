# SPDX-License-Identifier: GPL-2.0-or-later
"""The peak of a fitted curve, and whether it is one."""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Legendre

from .polynomial import Fit, end_zone

REPLICAS = 400


@dataclass(frozen=True)
class Peak:
    """Greatest value of a fitted curve, with standard uncertainties, in the units of the curve."""

    value: float
    value_error: float
    position: float
    position_error: float
    at_boundary: bool  # there is no peak within the travel


def find_peak(fit: Fit) -> Peak:
    """Highest interior maximum, unless the end of the curve is significantly higher.

    A polynomial is poorly held near its ends, so maxima within `end_zone` of them do not count. If the value at the end
    exceeds the interior maximum by more than two standard errors, or there is no interior maximum, the boundary is
    returned and marked as such: the end of the travel for a curve that rises, the first zone for one that falls.

    The uncertainties are the root mean square deviations of the bootstrap replicas from the peak: they hold
    the noise, the choice of the degree, and the bias of taking the maximum of a noisy curve.
    """
    margin = 2 * float(fit.error(fit.span)[0])
    position, at_boundary = _locate(fit.series, fit.span, margin)
    value = float(fit.series(position))
    replicas = fit.replicas(REPLICAS)
    positions = np.array([_locate(r, fit.span, margin)[0] for r in replicas])
    values = np.array([r(p) for r, p in zip(replicas, positions)])
    return Peak(value, _rms(values - value), position, _rms(positions - position), at_boundary)


def _locate(series: Legendre, span: float, margin: float) -> tuple[float, bool]:
    """Position of the peak of one polynomial on [0, span], and whether it is the end."""
    zone = end_zone(span)
    interior = [p for p in turning_points(series) if zone < p < span - zone]
    if not interior:
        ends = (zone, span)
        return max(ends, key=series), True
    highest = max(interior, key=series)
    if series(span) > series(highest) + margin:
        return span, True
    return highest, False


def turning_points(series: Legendre) -> list[float]:
    """Positions of the local maxima: real zeros of the derivative where the second derivative is negative."""
    slope = series.deriv()
    roots = np.atleast_1d(slope.roots())
    real = roots[np.abs(roots.imag) < 1e-9 * np.ptp(series.domain)].real
    return [float(p) for p in real if slope.deriv()(p) < 0]


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))
