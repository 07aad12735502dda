# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress and dilatancy against Mohr's circles drawn by number, and the relations against their own statements."""

import numpy as np
import pytest
from synthetic import correlated_noise

from shearbox_tools.analysis.stress_dilatancy import Dilatant, rowe_ratio, ultimate


def on_the_plane_of_no_extension(phi: float, psi: float) -> tuple[float, float]:
    """tau / sigma and dy/dx there, from tensors of stress and strain increment (compression +) with the same axes.

    There are two such planes; sheared is the one whose strain increment has the sense of the stress.
    """
    stress = np.diag([1 + np.sin(phi), 1 - np.sin(phi)])
    strain = np.diag([1 - np.sin(psi), -1 - np.sin(psi)])  # trace over difference is -sin(psi): dilation
    angle = np.arccos(np.sqrt((1 + np.sin(psi)) / 2))  # along @ strain @ along = 0
    along, normal = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    assert along @ strain @ along == pytest.approx(0, abs=1e-12)
    ratio = along @ stress @ normal / (normal @ stress @ normal)
    rise = -(normal @ strain @ normal) / (2 * along @ strain @ normal)
    return abs(float(ratio)), abs(float(rise))


@pytest.mark.parametrize("phi, psi", [(35, 15), (25, 0), (40, 25)])
def test_mohr_circle_of_a_direct_shear_test(phi: float, psi: float) -> None:
    ratio, rise = on_the_plane_of_no_extension(np.radians(phi), np.radians(psi))
    state = Dilatant(ratio, rise)
    assert state.dilation_deg == pytest.approx(psi)
    assert state.plane_strain_deg == pytest.approx(phi)


def test_rowe_and_bolton() -> None:
    """Rowe: s1/s3 of phi_cv = 20 degrees (2.0396) times that of psi = 15 (1.6984) is 3.4641, 33.50 degrees."""
    phi, psi = np.radians(33.503), np.radians(15)
    state = Dilatant(float(np.sin(phi) * np.cos(psi) / (1 - np.sin(phi) * np.sin(psi))), float(np.tan(psi)))
    assert state.critical_by_rowe_deg == pytest.approx(20, abs=0.01)
    assert state.critical_by_bolton_deg == pytest.approx(33.503 - 12, abs=0.001)
    assert not state.is_critical


@pytest.mark.parametrize("rate", [-0.2, 0, 0.5])
def test_rowes_line(rate: float) -> None:
    """All states on it have its phi_cv."""
    ratio = float(rowe_ratio(np.array([rate]), 24)[0])
    assert Dilatant(ratio, rate).critical_by_rowe_deg == pytest.approx(24)


def test_the_critical_state() -> None:
    """Without dilatancy tau / sigma = sin(phi_cv), and both relations give the angle back."""
    state = Dilatant(np.sin(np.radians(24)), 0.0)
    assert (state.plane_strain_deg, state.critical_by_rowe_deg, state.critical_by_bolton_deg) == pytest.approx(
        (24,) * 3
    )
    assert state.is_critical and Dilatant(0.4, np.tan(np.radians(-0.99))).is_critical
    assert not Dilatant(0.4, np.tan(np.radians(1.01))).is_critical


def test_a_ratio_without_a_circle() -> None:
    """No plane has tau > sigma / sin(psi)-like ratios: of psi = 0, none above 1."""
    state = Dilatant(1.2, 0.0)
    assert (state.plane_strain_deg, state.critical_by_rowe_deg, state.critical_by_bolton_deg) == (None,) * 3


def test_ultimate_stress_and_its_error() -> None:
    """The last fifth, 50; a thousandth of the noise's variance times twice its correlation length is the error's square."""
    deviations, errors = [], []
    for seed in range(100):
        noise = correlated_noise(np.random.default_rng(seed), 2000, 2, 3)
        mean, error = ultimate(np.where(np.arange(2000) < 1600, 90, 50) + noise)
        deviations.append(mean - 50)
        errors.append(error)
    assert abs(np.mean(deviations)) < 0.1
    assert np.mean(errors) == pytest.approx(np.std(deviations), rel=0.2)
