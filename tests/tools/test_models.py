# SPDX-License-Identifier: GPL-2.0-or-later
"""The models: their files against their names, and what happens to a damaged file."""

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shearbox_tools.asking.grains import area_over_largest
from shearbox_tools.asking.models import INPUT, Model, all_models, find_model, model_files, read_model, read_variables
from shearbox_tools.asking.named import model_text
from shearbox_tools.asking.parameters import parameters
from shearbox_tools.base.errors import InputError, ShearboxError
from shearbox_tools.base.presets import LAWS
from shearbox_tools.commands.listing import print_models

NAME = re.compile(r"Type[A-D]_(\d+)x(\d+)_(?:T-(\d)|(\d)-(\d))_([13])-circle_(\d+)")


def test_there_are_fourteen() -> None:
    assert len(all_models()) == 14


@pytest.mark.parametrize("model", all_models(), ids=lambda model: model.name)
def test_the_name_encodes_the_numbers(model: Model) -> None:
    match = NAME.fullmatch(model.name)
    assert match
    width, half_height, equal, low, high, discs, grains = match.groups()
    assert model.width == pytest.approx(int(width) / 100)
    assert model.half_height == pytest.approx(int(half_height) / 100)
    assert model.dmin == pytest.approx(int(equal or low) / 1000)
    assert model.dmax == pytest.approx(int(equal or high) / 1000)
    assert model.ngrains == int(grains)
    assert model.discs == int(discs)
    assert model.power == (0 if discs == "3" else -3) or equal


@pytest.mark.parametrize("path", model_files(), ids=lambda path: path.stem)
def test_the_name_alone_makes_the_same_model(path: Path, tmp_path: Path) -> None:
    made = tmp_path / path.name
    made.write_text(model_text(path.stem) or "", encoding="utf-8")
    assert read_model(made).variables == read_model(path).variables


@pytest.mark.parametrize("discs, sizes", [("1", "2-4"), ("1", "T-2"), ("3", "2-8")])
def test_auto_is_so_many_that_their_area_fills_the_box(discs: str, sizes: str) -> None:
    """In a box so large that walls do not count, and with it: the solid fraction is between those of a square and of a
    triangular lattice of discs, pi/4 and 0.907."""
    model = find_model(f"TypeD_1000x400_{sizes}_{discs}-circle_auto")
    shares = (np.arange(model.ngrains) + 0.5) / model.ngrains
    diameters = (
        model.dmin + shares * (model.dmax - model.dmin)
        if discs == "3"
        else model.dmin / np.sqrt(1 - shares * (1 - (model.dmin / model.dmax) ** 2))
    )
    area = int(discs) * np.pi / 4 * np.sum(diameters**2)
    assert math.pi / 4 < area / (model.width * 2 * model.half_height) < 0.907
    narrow = find_model(model.name.replace("1000x400", "10x400"))
    assert 0.95 * model.ngrains / 100 < narrow.ngrains < model.ngrains / 100


@pytest.mark.parametrize(
    "name, message",
    [
        ("TypeA_10x5_8-4_1-circle_350", "the least size first. Names are TypeX_WIDTHxHALF-HEIGHT"),
        ("TypeA_0x5_4-8_1-circle_350", "lengths above 0 are expected"),
        ("TypeA_10x5_2-9_1-circle_auto", "auto is for sizes up to 1 : 4"),
        ("TypeE_10x5_4-8_1-circle_350", "unknown model"),
        ("TypeA_10x5_4-8_1-circle_many", "COUNT of grains, or auto"),
    ],
)
def test_a_name_that_cannot_be_meant_says_what_is_allowed(name: str, message: str) -> None:
    with pytest.raises(InputError, match=re.escape(message)):
        find_model(name)


def test_the_table_names_them_all(capsys: pytest.CaptureFixture[str]) -> None:
    print_models()
    table = capsys.readouterr().out
    assert all(model.name in table for model in all_models())
    assert "10 × 10" in table and "n(d) ∝ d^-3" in table


def test_the_same_for_scripts(capsys: pytest.CaptureFixture[str]) -> None:
    print_models(as_json=True)
    models = {model["name"]: model for model in json.loads(capsys.readouterr().out)}
    assert set(models) == {model.name for model in all_models()}
    one = models["TypeA_10x5_2-4_3-circle_350"]
    assert (one["discs"], one["ngrains"], one["dmin"], one["width"], one["shape"]) == (3, 350, 0.002, 0.1, "triple")


def own(folder: Path, shape: str) -> Path:
    """A model with a shape of its own."""
    path = folder / "own.in"
    text = (INPUT / "models" / "TypeA_10x5_4-8_1-circle_350.in").read_text(encoding="utf-8")
    path.write_text(text.replace("index single", f"index {shape}"), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "shape, discs, template",
    [
        ("triple", 3, "triple"),
        ('"discs 2 0 0 1 1 0 1"', 2, "discs 2 0 0 1 1 0 1"),
        ('"discs 2  0 0 1 &\n  1 0 1"', 2, "discs 2 0 0 1 1 0 1"),
        ('"file grain.txt"', 2, "discs 2 0 0 1 1 0 .5"),
    ],
)
def test_a_model_of_ones_own(tmp_path: Path, shape: str, discs: int, template: str) -> None:
    """A template in a file is recorded as the discs that it had."""
    (tmp_path / "grain.txt").write_text("# x y r\n0 0 1\n\n1 0 .5 # the small one\n", encoding="utf-8")
    model = find_model(str(own(tmp_path, shape)))
    assert (model.name, model.discs, model.variables["shape"]) == ("own", discs, template)


@pytest.mark.parametrize(
    "shape, message",
    [
        ("quadruple", "own.in: shape quadruple: single, triple, 'discs N x y r ...' or 'file NAME' is expected"),
        ("discs", "own.in: shape discs: single"),
        ('"discs many 0 0 1"', "own.in: shape discs many 0 0 1: single"),
        ('"file none.txt"', "none.txt: No such file"),
    ],
)
def test_a_shape_that_is_none_is_named(tmp_path: Path, shape: str, message: str) -> None:
    with pytest.raises(ShearboxError) as error:
        read_model(own(tmp_path, shape))
    assert message in str(error.value)


def test_what_else_a_model_says_is_recorded(tmp_path: Path) -> None:
    """So that a changed one is not taken for the one that was packed."""
    path = own(tmp_path, "single")
    path.write_text(path.read_text(encoding="utf-8") + "variable loose index 2.5 # column\n", encoding="utf-8")
    assert read_model(path).variables["loose"] == "2.5"


def test_variables_without_their_comments() -> None:
    assert read_variables(INPUT / "parameters.in")["phi"] == "27"


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda text: text.replace("ngrains", "grains"), "no variable ngrains"),
        (
            lambda text: text.replace("0.008", "wide"),
            "dmax: 'wide' is not a number; units are those of parameters.in: SI",
        ),
        (lambda text: "", "no variable width, half_height"),
    ],
)
def test_a_damaged_model_is_named(tmp_path: Path, change: Callable[..., Any], message: str) -> None:
    path = tmp_path / "bad.in"
    path.write_text(
        change((INPUT / "models" / "TypeA_10x5_4-8_1-circle_350.in").read_text(encoding="utf-8")), encoding="utf-8"
    )
    with pytest.raises(ShearboxError, match=message) as error:
        read_model(path)
    assert str(path) in str(error.value)


def test_the_laws_are_those_that_the_decks_name() -> None:
    assert parameters()["law"].words == LAWS


@pytest.mark.parametrize(
    "shape, area",
    [
        ("single", math.pi / 4),
        ("triple", 3 * math.pi / 4),
        ("discs 1 7 -3 50", math.pi / 4),
        ("discs 2 0 0 1 1 0 1", (2 * math.pi - 2 * math.pi / 3 + math.sqrt(3) / 2) / 4),
        ("discs 2 0 0 1e200 1.5e200 0 5e199", 1.25 * math.pi / 4),
    ],
)
def test_area_of_a_grain(shape: str, area: float) -> None:
    """Two discs of radius 1 whose centres are 1 apart share the lens 2 pi/3 - sqrt(3)/2."""
    assert area_over_largest(shape) == pytest.approx(area, rel=1e-3)


@pytest.mark.parametrize(
    "text, message",
    [
        ("0 0 1\n3 0 1\n", "disc 2 is disconnected from disc 1"),
        ("0 0 1\n0 .2 .5\n", "disc 2 is a duplicate of, or lies inside, disc 1"),
        (
            "0 0 1\n.03 0 1\n.01 0 1.005\n",
            "disc 3 nearly coincides with disc 1: distance of centres and difference of radii must add up to 2 % of the smaller radius",
        ),
        ("0 0 1\n1 0 0\n", "line 2: 'x y r' of a disc with r > 0 is expected, not '1 0 0'"),
        ("0 0 1\n# two\n1 0 -.8\n", "line 3: 'x y r' of a disc with r > 0 is expected, not '1 0 -.8'"),
        ("0 0 1\n1 0\n", "line 2: 'x y r' of a disc with r > 0 is expected, not '1 0'"),
        ("0 0 1\n1 0 one\n", "line 2: 'x y r' of a disc with r > 0 is expected, not '1 0 one'"),
        ("0 0 1\n1 0 nan\n", "line 2: 'x y r' of a disc with r > 0 is expected, not '1 0 nan'"),
        ("# nothing\n", "it has 0 discs, 1 to 1000 are allowed"),
    ],
)
def test_a_template_that_no_grain_has_is_refused(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "grain.txt").write_text(text, encoding="utf-8")
    with pytest.raises(ShearboxError) as error:
        read_model(own(tmp_path, '"file grain.txt"'))
    assert message in str(error.value) and "grain.txt" in str(error.value)


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("index single", "index file grain.txt", "'variable NAME index VALUE' is expected"),  # LAMMPS: two values
        ("index 350", "index 350.5", "ngrains: a whole number is expected"),
        ("index 350", "equal 350", "'variable NAME index VALUE' is expected, not 'variable ngrains     equal 350"),
        ("index 350", "index 3_50", "ngrains: '3_50' is not a number"),
        ("index 350", "index ３５０", "ngrains: '３５０' is not a number"),
        ("index 350", "index 350\nvariable ngrains index 400", "several variables ngrains"),  # LAMMPS: the first counts
        ("index 350", "index 35&\n0\0", "not text"),
        ("variable width", "vari width", "'variable NAME index VALUE' is expected, not 'vari"),
    ],
)
def test_what_lammps_reads_otherwise_is_refused(tmp_path: Path, old: str, new: str, message: str) -> None:
    path = own(tmp_path, "single")
    path.write_text(path.read_text(encoding="utf-8").replace(old, new, 1), encoding="utf-8")
    with pytest.raises(ShearboxError) as error:
        read_model(path)
    assert message in str(error.value) and str(path) in str(error.value)
