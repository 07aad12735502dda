# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes at the edge of what a deck can ask for: boxes, neighbour lists and ranks that LAMMPS allows. What can't be done
right is refused, see test_bad_input.py; the rest changes no bit, or has a closed form."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import DECKS, Disc, Run, run, same_bits, start
from scenes import both_laws, lattice, mini_box

MINI_BOX = (DECKS / "mini_box.in").read_text()
START = "include ${decks}/start.in\n"
END = "include ${decks}/end.in\n"


# --- how LAMMPS keeps its atoms -----------------------------------------------------------------------------------------

KEPT = {
    "balance": "comm_style tiled\nfix even all balance 50 1.0 rcb\n",
    "sort": "atom_modify sort 10 0.002\n",
    "multi": "neighbor ${skin} multi\ncomm_modify mode multi\n",
    "nsq": "neighbor ${skin} nsq\n",
    "far ghosts": "comm_modify cutoff 0.05\n",
    "restart files": "restart 333 a.restart b.restart\n",
}


def mini(directory: Path, more: str, **options: Any) -> Run:
    discs, box = mini_box()
    deck = MINI_BOX.replace("fix        lid", more + "fix        lid", 1)
    return run(deck, directory, discs=discs, box=box, style="verlet/cdem", **options)


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return mini(tmp_path_factory.mktemp("plain"), "")


@pytest.mark.parametrize("kept", KEPT)
def test_however_lammps_keeps_its_atoms(tmp_path: Path, kept: str, plain: Run) -> None:
    """Grains that another fix moves to another rank take their contacts along, and so on: the same bits. (The `shift` of
    balance is another matter: it takes all coordinates to shares of the box and back, which rounds them.)"""
    out = mini(tmp_path, KEPT[kept], ranks=2 if kept == "balance" else 1)
    assert same_bits(plain.end, out.end)


def test_balance_moves_grains_in_contact(tmp_path: Path) -> None:
    """That the case above is worth it."""
    deck = KEPT["balance"] + "dump ranks grains custom 50 ranks.dump id proc fx\ndump_modify ranks sort id\n"
    out = mini(tmp_path, deck, ranks=2)
    proc, touching = out.series("ranks.dump", "proc"), out.series("ranks.dump", "fx") != 0
    assert np.count_nonzero((proc[1:] != proc[:-1]) & touching[1:] & touching[:-1]) > 10


# --- many runs, and none --------------------------------------------------------------------------------------------


def test_one_run_in_many(tmp_path: Path) -> None:
    """Cut into runs of any length, some of no step, and after `clear` all over again: the same bits."""
    discs, box = mini_box()
    runs = (
        "run 0\n" * 3
        + "run 1\nrun 0\n" * 5
        + "run 95 every 7 NULL\nrun 0\nrun 7400 post no\nrun 7600 upto\nrun 8000 upto pre no\n"
    )
    begin = START + "group lid type 3\nfix move grains cdem/integrate gravity 0 -1000\ntimestep 2e-7\n"
    begin += "fix lid lid cdem/lid stress 4e5 width 0.032 thickness 0.01\n"
    whole = run(begin + "run 8000\n" + END, tmp_path / "whole", discs=discs, box=box)
    again = "variable state delete\nclear\n" + begin + "run 8000\n" + END
    cut = run(begin + runs + "variable state index cut.dump\n" + END + again, tmp_path / "cut", discs=discs, box=box)
    assert np.count_nonzero(whole.end["tqz"]) > 10  # grains still roll
    assert same_bits(whole.end, cut.dump("cut.dump")[0]) and same_bits(whole.end, cut.end)


EMPTY = """
units         si
dimension     2
boundary      p f p
processors    ${px} ${py} 1
atom_style    sphere
newton        off
comm_modify   vel yes
region        box block -0.02 0.02 -0.02 0.02 -0.5 0.5
create_box    2 box
cdem/create   2 row -0.018 -0.015 0.018 -0.015 10 diameter 0.004 density 26.5
group         grains empty
group         walls type 2
neighbor      0.001 bin
run_style     verlet/cdem
pair_style    cdem law ${law}
pair_coeff    * * 1e8 2.5e7 0.215 0.215 27
compute       e all cdem/energy
compute       t all cdem/trm
compute       c all cdem/contacts
compute       d all cdem/discs
dump          c all local 10 c.dump c_c[*]
dump          d all local 10 d.dump c_d[*]
thermo        10
"""


@both_laws
def test_a_box_without_grains(tmp_path: Path, law: str, ranks: int) -> None:
    """Walls alone stay where they are, and feel nothing; grains may come between two runs."""
    deck = EMPTY + "thermo_style custom step c_e c_t pe press\nfix move grains cdem/integrate gravity 0 -10\n"
    deck += "fix walls walls cdem/move speed 0\ntimestep 2e-7\nrun 100\n"
    deck += "cdem/create 1 fill 3 region -0.01 0.01 0 0.01 diameter 0.002 0.004 power 0 density 26.5 seed 1\n"
    deck += "group grains type 1\nrun 1000\n" + END
    out = run(deck, tmp_path, law=law, ranks=ranks)
    assert [len(frame["c_c[1]"]) for frame in out.dump("c.dump")] == [0] * len(out.dump("c.dump"))
    free = out.end["type"] == 1
    assert np.count_nonzero(free) == 3
    assert out.end["vy"][free] == pytest.approx(np.full(3, -10 * 1000 * 2e-7), rel=1e-12)


def test_grains_poured_into_a_box_without(tmp_path: Path) -> None:
    """fix pour brings them in the middle of a run, close to the wall; each falls freely from then on."""
    deck = (
        EMPTY
        + """
    group grains type 1
    neighbor 0.006 bin
    region top block -0.016 0.016 -0.0119 -0.0094 -0.5 0.5
    fix weight all gravity 10 vector 0 -1 0
    fix move grains cdem/integrate dt any
    fix pour grains pour 3 1 4711 region top diam one 0.002 dens 2e4 2e4 vel 0 0 -0.1
    timestep 2e-8
    dump g all custom 1000 g.dump id type vy
    dump_modify g sort id format float %.17g
    run 3000
    """
    )
    frames = run(deck, tmp_path, law="direct").dump("g.dump")
    speeds = [frame["vy"][frame["type"] == 1] for frame in frames]
    assert [len(v) for v in speeds[1:]] == [3, 3, 3]
    assert speeds[3] - speeds[1] == pytest.approx(np.full(3, -10 * 2000 * 2e-8), rel=1e-9)


@both_laws
def test_a_grain_alone(tmp_path: Path, law: str, ranks: int) -> None:
    """It crosses all borders of box and ranks, some ranks have nothing, and keeps its velocity and spin to the bit."""
    grain = Disc(-0.015, -0.015, vx=3, vy=4, omega=70)
    deck = START + "fix move grains cdem/integrate\ntimestep 2e-7\nrun 100000\n" + END
    end = run(deck, tmp_path, discs=[grain], law=law, ranks=ranks, bx="p", by="p").end
    assert [end["vx"][0], end["vy"][0], end["omegaz"][0]] == [3, 4, 70]
    gone = [end["x"][0] + 0.015 - 3 * 0.02, end["y"][0] + 0.015 - 4 * 0.02]
    assert [np.remainder(g + 0.02, 0.04) - 0.02 for g in gone] == pytest.approx([0, 0], abs=1e-10)


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
@pytest.mark.parametrize("instructions", ["baseline", "avx2", "avx512"])
def test_instructions(tmp_path: Path, law: str, style: str, instructions: str) -> None:
    """Those without fused multiply-add have other last bits, no more: 2e-16 of coordinates of 0.01 m, in forces of
    1e8 N/m, are 2e-10 N; over 50 steps of a collision in progress this stays below 1e-8 of the forces."""
    if instructions != "baseline" and instructions not in Path("/proc/cpuinfo").read_text():
        pytest.skip(f"no {instructions} here")
    discs = [Disc(-1.99e-3, 0, vx=5, omega=50), Disc(1.99e-3, 1e-4, vx=-5, vy=1), Disc(5.9e-3, -1e-4, 3.8e-3, vx=-2)]
    deck = (
        START
        + "pair_style cdem law ${law} instructions ${instructions}\npair_coeff * * ${kn} ${ks} ${hn} ${hs} ${phi}\n"
    )
    deck += "fix move grains cdem/integrate\ntimestep 2e-8\nrun 50\n" + END
    ends = {
        i: run(deck, tmp_path / i, discs=discs, law=law, style=style, instructions=i).end
        for i in ("baseline", instructions)
    }
    for column in ("fx", "fy", "tqz", "vx", "vy", "omegaz"):
        scale = np.abs(ends["baseline"][column]).max()
        assert ends[instructions][column] == pytest.approx(ends["baseline"][column], abs=1e-8 * scale)


# --- boxes ----------------------------------------------------------------------------------------------------------

MOVE = "fix move grains cdem/integrate\ntimestep 1e-7\nthermo 100\nthermo_modify format float %.17g\n"


@both_laws
def test_tilted_box(tmp_path: Path, law: str, ranks: int) -> None:
    """A lattice whose periods are tilted by one lattice constant is the same lattice."""
    discs, box = lattice(6, 6, 1e-5)
    tilt = f"change_box all triclinic\nchange_box all xy final {(box[1] - box[0]) / 6:.17g}\n"
    deck = START + tilt + MOVE + "run 100\n" + END
    out = run(deck, tmp_path, discs=discs, box=box, bx="p", by="p", law=law, ranks=ranks)
    assert out.thermo["E_pair"] == pytest.approx(3 * len(discs) * 0.5 * 1e8 * 1e-5**2, rel=1e-9)
    force = 1e8 * 1e-5
    assert np.abs([out.end["fx"], out.end["fy"]]).max() < 1e-9 * force


FLOWS = {  # fix deform, and the velocity gradient of its flow, dvx/dx dvx/dy dvy/dy (1/s)
    "squeeze": ("x erate -100 y erate 50", (-100, 0, 50)),
    "shear": ("xy erate 80", (0, 80, 0)),
}


@pytest.mark.parametrize("flow", FLOWS)
@both_laws
def test_deforming_box(tmp_path: Path, law: str, ranks: int, flow: str) -> None:
    """A lattice that flows with its box: every grain is in the place of every other, so no force acts on any, dashpots
    and all, nor at the borders of the box. Tolerance: LAMMPS's box is a step behind the grains, by 1e-7 m or less; the
    dashpots across a border that did not know of the flow would have 55 kg/s x 2 m/s = 100 N."""
    discs, box = lattice(6, 6, 1e-5)
    deform, (xx, xy, yy) = FLOWS[flow]
    discs = [replace(d, vx=xx * d.x + xy * d.y, vy=yy * d.y) for d in discs]
    deck = START + f"change_box all triclinic\nfix flow all deform 1 {deform} remap v\n" + MOVE
    deck += "timestep 2e-8\nrun 1000\n" + END
    out = run(deck, tmp_path, discs=discs, box=box, bx="p", by="p", law=law, ranks=ranks)
    assert abs(out.thermo["E_pair"][-1] / out.thermo["E_pair"][0] - 1) > 0.01  # it did deform
    behind = 2e-8 * 100 * box[1]
    assert np.abs([out.end["fx"], out.end["fy"]]).max() < 2 * 1e8 * behind


DEFORM = """
velocity grains set 0 1e-3 0
fix flow all deform 10 x erate -10 remap none
fix move grains cdem/integrate dt any
timestep 2e-7
run 14000
"""


def test_a_box_that_is_deformed_now_and_then(tmp_path: Path, ranks: int) -> None:
    """Grains stand still, and their images come nearer by 0.028 x 40 mm: these touch after 0.8 mm, and push them together."""
    discs = [Disc(-0.0176, 0), Disc(0.0176, 0)]
    smooth: dict[str, Any] = {"hn": 0, "hs": 0, "ks": 0, "phi": 0}
    ways = [
        float(np.ptp(run(START + DEFORM + END, tmp_path / style.replace("/", "_"), discs=discs, ranks=ranks, style=style,
                         bx="p", skin=2e-4, **smooth).end["x"]))
        for style in ("verlet", "verlet/cdem")
    ]  # fmt: skip
    assert ways[0] == ways[1] < 0.9999 * 0.0352


def test_a_grain_in_the_tip_of_a_tilted_box_is_inside(tmp_path: Path) -> None:
    deck = """
units si
dimension 2
boundary f p p
atom_style sphere
newton off
comm_modify vel yes
region box prism 0 0.1 0 0.1 -0.005 0.005 0.04 0 0
create_box 1 box
cdem/create 1 row 0.12 0.08 0.12 0.08 1 diameter 0.004 density 26.5
pair_style cdem law direct
pair_coeff * * 1e6 0 0 0 0
fix move all cdem/integrate dt auto
neighbor 4e-4 bin
neigh_modify delay 0 every 1 check no
MORE
run 10
print "n = $(count(all))"
"""
    assert run(deck.replace("MORE", ""), tmp_path / "inside").printed("n") == 1  # there x is from 0.032 to 0.132
    status, output = start(deck.replace("MORE", "velocity all set 10 0 0\nrun 2000"), tmp_path / "gone")
    assert status != 0 and "atom 1 has left the box" in output
