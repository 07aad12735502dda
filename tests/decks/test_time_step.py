# SPDX-License-Identifier: GPL-2.0-or-later
"""The stability limit of the time step, which fix cdem/integrate states and watches over."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from engine import Disc, EngineError, run
from scenes import kinetic_energy, lattice

KN, KS = 1e8, 2.5e7

VIBRATE = """
include ${decks}/start.in
fix move grains cdem/integrate dt any
variable limit equal f_move
thermo_style custom step v_limit
thermo_modify format float %.17g
run 0
variable dt equal ${limit}*${fraction}
timestep ${dt}
dump d all custom 5 vibration.dump mass radius vx vy omegaz
run 400
"""


def largest_kinetic_energy(directory: Path, fraction: float, h: float, law: str) -> float:
    """Of a vibrating lattice over 400 steps, as a multiple of what it has at first."""
    discs, box = lattice(6, 6, 1e-5, speed=0.01)
    out = run(VIBRATE, directory, discs=discs, box=box, bx="p", by="p", law=law, phi=89, hn=h, hs=h, fraction=fraction)
    kinetic = [kinetic_energy(frame) for frame in out.dump("vibration.dump")]
    return max(kinetic) / kinetic[0]


def blows_up(directory: Path, fraction: float, h: float, law: str) -> bool:
    """Whether the energy grows a hundredfold, or so much that the run is stopped."""
    try:
        return largest_kinetic_energy(directory, fraction, h, law) > 100
    except EngineError as stopped:
        return "the run is unstable" in str(stopped)


@pytest.mark.parametrize("h", [0, 0.05, 0.215, 0.5, 1.0])
def test_lattice_is_stable_up_to_the_limit_and_not_beyond(tmp_path: Path, law: str, h: float) -> None:
    """The triangular lattice has the most contacts a disc can have, and on it the limit is exact. Half of it and of all
    the fractions between must be stable, too: a dashpot that is carried forward too far blows up in between."""
    for fraction in (0.5, 0.7, 0.8, 0.9, 0.98):
        assert largest_kinetic_energy(tmp_path, fraction, h, law) < 2, fraction
    assert blows_up(tmp_path, 1.03, h, law)


@pytest.mark.parametrize("h", [0, 0.215])
def test_the_limit_is_that_of_the_smallest_grain(tmp_path: Path, ranks: int, h: float) -> None:
    """Undamped: 2/sqrt(max(6 kn + 3 ks, 24 ks)/m), from Bloch waves on the lattice of equal discs. With damping, the
    positive root of K dt^2 + 2 C dt = 4 m of either mode."""
    small, large = Disc(-0.01, -0.01, 2e-3), Disc(0.01, 0.01, 4e-3)
    out = run(VIBRATE, tmp_path, discs=[large, small], ranks=ranks, hn=h, hs=h, fraction=0.5)
    m = small.mass
    limit = math.inf
    for k, normal, tangential in ((6 * KN + 3 * KS, 6, 3), (24 * KS, 0, 24)):
        c = 2 * h * math.sqrt(m / 2) * (normal * math.sqrt(KN) + tangential * math.sqrt(KS))
        limit = min(limit, (math.sqrt(c * c + 4 * m * k) - c) / k)
    assert out.thermo["v_limit"][0] == pytest.approx(limit, rel=1e-12)


AUTO = """
include ${decks}/start.in
fix move grains cdem/integrate dt auto ${largest}
variable limit equal f_move
thermo_style custom step dt v_limit
thermo_modify format float %.17g
run 0
"""


@pytest.mark.parametrize("largest", [1e-6, 1e-8])
def test_automatic_time_step(tmp_path: Path, ranks: int, largest: float) -> None:
    out = run(AUTO, tmp_path, discs=[Disc(-0.01, -0.01, 2e-3), Disc(0.01, 0.01)], ranks=ranks, largest=largest)
    limit = out.thermo["v_limit"][0]
    assert out.thermo["Dt"][0] == pytest.approx(min(0.9 * limit, largest), rel=1e-12)


ORDER = """
include ${decks}/start.in
timestep 5e-7
if "${first} == gravity" then "fix weight grains gravity 100 vector 0 -1 0"
fix move grains cdem/integrate
if "${first} == integrate" then "fix weight grains gravity 100 vector 0 -1 0"
run 10
include ${decks}/end.in
"""


@pytest.mark.parametrize("first", ["gravity", "integrate"])
def test_free_fall_from_the_first_step(tmp_path: Path, ranks: int, first: str) -> None:
    """v = -g t, y = -g t^2/2 exactly, wherever the fix that adds the force stands in the deck."""
    out = run(ORDER, tmp_path, discs=[Disc(0, 0)], ranks=ranks, first=first).end
    assert out["vy"][0] == pytest.approx(-100 * 5e-6, rel=1e-14)
    assert out["y"][0] == pytest.approx(-100 * 5e-6**2 / 2, rel=1e-14)
