# SPDX-License-Identifier: GPL-2.0-or-later
"""Restart files that are written in a run: each can be read, and what goes on from it ends like the run that wrote it,
whatever the sides of the box. And the rescue file of a run that blows up."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from engine import Disc, run, same_bits, start
from scenes import cloud

# Grains fly through a box, are drawn over the border again and again, and fall on a floor.
MOTION = """
fix move grains cdem/integrate gravity 300 -600
timestep 2e-7
thermo_modify lost ignore
"""
WRITE = f"""include ${{decks}}/start.in
change_box all boundary ${{bx}} ${{by}} p
velocity grains set 20 -3 0 sum yes
{MOTION}
restart ${{every}} at.*.restart
run 6000
include ${{decks}}/end.in
"""
GO_ON = f"""newton off
processors ${{px}} ${{py}} 1
read_restart at.${{at}}.restart
comm_modify vel yes
neighbor 1e-4 bin
neigh_modify delay 0 every 1 check yes
run_style ${{style}}
group walls type 2
{MOTION}
restart ${{every}} again.*.restart
run 6000 upto
include ${{decks}}/end.in
"""
SIDES = {"periodic": ("p", "p"), "shrink-wrapped": ("s", "s"), "fixed and periodic": ("p", "f")}


@pytest.mark.parametrize("ranks", [1, 4])
@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
@pytest.mark.parametrize("sides", SIDES)
def test_what_was_written_in_a_run_goes_on_to_the_same_bits(tmp_path: Path, sides: str, style: str, ranks: int) -> None:
    bx, by = SIDES[sides]
    options: dict[str, Any] = {"style": style, "bx": bx, "by": by, "every": 370, "skin": 1e-4, "ranks": ranks}
    box = (-0.012, 0.012, -0.012, 0.012)
    end = run(WRITE, tmp_path, discs=cloud(4, 2), box=box, **options).end
    for at in (370, 2220, 3330, 5550):
        assert same_bits(end, run(GO_ON, tmp_path, at=at, **options).end), f"from step {at} on"


RESCUE = """include ${decks}/start.in
change_box all boundary ${bx} ${by} p
velocity grains set 20 -3 0 sum yes
fix move grains cdem/integrate rescue rescue.restart
MORE
group one id 5
variable kick equal "(step > 11500)*1e6"
fix kick one addforce 0 v_kick 0
timestep 2e-7
thermo_modify lost ignore
run 30000
"""


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("sides", SIDES)
def test_a_rescue_file_can_be_read(tmp_path: Path, sides: str, ranks: int) -> None:
    """The message of the guard is the last word, and what it says has been written can be read."""
    bx, by = SIDES[sides]
    options: dict[str, Any] = {"bx": bx, "by": by, "ranks": ranks}
    deck = RESCUE.replace("MORE", "")
    _fail(tmp_path, deck, **options)
    read = 'newton off\nprocessors ${px} ${py} 1\nread_restart rescue.restart\nprint "atoms = $(atoms)"\n'
    assert run(read, tmp_path, ranks=ranks).printed("atoms") == 16


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize(
    "more", ["change_box all triclinic", "change_box all triclinic\nfix flow all deform 1 xy erate 1 remap none"]
)
def test_a_rescue_file_of_a_tilted_box_can_be_read(tmp_path: Path, more: str, ranks: int) -> None:
    _fail(tmp_path, RESCUE.replace("MORE", more), bx="p", by="p", ranks=ranks)
    read = 'newton off\nprocessors ${px} ${py} 1\nread_restart rescue.restart\nprint "atoms = $(atoms)"\nprint "tilt = $(xy)"\n'
    done = run(read, tmp_path, ranks=ranks)
    assert done.printed("atoms") == 16
    tilt = 0.06 * 4999 * 2e-7 if "deform" in more else 0  # height x rate x time: the copy is made before fix flow acts
    assert done.printed("tilt") == pytest.approx(tilt, rel=1e-9)


AUDITED = """
compute energy all cdem/energy audit yes
variable drag equal c_energy[7]
thermo_style custom step v_drag
"""


def test_the_books_in_a_rescue_file_are_those_of_its_step(tmp_path: Path) -> None:
    """Not those of its step and, of all ranks but the first, of what came after."""
    deck = RESCUE.replace("MORE", AUDITED).replace("rescue rescue.restart", "rescue rescue.restart drag 1e-3")
    deck = deck.replace("run 30000", "run 5000\nprint 'before = $(v_drag)'\nrun 25000")
    box = (-0.03, 0.03, -0.03, 0.03)
    run("include ${decks}/start.in\n", tmp_path, discs=cloud(4, 2), box=box)
    status, output = start(deck, tmp_path, ranks=2, bx="p", by="p")
    assert status != 0
    found = re.search(r"^before = ([0-9.e-]+)$", output, re.M)
    assert found
    go_on = (
        "newton off\nprocessors ${px} ${py} 1\nread_restart rescue.restart\ncomm_modify vel yes\n"
        "fix move grains cdem/integrate drag 1e-3\ntimestep 2e-7\n" + AUDITED + "run 0\nprint 'after = $(v_drag)'\n"
    )
    assert run(go_on, tmp_path, ranks=2).printed("after") == pytest.approx(float(found[1]), rel=1e-6)


CUT = """include ${decks}/start.in
group other id 3
fix move grains cdem/integrate gravity 0 -600
fix calm other momentum 100 linear 1 1 0
timestep 1e-7
RUN
include ${decks}/end.in
"""


def test_a_run_may_be_cut_where_the_guard_looks(tmp_path: Path) -> None:
    """It keeps a copy every 5000 steps; a fix that comes later in the deck changes velocities after that. The next run begins
    with the forces of the last nevertheless, here of a grain that vibrates on a wall."""
    discs = [Disc(0, 0, type=2), Disc(0, 0.004 - 3e-9), Disc(0.01, 0.01, vx=1)]  # half as much again as its weight
    whole, cut = (
        run(CUT.replace("RUN", runs), tmp_path / str(k), discs=discs, hn=1e-3).end
        for k, runs in enumerate(("run 10000", "run 5000\nrun 5000"))
    )
    assert same_bits(whole, cut)


def test_the_guard_has_the_last_word_beside_fix_deposit(tmp_path: Path) -> None:
    """Which refuses to be told of another step."""
    (tmp_path / "small.txt").write_text(
        "a disc\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\nDiameters\n\n1 0.002\n\nMasses\n\n1 8.3e-5\n"
    )
    more = """molecule small small.txt
region place block -0.026 -0.025 -0.026 -0.025 0 0
fix rain grains deposit 100 0 100000 4711 region place mol small units box
"""
    _fail(tmp_path, RESCUE.replace("MORE", more), bx="p", by="p", ranks=1)
    assert (tmp_path / "rescue.restart").stat().st_size > 0


def test_the_guard_has_the_last_word_where_grains_have_gone(tmp_path: Path) -> None:
    """LAMMPS counts atoms before it writes a file. The file has the grains of its step, also those that have gone since."""
    more = """group others id 1:4 6:16
region all block INF INF INF INF INF INF
fix out others evaporate 7000 1 all 4711
"""
    deck = RESCUE.replace("MORE", more).replace("thermo_modify lost ignore", "")
    _fail(tmp_path, deck, bx="p", by="p", ranks=1)
    assert run('newton off\nread_restart rescue.restart\nprint "atoms = $(atoms)"\n', tmp_path).printed("atoms") == 16


def _fail(folder: Path, deck: str, ranks: int, **options: str) -> None:
    """The deck, whose run blows up at step 11501 or little later."""
    box = (-0.03, 0.03, -0.03, 0.03)
    run("include ${decks}/start.in\n", folder, discs=cloud(4, 2), box=box)
    status, output = start(deck, folder, ranks=ranks, **options)
    assert status != 0
    errors = [line for line in output.splitlines() if line.startswith("ERROR")]
    assert len(errors) == 1
    assert "Fix cdem/integrate: at step 115" in errors[0]
    assert "The state of step 5000 is in rescue.restart" in errors[0]
