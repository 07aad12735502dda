# SPDX-License-Identifier: GPL-2.0-or-later
"""Strength and dilatancy: ultimate stress, dilation angle, and the critical state angle by Rowe and by Bolton.

A direct shear test gives the ratio of stresses on its plane, tau / sigma, while the relations are about the angle phi of
Mohr's circle in plane strain, sin(phi) = (s1 - s3) / (s1 + s3). The plane is one of no extension; if the principal
directions of stress and strain increment coincide (Davis 1968; Rowe 1969), it sees

    tau / sigma = sin(phi) cos(psi) / (1 - sin(phi) sin(psi)),    tan(psi) = rise of the lid / shear.

Rowe (1962): s1/s3 is that of the critical state, phi_cv, times (1 + sin(psi)) / (1 - sin(psi)). Bolton (1986), in plane
strain: phi = phi_cv + 0.8 psi. Where a relation holds, the same phi_cv comes out of the peak and of the end of a test.

E. H. Davis, in: Soil Mechanics: Selected Topics (ed. Lee, 1968) 341; P. W. Rowe, Proc. R. Soc. A 269 (1962) 500 and
Geotechnique 19 (1969) 75; M. D. Bolton, Geotechnique 36 (1986) 65.
"""

from dataclasses import dataclass

import numpy as np

from .polynomial import correlation_length

ULTIMATE_SHARE = 0.2  # of the travel, at its end
CRITICAL_DEG = 1  # dilation angle up to which a state is critical, this project's choice
BOLTON = 0.8


@dataclass(frozen=True)
class Dilatant:
    """A state of shear: ratio = tau / sigma, and the rise of the lid over shear, mm/mm. Angles are in degrees."""

    ratio: float
    rate: float

    @property
    def dilation_deg(self) -> float:
        """psi."""
        return float(np.degrees(np.arctan(self.rate)))

    @property
    def plane_strain_deg(self) -> float | None:
        """phi; None if there is no Mohr's circle for it."""
        psi = np.arctan(self.rate)
        return _arcsin_deg(self.ratio / (np.cos(psi) + self.ratio * np.sin(psi)))

    @property
    def critical_by_rowe_deg(self) -> float | None:
        """phi_cv."""
        phi = self.plane_strain_deg
        if phi is None:
            return None
        ratio = _principal_ratio(phi) / _principal_ratio(self.dilation_deg)
        return _arcsin_deg((ratio - 1) / (ratio + 1))

    @property
    def critical_by_bolton_deg(self) -> float | None:
        """phi_cv."""
        phi = self.plane_strain_deg
        return None if phi is None else phi - BOLTON * self.dilation_deg

    @property
    def is_critical(self) -> bool:
        """Whether it is sheared at constant volume: then psi = 0, and tau / sigma = sin(phi_cv)."""
        return abs(self.dilation_deg) <= CRITICAL_DEG


def rowe_ratio(rate: np.ndarray, critical_deg: float) -> np.ndarray:
    """tau / sigma at rates of dilatancy (mm/mm) by Rowe's relation, with phi_cv in degrees."""
    psi = np.arctan(rate)
    dilation = (1 + np.sin(psi)) / (1 - np.sin(psi))
    ratio = _principal_ratio(critical_deg) * dilation
    sine = (ratio - 1) / (ratio + 1)
    return sine * np.cos(psi) / (1 - sine * np.sin(psi))


def ultimate_rows(rows: int) -> slice:
    """The last fifth of so many rows, at least two."""
    return slice(-max(2, int(ULTIMATE_SHARE * rows)), None)


def ultimate(y: np.ndarray) -> tuple[float, float]:
    """Mean of y (n,) in its ultimate rows, and its standard error s sqrt(2 L / n), L the correlation length."""
    last = y[ultimate_rows(len(y))]
    return float(last.mean()), float(last.std(ddof=1) * np.sqrt(2 * correlation_length(last) / len(last)))


def _principal_ratio(angle: float) -> float:
    """s1/s3 of Mohr's circle."""
    return float((1 + np.sin(np.radians(angle))) / (1 - np.sin(np.radians(angle))))


def _arcsin_deg(sine: float) -> float | None:
    return float(np.degrees(np.arcsin(sine))) if abs(sine) < 1 else None
