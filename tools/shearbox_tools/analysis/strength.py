# SPDX-License-Identifier: GPL-2.0-or-later
"""Coulomb's line tau_f = c + sigma tan(phi) through the peaks (the paper's eq. 5), with its uncertainty."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import ndtri, stdtrit

from ..asking.models import is_of_the_decks

COVERAGE = 0.95
LEAST_ERROR = 1e-9
# of examples/paper/measured/specimens.csv: packings, least and greatest φ and its standard deviation, °
_SCATTER = {
    "TypeA_10x5_4-8_1-circle_350": (8, 30, 44, 4.8),
    "TypeB_15x5_4-8_1-circle_550": (8, 30, 35, 1.6),
    "TypeC_20x10_4-8_1-circle_1500": (4, 31, 33, 0.9),
    "TypeA_10x5_2-4_1-circle_1500": (8, 29, 32, 1.2),
    "TypeB_15x5_2-4_1-circle_2250": (8, 25, 30, 1.4),
    "TypeC_20x10_2-4_1-circle_6000": (4, 26, 27, 0.6),
    "TypeA_10x5_2-4_3-circle_350": (8, 41, 61, 5.7),
    "TypeB_15x5_2-4_3-circle_550": (8, 43, 51, 3.0),
    "TypeC_20x10_2-4_3-circle_1500": (4, 43, 46, 1.7),
    "TypeB_15x5_T-2_1-circle_3750": (7, 27, 36, 3.8),
}


@dataclass(frozen=True)
class Line:
    """Cohesion (kPa) and friction angle (degrees) with the half-widths of their 95 % intervals."""

    c_kPa: float
    c_half_width_kPa: float
    phi_deg: float
    phi_half_width_deg: float
    slope: float
    covariance: np.ndarray  # (2, 2) of (c, slope), scaled as described in fit_line
    quantile: float  # number of standard errors in a half-width
    r_squared: float
    chi2_reduced: float | None  # None with two points: nothing is left over to judge the scatter by
    phi_through_origin_deg: float

    def band(self, sigma: np.ndarray) -> np.ndarray:
        """Half-width (kPa) of the 95 % band of the line at sigma (kPa)."""
        design = np.column_stack([np.ones_like(sigma), sigma])
        return self.quantile * np.sqrt(np.einsum("ij,jk,ik->i", design, self.covariance, design))


def known_scatter(identity: Mapping[str, Any]) -> str:
    """What is known of how specimens of a run's model differ from one to the next; of the decks' models alone, as they are there."""
    model = identity["model"]
    if model not in _SCATTER or not is_of_the_decks(identity):
        return "How specimens of this model differ is not known; --seeds 8 tells."
    count, least, greatest, deviation = _SCATTER[model]
    return f"{count} packings of this model, with the parameters of the decks, had φ from {least} to {greatest}°, standard deviation {deviation}°."


def student_quantile(freedom: float) -> float:
    """Standard errors in the half-width of an interval of COVERAGE; with infinite freedom those of a normal error."""
    share = (1 + COVERAGE) / 2
    return float(stdtrit(freedom, share) if np.isfinite(freedom) else ndtri(share))


def fit_line(sigma: np.ndarray, tau: np.ndarray, tau_error: np.ndarray) -> Line:
    """Weighted least squares through n >= 2 points (sigma, tau +- tau_error), all in kPa; sigma is exact (the load is).

    With A = [1, sigma] and W = diag(1 / tau_error^2): (c, slope) = (A^T W A)^-1 A^T W tau, phi = atan(slope).
    (A^T W A)^-1 is the covariance propagated from the errors of the peaks. One specimen differs from the next by more
    than its peak's error, and that shows as chi^2 / (n - 2) > 1: the covariance is multiplied by
    max(1, chi^2 / (n - 2)), never shrunk (Birge ratio), and the half-widths are Student's t with n - 2 degrees of
    freedom times the standard errors. Two points leave no degree of freedom: then the propagated errors times 1.96.
    The error of phi is that of the slope times d(atan s)/ds = 1 / (1 + s^2). Errors of less than LEAST_ERROR sigma, as of a stress that
    is always the same, count as that: nothing has an infinite weight.
    """
    tau_error = np.maximum(tau_error, LEAST_ERROR * sigma)
    design = np.column_stack([np.ones_like(sigma), sigma])
    weights = 1 / tau_error**2
    covariance = np.linalg.inv(design.T @ (weights[:, None] * design))
    cohesion, slope = covariance @ design.T @ (weights * tau)
    residuals = tau - cohesion - slope * sigma
    dof = len(sigma) - 2
    chi2_reduced, quantile = None, student_quantile(np.inf)
    if dof > 0:
        chi2_reduced = float(np.sum(weights * residuals**2) / dof)
        covariance = covariance * max(1.0, chi2_reduced)
        quantile = student_quantile(dof)
    total = np.sum(weights * (tau - np.average(tau, weights=weights)) ** 2)
    through_origin = np.sum(weights * sigma * tau) / np.sum(weights * sigma**2)
    return Line(
        c_kPa=float(cohesion),
        c_half_width_kPa=float(quantile * np.sqrt(covariance[0, 0])),
        phi_deg=float(np.degrees(np.arctan(slope))),
        phi_half_width_deg=float(np.degrees(quantile * np.sqrt(covariance[1, 1]) / (1 + slope**2))),
        slope=float(slope),
        covariance=covariance,
        quantile=quantile,
        r_squared=float(1 - np.sum(weights * residuals**2) / total) if total else np.nan,
        chi2_reduced=chi2_reduced,
        phi_through_origin_deg=float(np.degrees(np.arctan(through_origin))),
    )
