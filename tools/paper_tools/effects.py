# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects with 95 % intervals, and what they say of a claim.

Specimens with packings of their own are independent samples; an effect is a mean over them, a difference of two
(shearbox_tools/analysis/differences.py), a share, or one over several groups (over_groups.py). What is told of the same packings, sheared in
different ways, is told packing by packing.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from shearbox_tools.analysis import differences
from shearbox_tools.analysis.strength import COVERAGE

CONFIRMED, CONTRADICTED, OPEN = "confirmed", "contradicted", "open"


@dataclass(frozen=True)
class Effect:
    """A value with its interval; nan where it cannot be told. `count` is the number of specimens."""

    label: str
    count: int
    value: float
    low: float
    high: float

    def verdict(self, sign: int, limit: float = 0.0) -> str:
        """Whether the value is above (sign 1) or below (sign -1) a limit: as the whole interval is."""
        low, high = sorted((sign * (self.low - limit), sign * (self.high - limit)))
        if not np.isfinite(low + high):
            return OPEN
        return CONFIRMED if low > 0 else CONTRADICTED if high < 0 else OPEN


def unknown(label: str, count: int = 0) -> Effect:
    """That of too few specimens."""
    return Effect(label, count, np.nan, np.nan, np.nan)


def mean(label: str, values: np.ndarray, angles: bool = False) -> Effect:
    """Over specimens (n,); of angles (degrees) that of their slopes, as in reports on ensembles."""
    if not len(values):
        return unknown(label)
    if angles:
        return _known(label, len(values), differences.mean_angle(np.tan(np.radians(values))))
    return _known(label, len(values), differences.mean(values))


def difference(label: str, first: np.ndarray, second: np.ndarray) -> Effect:
    """Mean of the second less that of the first."""
    if not (len(first) and len(second)):
        return unknown(label, len(first) + len(second))
    means = differences.mean(first), differences.mean(second)
    return _known(label, len(first) + len(second), differences.difference(*means, paired=False))


def paired(label: str, first: np.ndarray, second: np.ndarray) -> Effect:
    """The same of specimens that belong together, in order."""
    means = differences.mean(first), differences.mean(second)
    return _known(label, len(first), differences.difference(*means, paired=True))


def slope_of_each(label: str, lines: Sequence[tuple[np.ndarray, np.ndarray]]) -> Effect:
    """Mean of the slopes of lines (x, y), one through each packing: what packings differ by is not in it. Three points make a line."""
    slopes = [stats.linregress(x, y).slope for x, y in lines if len(x) > 2 and np.ptp(x) > 0]
    return mean(label, np.array(slopes))


def share(label: str, holds: int, judged: int) -> Effect:
    """Of specimens, with Wilson's interval (J. Am. Stat. Assoc. 22 (1927) 209)."""
    if not judged:
        return unknown(label)
    interval = stats.binomtest(holds, judged).proportion_ci(COVERAGE, "wilson")
    return Effect(label, judged, holds / judged, float(interval.low), float(interval.high))


def _known(label: str, count: int, of: differences.Mean | differences.Difference) -> Effect:
    low, high = (np.nan if end is None else end for end in (of.low, of.high))
    return Effect(label, count, of.value, low, high)


def effect_of(label: str, count: int, value: float, error: float, freedom: float) -> Effect:
    """With a standard error of so many degrees of freedom; no interval without any."""
    half = float(stats.t.ppf((1 + COVERAGE) / 2, freedom) * error) if freedom > 0 else np.nan
    return Effect(label, count, value, value - half, value + half)
