# SPDX-License-Identifier: GPL-2.0-or-later
"""The peak of the smoothed data and its error, against curves whose peak is known."""

import numpy as np
import pytest
from scipy.signal import savgol_filter
from synthetic import correlated_noise, softening

from shearbox_tools.analysis.peak import Peak
from shearbox_tools.analysis.smoothed import find_smoothed_peak, smooth

ROWS = 800
S = (np.arange(ROWS) + 0.5) / 100  # to 8 mm


def test_a_parabola_stays_as_it_is() -> None:
    curve = 80 - 3 * (S - 3.255) ** 2
    assert smooth(curve) == pytest.approx(curve)
    peak = find_smoothed_peak(S, curve)
    assert (peak.value, peak.position) == pytest.approx((80, 3.255))
    assert peak.value_error == pytest.approx(0, abs=1e-9)
    assert not peak.at_boundary


def peaks(at: float, residual: float, count: int = 12) -> list[Peak]:
    """Of curves with a peak of 80 and noise of 4, correlated over 8 rows."""
    curve = softening(S, 80, at, residual)
    noise = [correlated_noise(np.random.default_rng(seed), ROWS, 4, 8) for seed in range(count)]
    return [find_smoothed_peak(S, curve + some) for some in noise]


@pytest.mark.parametrize("at, residual", [(0.6, 50), (2.5, 60)])
def test_peak_and_error_of_a_noisy_curve(at: float, residual: float) -> None:
    """The bias of the highest of noisy values, 2 to 3 here, is gone, and the truth is within two errors nearly always.

    The error may be too large, since residuals around the wide smoothing hold a part of the curve's own shape.
    """
    found = peaks(at, residual)
    deviation = np.array([peak.value - 80 for peak in found])
    error = np.array([peak.value_error for peak in found])
    assert abs(np.mean(deviation)) < 1.2  # and three standard errors of a mean of 12 are 1.3
    assert np.mean(abs(deviation) < 2 * error) >= 0.8
    assert 0.6 < np.mean(error) / np.sqrt(np.mean(deviation**2)) < 1.7


def test_a_narrow_peak_is_seen() -> None:
    """A rise to 350 between 2.2 and 4.2 mm, as wide as the window, on a plateau of 240."""
    curve = 240 * (1 - np.exp(-4 * S)) + 110 * np.exp(-(((S - 3.2) / 1.0) ** 2))
    noisy = curve + correlated_noise(np.random.default_rng(1), ROWS, 8, 8)
    peak = find_smoothed_peak(S, noisy)
    assert peak.value == pytest.approx(350, abs=2 * peak.value_error)
    assert peak.value_error < 15
    assert peak.position == pytest.approx(3.2, abs=0.3)


def test_a_rising_curve_has_its_peak_at_the_boundary() -> None:
    peak = find_smoothed_peak(S, 10 * S + correlated_noise(np.random.default_rng(2), ROWS, 0.1, 8))
    assert peak.at_boundary


def test_few_rows() -> None:
    s = np.arange(6.0)
    assert np.isfinite(find_smoothed_peak(s, np.sin(s / 2)).value)


def test_it_is_the_filter_of_savitzky_and_golay() -> None:
    rows = np.random.default_rng(3).normal(size=(3, 101))
    assert smooth(rows) == pytest.approx(savgol_filter(rows, 21, 2), abs=1e-12)
