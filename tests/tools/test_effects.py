# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects and their intervals against scipy's tests, least squares, and what they should cover."""

import numpy as np
import pytest
from scipy import stats

from shearbox_tools.analysis.ensemble import strength_of_shared
from paper_tools.effects import (
    CONFIRMED,
    CONTRADICTED,
    OPEN,
    Effect,
    difference,
    mean,
    paired,
    share,
    slope_of_each,
)

from paper_tools.over_groups import common_difference, mean_of_groups, slope

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


def test_of_one_box_a_common_difference_is_the_difference() -> None:
    one, other = common_difference("", [(FIRST, SECOND)]), difference("", FIRST, SECOND)
    assert vars(one) == pytest.approx(vars(other))
    line = slope("", [(1.0, FIRST), (3.0, SECOND)])
    assert (2 * line.value, 2 * line.low, 2 * line.high) == pytest.approx((other.value, other.low, other.high))


def test_a_common_difference_is_that_of_least_squares() -> None:
    """y = box + difference x second + scatter: the normal equations with a column for each box. Its error is that of a sum of means, each
    with a variance of its own."""
    pairs = [(RNG.normal(30 + k, 2, 3 + k), RNG.normal(33 + k, 2, 2 + k)) for k in range(3)]
    y = np.concatenate([np.concatenate(pair) for pair in pairs])
    box = np.concatenate([[k] * (len(a) + len(b)) for k, (a, b) in enumerate(pairs)])
    second = np.concatenate([[0] * len(a) + [1] * len(b) for a, b in pairs])
    design = np.column_stack([second, *(box == k for k in range(3))]).astype(float)
    by_value = np.linalg.pinv(design)[0]  # the solution as a sum over the values
    effect = common_difference("", pairs)
    assert effect.value == pytest.approx(by_value @ y)
    variance = sum(
        np.sum(by_value[part] ** 2) * np.var(y[part], ddof=1)
        for part in ((box == k) & (second == m) for k in range(3) for m in range(2))
    )
    half = effect.high - effect.value
    assert half / np.sqrt(variance) > stats.t.ppf(0.975, len(y) - 6)  # fewer freedoms than of one variance for all
    assert half / np.sqrt(variance) < stats.t.ppf(0.975, 1)


def test_where_boxes_differ_the_interval_is_that_of_boxes() -> None:
    """Differences of 1, 5 and 9 with hardly any scatter: their mean is 5, by a t test of three numbers."""
    pairs = [(np.array([0.0, 0.01]), np.array([of, of + 0.01])) for of in (1, 5, 9)]
    effect = common_difference("box", pairs)
    expected = stats.ttest_1samp([1, 5, 9], 0).confidence_interval(0.95)
    assert (effect.low, effect.high) == pytest.approx(tuple(expected))
    assert effect.label == "box; these differ"
    bent = slope("", [(x, np.array([x * x, x * x + 0.01])) for x in (0.0, 1.0, 2.0, 3.0)])
    line = stats.linregress([0, 1, 2, 3], [0, 1, 4, 9])
    assert bent.high - bent.value == pytest.approx(stats.t.ppf(0.975, 2) * line.stderr)
    assert bent.label == "; not on a line"


@pytest.mark.filterwarnings("error")
def test_single_specimens_count_where_there_is_no_other() -> None:
    assert slope("", [(1.0, np.array([1.0, 2.0])), (2.0, np.array([3.0])), (3.0, np.array([4.0]))]).count == 4
    found = common_difference("", [(np.array([0.0]), np.array([1.0, y])) for y in (4.0, 5.0, 5.0)])
    assert found.count == 9 and not np.isfinite(found.low)


def test_where_two_boxes_differ_the_interval_holds_that_of_either() -> None:
    pairs = [(RNG.normal(0, 1, 6), RNG.normal(of, 1, 6)) for of in (5, 50)]
    found, low, high = common_difference("", pairs), *(difference("", *pair) for pair in pairs)
    assert (found.low, found.high) == pytest.approx((low.low, high.high))
    assert low.value < found.value < high.value and found.label == "; these differ"


def test_the_mean_of_groups_has_the_larger_error() -> None:
    apart = [np.array([of, of + 0.01]) for of in (1.0, 5.0, 9.0)]
    interval = stats.ttest_1samp([group.mean() for group in apart], 0).confidence_interval(0.95)
    found = mean_of_groups("", apart)
    assert (found.low, found.high, found.count) == pytest.approx((*interval, 6))
    alike = [np.array([1.0, 3.0, 5.0]), np.array([2.0, 3.001, 4.0])]  # means closer together than chance has them
    found = mean_of_groups("", alike)
    error = np.hypot(*(group.std(ddof=1) / np.sqrt(3) / 2 for group in alike))
    assert stats.t.ppf(0.975, 4) * error < found.high - found.value < stats.t.ppf(0.975, 2) * error
    assert vars(mean_of_groups("", [FIRST])) == pytest.approx(vars(mean("", FIRST)))


def test_slopes_of_the_same_packings_are_a_sample() -> None:
    """However much packings differ: their slopes are 1, 2 and 3."""
    x = np.array([0.0, 1.0, 2.0])
    found = slope_of_each("", [(x, 100 * k + k * x) for k in (1, 2, 3)] + [(x[:2], x[:2])])
    expected = stats.ttest_1samp([1, 2, 3], 0).confidence_interval(0.95)
    assert (found.value, found.low, found.high, found.count) == pytest.approx((2, *expected, 3))


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
        slope("", [(1.0, FIRST[:1]), (2.0, SECOND[:1])]),
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


@pytest.mark.parametrize("effect", ["difference", "slope"])
def test_intervals_hold_the_truth_as_often_as_they_say(effect: str) -> None:
    """Of 2000 experiments 95 %, give or take 3 x 0.5 %, and up to 1.5 % more where a single box has most of the scatter: boxes with the
    scatter and the packings that the study has. As many as should, 5 %, are said to differ though they do not."""
    rng, held, differ = np.random.default_rng(1), 0, 0
    for _ in range(2000):
        groups = [(x, rng.normal(x, s, n)) for x, s, n in ((0, 5.0, 8), (1, 1.6, 8), (2, 0.4, 4), (3, 1.0, 4))]
        if effect == "slope":
            found = slope("", groups)
        else:
            found = common_difference("", [(of, rng.normal(x + 1, 2, len(of))) for x, of in groups])
        held += found.low <= 1 <= found.high
        differ += found.label != ""
    assert 0.935 < held / 2000 < 0.98
    assert 0.035 < differ / 2000 < 0.065
