# SPDX-License-Identifier: GPL-2.0-or-later
"""Progress of a run: bars with the time left on a terminal, plain lines elsewhere."""

import time
from typing import Protocol

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TaskID, TextColumn, TimeElapsedColumn, TimeRemainingColumn

SECONDS_BETWEEN_LINES = 30.0
ENOUGH = 0.005  # of all displacement, for a first estimate of the time left


class Display(Protocol):
    """What the campaign tells of its progress; displacements in mm."""

    def started(self, label: str, travel: float | None, reached: float) -> None:
        """A phase begins, or goes on where it was stopped; phases whose end cannot be foreseen have no travel."""

    def moved(self, label: str, displacement: float) -> None:
        """A shear phase has come so far."""

    def ended(self, label: str, note: str) -> None:
        """A phase has ended."""

    def say(self, text: str) -> None:
        """Something else worth a line."""

    def close(self) -> None:
        """No more is to be shown."""


def make_display(console: Console, total: float, reached: float) -> Display:
    """A display for shear phases of `total` mm together, of which an earlier run has done `reached`."""
    if console.is_terminal:
        return BarDisplay(console, total, reached)
    return LineDisplay(console, total, reached)


class BarDisplay:
    """A bar for each running phase and one for all shear phases together."""

    def __init__(self, console: Console, total: float, reached: float) -> None:
        self._progress = Progress(
            SpinnerColumn(),
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.fields[state]}"),
            TimeElapsedColumn(),
            TextColumn("left"),
            TimeRemainingColumn(),
            console=console,
            speed_estimate_period=300,
        )
        self._tasks: dict[str, TaskID] = {}
        self._reached: dict[str, float] = {}
        self._all = self._progress.add_task("all stresses", total=total, state="", start=False)
        self._progress.update(self._all, completed=reached)
        self._progress.start()

    def started(self, label: str, travel: float | None, reached: float) -> None:
        self._reached[label] = reached
        self._tasks[label] = self._progress.add_task(label, total=travel, state="")
        if travel is not None:
            self._progress.start_task(self._all)

    def moved(self, label: str, displacement: float) -> None:
        task = self._tasks[label]
        self._progress.update(task, completed=displacement, state=f"{displacement:.2f} mm", refresh=True)
        self._progress.update(self._all, advance=displacement - self._reached[label])
        self._reached[label] = displacement

    def ended(self, label: str, note: str) -> None:
        self._progress.remove_task(self._tasks.pop(label))
        self.say(f"{label}: {note}")

    def say(self, text: str) -> None:
        self._progress.console.print(text, markup=False, highlight=False)

    def close(self) -> None:
        self._progress.remove_task(self._all)
        self._progress.stop()


class LineDisplay:
    """A line when a phase begins or ends, and one every half minute."""

    def __init__(self, console: Console, total: float, reached: float) -> None:
        self._console = console
        self._total = total
        self._left = total - reached
        self._positions: dict[str, float] = {}
        self._start: tuple[float, float] | None = None  # time and what was left when the first phase reported
        self._last_line = time.monotonic()

    def started(self, label: str, travel: float | None, reached: float) -> None:
        if travel is not None:
            self._positions[label] = reached
        self.say(f"{label}: started")

    def moved(self, label: str, displacement: float) -> None:
        self._left -= displacement - self._positions[label]
        self._positions[label] = displacement
        now = time.monotonic()
        if self._start is None:
            self._start = (now, self._left)
        if now - self._last_line >= SECONDS_BETWEEN_LINES:
            self._last_line = now
            where = ", ".join(f"{name} at {mm:.2f} mm" for name, mm in self._positions.items())
            self.say(f"{where}; {100 * (1 - self._left / self._total):.0f} % of all{self._time_left(now)}")

    def ended(self, label: str, note: str) -> None:
        self._positions.pop(label, None)
        self.say(f"{label}: {note}")

    def say(self, text: str) -> None:
        self._console.print(text, markup=False, highlight=False, soft_wrap=True)

    def close(self) -> None:
        pass

    def _time_left(self, now: float) -> str:
        assert self._start is not None
        begun, then_left = self._start
        done = then_left - self._left
        if done < ENOUGH * self._total:  # the lower half gets up to speed first
            return ""
        return f", about {duration(self._left * (now - begun) / done)} left"


def duration(seconds: float) -> str:
    """Seconds as people say them: 48 s, 12 min, 3 h 20 min."""
    if seconds < 100:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 100 else f"{minutes // 60} h {minutes % 60} min"
