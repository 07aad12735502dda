# SPDX-License-Identifier: GPL-2.0-or-later
"""run_style verlet/cdem where it might part from run_style verlet. That it gives the same bits in a packing is tested in
test_same_bits.py and test_clump_bits.py; the decks of all other tests use it too."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from engine import Disc, Run, run, same_bits, start

START = "include ${decks}/start.in\n"
END = "include ${decks}/end.in\n"
MOVE = "fix move grains cdem/integrate\ntimestep 2e-7\n"
APPROACH = [Disc(-0.012, 0, vx=50), Disc(0.012, 1e-3, vx=-60, omega=100), Disc(0, -0.015, type=2)]


def shot(directory: Path, ranks: int, deck: str, **variables: Any) -> Run:
    """Grains that shoot at each other, through many times the skin in 20 steps, and on to a wall."""
    return run(START + MOVE + deck + END, directory, discs=APPROACH, ranks=ranks, skin=2e-5, **variables)


def test_fast_grains_find_each_other(tmp_path: Path, ranks: int) -> None:
    """The list is rebuilt when the grains need it, even if neigh_modify looks at it every 20 steps only."""
    looked_at = shot(tmp_path / "verlet", ranks, "run 1000\n", style="verlet")
    late = shot(tmp_path / "cdem", ranks, "neigh_modify delay 0 every 20 check yes\nrun 1000\n")
    assert looked_at.end["vx"][0] < 0  # they have met
    assert "Dangerous builds = 0" in late.log
    assert same_bits(looked_at.end, late.end)


@pytest.mark.parametrize("every", [1, 7, 1000])
def test_neigh_modify_without_check(tmp_path: Path, every: int) -> None:
    """The list is built in the steps that the deck asks for, and whenever it has to be."""
    asked = f"neigh_modify delay 0 every {every} check no\nrun 1000\n"
    assert same_bits(
        shot(tmp_path / "verlet", 1, "run 1000\n", style="verlet").end, shot(tmp_path / "cdem", 1, asked).end
    )


def test_something_at_the_end_of_steps(tmp_path: Path, ranks: int) -> None:
    """Fixes that average, print and halt see each of their steps, and the run stops where it is told to."""
    deck = """
variable x equal x[1]
fix mean all ave/time 3 4 12 v_x file mean.dat
fix print all print 17 "$(step) $(v_x:%.17g) $(vx[1]:%.17g) $(fx[1]:%.17g)" file printed.dat screen no
fix halt all halt 19 v_x > -0.003 error continue message no
run 2000
"""
    runs = [shot(tmp_path / style[-4:], ranks, deck, style=style) for style in ("verlet", "verlet/cdem")]
    for name in ("mean.dat", "printed.dat"):
        verlet, cdem = ((r.directory / name).read_text() for r in runs)
        assert cdem == verlet and cdem.count("\n") > 20
    assert runs[0].end.step == runs[1].end.step < 2000
    assert same_bits(runs[0].end, runs[1].end)


def test_who_looks_at_ghosts_sees_where_they_are(tmp_path: Path, ranks: int) -> None:
    """Distances of two grains that meet across a period of the box, from LAMMPS's list and its ghosts."""
    discs = [Disc(-0.008, 0, vx=-1), Disc(0.008, 1e-5, vx=1, omega=100)]
    deck = """
compute distance all pair/local dist
dump    distance all local 7 distances.dump c_distance
dump_modify distance format float %.17g
run 700
"""
    options: dict[str, Any] = {
        "discs": discs,
        "box": (-0.01, 0.01, -0.01, 0.01),
        "bx": "p",
        "kn": 1e5,
        "ks": 2e4,
        "ranks": ranks,
    }
    runs = [run(START + MOVE + deck, tmp_path / s[-4:], style=s, **options) for s in ("verlet", "verlet/cdem")]
    verlet, cdem = ((r.directory / "distances.dump").read_text() for r in runs)
    assert cdem == verlet and cdem.count("0.003") > 50


def test_walls_that_nothing_moves(tmp_path: Path) -> None:
    """A wall with a velocity but no fix to move it drags the grain along, and stays where it is."""
    discs = [Disc(0, 0, vy=-1), Disc(0, -3.999e-3, vx=2, omega=30, type=2)]
    deck = START + MOVE + "run 500\n" + END
    verlet, cdem = (run(deck, tmp_path / s[-4:], discs=discs, style=s) for s in ("verlet", "verlet/cdem"))
    assert cdem.end["x"][1] == 0 and cdem.end["vx"][0] != 0
    assert same_bits(verlet.end, cdem.end)


def test_gravity_and_drag(tmp_path: Path, ranks: int) -> None:
    """A grain falls through a medium: v = g T (1 - exp(-t/T)); fix_modify takes drag away again."""
    g, drag, dt, steps = 10.0, 2e-3, 1e-6, 4000
    deck = f"fix move grains cdem/integrate dt any gravity 0 -{g} drag {drag}\ntimestep {dt}\nrun {steps}\n"
    falls = run(START + deck + END, tmp_path, discs=[Disc(0, 0.01)], ranks=ranks)
    expected = -g * drag * (1 - 2.718281828459045 ** (-steps * dt / drag))
    assert falls.end["vy"][0] == pytest.approx(
        expected, rel=2 * dt / drag
    )  # drag takes v of the half step: first order
    free = f"fix_modify move drag none gravity 0 0\nrun {steps}\n"
    assert run(START + deck + free + END, tmp_path / "free", discs=[Disc(0, 0.01)], ranks=ranks).end["vy"][
        0
    ] == pytest.approx(
        falls.end["vy"][0], rel=5e-4
    )  # half a step of the old acceleration


def test_a_fix_that_acts_in_every_step_is_named(tmp_path: Path) -> None:
    deck = START + MOVE + "fix pull grains gravity 10 vector 0 -1 0\nrun 10\n"
    log = run(deck, tmp_path, discs=[Disc(0, 0)]).log
    assert "Run style verlet/cdem is no faster than verlet here: fix pull of style gravity acts in every step" in log


@pytest.mark.parametrize(
    ("deck", "message"),
    {
        "no-pair": ("pair_style zero 0.01\npair_coeff * *\nrun 0", "Run style verlet/cdem needs pair_style cdem"),
        "no-integrate": ("run 0", "needs a fix cdem/integrate"),
        "argument": (MOVE + "run_style verlet/cdem fast\nrun 0", "Run style verlet/cdem: unknown argument fast"),
        "gravity-one": ("fix move grains cdem/integrate gravity 1", "Fix cdem/integrate: gravity has no value"),
        "gravity-word": ("fix move grains cdem/integrate gravity 0 down", "gravity is down, must be a number"),
        "drag-zero": ("fix move grains cdem/integrate drag 0", "Fix cdem/integrate: drag 0: the time must be positive"),
        "drag-word": ("fix move grains cdem/integrate drag much", "drag is much, must be a number"),
        "modify": (MOVE + "fix_modify move weight 1", "Illegal fix_modify command|does not support fix_modify weight"),
    }.values(),
)
def test_refused(tmp_path: Path, deck: str, message: str) -> None:
    run(START + MOVE + "run 0\n", tmp_path, discs=[Disc(0, 0)])  # without the mistake it runs
    status, output = start(START + deck + "\n", tmp_path)
    assert status != 0
    assert re.search(message, output)
