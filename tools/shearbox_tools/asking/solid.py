# SPDX-License-Identifier: GPL-2.0-or-later
"""How dense grains will lie when pack.in has packed them: a fit to what it has packed (tests/validation/packing)."""

import math
from dataclasses import dataclass

import numpy as np

from .grains import area_over_largest

SIZES = {"single": 1.0, "triple": 1 + 2 / math.sqrt(3)}  # of a grain, over that of its largest disc

# Solid fraction far from walls, of single discs with n(d) ~ d^-3 and of grains of three discs of uniform sizes, by the friction
# angle with which they are packed (degrees) and by greatest over least diameter. Equal discs crystallise without friction.
FRICTIONS = (0.0, 10.0, 45.0)
RATIOS = (1.0, 1.25, 1.5, 2.0, 3.0, 4.0)
FAR_FROM_WALLS = {
    "single": (
        (0.895, 0.848, 0.844, 0.844, 0.853, 0.855),
        (0.847, 0.837, 0.8275, 0.826, 0.830, 0.832),
        (0.829, 0.826, 0.8175, 0.815, 0.818, 0.820),
    ),
    "triple": (
        (0.831, 0.826, 0.822, 0.822, 0.824, 0.826),
        (0.794, 0.791, 0.788, 0.780, 0.780, 0.780),
        (0.735, 0.735, 0.734, 0.733, 0.733, 0.733),
    ),
}
LAYER = {"single": 0.12, "triple": 0.08}  # along walls, as if one so thick, over the mean size of a grain, were empty


@dataclass(frozen=True)
class Grading:
    """Sizes of grains: diameters of their largest discs (m), number density n(d) ~ d^power."""

    dmin: float
    dmax: float
    power: float

    def diameters(self, count: int) -> np.ndarray:
        """(count,) of so many grains, as src/core/fill.h draws them."""
        shares = (np.arange(count) + 0.5) / count
        p, ratio = self.power + 1, self.dmax / self.dmin
        return self.dmin * (ratio ** shares if abs(p) < 1e-12 else (1 + shares * (ratio**p - 1)) ** (1 / p))


def solid_fraction(shape: str, grading: Grading, width: float, height: float, friction: float) -> float:
    """Of a box of that width and height (m), packed with that friction angle (degrees); greater ones make little difference."""
    at_friction = [np.interp(grading.dmax / grading.dmin, RATIOS, row) for row in FAR_FROM_WALLS[shape]]
    size = SIZES[shape] * np.mean(grading.diameters(1000))
    walls = 1 - 2 * LAYER[shape] * size * (1 / width + 1 / height)
    return float(walls * np.interp(friction, FRICTIONS, at_friction))


def filling(shape: str, grading: Grading, width: float, height: float, friction: float) -> int:
    """How many grains fill the box."""
    area = area_over_largest(shape) * np.mean(grading.diameters(1000) ** 2)
    return round(solid_fraction(shape, grading, width, height, friction) * width * height / area)
