# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes, each with one ingredient of the contact law or of the motion, and what comes of them.

A scene is the same pair of discs of 4 mm several times over, alike but for the fraction of a time step at which they first
touch. Speeds are so low that the normal does not turn within a contact, except where that is the point.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

DIAMETER, DENSITY = 4e-3, 26.5  # m, kg/m^2
MASS = DENSITY * math.pi * DIAMETER**2 / 4
KN, KS = 1e8, 2.5e7  # N/m
MU = math.tan(math.radians(27))
PHASES = 16

State = np.ndarray  # (discs, 5): x, y, vx, vy, omega
Exact = Callable[["Scene", float], tuple[float, float, float]]


@dataclass(frozen=True)
class Scene:
    """A disc flies upwards at the other, with `slip` times that speed along x."""

    ingredient: str
    hn: float = 0
    hs: float = 0
    ks: float = 0
    phi: float = 27
    slips: tuple[float, ...] = (0,)  # tangential over normal speed
    speed: float = 1e-5  # normal (m/s)
    wall: bool = False
    cut: bool = False
    same_law: bool = True  # LAMMPS's friction limit counts the dashpot, too: with both, it has another solution
    exact: Exact | None = None

    @property
    def mass(self) -> float:
        """What moves against the other (kg)."""
        return MASS if self.wall else MASS / 2

    @property
    def frequency(self) -> float:
        """Of the undamped contact (1/s)."""
        return math.sqrt(KN / self.mass)

    def time_step(self, steps: int) -> float:
        """So many in an undamped contact."""
        return math.pi / self.frequency / steps


def restitution(h: float) -> float:
    """Schwager & Poeschel (2007)."""
    return math.exp(-math.pi * h / math.sqrt(1 - h * h))


def restitution_without_pull(h: float) -> float:
    """The same, of a dashpot that may not pull."""
    root = math.sqrt(1 - h * h)
    return math.exp(-h / root * (math.pi - math.atan2(2 * h * root, 1 - 2 * h * h)))


def head_on(scene: Scene, slip: float) -> tuple[float, float, float]:
    """Rebound, slip and spin over the speed."""
    return (restitution_without_pull if scene.cut else restitution)(scene.hn), slip, 0


def sticking(scene: Scene, slip: float) -> tuple[float, float, float]:
    """The rims' slip is a damped oscillator: m_t z'' + c z' + k_s z = 0, m_t a third of the pair's mass."""
    w = math.sqrt(3 * scene.ks / scene.mass)
    decay = 3 * scene.hs * math.sqrt(scene.ks / scene.mass)
    damped = math.sqrt(w * w - decay * decay)
    t = math.pi / scene.frequency / math.sqrt(1 - scene.hn**2)
    rims = slip * math.exp(-decay * t) * (math.cos(damped * t) - decay / damped * math.sin(damped * t))
    impulse = (slip - rims) / 3  # over the pair's mass: a third of the rims' change is the centres'
    return restitution(scene.hn), slip - impulse, 2 * impulse


def sliding(scene: Scene, slip: float) -> tuple[float, float, float]:
    """Friction's impulse is mu times that of the springs, and so of the contact."""
    e = restitution(scene.hn)
    impulse = MU * (1 + e)
    return e, slip - impulse, 2 * impulse


STICK = 89.99
# From a contact that sticks to one that slides nearly throughout. At 4 mu = mu KN/KS spring and limit grow alike from the
# first touch, so that round-off decides: not there.
SLIPS = (2 * MU, 3 * MU, 5 * MU, 7 * MU)
SCENES = [
    Scene("normal spring", exact=head_on),
    Scene("normal dashpot", hn=0.215, exact=head_on),
    Scene("normal dashpot, against a wall", hn=0.215, wall=True, exact=head_on),
    Scene("dashpot that may not pull", hn=0.215, cut=True, exact=head_on),
    Scene("tangential spring, no limit", ks=KS, phi=STICK, slips=(1, 3), exact=sticking),
    Scene("tangential dashpot, no limit", ks=KS, hs=0.215, phi=STICK, slips=(1, 3), exact=sticking),
    Scene("sliding throughout", hn=0.215, ks=KS, hs=0.215, slips=(6, 12), exact=sliding, same_law=False),
    Scene("stick and slip, undamped", ks=KS, slips=SLIPS),
    Scene("stick and slip", hn=0.215, ks=KS, hs=0.215, slips=SLIPS),
    Scene("normal that turns", hn=0.215, ks=KS, hs=0.215, slips=(10, 40), speed=2.0),
]


def discs(scene: Scene, steps: int, phases: int) -> tuple[list[tuple[int, float, float, float, float]], int]:
    """Type, x, y, vx, vy of all discs; and how many steps to run."""
    dt = scene.time_step(steps)
    rows = []
    for k, (slip, phase) in enumerate((s, p) for s in scene.slips for p in range(phases)):
        x = 0.006 * (k - (len(scene.slips) * phases - 1) / 2)
        gap = scene.speed * dt * ((phase + 0.5) / phases + 1)
        # Where they touch, the centres are above each other.
        shift = slip * gap
        rows.append((1, x - shift, -gap, slip * scene.speed, scene.speed))
        rows.append((2 if scene.wall else 1, x, DIAMETER, 0.0, 0.0))
    return rows, math.ceil((1 / math.sqrt(1 - scene.hn**2) + 0.1) * steps) + 6


def outcome(scene: Scene, state: State) -> np.ndarray:
    """(pairs, 3): rebound, slip of the centres, sum of the rims' spins, over the normal speed of approach."""
    low, high = state[0::2], state[1::2]
    v = (low - high)[:, 2:4]
    spin = (low[:, 4] + (0 if scene.wall else high[:, 4])) * DIAMETER / 2
    return np.column_stack([-v[:, 1], v[:, 0], spin]) / scene.speed
