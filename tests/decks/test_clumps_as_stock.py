# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains of several discs against the rigid bodies of stock LAMMPS."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from clumps import END, LONG, TRIPLE, Clump, begin
from engine import DENSITY, Disc, run

STOCK = """
units si
dimension 2
boundary f f p
atom_style sphere
newton off
comm_modify vel yes
read_data discs.data
set group all density/disc ${density}
neighbor 0.001 bin
neigh_modify delay 0 every 1 check yes
include bodies.in
pair_style gran/hooke ${kn} NULL 0 NULL 0 0
pair_coeff * *
timestep ${dt}
dump discs all custom ${every} discs.dump id x y
dump_modify discs sort id format float %.17g
thermo_style custom step atoms
run ${steps}
"""
OURS = """
timestep ${dt}
compute discs all cdem/discs
dump discs all local ${every} discs.dump c_discs[*]
dump_modify discs format float %.17g
run ${steps}
"""


def rigid_bodies(directory: Path, grains: Sequence[Disc], shapes: Sequence[Clump]) -> list[Disc]:
    """The discs of the grains; writes how stock LAMMPS joins them to bodies, and the bodies' properties."""
    discs: list[Disc] = []
    commands, bodies = [], []
    for k, (grain, shape) in enumerate(zip(grains, shapes, strict=True), 1):
        commands += [f"group b{k} id {len(discs) + 1}:{len(discs) + len(shape.radii)}"]
        commands += [f"neigh_modify exclude group b{k} b{k}"]
        discs += [Disc(grain.x + x, grain.y + y, 2 * r) for (x, y), r in zip(shape.offsets, shape.radii, strict=True)]
        i = shape.inertia
        numbers = [shape.mass, grain.x, grain.y, 0]
        numbers += [i / 2, i / 2, i, 0, 0, 0]  # of a thin body: xx yy zz xy xz yz
        numbers += [grain.vx, grain.vy, 0, 0, 0, i * grain.omega]  # velocity, angular momentum
        bodies.append(" ".join([str(k), *(f"{number:.17g}" for number in numbers), "0 0 0"]))
    names = " ".join(f"b{k}" for k in range(1, len(grains) + 1))
    commands += [f"fix move all rigid group {len(grains)} {names} infile bodies.txt"]
    directory.mkdir()
    (directory / "bodies.in").write_text("\n".join(commands) + "\n")
    (directory / "bodies.txt").write_text("\n".join([str(len(grains)), *bodies]) + "\n")
    return discs


def test_as_stock_fix_rigid(tmp_path: Path) -> None:
    """Nine grains collide, smooth and without loss: stock LAMMPS has the same normal force (gran/hooke), and moves them
    the same way (fix rigid) if it is given mass, centre and inertia of the bodies, here by the plain sums of Clump.
    Every grain is hit, most of them several times. Places agree to 1e-13 m before the first hit and to 1e-11 m at the
    end, after 2.4 ms; by then they part by a factor of 10 a ms, as chaotic trajectories do."""
    random = np.random.default_rng(3)
    shapes = [(TRIPLE, LONG)[k % 2] for k in range(9)]
    grains = []
    for k, shape in enumerate(shapes):
        x, y = 0.013 * (k % 3 - 1), 0.013 * (k // 3 - 1)
        vx, vy, omega = random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-300, 300)
        grains.append(shape.at(x, y, vx - 200 * x, vy - 200 * y, omega, type=(1, 3)[k % 2]))
    options: dict[str, Any] = {
        "box": (-0.05, 0.05, -0.05, 0.05), "density": DENSITY, "kn": 1e8, "dt": 2e-7, "steps": 12000, "every": 200,
    }  # fmt: skip

    deck = begin(TRIPLE, LONG, step="dt any") + OURS + END
    ours = run(deck, tmp_path / "ours", discs=grains, hn=0, hs=0, phi=0, **options)
    assert (ours.end["omegaz"] != [grain.omega for grain in grains]).all()
    stock = run(STOCK, tmp_path / "stock", discs=rigid_bodies(tmp_path / "stock", grains, shapes), **options)
    apart = []
    for frame, stock_frame in zip(ours.dump("discs.dump"), stock.dump("discs.dump"), strict=True):
        ids, numbers, xs, ys, *_ = frame.columns.values()
        order = np.lexsort([numbers, ids])
        apart.append(max(np.abs(xs[order] - stock_frame["x"]).max(), np.abs(ys[order] - stock_frame["y"]).max()))
    assert len(apart) == 61
    assert max(apart[:15]) < 1e-13
    assert max(apart) < 1e-10
