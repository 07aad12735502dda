# SPDX-License-Identifier: GPL-2.0-or-later
"""The decks of examples/ with few grains: what must hold in them whatever their size."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import DECKS, Run, run

EXAMPLES = DECKS.parents[1] / "examples"


def example(case: str, folder: Path, **variables: Any) -> Run:
    return run(f"include {EXAMPLES}/{case}/{case}.in\n", folder, **variables)


def test_the_lines_that_the_manual_asks_for_are_a_deck(tmp_path: Path) -> None:
    text = (DECKS.parents[1] / "manual" / "decks.md").read_text(encoding="utf-8")
    found = re.search(r"need these lines.*?```text\n(.*?)```", text, re.S)
    assert found
    box = "region box block 0 0.1 0 0.1 -0.01 0.01\ncreate_box 1 box\n"
    grains = "cdem/create 1 row 0.01 0.01 0.09 0.09 9 diameter 4e-3 density 26.5\ngroup grains type 1\n"
    deck = "boundary f f p\nunits si\n" + found[1].replace("fix          shape", box + "fix shape", 1)
    deck = deck.replace("pair_style", grains + "pair_style", 1)
    assert run(deck + 'run 10\nprint "n = $(count(grains))"\n', tmp_path).printed("n") == 9


def table(path: Path) -> dict[str, np.ndarray]:
    with path.open() as stream:
        names = stream.readline().lstrip("# ").split()
    return dict(zip(names, np.loadtxt(path).T, strict=True))


def test_the_floor_bears_the_weight(tmp_path: Path) -> None:
    """Smooth sides take none of it. What is left of the motion is some 1e-9 of the weight."""
    log = example("pour", tmp_path, n=40, width=0.03).log
    found = re.search(r"^floor_N (\S+) weight_N (\S+)", log, re.M)
    assert found
    assert float(found[1]) == pytest.approx(float(found[2]), rel=1e-6)


def test_stresses_of_the_biaxial_test(tmp_path: Path) -> None:
    """The mean stress inside is that on the walls (from the virial of forces in equilibrium), and that of the sides is kept.
    Inertia is the difference: of the order of the inertial number, 1e-3 here."""
    example("biaxial", tmp_path, n=80, strain=3, rows=10, rate=1)
    rows = table(tmp_path / "biaxial.dat")
    vertical, sideways = (rows["top_kPa"] + rows["floor_kPa"]) / 2, (rows["right_kPa"] + rows["left_kPa"]) / 2
    assert rows["right_kPa"].mean() == pytest.approx(100, rel=0.005)
    assert rows["yy_kPa"].mean() == pytest.approx(vertical.mean(), rel=0.005)
    assert rows["xx_kPa"].mean() == pytest.approx(sideways.mean(), rel=0.005)
    assert vertical.mean() > 1.3 * sideways.mean()


@pytest.mark.parametrize("boundary", ["volume", "stiffness"])
def test_boundaries_of_simple_shear(tmp_path: Path, boundary: str) -> None:
    """A lid that stays keeps the volume, bit by bit, and a dense layer that may not dilate presses on it; a spring of
    100 kPa/mm adds to the stress what its lid rises."""
    example("simple_shear", tmp_path, n=120, boundary=boundary, strain=0.1, rows=20, rate=2)
    rows = table(tmp_path / f"{boundary}_0.dat")
    rise = rows["height_mm"] - rows["height_mm"][0]
    if boundary == "volume":
        assert np.all(rise == 0) and rows["sigma_lid_kPa"][-5:].mean() > 150
    else:
        spring = rows["sigma_lid_kPa"][0] + 100 * rise
        assert rise[-5:].mean() > 0.05
        assert rows["sigma_lid_kPa"][-5:].mean() == pytest.approx(spring[-5:].mean(), rel=0.05)


@pytest.mark.parametrize(("case", "variables"), [("hopper", {"n": 100, "seconds": 0.2, "width": 0.05}),
                                                 ("pile", {"half": 0.02, "aspect": 0.5})])  # fmt: skip
def test_it_runs(tmp_path: Path, case: str, variables: dict[str, Any]) -> None:
    """To its end, and has moved grains: out of the hopper, and beyond the gates."""
    example(case, tmp_path, **variables)
    if case == "hopper":
        assert table(tmp_path / "rate.dat")["grains"][-1] > 30
    else:
        text = (tmp_path / "discs.dump").read_text().split("ITEM: TIMESTEP")[-1].splitlines()
        rows = np.loadtxt(text[9:])
        assert np.max(np.abs(rows[rows[:, 5] == 1, 2])) > 0.022
