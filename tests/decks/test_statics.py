# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains that have come to rest: overlaps and forces from equilibrium."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from engine import Disc, run

G = 1000.0  # m/s^2, so that overlaps (3e-9 of a diameter with 10 m/s^2) are well above round-off
KN = 1e8

SETTLE = """
include ${decks}/start.in
fix weight grains gravity ${g} vector 0 -1 0
fix move grains cdem/integrate dt auto
fix floor walls cdem/move speed 0
run ${steps}
variable force equal f_floor[4]
print "floor = ${force}"
include ${decks}/end.in
"""


@pytest.mark.parametrize("ks", [0.0, 2.5e7], ids=["smooth", "stick"])
def test_disc_at_rest_on_two(tmp_path: Path, law: str, ranks: int, ks: float) -> None:
    """Set down where it touches two fixed discs, 60 degrees apart, it sinks by u, and each contact has
    fn = kn u cos(30), ft = ks u sin(30) in stick (ks tan(30)/kn < tan(phi)):  2 u (kn cos^2 + ks sin^2) = m g.
    Tolerance: u/d = 7e-7 is what linear geometry neglects; round-off of the overlap is 1e-10."""
    slope = math.radians(30)
    grain = Disc(0, 0)
    d = grain.diameter
    walls = [Disc(side * d * math.sin(slope), -d * math.cos(slope), type=2) for side in (-1, 1)]
    run_ = run(
        SETTLE, tmp_path, discs=[grain, *walls], ranks=ranks, law=law, kn=KN, ks=ks, hn=0.5, hs=0.5, g=G, steps=3000
    )
    weight = grain.mass * G
    sink = weight / (2 * (KN * math.cos(slope) ** 2 + ks * math.sin(slope) ** 2))
    fn, ft = KN * sink * math.cos(slope), ks * sink * math.sin(slope)
    end = run_.end
    assert -end["y"][0] == pytest.approx(sink, rel=1e-5)
    assert abs(end["x"][0]) < 1e-9 * sink
    # On the right wall disc: the normal force pushes it away from the grain, friction pulls it down.
    assert end["fx"][2] == pytest.approx(fn * math.sin(slope) - ft * math.cos(slope), rel=1e-5)
    assert end["fy"][2] == pytest.approx(-fn * math.cos(slope) - ft * math.sin(slope), rel=1e-5)
    assert end["fx"][1] == pytest.approx(-end["fx"][2], rel=1e-9)
    assert end["tqz"][2] == pytest.approx(-end["tqz"][1], rel=1e-9)
    assert -run_.printed("floor") == pytest.approx(weight, rel=1e-9)
    assert abs(end["vy"][0]) < 1e-12


def test_column_under_its_weight(tmp_path: Path, law: str, ranks: int) -> None:
    """n discs on a floor: the contact below disc i (from the floor, 0 ... n-1) carries (n - i) m g, and its overlap is
    that over kn. Set down just touching, the column sinks and comes to rest."""
    n = 3
    d = Disc(0, 0).diameter
    column = [Disc(0, (i + 0.5 - n / 2) * d) for i in range(n)]
    floor = Disc(0, column[0].y - d, type=2)
    run_ = run(SETTLE, tmp_path, discs=[*column, floor], ranks=ranks, law=law, kn=KN, hn=0.5, hs=0.5, g=G, steps=6000)
    end = run_.end
    weight = column[0].mass * G
    y = np.concatenate([[end["y"][n]], end["y"][:n]])
    assert d - np.diff(y) == pytest.approx(weight / KN * np.arange(n, 0, -1), rel=1e-8)
    assert -run_.printed("floor") == pytest.approx(n * weight, rel=1e-9)
    assert np.abs(end["fy"][:n]).max() < 1e-8 * weight
    assert np.abs(end["x"]).max() == 0
