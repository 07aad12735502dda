# SPDX-License-Identifier: GPL-2.0-or-later
"""The contact law in LIGGGHTS against the closed forms that the engine's own tests use, tests/decks/test_restitution.py and
test_friction.py, which have the derivations; with their tolerances, as the scheme is the same."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from host import Disc, run, start

SPEED, STIFFNESS, DIAMETER = 0.1, 1e8, 4e-3  # m/s, N/m, m
R = 10.0  # m, radius of a floor that is flat over the distances here
BOX = (-11.0, 11.0, -11.0, 11.0)
FLOOR = Disc(0, -R, 2 * R, type=2)
MU = math.tan(math.radians(27))
KINDS = {
    "equal": (DIAMETER, DIAMETER),
    "unequal": (DIAMETER * math.sqrt(5 / 8), 2 * DIAMETER * math.sqrt(5 / 8)),
    "wall": (DIAMETER / math.sqrt(2), DIAMETER),
}
W0 = math.sqrt(STIFFNESS / (Disc(0, 0, DIAMETER).mass / 2))

IMPACTS = """
include ${decks}/start.in
fix move grains cdem/integrate dt any
timestep ${dt}
run ${steps}
include ${decks}/end.in
"""


def restitution(h: float) -> float:
    return math.exp(-math.pi * h / math.sqrt(1 - h * h))


def impacts(dt: float, phases: int) -> list[Disc]:
    """Pairs of discs of all kinds, which touch at evenly spread fractions of a step."""
    discs = []
    for row, (kind, phase) in enumerate((kind, phase) for kind in KINDS for phase in range(phases)):
        small, large = KINDS[kind]
        gap, y = SPEED * dt * (phase + 0.5) / phases, 0.01 * (row + 0.5)
        discs.append(Disc(-small / 2, y, small, vx=SPEED))
        discs.append(Disc(large / 2 + gap, y, large, type=2 if kind == "wall" else 1))
    return discs


@pytest.mark.parametrize("h, tolerance", [(0, 5e-5), (0.05, 3e-5), (0.215, 1e-4), (0.5, 8e-4)])
def test_restitution(tmp_path: Path, law: str, ranks: int, h: float, tolerance: float) -> None:
    """e = exp(-pi h/sqrt(1 - h^2)), at 40 steps a contact."""
    dt = math.pi / W0 / 40
    discs = impacts(dt, 16)
    end = run(
        IMPACTS, tmp_path, discs, (-0.02, 0.02, 0, 0.005 * len(discs)), law=law, ranks=ranks, hn=h, hs=h, dt=dt,
        steps=math.ceil(40 / math.sqrt(1 - h * h)) + 5,
    ).end  # fmt: skip
    v = end["vx"].reshape(-1, 2)
    assert (v[:, 1] - v[:, 0]) / SPEED == pytest.approx(restitution(h), rel=tolerance)


def test_restitution_if_the_dashpot_may_not_pull(tmp_path: Path, law: str) -> None:
    h, dt = 0.215, math.pi / W0 / 40
    root = math.sqrt(1 - h * h)
    expected = math.exp(-h / root * (math.pi - math.atan2(2 * h * root, 1 - 2 * h * h)))
    discs = impacts(dt, 16)
    box = (-0.02, 0.02, 0, 0.005 * len(discs))
    end = run(IMPACTS, tmp_path, discs, box, law=law, cut="on", dt=dt, steps=46).end
    v = end["vx"].reshape(-1, 2)
    assert (v[:, 1] - v[:, 0]) / SPEED == pytest.approx(expected, rel=4e-3)


def test_stick(tmp_path: Path, law: str, ranks: int) -> None:
    """A disc pressed between two walls turns to and fro against the tangential springs of both, as a damped oscillator."""
    ks, hs, overlap, spin, steps = 1e7, 0.05, 1e-6, 10.0, 240
    disc = Disc(0, 0, omega=spin)
    height = disc.radius + R - overlap
    walls = [Disc(0, -height, 2 * R, type=2), Disc(0, height, 2 * R, type=2)]
    lever = 1 - overlap / 2 / disc.radius
    w = 2 * lever * math.sqrt(ks / disc.mass)
    damped = w * math.sqrt(1 - (2 * hs * lever) ** 2)
    dt = 2 * math.pi / w / steps
    deck = """
    include ${decks}/start.in
    fix move grains cdem/integrate
    timestep ${dt}
    dump d grains custom 1 turn.dump id x y f_move[6]
    dump_modify d format "%d %.17g %.17g %.17g"
    run ${steps}
    """
    out = run(deck, tmp_path, [disc, *walls], BOX, ranks=ranks, law=law, ks=ks, hs=hs, dt=dt, steps=steps)
    t = dt * np.arange(steps + 1)
    angle = spin / damped * np.exp(-2 * hs * lever * w * t) * np.sin(damped * t)
    assert np.abs(out.series("turn.dump", "f_move[6]")[:, 0] - angle).max() < 5e-4 * spin / damped


@pytest.mark.parametrize("begin", ["thrown", "spun"])
def test_sliding_ends_in_rolling(tmp_path: Path, law: str, ranks: int, begin: str) -> None:
    """The force is the Coulomb limit until slip ceases, at t = v0/(3 mu g); then v = 2/3 v0 (thrown) or r w0/3 (spun)."""
    v0, kn, ks, g, dt, steps = 0.01, 1e5, 1e6, 10.0, 2e-6, 2600
    r, mass = DIAMETER / 2, Disc(0, 0).mass
    y = r - mass * g / kn
    disc = Disc(0, y, vx=v0) if begin == "thrown" else Disc(0, y, omega=-v0 / r)
    deck = """
    include ${decks}/start.in
    fix weight grains gravity ${g} vector 0 -1 0
    fix move grains cdem/integrate
    timestep ${dt}
    dump d grains custom 2 slide.dump id vx omegaz fx
    dump_modify d format "%d %.17g %.17g %.17g"
    run ${steps}
    """
    out = run(deck, tmp_path, [disc, FLOOR], BOX, ranks=ranks, law=law, kn=kn, ks=ks, hs=0.01, g=g, dt=dt, steps=steps)
    t = dt * np.arange(0, steps + 1, 2)
    vx, omega, fx = (out.series("slide.dump", name)[:, 0] for name in ("vx", "omegaz", "fx"))
    end, limit = v0 / (3 * MU * g), MU * mass * g
    assert t[np.abs(fx) > 0.999 * limit].max() == pytest.approx(end, rel=0.005, abs=2 * dt)
    slides = (t > 5 * dt) & (t < 0.99 * end)
    assert np.abs(fx[slides]) == pytest.approx(limit, rel=2e-6)
    final = v0 * (2 / 3 if begin == "thrown" else 1 / 3)
    assert vx[-1] == pytest.approx(final, rel=1e-4)
    assert -omega[-1] * r == pytest.approx(final, rel=1e-4)


def test_a_new_contact_knows_nothing_of_the_last(tmp_path: Path, law: str, ranks: int) -> None:
    """A spinning disc bounces between floor and roof, in one neighbour list. Another run begins as it came from the floor
    the first time, without any history: it goes on alike, as all is forgotten when a contact opens. A contact that were
    still known when it closes again would not see that it closes: 9e-3 of its speed."""
    dt, drop = math.pi / math.sqrt(STIFFNESS / Disc(0, 0).mass) / 100, 1e-7
    deck = """
    include ${decks}/start.in
    fix move grains cdem/integrate dt any
    fix roof walls cdem/move speed 0
    timestep ${dt}
    dump d grains custom 1 bounce.dump id y vx vy omegaz
    dump_modify d format "%d %.17g %.17g %.17g %.17g"
    run 700
    """
    above = DIAMETER / 2
    first = Disc(0, above + drop, vy=-SPEED, omega=20.0)
    roof = Disc(0, 2 * above + R + 2 * drop, 2 * R, type=2)
    done = run(deck, tmp_path / "first", [first, FLOOR, roof], BOX, law=law, ranks=ranks, dt=dt)
    y, vx, vy, omega = (done.series("bounce.dump", name)[:, 0] for name in ("y", "vx", "vy", "omegaz"))
    after = np.flatnonzero((y > above + 0.5 * drop) & (vy > 0))[0]
    assert omega[after] != omega[0] and np.count_nonzero(np.diff(np.sign(vy))) > 2
    again = Disc(0, y[after], vx=vx[after], vy=vy[after], omega=omega[after])
    anew = run(deck, tmp_path / "again", [again, FLOOR, roof], BOX, law=law, ranks=ranks, dt=dt)
    rest = len(y) - after
    assert anew.series("bounce.dump", "omegaz")[:rest, 0] == pytest.approx(omega[after:], rel=1e-4)
    assert anew.series("bounce.dump", "vx")[:rest, 0] == pytest.approx(vx[after:], rel=1e-4, abs=1e-6)


def test_a_negative_coefficient_of_friction_is_refused(tmp_path: Path) -> None:
    deck = IMPACTS.replace(
        "fix move", "fix mu all property/global coefficientFriction peratomtypepair 2 -0.5 -0.5 -0.5 -0.5\nfix move", 1
    )
    run(IMPACTS, tmp_path, [Disc(0, 0)], dt=1e-6, steps=1)
    status, output = start(deck, tmp_path, dt=1e-6, steps=1)
    assert status != 0 and "the coefficient of friction -0.5 0 or more, for types 1 1" in output


def test_without_the_library_liggghts_says_so(tmp_path: Path) -> None:
    deck = "units si\ndimension 2\natom_style sphere\npair_style gran model direct_accumulation\n"
    status, output = start(deck, tmp_path, preload=False)
    assert status != 0 and "ERROR" in output
