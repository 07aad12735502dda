# SPDX-License-Identifier: GPL-2.0-or-later
"""Strength of a sand from several specimens, with intervals that hold their scatter.

One specimen differs from the next by more than the error of its peaks, and stresses that share a packing share that
difference: it is no noise of points around a line. The model is one with random effects of the specimen (Laird and
Ware, Biometrics 38 (1982) 963),

    tau_ij = c_j + sigma_i tan(phi_j) + e_ij,    wanted: the means of c_j and tan(phi_j) over all specimens j.

The scatter e of a peak grows with sigma, as peaks' errors and the influence of phi_j do: lines are ordinary least
squares of tau / sigma = tan(phi) + c (1 / sigma), that is, with weights 1 / sigma^2 (Aitken, Proc. R. Soc. Edinburgh 55
(1935) 42). Leading axes of arrays are ensembles of their own, and the estimates have their shape. All intervals are of
strength.COVERAGE.
"""

from dataclasses import dataclass

import numpy as np

from .strength import student_quantile


@dataclass(frozen=True)
class Estimate:
    """A mean over all specimens, the ends of its interval, and the scatter of specimens (None: cannot be told)."""

    value: np.ndarray
    low: np.ndarray
    high: np.ndarray
    deviation: np.ndarray | None  # standard deviation from specimen to specimen


@dataclass(frozen=True)
class EnsembleStrength:
    """Friction angle (degrees) and cohesion (kPa) of the mean line."""

    phi_deg: Estimate
    c_kPa: Estimate


def mean_of(values: np.ndarray) -> Estimate:
    """Mean over specimens (..., n), n >= 2, and Student's interval: of any number that each specimen has one of."""
    count = values.shape[-1]
    _need(count, "specimens")
    deviation = values.std(axis=-1, ddof=1)
    half = student_quantile(count - 1) * deviation / np.sqrt(count)
    mean = values.mean(axis=-1)
    return Estimate(mean, mean - half, mean + half, deviation)


def as_angle(slope: Estimate) -> Estimate:
    """The same of the angle (degrees) that has the slope; the scatter is that near the mean."""
    value, low, high = (np.degrees(np.arctan(s)) for s in (slope.value, slope.low, slope.high))
    scatter = None if slope.deviation is None else np.degrees(slope.deviation / (1 + slope.value**2))
    return Estimate(value, low, high, scatter)


def strength_of_shared(sigma: np.ndarray, tau: np.ndarray) -> EnsembleStrength:
    """Each specimen is one packing, sheared at all stresses sigma in kPa, (n,) or for each specimen (..., specimens, n);
    tau (..., specimens, n).

    A line for each specimen, and Student's interval over the lines. With the same stresses for all this is exact for
    normal c_j, tan(phi_j) and e_ij, whatever their variances and correlations: the lines are independent and alike
    (Rao, Biometrika 52 (1965) 447; as a practice: Matthews et al., BMJ 300 (1990) 230).
    """
    slopes, cohesions = lines_of(sigma, tau)
    return EnsembleStrength(as_angle(mean_of(slopes)), mean_of(cohesions))


def lines_of(sigma: np.ndarray, tau: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """tan(phi) and c (kPa) of each specimen, (..., specimens): sigma and tau as for strength_of_shared."""
    _need(len(np.unique(sigma)), "stresses")
    slopes, cohesions = np.moveaxis(np.linalg.pinv(_design(sigma)) @ (tau / sigma)[..., None], -2, 0)[..., 0]
    return slopes, cohesions


def strength_of_independent(sigma: np.ndarray, tau: np.ndarray) -> EnsembleStrength:
    """Each peak is that of a packing of its own: tau (..., n) at sigma (n,) in kPa, n >= 3, stresses may be repeated.

    One line through all points, which are independent, and Student's interval of the regression with n - 2 degrees of
    freedom. It is exact for normal scatter in proportion to sigma, and lets phi and c through in 94 to 96 % of cases
    with 3 kPa beside it; what a specimen and what a peak adds to it cannot be told apart.
    """
    _need(len(np.unique(sigma)), "stresses")
    freedom = len(sigma) - 2
    if freedom < 1:
        raise ValueError(f"{len(sigma)} peaks: at least 3 are needed")
    design, ratio = _design(sigma), tau / sigma
    lines = ratio @ np.linalg.pinv(design).T
    variance = np.sum((ratio - lines @ design.T) ** 2, axis=-1) / freedom
    errors = np.sqrt(variance[..., None] * np.diag(np.linalg.inv(design.T @ design)))
    half = student_quantile(freedom) * errors
    slope, cohesion = (Estimate(lines[..., k], (lines - half)[..., k], (lines + half)[..., k], None) for k in (0, 1))
    return EnsembleStrength(as_angle(slope), cohesion)


def _design(sigma: np.ndarray) -> np.ndarray:
    """(..., n, 2) of (tan(phi), c) in tau / sigma (..., n)."""
    return np.stack([np.ones_like(sigma), 1 / sigma], axis=-1)


def _need(count: int, what: str) -> None:
    if count < 2:
        raise ValueError(f"{count} {what}: at least 2 are needed")
