# SPDX-License-Identifier: GPL-2.0-or-later
"""Computes cdem/trm, contacts, discs, energy: closed forms, the same on any number of ranks, and they only look."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from engine import DENSITY, Disc, Run, run, same_bits, start

START = "include ${decks}/start.in\n"
END = "include ${decks}/end.in\n"
RADIUS = 2e-3  # m, of most discs here
WHOLE = "modify sort id format float %.17g"

# --- rotation rate of motion ----------------------------------------------------------------------

# One crosses the box and both of its periodic borders, one spins clockwise and drifts, one stays where it is.
FREE = [
    Disc(-0.01, -0.015, 4e-3, vx=3, vy=4, omega=10),
    Disc(0.01, 0.01, 2e-3, vx=-0.5, omega=-2000),
    Disc(0.0, -0.01, 4e-3),
]
FREE_TRM = [2e-3 * 10 / 5, 1e-3 * 2000 / 0.5, 0]
# All of them outside each other's way: they meet nothing.
FREE_DECK = (
    START
    + """
fix      move grains cdem/integrate
timestep 1e-7
"""
)
MADE = """
compute      trm grains cdem/trm
thermo_style custom step c_trm
"""
TRM_DUMP = f"write_dump all custom trm.dump id c_trm {WHOLE}\n"


def trm(done: Run) -> np.ndarray:
    return done.dump("trm.dump")[-1]["c_trm"]


def free(directory: Path, deck: str, ranks: int = 1) -> Run:
    return run(deck, directory, discs=FREE, box=(-0.02, 0.02, -0.02, 0.02), ranks=ranks, bx="p", by="p", hs=0, hn=0)


def test_trm_of_free_discs(tmp_path: Path, ranks: int) -> None:
    """r |omega|/|v|, also while a disc crosses borders; the mean leaves out the disc that never moved."""
    deck = FREE_DECK + "fix move grains cdem/integrate dt any\ntimestep 1e-5\n" + MADE
    deck += f"dump trm all custom 1000 trm.dump id c_trm\ndump_{WHOLE.replace('modify', 'modify trm')}\n"
    done = free(tmp_path, deck + 'run 1000\nprint "mean = $(c_trm:%.17g)"\n', ranks)
    assert trm(done) == pytest.approx(FREE_TRM, rel=1e-12)
    assert done.printed("mean") == pytest.approx((FREE_TRM[0] + FREE_TRM[1]) / 2, rel=1e-12)
