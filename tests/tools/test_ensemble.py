# SPDX-License-Identifier: GPL-2.0-or-later
"""Intervals of ensembles hold the truth as often as they say, on peaks made by the model with specimens that differ."""

import numpy as np
import pytest
from scipy import stats

from shearbox_tools.analysis.ensemble import EnsembleStrength, mean_of, strength_of_independent, strength_of_shared

SIGMA = np.array([100.0, 200, 300, 400])
TRIALS = 1000
C_KPA, PHI_DEG, SCATTER_DEG, NOISE = 8.0, 33.0, 3.0, 0.03
ANGLES = PHI_DEG + SCATTER_DEG * stats.norm.ppf((np.arange(1000) + 0.5) / 1000)
TRUE_PHI = float(
    np.degrees(np.arctan(np.mean(np.tan(np.radians(ANGLES)))))
)  # the estimates are of the mean of tan(phi)


def peaks(specimens: int, shared: bool, seed: int) -> np.ndarray:
    """(TRIALS, specimens, stresses): an angle for each specimen, or for each peak, and noise in proportion to sigma."""
    rng = np.random.default_rng(seed)
    phi = PHI_DEG + SCATTER_DEG * rng.normal(size=(TRIALS, specimens, 1 if shared else len(SIGMA)))
    return C_KPA + SIGMA * (np.tan(np.radians(phi)) + NOISE * rng.normal(size=(TRIALS, specimens, len(SIGMA))))


def share_that_holds(strength: EnsembleStrength) -> tuple[float, float]:
    """Of the intervals of phi and c, those that hold the truth."""
    pairs = ((strength.phi_deg, TRUE_PHI), (strength.c_kPa, C_KPA))
    phi, c = (float(np.mean((e.low <= truth) & (truth <= e.high))) for e, truth in pairs)
    return phi, c


@pytest.mark.parametrize("specimens", [3, 5, 8])
def test_intervals_of_shared_packings_hold_the_truth_in_95_of_100(specimens: int) -> None:
    """93 to 97 %: three standard deviations of the share in a thousand trials."""
    phi, c = share_that_holds(strength_of_shared(SIGMA, peaks(specimens, True, seed=specimens)))
    assert 0.93 <= phi <= 0.97 and 0.93 <= c <= 0.97, (phi, c)


@pytest.mark.parametrize("specimens", [3, 5, 8])
def test_intervals_of_independent_packings_hold_the_truth_in_95_of_100(specimens: int) -> None:
    tau = peaks(specimens, False, seed=specimens).reshape(TRIALS, -1)
    phi, c = share_that_holds(strength_of_independent(np.tile(SIGMA, specimens), tau))
    assert 0.93 <= phi <= 0.97 and 0.93 <= c <= 0.97, (phi, c)


def test_points_that_share_a_packing_are_not_independent() -> None:
    """What the model is for: a line through all points of five packings promises too much of phi and too little of c."""
    tau = peaks(5, True, seed=1).reshape(TRIALS, -1)
    phi, c = share_that_holds(strength_of_independent(np.tile(SIGMA, 5), tau))
    assert phi < 0.93 and c > 0.97, (phi, c)


def test_each_specimen_may_have_stresses_of_its_own() -> None:
    """As those on the shear plane are: lines of its own slope and cohesion are found, and their means."""
    slopes, cohesions = np.array([0.5, 0.6, 0.8]), np.array([1.0, 5.0, 9.0])
    sigma = SIGMA * np.array([[1.0, 1.1, 0.9, 1.0], [1.2, 1.1, 1.0, 0.9], [1.0, 1.0, 1.3, 1.1]])
    found = strength_of_shared(sigma, cohesions[:, None] + slopes[:, None] * sigma)
    assert np.tan(np.radians(found.phi_deg.value)) == pytest.approx(slopes.mean())
    assert found.c_kPa.value == pytest.approx(cohesions.mean())
    assert found.c_kPa.deviation == pytest.approx(cohesions.std(ddof=1))


def test_a_line_through_independent_points_is_that_of_scipy() -> None:
    sigma, tau = np.tile(SIGMA, 3), peaks(3, False, seed=4)[0].ravel()
    line = stats.linregress(1 / sigma, tau / sigma)
    found = strength_of_independent(sigma, tau)
    quantile = stats.t.ppf(0.975, 10)
    assert found.c_kPa.value == pytest.approx(line.slope)
    assert found.c_kPa.high - found.c_kPa.value == pytest.approx(quantile * line.stderr)
    ends = np.degrees(np.arctan(line.intercept + np.array([-1, 1]) * quantile * line.intercept_stderr))
    assert [found.phi_deg.low, found.phi_deg.high] == pytest.approx(ends)


def test_the_scatter_of_specimens_is_told() -> None:
    """sd of phi: the specimens' own and that of a fitted tan(phi), NOISE |row of the pseudo-inverse|, times dphi/dtan."""
    row = np.linalg.pinv(np.column_stack([np.ones(4), 1 / SIGMA]))[0]
    expected = np.hypot(SCATTER_DEG, np.degrees(NOISE * np.linalg.norm(row)) * np.cos(np.radians(PHI_DEG)) ** 2)
    deviation = strength_of_shared(SIGMA, peaks(8, True, seed=2)).phi_deg.deviation
    assert deviation is not None
    assert np.sqrt(np.mean(deviation**2)) == pytest.approx(expected, rel=0.03)


def test_exact_lines_have_no_width() -> None:
    tau = 12 + SIGMA * np.tan(np.radians(31))
    found = (strength_of_shared(SIGMA, np.tile(tau, (3, 1))), strength_of_independent(SIGMA, tau))
    for strength in found:
        for estimate, truth in ((strength.phi_deg, 31), (strength.c_kPa, 12)):
            assert [estimate.value, estimate.low, estimate.high] == pytest.approx([truth] * 3, abs=1e-9)


def test_a_mean_has_the_interval_of_scipy() -> None:
    values = np.array([33.2, 35.6, 36.7, 31.9, 29.4])
    mean = mean_of(values)
    expected = stats.ttest_1samp(values, 0).confidence_interval(0.95)
    assert (mean.low, mean.high) == pytest.approx((expected.low, expected.high))
    assert mean.deviation == pytest.approx(2.92, abs=0.005)


def test_too_little_is_refused() -> None:
    with pytest.raises(ValueError, match="1 specimens: at least 2"):
        strength_of_shared(SIGMA, peaks(1, True, 1))
    with pytest.raises(ValueError, match="1 stresses: at least 2"):
        strength_of_shared(SIGMA[:1], np.ones((3, 1)))
    with pytest.raises(ValueError, match="1 stresses: at least 2"):
        strength_of_independent(np.full(5, 100.0), np.ones(5))
    with pytest.raises(ValueError, match="2 peaks: at least 3"):
        strength_of_independent(SIGMA[:2], np.ones(2))
