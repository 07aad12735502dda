# SPDX-License-Identifier: GPL-2.0-or-later
"""Tangential force: the spring in stick, the Coulomb limit, sliding that comes to an end, oblique impacts.

The floor is one wall disc of 10 m radius: over the distances here (1e-8 to 1e-5 m) it is flat.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import Disc, run
from scenes import mini_box

R = 10.0  # m, radius of the floor
BOX = (-11.0, 11.0, -11.0, 11.0)
FLOOR = Disc(0, -R, 2 * R, type=2)
MU = math.tan(math.radians(27))


def test_shear_spring_in_stick(tmp_path: Path, law: str, ranks: int) -> None:
    """A disc pressed between two walls, with a spin: it turns to and fro against the tangential springs of both.

    m r^2/2 d2q/dt2 = -2 l^2 (ks q + cs dq/dt), lever arm l = r - overlap/2, cs = 2 hs sqrt(m ks): an oscillator with
    W = 2 (l/r) sqrt(ks/m) and damping ratio 2 hs l/r:  q = w0/Wd exp(-2 hs (l/r) W t) sin(Wd t).
    Tolerance: the scheme's frequency is second order, W^2 dt^2/24 = 3e-5 at 240 steps a period, or 2e-4 over a period.
    """
    ks, hs, overlap, spin = 1e7, 0.05, 1e-6, 10.0
    disc = Disc(0, 0, omega=spin)
    height = disc.radius + R - overlap
    walls = [Disc(0, -height, 2 * R, type=2), Disc(0, height, 2 * R, type=2)]
    lever = 1 - overlap / 2 / disc.radius
    w = 2 * lever * math.sqrt(ks / disc.mass)
    damped = w * math.sqrt(1 - (2 * hs * lever) ** 2)
    steps = 240
    dt = 2 * math.pi / w / steps
    out = run(
        """
        include ${decks}/start.in
        fix move grains cdem/integrate
        timestep ${dt}
        dump d grains custom 1 turn.dump id x y omegaz tqz f_move[4]
        dump_modify d format float %.17g
        run ${steps}
        """,
        tmp_path, discs=[disc, *walls], box=BOX, ranks=ranks, law=law, ks=ks, hs=hs, dt=dt, steps=steps,
    )  # fmt: skip
    t = dt * np.arange(steps + 1)
    angle = spin / damped * np.exp(-2 * hs * lever * w * t) * np.sin(damped * t)
    measured = out.series("turn.dump", "f_move[4]")[:, 0]
    assert np.abs(measured - angle).max() < 5e-4 * spin / damped
    # The walls' forces cancel: the disc stays where it is. 10 m in a double have steps of 2e-15 m, 2e-7 N in the force.
    assert np.abs(out.series("turn.dump", "x")).max() < 1e-15
    assert np.abs(out.series("turn.dump", "y")).max() < 1e-14


SLIDE = """
include ${decks}/start.in
fix weight grains gravity ${g} vector 0 -1 0
fix move grains cdem/integrate inertia ${factor}
timestep ${dt}
compute energy grains cdem/energy
thermo_style custom step c_energy[2]
thermo_modify format float %.17g
dump d grains custom 2 slide.dump id x y vx omegaz fx
dump_modify d format float %.17g
run ${steps}
"""


@pytest.mark.parametrize("start", ["thrown", "spun"])
def test_sliding_ends_in_rolling(tmp_path: Path, law: str, ranks: int, start: str) -> None:
    """As in LAMMPS's own tests (there a sphere: 5/7)."""
    slide_until_it_rolls(tmp_path, start, law=law, ranks=ranks)


@pytest.mark.parametrize("start", ["thrown", "spun"])
@pytest.mark.parametrize("factor", [0.25, 3.0])
def test_sliding_with_another_inertia(tmp_path: Path, anywhere: dict[str, Any], start: str, factor: float) -> None:
    slide_until_it_rolls(tmp_path, start, factor, **anywhere)


@pytest.mark.parametrize("start", ["thrown", "spun"])
def test_cohesion_adds_to_the_limit_of_friction(tmp_path: Path, anywhere: dict[str, Any], start: str) -> None:
    slide_until_it_rolls(tmp_path, start, cohesion=0.5, **anywhere)


def slide_until_it_rolls(directory: Path, start: str, factor: float = 1, cohesion: float = 0, **options: Any) -> None:
    """A disc set on a floor slides until it rolls.

    Angular momentum about the contact is kept, v + F r w/2 = const with the inertia F m r^2/2 (w: rolling forward):
    thrown with v0, it ends with v = v0/(1 + F/2), spun with w0, with v = r w0/(1 + 2/F), either at t = v0/(mu g (1 + 2/F))
    with v0 = r w0. Friction is that of its weight and of cohesion, which is given in weights: of g (1 + cohesion).
    """
    v0, kn, ks, weight = 0.01, 1e5, 1e6, 10.0
    hs = 0.01 if factor <= 1 else 0.02  # what is left of sliding decays more slowly
    g = weight * (1 + cohesion)  # in all that presses
    overlap = Disc(0, 0).mass * g / kn
    y, r = Disc(0, 0).radius - overlap, Disc(0, 0).radius
    disc = Disc(0, y, vx=v0) if start == "thrown" else Disc(0, y, omega=-v0 / r)  # forward is a negative spin
    dt, steps = 2e-6, 2600
    out = run(
        SLIDE, directory, discs=[disc, FLOOR], box=BOX, kn=kn, ks=ks, hs=hs, g=weight, dt=dt, steps=steps, factor=factor,
        added=f"cohesion {cohesion * disc.mass * weight}" if cohesion else "", **options,
    )  # fmt: skip
    t = dt * np.arange(0, steps + 1, 2)
    vx, omega, fx = (out.series("slide.dump", name)[:, 0] for name in ("vx", "omegaz", "fx"))

    # The spring takes mu g m/(ks v0) = 2e-7 s to reach the limit; its dashpot, until then, takes 1e-3 of v0.
    end = v0 / (MU * g * (1 + 2 / factor))
    limit = MU * disc.mass * g
    assert t[np.abs(fx) > 0.999 * limit].max() == pytest.approx(end, rel=0.005, abs=2 * dt)
    # While it slides, the force is the limit. Coordinates of 10 m have a last bit of 2e-15 m: 5e-8 of the overlap; and
    # the floor is bent: v0^2/(R g) = 1e-6 of the weight.
    slides = (t > 5 * dt) & (t < 0.99 * end)
    assert np.abs(fx[slides]) == pytest.approx(limit, rel=2e-6)

    # Whatever the tangential force is; but downhill on the bent floor the disc gains g t s/R = 1.2e-7 m/s in the end.
    lever = r - overlap / 2
    conserved = vx - factor * disc.inertia / disc.mass / lever * omega
    assert conserved == pytest.approx(conserved[0], rel=2e-5)
    # The tangential dashpot ends the oscillation that is left of sliding, exp(-sqrt(3) hs w t) = 1e-4 with w^2 = 3 ks/m.
    final = v0 / (1 + factor / 2 if start == "thrown" else 1 + 2 / factor)
    assert vx[-1] == pytest.approx(final, rel=1e-4)
    assert -omega[-1] * lever == pytest.approx(final, rel=1e-4)
    energy = factor * disc.inertia * omega[-1] ** 2 / 2
    assert out.thermo["c_energy[2]"][-1] == pytest.approx(energy, rel=1e-12)


IMPACT = """
include ${decks}/start.in
fix move grains cdem/integrate dt any
timestep ${dt}
run ${steps}
include ${decks}/end.in
"""


@pytest.mark.parametrize("h", [0, 0.215])
@pytest.mark.parametrize("against", ["wall", "disc"])
def test_oblique_impact_in_the_sliding_regime(tmp_path: Path, law: str, ranks: int, h: float, against: str) -> None:
    """Impacts that slide from first to last touch (Chung & Ooi 2011, tests 3 to 5).

    The Coulomb limit is mu e_n and the dashpot's impulse is c x from 0 to 0, so the tangential impulse is exactly
    J_t = mu J_n, J_n = m_eff (1 + e) v_n, and each disc gets J_t/m and the spin r J_t/I. Sliding throughout needs
    v_t > 3 mu (1 + e) v_n, and from the first moment ks v_t > mu kn v_n.
    The error is that of e (see test_restitution): 0 for h = 0, 3e-4 at 100 steps a contact and h = 0.215.
    """
    kn, vn, phases = 1e8, 1e-5, 8  # slow: 6e-7 rad is all that the normal turns in a contact, 2e-5 of v_n at 40 v_n
    mass = Disc(0, 0).mass
    effective = mass if against == "wall" else mass / 2
    dt, steps = math.pi * math.sqrt(effective / kn) / 100, 115
    vt = vn * 4 * np.arange(1, phases + 1)  # 76 to 88 degrees from the normal
    discs: list[Disc] = []
    for k in range(phases):
        gap = vn * dt * (k + 0.5) / phases
        x = 0.01 * (k - (phases - 1) / 2)
        discs += [Disc(x, 0.002 + gap, vx=vt[k], vy=-vn), Disc(x, -0.002, type=2 if against == "wall" else 1)]
    end = run(
        IMPACT, tmp_path, discs=discs, box=(-0.05, 0.05, -0.05, 0.05), ranks=ranks, law=law, kn=kn, hn=h, hs=h, dt=dt, steps=steps,
    ).end  # fmt: skip
    vx, vy, omega = (end[name].reshape(-1, 2) for name in ("vx", "vy", "omegaz"))

    e = math.exp(-math.pi * h / math.sqrt(1 - h * h))
    normal = effective * (1 + e) * vn
    accuracy = 5e-4 if h else 5e-5
    assert vy[:, 0] + vn == pytest.approx(normal / mass, rel=accuracy)
    tangential = (vt - vx[:, 0]) * mass
    assert tangential == pytest.approx(MU * normal, rel=accuracy)
    assert -omega[:, 0] == pytest.approx(MU * normal * discs[0].radius / discs[0].inertia, rel=accuracy)
    if against == "disc":
        assert vx[:, 1] == pytest.approx(MU * normal / mass, rel=accuracy)
        assert omega[:, 1] == pytest.approx(omega[:, 0], rel=1e-6)
    # Tangential and normal impulse are in the ratio mu case by case, whatever e is.
    assert tangential / ((vy[:, 0] + vn) * mass) == pytest.approx(np.full(phases, MU), rel=1e-3)
    # Rebound angle: tan = (v_t - mu (1 + e) v_n)/(e v_n), for free discs the relative velocity's.
    slip, rebound = vx[:, 0] - vx[:, 1], vy[:, 0] - vy[:, 1]
    expected = (vt - MU * normal / effective) / (e * vn)
    assert slip / rebound / expected == pytest.approx(1, rel=1e-3)


def test_the_limit_is_exact_in_a_packing(tmp_path: Path, ranks: int) -> None:
    """Every contact that slides has |ft| = tan(phi) kn overlap, where the dashpots do not count; none that sticks has
    a spring beyond it. To round-off of the overlaps, 4e-18 m of some 1e-7 m."""
    deck = """
    include ${decks}/mini_box.in
    compute c all cdem/contacts ft overlap sliding
    dump c all local 20 contacts.dump c_c[1] c_c[2] c_c[3]
    dump_modify c format float %.17g
    run 200
    """
    discs, box = mini_box()
    # Without tangential dashpots, ft is the spring's force. The increments of the other law don't sum to the overlap.
    frames = run(deck, tmp_path, discs=discs, box=box, law="direct", ranks=ranks, hs=0).dump("contacts.dump")
    ft, overlap, sliding = (np.concatenate([f[f"c_c[{k}]"] for f in frames]) for k in (1, 2, 3))
    touch = overlap > 0  # else it has just opened, and may let go of what it held
    ft, limit, sliding = ft[touch], MU * 1e8 * overlap[touch], sliding[touch] == 1
    assert np.count_nonzero(sliding) > 20 and np.count_nonzero(~sliding) > 20
    assert np.abs(ft[sliding]) == pytest.approx(limit[sliding], rel=1e-9, abs=1e-12)
    assert np.all(np.abs(ft) <= limit * (1 + 1e-9) + 1e-12)
