# SPDX-License-Identifier: GPL-2.0-or-later
"""Rolling resistance: spring, limit and dashpot of the moment by which two discs resist turning on each other.

    k_r = 3 k_n (mu_r R)^2,   |M| <= mu_r R e_n,   c_r = 2 h_r sqrt(J k_r),   1/J = sum of 1/(I + m r^2)

A floor is one wall disc of 10 m radius, flat over the distances here; with it R is a disc's own radius, but for 2e-4, and
J its inertia about the rim. The same bits, restarts, new ids, momenta and the audit in motion: test_same_bits.py,
test_contact_history.py, test_conservation.py, test_audit.py; the limit of the time step: test_time_step.py.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import Disc, Run, run, same_bits
from scenes import lattice

FLAT = 10.0  # m, radius of a floor
BOX = (-11.0, 11.0, -11.0, 11.0)
RADIUS = Disc(0, 0).radius
ROLLING_RADIUS = RADIUS * FLAT / (RADIUS + FLAT)
# A disc with two small ones at its sides, and its inertia and mass over those of the disc alone (radius 2, then 1 twice).
WINGED = "discs 3 0 0 2 3 0 1 -3 0 1"
WINGED_MASS = (4 + 2) / 4
WINGED_INERTIA = (4 * 2 + 2 * (0.5 + 9)) / (4 * 2)


@pytest.mark.parametrize(("shape", "factor"), [("single", 1.0), ("single", 0.25), (WINGED, 1.0)])
def test_turning_to_and_fro(tmp_path: Path, anywhere: dict[str, Any], shape: str, factor: float) -> None:
    """A disc pressed between two smooth walls, with a spin: I d2q/dt2 = -2 (k_r q + c_r dq/dt), also if it is part of a
    grain, or has another inertia. With W = sqrt(2 k_r/I) and damping ratio D = h_r sqrt(2 J/I) that is
    q = w/W' exp(-D W t) sin(W' t), W' = W sqrt(1 - D^2). Of second order: (W dt)^2/24 is the error of the frequency, 3e-5
    at 240 steps a period, 2e-4 in a period; halving the step takes 3/4 of it."""
    kn, overlap, mu_r, h_r, spin = 1e7, 1e-6, 0.2, 0.05, 0.1
    alone = Disc(0, 0)
    mass = alone.mass * (WINGED_MASS if shape == WINGED else 1)
    inertia = alone.inertia * (WINGED_INERTIA if shape == WINGED else 1) * factor
    diameter = alone.diameter * (2 if shape == WINGED else 1)  # circumscribed
    k_r = 3 * kn * (mu_r * ROLLING_RADIUS) ** 2
    w = math.sqrt(2 * k_r / inertia)
    damping = h_r * math.sqrt(2 * (inertia + mass * RADIUS**2) / inertia)
    damped = w * math.sqrt(1 - damping**2)
    assert spin / w * k_r < 0.1 * mu_r * ROLLING_RADIUS * kn * overlap  # far from the limit
    height = RADIUS + FLAT - overlap
    discs = [Disc(0, 0, diameter, omega=spin), *(Disc(0, y, 2 * FLAT, type=2) for y in (-height, height))]
    deck = """
    include ${decks}/start.in
    fix shape all cdem/shape type 1 ${shape} type 2 single density ${density}
    fix move grains cdem/integrate dt any inertia ${factor}
    timestep ${dt}
    dump d grains custom 1 turn.dump y f_move[4]
    dump_modify d format float %.17g
    run ${steps}
    """
    error = []
    for steps in (120, 240):
        dt = 2 * math.pi / w / steps
        out = run(
            deck, tmp_path / str(steps), discs=discs, box=BOX, **anywhere, kn=kn, ks=0, phi=0, dt=dt,
            steps=steps, shape=shape, factor=factor, added=f"rolling {mu_r} {h_r}",
        )  # fmt: skip
        t = dt * np.arange(steps + 1)
        angle = spin / damped * np.exp(-damping * w * t) * np.sin(damped * t)
        error.append(np.abs(out.series("turn.dump", "f_move[4]")[:, 0] - angle).max() / (spin / damped))
        assert np.abs(out.series("turn.dump", "y")).max() < 1e-14  # walls 10 m away: their last bits
    assert error[1] < 5e-4
    assert error[0] / error[1] == pytest.approx(4, rel=0.1)


TWIST = """
include ${decks}/start.in
pair_coeff 1 3 ${kn} 0 0 0 0 rolling ${mu} 0
fix move all cdem/integrate dt any
timestep ${dt}
compute c all cdem/contacts id1 id2 rolling
compute energy all cdem/energy
thermo_style custom step pe c_energy[3]
thermo_modify format float %.17g
thermo 100
dump c all local 100 contacts.dump c_c[*]
dump d all custom 100 twist.dump id tqz
dump_modify c format float %.17g
dump_modify d format float %.17g sort id
run 2000
"""


@pytest.mark.parametrize("first", [1, 3], ids="type-{}-first".format)
def test_moment_up_to_its_limit(tmp_path: Path, anywhere: dict[str, Any], first: int) -> None:
    """Two smooth discs, too heavy to be slowed, turn on each other at u: M = -k_r u t on the one that turns, up to
    mu_r R e_n, and the opposite on the other, whichever has the lower id; `rolling` is that on grain 1. A pair of types
    without rolling resistance has none. Energies have M^2/(2 k_r)."""
    kn, overlap, mu, u, dt, r1, r3 = 1e6, 1e-6, 0.25, 2.0, 1e-6, 2e-3, 3e-3
    distance = r1 + r3 - overlap
    one, three = Disc(0, 0, 2 * r1, omega=u / 4, type=1), Disc(distance, 0, 2 * r3, omega=-3 * u / 4, type=3)
    same = [Disc(x, 0.01, 2 * r1, omega=w) for x, w in ((-0.01, u), (-0.01 + 2 * r1 - overlap, 0))]
    discs = [one, three] if first == 1 else [three, one]
    out = run(
        TWIST, tmp_path, discs=[*discs, *same], **anywhere, kn=kn, ks=0, hn=0, hs=0, phi=0, density=1e12, mu=mu,
        dt=dt,
    )  # fmt: skip
    arm = mu * r1 * r3 / (r1 + r3)
    k_r, limit = 3 * kn * arm**2, arm * kn * overlap
    t = dt * 100 * np.arange(21)
    moment = np.minimum(k_r * u * t, limit)
    assert 0.3 < np.mean(moment == limit) < 0.9  # both happen
    sign = -1 if first == 1 else 1  # type 1 gains on type 3, so it is held back
    frames = out.dump("contacts.dump")
    by_pair = [{(int(a), int(b)): m for a, b, m in zip(*f.columns.values(), strict=True)} for f in frames]
    # In 2 ms the heavy discs are pressed apart by 1 N t^2/m = 2e-7 of the overlap.
    assert np.array([m[1, 2] for m in by_pair]) == pytest.approx(sign * moment, rel=1e-6)
    assert {m[3, 4] for m in by_pair} == {0}
    torque = out.series("twist.dump", "tqz")
    assert torque[:, 0] == pytest.approx(sign * moment, rel=1e-6)
    assert np.array_equal(torque[:, 1], -torque[:, 0]) and not torque[:, 2:].any()
    stored = 2 * kn * overlap**2 / 2 + moment**2 / (2 * k_r)
    for energy in ("PotEng", "c_energy[3]"):
        assert out.thermo[energy] == pytest.approx(stored, rel=1e-6), energy


ROLL = """
include ${decks}/start.in
fix move grains cdem/integrate gravity ${gx} ${gy}
timestep ${dt}
compute energy all cdem/energy audit yes
thermo_style custom step c_energy[*]
thermo_modify format float %.17g
thermo ${steps}
dump d grains custom 10 roll.dump x vx omegaz f_move[4]
dump_modify d format float %.17g
run ${steps}
"""
FLOOR = Disc(0, -FLAT, 2 * FLAT, type=2)
G, KN, STEP = 10.0, 1e6, 2e-6


def roll(directory: Path, steps: int, *, mu_r: float, h_r: float, v: float, slope: float, **options: Any) -> Run:
    """A disc rolls along x on a rough floor that goes down by `slope` (rad), or gravity is turned by it."""
    gx, gy = G * math.sin(slope), -G * math.cos(slope)
    disc = Disc(0, RADIUS + Disc(0, 0).mass * gy / KN, vx=v, omega=-v / RADIUS)
    return run(
        ROLL, directory, discs=[disc, FLOOR], box=BOX, kn=KN, ks=KN, hs=0.1, phi=45, gx=gx, gy=gy, dt=STEP, steps=steps,
        added=f"rolling {mu_r} {h_r}", **options,
    )  # fmt: skip


def test_a_rolling_disc_comes_to_rest(tmp_path: Path, anywhere: dict[str, Any]) -> None:
    """The moment mu_r r m g slows it, about the contact with J = 3/2 m r^2: dv/dt = -2/3 mu_r g. It turns until its energy
    is used up, 1/2 of the limit's angle M/k_r later as the spring comes first, and back by that angle as it relaxes. All
    that but for the last spring's energy goes into friction."""
    mu_r, h_r, v, steps = 0.1, 0.1, 0.01, 14000
    out = roll(tmp_path, steps, mu_r=mu_r, h_r=h_r, v=v, slope=0, **anywhere)
    t = 10 * STEP * np.arange(steps // 10 + 1)
    vx, angle = (out.series("roll.dump", name)[:, 0] for name in ("vx", "f_move[4]"))
    disc = Disc(0, 0)
    inertia, moment = 1.5 * disc.mass * RADIUS**2, mu_r * RADIUS * disc.mass * G
    k_r = 3 * KN * (mu_r * RADIUS) ** 2
    middle = (t > 2e-3) & (t < 12e-3)
    slowing = np.polyfit(t[middle], vx[middle], 1)[0]
    # R is 2e-4 less than r; what is left of the stick spring's oscillation.
    assert slowing == pytest.approx(-2 / 3 * mu_r * G, rel=1e-3)
    assert np.abs(vx[-20:]).max() < 1e-4 * v
    energy = inertia * (v / RADIUS) ** 2 / 2
    # Until the limit is reached the dashpot takes 4 h_r sqrt(k_r/J) (M/k_r)/(v/r) = 3e-3.
    assert -angle[-1] == pytest.approx(energy / moment - moment / k_r / 2, rel=4e-3)
    assert out.thermo["c_energy[5]"][-1] == pytest.approx(energy - moment**2 / (2 * k_r), rel=5e-3)
    assert abs(out.thermo["c_energy[10]"][-1]) < 1e-4 * energy


@pytest.mark.parametrize("share", [0.9, 1.1])
def test_critical_slope(tmp_path: Path, anywhere: dict[str, Any], share: float) -> None:
    """A disc stays on a slope as long as m g sin(a) r is less than mu_r R m g cos(a), turned by the angle at which its
    spring holds it; on a steeper one it rolls at 2/3 g (sin(a) - mu_r cos(a)). With h_r = 1 the sudden load does not make
    it swing beyond."""
    mu_r, steps = 0.1, 5000
    slope = math.atan(share * mu_r)
    out = roll(tmp_path, steps, mu_r=mu_r, h_r=1, v=0, slope=slope, **anywhere)
    vx, angle = (out.series("roll.dump", name)[:, 0] for name in ("vx", "f_move[4]"))
    if share < 1:
        held = Disc(0, 0).mass * G * math.sin(slope) * RADIUS / (3 * KN * (mu_r * ROLLING_RADIUS) ** 2)
        assert -angle[-1] == pytest.approx(held, rel=1e-3)
        assert np.abs(vx[-20:]).max() < 1e-9
    else:
        late = slice(len(vx) // 2, None)
        gains = np.polyfit(10 * STEP * np.arange(len(vx))[late], vx[late], 1)[0]
        expected = 2 / 3 * G * (math.sin(slope) - mu_r * ROLLING_RADIUS / RADIUS * math.cos(slope))
        assert gains == pytest.approx(expected, rel=2e-3)


# %s: what comes between the runs.
CHANGE = """
include ${decks}/start.in
fix move grains cdem/integrate inertia ${factor}
timestep 2e-7
run 400
write_restart between.restart
variable state index between.dump
include ${decks}/end.in
%s
variable state delete
variable state index begun.dump
run 1
include ${decks}/end.in
variable state delete
run 399
include ${decks}/end.in
"""
FROM_FILE = """
clear
newton off
processors ${px} ${py} 1
read_restart between.restart
comm_modify vel yes
neighbor ${skin} bin
run_style ${style}
fix move grains cdem/integrate inertia ${factor}
timestep 2e-7
"""


@pytest.mark.parametrize(("first", "then"), [("rolling 0.3 0.1 cohesion 10", ""), ("", "rolling 0.3 0.1 cohesion 10")])
def test_additions_that_come_and_go(tmp_path: Path, anywhere: dict[str, Any], first: str, then: str) -> None:
    """Other additions from a run to the next, in the same deck and by way of a restart file: the same bits, if the
    factor on the inertia is given again. Smooth discs
    change their spin as long as there is rolling resistance, and only then; a run begins with half a step of the
    acceleration there was."""
    discs, box = lattice(6, 6, 1e-6, speed=0.01)
    anew = "pair_coeff * * ${kn} 0 ${hn} 0 0 " + then
    options: dict[str, Any] = {"discs": discs, "box": box, "bx": "p", "by": "p", "added": first} | anywhere
    options |= {"ks": 0, "hs": 0, "phi": 0, "factor": 2.5}
    here, there = (
        run(CHANGE % (way + anew), tmp_path / name, **options) for name, way in (("here", ""), ("there", FROM_FILE))
    )
    assert same_bits(here.end, there.end)
    start = np.array([d.omega for d in discs])
    between, begun = (here.dump(f"{name}.dump")[-1]["omegaz"] for name in ("between", "begun"))
    assert np.array_equal(between, start) == (first == "")
    assert np.array_equal(here.end["omegaz"], begun) == (then == "")
