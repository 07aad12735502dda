# SPDX-License-Identifier: GPL-2.0-or-later
"""Differences of two means, with intervals of strength.COVERAGE.

Specimens that are independent: Welch (Biometrika 34 (1947) 28), a t test with the freedom of Satterthwaite. The same packings
on both sides, which were only sheared differently: Student's t of the differences, packing by packing, which the scatter
of packings is not in.
"""

from dataclasses import dataclass

import numpy as np

from .ensemble import EnsembleStrength, Estimate, as_angle, mean_of
from .strength import student_quantile


@dataclass(frozen=True)
class Mean:
    """A mean with its interval; without one where there is one specimen."""

    value: float
    low: float | None = None
    high: float | None = None
    error: float | None = None  # standard error
    freedom: float = 0
    values: np.ndarray | None = None  # (specimens,), with this mean; None where each stress has packings of its own


@dataclass(frozen=True)
class Difference:
    """Of a mean to the first; without an interval where either has one specimen."""

    value: float
    low: float | None
    high: float | None


def mean(values: np.ndarray) -> Mean:
    """Of a number of each specimen, (n,)."""
    if len(values) == 1:
        return Mean(float(values[0]), values=values)
    return _with_interval(mean_of(values), values)


def mean_angle(slopes: np.ndarray) -> Mean:
    """The angle (degrees) of the mean slope of specimens, (n,). Its values are to first order in slope less mean."""
    middle = np.mean(slopes)
    values = np.degrees(np.arctan(middle) + (slopes - middle) / (1 + middle**2))
    if len(slopes) == 1:
        return Mean(float(values[0]), values=values)
    return _with_interval(as_angle(mean_of(slopes)), values)


def mean_strength(strength: EnsembleStrength, freedom: int) -> tuple[Mean, Mean]:
    """phi (degrees) and c (kPa) of a line through independent peaks; errors of an angle are to first order, as above."""
    phi, c, quantile = strength.phi_deg, strength.c_kPa, student_quantile(freedom)
    slope, high = (np.tan(np.radians(angle)) for angle in (phi.value, phi.high))
    error = float(np.degrees((high - slope) / (1 + slope**2)) / quantile)
    return _of_line(phi, error, freedom), _of_line(c, float(c.high - c.value) / quantile, freedom)


def difference(first: Mean, other: Mean, paired: bool) -> Difference:
    """paired: the values of both are of the same packings, in the same order."""
    value = other.value - first.value
    if first.error is None or other.error is None:
        return Difference(value, None, None)
    if paired and first.values is not None and other.values is not None:
        of_pairs = mean_of(other.values - first.values)
        return Difference(value, float(of_pairs.low), float(of_pairs.high))
    parts = np.array([first.error**2, other.error**2])
    if not np.any(parts):
        return Difference(value, value, value)
    freedom = parts.sum() ** 2 / np.sum(parts**2 / [first.freedom, other.freedom])
    half = student_quantile(freedom) * float(np.sqrt(parts.sum()))
    return Difference(value, value - half, value + half)


def _with_interval(estimate: Estimate, values: np.ndarray) -> Mean:
    error = float(values.std(ddof=1) / np.sqrt(len(values)))
    return Mean(float(estimate.value), float(estimate.low), float(estimate.high), error, len(values) - 1, values)


def _of_line(estimate: Estimate, error: float, freedom: int) -> Mean:
    return Mean(float(estimate.value), float(estimate.low), float(estimate.high), error, freedom)
