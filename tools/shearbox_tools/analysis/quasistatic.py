# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a shear phase is quasi-static: so slow that its stresses do not depend on how fast it is.

Two numbers say so. The inertial number of dry grains in two dimensions (da Cruz, Emam, Prochnow, Roux and Chevoir,
Phys. Rev. E 72 (2005) 021309; in three, GDR MiDi, Eur. Phys. J. E 14 (2004) 341),

    I = rate sqrt(m / P)

with the mean mass m of a grain and the normal force P on a length, is the time in which P pushes a grain into a gap,
over that in which shear opens one; up to 1e-3 a flow is quasi-static. With thickness t, density rho and mean area A of
a grain m = rho t A, and P = sigma t: I = rate sqrt(rho A / sigma). Shear localises: the rate is the speed over a band
of 10 mean diameters d = sqrt(4 A / pi) (8 to 16 were seen: Muehlhaus and Vardoulakis, Geotechnique 37 (1987) 271), or
over the specimen's height if that is less.

And the stress on the lower half equals that on the upper one unless grains are being accelerated.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.verdict import Verdict, told_apart

BAND = 10  # mean diameters
LARGEST_INERTIAL_NUMBER = 1e-3
LARGEST_IMBALANCE_PERCENT = 5  # this project's choice


@dataclass(frozen=True)
class Inertia:
    """How far a shear phase is from being quasi-static; None: cannot be known."""

    number: float | None  # I
    imbalance_percent: float | None  # root mean square difference of the halves' stresses over that of their mean

    @property
    def quasi_static(self) -> Verdict:
        """Whether what is known is within its limits."""
        judged, numbers = [], []
        if self.number is not None:
            share = self.number / LARGEST_INERTIAL_NUMBER
            judged.append(share <= 1)
            numbers.append(f"inertial number {told_apart(share, 1, 2)}e-3 (≤ 1e-3)")
        if self.imbalance_percent is not None and np.isfinite(self.imbalance_percent):
            judged.append(self.imbalance_percent <= LARGEST_IMBALANCE_PERCENT)
            percent = told_apart(self.imbalance_percent, LARGEST_IMBALANCE_PERCENT, 1)
            numbers.append(f"τ of the halves differs by {percent} % (≤ {LARGEST_IMBALANCE_PERCENT} %)")
        return Verdict(all(judged) if judged else None, ", ".join(numbers) or "neither density nor both stresses known")


def greatest(of: Sequence[Inertia]) -> Inertia:
    """The greatest of each number, among those that are known."""
    numbers = [one.number for one in of if one.number is not None]
    imbalances = [p for one in of if (p := one.imbalance_percent) is not None and np.isfinite(p)]
    return Inertia(max(numbers, default=None), max(imbalances, default=None))


def inertial_number(speed: float, sigma: float, area: float, density: float, height: float) -> float:
    """I of shear at speed (m/s) under sigma (Pa) of grains of mean area (m^2), density (kg/m^3), `height` (m) high."""
    rate = speed / min(BAND * np.sqrt(4 * area / np.pi), height)
    return float(rate * np.sqrt(density * area / sigma))


def imbalance_percent(lower: np.ndarray, upper: np.ndarray) -> float:
    """Root mean square of the difference of the halves' shear stresses, in percent of that of their mean; nan if that is 0."""
    square = np.mean(((lower + upper) / 2) ** 2)
    return float(100 * np.sqrt(np.mean((lower - upper) ** 2) / square)) if square else np.nan
