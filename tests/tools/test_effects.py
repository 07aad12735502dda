# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects and their intervals against scipy's tests, least squares, and what they should cover."""

import numpy as np
import pytest
from scipy import stats

from shearbox_tools.ensemble import strength_of_shared
from paper_tools.effects import (
    CONFIRMED,
    CONTRADICTED,
    OPEN,
    Effect,
    common_difference,
    difference,
    mean,
    paired,
    share,
    slope,
)

RNG = np.random.default_rng(5)
FIRST, SECOND = RNG.normal(30, 2, 8), RNG.normal(35, 5, 5)


def test_the_ends_of_an_interval_are_where_a_test_gives_five_percent() -> None:
    welch = difference("", FIRST, SECOND)
    for end in (welch.low, welch.high):
        assert stats.ttest_ind(SECOND - end, FIRST, equal_var=False).pvalue == pytest.approx(0.05)
    pairs = paired("", FIRST[:5], SECOND)
    for end in (pairs.low, pairs.high):
        assert stats.ttest_rel(SECOND - end, FIRST[:5]).pvalue == pytest.approx(0.05)
    one = mean("", FIRST)
    assert stats.ttest_1samp(FIRST, one.low).pvalue == pytest.approx(0.05)
    assert (welch.count, pairs.count, one.count) == (13, 5, 8)
    assert welch.value == pytest.approx(SECOND.mean() - FIRST.mean())


def test_an_angle_has_the_interval_of_its_slope() -> None:
    """As that of the strength of an ensemble without cohesion, whose specimens lie on lines of these angles."""
    sigma = np.array([100.0, 200.0])
    tau = np.tan(np.radians(FIRST))[:, None] * sigma
    found, expected = mean("", FIRST, angles=True), strength_of_shared(sigma, tau).phi_deg
    assert (found.value, found.low, found.high) == pytest.approx((expected.value, expected.low, expected.high))


def test_a_common_difference_is_that_of_least_squares() -> None:
    """y = box + difference x second + scatter: the normal equations with a column for each box."""
    pairs = [(RNG.normal(30 + k, 2, 3 + k), RNG.normal(33 + k, 2, 2 + k)) for k in range(3)]
    y = np.concatenate([np.concatenate(pair) for pair in pairs])
    box = np.concatenate([[k] * (len(a) + len(b)) for k, (a, b) in enumerate(pairs)])
    second = np.concatenate([[0] * len(a) + [1] * len(b) for a, b in pairs])
    design = np.column_stack([second, *(box == k for k in range(3))]).astype(float)
    solution, squares, *_ = np.linalg.lstsq(design, y, rcond=None)
    freedom = len(y) - 4
    error = np.sqrt(squares[0] / freedom * np.linalg.inv(design.T @ design)[0, 0])
    effect = common_difference("", pairs)
    assert effect.value == pytest.approx(solution[0])
    assert effect.high - effect.value == pytest.approx(stats.t.ppf(0.975, freedom) * error)


def test_a_slope_is_zero_where_a_test_gives_five_percent() -> None:
    x = np.repeat([1.0, 2.0, 4.0], 4)
    y = 3 * x + RNG.normal(size=12)
    found = slope("", x, y)
    for end in (found.low, found.high):
        assert stats.linregress(x, y - end * x).pvalue == pytest.approx(0.05)


def test_a_share_has_an_interval_within_0_and_1() -> None:
    """Wilson: where (k/n - p)^2 = z^2 p (1 - p)/n."""
    effect = share("", 7, 8)
    for p in (effect.low, effect.high):
        assert (7 / 8 - p) ** 2 == pytest.approx(stats.norm.ppf(0.975) ** 2 * p * (1 - p) / 8)
    assert share("", 8, 8).high == pytest.approx(1)


def test_few_specimens_tell_nothing() -> None:
    for effect in (
        mean("", FIRST[:1]),
        difference("", FIRST, SECOND[:1]),
        slope("", FIRST[:2], SECOND[:2]),
        share("", 0, 0),
    ):
        assert effect.verdict(1) == effect.verdict(-1) == OPEN


@pytest.mark.parametrize(
    "low, high, sign, limit, verdict",
    [
        (1, 2, 1, 0, CONFIRMED),
        (1, 2, -1, 0, CONTRADICTED),
        (-1, 2, 1, 0, OPEN),
        (1, 2, -1, 3, CONFIRMED),
        (1, 4, 1, 3, OPEN),
    ],
)
def test_verdicts(low: float, high: float, sign: int, limit: float, verdict: str) -> None:
    assert Effect("", 9, (low + high) / 2, low, high).verdict(sign, limit) == verdict


def test_intervals_hold_the_truth_as_often_as_they_say() -> None:
    """Of 2000 experiments 95 %, give or take 3 x 0.5 %."""
    rng, held = np.random.default_rng(1), 0
    for _ in range(2000):
        pairs = [(rng.normal(b, 3, n), rng.normal(b + 1, 3, n)) for b, n in ((30, 8), (33, 4), (28, 2))]
        effect = common_difference("", pairs)
        held += effect.low <= 1 <= effect.high
    assert 0.935 < held / 2000 < 0.965
