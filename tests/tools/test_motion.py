# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows at full speed, against the closed form of the motion of fix cdem/move."""

import numpy as np
import pytest

from shearbox_tools.analysis.motion import full_speed

TRAVEL, ROWS, STEPS = 8.0, 800, 60


def phase(ramp: float, rows: int = ROWS, until: float = 0.95 * ROWS) -> dict[str, np.ndarray]:
    """Means of s over intervals of 1; ramp is its duration: s = V/2 (t - T/pi sin(pi t/T)), then V (t - T/2) up to 8."""
    speed = TRAVEL / (until - ramp / 2)
    t = (np.arange(rows * 100) + 0.5) / 100
    begin = speed / 2 * (t - ramp / np.pi * np.sin(np.pi * t / max(ramp, 1e-9)) * (ramp > 0))
    s = np.minimum(np.where(t < ramp, begin, speed * (t - ramp / 2)), TRAVEL)
    return {"step": STEPS * np.arange(1.0, rows + 1), "displacement_mm": s.reshape(rows, 100).mean(axis=1)}


@pytest.mark.parametrize("ramp", [0, 8, 50])
def test_ramp_and_stop_are_left_out(ramp: int) -> None:
    """The half moves at full speed from the end of the ramp to 0.95 of the time; where the speed is reached smoothly,
    the last rows of the ramp may differ by less than the tolerance."""
    rows = full_speed(phase(ramp))
    assert ramp - 2 <= rows.start <= ramp
    assert rows.stop == 760


@pytest.mark.parametrize("until", [300, 20])
def test_a_box_that_stands_still_in_most_rows(until: int) -> None:
    rows = full_speed(phase(2, until=until))
    assert (rows.start, rows.stop) == (2, until)


def test_what_still_moves_has_no_stop() -> None:
    assert full_speed(phase(8, rows=300)).stop == 300


def test_frames_written_at_other_distances() -> None:
    """Steps between rows that change in the middle, as after a continuation, do not count as another speed."""
    data = phase(8, rows=700)
    some = np.r_[0:300, 300:700:2]
    rows = full_speed({name: column[some] for name, column in data.items()})
    assert rows.stop == len(some)


def test_no_motion_to_speak_of() -> None:
    assert full_speed({"step": np.array([60.0]), "displacement_mm": np.array([0.1])}) == slice(0, 0)
