# SPDX-License-Identifier: GPL-2.0-or-later
"""Virial: right, and the same wherever the scene is.  P = sum over contacts of force x branch / area, in N/m."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import run
from scenes import lattice, mini_box, shifted

KN = 1e8

PRESSURE = """
include ${decks}/start.in
fix move grains cdem/integrate dt any
compute p all pressure NULL virial
compute s all stress/atom NULL virial
compute sum all reduce sum c_s[1] c_s[2] c_s[4]
thermo_style custom step c_p[1] c_p[2] c_p[4] c_sum[1] c_sum[2] c_sum[3] press pe
thermo_modify format float %.17g
timestep 2e-7
run ${steps}
"""


def stress(thermo: dict[str, np.ndarray]) -> np.ndarray:
    """xx, yy, xy of the last step."""
    return np.array([thermo[f"c_p[{k}]"][-1] for k in (1, 2, 4)])


def test_pressure_of_a_lattice(tmp_path: Path, law: str, ranks: int) -> None:
    """Each disc of a triangular lattice has three contacts of its own, of force kn u and branch b = d - u:
    P = sum f b/(2 A) in any direction. The overlap of 1e-5 m is known to 1e-12 of it."""
    overlap = 1e-5
    discs, box = lattice(6, 6, overlap)
    out = run(PRESSURE, tmp_path, discs=discs, box=box, bx="p", by="p", law=law, ranks=ranks, steps=0)
    area = (box[1] - box[0]) * (box[3] - box[2])
    pressure = 3 * len(discs) * KN * overlap * (discs[0].diameter - overlap) / (2 * area)
    assert stress(out.thermo) == pytest.approx([pressure, pressure, 0], rel=1e-10, abs=1e-10 * pressure)
    assert out.thermo["Press"][0] == pytest.approx(pressure, rel=1e-10)  # at rest: no kinetic part
    per_atom = [out.thermo[f"c_sum[{k}]"][0] for k in (1, 2, 3)]
    assert per_atom == pytest.approx(-stress(out.thermo) * area, rel=1e-10, abs=1e-10 * pressure * area)
    assert out.thermo["PotEng"][0] == pytest.approx(3 * len(discs) * KN * overlap**2 / 2, rel=1e-10)


@pytest.mark.parametrize("away", [4.0, -2000.0], ids=["1000-diameters", "500000-diameters"])
def test_stress_is_independent_of_position(tmp_path: Path, law: str, ranks: int, away: float) -> None:
    """A vibrating lattice far from the origin. Its overlaps of 1e-5 m feel the last bit of the coordinates, 9e-16 m and
    2e-13 m: 1e-10 and 2e-8 of them."""
    overlap = 1e-5
    discs, box = lattice(6, 6, overlap, speed=0.5)
    options: dict[str, Any] = {"bx": "p", "by": "p", "law": law, "ranks": ranks, "steps": 100}
    here = run(PRESSURE, tmp_path / "here", discs=discs, box=box, **options)
    moved_box = (box[0] + away, box[1] + away, box[2] - away, box[3] - away)
    there = run(PRESSURE, tmp_path / "there", discs=shifted(discs, away, -away), box=moved_box, **options)
    scale = stress(here.thermo)[:2].max()
    assert stress(there.thermo) == pytest.approx(stress(here.thermo), abs=1e-11 * abs(away) * scale)


def test_stress_from_contacts(tmp_path: Path, law: str, ranks: int) -> None:
    """The pressure tensor and the per-atom stresses agree with the sum over the contacts of force x branch, with friction,
    damping, walls and a lid, and grains across the borders between ranks."""
    discs, box = mini_box()
    deck = """
    variable steps index 4000
    include ${decks}/mini_box.in
    compute p all pressure NULL virial
    compute s all stress/atom NULL virial
    compute sum all reduce sum c_s[1] c_s[2] c_s[4]
    compute c all cdem/contacts id1 id2 fx fy
    dump c all local 1 contacts.dump c_c[1] c_c[2] c_c[3] c_c[4]
    dump_modify c format float %.17g
    thermo_style custom step c_p[1] c_p[2] c_p[4] c_sum[1] c_sum[2] c_sum[3]
    thermo_modify format float %.17g
    run 1
    include ${decks}/end.in
    """
    out = run(deck, tmp_path, discs=discs, box=box, law=law, ranks=ranks, state="after.dump")
    after, contacts = out.dump("after.dump")[0], out.dump("contacts.dump")[-1]
    assert len(contacts["c_c[1]"]) > 10
    i, j = (contacts[f"c_c[{k}]"].astype(int) - 1 for k in (1, 2))
    branch = [after[k][i] - after[k][j] for k in "xy"]
    force = [contacts["c_c[3]"], contacts["c_c[4]"]]
    virial = np.array([force[0] @ branch[0], force[1] @ branch[1], force[1] @ branch[0]])
    area = (box[1] - box[0]) * (box[3] - box[2])
    scale = np.abs(virial).max()
    assert stress(out.thermo) * area == pytest.approx(virial, abs=1e-10 * scale)
    assert -np.array([out.thermo[f"c_sum[{k}]"][-1] for k in (1, 2, 3)]) == pytest.approx(virial, abs=1e-10 * scale)
