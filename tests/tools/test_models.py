# SPDX-License-Identifier: GPL-2.0-or-later
"""The models: their files against their names, and what happens to a damaged file."""

import re

import pytest

from shearbox_tools.errors import ShearboxError
from shearbox_tools.models import INPUT, all_models, read_model, read_variables
from shearbox_tools.table import print_models

NAME = re.compile(r"Type[A-D]_(\d+)x(\d+)_(?:T-(\d)|(\d)-(\d))_([13])-circle_(\d+)")


def test_there_are_fourteen():
    assert len(all_models()) == 14


@pytest.mark.parametrize("model", all_models(), ids=lambda model: model.name)
def test_the_name_encodes_the_numbers(model):
    width, half_height, equal, low, high, discs, grains = NAME.fullmatch(model.name).groups()
    assert model.width == pytest.approx(int(width) / 100)
    assert model.half_height == pytest.approx(int(half_height) / 100)
    assert model.dmin == pytest.approx(int(equal or low) / 1000)
    assert model.dmax == pytest.approx(int(equal or high) / 1000)
    assert model.ngrains == int(grains)
    assert model.shape == {"1": "single", "3": "triple"}[discs]
    assert model.power == (0 if discs == "3" else -3) or equal


def test_the_table_names_them_all(capsys):
    print_models()
    table = capsys.readouterr().out
    assert all(model.name in table for model in all_models())
    assert "10 × 10" in table and "n(d) ∝ d^-3" in table


def test_variables_without_their_comments():
    assert read_variables(INPUT / "parameters.in")["phi"] == "27"


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda text: text.replace("ngrains", "grains"), "no variable ngrains"),
        (lambda text: text.replace("0.008", "wide"), "could not convert string to float: 'wide'"),
        (lambda text: "", "no variable width, half_height"),
    ],
)
def test_a_damaged_model_is_named(tmp_path, change, message):
    path = tmp_path / "bad.in"
    path.write_text(
        change((INPUT / "models" / "TypeA_10x5_4-8_1-circle_350.in").read_text(encoding="utf-8")), encoding="utf-8"
    )
    with pytest.raises(ShearboxError, match=message) as error:
        read_model(path)
    assert str(path) in str(error.value)
