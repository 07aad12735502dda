# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixes of other developers whose names begin like ours, in the program lmp_stranger: what they do is not left out."""

from __future__ import annotations

from pathlib import Path

import engine
import pytest
from engine import Disc, run, start

STEPS = 50
HEAD = "include ${decks}/start.in\nfix move grains cdem/integrate\ntimestep 1e-7\n"
COUNTED = f"""{HEAD}
fix stranger all cdem/counter
run {STEPS}
print "calls = $(f_stranger)"
"""


@pytest.fixture(autouse=True)
def stranger(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "PROGRAM", engine.PROGRAM.with_name("lmp_stranger"))


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_a_fix_with_a_name_like_ours_is_called_in_every_step(tmp_path: Path, style: str) -> None:
    done = run(COUNTED, tmp_path, discs=[Disc(0, 0)], style=style)
    assert done.printed("calls") == STEPS
    warned = "fix stranger of style cdem/counter acts in every step" in done.log
    assert warned == (style == "verlet/cdem")


def test_a_second_integrator_with_a_name_like_ours_is_refused(tmp_path: Path) -> None:
    deck = HEAD + "fix twice grains cdem/second\nrun 1\n"
    (tmp_path / "first").mkdir()
    run(HEAD + "run 1\n", tmp_path / "first", discs=[Disc(0, 0)])
    (tmp_path / "discs.data").write_text((tmp_path / "first" / "discs.data").read_text())
    status, output = start(deck, tmp_path)
    assert status != 0
    assert "Fix cdem/integrate move: fix twice of style cdem/second moves grains of its group too" in output
