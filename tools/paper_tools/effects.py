# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects with 95 % intervals, and what they say of a claim.

Specimens are independent samples; an effect is a mean over specimens, a difference of two (shearbox_tools/differences.py), one that
is the same in several boxes, each with a mean of its own, by least squares with one variance for all, a slope, or a share.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from shearbox_tools import differences
from shearbox_tools.strength import COVERAGE

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


def common_difference(label: str, pairs: Sequence[tuple[np.ndarray, np.ndarray]]) -> Effect:
    """Of several pairs of groups, the difference that is the same in all: value = box + difference + scatter. Pairs of which one has no
    specimens tell nothing."""
    pairs = [(a, b) for a, b in pairs if len(a) and len(b)]
    if not pairs:
        return unknown(label)
    weights = np.array([1 / (1 / len(a) + 1 / len(b)) for a, b in pairs])
    values = np.array([np.mean(b) - np.mean(a) for a, b in pairs])
    groups = [group for pair in pairs for group in pair]
    count, spread = sum(map(len, groups)), sum(float(np.sum((g - np.mean(g)) ** 2)) for g in groups)
    # an additive model has one mean a box and one difference; what boxes differ in it is scatter, too
    value = float(np.average(values, weights=weights))
    spread += float(np.sum(weights * (values - value) ** 2))
    freedom = count - len(pairs) - 1
    error = np.sqrt(spread / freedom / weights.sum()) if freedom > 0 else np.nan
    return _effect(label, count, value, error, freedom)


def slope(label: str, x: np.ndarray, y: np.ndarray) -> Effect:
    """Of y over x, a specimen each."""
    if len(x) < 3 or np.ptp(x) == 0:
        return unknown(label, len(x))
    line = stats.linregress(x, y)
    return _effect(label, len(x), float(line.slope), float(line.stderr), len(x) - 2)


def share(label: str, holds: int, judged: int) -> Effect:
    """Of specimens, with Wilson's interval (J. Am. Stat. Assoc. 22 (1927) 209)."""
    if not judged:
        return unknown(label)
    interval = stats.binomtest(holds, judged).proportion_ci(COVERAGE, "wilson")
    return Effect(label, judged, holds / judged, float(interval.low), float(interval.high))


def _known(label: str, count: int, of: differences.Mean | differences.Difference) -> Effect:
    low, high = (np.nan if end is None else end for end in (of.low, of.high))
    return Effect(label, count, of.value, low, high)


def _effect(label: str, count: int, value: float, error: float, freedom: float) -> Effect:
    half = float(stats.t.ppf((1 + COVERAGE) / 2, freedom) * error) if freedom > 0 else np.nan
    return Effect(label, count, value, value - half, value + half)
