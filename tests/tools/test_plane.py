# SPDX-License-Identifier: GPL-2.0-or-later
"""Stresses on the shear plane, and strength by them, against closed forms."""

import numpy as np
import pytest
from synthetic import correlated_noise

from shearbox_tools.analysis.peak import Peak
from shearbox_tools.analysis.plane import OnPlane, line_on_plane, on_plane
from shearbox_tools.analysis.polynomial import fit_curve

S = np.linspace(0.01, 8, 800)


def plane(sigma: float, tau: float, error: float = 1.0) -> OnPlane:
    """At its peak, with the standard error of tau; that of sigma is 0."""
    return OnPlane(fit_curve(S, sigma + 0 * S), fit_curve(S, S), Peak(tau, error, 2.5, 0.1, False), (sigma, tau))


@pytest.mark.parametrize("column", ["plane_kPa", "plane_tau_kPa"])
def test_without_both_columns_nothing_is_known(column: str) -> None:
    assert on_plane({"displacement_mm": S, column: S}, slice(None)) is None


def test_at_the_peak_and_at_the_end() -> None:
    """tau = 60 - 4 (s - 2.5)^2 has its peak at 2.5 mm, where sigma = 120 + 8 s - s^2 is 133.75. Means from 6.4 to 8: of
    sigma 120 + 8 * 7.2 - (7.2^2 + 1.6^2 / 12), of tau 60 - 4 (4.7^2 + 1.6^2 / 12). The stress on the lower half is
    not in it."""
    rng = np.random.default_rng(1)
    data = {
        "displacement_mm": S,
        "tau_kPa": 90 - (S - 6) ** 2,
        "plane_kPa": 120 + 8 * S - S**2 + correlated_noise(rng, 800, 1, 3),
        "plane_tau_kPa": 60 - 4 * (S - 2.5) ** 2 + correlated_noise(rng, 800, 1, 3),
    }
    found = on_plane(data, slice(None))
    assert found is not None
    assert found.peak.value == pytest.approx(60, abs=3 * found.peak.value_error) and found.peak.value_error < 1
    assert found.peak.position == pytest.approx(2.5, abs=0.1)
    assert found.sigma_at_peak == pytest.approx(133.75, abs=3 * found.sigma_at_peak_error + 0.3)
    assert found.sigma_at_peak_error < 0.5
    ends = 120 + 8 * 7.2 - 7.2**2 - 1.6**2 / 12, 60 - 4 * (4.7**2 + 1.6**2 / 12)
    assert found.at_end == pytest.approx(ends, abs=0.6)


def test_the_line_goes_through_the_stresses_on_the_plane() -> None:
    line = line_on_plane([plane(sigma, 7 + 0.4 * sigma) for sigma in (130.0, 250, 390)])
    assert (line.c_kPa, line.slope) == pytest.approx((7, 0.4))


def test_errors_of_both_stresses_count(monkeypatch: pytest.MonkeyPatch) -> None:
    """A line of slope m through the origin: an error e of sigma is one of m e of tau; 0.75 * 4 and 4 make 5."""
    by_tau = line_on_plane([plane(s, 0.75 * s, 5) for s in (100.0, 200, 300)])
    monkeypatch.setattr(OnPlane, "sigma_at_peak_error", 4.0)
    by_both = line_on_plane([plane(s, 0.75 * s, 4) for s in (100.0, 200, 300)])
    assert by_both.covariance == pytest.approx(by_tau.covariance)
