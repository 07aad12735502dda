# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains of several discs have the same bits however the work is cut."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from clumps import END, FIELDS, LONG, R, SINGLE, TRIPLE, Clump, begin, contacts, dump_contacts
from engine import Disc, Frame, Run, run, same_bits
from scenes import cloud

# A dense crowd in a box of wall discs: grains of four and three discs and single ones, turned at random and pressed
# together. All bits agree however the work is cut.

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
