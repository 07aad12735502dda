# SPDX-License-Identifier: GPL-2.0-or-later
"""What becomes of runs with too large a time step: those that blow up are stopped, the others are warned of."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest
from engine import Disc, read_dump, run, same_bits, start, write_data
from scenes import lattice, mini_box

# A box full of grains under a lid, with a time step that is `fraction` of the stability limit.
BOX = """
include ${decks}/start.in
group lid type 3
neigh_modify delay 0 every 20 check yes
fix lid lid cdem/lid stress 4e5 width 0.032 thickness 0.01
fix move grains cdem/integrate dt any
compute limit all cdem/limit
variable limit equal f_move
variable contacts equal c_limit
thermo_style custom step v_contacts
thermo_modify format float %.17g
run 0
timestep $(v_fraction*v_limit)
thermo 7
run ${steps}
"""


def box(directory: Path, **variables: Any) -> tuple[int, str]:
    discs, size = mini_box()
    directory.mkdir(parents=True, exist_ok=True)
    write_data(directory / "discs.data", discs, size)
    return start(BOX, directory, skin=2e-5, **variables)


@pytest.mark.parametrize(("style", "ranks"), [("verlet", 2), ("verlet/cdem", 1), ("verlet/cdem", 4)])
def test_a_run_that_blows_up_is_stopped(tmp_path: Path, ranks: int, style: str) -> None:
    """On every number of ranks, before LAMMPS has lost a grain, and with what is wrong and what to do."""
    status, output = box(tmp_path, style=style, ranks=ranks, fraction=6.0, steps=3000)
    assert status != 0 and "Lost atoms" not in output
    said = re.search(r"at step (\d+) atom (\d+) moves by (\S+) m in one step", output)
    assert said, output[-1500:]
    assert int(said[1]) < 300 and 1 <= int(said[2]) <= 95 and float(said[3]) > 0.1 * 0.99 * 2e-3
    assert re.search(r"The time step \S+ s is beyond the stability limit \S+ s of this scene: take a smaller", output)
    assert "The state of step 0 is in rescue.restart" in output
    assert (tmp_path / "rescue.restart").exists()


def test_without_rescue(tmp_path: Path) -> None:
    discs, size = mini_box()
    write_data(tmp_path / "discs.data", discs, size)
    deck = BOX.replace("dt any", "dt any rescue none")
    status, output = start(deck, tmp_path, skin=2e-5, fraction=6.0, steps=3000)
    assert status != 0 and "moves by" in output and "The state of" not in output
    assert not (tmp_path / "rescue.restart").exists()


# A run that fails after more than 10000 steps, and goes on from a restart file: FALL or SHEAR, then the rest.
BEGIN = """
if "${part} == fail" then "include ${decks}/start.in" &
else "newton off" "processors ${px} ${py} 1" "read_restart ${from}" "comm_modify vel yes" "neighbor ${skin} bin" &
     "run_style ${style}"
timestep 2e-7
"""
# All grains fall, faster and faster, through a box that repeats, until they move by a tenth of their radius in a step.
FALL = "fix move grains cdem/integrate gravity 0 -4.5e5 rescue ${part}.rescue\n"
# A small box is sheared under its lid, until all grains are pushed away.
SHEAR = """
group lid type 3
group floor type 4
fix move grains cdem/integrate rescue ${part}.rescue
fix lid lid cdem/lid stress 4e5 width 0.032 thickness 0.01
fix floor floor cdem/move speed 1 ramp 2e-4
variable kick equal 1e9*(step>11000)
if "${part} == fail" then "fix kick grains addforce v_kick 0 0"
"""
END = """
thermo_modify lost error
if "${part} == fail" then "restart 5000 control" "run 20000"
run 400
include ${decks}/end.in
"""


@pytest.mark.parametrize(
    ("scene", "law", "style", "written_by", "read_by"),
    [("fall", "incremental", "verlet/cdem", 1, 2), ("shear", "direct", "verlet", 2, 1)],
)
def test_the_rescued_state_goes_on_to_the_same_bits(
    tmp_path: Path, scene: str, law: str, style: str, written_by: int, read_by: int
) -> None:
    """As the restart file that the run itself wrote 5000 to 10000 steps before it failed: with the history of contacts,
    the lid and the wall."""
    discs, size = lattice(6, 6, 1e-5, speed=0.5) if scene == "fall" else mini_box()
    write_data(tmp_path / "discs.data", discs, size)
    border = "p" if scene == "fall" else "f"
    deck = BEGIN + (FALL if scene == "fall" else SHEAR) + END
    options: dict[str, Any] = {"bx": border, "by": border, "law": law, "style": style, "skin": 2e-4}
    status, output = start(deck, tmp_path, ranks=written_by, part="fail", **options)
    assert status != 0, output[-1500:]
    assert re.search(r"at step 11[01]\d\d atom \d+ moves by", output)  # fall: g t dt = r/10
    assert "The state of step 5000 is in fail.rescue" in output
    ends = []
    for file in ("control.5000", "fail.rescue"):
        status, output = start(deck, tmp_path, ranks=read_by, part="on", **{"from": file}, **options)
        assert status == 0, output[-1500:]
        ends += read_dump(tmp_path / "end.dump")
    control, rescued = ends
    assert control.step == rescued.step == 5400
    assert max(abs(control["tqz"])) > 0
    assert same_bits(control, rescued)


def test_what_is_no_number_is_found(tmp_path: Path) -> None:
    """A force beyond all bounds on one of three discs."""
    write_data(
        tmp_path / "discs.data", [Disc(0.01, 0.01), Disc(-0.01, 0), Disc(0.01, -0.01)], (-0.02, 0.02, -0.02, 0.02)
    )
    deck = (
        "include ${decks}/start.in\ngroup one id 3\nfix push one addforce 1e308 0 0\nfix move grains cdem/integrate\n"
    )
    deck += "timestep 1e-7\nrun 1000\n"
    status, output = start(deck, tmp_path, ranks=2)
    assert status != 0
    assert re.search(r"at step \d+ atom 3 has a position, velocity or force that is not a finite number", output)


# A grain is spoilt between two steps. LAMMPS refuses 0/0 in a formula, but not inf - inf.
SPOIL = """
include ${decks}/start.in
group one id 2
fix move grains cdem/integrate
variable infinite atom 1e308*10
variable none atom v_infinite-v_infinite
timestep ${dt}
run 20000 pre no every 12000 "${spoil}"
"""


@pytest.mark.parametrize(("style", "ranks"), [("verlet", 1), ("verlet/cdem", 2)])
@pytest.mark.parametrize(
    ("spoil", "pace"),
    [
        ("velocity one set v_none NULL NULL", 0),
        ("velocity one set v_none NULL NULL", 10),
        ("velocity one set v_infinite NULL NULL", 0),
        ("set group one x v_none", 0),
        ("set group one x v_none", 10),
        ("set group one y v_infinite", 0),
        ("fix_modify move gravity 1e308 0", 0),
    ],
)
def test_what_is_no_number_amid_a_run_is_found(tmp_path: Path, spoil: str, pace: float, style: str, ranks: int) -> None:
    """At once, on the next rebuild, or in the next hundredth step; with verlet/cdem in the one after it. The copy that is left is
    sound."""
    speed, dt = 0.1, 2e-7
    discs = [Disc(0.01, 0.01, type=2), Disc(-0.01, 0, vx=speed), Disc(0.01, -0.01, vy=pace)]
    write_data(tmp_path / "discs.data", discs, (-0.02, 0.02, -0.02, 0.02))
    options: dict[str, Any] = {"style": style, "by": "p", "skin": 2e-4}
    status, output = start(SPOIL, tmp_path, ranks=ranks, dt=dt, spoil=spoil, **options)
    assert status != 0 and "is no faster than verlet" not in output, output[-1500:]
    said = re.search(r"at step (\d+) atom (\d) has a position, velocity or force that is not a finite number", output)
    assert said, output[-1500:]
    assert 12000 <= int(said[1]) <= 12101
    assert said[2] == "2" or "gravity" in spoil
    assert "The state of step 5000 is in rescue.restart" in output
    deck = BEGIN + "fix move grains cdem/integrate\ninclude ${decks}/end.in\n"
    options["from"] = "rescue.restart"
    status, output = start(deck, tmp_path, part="on", **options)
    assert status == 0, output[-1500:]
    (state,) = read_dump(tmp_path / "end.dump")
    assert state.step == 5000
    assert state["x"] == pytest.approx([0.01, -0.01 + 5000 * dt * speed, 0.01], rel=1e-9)
    assert list(state["vx"]) == [0, speed, 0] and list(state["vy"]) == [0, 0, pace]


@pytest.mark.parametrize(("style", "ranks"), [("verlet", 2), ("verlet/cdem", 1)])
def test_a_force_that_is_no_number_is_found(tmp_path: Path, law: str, style: str, ranks: int) -> None:
    """Two grains that hardly repel are in one place after 60 steps, where a contact has no normal. They meet exactly,
    as dt is a power of two; and the skin is so large that no list is drawn in that step, which would be refused."""
    dt, speed = 2**-22, 1
    discs = [Disc(-60 * speed * dt, 0.01, vx=speed), Disc(60 * speed * dt, 0.01, vx=-speed), Disc(0.01, -0.01)]
    write_data(tmp_path / "discs.data", discs, (-0.02, 0.02, -0.02, 0.02))
    deck = "include ${decks}/start.in\nfix move grains cdem/integrate\ntimestep ${dt}\nrun 6000\n"
    status, output = start(deck, tmp_path, ranks=ranks, style=style, law=law, dt=dt, skin=0.01, kn=1e-30, ks=1e-30)
    assert status != 0, output[-1500:]
    said = re.search(r"at step (\d+) atom [12] has a position, velocity or force that is not a finite number", output)
    assert said, output[-1500:]
    assert 60 <= int(said[1]) <= 101
    assert "The state of step 0 is in rescue.restart" in output
    assert (tmp_path / "rescue.restart").exists()


WARNING = r"at step (\d+) the time step \S+ is beyond the stability limit (\S+) of the present contacts"


@pytest.mark.parametrize("fraction", [0.9, 1.1])
def test_contacts_that_chatter_are_warned_of(tmp_path: Path, fraction: float) -> None:
    """Two discs under no other load: with a step beyond 2/sqrt(2 kn/m) of their contact, but only then; the limit of the
    scene, 2/sqrt(6.75 kn/m), is far below."""
    discs = [Disc(-1.9995e-3, 0), Disc(1.9995e-3, 0)]
    contact = 2 / math.sqrt(2e8 / discs[0].mass)
    out = run(
        "include ${decks}/start.in\nfix move grains cdem/integrate dt any\ncompute limit all cdem/limit\n"
        "thermo_style custom step c_limit\nthermo_modify format float %.17g\ntimestep ${step}\nrun 1\n",
        tmp_path, discs=discs, hn=0, hs=0, step=fraction * contact,
    )  # fmt: skip
    assert out.thermo["c_limit"][0] == pytest.approx(contact, rel=1e-3)
    warnings = re.findall(WARNING, out.log)
    assert len(warnings) == (fraction > 1)
    if warnings:
        assert float(warnings[0][1]) == pytest.approx(contact, rel=1e-3)


def test_warned_once_when_contacts_close(tmp_path: Path) -> None:
    """Grains that do not touch at first are pressed together by the lid; they chatter, so the look at them at one step
    or another finds enough contacts."""
    status, output = box(tmp_path, fraction=1.4, steps=16000, hn=0.05, hs=0.05)
    assert status == 0, output[-1500:]
    steps = [int(step) for step, _ in re.findall(WARNING, output)]
    assert len(steps) == 1 and steps[0] in (5000, 10000, 15000)


def test_the_limit_of_contacts_is_the_same_for_any_number_of_ranks(tmp_path: Path) -> None:
    limits = []
    for ranks in (1, 2, 4):
        status, output = box(tmp_path / str(ranks), ranks=ranks, fraction=0.5, steps=300)
        assert status == 0, output[-1500:]
        limits.append(re.findall(r"^ +\d+ +(\d\S+) *$", output, re.MULTILINE))
    assert len(limits[0]) > 30 and len(set(limits[0])) > 5  # while nothing touches there is none
    assert limits[1] == limits[0] and limits[2] == limits[0]


@pytest.mark.parametrize(("walls", "warns"), [(6, False), (24, True)])
def test_a_large_grain_among_many_small_walls_is_warned_of(tmp_path: Path, walls: int, warns: bool) -> None:
    """n contacts all around hold a grain by n/2 (kn + ks) in any direction, more than the 6.75 kn of the scene's limit if n
    is 11 or more."""
    large, small = 8e-3, 1e-3
    ring = large + small - 1e-5
    angles = [2 * math.pi * k / walls for k in range(walls)]
    discs = [Disc(0, 0, 2 * large)]
    discs += [Disc(ring * math.cos(a), ring * math.sin(a), 2 * small, type=2) for a in angles]
    deck = "include ${decks}/start.in\nfix move grains cdem/integrate dt ${rule}\nrun 1\n"
    assert bool(re.search(WARNING, run(deck, tmp_path, discs=discs, rule="auto").log)) == warns
    assert not re.search(WARNING, run(deck, tmp_path, discs=discs, rule="contacts").log)
