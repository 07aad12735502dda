# SPDX-License-Identifier: GPL-2.0-or-later
"""What examples/models/run says about size laws, against closed forms."""

from __future__ import annotations

import dataclasses
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path

import pytest
from shearbox_tools.asking.models import Model

ROOT = Path(__file__).resolve().parents[2]
LOADER = SourceFileLoader("models_example", str(ROOT / "examples" / "models" / "run"))
SPEC = spec_from_loader("models_example", LOADER)
assert SPEC
example = module_from_spec(SPEC)
LOADER.exec_module(example)

MODEL = Model(Path("A.in"), 0.1, 0.05, 0.002, 0.004, 0, 1500, "single")


def test_mean_square() -> None:
    assert example.mean_square(0, 1, 2) == pytest.approx(7 / 3)  # uniform: (b^3 - a^3)/(3 (b - a))
    assert example.mean_square(-3, 1, 2) == pytest.approx(0.6931471805599453 / (3 / 8))
    assert example.mean_square(-1, 1, 2) == pytest.approx(1.5 / 0.6931471805599453)


@pytest.mark.parametrize("power", [-5.0, -3.0, 0.0, 2.5])
def test_fitting_power_is_the_inverse(power: float) -> None:
    assert example.fitting_power(MODEL, example.mean_square(power, 0.002, 0.004)) == pytest.approx(power, abs=1e-5)


def test_no_power_beyond_the_sizes() -> None:
    assert example.fitting_power(MODEL, 0.004**2) is None


def test_remedy() -> None:
    """None within 5 %; uniform discs 10 % larger fill a specimen 21 % higher."""
    assert example.remedy(MODEL, 0.1 * 1.049) == ""
    uniform = dataclasses.replace(MODEL, dmax=0.002)
    assert example.remedy(uniform, 0.1 / 1.21) == "discs of 2.20 mm"
    assert example.remedy(MODEL, 0.1 / 1.1).startswith("n(d) ∝ d^")
    assert example.remedy(MODEL, 0.05) == "no power law of these sizes"
