# SPDX-License-Identifier: GPL-2.0-or-later
"""Single impacts: a thousand pairs that know nothing of each other, each touching first at another moment of a step.

Normal and oblique impact of two discs, and of a disc and a wall, after Chung and Ooi (2011), as far as a linear law in
two dimensions has a solution. The error is that of the velocity after the impact (both components, and radius x spin),
over the speed before it, root mean square over all angles and phases.

With one contact and a normal that hardly turns, u'' = -k u/m - c u'/m: overlap v/w_d exp(-h w t) sin(w_d t), with
w = sqrt(k_n/m), w_d = w sqrt(1 - h^2), m the reduced mass; it ends after pi/w_d with e = exp(-pi h/sqrt(1 - h^2)).
Along the contact the discs are lighter, m_t = m/3, since they also turn; spring and slider are followed by the
trapezoidal rule with so small a step that its error does not count.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from cases import AREAL_DENSITY, KN
from check import section
from engines import CDEM, HERE, LIGGGHTS, STOCK, Job

Array = np.ndarray[Any, np.dtype[np.float64]]
KS, H, PHI = 2.5e7, 0.215, 27.0  # of scene.in: N/m, -, degrees
RADIUS = 0.003  # m
MASS = AREAL_DENSITY * math.pi * RADIUS**2
SPEED = 1e-3  # m/s; so small that overlap and turning of the normal change nothing in the first six digits
PAIRS = 1000
DECKS = {CDEM: "cdem.in", STOCK: "stock.in", LIGGGHTS: "liggghts.in"}
LEVELS = (10, 20, 40, 80, 160, 320, 640)  # steps that an undamped contact lasts
TIMED = 10240  # to measure the time of a step, and for a reference where the engines' laws differ


@dataclass(frozen=True)
class Impact:
    """Angles against the normal (degrees), a wall or a second disc, damping ratio, friction angle (degrees)."""

    angles: tuple[float, ...] = (0,)
    wall: bool = False
    h: float = H
    phi: float = 0
    own_reference: bool = False  # each engine is compared with itself: their laws of damped friction differ

    @property
    def reduced(self) -> float:
        """Reduced mass over that of a disc."""
        return 1 if self.wall else 0.5

    @property
    def duration(self) -> float:
        """Of the contact, without damping (s)."""
        return math.pi * math.sqrt(self.reduced * MASS / KN)

    @property
    def levels(self) -> tuple[int, ...]:
        """Steps of a contact; the fewest are near the limit, which is that of a disc with discs all around."""
        return (8 if self.wall else 6, *LEVELS)

    def job(self, engine: str, level: int, data: Path) -> Job:
        """All pairs, from just before to just after the impact; writes the data file."""
        dt = self.duration / level
        write_pairs(data, self, dt)
        steps = self.steps(level)
        about: Mapping[str, object] = {"h": self.h, "phi": self.phi, "reduced": self.reduced}
        variables = {"decks": HERE, "data": data, "steps": steps, "dt": repr(dt), "state": 2, **about}
        return Job(engine, HERE / DECKS[engine], variables, steps, discs=PAIRS * (1 if self.wall else 2))

    def steps(self, level: float) -> int:
        """From just before to just after the impact."""
        return math.ceil(1.1 * level / math.sqrt(1 - self.h**2)) + 5

    def directions(self) -> Array:
        """(pairs,) angle of each pair, rad."""
        return np.radians(np.resize(self.angles, PAIRS))

    def phases(self) -> Array:
        """(pairs,) share of a step before the first touch."""
        return (np.arange(PAIRS) // len(self.angles) + 0.5) * len(self.angles) / PAIRS


OBLIQUE = tuple(range(10, 90, 10))
IMPACTS = {
    "normal, two discs": Impact(),
    "normal, disc and wall": Impact(wall=True),
    "oblique, smooth": Impact(OBLIQUE),
    "oblique, friction, two discs": Impact(OBLIQUE, h=0, phi=PHI),
    "oblique, friction, disc and wall": Impact(OBLIQUE, h=0, phi=PHI, wall=True),
    "oblique, friction and damping": Impact(OBLIQUE, phi=PHI, own_reference=True),
}


def write_pairs(data: Path, impact: Impact, dt: float) -> None:
    """The data file: pairs side by side along x, apart by what they approach in one to two steps."""
    angle = impact.directions()
    number = np.arange(PAIRS)
    x, y = 0.02 * (number % 25), 0.01 * (number // 25)
    gap = SPEED * np.cos(angle) * dt * (1 + impact.phases())
    velocity = SPEED * np.column_stack([np.cos(angle), np.sin(angle)])
    share = 1 - impact.reduced  # of the velocity that the other disc has, backwards
    density = AREAL_DENSITY * 3 / (4 * RADIUS)  # of a sphere with the mass of the disc
    atoms, velocities = [], []
    for i in number:
        one, other = 2 * i + 1, 2 * i + 2
        centre = x[i] + 2 * RADIUS + gap[i]
        kind = 2 if impact.wall else 1
        atoms.append(f"{one} 1 {2 * RADIUS!r} {density!r} {float(x[i])!r} {float(y[i])!r} 0")
        atoms.append(f"{other} {kind} {2 * RADIUS!r} {density!r} {float(centre)!r} {float(y[i])!r} 0")
        for atom, factor in ((one, 1 - share), (other, -share)):
            vx, vy = factor * velocity[i]
            velocities.append(f"{atom} {vx:.17g} {vy:.17g} 0 0 0 0")
    box = f"-0.01 {x.max() + 0.03} xlo xhi\n-0.01 {y.max() + 0.01} ylo yhi\n-0.01 0.01 zlo zhi"
    text = f"pairs\n\n{2 * PAIRS} atoms\n2 atom types\n\n{box}\n\nAtoms\n\n" + "\n".join(atoms)
    data.write_text(text + "\n\nVelocities\n\n" + "\n".join(velocities) + "\n")


def rebounds(folder: Path) -> Array:
    """(pairs, 3) of the first disc of each pair: velocity, and radius x spin, over the speed before the impact."""
    first = section(folder / "state.data", "Velocities", 7)[::2]
    return np.column_stack([first[:, 1], first[:, 2], RADIUS * first[:, 6]]) / SPEED


def error(found: Array, reference: Array) -> float:
    """Root mean square over the pairs of the error of the velocity."""
    return float(np.sqrt(np.mean(np.sum((found - reference) ** 2, axis=1))))


def own_reference(impact: Impact, finest: Array) -> Array:
    """(pairs, 3) means over the phases of a very fine run."""
    count = len(impact.angles)
    return np.resize([finest[k::count].mean(axis=0) for k in range(count)], (PAIRS, 3))


@cache
def exact(impact: Impact, steps: int = 20000) -> Array:
    """(pairs, 3) what `rebounds` should be, by the law of pair style cdem; the error is of second order in the steps."""
    angles = np.radians(np.array(impact.angles, float))
    m = impact.reduced * MASS
    omega = math.sqrt(KN / m)
    damped = omega * math.sqrt(1 - impact.h**2)
    restitution = math.exp(-math.pi * impact.h / math.sqrt(1 - impact.h**2))
    t = np.linspace(0, math.pi / damped, steps + 1)
    pressure = KN * np.cos(angles)[:, None] / damped * np.exp(-impact.h * omega * t) * np.sin(damped * t)
    limit = math.tan(math.radians(impact.phi)) * np.abs(pressure)
    impulse = tangential_impulse(np.sin(angles), limit, t[1], m, impact.h)  # on the first disc, against its motion
    shared = impact.reduced * np.column_stack([-restitution * np.cos(angles), np.sin(angles)])
    spin = 2 * impulse / MASS  # r J r/I
    return np.resize(np.column_stack([shared[:, 0], shared[:, 1] + impulse / MASS, spin]), (PAIRS, 3))


def tangential_impulse(speed: Array, limit: Array, dt: float, m: float, h: float) -> Array:
    """(angles,) impulse of spring, dashpot and slider (N s); limit (angles, times) is that of the spring (N)."""
    dashpot = 2 * h * math.sqrt(m * KS)
    light = m / 3
    spring, force, u = np.zeros_like(speed), np.zeros_like(speed), speed.copy()
    impulse = np.zeros_like(speed)
    for most in limit.T[1:]:
        tried = spring + KS * dt * (u - dt * force / (2 * light))
        slides = np.abs(tried) >= most
        spring = np.clip(tried, -most, most)
        new = spring + np.where(slides, 0, dashpot * u)
        push = dt * (force + new) / 2
        u, force = u - push / light, new
        impulse -= push
    return impulse
