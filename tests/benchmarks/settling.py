# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds that move under gravity: error of the whole bed against the time a run takes.

Of the bed, kinetic energy and height of the centre of mass are followed, and compared with a run of the same engine
with a step so small that its own error hardly counts: the engines damp walls and unequal pairs differently. Every
contact that opens or closes multiplies errors, in all engines, so only the time is compared in which the references
still agree with runs of twice their step.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from cases import AREAL_DENSITY, SMALL, pack
from check import section
from engines import CDEM, HERE, LIGGGHTS, STOCK, Job

Array = np.ndarray[Any, np.dtype[np.float64]]
DECKS = {CDEM: "cdem.in", STOCK: "stock.in", LIGGGHTS: "liggghts.in"}
ROWS = 200  # of output
LEVELS = (6, 8, 12, 20, 40, 80)  # steps that the shortest contact lasts
CHECK, REFERENCE = 320, 640
AGREEMENT = 3e-4  # of kinetic energy between these two, over the greatest

COLUMNS, LAYERS = 20, 25
PITCH = 0.005  # m, of the grid from which discs fall
SMALLEST, LARGEST = 0.002, 0.004  # their diameters, m


@dataclass(frozen=True)
class Scene:
    """Discs (with their walls, in what `make` writes) and what becomes of them; SI units."""

    make: Callable[[Path, Path], None]  # data file, folder where beds are kept
    discs: int
    smallest: float  # diameter
    kn: float
    gravity: float
    seconds: float
    skin: float
    look: int  # steps between two looks at the neighbour list

    @property
    def shortest(self) -> float:
        """Duration of an undamped contact of the smallest discs, s."""
        return math.pi * math.sqrt(AREAL_DENSITY * math.pi * self.smallest**2 / 8 / self.kn)

    def job(self, engine: str, level: int, data: Path) -> Job:
        """The run with a number of steps for the shortest contact."""
        every = math.ceil(self.seconds / ROWS / self.shortest * level)
        steps = every * ROWS
        material = {"kn": self.kn, "ks": self.kn / 4, "gravity": self.gravity}
        run = {"steps": steps, "every": every, "dt": repr(self.seconds / steps), "skin": self.skin, "look": self.look}
        return Job(engine, HERE / DECKS[engine], {"decks": HERE, "data": data, **material, **run}, steps, self.discs)


def write_falling(data: Path, _: Path) -> None:
    """Discs of any size between the limits, on a grid but for some chance, above a floor and between sides."""
    random = np.random.default_rng(1)
    column, layer = np.meshgrid(np.arange(COLUMNS), np.arange(LAYERS))
    places = PITCH * (np.column_stack([column.ravel(), layer.ravel()]) + 0.5)
    places += random.uniform(-1, 1, places.shape) * (PITCH - LARGEST) / 2
    diameters = random.uniform(SMALLEST, LARGEST, len(places))
    width, height = PITCH * COLUMNS, PITCH * LAYERS
    across, up = (np.arange(length / SMALLEST) * SMALLEST + SMALLEST / 2 for length in (width, height))
    floor = np.column_stack([across, np.full_like(across, -SMALLEST / 2)])
    left = np.column_stack([np.full_like(up, -SMALLEST / 2), up])
    walls = np.concatenate([floor, left, left + [width + SMALLEST, 0]])
    kind = np.append(np.ones(len(places)), np.full(len(walls), 2))
    write_atoms(data, kind, np.append(diameters, np.full(len(walls), SMALLEST)), np.concatenate([places, walls]))


def write_released(data: Path, beds: Path) -> None:
    """A bed packed under 100 kPa, without the lid that pressed on it."""
    atoms = section(pack(SMALL, beds) / "bed.data", "Atoms", 7)
    kind, diameter, x = atoms[:, 1], atoms[:, 2], atoms[:, 4:6]
    grains = x[kind == 1]
    lid = (kind == 2) & (x[:, 1] > grains[:, 1].max()) & (x[:, 0] > grains[:, 0].min()) & (x[:, 0] < grains[:, 0].max())
    write_atoms(data, kind[~lid], diameter[~lid], x[~lid])


def write_atoms(data: Path, kind: Array, diameter: Array, x: Array) -> None:
    """The data file of discs (kind 1) and wall discs (kind 2)."""
    density = AREAL_DENSITY * 3 / (2 * diameter)  # of a sphere with the mass of the disc
    atoms = [
        f"{i} {k:.0f} {d:.17g} {rho:.17g} {place[0]:.17g} {place[1]:.17g} 0"
        for i, (k, d, rho, place) in enumerate(zip(kind, diameter, density, x, strict=True), 1)
    ]
    low, high = x.min(axis=0) - 0.01, x.max(axis=0) + 0.05
    box = f"{low[0]} {high[0]} xlo xhi\n{low[1]} {high[1]} ylo yhi\n-0.01 0.01 zlo zhi"
    data.write_text(f"discs\n\n{len(x)} atoms\n2 atom types\n\n{box}\n\nAtoms\n\n" + "\n".join(atoms) + "\n")


SCENES = {
    "fall": Scene(write_falling, COLUMNS * LAYERS, SMALLEST, 1e5, 9.81, 0.06, 5e-4, 5),
    "release": Scene(write_released, int(SMALL["n"]), float(SMALL["dmin"]), 1e8, 98.1, 1e-3, 2e-4, 20),
}


@dataclass(frozen=True)
class Motion:
    """Kinetic energy (J) of translation and height (m) of the centre of mass, by row of output."""

    kinetic: Array
    height: Array


def read_motion(output: str) -> Motion:
    """The rows that an engine printed, but for the first: step, kinetic energy, height."""
    rows = re.findall(r"^ *(\d+) +([\d.e+-]+) +([\d.e+-]+) *$", output, re.M)
    table = np.array(rows[-ROWS:], float)
    return Motion(table[:, 1], table[:, 2])


def deviations(motion: Motion, reference: Motion) -> tuple[Array, Array]:
    """By row: of the kinetic energy over the greatest, and of the height over its whole range."""
    kinetic = np.abs(motion.kinetic - reference.kinetic) / reference.kinetic.max()
    return kinetic, np.abs(motion.height - reference.height) / np.ptp(reference.height)


def rows_that_agree(check: Motion, reference: Motion) -> int:
    """Rows before the two part."""
    apart = np.flatnonzero(deviations(check, reference)[0] > AGREEMENT)
    return int(apart[0]) if len(apart) else ROWS


def errors(motion: Motion, reference: Motion, rows: int) -> tuple[float, float]:
    """Root mean square of both deviations over the first rows."""
    kinetic, height = (float(np.sqrt(np.mean(part[:rows] ** 2))) for part in deviations(motion, reference))
    return kinetic, height
