# SPDX-License-Identifier: GPL-2.0-or-later
"""What direct and incremental accumulation of the normal force have in common, and where they differ. See also
tests/validation/laws.

In a step with displacements du_n, du_t the distance D = r_i + r_j of two centres grows by du_n - du_t^2/(2 D), n being that
of the step's end, and the sum takes du_n. So e_n falls behind k_n overlap by k_n u_t^2 dt/(2 D) per unit of time, always to
the same side.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from engine import DECKS, Disc, run
from scenes import circling, oblique_pairs

SPEED = 0.1  # m/s
SINES = (0.0, 0.5, 0.8)  # of the angle between approach and normal
PHASES = 8
STIFFNESS = 1e8  # N/m
DIAMETER = Disc(0, 0).diameter
OMEGA = math.sqrt(STIFFNESS / (Disc(0, 0).mass / 2))  # of a pair, 1/s
ROUND_OFF = STIFFNESS * 2e-18  # N, of an overlap: the last bits of a distance and of the radii


def left_at_opening(directory: Path, law: str, dt: float, phi: float) -> np.ndarray:
    """e_n - k_n overlap (N) in the last step in which the discs touch, by sine and phase. Without dashpots, the normal
    force is e_n. Fails if there is a normal force without overlap."""
    discs, box = oblique_pairs(SINES, PHASES, SPEED, dt)
    out = run(
        (DECKS / "impacts.in").read_text(), directory, discs=discs, box=box, law=law, dt=dt, phi=phi, hn=0, hs=0,
        steps=math.ceil(math.pi / OMEGA / dt) + 8,
    )  # fmt: skip
    left = np.full(len(discs) // 2, np.nan)
    for frame in out.dump("contacts.dump"):
        force, overlap = frame["c_contacts[2]"], frame["c_contacts[3]"]
        touching = overlap > 0
        assert np.abs(force[~touching]).max(initial=0) < ROUND_OFF
        left[(frame["c_contacts[1]"].astype(int)[touching] - 1) // 2] = (force - STIFFNESS * overlap)[touching]
    assert len(frame["c_contacts[1]"]) == 0, "some are not apart yet"
    return left.reshape(len(SINES), PHASES)


@pytest.mark.parametrize("phi", [0, 27])
def test_direct_leaves_no_force_at_zero_overlap(tmp_path: Path, phi: float) -> None:
    for dt in (1e-6, 1e-7):
        assert np.abs(left_at_opening(tmp_path / str(dt), "direct", dt, phi)).max() < ROUND_OFF


def test_incremental_leaves_a_force_of_first_order(tmp_path: Path) -> None:
    """Head-on nothing but the round-off of a sum of 50 increments. Obliquely and without friction u_t = v sin stays as it
    is over the time pi/omega of the contact. Tolerance: of the steps in which the contact closes and opens, the sum takes
    none, that is up to 2 steps less; the normal turns by 1e-4 only."""
    for dt in (1e-7, 5e-8):
        head_on, *oblique = left_at_opening(tmp_path / str(dt), "incremental", dt, phi=0)
        assert np.abs(head_on).max() < 100 * ROUND_OFF
        for sine, left in zip(SINES[1:], oblique, strict=True):
            expected = -STIFFNESS * (SPEED * sine) ** 2 * dt / (2 * DIAMETER) * math.pi / OMEGA
            assert left == pytest.approx(expected, rel=2 * dt * OMEGA / math.pi)


@pytest.mark.parametrize("dt", [1e-6, 2.5e-7])
def test_disc_that_circles_another(tmp_path: Path, law: str, dt: float) -> None:
    """Pulled to a fixed disc and without friction it circles at constant speed. e_n is in balance with the pull, so with
    incremental accumulation the overlap grows by v^2 dt/(2 D) per unit of time: by pi v dt a turn, whatever k_n and D. Here
    that is up to 145 times the overlap. Tolerance: with the overlap, 3e-3 D at the most, the orbit shrinks."""
    speed, pull = 4.0, 10.0  # m/s, N
    steps = round(2 * math.pi * DIAMETER / speed / dt)
    out = run(
        (DECKS / "orbit.in").read_text(), tmp_path, discs=circling(speed, pull, STIFFNESS), law=law, dt=dt,
        steps=steps, every=steps, pull=pull, kn=STIFFNESS, phi=0, skin=1e-4,
    )  # fmt: skip
    start, end = out.thermo["v_overlap"]
    growth = math.pi * speed * dt if law == "incremental" else 0
    assert end - start == pytest.approx(growth, rel=1e-2, abs=2e-2 * start)
