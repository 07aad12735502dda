# SPDX-License-Identifier: GPL-2.0-or-later
"""Local damping of fix cdem/integrate: a share A of each component of the force on a grain opposes its motion."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest
from engine import Disc, EngineError, run, same_bits
from scenes import cloud

DECK = """
include ${decks}/start.in
fix      move grains cdem/integrate dt any gravity ${gx} ${gy} damping ${damping}
timestep ${dt}
compute  books grains cdem/energy audit yes
fix      sums all ave/time ${steps} 1 ${steps} c_books[*] mode scalar file books.dat
thermo   ${steps}
run      ${steps}
include  ${decks}/end.in
"""
PLAIN = re.sub("(compute|fix +sums).*\n", "", DECK)  # without an audit: on the rows
A = 0.3


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_up_and_down(tmp_path: Path, ranks: int, style: str) -> None:
    """Thrown up, a grain is stopped by g (1 + A); it falls with g (1 - A). In the step that turns it the velocity is off by
    2 A g dt at most."""
    g, v, dt, steps = 10.0, 0.1, 1e-5, 2000
    turn = v / (g * (1 + A))
    out = run(
        PLAIN, tmp_path, discs=[Disc(0, 0, vy=v)], ranks=ranks, style=style, gx=0, gy=-g, damping=A, dt=dt, steps=steps
    )
    assert out.end["vy"][0] == pytest.approx(-g * (1 - A) * (steps * dt - turn), abs=2 * A * g * dt)
    assert out.end["vx"][0] == 0


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_a_grain_on_a_spring(tmp_path: Path, law: str, ranks: int, style: str) -> None:
    """A grain bounces on a wall without dashpot, pressed so hard that it never leaves it: it starts an
    amplitude below equilibrium, where it overlaps by four. Each half of the oscillation begins
    and ends at rest: on the way in the force is 1 - A, on the way out 1 + A of the spring's, so that amplitudes fall by
    sqrt((1 - A)/(1 + A)). The frequency, kn (1 -+ A)/m, is that of a quarter: the time of a whole oscillation is
    pi sqrt(m/kn) (1/sqrt(1 - A) + 1/sqrt(1 + A))."""
    grain = Disc(0, 0)
    kn, amplitude, dt = 1e8, 1e-6, 1e-8
    g = 4 * amplitude * kn / grain.mass
    period = math.pi * math.sqrt(grain.mass / kn) * (1 / math.sqrt(1 - A) + 1 / math.sqrt(1 + A))
    steps = round(3 * period / dt)
    discs = [Disc(0, 0), Disc(0, -4e-3 + 5 * amplitude, type=2)]
    out = run(PLAIN, tmp_path, discs=discs, law=law, ranks=ranks, style=style, hn=0, hs=0, gx=0, gy=-g, damping=A, dt=dt,
              steps=steps)  # fmt: skip
    left = ((1 - A) / (1 + A)) ** 3 * amplitude
    assert out.end["y"][0] - amplitude == pytest.approx(-left, rel=2e-3)


def test_what_it_takes_out_is_booked(tmp_path: Path) -> None:
    """Discs collide without friction or dashpots: the energy they lose has gone into damping, to round-off and what the
    contacts' own steps leave over, with nothing else that asks for every step; the same grains with the same damping end
    alike without an audit."""
    discs = cloud(4, 0.5)
    options: dict[str, Any] = {"discs": discs, "hn": 0, "hs": 0, "phi": 0, "gx": 0, "gy": 0, "damping": A}
    out = run(DECK, tmp_path, **options, dt=1e-7, steps=20000)
    names = "translation rotation springs tangential friction dashpots drag walls gravity residual".split()
    got = dict(zip(names, map(float, (tmp_path / "books.dat").read_text().split("\n")[-2].split()[1:]), strict=True))
    before = sum(d.mass * (d.vx**2 + d.vy**2) / 2 + d.inertia * d.omega**2 / 2 for d in discs)
    after = got["translation"] + got["rotation"] + got["springs"]
    assert got["drag"] == pytest.approx(before - after, rel=1e-3) and got["drag"] > 0.05 * before
    bare = run(PLAIN, tmp_path / "bare", **options, dt=1e-7, steps=20000)
    assert same_bits(bare.end, out.end)


@pytest.mark.parametrize("damping", ["1", "-0.1"])
def test_refused(tmp_path: Path, damping: str) -> None:
    with pytest.raises(EngineError, match=f"damping {damping}: must be from 0 to less than 1"):
        run(PLAIN, tmp_path, discs=[Disc(0, 0)], gx=0, gy=0, damping=damping, dt=1e-6, steps=1)


LIMIT = """
include ${decks}/start.in
fix      move grains cdem/integrate dt any gravity 0 -${g} damping ${damping} rescue none
timestep ${dt}
compute  limit all cdem/limit
thermo_style custom step f_move c_limit
thermo   ${steps}
thermo_modify format float %.17g
run      ${steps}
include  ${decks}/end.in
"""


@pytest.mark.parametrize("share", [0.97, 1.03])
def test_the_stability_limit(tmp_path: Path, law: str, share: float) -> None:
    """Of a grain on a spring: the force that resists is 1 + A times that of the spring, so that leapfrog is stable up to
    2 sqrt(m/(kn (1 + A))). Below, the grain comes to rest; above, it leaves the wall or blows up. Both limits that are told know
    it: that of the contact is never more, that of the worst packing lower by the same factor."""
    grain, a = Disc(0, 0), 0.7
    kn, amplitude = 1e8, 1e-7
    exact = 2 * math.sqrt(grain.mass / kn / (1 + a))
    discs = [grain, Disc(0, -4e-3 + 5 * amplitude, type=2)]
    options: dict[str, Any] = {
        "discs": discs,
        "law": law,
        "hn": 0,
        "hs": 0,
        "ks": 0,
        "g": 4 * amplitude * kn / grain.mass,
    }
    told = run(LIMIT, tmp_path / "told", **options, damping=a, dt=1e-8, steps=0).thermo
    bare = run(LIMIT, tmp_path / "bare", **options, damping=0, dt=1e-8, steps=0).thermo
    assert 0.87 * exact < told["c_limit"][0] <= exact * (1 + 1e-9)
    assert told["f_move"][0] == pytest.approx(bare["f_move"][0] / math.sqrt(1 + a), rel=1e-12)
    try:
        out = run(LIMIT, tmp_path, **options, damping=a, dt=share * exact, steps=2000)
        calm = abs(out.end["vy"][0]) < 1e-3 * amplitude / exact
    except EngineError as error:
        assert "blow" in str(error) or "moved" in str(error)
        calm = False
    assert calm == (share < 1)


SWITCHED_ON = """
include ${decks}/start.in
fix      move grains cdem/integrate dt any gravity 0 -10
timestep 1e-6
compute  books grains cdem/energy audit yes
thermo   1000
thermo_style custom step c_books[7] c_books[9] c_books[10]
thermo_modify format float %.17g
run      1000
fix_modify move damping ${damping}
run      1000 pre no
"""


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_the_books_of_damping_that_is_switched_on_between_runs(tmp_path: Path, style: str) -> None:
    """A grain that falls: damping takes the A-fold of the work of gravity since, also in a run without a setup. But for the
    first half step of the second run, which begins with the acceleration that was."""
    books = run(SWITCHED_ON, tmp_path, discs=[Disc(0, 0, vy=-1)], style=style, damping=A).thermo
    drag, gravity, residual = (books[f"c_books[{k}]"] for k in (7, 9, 10))
    assert drag[0] == 0
    assert drag[1] == pytest.approx(A * (gravity[1] - gravity[0]), rel=1e-3)
    assert abs(residual[1]) < 1e-3 * drag[1]
