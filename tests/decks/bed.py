# SPDX-License-Identifier: GPL-2.0-or-later
"""A small bed of grains in a box with floor and lid, that of mini_box.in; wall types 2 sides, 3 lid, 4 floor."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from engine import Disc, Run, Table, run
from scenes import mini_box

STRESS, WIDTH, THICKNESS = 4e5, 0.032, 0.01
LOAD = STRESS * WIDTH * THICKNESS  # N
G = 1000.0
DT = 2e-7

BED = f"""
include ${{decks}}/start.in
group lid type 3
group floor type 4
fix move grains cdem/integrate gravity 0 -{G}
fix lid lid cdem/lid stress {STRESS} width {WIDTH} thickness {THICKNESS} vmax 100
fix floor floor cdem/move speed 0
timestep {DT}
compute e all cdem/energy
variable fall atom mass*{G}*y
compute height grains reduce sum v_fall
thermo_style custom step c_e c_height f_lid[2] f_lid[3] f_lid[4] f_floor[1] f_floor[3]
thermo_modify format float %.17g lost error
"""


def bed(lid_up: float = 0) -> list[Disc]:
    discs, _ = mini_box()
    return [replace(d, y=d.y + lid_up) if d.type == 3 else d for d in discs]


def run_bed(deck: str, directory: Path, lid_up: float = 0, **options: Any) -> Run:
    return run(BED + deck, directory, discs=bed(lid_up), box=(-0.03, 0.03, -0.03, 0.03), **options)


def energy(thermo: Table) -> np.ndarray:
    """Of motion, springs, and the weights of grains and lid."""
    return thermo["c_e"] + thermo["c_height"] + LOAD * thermo["f_lid[3]"]
