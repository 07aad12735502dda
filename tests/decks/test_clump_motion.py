# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains of several discs that fly, collide and rock: closed forms, and the time step that they need."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from clumps import END, R, SQRT3, TRIPLE, UNEVEN, Clump, Vector, begin, contacts, cross, dump, dump_contacts
from engine import Disc, Run, run, same_bits
from impact import restitution
from scenes import both_laws

FLOOR = Disc(0, -10, 20, type=2)  # flat over the distances here
FLOOR_BOX = (-11.0, 11.0, -21.0, 1.0)


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

STEPS_PER_CONTACT = 400
# The dashpot's error at the ends of the contact is second order: 2e-5 and 3e-5 at 400 steps; undamped, it is 1e-5.
COLLIDE = "timestep ${dt}\nrun ${steps}\n" + END


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
