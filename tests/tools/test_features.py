# SPDX-License-Identifier: GPL-2.0-or-later
"""The three features on curves that have them and on curves that do not."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from synthetic import correlated_noise, curves

from shearbox_tools.analysis import features
from shearbox_tools.analysis.peak import find_peak, steepest
from shearbox_tools.analysis.polynomial import end_zone, fit_curve
from shearbox_tools.analysis.strength import fit_line

SIGMA = np.array([100.0, 200, 300, 400])


def judged(tau: np.ndarray) -> features.Verdict:
    return features.proportional(SIGMA[: len(tau)], tau, fit_line(SIGMA[: len(tau)], tau, np.ones(len(tau))))


def test_proportional() -> None:
    assert judged(np.array([55.0, 104, 151, 206])).holds is True
    many = np.arange(1, 13) * 100.0
    tau = 0.5 * many - 26 * (many == 700) + 26 * (many == 600)
    verdict = features.proportional(many, tau, fit_line(many, tau, np.ones(12)))
    assert "R² of the line 0.99" in verdict.reason
    assert verdict.holds is False, "must rise with every stress"
    assert judged(np.array([50.0, 60, 61, 200])).holds is False, "must be a line"
    assert judged(np.array([55.0, 104])).holds is None


def test_numbers_do_not_look_like_another_verdict() -> None:
    """R^2 of 0.97996 is not printed as 0.980, nor a rise of 0.004 kPa as 0.0."""
    tau = np.array([55.0, 104, 104.004, 206])
    line = replace(fit_line(SIGMA, tau, np.ones(4)), r_squared=0.97996)
    verdict = features.proportional(SIGMA, tau, line)
    assert verdict.holds is False
    assert "R² of the line 0.97996 (≥ 0.98)" in verdict.reason and "+0.004 kPa (> 0)" in verdict.reason


def test_a_share_just_below_the_limit_is_not_the_limit() -> None:
    """tau = 100 - (s - 3)^2 is 89.96 at 3 - 3.1686, which is moved to where the lid is steepest."""
    s = curves(200, 8)["displacement_mm"]
    lid = fit_curve(s, s**2 - s**3 / 12, through_origin=True)  # steepest at 4
    tau = fit_curve(s, 100 - (s - 4 + np.sqrt(10.04)) ** 2)
    verdict = features.peak_at_steepest(tau, find_peak(tau), lid)
    assert verdict.holds is False
    assert "τ is 89.96 % of its peak (≥ 90 %)" in verdict.reason


def fits(lid: np.ndarray | None = None) -> Any:
    data = curves(200, 8)
    s = data["displacement_mm"]
    tau = fit_curve(s, data["tau_kPa"])
    return tau, find_peak(tau), fit_curve(s, data["lid_mm"] if lid is None else lid)


def test_dilation_and_its_steepest_point() -> None:
    tau, peak, lid = fits()
    position, rate = steepest(lid)
    assert position == pytest.approx(1.6, abs=0.3)
    assert rate == pytest.approx(0.25, abs=0.05)
    assert features.dilates(lid, peak).holds is True
    assert features.peak_at_steepest(tau, peak, lid).holds is True


@pytest.mark.parametrize("lowest, at_start", [(3, True), (2.28, False)])
def test_the_lid_may_rise_steepest_as_shear_begins(lowest: float, at_start: bool) -> None:
    """Slope 0.5 - 0.02 (s^3/3 - (m + 6) s^2/2 + 6 m s), lowest at m and highest inside at 6 mm. A twentieth of the travel from the
    start it is higher: by 0.23, or by 0.005, which is lost in the noise."""
    s = curves(200, 8)["displacement_mm"]
    slope = np.polynomial.Polynomial([0.5, -0.02 * 6 * lowest, 0.01 * (lowest + 6), -0.02 / 3])
    noise = correlated_noise(np.random.default_rng(2), len(s), 0.02, 8)
    position, rate = steepest(fit_curve(s, slope.integ()(s) + noise, through_origin=True))
    assert position == pytest.approx(end_zone(s[-1]) if at_start else 6, abs=0.3)
    assert rate == pytest.approx(slope(position), rel=0.1)


def test_contraction_does_not_dilate() -> None:
    noise = correlated_noise(np.random.default_rng(1), 800, 0.002, 8)
    s = curves(200, 8)["displacement_mm"]
    tau, peak, lid = fits(-0.05 * s + noise)
    assert features.dilates(lid, peak).holds is False
    assert features.peak_at_steepest(tau, peak, lid).holds is False


def test_flat_lid_within_its_noise_does_not_dilate() -> None:
    _, peak, lid = fits(correlated_noise(np.random.default_rng(2), 800, 0.01, 8))
    assert features.dilates(lid, peak).holds is False


def test_late_dilation_is_not_at_the_peak() -> None:
    data = curves(200, 8)
    s = data["displacement_mm"]
    tau = fit_curve(s, 100 * s * np.exp(1 - s / 5) / 5 + correlated_noise(np.random.default_rng(3), 800, 1, 8))
    lid = fit_curve(s, 0.5 / (1 + np.exp(-(s - 1.2) / 0.4)) + correlated_noise(np.random.default_rng(4), 800, 0.002, 8))
    assert features.peak_at_steepest(tau, find_peak(tau), lid).holds is False
