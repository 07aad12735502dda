# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run is told that may not be meant, before it begins."""

import math
from dataclasses import replace
from pathlib import Path

import pytest
import synthetic
from command import MODEL, shearbox

from shearbox_tools.analysis.results import read_results
from shearbox_tools.asking.box_width import narrow
from shearbox_tools.asking.grains import length_over_largest
from shearbox_tools.asking.models import all_models, find_model
from shearbox_tools.asking.request import Request
from shearbox_tools.running.cautions import cautions


def request(**settings: str) -> Request:
    return Request(find_model(MODEL), (100.0,), settings=settings)


def test_a_coefficient_of_friction_in_place_of_an_angle() -> None:
    """tan 26.57 degrees is 0.5, tan 16.70 is 0.3; smooth grains, and angles as sand has them, are meant."""
    told = cautions(request(phi="0.5", phi_packing="0.3", phi_wall="0", rolling="0.5"))
    assert told == [
        "phi = 0.5 is an angle of 0.5 degrees; a coefficient of friction of 0.5 is phi 26.57",
        "phi_packing = 0.3 is an angle of 0.3 degrees; a coefficient of friction of 0.3 is phi_packing 16.70",
    ]
    assert cautions(request(phi="1.5")) == cautions(request(phi="27")) == cautions(request()) == []


def test_a_step_beyond_the_stability_limit() -> None:
    """2 sqrt(m / (6 k_n + 3 k_s)) without damping, for discs of 4 mm."""
    limit = 2 * math.sqrt(26.5 * math.pi * 0.002**2 / 6.75e8)
    asked = request(hn="0", hs="0")
    assert cautions(replace(asked, dt=f"{0.99 * limit:.6g}")) == []
    (told,) = cautions(replace(asked, dt=f"{1.01 * limit:.6g}"))
    assert f"is about {limit:.2g} s" in told and "--dt auto" in told


@pytest.mark.parametrize(
    "shape, length", [("single", 1), ("triple", 2), ("discs 2 0 0 1 3 0 1", 2.5), ("discs 2 0 0 2 0 -3 1", 1.5)]
)
def test_length_of_a_grain(shape: str, length: float) -> None:
    """Of two discs in a row: from the one end to the other, over the diameter of the larger."""
    assert length_over_largest(shape) == pytest.approx(length)


def test_a_box_that_is_narrow_for_its_grains() -> None:
    """A grain of three discs that touch is two of them wide. None of the paper's boxes is narrow: the least, of 10 cm, has 12.5
    grains of 8 mm."""
    (told,) = narrow(0.05, 0.008, "single")
    assert told.startswith("the box is 6.25 of its largest grains wide") and "10 or more (ASTM D3080)" in told
    assert narrow(0.1, 0.008, "triple") == narrow(0.05, 0.008, "single")
    assert narrow(0.08, 0.008, "single") == []
    assert [model.name for model in all_models() if cautions(Request(model, (100.0,)))] == []


def test_the_report_tells_it_too(tmp_path: Path) -> None:
    model = find_model(MODEL, {"width": "0.05", "ngrains": "175"})
    synthetic.write_record(tmp_path, Request(model, (100.0,)))
    assert "the box is 6.25 of its largest grains wide" in "\n".join(read_results(tmp_path).notes)


def test_each_note_once_before_anything_runs(tmp_path: Path) -> None:
    said = shearbox(tmp_path / "new", "--dry-run", "--seeds", "2", "--set", "phi=0.5", "--dt", "1e-5")
    assert said.returncode == 0, said.stderr
    assert said.stdout.count("note: phi = 0.5 is an angle") == said.stdout.count("note: --dt 1e-05: the stability") == 1
