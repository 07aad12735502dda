# SPDX-License-Identifier: GPL-2.0-or-later
"""The peak of a fitted curve, and whether it is one."""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from .polynomial import Fit, end_zone

REPLICAS = 400
IMAGINARY = 2e-9  # of a zero on [-1, 1] that is real but for round-off, at most


@dataclass(frozen=True)
class Peak:
    """Greatest value of a fitted curve, with standard uncertainties, in the units of the curve."""

    value: float
    value_error: float
    position: float
    position_error: float
    at_boundary: bool  # there is no peak within the travel
    falls: bool = False  # then: the curve falls from its first zone on, instead of rising to its end


def find_peak(fit: Fit) -> Peak:
    """Highest interior maximum, unless the curve is significantly higher at one of its ends.

    A polynomial is poorly held near its ends, so maxima within `end_zone` of them do not count. If the value at the end of
    the travel or behind the first zone exceeds the interior maximum by more than two standard errors, or there is no interior
    maximum, the higher of those that do is returned and marked as such: the end of the travel for a curve that rises, the
    first zone for one that falls.

    The uncertainties are the root mean square deviations of the bootstrap replicas from the peak: they hold
    the noise, the choice of the degree, and the bias of taking the maximum of a noisy curve.
    """
    ends = np.array([end_zone(fit.span), fit.span])
    margins = 2 * fit.error(ends)
    (position,), (value,), (at_boundary,), (falls,) = _locate(fit.series.coef[:, None], fit.span, ends, margins)
    positions, values, *_ = _locate(fit.replicas(REPLICAS), fit.span, ends, margins)
    errors = _rms(values - value), _rms(positions - position)
    return Peak(float(value), errors[0], float(position), errors[1], bool(at_boundary), bool(falls))


def steepest(fit: Fit) -> tuple[float, float]:
    """Where a fitted curve rises fastest, and its slope there, by the rule of find_peak for the slope: within `end_zone` of either
    end a slope is hardly held, so both ends of the curve are where these zones begin."""
    ends = np.array([end_zone(fit.span), fit.span - end_zone(fit.span)])
    slopes = fit.series.deriv().coef[:, None]
    (position,), (slope,), *_ = _locate(slopes, fit.span, ends, 2 * fit.slope_error(ends))
    return float(position), float(slope)


def _locate(
    curves: np.ndarray, span: float, ends: np.ndarray, margins: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Positions of the peaks of polynomials on [0, span], their heights, whether they are at an end, and at the first.

    curves: (n, c) Legendre coefficients of c polynomials; ends: two places, which count if they are higher than what is inside by
    more than their margins.
    """
    tops = maxima(curves)
    heights = np.where(np.abs(tops) < 1 - end_zone(2), legendre.legval(tops, curves, tensor=False), -np.inf)
    highest = heights.argmax(axis=0)[None]
    top, height = (np.take_along_axis(of, highest, axis=0)[0] for of in (tops, heights))
    first, last = legendre.legval(2 * ends / span - 1, curves).T
    highest_first, highest_last = first > height + margins[0], last > height + margins[1]
    rises = highest_last & ((last > first) | ~highest_first)
    falls = highest_first & ~rises
    positions = np.select([rises, falls], [ends[1], ends[0]], span * (top + 1) / 2)
    values = np.select([rises, falls], [last, first], height)
    return positions, values, rises | falls, falls


def maxima(curves: np.ndarray) -> np.ndarray:
    """(n, c) where Legendre series, (n, c), have their local maxima, NaN for the rest: real zeros of the derivative
    where the second derivative is negative."""
    slopes = legendre.legder(curves)
    bends = legendre.legder(slopes)
    degrees = np.max(np.arange(len(slopes))[:, None] * (slopes != 0), axis=0)
    tops = np.full(curves.shape, np.nan)
    for degree in set(degrees) - {0}:
        alike = degrees == degree
        zeros = np.linalg.eigvals(_companions(slopes[: degree + 1, alike])).T
        down = legendre.legval(zeros.real, bends[:, alike], tensor=False) < 0
        tops[:degree, alike] = np.where(down & (np.abs(zeros.imag) < IMAGINARY), zeros.real, np.nan)
    return tops


def _companions(series: np.ndarray) -> np.ndarray:
    """(c, degree, degree) matrices whose eigenvalues are the zeros of Legendre series, (degree + 1, c): that of the last
    function alone, and what the others change in its last column, as in numpy's legcompanion."""
    degree = len(series) - 1
    matrices = np.tile(legendre.legcompanion(np.eye(degree + 1)[-1]), (series.shape[1], 1, 1))
    scale = 1 / np.sqrt(2 * np.arange(degree) + 1)
    others = series[:-1] / series[-1] * scale[:, None] / scale[-1]
    matrices[:, :, -1] -= others.T * degree / (2 * degree - 1)
    return matrices[:, ::-1, ::-1]  # reversed, eigenvalues are more accurate


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))
