# SPDX-License-Identifier: GPL-2.0-or-later
"""Normal stress on the shear plane, and strength by it, against closed forms."""

import numpy as np
import pytest
from synthetic import correlated_noise

from shearbox_tools.peak import Peak
from shearbox_tools.plane import OnPlane, line_on_plane, on_plane
from shearbox_tools.polynomial import fit_curve

S = np.linspace(0.01, 8, 800)


def peak(value: float, error: float = 1.0) -> Peak:
    return Peak(value, error, 2.5, 0.1, False)


def plane(at_peak: float, error: float = 0.0) -> OnPlane:
    return OnPlane(fit_curve(S, S), at_peak, error, at_peak)


def test_without_the_column_nothing_is_known() -> None:
    assert on_plane({"displacement_mm": S}, slice(None), peak(50)) is None


def test_at_the_peak_and_at_the_end() -> None:
    """120 + 8 s - s^2 is 133.75 at 2.5 mm; its mean from 6.4 to 8 is 120 + 8 * 7.2 - (7.2^2 + 1.6^2 / 12)."""
    data = {
        "displacement_mm": S,
        "plane_kPa": 120 + 8 * S - S**2 + correlated_noise(np.random.default_rng(1), 800, 1, 3),
    }
    found = on_plane(data, slice(None), peak(50))
    assert found is not None
    assert found.at_peak == pytest.approx(133.75, abs=3 * found.at_peak_error) and found.at_peak_error < 0.5
    assert found.at_end == pytest.approx(120 + 8 * 7.2 - 7.2**2 - 1.6**2 / 12, abs=0.6)


def test_the_line_goes_through_the_stresses_on_the_plane() -> None:
    sigma = np.array([130.0, 250, 390])
    line = line_on_plane([peak(7 + 0.4 * s) for s in sigma], [plane(s) for s in sigma])
    assert (line.c_kPa, line.slope) == pytest.approx((7, 0.4))


def test_errors_of_both_stresses_count() -> None:
    """A line of slope m through the origin: an error e of sigma is one of m e of tau; 0.75 * 4 and 4 make 5."""
    sigma = np.array([100.0, 200, 300])
    by_both = line_on_plane([peak(0.75 * s, 4) for s in sigma], [plane(s, 4) for s in sigma])
    by_tau = line_on_plane([peak(0.75 * s, 5) for s in sigma], [plane(s) for s in sigma])
    assert by_both.covariance == pytest.approx(by_tau.covariance)
