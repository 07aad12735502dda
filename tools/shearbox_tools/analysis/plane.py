# SPDX-License-Identifier: GPL-2.0-or-later
"""Stresses on the shear plane, for tables of a shear phase that have them.

The grains between the halves bear the lid and what the sides of the upper half press down besides, less what rests on
flanges of the lower half. Their shear force is all that the upper half and the lid hold, less what flanges bear; those of
smooth sides are flat and bear none, so there it is that of the halves (input/shear.in). Columns plane_kPa and
plane_tau_kPa are these over the full width of the box. An angle of friction by them is not that by the lid.
"""

from dataclasses import dataclass

import numpy as np

from ..reading.readers import Columns
from .peak import Peak, find_peak
from .polynomial import Fit, fit_curve
from .strength import Line, fit_line
from .stress_dilatancy import ultimate

NORMAL, SHEAR = "plane_kPa", "plane_tau_kPa"


@dataclass(frozen=True)
class OnPlane:
    """Normal stress sigma and shear stress tau on the shear plane, kPa, fitted against displacement."""

    sigma: Fit
    tau: Fit
    peak: Peak  # of tau, as that of the stress on the lower half
    at_end: tuple[float, float]  # sigma, tau: means over the ultimate rows

    @property
    def sigma_at_peak(self) -> float:
        """At the peak of tau."""
        return float(self.sigma.series(self.peak.position))

    @property
    def sigma_at_peak_error(self) -> float:
        """Its standard error."""
        return float(self.sigma.error(self.peak.position)[0])


def on_plane(data: Columns, rows: slice) -> OnPlane | None:
    """What the table says of the plane in its rows at full speed, if it has the columns."""
    if NORMAL not in data or SHEAR not in data:
        return None
    sigma, tau = data[NORMAL][rows], data[SHEAR][rows]
    of_sigma, of_tau = (fit_curve(data["displacement_mm"][rows], y) for y in (sigma, tau))
    return OnPlane(of_sigma, of_tau, find_peak(of_tau), (ultimate(sigma)[0], ultimate(tau)[0]))


def line_on_plane(planes: list[OnPlane]) -> Line:
    """Coulomb's line through the peaks of the shear stress at the normal stress on the plane, of at least two.

    Neither is exact here. Each point counts with the effective variance e_tau^2 + (e_sigma tan(phi))^2 (Orear, Am. J.
    Phys. 50 (1982) 912), with tan(phi) from all points together.
    """
    tau, tau_error = np.array([(plane.peak.value, plane.peak.value_error) for plane in planes]).T
    sigma, sigma_error = np.array([(plane.sigma_at_peak, plane.sigma_at_peak_error) for plane in planes]).T
    return fit_line(sigma, tau, np.hypot(tau_error, sigma_error * tau.sum() / sigma.sum()))
