# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects over several groups of specimens, such as boxes, with 95 % intervals.

Groups have scatters of their own, since packings differ the less, the larger the box; and what is sought may differ from one group to
the next by more than specimens explain. Then the interval is that over the groups.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

from shearbox_tools.analysis.strength import COVERAGE

from .effects import Effect, effect_of, mean, unknown

DIFFER, BENT = "these differ", "not on a line"  # what labels say where groups are apart


def common_difference(label: str, pairs: Sequence[tuple[np.ndarray, np.ndarray]]) -> Effect:
    """Mean of the second less that of the first, of several boxes together, each with a mean of its own: the differences of the boxes,
    each with the weight that least squares gives it where all specimens scatter alike. Boxes in which a group has a single specimen,
    whose scatter is unknown, count where there is no other.
    """
    pairs = [(a, b) for a, b in pairs if len(a) and len(b)]
    pairs = [(a, b) for a, b in pairs if len(a) > 1 and len(b) > 1] or pairs
    if not pairs:
        return unknown(label)
    parts = [_less(_of(b), _of(a)) for a, b in pairs]
    weights = np.array([1 / (1 / len(a) + 1 / len(b)) for a, b in pairs])
    return _through(label, np.ones((len(pairs), 1)), parts, weights, DIFFER)


def slope(label: str, groups: Sequence[tuple[float, np.ndarray]]) -> Effect:
    """Of a line through groups (x, values): least squares, where all specimens scatter alike. Single specimens, as above."""
    groups = [(x, values) for x, values in groups if len(values)]
    several = [(x, values) for x, values in groups if len(values) > 1]
    groups = several if len({x for x, _ in several}) > 1 else groups
    x = np.array([place for place, _ in groups])
    if len(set(x)) < 2:
        return unknown(label, sum(len(values) for _, values in groups))
    parts, weights = [_of(values) for _, values in groups], np.array([len(values) for _, values in groups])
    return _through(label, np.column_stack([np.ones(len(x)), x]), parts, weights, BENT)


def mean_of_groups(label: str, groups: Sequence[np.ndarray]) -> Effect:
    """Mean of the groups' means. Its error is the larger of two: that by the scatter of the groups' means, and that by the scatter of
    specimens in the groups."""
    groups = [values for values in groups if len(values)]
    if not groups:
        return unknown(label)
    parts = [_of(values) for values in groups]
    of_groups = mean(label, np.array([part.value for part in parts]))
    weights = np.full(len(parts), 1 / len(parts))
    of_specimens = _sum(label, parts, weights)
    return max((replace(of_groups, count=of_specimens.count), of_specimens), key=_width)


@dataclass(frozen=True)
class _Part:
    """A number with the variance that the scatter of specimens gives it, and the freedom of that; both 0 of one specimen."""

    count: int
    value: float
    variance: float
    freedom: float


def _of(values: np.ndarray) -> _Part:
    n = len(values)
    return _Part(n, float(np.mean(values)), float(np.var(values, ddof=1)) / n if n > 1 else 0.0, n - 1)


def _less(one: _Part, other: _Part) -> _Part:
    both = [one, other]
    return _Part(one.count + other.count, one.value - other.value, one.variance + other.variance, _freedom(both))


def _freedom(parts: Sequence[_Part], weights: Sequence[float] | np.ndarray = (1, 1)) -> float:
    """Of the variance of a sum of independent parts, each with a weight: Satterthwaite (Biometrics Bull. 2 (1946) 110)."""
    if any(part.freedom == 0 for part in parts):
        return 0
    terms = [weight**2 * part.variance for weight, part in zip(weights, parts)]
    squares = sum(term**2 / part.freedom for term, part in zip(terms, parts))
    return sum(terms) ** 2 / squares if squares else np.inf


def _sum(label: str, parts: Sequence[_Part], weights: np.ndarray) -> Effect:
    """Of parts with weights, with the error that specimens give it, each part with a scatter of its own."""
    variance = sum(weight**2 * part.variance for weight, part in zip(weights, parts))
    value = float(np.dot(weights, [part.value for part in parts]))
    return effect_of(label, sum(p.count for p in parts), value, np.sqrt(variance), _freedom(parts, weights))


def _through(label: str, design: np.ndarray, parts: Sequence[_Part], weights: np.ndarray, apart: str) -> Effect:
    """The last coefficient of a fit to parts, (parts, coefficients), by weighted least squares.

    Its error is that of specimens. Where the parts are further from a fit than their specimens explain, it is that of the parts around
    it, if that is larger, and the label says so (`apart`): what is true of the boxes here need not be of others. Two parts tell no scatter: then the interval is from
    the lower end of theirs to the upper one.
    """
    covariance, solve = _solution(design, weights)
    of_specimens = _sum(label, parts, solve[-1])
    if not _are_apart(design, parts):
        return of_specimens
    label = f"{label}; {apart}"
    if len(parts) == 2:
        own = [effect_of(label, part.count, part.value, np.sqrt(part.variance), part.freedom) for part in parts]
        return replace(of_specimens, label=label, low=min(e.low for e in own), high=max(e.high for e in own))
    values = np.array([part.value for part in parts])
    squares = np.sum(weights * (values - design @ (solve @ values)) ** 2)
    freedom = len(parts) - design.shape[1]
    error = np.sqrt(squares / freedom * covariance[-1, -1])
    of_parts = effect_of(label, of_specimens.count, of_specimens.value, error, freedom)
    return max(of_parts, replace(of_specimens, label=label), key=_width)


def _solution(design: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of weighted least squares: the inverse of the normal equations, and what the coefficients are of the values."""
    inverse = np.linalg.inv(design.T @ (weights[:, None] * design))
    return inverse, inverse @ (design.T * weights)


def _are_apart(design: np.ndarray, parts: Sequence[_Part]) -> bool:
    """Whether no fit goes through all parts, at 5 %: Johansen (Biometrika 67 (1980) 85), for one coefficient Welch's analysis of variance."""
    values, variances, freedoms = np.array([(part.value, part.variance, part.freedom) for part in parts]).T
    q = len(parts) - design.shape[1]
    if q < 1 or not (np.all(variances) and np.all(freedoms)):
        return False
    _, solve = _solution(design, 1 / variances)
    away = values - design @ (solve @ values)
    a = np.sum((1 - np.diag(design @ solve)) ** 2 / freedoms)
    statistic = np.sum(away**2 / variances) / (q + 2 * a * (q - 1) / (q + 2))
    return bool(statistic > stats.f.ppf(COVERAGE, q, q * (q + 2) / (3 * a)))


def _width(effect: Effect) -> float:
    width = effect.high - effect.low
    return width if np.isfinite(width) else -1
