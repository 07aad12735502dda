# SPDX-License-Identifier: GPL-2.0-or-later
"""The fitted curve and its peak against curves whose peak is known."""

import numpy as np
import pytest
from numpy.polynomial.polyutils import mapdomain
from synthetic import correlated_noise, softening

from shearbox_tools.analysis.peak import find_peak, maxima
from shearbox_tools.analysis.polynomial import DEGREES, block_averages, correlation_length, end_zone, fit_curve

TRAVEL = 8.0
ROWS = 800


def displacement() -> np.ndarray:
    return (np.arange(ROWS) + 0.5) * TRAVEL / ROWS


@pytest.mark.parametrize("degree", DEGREES)
def test_exact_polynomial_is_found_with_its_degree(degree: int) -> None:
    s = displacement()
    truth = np.polynomial.Chebyshev.basis(degree, domain=[0, TRAVEL])
    fit = fit_curve(s, truth(s) + 1e-3 * np.random.default_rng(degree).normal(size=ROWS))
    assert fit.degree == degree
    assert np.max(np.abs(fit.series(s) - truth(s))) < 1e-3


def test_peak_of_a_parabola_is_exact() -> None:
    s = displacement()
    peak = find_peak(fit_curve(s, 80 - 3 * (s - 3.25) ** 2))
    assert peak.value == pytest.approx(80, abs=1e-6)
    assert peak.position == pytest.approx(3.25, abs=1e-6)
    assert not peak.at_boundary


@pytest.mark.parametrize("at", [1.2, 2.5, 4.0])
def test_peak_of_a_noisy_softening_curve(at: float) -> None:
    s = displacement()
    deviations, errors = [], []
    for seed in range(12):
        noise = correlated_noise(np.random.default_rng(seed), ROWS, 4, 8)
        peak = find_peak(fit_curve(s, softening(s, 80, at, 60) + noise))
        deviations.append(peak.value - 80)
        errors.append(peak.value_error)
    assert abs(np.mean(deviations)) < 2.0  # 2.5 % of the peak with noise of 5 %
    assert np.max(np.abs(deviations)) < 6.0
    assert 0.4 < np.mean(errors) < 4.0


def test_uncertainty_grows_with_the_noise() -> None:
    s = displacement()
    noise = correlated_noise(np.random.default_rng(5), ROWS, 1, 8)
    quiet, loud = (find_peak(fit_curve(s, softening(s, 80, 2.5, 60) + k * noise)) for k in (2, 8))
    assert loud.value_error > 2 * quiet.value_error


def test_rising_curve_has_its_peak_at_the_boundary() -> None:
    s = displacement()
    noise = correlated_noise(np.random.default_rng(2), ROWS, 1, 8)
    peak = find_peak(fit_curve(s, 10 * s + noise))
    assert peak.at_boundary
    assert peak.position == pytest.approx(s[-1])


def test_a_curve_that_falls_from_the_start_has_its_peak_there() -> None:
    """However it goes up and down later on: the first place where the polynomial is held."""
    s = displacement()
    truth = 30 + 40 * np.exp(-s / 1.5) + 8 * np.exp(-((s - 5.5) ** 2) / 2)
    for seed in range(5):
        peak = find_peak(fit_curve(s, truth + correlated_noise(np.random.default_rng(seed), ROWS, 1, 8)))
        assert peak.at_boundary and peak.falls
        assert peak.position == pytest.approx(end_zone(s[-1]))
        assert peak.value == pytest.approx(np.interp(peak.position, s, truth), rel=0.05)


@pytest.mark.parametrize("end, at_boundary", [(8, True), (-2, False)])
def test_the_end_counts_only_if_it_is_higher(end: int, at_boundary: bool) -> None:
    s = displacement()
    bump = 20 * np.sin(2 * np.pi * s / 6.5) + end * s
    peak = find_peak(fit_curve(s, bump + correlated_noise(np.random.default_rng(6), ROWS, 1, 8)))
    assert peak.at_boundary == at_boundary
    assert peak.position == pytest.approx(s[-1] if at_boundary else 1.53, abs=0.3)


def test_a_curve_that_is_nothing() -> None:
    """As of a lid that is held."""
    fit = fit_curve(displacement(), np.zeros(ROWS))
    assert np.all(fit.series(displacement()) == 0)
    assert find_peak(fit).value == 0


def test_same_data_same_result() -> None:
    s = displacement()
    y = softening(s, 80, 2.5, 60) + correlated_noise(np.random.default_rng(1), ROWS, 4, 8)
    assert find_peak(fit_curve(s, y)) == find_peak(fit_curve(s, y))


def test_too_few_rows_are_refused() -> None:
    with pytest.raises(ValueError, match="5 rows are too few"):
        fit_curve(np.arange(5.0), np.arange(5.0))


@pytest.mark.parametrize("length, tolerance", [(1, 0.2), (10, 3)])
def test_correlation_length_of_autoregressive_noise(length: int, tolerance: float) -> None:
    noise = correlated_noise(np.random.default_rng(3), 20000, 1, length)
    factor = np.exp(-1 / length)
    assert correlation_length(noise) == pytest.approx((1 + factor) / (1 - factor) / 2, abs=tolerance)


def test_correlation_length_of_white_noise_and_of_nothing() -> None:
    assert correlation_length(np.random.default_rng(4).normal(size=5000)) == pytest.approx(0.5, abs=0.1)
    assert correlation_length(np.zeros(100)) == 0.5


def test_block_averages_drop_the_rest_at_the_start() -> None:
    assert block_averages(np.arange(7.0), 3).tolist() == [2.0, 5.0]


def test_through_the_origin() -> None:
    s = displacement()
    noise = correlated_noise(np.random.default_rng(1), ROWS, 0.01, 1)
    fit = fit_curve(s, 0.3 * s - 0.02 * s**2 + noise, through_origin=True)
    assert fit.series(0) == pytest.approx(0, abs=1e-12)
    assert fit.error(0.0)[0] == pytest.approx(0, abs=1e-12)
    assert fit.degree <= 3
    assert fit.series(s) == pytest.approx(0.3 * s - 0.02 * s**2, abs=0.01)
    assert np.polynomial.legendre.legval(-1, fit.replicas(20)) == pytest.approx(np.zeros(20), abs=1e-12)


def test_error_of_the_slope() -> None:
    """That of 2 a x + b by the covariance of a parabola through the averages of the blocks."""
    s = displacement()
    noise = np.random.default_rng(7).normal(size=ROWS)
    fit = fit_curve(s, 3 * s - 0.2 * s**2 + noise)
    assert fit.degree == 2
    blocks = block_averages(s, fit.rows_per_block)
    _, covariance = np.polyfit(blocks, fit.y, 2, cov=True)
    for x in (0.4, 4.0):
        gradient = np.array([2 * x, 1, 0])
        assert fit.slope_error(x)[0] == pytest.approx(np.sqrt(gradient @ covariance @ gradient), rel=0.01)


def turning_points(series: np.polynomial.Legendre) -> list[float]:
    """Positions of the local maxima, ascending."""
    tops = maxima(series.coef[:, None])
    return np.sort(mapdomain(tops[np.isfinite(tops)], series.window, series.domain)).tolist()


def test_maxima_only() -> None:
    cubic = np.polynomial.Polynomial([0, -3, 0, 1]).convert(kind=np.polynomial.Legendre, domain=[-2, 2])
    assert turning_points(cubic) == pytest.approx([-1])


@pytest.mark.parametrize("count", range(1, 6))
def test_maxima_of_every_degree(count: int) -> None:
    zeros = np.linspace(0.7, 5.3, count) ** 1.1  # of the derivative: its sign changes at each, last to the negative
    rising = -np.polynomial.Polynomial.fromroots(zeros)
    curve = rising.integ().convert(kind=np.polynomial.Legendre, domain=[0, 8])
    assert turning_points(curve) == pytest.approx(zeros[::-2][::-1], rel=1e-6)
