# SPDX-License-Identifier: GPL-2.0-or-later
"""Progress on a terminal and elsewhere."""

import io
import time

import pytest
from rich.console import Console

from shearbox_tools.base import words
from shearbox_tools.running import display


def show(console: Console, monkeypatch: pytest.MonkeyPatch) -> str:
    now = [0.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    work = {"pack": 0.0, "shear 100 kPa": 80.0, "shear 200 kPa": 60.0, "shear 300 kPa": 20.0}
    whole = display.Whole(work, {"shear 100 kPa": 0.5})
    shown = display.make_display(console, whole)
    shown.started("pack", None, 0)
    shown.ended("pack", "done in 4 s")
    shown.started("shear 100 kPa", 8, 4)
    for k in range(5):
        now[0] = 40.0 * k
        shown.moved("shear 100 kPa", 4.0 + k)
    shown.ended("shear 100 kPa", "done in 3 min")
    shown.close()
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue()


def test_plain_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    text = show(Console(file=io.StringIO(), width=200), monkeypatch)
    assert text.splitlines() == [
        "pack: started",
        "pack: done in 4 s",
        "shear 100 kPa: started at 4.00 mm",
        "shear 100 kPa at 5.00 mm; 31 % of all, about 7 min left",
        "shear 100 kPa at 6.00 mm; 38 % of all, about 7 min left",
        "shear 100 kPa at 7.00 mm; 44 % of all, about 6 min left",
        "shear 100 kPa at 8.00 mm; 50 % of all, about 5 min left",
        "shear 100 kPa: done in 3 min",
    ]


def test_bars_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    text = show(Console(file=io.StringIO(), width=120, force_terminal=True), monkeypatch)
    assert "all" in text and "8.00 mm" in text and "about 5 min left" in text
    assert "shear 100 kPa: done in 3 min" in text


@pytest.mark.parametrize(
    "seconds, text",
    [
        (0, "under 1 s"),
        (0.4, "under 1 s"),
        (0.6, "1 s"),
        (3.4, "3 s"),
        (99, "99 s"),
        (101, "2 min"),
        (5900, "98 min"),
        (12000, "3 h 20 min"),
    ],
)
def test_durations(seconds: float, text: str) -> None:
    assert words.duration(seconds) == text
    assert words.about(seconds) == (text if text.startswith("under") else f"about {text}")


@pytest.mark.parametrize("size, text", [(0.2e6, "0 MB"), (46e6, "46 MB"), (999.6e6, "1.0 GB"), (4838e6, "4.8 GB")])
def test_amounts(size: float, text: str) -> None:
    assert words.amount(size) == text


def test_time_left_of_the_whole_follows_from_the_work_done(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 100 s of expected work 10 s took 40: 4 s each. What is given up takes no time."""
    now = [0.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    whole = display.Whole({"pack": 10.0, "shear": 60.0, "other": 30.0}, {})
    assert whole.seconds_left() is None
    now[0] = 40.0
    whole.reached("pack", 1)
    assert whole.seconds_left() == pytest.approx(4 * 90)
    whole.reached("shear", 0.5)
    assert whole.seconds_left() == pytest.approx(60)
    whole.give_up(["other"])
    assert whole.seconds_left() == pytest.approx(30)


def test_what_was_done_before_says_nothing_of_the_speed(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    whole = display.Whole({"a": 50.0, "b": 50.0}, {"a": 1.0})
    now[0] = 20.0
    whole.reached("b", 0.2)
    assert whole.seconds_left() == pytest.approx(2 * 40)
