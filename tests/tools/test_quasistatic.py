# SPDX-License-Identifier: GPL-2.0-or-later
"""Inertial number and balance of the halves, in closed form."""

import numpy as np
import pytest

from shearbox_tools.analysis.quasistatic import Inertia, imbalance_percent, inertial_number

DIAMETER = 5e-3
AREA = np.pi * DIAMETER**2 / 4


def test_inertial_number_of_equal_discs() -> None:
    """rate d sqrt(pi rho / (4 sigma)): discs of 5 mm, 0.2 m/s over 50 mm = 4 /s, under 100 kPa."""
    expected = 4 * DIAMETER * np.sqrt(np.pi * 2650 / 4 / 1e5)
    assert inertial_number(0.2, 1e5, AREA, 2650, height=0.1) == pytest.approx(expected)
    assert expected == pytest.approx(2.885e-3, rel=1e-3)


def test_a_low_specimen_shears_over_its_height() -> None:
    low, high = (inertial_number(0.2, 1e5, AREA, 2650, height) for height in (0.02, 1.0))
    assert low / high == pytest.approx(0.05 / 0.02)


def test_inertial_number_is_a_ratio_of_times() -> None:
    """It does not change with the unit of time: stress goes with its square."""
    assert inertial_number(2.0, 1e7, AREA, 2650, 0.1) == pytest.approx(inertial_number(0.2, 1e5, AREA, 2650, 0.1))


def test_imbalance_of_a_vibration() -> None:
    """Stresses 80 + a sin and 80 - a sin: the difference has an rms of sqrt(2) a."""
    phase = 2 * np.pi * np.arange(1000) / 100
    assert imbalance_percent(80 + 2 * np.sin(phase), 80 - 2 * np.sin(phase)) == pytest.approx(100 * np.sqrt(2) * 2 / 80)
    assert imbalance_percent(np.full(9, 80.0), np.full(9, 80.0)) == 0


@pytest.mark.parametrize(
    "number, imbalance, holds, reason",
    [
        (2.9e-5, 0.1, True, "inertial number 0.03e-3 (≤ 1e-3), τ of the halves differs by 0.1 % (≤ 5 %)"),
        (1.0001e-3, 0.1, False, "inertial number 1.0001e-3"),
        (2.9e-5, 5.04, False, "differs by 5.04 % (≤ 5 %)"),
        (None, 0.1, True, "τ of the halves differs by 0.1 %"),
        (2e-3, None, False, "inertial number 2.00e-3 (≤ 1e-3)"),
        (None, None, None, "neither"),
    ],
)
def test_judgement(number: float | None, imbalance: float | None, holds: bool | None, reason: str) -> None:
    verdict = Inertia(number, imbalance).quasi_static
    assert verdict.holds is holds
    assert reason in verdict.reason
