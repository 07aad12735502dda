# SPDX-License-Identifier: GPL-2.0-or-later
"""Proof that the engines simulate the same: small scenes, short runs, what they come to side by side.

Beds: the grains get a push to the right. After 200 steps half of it is used up, by dashpots and sliding contacts, after
2000 nearly all. The state is measured by one code from positions and velocities. Shear: the first 0.04 mm of the direct
shear test, and what each engine says of its walls.

Grains collide, so trajectories part after some 100 steps whatever the engines; only sums and means can agree.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from engines import CDEM, Job, execute, installed
from cases import AREAL_DENSITY, KN, Bed, Scene, Shear

Array = np.ndarray[Any, np.dtype[np.float64]]
PUSH = 0.02  # m/s
BED = Bed({"n": 400, "width": 0.06}, more={"push": PUSH, "state": 1})
CLUMPS = Bed({"n": 200, "width": 0.06, "shape": "triple"}, more={"push": PUSH, "state": 1})
CHECKS: dict[str, Scene] = {
    "bed, 200 steps": replace(BED, disc_steps=200 * BED.discs),
    "bed, 2000 steps": replace(BED, disc_steps=2000 * BED.discs),
    "clumps, 200 steps": replace(CLUMPS, disc_steps=200 * CLUMPS.discs),
    "clumps, 2000 steps": replace(CLUMPS, disc_steps=2000 * CLUMPS.discs),
    "shear": Shear(travel=0.04),
}

# Largest relative deviation of a peer from ours. With 10 % more stiffness, half the damping or 22 instead of 27 degrees of
# friction in a peer, at least one of them is exceeded.
TOLERANCES = {
    # Sums over all contacts, of which one in a hundred opens or closes by chance. A contact that has just closed counts
    # as one more in the mean, while the spring energy hardly knows it: two clump beds gave 0.002 and 0.011, and 0.003 and
    # 0.004 in energy.
    "mean overlap (m)": 0.015,
    "spring energy (J)": 0.01,
    # A wall has some 20 contacts: a grain that comes to rest elsewhere moves the sum by some per cent. The push is
    # against the sides.
    "floor (N)": 0.03,
    "lid (N)": 0.03,
    "left side (N)": 0.08,
    "right side (N)": 0.08,
    # The peers damp all pairs at the mean grain's rate, and LAMMPS gives clumps too much inertia (together up to 0.04). Our
    # dashpots are weaker by up to 0.04, since steps would damp too much (mass_of_steps); theirs are not.
    "used up of the push (%)": 0.08,
    # Means over 0.04 mm, in which some contacts slip earlier or later; the lid rises by 4 micrometres.
    "shear stress (kPa)": 0.02,
    "shear stress, upper half (kPa)": 0.02,
    "rise of the lid (mm)": 0.06,
    # Set by the load; what deviates is the lid's vibration.
    "normal stress (kPa)": 1e-3,
}


@dataclass(frozen=True)
class Comparison:
    """A quantity of a scene, of ours and of a peer."""

    scene: str
    quantity: str
    peer: str
    ours: float
    theirs: float

    @property
    def deviation(self) -> float:
        """Relative to ours."""
        return abs(self.theirs / self.ours - 1)

    @property
    def agrees(self) -> bool:
        """Whether it is within the tolerance."""
        return self.deviation <= TOLERANCES[self.quantity]


def compare(name: str, beds: Path, work: Path) -> list[Comparison]:
    """Runs a scene with every installed engine and compares each peer with ours."""
    found: dict[str, dict[str, float]] = {}
    scene = CHECKS[name]
    for job in scene.jobs(beds, 1):
        if installed(job.engine):
            folder = work / f"{name}, {job.engine}"
            execute(job, folder)
            found[job.engine] = bed(read_discs(job, folder)) if isinstance(scene, Bed) else shear(folder)
    ours = found.pop(CDEM)
    return [
        Comparison(name, quantity, peer, ours[quantity], theirs[quantity])
        for peer, theirs in found.items()
        for quantity in ours
    ]


def shear(folder: Path) -> dict[str, float]:
    """Means over the rows of shear.dat, and the height of the lid at the end."""
    lines = (folder / "shear.dat").read_text().splitlines()
    names = [
        name.removeprefix("v_") for name in [line for line in lines if line.startswith("#")][-1].lstrip("# ").split()
    ]
    table = dict(zip(names, np.loadtxt(lines, ndmin=2).T))
    return {
        "shear stress (kPa)": table["tau_kPa"].mean(),
        "shear stress, upper half (kPa)": table["tau_upper_kPa"].mean(),
        "normal stress (kPa)": table["sigma_kPa"].mean(),
        "rise of the lid (mm)": table["lid_mm"][-1],
    }


@dataclass(frozen=True)
class Discs:
    """All discs of a bed; a grain's discs share its number, wall discs have 0."""

    grain: Array
    x: Array  # (discs, 2), m
    r: Array
    v: Array  # (discs, 2), m/s
    omega: Array


def read_discs(job: Job, folder: Path) -> Discs:
    """The discs of state.data, or of state.discs if grains are of several."""
    atoms = section(folder / "state.data", "Atoms", 7)
    speeds = section(folder / "state.data", "Velocities", 7)
    tag, kind = atoms[:, 0], atoms[:, 1]
    state = Discs(np.where(kind == 1, tag, 0), atoms[:, 4:6], atoms[:, 2] / 2, speeds[:, 1:3], speeds[:, 6])
    if job.engine == CDEM:
        rows = np.loadtxt(folder / "state.discs", skiprows=9, ndmin=2)
        of = np.searchsorted(tag, rows[:, 0])
        arm = rows[:, 2:4] - state.x[of]
        turning = state.omega[of, None] * np.column_stack([-arm[:, 1], arm[:, 0]])
        return Discs(state.grain[of], rows[:, 2:4], rows[:, 4], state.v[of] + turning, state.omega[of])
    if job.deck.stem == "stock_rigid":
        body = section(Path(str(job.variables["data"])), "Molecules", 2)[:, 1]
        return replace(state, grain=body)
    return state


def section(data: Path, name: str, columns: int) -> Array:
    """A section of a data file, by id."""
    lines = iter(data.read_text().splitlines())
    next(line for line in lines if line.split("#")[0].strip() == name)
    next(lines)
    rows = itertools.takewhile(str.strip, lines)
    table: Array = np.array([row.split()[:columns] for row in rows], float)
    by_id: Array = table[table[:, 0].argsort()]
    return by_id


def bed(discs: Discs) -> dict[str, float]:
    """Contacts, springs, walls and motion of a bed."""
    gap = discs.x[:, None] - discs.x
    distance = np.hypot(gap[..., 0], gap[..., 1])
    overlap = discs.r[:, None] + discs.r - distance
    free = discs.grain > 0
    touching = (overlap > 0) & (discs.grain[:, None] != discs.grain)  # walls are all of grain 0
    one, other = np.nonzero(np.triu(touching, 1))
    depth = overlap[one, other]

    # normal force of the grains on each wall
    wall, grain = np.nonzero(touching & ~free[:, None] & free)
    push = KN * overlap[wall, grain, None] * gap[wall, grain] / distance[wall, grain, None]
    low, high = discs.x[free].min(axis=0), discs.x[free].max(axis=0)
    x, y = discs.x[wall].T

    mass = AREAL_DENSITY * np.pi * discs.r**2
    motion = mass * (discs.v**2).sum(axis=1) / 2 + mass * discs.r**2 / 4 * discs.omega**2
    given = mass[free].sum() * PUSH**2 / 2
    return {
        "mean overlap (m)": depth.mean(),
        "spring energy (J)": KN / 2 * (depth**2).sum(),
        "floor (N)": -push[y < low[1], 1].sum(),
        "left side (N)": -push[x < low[0], 0].sum(),
        "right side (N)": push[x > high[0], 0].sum(),
        "lid (N)": push[y > high[1], 1].sum(),
        "used up of the push (%)": 100 * (1 - motion[free].sum() / given),
    }
