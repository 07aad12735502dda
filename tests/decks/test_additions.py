# SPDX-License-Identifier: GPL-2.0-or-later
"""The decks' variables rolling, cohesion and inertia: they count in consolidation and shear, the first two not in packing."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import Run, run
from input_decks import INPUT, SHEARING, SPECIMEN

from shearbox_tools.base.files import CONTACTS_DUMP, GRAINS_DUMP, PACKED_TABLE, SHEAR_TABLE
from shearbox_tools.reading.dumps import Dump
from shearbox_tools.reading.readers import Columns, read_shear

KN = 1e8  # N/m
SHORT: dict[str, Any] = SPECIMEN | SHEARING | {"model": "few", "speed": 50, "rest": 0.01}
MODEL = """
variable width       index 0.03
variable half_height index 0.012
variable dmin        index 2e-3
variable dmax        index 3e-3
variable power       index 0
variable ngrains     index 90
variable shape       index single
"""


def carried_out(folder: Path, deck: str, **more: Any) -> Run:
    (folder / "few.in").write_text(MODEL)
    variables: dict[str, Any] = SHORT | {"models": folder, **more}
    return run((INPUT / f"{deck}.in").read_text(), folder, **variables)


@pytest.fixture(name="packed", scope="module")
def _packed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("additions")
    carried_out(folder, "pack")
    return folder


def sheared(folder: Path, packed: Path, **more: Any) -> Columns:
    """Consolidated and sheared with other values of variables."""
    folder.mkdir(exist_ok=True)
    carried_out(folder, "consolidate", packed=packed / "packed.restart", **more)
    carried_out(folder, "shear", **more)
    return read_shear(folder / SHEAR_TABLE)


def test_packing_knows_neither_cohesion_nor_rolling_resistance(tmp_path: Path, packed: Path) -> None:
    carried_out(tmp_path, "pack", cohesion=1000, rolling=10)
    assert (tmp_path / PACKED_TABLE).read_bytes() == (packed / PACKED_TABLE).read_bytes()


def test_cohesion_pulls_grains_together_and_not_walls(tmp_path: Path, packed: Path) -> None:
    """At rest, before shear, the normal force is k_n overlap - F_c between grains, and k_n overlap at a wall."""
    force = 20.0
    sheared(tmp_path, packed, cohesion=force, rolling=0.1)
    rows = Dump(tmp_path / CONTACTS_DUMP, ("id1", "id2", "fn", "overlap")).frame(0)
    grains = Dump(tmp_path / GRAINS_DUMP, ("id", "wall")).frame(0)
    walls = grains["id"][grains["wall"] == 1]
    of_grains = ~np.isin(rows["id1"], walls) & ~np.isin(rows["id2"], walls)
    assert 50 < np.count_nonzero(of_grains) < len(of_grains) - 10
    expected = KN * rows["overlap"] - np.where(of_grains, force, 0)
    assert rows["fn"] == pytest.approx(expected, abs=0.01 * force)  # what dashpots still do


def test_rolling_resistance_keeps_grains_from_turning(tmp_path: Path, packed: Path) -> None:
    free, held = (sheared(tmp_path / f"{r}", packed, rolling=r, speed=200)["trm"][-1] for r in (0, 10))
    assert held < 0.5 * free


def test_light_grains_need_smaller_steps(tmp_path: Path, packed: Path) -> None:
    """Where turning decides, dashpots do: a step is stable up to 2 I over their sum, in proportion to the inertia I."""
    rows = [sheared(tmp_path / f"{f}", packed, inertia=f, travel=0.1) for f in (1, 0.04, 0.01)]
    dt = [row["time_s"][-1] / row["step"][-1] for row in rows]
    assert dt[1] < 0.9 * dt[0]
    assert dt[2] / dt[1] == pytest.approx(0.25, rel=0.03)  # springs still count a little
