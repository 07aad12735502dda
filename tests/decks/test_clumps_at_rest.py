# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains of several discs at rest, on a floor and on each other: the statics of rigid bodies on springs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from clumps import R, SQRT3, TRIPLE, Clump, Vector, begin, contacts, cross, dump_contacts
from engine import Disc, Frame, run
from scenes import both_laws

# Grains of the triangular lattice of touching discs, set down where they just touch. Under a load they sink by 1e-6 of
# a diameter, so the linear statics of rigid bodies on springs gives every contact force, to that accuracy.


class Springs:
    """Rigid bodies on linear springs at the contacts; bodies of fixed discs don't move."""

    def __init__(self, bodies: dict[int, tuple[float, float]], frame: Frame, kn: float, ks: float) -> None:
        """The bodies that move, by id, with their centres; the contacts as compute cdem/contacts has them."""
        self.kn, self.ks = kn, ks
        column = {body: 3 * k for k, body in enumerate(bodies)}
        self.n, self.t = np.zeros((2, len(frame["id1"]), 3 * len(bodies)))
        for k in range(len(frame["id1"])):
            point, normal = (np.array([frame[a][k], frame[b][k]]) for a, b in (("x", "y"), ("nx", "ny")))
            tangent = np.array([-normal[1], normal[0]])
            for body, sign in ((frame["id1"][k], 1), (frame["id2"][k], -1)):
                if body in column:
                    arm, c = point - bodies[body], column[body]
                    self.n[k, c : c + 3] = sign * np.array([*normal, cross(arm, normal)])
                    self.t[k, c : c + 3] = sign * np.array([*tangent, cross(arm, tangent)])

    def forces(self, load: Vector) -> tuple[np.ndarray, np.ndarray]:
        """Normal and tangential forces of the contacts under the load (fx, fy, torque of each body)."""
        u = np.linalg.solve(self.kn * self.n.T @ self.n + self.ks * self.t.T @ self.t, load)
        return -self.kn * self.n @ u, -self.ks * self.t @ u


G = 1000.0  # m/s^2
UPRIGHT = TRIPLE
HANGING = Clump((-R, 0, R), (R, 0, R), (0, -SQRT3 * R, R))


def row(y: int, *places: int) -> list[Disc]:
    return [Disc(R * x, SQRT3 * R * y, 2 * R, type=2) for x in places]


def settle(degrees: float) -> str:
    """Adds the weight, at an angle to the vertical, and goes on until nothing moves."""
    x, y = math.sin(math.radians(degrees)), -math.cos(math.radians(degrees))
    return f"""
    fix weight grains gravity {G} vector {x:.17g} {y:.17g} 0
    run 6000
    """


def weights(shapes: Sequence[Clump], degrees: float) -> np.ndarray:
    x, y = math.sin(math.radians(degrees)), -math.cos(math.radians(degrees))
    return np.array([part for s in shapes for part in (s.mass * G * x, s.mass * G * y, 0)])


@both_laws
def test_triple_at_rest_on_a_floor(tmp_path: Path, law: str, ranks: int) -> None:
    """Its two lower discs lie in two gaps of the floor: four contacts at 30 degrees from the vertical, which carry the
    same if smooth, M g/(4 cos 30). Then they stick, and the weight is tilted: normal and tangential springs share the
    change as linear statics says."""
    kn, ks, tilt = 1e8, 2.5e7, 8.0
    centre = (0, SQRT3 * R + R / SQRT3)
    scene = [UPRIGHT.at(centre[0], centre[1]), *row(0, -2, 0, 2)]
    deck = begin(UPRIGHT, step="dt auto") + dump_contacts(6000) + settle(0)
    deck += "pair_coeff * * ${kn} ${ks} ${hn} ${hs} 60\nunfix weight\n" + settle(tilt)
    out = run(deck, tmp_path, discs=scene, law=law, ranks=ranks, kn=kn, ks=ks, hn=0.5, hs=0.5, phi=0)
    level, tilted = contacts(out)[1], contacts(out)[-1]

    discs = [(0, 2), (0, 3), (1, 3), (1, 4)]  # the disc of the grain and the id of the floor's
    assert list(zip(level["disc1"], level["id2"], strict=True)) == discs
    assert level["fn"] == pytest.approx(4 * [UPRIGHT.mass * G / 4 / math.cos(math.radians(30))], rel=1e-5)
    assert np.abs(level["ft"]).max() < 1e-9 * level["fn"][0]

    springs = Springs({1: centre}, level, kn, ks)
    fn, ft = springs.forces(weights([UPRIGHT], tilt) - weights([UPRIGHT], 0))
    assert list(zip(tilted["disc1"], tilted["id2"], strict=True)) == discs
    assert tilted["fn"] - level["fn"] == pytest.approx(fn, abs=1e-4 * np.abs(fn).max())
    assert tilted["ft"] == pytest.approx(ft, abs=1e-4 * np.abs(fn).max())
    assert np.abs(ft).min() > 0.01 * np.abs(fn).max()


@both_laws
@pytest.mark.parametrize("tilt", [0.0, 5.0])
def test_triple_at_rest_on_two_others(tmp_path: Path, law: str, ranks: int, tilt: float) -> None:
    """Point down between two that stand on the floor: 3 contacts with each, 4 of each with the floor, 1 of the two with
    each other, as far as they aren't pulled apart; all smooth."""
    kn = 1e8
    height = SQRT3 * R + R / SQRT3
    centres = {1: (-2 * R, height), 2: (2 * R, height), 3: (0, 3 * SQRT3 * R - R / SQRT3)}
    shapes = [UPRIGHT, UPRIGHT, HANGING]
    scene = [s.at(x, y, type=t) for s, (x, y), t in zip(shapes, centres.values(), (1, 1, 3), strict=True)]
    deck = begin(UPRIGHT, HANGING, step="dt auto") + dump_contacts(6000) + settle(tilt)
    out = run(
        deck, tmp_path, discs=[*scene, *row(0, -4, -2, 0, 2, 4)], law=law, ranks=ranks, kn=kn, hn=0.5, hs=0.5, phi=0
    )
    rest = contacts(out)[-1]
    fn, _ = Springs(centres, rest, kn, 0).forces(weights(shapes, tilt))
    assert rest["fn"] == pytest.approx(fn, abs=1e-4 * fn.max())
    assert fn.min() > 0
    assert len(fn) >= 9  # as many as the three grains have ways to move
    between = np.count_nonzero(rest["id2"] <= 3)
    assert between >= 4
