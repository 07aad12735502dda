# SPDX-License-Identifier: GPL-2.0-or-later
"""The stability limit of the time step, which fix cdem/integrate states and watches over."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from engine import Disc, EngineError, run, same_bits
from scenes import kinetic_energy, lattice

KN, KS = 1e8, 2.5e7

VIBRATE = """
variable which index f_move
variable factor index 1
include ${decks}/start.in
fix move grains cdem/integrate dt any inertia ${factor}
compute limit all cdem/limit
variable limit equal ${which}
thermo_style custom step v_limit
thermo_modify format float %.17g
run 0
variable dt equal ${limit}*${fraction}
timestep ${dt}
dump d all custom 5 vibration.dump mass radius vx vy omegaz
run 400
"""


def largest_kinetic_energy(directory: Path, fraction: float, h: float, law: str, **options: Any) -> float:
    """Of a vibrating lattice over 400 steps, as a multiple of what it has at first."""
    discs, box = lattice(6, 6, 1e-5, speed=0.01)
    options |= {"discs": discs, "box": box, "bx": "p", "by": "p", "law": law, "phi": 89, "hn": h, "hs": h}
    out = run(VIBRATE, directory, fraction=fraction, **options)
    kinetic = [kinetic_energy(frame) for frame in out.dump("vibration.dump")]
    return max(kinetic) / kinetic[0]


def blows_up(directory: Path, fraction: float, h: float, law: str, **options: Any) -> bool:
    """Whether the energy grows a hundredfold, or so much that the run is stopped."""
    try:
        return largest_kinetic_energy(directory, fraction, h, law, **options) > 100
    except EngineError as stopped:
        return "the run is unstable" in str(stopped)


@pytest.mark.parametrize("h", [0, 0.05, 0.215, 0.5, 1.0])
def test_lattice_is_stable_up_to_the_limit_and_not_beyond(tmp_path: Path, law: str, h: float) -> None:
    """The triangular lattice has the most contacts a disc can have, and on it the limit is exact. Half of it and of all
    the fractions between must be stable, too: a dashpot that is carried forward too far blows up in between."""
    for fraction in (0.5, 0.7, 0.8, 0.9, 0.98):
        assert largest_kinetic_energy(tmp_path, fraction, h, law) < 2, fraction
    assert blows_up(tmp_path, 1.03, h, law)


@pytest.mark.parametrize(("which", "beyond"), [("f_move", 1.4), ("c_limit", 1.8)])
@pytest.mark.parametrize(("mu_r", "factor", "h"), [(1, 1, 0), (1, 1, 0.4), (2, 0.5, 0.1), (0, 3, 0), (0.7, 3, 0.1)])
def test_lattice_that_resists_turning(
    tmp_path: Path, which: str, beyond: float, mu_r: float, factor: float, h: float
) -> None:
    """With rolling resistance, and with another inertia, the limits of the scene and of the contacts are stable, and so are
    fractions of them. That of the contacts is up to 40 % below the true one, as both discs of a contact may not turn the
    same way and against each other."""
    options = {"which": which, "factor": factor, "added": f"rolling {mu_r} {h}"}
    for fraction in (0.5, 0.8, 0.98):
        assert largest_kinetic_energy(tmp_path, fraction, h, "direct", **options) < 2, fraction
    assert blows_up(tmp_path, beyond, h, "direct", **options)


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


# `plan` go: from the restart file, with other springs. At the end the grains are pulled apart.
CONTACTS = """
if "${plan} == begin" then "include ${decks}/start.in" &
else "newton off" "read_restart touching.restart" "pair_coeff * * ${kn} 0 ${hn} 0 27"
fix ${id} grains cdem/integrate dt ${rule} ${largest}
variable limit equal f_${id}
thermo_style custom step dt v_limit
thermo_modify format float %.17g
run 0
write_restart touching.restart
displace_atoms grains ramp x -1e-3 1e-3 x -0.01 0.01
run 1
"""


def pair_limit(kn: float, h: float) -> float:
    """Of two smooth discs in contact: the positive root of kn dt^2 + 2 c dt = 4 m/2."""
    m = Disc(0, 0).mass
    c = 2 * h * math.sqrt(m / 2 * kn)
    return (math.sqrt(c * c + 2 * m * kn) - c) / kn


def step_of_contacts(directory: Path, gap: float, h: float = 0.215, **variables: Any) -> tuple[list[float], float]:
    """Time steps of a run with contacts and one without, and the limit of the worst packing."""
    discs = [Disc(-0.002 - gap / 2, 0), Disc(0.002 + gap / 2, 0)]
    options: dict[str, Any] = {
        "ks": 0,
        "hn": h,
        "hs": 0,
        "id": "move",
        "largest": 1,
        "plan": "begin",
        "rule": "contacts",
    }
    thermo = run(CONTACTS, directory, discs=discs, **(options | variables)).thermo
    return list(thermo["Dt"]), thermo["v_limit"][0]


@pytest.mark.parametrize("h", [0, 0.215])
def test_time_step_of_the_contacts(tmp_path: Path, ranks: int, h: float) -> None:
    """0.8 of what two discs in contact allow, also when they have parted."""
    steps, _ = step_of_contacts(tmp_path, -1e-6, h, ranks=ranks)
    assert steps == pytest.approx([0.8 * pair_limit(KN, h)] * len(steps), rel=1e-9)


def test_time_step_of_the_contacts_has_a_maximum(tmp_path: Path) -> None:
    assert step_of_contacts(tmp_path, -1e-6, largest=1e-7)[0] == [1e-7, 1e-7]


def test_time_step_without_contacts(tmp_path: Path, ranks: int) -> None:
    """As dt auto."""
    steps, limit = step_of_contacts(tmp_path, 1e-4, ranks=ranks)
    assert steps == pytest.approx([0.9 * limit] * len(steps), rel=1e-12)


def test_time_step_of_the_contacts_goes_on(tmp_path: Path, ranks: int) -> None:
    """A run from a restart file has the step of the run before, even with other springs; a fix of another ID chooses."""
    first, _ = step_of_contacts(tmp_path, -1e-6, ranks=ranks)
    assert first[0] == pytest.approx(0.8 * pair_limit(KN, 0.215), rel=1e-9)
    other: dict[str, Any] = {"plan": "go", "kn": KN / 4, "ranks": ranks}
    assert set(step_of_contacts(tmp_path, -1e-6, **other)[0]) == {first[0]}
    fresh, _ = step_of_contacts(tmp_path, -1e-6, **other, id="anew")
    assert fresh[0] == pytest.approx(0.8 * pair_limit(KN / 4, 0.215), rel=1e-9)


def test_what_is_asked_for_counts_before_the_step_of_the_contacts(tmp_path: Path) -> None:
    """After a restart, too: dt auto chooses by the worst packing, and a maximum is one."""
    step_of_contacts(tmp_path, -1e-6)
    steps, limit = step_of_contacts(tmp_path, -1e-6, plan="go", kn=KN, rule="auto")
    assert steps == pytest.approx([0.9 * limit] * 2, rel=1e-12)
    step_of_contacts(tmp_path, -1e-6)
    assert step_of_contacts(tmp_path, -1e-6, plan="go", kn=KN, largest=1e-7)[0] == [1e-7, 1e-7]


CHOSEN = """
include ${decks}/start.in
fix move grains cdem/integrate dt contacts
if "${first} > 0" then "run 0"
run 20
include ${decks}/end.in
"""


def test_dashpots_go_with_the_step_that_is_chosen(tmp_path: Path, ranks: int) -> None:
    """They are scaled for the step (mass_of_steps of core/contact_law.h): the first step of a run of its own changes
    nothing."""
    discs, box = lattice(6, 6, 1e-5, speed=0.01)
    options: dict[str, Any] = {"discs": discs, "box": box, "bx": "p", "by": "p", "ranks": ranks}
    at_once, later = (run(CHOSEN, tmp_path / str(first), first=first, **options).end for first in (0, 1))
    assert same_bits(at_once, later)


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


@pytest.mark.parametrize("order", ["move shape", "shape move"])
def test_the_step_is_that_of_the_masses_that_shape_sets(tmp_path: Path, order: str) -> None:
    """In whatever order the fixes are defined: the limit of a run is that of the next."""
    fixes = {
        "move": "fix move grains cdem/integrate dt auto",
        "shape": "fix shape all cdem/shape type 1 triple type 2 single density 26.5",
    }
    deck = (
        "include ${decks}/start.in\n"
        + "\n".join(fixes[name] for name in order.split())
        + """
set group all diameter 0.004
run 0
print "first = $(f_move)"
run 0
print "second = $(f_move)"
"""
    )
    done = run(deck, tmp_path, discs=[Disc(0, 0, 0.4), Disc(0.01, 0.01, type=2)], box=(-1, 1, -1, 1))
    assert done.printed("first") == done.printed("second")
