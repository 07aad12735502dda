# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands of LAMMPS beside the styles of Shearbox: they do what they say, or are refused."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from engine import Disc, run, start

HEAD = "include ${decks}/start.in\nfix move grains cdem/integrate\ntimestep 1e-7\n"
DISCS = [Disc(0, 0, vy=-1), Disc(0.01, 0)]


def refused(deck: str, folder: Path) -> str:
    """The error of a deck."""
    run(HEAD + "run 1\n", folder / "good", discs=DISCS)
    (folder / "discs.data").write_text((folder / "good" / "discs.data").read_text())
    status, output = start(deck, folder)
    assert status != 0
    [error] = [line for line in output.splitlines() if line.startswith("ERROR")]
    return error


def test_contacts_cannot_lose_their_memory(tmp_path: Path) -> None:
    """The fix that pair style cdem made is not the user's to remove."""
    error = refused(HEAD + "run 1\nunfix CDEM_HISTORY\nrun 1\n", tmp_path)
    assert "fix CDEM_HISTORY, which has the memory of the contacts, was removed: do not unfix it" in error


def test_run_style_respa_is_refused(tmp_path: Path) -> None:
    """The fixes of this package have no part in it: nothing would move."""
    deck = HEAD + "run_style respa 2 2 pair 1\nrun 10\n"
    assert "Fix cdem/integrate: run_style respa must be verlet or verlet/cdem" in refused(deck, tmp_path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("fix adapt all dt/reset 10 1e-9 1e-5 1e-4 units box\nrun 100", "is beyond the stability limit"),
        ("run 1\ntimestep 1e-5\nrun 10 pre no", "is beyond the stability limit"),
        ("fix move grains cdem/integrate dt auto\nrun 1\ntimestep 1e-5\nrun 10 pre no", "which dt auto has chosen"),
    ],
)
def test_a_step_beyond_the_limit_is_refused_whoever_sets_it(tmp_path: Path, change: str, message: str) -> None:
    error = refused(HEAD + change + "\n", tmp_path)
    assert "Fix cdem/integrate: the time step 1e-05" in error
    assert message in error


@pytest.mark.parametrize("first", ["integrate", "other"])
@pytest.mark.parametrize("other", ["fix hold one freeze", "fix hold one setforce 0 0 0"])
def test_held_grains_do_not_fall(tmp_path: Path, other: str, first: str) -> None:
    """Whatever comes first in the deck: forces are set after gravity has been added."""
    integrate = "fix move grains cdem/integrate gravity 0 -9.81"
    fixes = [integrate, other] if first == "integrate" else [other, integrate]
    deck = "include ${decks}/start.in\ngroup one id 2\n" + "\n".join(fixes) + "\ntimestep 1e-7\nrun 1000\n"
    end = run(deck + "include ${decks}/end.in\n", tmp_path, discs=DISCS).end
    assert end["y"][1] == 0
    assert end["vy"][0] == pytest.approx(-1 - 9.81 * 1e-4, rel=1e-9)


def test_grains_are_made_in_a_tilted_box(tmp_path: Path) -> None:
    deck = """units si
dimension 2
boundary p p p
processors ${px} ${py} 1
atom_style sphere
newton off
region cell prism 0 0.03 0 0.04 -0.01 0.01 0.005 0 0
create_box 1 cell
cdem/create 1 fill 60 region 0.005 0.029 0 0.039 diameter 0.002 0.003 power -1 density 26.5 seed 3
print "grains = $(count(all))"
"""
    for ranks in (1, 2, 4):
        assert run(deck, tmp_path / str(ranks), ranks=ranks).printed("grains") == 60
    tip = "cdem/create 1 row 0.034 0.039 0.034 0.039 1 diameter 0.001 density 26.5\nprint"
    assert run(deck.replace("print", tip), tmp_path / "tip").printed("grains") == 61  # the side is at 0.0349 there
    status, output = start(deck.replace("print", tip.replace("0.034", "0.036")), tmp_path / "beyond")
    assert status != 0
    assert re.search(
        "cdem/create: disc centre x = 1.0[0-9]* is outside of the box, 0 to 1 in shares of its tilted", output
    )


@pytest.mark.parametrize(("seed", "works"), [(2147483647, True), (2147483648, False), (10**30, False)])
def test_a_seed_is_an_integer_of_32_bits(tmp_path: Path, seed: int, works: bool) -> None:
    fill = f"cdem/create 1 fill 3 region -0.01 0.01 0.001 0.01 diameter 0.002 0.003 power -1 density 26.5 seed {seed}\n"
    run("include ${decks}/start.in\n", tmp_path, discs=DISCS)
    status, output = start("include ${decks}/start.in\n" + fill, tmp_path)
    assert (status == 0) == works
    assert works or f"cdem/create: seed is {seed}, must be an integer from -2147483648 to 2147483647" in output
