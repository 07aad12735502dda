# SPDX-License-Identifier: GPL-2.0-or-later
"""What a contact remembers lasts as long as the contact: not longer, and not less when grains cross a border."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import Disc, Frame, run, same_bits
from scenes import lattice, shifted

ADDED = "rolling 0.05 0.2 cohesion 1"  # at first touch the spring holds

BOUNCE = """
include ${decks}/start.in
fix weight grains gravity 2000 vector 0 -1 0
fix move grains cdem/integrate
timestep 2e-7
dump all grains custom 1 path.dump id x y vx vy omegaz fx fy tqz
dump_modify all format float %.17g
run ${steps}
"""
STATE = ("x", "y", "vx", "vy", "omegaz", "fx", "fy", "tqz")


@pytest.mark.parametrize(("cut", "added"), [("no", ""), ("yes", ""), ("no", ADDED)])
def test_contact_starts_afresh(tmp_path: Path, law: str, ranks: int, cut: str, added: str) -> None:
    """A disc falls obliquely on another and bounces twice, with no rebuild of the neighbour list between. The second
    impact is the same, to the bit, as that of a disc which starts in the flight between the two, without a past."""
    grain, floor = Disc(1e-3, 3.8731e-3, vx=0.05, vy=-0.05, omega=10), Disc(0, 0, type=2)
    options: dict[str, Any] = {"law": law, "cut": cut, "added": added, "ranks": ranks, "skin": 1e-3}
    whole = run(BOUNCE, tmp_path / "whole", discs=[grain, floor], steps=600, **options)
    assert "Neighbor list builds = 0" in whole.log
    path = whole.dump("path.dump")
    touching = np.array([frame["tqz"][0] != 0 for frame in path])
    starts = np.flatnonzero(~touching[:-1] & touching[1:])
    ends = np.flatnonzero(touching[:-1] & ~touching[1:])
    assert len(starts) >= 2, "there is no second impact"

    between = path[(ends[0] + starts[1]) // 2]
    x, y, vx, vy, omega = (between[name][0] for name in STATE[:5])
    fresh = replace(grain, x=x, y=y, vx=vx, vy=vy, omega=omega)
    alone = run(BOUNCE, tmp_path / "alone", discs=[fresh, floor], steps=600 - between.step, **options).dump("path.dump")
    for a, b in zip(path[between.step :], alone, strict=True):
        assert [a[name][0] for name in STATE] == [b[name][0] for name in STATE], f"step {a.step}"


COLLIDE = """
include ${decks}/start.in
fix move grains cdem/integrate
timestep 1e-7
run ${steps}
include ${decks}/end.in
"""


def oblique_pair(drift: float) -> list[Disc]:
    """Two discs of unequal size about to collide in the origin; both drift along x."""
    left, right = 4e-3, 3e-3
    return [
        Disc(-left / 2, 0, left, vx=drift + 0.1, vy=-0.02, omega=5),
        Disc(right / 2 + 1e-7, 1e-4, right, vx=drift - 0.1, vy=0.03),
    ]


def motion(state: Frame) -> np.ndarray:
    return np.array([state["vx"], state["vy"], state["omegaz"]])


@pytest.mark.parametrize("shift", [0.02, -0.0201, 0.6], ids=["at-the-border", "beyond-it", "many-boxes-away"])
def test_collision_across_a_periodic_border(tmp_path: Path, law: str, ranks: int, shift: float) -> None:
    """While they touch, the discs pass the border of the box and the neighbour list is rebuilt again and again: the same
    as in the middle of a box, within the round-off of the overlap, 3e-18/1e-7."""
    options: dict[str, Any] = {"law": law, "steps": 100, "skin": 2e-6, "box": (-0.02, 0.02, -0.02, 0.02)}
    inside = run(COLLIDE, tmp_path / "inside", discs=oblique_pair(1.0), **options)
    across = run(COLLIDE, tmp_path / "across", discs=shifted(oblique_pair(1.0), shift), ranks=ranks, bx="p", **options)
    builds = next(line for line in across.log.splitlines() if line.startswith("Neighbor list builds"))
    assert int(builds.split("=")[1]) >= 5
    assert np.all(inside.end["omegaz"] != [5, 0]), "no friction"
    assert motion(across.end) == pytest.approx(motion(inside.end), rel=1e-8)


@pytest.mark.parametrize("added", ["", ADDED])
def test_both_images_of_a_pair_are_near(tmp_path: Path, law: str, added: str) -> None:
    """Two discs in a box of two diameters bounce to and fro between each other's images, closer than any skin. One image
    does not take over what the contact with the other remembers: whenever the list is made, the same forces."""
    discs = [Disc(0, 0, vx=1, omega=100), Disc(3.98e-3, 1e-4, vx=-1)]
    options: dict[str, Any] = {"law": law, "added": added, "steps": 300, "box": (-4e-3, 4e-3, -4e-3, 4e-3), "bx": "p", "by": "p"}  # fmt: skip
    seldom, often = (run(COLLIDE, tmp_path / str(skin), discs=discs, skin=skin, **options) for skin in (1e-3, 1e-4))
    assert seldom.end["tqz"][0] != 0
    assert motion(often.end) == pytest.approx(motion(seldom.end), rel=1e-9)


def test_collision_across_ranks(tmp_path: Path, law: str, ranks: int) -> None:
    """The same between ranks, whose border passes through the contact: here to the bit."""
    options: dict[str, Any] = {"law": law, "steps": 100, "skin": 2e-6}
    alone = run(COLLIDE, tmp_path / "alone", discs=oblique_pair(1.0), **options)
    out = run(COLLIDE, tmp_path / "ranks", discs=oblique_pair(1.0), ranks=ranks, **options)
    assert np.array_equal(motion(out.end), motion(alone.end))


RENUMBERED = """
include ${{decks}}/start.in
group lone id 1
fix move grains cdem/integrate
timestep 1e-7
run 50
{change}
run 50
include ${{decks}}/end.in
"""
FROM_FILE = """
write_restart between.restart
clear
newton off
processors ${px} ${py} 1
read_restart between.restart
comm_modify vel yes
neighbor ${skin} bin
run_style ${style}
fix move grains cdem/integrate
timestep 1e-7
"""
NEW_IDS = {
    "delete": "delete_atoms group lone",
    "delete-restart": "delete_atoms group lone" + FROM_FILE,
    "reset": "delete_atoms group lone compress no\nreset_atom_ids",
}


@pytest.mark.parametrize(
    ("change", "added"), [*((change, "") for change in NEW_IDS), ("delete-restart", "rolling 0.3 0.2 cohesion 100")]
)
def test_history_follows_new_ids(tmp_path: Path, law: str, ranks: int, change: str, added: str) -> None:
    """A grain far from all others is taken away, which gives new ids to these: the same as if they had kept theirs, to
    the bit if the order of the ids is the same, as on one rank; else forces are summed in another order, and the moment of
    rolling resistance is that on the other disc of a pair."""
    discs, (_, width, _, height) = lattice(6, 6, 1e-6, speed=0.05)
    discs = [Disc(0.019, 0.019), *shifted(discs, -width / 2, -height / 2)]
    options: dict[str, Any] = {"discs": discs, "law": law, "added": added, "ranks": ranks, "skin": 1e-3}
    kept = run(RENUMBERED.format(change="delete_atoms group lone compress no"), tmp_path / "kept", **options).end
    new = run(RENUMBERED.format(change=NEW_IDS[change]), tmp_path / "new", **options).end
    assert np.array_equal(kept["id"], np.arange(2, 38))
    assert np.array_equal(new["id"], np.arange(1, 37))
    squares = (new["x"][:, None] - kept["x"]) ** 2 + (new["y"][:, None] - kept["y"]) ** 2
    same = np.argmin(squares, axis=1)
    if np.array_equal(same, np.arange(36)):
        assert same_bits(new, kept, STATE)
    else:
        assert motion(new) == pytest.approx(motion(kept)[:, same], rel=1e-8)


REPLACED = """
include ${decks}/start.in
fix move grains cdem/integrate
timestep 1e-7
run 20
group second id 2
delete_atoms group second compress no
create_atoms 1 single 3.97e-3 0 0
set atom 2 diameter 4e-3
set atom 2 density/disc 26.5
velocity all set 0 0 0
set group all omega 0 0 0
group grains type 1
run 0
include ${decks}/end.in
"""


def test_a_new_grain_with_the_id_of_one_that_is_gone_is_new(tmp_path: Path, law: str, ranks: int) -> None:
    """In its place, touching the same grain: no spring has been sheared between the two, and both are at rest, so the force is
    along the line of the centres."""
    end = run(REPLACED, tmp_path, discs=[Disc(0, 0), Disc(3.97e-3, 0, vy=1)], law=law, ranks=ranks).end
    assert np.array_equal(end["id"], [1, 2])
    along = np.array([np.diff(end["x"])[0], np.diff(end["y"])[0]])
    force = np.array([end["fx"][0], end["fy"][0]])
    assert np.dot(force, along) < 0, "no contact"
    assert abs(force[0] * along[1] - force[1] * along[0]) <= 1e-14 * np.linalg.norm(force) * np.linalg.norm(along)


def test_a_grain_with_many_contacts_moves_on(tmp_path: Path, law: str) -> None:
    """A grain in contact with 1200 others comes from a restart file and goes to the other rank at once. (If LAMMPS's
    buffer for it is too small, only tests/sanitize is sure to find that.)"""
    large, small = Disc(-0.02, 0, 0.02, omega=10), 2.6e-5
    angles = np.linspace(0, 2 * np.pi, 1200, endpoint=False)
    x, y = (large.radius + small - 1e-7) * np.array([np.cos(angles), np.sin(angles)])
    discs = [large, *(Disc(-0.02 + dx, dy, 2 * small, type=2) for dx, dy in zip(x, y, strict=True))]
    box = (-0.04, 0.04, -0.04, 0.04)
    options: dict[str, Any] = {"discs": discs, "box": box, "law": law, "ranks": 2, "skin": 1e-4, "kn": 1e6, "ks": 2.5e5}
    stays = run(RENUMBERED.format(change=FROM_FILE), tmp_path / "stays", **options).end
    moves = run(RENUMBERED.format(change=FROM_FILE + "balance 1.0 x 0.1"), tmp_path / "moves", **options).end
    assert abs(stays["tqz"][0]) > 1e-5, "no friction"
    assert same_bits(moves, stays, STATE)
