# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains of several discs (fix cdem/shape): their mass, centre and inertia, the deck's words for them, their contacts."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from engine import DENSITY, Disc, Frame, Run

R = 2e-3  # m, radius of the discs of most clumps here
SQRT3 = math.sqrt(3)
Vector = Sequence[float] | np.ndarray


def cross(a: Vector, b: Vector) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


class Clump:
    """Discs (x, y, r) in m, turned by some degrees; they don't overlap, so mass, centre and inertia are plain sums.
    The template has them in mm and about another origin, which must not matter."""

    def __init__(self, *discs: tuple[float, float, float], turn: float = 0) -> None:
        x, y, self.radii = np.array(discs, dtype=float).T
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        centres = np.array([c * x - s * y, s * x + c * y]).T
        area = math.pi * self.radii**2
        self.area = float(area.sum())
        self.offsets = centres - area @ centres / self.area
        square = (self.offsets**2).sum(axis=1)
        self.mass = DENSITY * self.area
        self.inertia = DENSITY * float(area @ (self.radii**2 / 2 + square))
        self.radius = float((np.sqrt(square) + self.radii).max())  # circumscribed
        numbers = 1e3 * np.column_stack([centres + [4 * R, -7 * R], self.radii]).ravel()
        self.template = f"discs {len(discs)} " + " ".join(f"{number:.17g}" for number in numbers)

    def at(self, x: float, y: float, vx: float = 0, vy: float = 0, omega: float = 0, type: int = 1) -> Disc:
        return Disc(x, y, 2 * self.radius, vx, vy, omega, type)


TRIPLE = Clump((-R, 0, R), (R, 0, R), (0, SQRT3 * R, R))
UNEVEN = Clump((0, 0, R), (1.6 * R, 0, 0.6 * R), turn=-50)  # stands on its small disc
LONG = Clump((0, 0, R), (2 * R, 0, R), (4 * R, 0, R), (0, 2 * R, R), turn=20)
SINGLE = Clump((0, 0, 1.5 * R))


def begin(*shapes: Clump, step: str = "dt check", more: str = "") -> str:
    """Start of a deck: grains of the shapes, as types 1, 3, 4 ...; type 2 are wall discs."""
    types = [1, *range(3, 2 + len(shapes))]
    templates = " ".join(f"type {t} {s.template}" for t, s in zip(types, shapes, strict=True))
    groups = "".join(f"group grains type {t}\n" for t in types)
    return f"""
    include ${{decks}}/start.in
    {groups}
    fix shape grains cdem/shape {templates} type 2 single density ${{density}} {more}
    fix move grains cdem/integrate {step}
    """


END = "include ${decks}/end.in\n"


def dump(every: int, columns: str = "id x y vx vy omegaz f_move[4]") -> str:
    return f"dump grains all custom {every} grains.dump {columns}\ndump_modify grains format float %.17g sort id\n"


FIELDS = "id1 id2 disc1 disc2 fn ft x y nx ny".split()


def dump_contacts(every: int) -> str:
    return f"""
    compute contacts all cdem/contacts {" ".join(FIELDS)}
    dump contacts all local {every} contacts.dump c_contacts[*]
    dump_modify contacts format float %.17g
    """


def contacts(done: Run) -> list[Frame]:
    """The contacts of every frame, with the fields as columns, in order of grains and discs."""
    frames = []
    for frame in done.dump("contacts.dump"):
        columns = dict(zip(FIELDS, frame.columns.values(), strict=True))
        order = np.lexsort([columns[name] for name in ("disc2", "disc1", "id2", "id1")])
        frames.append(Frame(frame.step, {name: column[order] for name, column in columns.items()}))
    return frames
