# SPDX-License-Identifier: GPL-2.0-or-later
"""Progress of a run: bars with the time left on a terminal, plain lines elsewhere."""

import time
from collections.abc import Mapping
from typing import Protocol

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TaskID, TextColumn, TimeElapsedColumn

from ..base.words import about

SECONDS_BETWEEN_LINES = 30.0
ENOUGH = 0.005  # of all work, for a first estimate of the time left


class Display(Protocol):
    """What the campaign tells of its progress; displacements in mm."""

    def started(self, label: str, travel: float | None, reached: float) -> None:
        """A phase begins, or goes on where it was stopped; phases whose end cannot be foreseen have no travel."""

    def moved(self, label: str, displacement: float) -> None:
        """A shear phase has come so far."""

    def ended(self, label: str, note: str) -> None:
        """A phase has ended."""

    def given_up(self, labels: list[str]) -> None:
        """Phases that failed, or cannot begin since another failed."""

    def say(self, text: str) -> None:
        """Something else worth a line."""

    def close(self) -> None:
        """No more is to be shown."""


class Whole:
    """All phases together: `work` (s) that each is expected to be, by label, and the share of it that is done."""

    def __init__(self, work: Mapping[str, float], shares: Mapping[str, float]) -> None:
        self._work = dict(work)
        self._shares = dict(shares)
        self._begun = time.monotonic()
        self._done_before = self.done

    @property
    def total(self) -> float:
        """Work of all phases that have not been given up."""
        return sum(self._work.values())

    @property
    def done(self) -> float:
        """The part of it that is done."""
        return sum(work * self._shares.get(label, 0.0) for label, work in self._work.items())

    def reached(self, label: str, share: float) -> None:
        """A phase has come so far."""
        self._shares[label] = share

    def give_up(self, labels: list[str]) -> None:
        """Leave out phases that will not be done."""
        for label in labels:
            self._work.pop(label, None)

    def seconds_left(self) -> float | None:
        """If it goes on at the speed since the beginning; None: it is too early to tell."""
        done = self.done - self._done_before
        if done < ENOUGH * self.total or done <= 0:
            return None
        return (self.total - self.done) * (time.monotonic() - self._begun) / done


def make_display(console: Console, whole: Whole) -> Display:
    """Bars on a terminal, lines elsewhere."""
    if console.is_terminal:
        return BarDisplay(console, whole)
    return LineDisplay(console, whole)


class BarDisplay:
    """A bar for each running phase and one for all phases together."""

    def __init__(self, console: Console, whole: Whole) -> None:
        self._progress = Progress(
            SpinnerColumn(),
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.fields[state]}"),
            TimeElapsedColumn(),
            console=console,
        )
        self._whole = whole
        self._tasks: dict[str, TaskID] = {}
        self._travels: dict[str, float] = {}
        self._all = self._progress.add_task("all", state="")
        self._update()
        self._progress.start()

    def started(self, label: str, travel: float | None, reached: float) -> None:
        self._tasks[label] = self._progress.add_task(label, total=travel, state="")
        if travel is not None:
            self._travels[label] = travel
            self.moved(label, reached)

    def moved(self, label: str, displacement: float) -> None:
        self._whole.reached(label, displacement / self._travels[label])
        self._update()
        state = f"{displacement:.2f} mm"
        self._progress.update(self._tasks[label], completed=displacement, state=state, refresh=True)

    def ended(self, label: str, note: str) -> None:
        self._whole.reached(label, 1)
        self._progress.remove_task(self._tasks.pop(label))
        self._update()
        self.say(f"{label}: {note}")

    def given_up(self, labels: list[str]) -> None:
        self._whole.give_up(labels)
        self._update()

    def say(self, text: str) -> None:
        self._progress.console.print(text, markup=False, highlight=False)

    def close(self) -> None:
        self._progress.remove_task(self._all)
        self._progress.stop()

    def _update(self) -> None:
        state = _time_left(self._whole)
        self._progress.update(self._all, total=self._whole.total, completed=self._whole.done, state=state)


class LineDisplay:
    """A line when a phase begins or ends, and one every half minute."""

    def __init__(self, console: Console, whole: Whole) -> None:
        self._console = console
        self._whole = whole
        self._travels: dict[str, float] = {}
        self._positions: dict[str, float] = {}
        self._last_line = time.monotonic()

    def started(self, label: str, travel: float | None, reached: float) -> None:
        if travel is not None:
            self._travels[label] = travel
            self._positions[label] = reached
            self._whole.reached(label, reached / travel)
        self.say(f"{label}: started" + (f" at {reached:.2f} mm" if reached else ""))

    def moved(self, label: str, displacement: float) -> None:
        self._positions[label] = displacement
        self._whole.reached(label, displacement / self._travels[label])
        now = time.monotonic()
        if now - self._last_line >= SECONDS_BETWEEN_LINES:
            self._last_line = now
            where = ", ".join(f"{name} at {mm:.2f} mm" for name, mm in self._positions.items())
            left = _time_left(self._whole)
            self.say(f"{where}; {100 * self._whole.done / self._whole.total:.0f} % of all{', ' * bool(left)}{left}")

    def ended(self, label: str, note: str) -> None:
        self._positions.pop(label, None)
        self._whole.reached(label, 1)
        self.say(f"{label}: {note}")

    def given_up(self, labels: list[str]) -> None:
        self._whole.give_up(labels)

    def say(self, text: str) -> None:
        self._console.print(text, markup=False, highlight=False, soft_wrap=True)

    def close(self) -> None:
        pass


def _time_left(whole: Whole) -> str:
    seconds = whole.seconds_left()
    return "" if seconds is None else f"{about(seconds)} left"
