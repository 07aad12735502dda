# SPDX-License-Identifier: GPL-2.0-or-later
"""The same input gives the same bits, however the work is cut: over ranks, into runs, by restarts and rebuilds.

The scene is mini_box.in: 52 grains in frictional contact, some of which cross the borders between ranks, with a lid and
a moving floor. Trajectories of such a packing part by e-folding times of some hundred steps: one wrong bit shows.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import DECKS, Frame, Run, run, same_bits
from scenes import Box, mini_box

DECK = (DECKS / "mini_box.in").read_text()
COLUMNS = ("id", "x", "y", "vx", "vy", "omegaz", "fx", "fy", "tqz", "f_move[1]", "f_move[2]", "f_move[3]", "f_move[4]")

ADDED = "rolling 0.3 0.2 cohesion 40"  # the pull is that of 4e-7 m of overlap


def mini(directory: Path, law: str, box: Box | None = None, **options: Any) -> Run:
    discs, default_box = mini_box()
    return run(DECK, directory, discs=discs, box=box or default_box, law=law, **options)


@pytest.fixture(scope="module", params=["direct", "incremental"])
def law(request: pytest.FixtureRequest) -> str:
    """As everywhere, but with one reference run for all tests of a law."""
    return request.param


@pytest.fixture(scope="module")
def reference(law: str, tmp_path_factory: pytest.TempPathFactory) -> Run:
    """All in one run on one rank."""
    return mini(tmp_path_factory.mktemp(law), law)


@pytest.fixture(scope="module")
def with_additions(law: str, tmp_path_factory: pytest.TempPathFactory) -> Run:
    return mini(tmp_path_factory.mktemp(law), law, added=ADDED)


def same(a: Run, b: Run) -> bool:
    """The end states, and what the lid and the floor say of themselves and of the forces they feel."""
    last = [{name: values[-1] for name, values in run.thermo.items()} for run in (a, b)]
    if last[0] != last[1]:
        print(last[0], last[1], sep="\n")
    return same_bits(a.end, b.end, COLUMNS) and last[0] == last[1]


def builds(out: Run) -> int:
    """Of the neighbour list, in the first run."""
    return next(int(line.split("=")[1]) for line in out.log.splitlines() if line.startswith("Neighbor list builds"))


def test_the_scene_is_worth_it(reference: Run) -> None:
    discs, _ = mini_box()
    end: Frame = reference.end
    free = end["type"] == 1
    assert np.count_nonzero(end["fx"][free]) > 20  # in contact
    crossed = [(np.array([getattr(d, k) for d in discs]) >= 0) != (end[k] >= 0) for k in "xy"]  # borders between ranks
    assert np.count_nonzero((crossed[0] | crossed[1]) & free) >= 5
    assert np.abs(reference.thermo["f_floor[3]"][-1]) > 1  # N, with friction
    assert "Dangerous builds = 0" in reference.log


def test_gravity_is_that_of_fix_gravity(tmp_path: Path, law: str, reference: Run) -> None:
    assert same(reference, mini(tmp_path, law, gravity="stock"))


def test_run_style_cdem(tmp_path: Path, law: str, ranks: int, reference: Run) -> None:
    """Its steps are those of run_style verlet; the list is rebuilt at other steps."""
    out = mini(tmp_path, law, ranks=ranks, style="verlet/cdem")
    assert "Dangerous builds = 0" in out.log and "Run style verlet/cdem is no faster" not in out.log
    assert builds(out) != builds(reference)
    assert same(reference, out)


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_a_run_without_setup(tmp_path: Path, law: str, ranks: int, style: str, reference: Run) -> None:
    assert same(reference, mini(tmp_path, law, ranks=ranks, plan="resumed", style=style))


@pytest.mark.parametrize("instructions", ["avx512", "avx2"])
@pytest.mark.parametrize("added", ["", ADDED])
def test_vector_width(
    tmp_path: Path, law: str, instructions: str, added: str, reference: Run, with_additions: Run
) -> None:
    if instructions not in Path("/proc/cpuinfo").read_text():
        pytest.skip(f"no {instructions} here")
    deck = DECK.replace('"include ${decks}/start.in"', f'"include ${{decks}}/start.in" "pair_style cdem law ${{law}} '
                        f'instructions {instructions}" "pair_coeff * * ${{kn}} ${{ks}} ${{hn}} ${{hs}} ${{phi}} ${{added}}"')  # fmt: skip
    assert instructions in deck
    discs, box = mini_box()
    out = run(deck, tmp_path, discs=discs, box=box, law=law, added=added)
    assert same(with_additions if added else reference, out)


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
@pytest.mark.parametrize(("written_by", "read_by"), [(1, 2), (2, 4), (4, 1)])
def test_additions_to_the_law(
    tmp_path: Path, law: str, style: str, written_by: int, read_by: int, with_additions: Run
) -> None:
    """Rolling resistance and cohesion: on any number of ranks, in both run styles, and from a restart file, which has the
    additions and what contacts remember of them."""
    options: dict[str, Any] = {"added": ADDED, "style": style}
    assert same(with_additions, mini(tmp_path, law, ranks=written_by, plan="write", **options))
    assert same(with_additions, mini(tmp_path, law, ranks=read_by, plan="read", style=style))


@pytest.mark.parametrize(("written_by", "read_by"), [(1, 4), (2, 1)])
def test_run_style_cdem_restarts(tmp_path: Path, law: str, written_by: int, read_by: int, reference: Run) -> None:
    assert same(reference, mini(tmp_path, law, ranks=written_by, plan="write", style="verlet/cdem"))
    assert same(reference, mini(tmp_path, law, ranks=read_by, plan="read", style="verlet/cdem"))


@pytest.mark.parametrize("ranks", [2, 4])
def test_ranks(tmp_path: Path, law: str, ranks: int, reference: Run) -> None:
    assert same(reference, mini(tmp_path, law, ranks=ranks))


@pytest.mark.parametrize("ranks", [2, 4])
def test_ranks_without_grains(tmp_path: Path, law: str, ranks: int, reference: Run) -> None:
    """In a larger box, one of the ranks has all discs."""
    out = mini(tmp_path, law, ranks=ranks, box=(-0.03, 0.2, -0.03, 0.2))
    assert "Nlocal:" in out.log and " 0 min" in next(
        line for line in out.log.splitlines() if line.startswith("Nlocal:")
    )
    assert same(reference, out)


def test_two_runs_are_one(tmp_path: Path, law: str, ranks: int, reference: Run) -> None:
    assert same(reference, mini(tmp_path, law, ranks=ranks, plan="two"))


@pytest.mark.parametrize(("written_by", "read_by"), [(1, 1), (1, 4), (2, 1), (4, 2), (4, 4)])
def test_restart_in_mid_contact(tmp_path: Path, law: str, written_by: int, read_by: int, reference: Run) -> None:
    """Binary restart: writing it changes nothing, and the run that reads it ends like the one that was not interrupted."""
    assert same(reference, mini(tmp_path, law, ranks=written_by, plan="write"))
    assert same(reference, mini(tmp_path, law, ranks=read_by, plan="read"))


@pytest.mark.parametrize("rebuild", ["in-every-step", "never"])
def test_neighbour_list(tmp_path: Path, law: str, ranks: int, rebuild: str, reference: Run) -> None:
    options: dict[str, Any] = {"skin": 0.006} if rebuild == "never" else {"every": "yes"}
    out = mini(tmp_path, law, ranks=ranks, **options)
    assert builds(out) == (0 if rebuild == "never" else 5000)
    assert same(reference, out)


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_output_changes_nothing(tmp_path: Path, law: str, ranks: int, style: str, reference: Run) -> None:
    """single() by compute pair/local, energies and virials at odd steps leave the trajectory alone."""
    out = mini(tmp_path, law, ranks=ranks, output="yes", style=style)
    assert same_bits(reference.end, out.end, COLUMNS)
    assert np.count_nonzero(out.dump("pairs.dump")[-1]["c_p[3]"]) > 20
