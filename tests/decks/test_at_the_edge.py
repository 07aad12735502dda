# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes at the edge of what a deck can ask for: boxes, neighbour lists and ranks that LAMMPS allows. What can't be done
right is refused, see test_bad_input.py; the rest changes no bit, or has a closed form."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from engine import DECKS, Disc, Run, run, same_bits, start
from scenes import kinetic_energy, lattice, mini_box

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


def mini(directory: Path, more: str, **options: object) -> Run:
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


# --- boxes ----------------------------------------------------------------------------------------------------------

MOVE = "fix move grains cdem/integrate\ntimestep 1e-7\nthermo 100\nthermo_modify format float %.17g\n"


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
