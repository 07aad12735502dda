# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that more than one test uses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from engine import Disc, Frame

Box = tuple[float, float, float, float]

# Of law and number of ranks: both laws, and more than one rank, for cases about neither.
both_laws = pytest.mark.parametrize(("law", "ranks"), [("direct", 1), ("incremental", 1), ("direct", 4)])


def lattice(nx: int, ny: int, overlap: float, speed: float = 0, seed: int = 1) -> tuple[list[Disc], Box]:
    """Triangular lattice that fills a periodic box (ny even); every disc has six contacts. Velocities are random."""
    random = np.random.default_rng(seed)
    d = Disc(0, 0).diameter
    a, b = d - overlap, (d - overlap) * math.sqrt(3) / 2
    discs = []
    for j in range(ny):
        for i in range(nx):
            vx, vy, spin = random.uniform(-speed, speed, 3)
            discs.append(Disc((i + 0.25 + 0.5 * (j % 2)) * a, (j + 0.5) * b, vx=vx, vy=vy, omega=spin / d))
    return discs, (0, nx * a, 0, ny * b)


def cloud(n: int, speed: float, seed: int = 1) -> list[Disc]:
    """n x n discs of many sizes, not touching, that fly towards the origin with random velocities and spins."""
    random = np.random.default_rng(seed)
    pitch = 4.2e-3
    discs = []
    for i in range(n):
        for j in range(n):
            x, y = pitch * (i - (n - 1) / 2), pitch * (j - (n - 1) / 2)
            vx, vy, spin = random.uniform(-speed, speed, 3)
            inward = 2 * speed / (n * pitch)
            discs.append(Disc(x, y, random.uniform(2e-3, 4e-3), vx - inward * x, vy - inward * y, spin / 1e-3))
    return discs


def shifted(discs: list[Disc], dx: float, dy: float = 0) -> list[Disc]:
    return [replace(d, x=d.x + dx, y=d.y + dy) for d in discs]


def mini_box(seed: int = 1) -> tuple[list[Disc], Box]:
    """Seven rows of grains, packed but not touching, with random velocities, between a floor (type 4), sides (2) and a
    lid (3) of discs. See mini_box.in."""
    random = np.random.default_rng(seed)
    d, rows, columns = 4e-3, 7, 8
    pitch = d * math.sqrt(3) / 2
    half = columns * d / 2  # of the inner width
    bottom, top = -0.01225, -0.01225 + d + (rows - 1) * pitch
    discs = []
    for j in range(rows):
        for i in range(columns - j % 2):
            x, y = (i + 0.5 + 0.5 * (j % 2)) * d - half, bottom + d / 2 + j * pitch
            vx, vy, spin = random.uniform(-1, 1, 3)
            discs.append(Disc(x, y, random.uniform(0.99, 1) * d, vx, vy, spin / d))
    for i in range(columns + 1):
        x = i * d - half
        discs += [Disc(x, bottom - d / 2, d, type=4), Disc(x, top + d / 2, d, type=3)]
    for j in range(-1, rows + 1):
        discs += [Disc(side * (half + d / 2), bottom + j * d, d, type=2) for side in (-1, 1)]
    return discs, (-0.03, 0.03, -0.03, 0.03)


def oblique_pairs(sines: Sequence[float], phases: int, speed: float, dt: float) -> tuple[list[Disc], Box]:
    """Discs that fly along x at others at rest, one pair above the other: `phases` for each sine of the angle between
    approach and normal, which touch at different fractions of a time step. Of pair k the ids are 2 k + 1 and 2 k + 2.
    """
    d = Disc(0, 0).diameter
    discs: list[Disc] = []
    for sine in sines:
        for phase in range(phases):
            y, gap = 1.5 * d * len(discs), speed * dt * (phase + 0.5) / phases
            discs += [Disc(0, y), Disc(-d * math.sqrt(1 - sine**2) - gap, y + d * sine, vx=speed)]
    return discs, (-0.02, 0.02, -2 * d, discs[-1].y + 2 * d)


def circling(speed: float, pull: float, stiffness: float) -> list[Disc]:
    """A disc that circles a fixed one, which pulls it (orbit.in), with the overlap at which the contact is in balance."""
    disc = Disc(0, 0)
    overlap = (pull - disc.mass * speed**2 / disc.diameter) / stiffness
    return [Disc(disc.diameter - overlap, 0, vy=speed), Disc(0, 0, type=2)]


def kinetic_energy(state: Frame) -> float:
    """Of translation and rotation; the frame has mass, radius, vx, vy and omegaz."""
    m, r = state["mass"], state["radius"]
    return 0.5 * float(np.sum(m * (state["vx"] ** 2 + state["vy"] ** 2) + m * r**2 / 2 * state["omegaz"] ** 2))
