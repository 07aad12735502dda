# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains of several discs (fix cdem/shape): their motion, contacts and rest against closed forms and stock LAMMPS."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import DENSITY, Disc, Frame, Run, run, same_bits, start, write_data
from scenes import both_laws, cloud

R = 2e-3  # m, radius of the discs of most clumps here
SQRT3 = math.sqrt(3)
FLOOR = Disc(0, -10, 20, type=2)  # flat over the distances here
FLOOR_BOX = (-11.0, 11.0, -21.0, 1.0)

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


# --- free flight ------------------------------------------------------------------------------------


def test_free_rotation(tmp_path: Path) -> None:
    """A million steps, 1600 turns: no force acts, so velocity and spin keep every bit. Position and angle are sums of
    a million equal terms, each rounded to the same side at worst."""
    vx, vy, omega, dt, steps = 0.3, -0.2, 1e5, 1e-7, 1000000
    out = run(
        begin(TRIPLE, step="dt any") + "timestep ${dt}\n" + dump(steps) + "run ${steps}\n",
        tmp_path, discs=[TRIPLE.at(-0.015, 0.01, vx, vy, omega)], dt=dt, steps=steps,
    )  # fmt: skip
    start, end = out.dump("grains.dump")
    for column in ("vx", "vy", "omegaz"):
        assert end[column].tolist() == start[column].tolist()
    t = dt * steps
    assert end["x"][0] == pytest.approx(-0.015 + vx * t, abs=1e-10 * vx * t)
    assert end["y"][0] == pytest.approx(0.01 + vy * t, abs=-1e-10 * vy * t)
    assert end["f_move[4]"][0] == pytest.approx(omega * t, rel=1e-10)


# --- one grain inside another -----------------------------------------------------------------------
# A triple whose discs press outward onto three of the 12 discs of a ring: two grains with one centre and three
# contacts, each prestressed by N = kn overlap and sticking. The three forces balance, so the pair stays together.


def around(radius: float, r: float, degrees: Sequence[float]) -> Clump:
    return Clump(*[(radius * math.cos(a), radius * math.sin(a), r) for a in np.radians(degrees)])


class Nest:
    overlap, kn, ks = 1e-5, 1e8, 2.5e7
    hub = 2 / SQRT3 * R  # from the centre to the discs of the triple
    ring = (hub + R - overlap) / (1 - math.sin(math.radians(15)))  # and to those of the ring, which touch each other
    places = (90, 210, 330)  # degrees
    distance, lever = ring - hub, hub + R - overlap / 2  # of the centres of two discs in contact; of the contact point
    inner, outer = around(hub, R, places), around(ring, ring * math.sin(math.radians(15)), range(0, 360, 30))

    # Small vibrations: the springs' own stiffness, less that of the prestress, which pushes discs aside once they are
    # out of line. For a displacement u of the triple in the ring: sum of kn n n + (ks - N/distance) t t, that is
    # 3/2 (kn + ks - N/distance) in any direction; for a turn of it, 3 (ks lever^2 - N hub ring/distance).
    prestress = kn * overlap
    mass = inner.mass * outer.mass / (inner.mass + outer.mass)
    inertia = inner.inertia * outer.inertia / (inner.inertia + outer.inertia)
    w_shift = math.sqrt(1.5 * (kn + ks - prestress / distance) / mass)
    w_turn = math.sqrt(3 * (ks * lever**2 - prestress * hub * ring / distance) / inertia)

    @classmethod
    def grains(
        cls, x: float, y: float, v: Sequence[float], omega: float, u: Sequence[float], spin: float
    ) -> list[Disc]:
        """Both, with a common velocity and spin, and a relative one that leaves the sums as they are."""
        a, b = cls.mass / cls.inner.mass, -cls.mass / cls.outer.mass
        c, d = cls.inertia / cls.inner.inertia, -cls.inertia / cls.outer.inertia
        return [
            cls.inner.at(x, y, v[0] + a * u[0], v[1] + a * u[1], omega + c * spin),
            cls.outer.at(x, y, v[0] + b * u[0], v[1] + b * u[1], omega + d * spin, type=3),
        ]

    @classmethod
    def run(cls, deck: str, directory: Path, discs: Sequence[Disc], **options: Any) -> Run:
        deck = begin(cls.inner, cls.outer) + "timestep ${dt}\n" + deck
        return run(deck, directory, discs=discs, kn=cls.kn, ks=cls.ks, hn=0, hs=0, phi=80, **options)


def test_several_contacts_across_a_border(tmp_path: Path, law: str, ranks: int) -> None:
    """The vibration of the pair, and each of its three contacts with a history of its own, while it crosses the borders
    of four ranks. Tolerance: 400 steps a period, so the frequency is 1e-5 too high and the phase 2e-4 off at the end;
    the incremental law loses normal force in proportion to the square of what a contact turns in a step."""
    steps, dt = 1200, 2 * math.pi / Nest.w_shift / 400
    v, u, spin = (10.0, 8.0), (0.02 * Nest.overlap * Nest.w_shift, 0), 0.02 * Nest.overlap / R * Nest.w_turn
    scene = Nest.grains(-1.5e-4, -1.2e-4, v, 0, u, spin)
    deck = dump(1) + dump_contacts(1) + f"run {steps}\n" + END
    out = Nest.run(deck, tmp_path, scene, law=law, ranks=ranks, dt=dt, skin=2e-5)

    x, y, angle = (out.series("grains.dump", column) for column in ("x", "y", "f_move[4]"))
    t = dt * np.arange(steps + 1)
    for grain in (0, 1):
        assert x[0, grain] < -1e-4 and x[-1, grain] > 1e-4 and y[0, grain] < -1e-4 and y[-1, grain] > 1e-4
    amplitude, turned = u[0] / Nest.w_shift, spin / Nest.w_turn
    shift, turn = amplitude * np.sin(Nest.w_shift * t), turned * np.sin(Nest.w_turn * t)
    assert np.abs(x[:, 0] - x[:, 1] - shift).max() < 4e-4 * amplitude
    assert np.abs(y[:, 0] - y[:, 1]).max() < 4e-4 * amplitude
    assert np.abs(angle[:, 0] - angle[:, 1] - turn).max() < 4e-4 * turned

    nx, ny = -np.cos(np.radians(Nest.places)), -np.sin(np.radians(Nest.places))  # from the ring to the triple
    for frame, s, q in zip(contacts(out), shift, turn, strict=True):
        assert frame["id1"].tolist() == [1, 1, 1] and frame["id2"].tolist() == [2, 2, 2]
        assert frame["disc1"].tolist() == [0, 1, 2] and frame["disc2"].tolist() == [3, 7, 11]
        fn, ft = Nest.kn * (Nest.overlap - nx * s), -Nest.ks * (-ny * s - Nest.lever * q)
        assert frame["fn"] == pytest.approx(fn, abs=1e-3 * Nest.kn * amplitude)
        assert frame["ft"] == pytest.approx(ft, abs=1e-3 * Nest.ks * (amplitude + Nest.lever * turned))

    if ranks > 1:
        alone = Nest.run(deck, tmp_path / "alone", scene, law=law, dt=dt, skin=2e-5)
        assert same_bits(out.end, alone.end)


def test_turning_together(tmp_path: Path) -> None:
    """The same pair vibrates while it turns, 48 times in a million steps: angular momentum is kept to round-off, and
    the energy (of which the vibration is a quarter) to 1e-5, at 40 steps a period."""
    steps, every, omega = 1000000, 1000, 1e3
    u, spin = 0.1 * Nest.overlap * Nest.w_shift, 0.05 * Nest.overlap / R * Nest.w_turn
    scene = Nest.grains(0, 0, (0, 0), omega, (u, 0.2 * u), spin)
    deck = f"thermo {every}\nthermo_style custom step pe\nthermo_modify format float %.17g\n" + dump(every)
    out = Nest.run(deck + f"run {steps}\n", tmp_path, scene, dt=2 * math.pi / Nest.w_shift / 40)

    x, y, vx, vy, spins, angle = (out.series("grains.dump", name) for name in "x y vx vy omegaz f_move[4]".split())
    m, inertia = np.array([[s.mass, s.inertia] for s in (Nest.inner, Nest.outer)]).T
    momentum = (m * (x * vy - y * vx) + inertia * spins).sum(axis=1)
    energy = out.thermo["PotEng"] + (m * (vx**2 + vy**2) + inertia * spins**2).sum(axis=1) / 2
    assert energy[0] > 1.2 * inertia.sum() * omega**2 / 2
    assert (angle[-1] > 48 * 2 * math.pi).all()
    assert np.abs(momentum / momentum[0] - 1).max() < 1e-12
    assert np.abs((m * vx).sum(axis=1)).max() < 1e-11 * m[0] * u
    # The discrete orbit keeps an energy of its own, which is off by (w dt)^2/8 of the vibration at most, to and fro.
    assert abs(energy[-100:].mean() - energy[1:101].mean()) < 1e-5 * energy[0]
    assert np.ptp(energy[1:]) < 2e-4 * energy[0]


# --- collisions -------------------------------------------------------------------------------------
# A short contact of normal n (onto the grain) at the point p from its centre: x'' = -(kn x + c x')/m for the overlap x,
# with 1/m = 1/M + (p x n)^2/I, while the dashpot takes the mass M of the grain: c = 2 h sqrt(M kn). So the damping
# ratio of the contact is z = h sqrt(M/m), the restitution e = exp(-pi z/sqrt(1 - z^2)), and the impulse (1 + e) m u.
# Of two grains, 1/m is the sum of both, and M = Ma Mb/(Ma + Mb).

UNEVEN = Clump((0, 0, R), (1.6 * R, 0, 0.6 * R), turn=-50)  # stands on its small disc
STEPS_PER_CONTACT = 400
# The dashpot's error at the ends of the contact is second order: 2e-5 and 3e-5 at 400 steps; undamped, it is 1e-5.
COLLIDE = "timestep ${dt}\nrun ${steps}\n" + END


def restitution(z: float) -> float:
    return math.exp(-math.pi * z / math.sqrt(1 - z * z))


@both_laws
@pytest.mark.parametrize(
    ("h", "mu"), [(0, 0), (0.215, 0), (0.5, 0), (0, 0.2)], ids=["elastic", "h=0.215", "h=0.5", "sliding"]
)
def test_bounce_off_centre(tmp_path: Path, law: str, ranks: int, h: float, mu: float) -> None:
    """A grain hits the floor beside its centre. With friction it slides all the while, so that the force has the fixed
    direction f = n + mu t, the lever arm p x f, and 1/m = 1/M + (p x n)(p x f)/I; then h is 0 and e is 1."""
    kn, u, omega = 1e8, 1e-2, 1.5
    lowest = int(np.argmin(UNEVEN.offsets[:, 1] - UNEVEN.radii))
    n, t = np.array([0.0, 1.0]), np.array([-1.0, 0.0])
    centre, r = UNEVEN.offsets[lowest], UNEVEN.radii[lowest]
    p = centre - r * n
    vx = 20 * u if mu else 0.3 * u
    vy = -u - omega * cross(p, n)
    slip = vx * t[0] + omega * cross(p, t)
    f = n - math.copysign(mu, slip) * t
    m = 1 / (1 / UNEVEN.mass + cross(p, n) * cross(p, f) / UNEVEN.inertia)
    z = h * math.sqrt(UNEVEN.mass / m)
    impulse = (1 + restitution(z)) * m * u

    dt = math.pi * math.sqrt(m / kn) / STEPS_PER_CONTACT
    steps = math.ceil(STEPS_PER_CONTACT / math.sqrt(1 - z * z)) + 8
    x, y = n * (r + 3.3 * u * dt) - centre
    end = run(
        begin(UNEVEN, step="dt any") + COLLIDE, tmp_path, discs=[UNEVEN.at(x, y, vx, vy, omega), FLOOR], box=FLOOR_BOX,
        law=law, ranks=ranks, kn=kn, ks=kn, hn=h, hs=h, phi=math.degrees(math.atan(mu)), dt=dt, steps=steps,
    ).end  # fmt: skip
    change, spin = impulse * f / UNEVEN.mass, impulse * cross(p, f) / UNEVEN.inertia
    assert end["vx"][0] == pytest.approx(vx + change[0], abs=1e-4 * abs(change[1]))
    assert end["vy"][0] == pytest.approx(vy + change[1], abs=1e-4 * abs(change[1]))
    assert end["omegaz"][0] == pytest.approx(omega + spin, abs=1e-4 * abs(spin))
    assert end["mass"][0] == pytest.approx(UNEVEN.mass, rel=1e-14)


@both_laws
@pytest.mark.parametrize("h", [0, 0.215])
def test_two_grains_collide_off_centre(tmp_path: Path, law: str, ranks: int, h: float) -> None:
    """Two different grains, each hit beside its centre, at 30 degrees to the axes and on the border of the ranks."""
    kn, u, spins = 1e8, 1e-2, (2.0, -1.0)
    n = np.array([math.cos(math.radians(30)), math.sin(math.radians(30))])  # from b to a
    shapes = (UNEVEN, TRIPLE)
    side = (-1, 1)  # of each grain, where it is hit, along n
    discs = [int(np.argmax(s * (c.offsets @ n) + c.radii)) for s, c in zip(side, shapes, strict=True)]
    offset = [c.offsets[k] for c, k in zip(shapes, discs, strict=True)]
    arms = [cross(o, n) for o in offset]
    mass = TRIPLE.mass * UNEVEN.mass / (TRIPLE.mass + UNEVEN.mass)
    m = 1 / (1 / mass + sum(arm**2 / c.inertia for arm, c in zip(arms, shapes, strict=True)))
    z = h * math.sqrt(mass / m)
    impulse = (1 + restitution(z)) * m * u
    dt = math.pi * math.sqrt(m / kn) / STEPS_PER_CONTACT
    steps = math.ceil(STEPS_PER_CONTACT / math.sqrt(1 - z * z)) + 8

    touching = [-s * (c.radii[k] + 3.3 * u * dt / 2) * n for s, c, k in zip(side, shapes, discs, strict=True)]
    # All of the approach is a's, and what the spins add at the point of contact is taken off its velocity.
    v = -(u + spins[0] * arms[0] - spins[1] * arms[1]) * n
    places = [t - o for t, o in zip(touching, offset, strict=True)]
    scene = [
        UNEVEN.at(places[0][0], places[0][1], v[0], v[1], spins[0]),
        TRIPLE.at(places[1][0], places[1][1], omega=spins[1], type=3),
    ]
    end = run(
        begin(*shapes, step="dt any") + COLLIDE, tmp_path, discs=scene, law=law, ranks=ranks,
        kn=kn, hn=h, hs=h, phi=0, dt=dt, steps=steps,
    ).end  # fmt: skip
    for k, sign in ((0, 1), (1, -1)):
        change, spin = sign * impulse * n / shapes[k].mass, sign * impulse * arms[k] / shapes[k].inertia
        before = v if k == 0 else np.zeros(2)
        assert [end["vx"][k], end["vy"][k]] == pytest.approx(before + change, abs=1e-4 * impulse / shapes[k].mass)
        assert end["omegaz"][k] == pytest.approx(spins[k] + spin, abs=1e-4 * abs(spin))


# --- at rest ----------------------------------------------------------------------------------------
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


# --- rocking ----------------------------------------------------------------------------------------


def period(x: np.ndarray, dt: float) -> float:
    """From the first to the last upward zero crossing."""
    up = np.flatnonzero((x[:-1] < 0) & (x[1:] >= 0))
    at = up + x[up] / (x[up] - x[up + 1])
    return dt * float(at[-1] - at[0]) / (len(up) - 1)


def motion(stiffness: np.ndarray, inertia: Vector, start: Vector, t: np.ndarray) -> np.ndarray:
    """Free undamped motion from rest at 0 with the velocities `start`: one row a time."""
    root = np.sqrt(np.array(inertia))
    squares, modes = np.linalg.eigh(stiffness / np.outer(root, root))
    w = np.sqrt(squares)
    return (np.sin(np.outer(t, w)) / w * (modes.T @ (root * start))) @ modes.T / root


@pytest.mark.parametrize("sticks", [False, True], ids=["smooth", "sticking"])
@both_laws
def test_rocking_on_two_discs(tmp_path: Path, law: str, ranks: int, sticks: bool) -> None:
    """A triple on a floor turns by q to and fro on the springs of its two lower discs, l = R to the sides of its centre
    and b below it. On a flat floor I q'' = -(2 kn l^2 - M g b) q: the weight, on discs that swing out below the centre,
    helps it on. If they stick, it sways by x as well on the tangential springs, H = b + R - overlap/2 below the centre:
    M x'' = -2 ks (x + H q),   I q'' = -(2 kn l^2 - M g b) q - 2 ks H (x + H q).
    The floor's curvature tilts the normals by 2e-4, which counts here: k is the same sum with them."""
    kn, ks, overlap, periods, per_period = 1e6, 2.5e5, 2e-5, 4, 400
    b = R / SQRT3
    load = kn * overlap  # of either disc
    k = np.zeros((2, 2))
    for side in (-1, 1):
        tilt = math.asin(side * R / (FLOOR.radius + R - overlap))
        n, t = np.array([math.sin(tilt), math.cos(tilt)]), np.array([-math.cos(tilt), math.sin(tilt)])
        centre = np.array([side * R, -b])
        normal = [n[0], cross(centre, n)]
        tangential = [t[0], cross(centre - (R - overlap / 2) * n, t)]
        k += kn * np.outer(normal, normal) + ks * sticks * np.outer(tangential, tangential)
        k[1, 1] -= load * b
    g = 2 * load / TRIPLE.mass  # its moment is 0.6 % of the stiffness
    rock = k[1, 1]
    omega = 0.05 * overlap / R * math.sqrt(rock / TRIPLE.inertia)
    dt = 2 * math.pi / math.sqrt(rock / TRIPLE.inertia) / per_period
    steps = periods * per_period
    y = math.sqrt((-FLOOR.y + R - overlap) ** 2 - R**2) + FLOOR.y + b
    deck = f"""
    fix weight grains gravity {g:.17g} vector 0 -1 0
    timestep {dt:.17g}
    run {steps}
    """
    out = run(
        begin(TRIPLE) + dump(1) + deck, tmp_path, discs=[TRIPLE.at(0, y, omega=omega), FLOOR], box=FLOOR_BOX, law=law,
        ranks=ranks, kn=kn, ks=ks, hn=0, hs=0, phi=85 if sticks else 0,
    )  # fmt: skip
    x, angle = (out.series("grains.dump", name)[:, 0] for name in ("x", "f_move[4]"))
    if sticks:
        shift, turn = motion(k, [TRIPLE.mass, TRIPLE.inertia], [0, omega], dt * np.arange(steps + 1)).T
        assert x == pytest.approx(shift, abs=2e-3 * np.abs(shift).max())
        assert angle == pytest.approx(turn, abs=2e-3 * np.abs(turn).max())
    else:
        assert period(angle, dt) == pytest.approx(2 * math.pi * math.sqrt(TRIPLE.inertia / rock), rel=2e-5)


# A disc with two smaller ones beside and below its middle: its centre of mass is BELOW it, so it rights itself.
ROLY = Clump((0, 0, R), *[(1.3 * R * math.cos(a), 1.3 * R * math.sin(a), 0.3 * R) for a in np.radians([-20, 200])])
BELOW = float(ROLY.offsets[0, 1])


@pytest.mark.parametrize("rolls", [False, True], ids=["smooth", "rolling"])
@both_laws
def test_rocking_like_a_pendulum(tmp_path: Path, law: str, ranks: int, rolls: bool) -> None:
    """On a smooth floor the centre of mass stays where it is in x: I q'' = -M g b q. Rolling, it turns about the point
    of contact, h = R - b below, and the floor's curvature counts: (I + M h^2) q'' = -M g (b - R^2/(R + R_floor)) q.
    Tolerance: an amplitude of 0.02 makes the period longer by 0.02^2/16 = 2.5e-5."""
    kn, g, amplitude, dt = 1e6, 4000.0, 0.02, 2e-6
    h = R - BELOW
    inertia = ROLY.inertia + (ROLY.mass * h**2 if rolls else 0)
    arm = BELOW - (R**2 / (R + FLOOR.radius) if rolls else 0)
    w = math.sqrt(ROLY.mass * g * arm / inertia)
    steps = math.ceil(2.3 * 2 * math.pi / w / dt)
    y = R - ROLY.mass * g / kn - BELOW
    omega = amplitude * w
    deck = f"""
    fix weight grains gravity {g} vector 0 -1 0
    timestep {dt}
    run {steps}
    """
    out = run(
        begin(ROLY) + dump(10) + deck, tmp_path, discs=[ROLY.at(0, y, -h * omega if rolls else 0, 0, omega), FLOOR],
        box=FLOOR_BOX, law=law, ranks=ranks, kn=kn, ks=kn / 4, hn=0, hs=0, phi=60 if rolls else 0,
    )  # fmt: skip
    x, angle = (out.series("grains.dump", name)[:, 0] for name in ("x", "f_move[4]"))
    assert period(angle, 10 * dt) == pytest.approx(2 * math.pi / w, rel=2e-4)
    assert angle.max() == pytest.approx(amplitude, rel=2e-3)
    assert x.max() == pytest.approx(h * amplitude if rolls else 0, rel=2e-3, abs=1e-4 * h * amplitude)


# --- against stock LAMMPS ---------------------------------------------------------------------------

LONG = Clump((0, 0, R), (2 * R, 0, R), (4 * R, 0, R), (0, 2 * R, R), turn=20)


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


# --- the same bits ----------------------------------------------------------------------------------
# A dense crowd in a box of wall discs: grains of four and three discs and single ones, turned at random and pressed
# together. All bits agree however the work is cut.

SINGLE = Clump((0, 0, 1.5 * R))
PITCH, SIDE = 7.0e-3, 10
CROWD_BOX = (-0.05, 0.05, -0.05, 0.05)
COLUMNS = "id x y vx vy omegaz fx fy tqz f_move[1] f_move[2] f_move[3] f_move[4]".split()


def crowd() -> list[Disc]:
    random = np.random.default_rng(5)
    discs = []
    for k in range(SIDE**2):
        i, j = k % SIDE, k // SIDE
        x, y = PITCH * (i + 1 - SIDE / 2), PITCH * (j + 1 - SIDE / 2)  # borders between ranks pass through grains
        vx, vy, omega = random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-500, 500)
        if {i, j} & {0, SIDE - 1}:
            discs.append(Disc(x, y, PITCH, type=2))
        else:
            type = (1, 1, 3, 4, 4)[k % 5]
            grain = {1: TRIPLE, 3: LONG, 4: SINGLE}[type].at(x, y, vx, vy, omega, type)
            discs.append(replace(grain, diameter=grain.diameter * random.uniform(0.95, 1.05)))
    return discs


def run_crowd(directory: Path, law: str, plan: str = "one", rebuild: str = "by need", **options: Any) -> Run:
    """In one run or two; or with a restart in between, written or read."""
    deck = begin(TRIPLE, LONG, SINGLE, more="orient 7")
    if plan == "read":
        fixes = deck[deck.index("fix shape") :]
        deck = "newton off\nprocessors ${px} ${py} 1\nread_restart middle.restart\ncomm_modify vel yes\n"
        deck += "neighbor ${skin} bin\nvariable density index 26.5\n" + fixes
    deck += f"neigh_modify delay 0 every 1 check {'no' if rebuild == 'every step' else 'yes'}\n"
    deck += f"timestep 5e-7\ndump end all custom 3000 end.dump {' '.join(COLUMNS)} type\n"
    deck += "dump_modify end sort id format float %.17g\n" + dump_contacts(1000)
    deck += {
        "one": "run 3000\n",
        "two": "run 1000\nrun 2000\n",
        "write": "run 1000\nwrite_restart middle.restart\nrun 2000\n",
        "read": "run 2000\n",
    }[plan]
    defaults: dict[str, Any] = {"box": CROWD_BOX, "kn": 1e6, "ks": 2.5e5, "skin": 2e-4}
    return run(deck, directory, discs=[] if plan == "read" else crowd(), law=law, **(defaults | options))


@pytest.fixture(scope="module", params=["direct", "incremental"], name="crowd_law")
def crowd_law_fixture(request: pytest.FixtureRequest) -> str:
    """Both laws, with one reference run each."""
    return request.param


@pytest.fixture(scope="module")
def reference(crowd_law: str, tmp_path_factory: pytest.TempPathFactory) -> Run:
    return run_crowd(tmp_path_factory.mktemp(crowd_law), crowd_law)


def end_of_crowd(out: Run) -> Frame:
    return out.dump("end.dump")[-1]


def test_the_crowd_is_worth_it(reference: Run) -> None:
    """Many grains in contact when the restart is written, some twice with the same partner, sliding or not; many have
    crossed a border, turned, or met another partner since."""
    start, middle, end = contacts(reference)[0], contacts(reference)[1], contacts(reference)[-1]
    grains = list(zip(middle["id1"], middle["id2"], strict=True))
    assert len(grains) > 120 and len(set(grains)) < len(grains) - 20
    assert np.count_nonzero(np.abs(middle["ft"]) > 0.01 * middle["fn"].max()) > 30
    pairs = [set(zip(*(f[name] for name in FIELDS[:4]), strict=True)) for f in (start, middle, end)]
    assert len(pairs[1] - pairs[0]) > 20 and len(pairs[2] - pairs[1]) > 20 and len(pairs[1] & pairs[2]) > 20
    before, after = reference.dump("end.dump")[0], end_of_crowd(reference)
    assert all(np.count_nonzero((before[axis] < 0) != (after[axis] < 0)) >= 2 for axis in "xy")
    assert np.count_nonzero(np.abs(after["f_move[4]"] - before["f_move[4]"]) > 0.2) > 20
    assert "Dangerous builds = 0" in reference.log


@pytest.mark.parametrize("ranks", [2, 4])
def test_ranks(tmp_path: Path, crowd_law: str, ranks: int, reference: Run) -> None:
    assert same_bits(end_of_crowd(reference), end_of_crowd(run_crowd(tmp_path, crowd_law, ranks=ranks)), COLUMNS)


@pytest.mark.parametrize("ranks", [2, 4])
def test_ranks_without_grains(tmp_path: Path, crowd_law: str, ranks: int, reference: Run) -> None:
    """All of the crowd in one corner of a large box."""
    out = run_crowd(tmp_path, crowd_law, ranks=ranks, box=(-0.05, 0.3, -0.05, 0.3))
    assert any(line.startswith("Nlocal:") and " 0 min" in line for line in out.log.splitlines())
    assert same_bits(end_of_crowd(reference), end_of_crowd(out), COLUMNS)


@pytest.mark.parametrize(("written_by", "read_by"), [(1, 1), (1, 4), (4, 2)])
def test_restart_in_mid_contact(tmp_path: Path, crowd_law: str, written_by: int, read_by: int, reference: Run) -> None:
    """Writing changes nothing; what is read goes on to the same bits, and is not turned at random again."""
    written = run_crowd(tmp_path, crowd_law, "write", ranks=written_by)
    assert same_bits(end_of_crowd(reference), end_of_crowd(written), COLUMNS)
    read = run_crowd(tmp_path, crowd_law, "read", ranks=read_by)
    assert same_bits(end_of_crowd(reference), end_of_crowd(read), COLUMNS)


@pytest.mark.parametrize(("rebuild", "skin"), [("every step", 2e-4), ("by need", 4e-3)])
def test_rebuilds(tmp_path: Path, crowd_law: str, rebuild: str, skin: float, reference: Run) -> None:
    out = run_crowd(tmp_path, crowd_law, "two", rebuild=rebuild, skin=skin)
    assert same_bits(end_of_crowd(reference), end_of_crowd(out), COLUMNS)


def test_a_turning_grain_finds_its_neighbours(tmp_path: Path, ranks: int) -> None:
    """A rod spins on the spot, so LAMMPS sees no reason to rebuild its list; within a quarter turn it hits two discs
    that were further away than the skin, one of them a wall. The same bits as with a new list in every step.
    Run style verlet/cdem has LAMMPS rebuild its list, in time."""
    rod = Clump(*[(2 * R * k, 0, R) for k in range(4)])
    scene = [rod.at(0, 0, omega=500), SINGLE.at(0, 9e-3, type=3), Disc(-2e-3, -9e-3, 2 * R, type=2)]
    deck = begin(rod, SINGLE) + "timestep 1e-6\nneigh_modify delay 0 every 1 check ${check}\nrun 2150\n" + END
    lazy, eager, gliding = (
        run(deck, tmp_path / name, discs=scene, ranks=ranks, kn=1e6, ks=2.5e5, check=check, style=style)
        for name, check, style in (("yes", "yes", "verlet"), ("no", "no", "verlet"), ("glide", "yes", "verlet/cdem"))
    )
    assert "Neighbor list builds = 0" in lazy.log and "Neighbor list builds = 2150" in eager.log
    assert lazy.end["omegaz"][0] < 300 and lazy.end["vx"][1] != 0 and lazy.end["vy"][0] > 0
    assert "Dangerous builds = 0" in gliding.log
    assert same_bits(lazy.end, eager.end) and same_bits(lazy.end, gliding.end)
    if ranks > 1:
        alone = run(deck, tmp_path / "alone", discs=scene, kn=1e6, ks=2.5e5, check="yes", style="verlet")
        assert same_bits(lazy.end, alone.end)


@pytest.mark.parametrize(
    ("law", "template"),
    [
        ("direct", "single"),
        ("direct", "discs 1 0 0 1"),
        ("incremental", "discs 1 3 -2 0.7"),
        ("direct", "mixed"),
        ("incremental", "mixed"),
    ],
)
def test_grains_of_one_disc(tmp_path: Path, law: str, template: str) -> None:
    """The same bits as without fix cdem/shape; also if there is another grain somewhere, of several discs."""
    motion = "fix move grains cdem/integrate\ntimestep 2e-7\nrun 5000\n" + END
    discs = cloud(5, speed=2.0)
    plain = run("include ${decks}/start.in\n" + motion, tmp_path / "plain", discs=discs, law=law).end
    assert np.count_nonzero(plain["omegaz"] != [d.omega for d in discs]) > 15
    if template == "mixed":
        discs = [*discs, LONG.at(0.035, 0.035, type=3)]
        shape = f"group grains type 3\nfix shape all cdem/shape type 1 single type 2 single type 3 {LONG.template}\nset type 3 mass 1e-3\n"
    else:
        shape = f"fix shape all cdem/shape type 1 {template} type 2 single\n"
    box = (-0.02, 0.04, -0.02, 0.04)
    end = run("include ${decks}/start.in\n" + shape + motion, tmp_path / "shape", discs=discs, box=box, law=law).end
    first = Frame(end.step, {name: values[:25] for name, values in end.columns.items()})
    assert same_bits(plain, first)


def test_a_wall_of_several_discs(tmp_path: Path, law: str) -> None:
    """Acts like the same discs as walls of their own: dashpots don't know how many there are, and nothing moves it."""
    ground = Clump(*[(2 * R * k, 0, R) for k in range(8)])
    grains = [TRIPLE.at(-7e-3, 7e-3, 0.3, -1, 200), TRIPLE.at(3e-3, 6e-3, -0.5, -1, -100)]
    deck = begin(TRIPLE) + "fix weight grains gravity 2000 vector 0 -1 0\ntimestep 2e-7\nrun 8000\n" + END
    whole = deck.replace("type 2 single", f"type 2 {ground.template}")
    parts = [Disc(x, y, 2 * r, type=2) for (x, y), r in zip(ground.offsets, ground.radii, strict=True)]
    a = run(whole, tmp_path / "whole", discs=[*grains, ground.at(0, 0, type=2)], law=law, phi=27).end
    b = run(deck, tmp_path / "parts", discs=[*grains, *parts], law=law, phi=27).end
    assert (np.abs(a["omegaz"][:2] - [200, -100]) > 10).all()
    for column in ("x", "y", "vx", "vy", "omegaz"):
        assert a[column][:2] == pytest.approx(b[column][:2], rel=1e-6)
    assert [a["x"][2], a["y"][2], a["vx"][2], a["vy"][2], a["omegaz"][2]] == [0, 0, 0, 0, 0]


@pytest.mark.parametrize("side", ["top", "bottom", "left", "right"])
def test_the_face_of_a_lid_of_clumps(tmp_path: Path, side: str) -> None:
    """It is where the innermost point of its discs is, not that of the circles around the clumps, which are turned."""
    deck = f"""
    include ${{decks}}/start.in
    fix shape all cdem/shape type 1 single type 2 triple density 26.5 orient 7
    fix move grains cdem/integrate
    fix lid walls cdem/lid stress 1e4 width 0.01 thickness 0.01 vmax 1 from {side}
    compute discs walls cdem/discs x y radius
    dump discs walls cdem/local 1 discs.dump c_discs[*]
    dump_modify discs format float %.17g
    thermo_style custom step f_lid[3]
    thermo_modify format float %.17g
    run 0
    """
    walls = [Disc(0, 0, 6e-3, type=2), Disc(6e-3, 1e-4, 6e-3, type=2)]
    out = run(deck, tmp_path, discs=[*walls, Disc(0, -0.01)])
    discs = out.dump("discs.dump")[-1]
    outward = {"top": discs["y"], "bottom": -discs["y"], "right": discs["x"], "left": -discs["x"]}[side]
    sign = 1 if side in ("top", "right") else -1
    assert out.thermo["f_lid[3]"][-1] == pytest.approx(sign * np.min(outward - discs["radius"]), abs=1e-12)


# --- the time step ----------------------------------------------------------------------------------


@pytest.mark.parametrize("share", [0.99, 1.08])
def test_time_step_limit_of_a_lattice(tmp_path: Path, share: float) -> None:
    """Triples, each in stick with the six around it by 12 contacts, vibrate. The limit is that of the packing: below it
    they go on for ever. By Bloch's theorem its eigenvalue is 8.6 % above the true one at ks/kn = 1/4, so that the
    vibration grows from 1.042 of the limit on."""
    n, kn, squeeze = 4, 1e8, 1e-4
    random = np.random.default_rng(1)
    width, height = 6 * R * (1 - squeeze), 2 * SQRT3 * R * (1 - squeeze)
    scene = []
    for k in range(4 * n * n):
        x, y = width * (k % n), height * (k // n) / 2
        vx, vy, omega = random.uniform(-1, 1, 3) * 1e-3
        scene.append(TRIPLE.at(x + (width / 2 if k // n % 2 else 0) + R, y + R, vx, vy, omega / R))
    deck = (
        begin(TRIPLE, step="dt any")
        + f"""
    run 0
    variable dt equal {share}*f_move
    timestep ${{dt}}
    thermo 10
    thermo_style custom step ke
    run 3000
    """
    )
    box = (0, n * width, 0, 2 * n * height)
    out = run(deck, tmp_path, discs=scene, box=box, bx="p", by="p", kn=kn, ks=kn / 4, hn=0, hs=0, phi=80)
    kinetic = out.thermo["KinEng"]
    assert (kinetic.max() < 5 * kinetic[0]) == (share < 1)
    assert np.isfinite(kinetic).all()


# --- mass, angle, pressure --------------------------------------------------------------------------


def test_density_and_sizes(tmp_path: Path, ranks: int) -> None:
    """`density` sets the mass of the group's grains, from the area of the union: here two discs of radius 1 that are 1
    apart, in all of 2 (pi - acos(1/2) + sqrt(3)/4), in a grain of radius 1.5. Others keep theirs."""
    scene = [Disc(6e-3 * (k - 2), 1e-3 * k, diameter, type=t) for k, (diameter, t) in enumerate(
        [(3e-3, 1), (4e-3, 1), (5e-3, 3), (2e-3, 2), (4e-3, 3)]
    )]  # fmt: skip
    deck = "include ${decks}/start.in\ngroup grains type 3\n"
    deck += "fix shape grains cdem/shape density 10 type 3 triple type 2 single type 1 discs 2 4 4 1 4 5 1\n"
    deck += "fix move grains cdem/integrate dt auto\nrun 0\n" + END
    end = run(deck, tmp_path, discs=scene, ranks=ranks).end
    pair = 2 * (math.pi - math.acos(0.5) + SQRT3 / 4) / 1.5**2
    triple = 3 * math.pi / (1 + 2 / SQRT3) ** 2
    shares = np.array([10 * pair, 10 * pair, 10 * triple, DENSITY * math.pi, 10 * triple])
    assert end["mass"] == pytest.approx(shares * [d.radius**2 for d in scene], rel=1e-14)
    assert end["radius"].tolist() == [d.radius for d in scene]


def test_density_of_grains_made_later(tmp_path: Path) -> None:
    deck = """
    units si
    dimension 2
    boundary f f p
    atom_style sphere
    newton off
    comm_modify vel yes
    region box block 0 0.1 0 0.1 -0.005 0.005
    create_box 1 box
    fix shape all cdem/shape type 1 triple density 30
    create_atoms 1 single 0.05 0.05 0
    set group all diameter 0.006
    pair_style cdem law direct
    pair_coeff * * 1e8 2.5e7 0.215 0.215 27
    fix move all cdem/integrate dt auto
    run 0
    """
    end = run(deck + END, tmp_path).end
    assert end["mass"] == pytest.approx([30 * 3 * math.pi * (0.003 / (1 + 2 / SQRT3)) ** 2], rel=1e-14)


def test_mass_of_created_grains(tmp_path: Path, ranks: int) -> None:
    """cdem/create takes diameters as the circumscribed ones, and the area from the template."""
    deck = """
    units si
    dimension 2
    boundary f f p
    processors ${px} ${py} 1
    atom_style sphere
    newton off
    region box block 0 0.1 0 0.2 -0.005 0.005
    create_box 2 box
    fix shape all cdem/shape type 1 triple type 2 single
    cdem/create 1 fill 60 region 0 0.1 0 0.2 diameter 0.004 0.008 power 0 density 26.5 seed 3
    cdem/create 2 row 0.002 0.19 0.098 0.19 10 diameter 0.004 density 26.5
    run 0
    """
    end = run(deck.replace("run 0\n", END), tmp_path, ranks=ranks).end
    shares = np.where(end["type"] == 1, 3 * math.pi / (1 + 2 / SQRT3) ** 2, math.pi)
    assert end["mass"] == pytest.approx(DENSITY * shares * end["radius"] ** 2, rel=1e-14)
    assert end["radius"][:60].min() == pytest.approx(0.002, rel=0.01)
    assert end["radius"][:60].max() == pytest.approx(0.004, rel=0.01)


def angles(directory: Path, seed: int, ranks: int, more: str = "") -> np.ndarray:
    scene = [TRIPLE.at(0.01 * (k % 20 + 0.5), 0.01 * (k // 20 + 0.5)) for k in range(400)]
    scene[7] = Disc(scene[7].x, scene[7].y, type=2)
    deck = begin(TRIPLE, step="dt auto", more=f"orient {seed}") + dump(1) + "run 0\n" + more
    frames = run(deck, directory, discs=scene, box=(0, 0.2, 0, 0.2), ranks=ranks).dump("grains.dump")
    return frames[-1]["f_move[4]"]


def test_orient(tmp_path: Path, ranks: int) -> None:
    """Angles spread evenly over a turn (Kolmogorov's test at 1 %), by seed and id alone; only once; not for walls."""
    turned = angles(tmp_path / "turned", 4, ranks, more="run 0\n")
    assert turned[7] == 0
    grains = np.delete(turned, 7)
    n = len(grains)
    share = np.sort(grains) / (2 * math.pi)
    assert share[0] >= 0 and share[-1] < 1
    assert np.abs(share - (np.arange(n) + 0.5) / n).max() < 1.63 / math.sqrt(n)
    assert abs(np.corrcoef(grains[:-1], grains[1:])[0, 1]) < 0.15  # ids that follow each other aren't alike
    if ranks > 1:
        assert turned.tolist() == angles(tmp_path / "alone", 4, 1).tolist()
    else:
        other = angles(tmp_path / "other", 5, 1)
        assert abs(np.corrcoef(np.delete(other, 7), grains)[0, 1]) < 0.15


@both_laws
@pytest.mark.parametrize(("x", "y"), [(-0.004, 0.001), (0.017, -0.0195)], ids=["between-ranks", "periodic"])
def test_virial(tmp_path: Path, law: str, ranks: int, x: float, y: float) -> None:
    """P = force x vector between the centres of mass / area, for the contact of two grains beside their centres; the
    force is kn overlap n."""
    kn, overlap = 1e7, 2e-5
    # The right disc of the upright triple against the big one of the other.
    direction = np.array([math.cos(0.3), math.sin(0.3)])
    branch = TRIPLE.offsets[1] + (2 * R - overlap) * direction - UNEVEN.offsets[0]
    wrap = lambda c: math.remainder(c, 0.04)
    scene = [TRIPLE.at(x, y), UNEVEN.at(wrap(x + branch[0]), wrap(y + branch[1]), type=3)]
    deck = (
        begin(TRIPLE, UNEVEN, step="dt auto")
        + """
    compute p all pressure NULL virial
    thermo_style custom step c_p[1] c_p[2] c_p[4] pe
    thermo_modify format float %.17g
    run 0
    """
    )
    seen = run(deck, tmp_path, discs=scene, law=law, ranks=ranks, kn=kn, bx="p", by="p").thermo
    force = kn * overlap * direction
    expected = [branch[0] * force[0], branch[1] * force[1], branch[0] * force[1]]
    assert [seen[f"c_p[{k}]"][0] * 0.04**2 for k in (1, 2, 4)] == pytest.approx(expected, rel=1e-9)
    assert seen["PotEng"][0] == pytest.approx(kn * overlap**2 / 2, rel=1e-9)
    assert abs(force[0] * branch[1] / (force[1] * branch[0]) - 1) > 0.1  # the force is not central


# --- what is refused --------------------------------------------------------------------------------

FILES = {
    "good": b"# x y r\n0 0 1\r\n\n 2 0 1 # the second\n",
    "empty": b"",
    "comment": b"# nothing\n\n",
    "two-columns": b"0 0 1\n2 0\n",
    "four-columns": b"0 0 1 5\n",
    "words": b"x y r\n0 0 1\n",
    "commas": b"0,0,1\n",
    "not-a-number": b"0 0 1\n2 0 nan\n",
    "negative": b"0 0 1\n2 0 -1\n",
    "binary": bytes(range(256)) * 8,
}
BOTH = "type 1 single type 2 single"
REFUSED = {
    "type 1 discs 0 type 2 single": "discs 0: must be a positive number",
    "type 1 discs -3 0 0 1 type 2 single": "discs -3: must be a positive number",
    "type 1 discs 1.5 0 0 1 type 2 single": "discs is 1.5, must be an integer",
    "type 2 single type 1 discs": "discs has no value",
    "type 2 single type 1 discs 1000000000 0 0 1": "discs 1000000000: must be a positive number of discs, each with x y r; 3 values follow",
    "type 2 single type 1 discs 2147483647 0 0 1": "discs 2147483647: must be a positive number of discs",
    "type 2 single type 1 discs 2147483648 0 0 1": "discs is 2147483648, must be an integer",
    "type 2 single type 1 discs 2 0 0 1 2 0": "5 values follow",
    "type 2 single type 1 discs 1 0 0 1 5": "unknown keyword 5",
    "type 1 discs 2 0 0 1 2 0 type 2 single": "r of disc 2 is type, must be a number",
    "type 1 discs 1 0 a 1 type 2 single": "y of disc 1 is a, must be a number",
    "type 1 discs 1 0 0 0 type 2 single": "type 1, discs: disc 1 has radius 0",
    "type 1 discs 2 0 0 1 1 0 -0.5 type 2 single": "disc 2 has radius -0.5",
    "type 1 discs 1 0 0 -1e-9 type 2 single": "disc 1 has radius -1e-09",
    "type 1 discs 1 0 0 nan type 2 single": "r of disc 1 is nan",
    "type 1 discs 3 0 0 1 2 0 1 0 0 1 type 2 single": "disc 1 is a duplicate of, or lies inside, disc 3",
    "type 1 discs 2 0 0 1 0.1 0 0.2 type 2 single": "disc 2 is a duplicate of, or lies inside, disc 1",
    "type 1 discs 2 0 0 1 3 0 1 type 2 single": "disc 2 is disconnected from disc 1",
    "type 1 triple": "atom type 2 has no template",
    "": "atom type 1 has no template",
    "type 3 single " + BOTH: "type 3 must be between 1 and 2",
    "type 0 single " + BOTH: "type 0 must be between 1 and 2",
    "type 1 triple " + BOTH: "type 1 has two templates",
    "type 1 quadruple type 2 single": "type 1: unknown template quadruple; allowed: single, triple, discs, file",
    "type 1": "type 1: unknown template",
    "type x single": "type is x, must be an integer",
    BOTH + " density 0": "density 0: must be positive",
    BOTH + " density -26.5": "density -26.5: must be positive",
    BOTH + " density": "density has no value",
    BOTH + " orient 0": "orient 0: must be 1 or more",
    BOTH + " orient -4": "orient -4: must be 1 or more",
    BOTH + " orient 1.5": "orient is 1.5, must be an integer",
    BOTH + " colour red": "unknown keyword colour; allowed: folder, type, density, orient",
    BOTH + f"\nfix more all cdem/shape {BOTH}": "Fix cdem/shape more: there is one already, shape",
    BOTH + " folder": "folder: its name is missing",
    "folder elsewhere type 1 file good type 2 single": "can't read the template file elsewhere/good: No such file",
    "type 1 file": "type 1: file: its name is missing",
    "type 1 file missing type 2 single": "file missing: No such file",
    "type 1 file empty type 2 single": "file empty: it has no discs",
    "type 1 file comment type 2 single": "file comment: it has no discs",
    "type 1 file two-columns type 2 single": "two-columns line 2 is not 'x y r': 2 0",
    "type 1 file four-columns type 2 single": "four-columns line 1 is not 'x y r': 0 0 1 5",
    "type 1 file words type 2 single": "words line 1 is not 'x y r': x y r",
    "type 1 file commas type 2 single": "commas line 1 is not 'x y r': 0,0,1",
    "type 1 file not-a-number type 2 single": "not-a-number line 2 is not 'x y r': 2 0 nan",
    "type 1 file negative type 2 single": "file negative: disc 2 has radius -1",
    "type 1 file binary type 2 single": "binary line 1 is not text",
    "type 1 file . type 2 single": "template file . is a folder",
}


def offer(arguments: str, directory: Path) -> tuple[int, str]:
    write_data(directory / "discs.data", [Disc(0, 0), Disc(0.01, 0, type=2)], (-0.02, 0.02, -0.02, 0.02))
    for name, content in FILES.items():
        (directory / name).write_bytes(content)
    deck = f"include ${{decks}}/start.in\nfix shape all cdem/shape {arguments}\n"
    return start(deck + 'print "not refused"\nfix move grains cdem/integrate dt auto\nrun 0\n', directory)


def test_good_templates(tmp_path: Path) -> None:
    for template in ("single", "triple", "file good", "discs 1 0 0 1"):
        arguments = f"type 1 {template} type 2 single density 26.5"
        status, output = offer(arguments, tmp_path)
        assert status == 0 and "not refused" in output, arguments


def test_a_template_file_in_another_folder(tmp_path: Path) -> None:
    (tmp_path / "shapes").mkdir()
    (tmp_path / "shapes" / "pair").write_text("0 0 1\n2 0 1\n")
    for folder, name in (("shapes", "pair"), ("nowhere", tmp_path / "shapes" / "pair")):
        status, output = offer(f"folder {folder} type 1 file {name} type 2 single density 26.5", tmp_path)
        assert status == 0 and "not refused" in output, output


LENS = 2 * math.pi / 3 - SQRT3 / 2  # area that two discs of radius 1 share when their centres are 1 apart


@pytest.mark.parametrize(
    ("template", "discs", "size", "fill"),
    [
        ("single", 1, 1, 1),
        ("triple", 3, 1 + 2 / SQRT3, 3 / (1 + 2 / SQRT3) ** 2),
        ("discs 2 0 0 2 3 0 1", 2, 1.7, 5 / 3.4**2),  # their centre is 0.6 from the larger one: 3.4 = 2.4 + 1
        ("discs 2 5 5 1 6 5 1", 2, 1.5, (2 - LENS / math.pi) / 1.5**2),
        ("discs 5 0 0 1 1 0 1 -1 0 1 0 1 1 0 -1 1", 5, 2, (4 + 2 * math.pi) / (4 * math.pi)),  # a square, 4 half discs
    ],
)
def test_what_a_shape_says_of_itself(tmp_path: Path, template: str, discs: int, size: float, fill: float) -> None:
    """Discs of a grain, circumscribed circle over the largest disc, area over that of the circle; per type."""
    deck = f"""
    include ${{decks}}/start.in
    fix shape all cdem/shape type 1 single type 2 {template}
    print "discs = $(f_shape[2][1])"
    print "size = $(f_shape[2][2]:%.17g)"
    print "fill = $(f_shape[2][3]:%.17g)"
    print "first = $(f_shape[1][1]+f_shape[1][2]+f_shape[1][3])"
    """
    out = run(deck, tmp_path, discs=[Disc(0, 0), Disc(0.01, 0, type=2)])
    assert out.printed("first") == 3
    assert out.printed("discs") == discs
    assert out.printed("size") == pytest.approx(size, rel=1e-15)
    assert out.printed("fill") == pytest.approx(fill, rel=1e-13)


@pytest.mark.parametrize(("arguments", "message"), REFUSED.items(), ids=[key.replace("\n", "; ") for key in REFUSED])
def test_refused(tmp_path: Path, arguments: str, message: str) -> None:
    """Before the run, with the value in the message."""
    status, output = offer(arguments, tmp_path)
    assert status != 0
    assert "not refused" not in output
    [error] = [line for line in output.splitlines() if line.startswith("ERROR")]
    assert message in error
