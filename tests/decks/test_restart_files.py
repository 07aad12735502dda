# SPDX-License-Identifier: GPL-2.0-or-later
"""Restart files that are written in a run: each can be read, and what goes on from it ends like the run that wrote it,
whatever the sides of the box. And the rescue file of a run that blows up."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from engine import run, same_bits, start
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


def test_the_guard_has_the_last_word_beside_fix_deposit(tmp_path: Path) -> None:
    """Which refuses to be told of another step."""
    (tmp_path / "small.txt").write_text(
        "a disc\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\nDiameters\n\n1 0.002\n"
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
