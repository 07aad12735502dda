# SPDX-License-Identifier: GPL-2.0-or-later
"""Normal stress on the shear plane, for tables of a shear phase that have it.

The grains between the halves bear the lid and what the sides of the upper half press down besides, less what rests on
flanges of the lower half (input/shear.in): column plane_kPa, over the full width of the box. It is never quite the
stress of the lid, and an angle of friction by the one is not that by the other.
"""

from dataclasses import dataclass

import numpy as np

from .peak import Peak
from .polynomial import Fit, fit_curve
from .readers import Columns
from .stress_dilatancy import ultimate
from .strength import Line, fit_line

COLUMN = "plane_kPa"


@dataclass(frozen=True)
class OnPlane:
    """Normal stress on the shear plane, kPa."""

    fit: Fit  # against displacement, as that of the shear stress
    at_peak: float  # of the shear stress
    at_peak_error: float  # standard error
    at_end: float  # mean over the ultimate rows


def on_plane(data: Columns, rows: slice, peak: Peak) -> OnPlane | None:
    """What the table says of the plane in its rows at full speed, if it has the column."""
    if COLUMN not in data:
        return None
    sigma = data[COLUMN][rows]
    fit = fit_curve(data["displacement_mm"][rows], sigma)
    return OnPlane(fit, float(fit.series(peak.position)), float(fit.error(peak.position)[0]), ultimate(sigma)[0])


def line_on_plane(peaks: list[Peak], planes: list[OnPlane]) -> Line:
    """Coulomb's line through the peaks of the shear stress at the normal stress on the plane, of at least two.

    Neither is exact here. Each point counts with the effective variance e_tau^2 + (e_sigma tan(phi))^2 (Orear, Am. J.
    Phys. 50 (1982) 912), with tan(phi) from all points together.
    """
    tau, tau_error = np.array([(peak.value, peak.value_error) for peak in peaks]).T
    sigma, sigma_error = np.array([(plane.at_peak, plane.at_peak_error) for plane in planes]).T
    return fit_line(sigma, tau, np.hypot(tau_error, sigma_error * tau.sum() / sigma.sum()))
