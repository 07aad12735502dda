# SPDX-License-Identifier: GPL-2.0-or-later
"""Says on the terminal what runs, and how long the rest may take."""

from __future__ import annotations

import sys
import time

from engines import CDEM, LIGGGHTS, STOCK, Job

NOMINAL_NS = {CDEM: 30, STOCK: 90, LIGGGHTS: 130}  # a disc and step, to guess what is left


def guess(job: Job) -> float:
    """Seconds that a job takes, roughly."""
    return 1 + job.steps * job.discs * NOMINAL_NS[job.engine] * 1e-9 / job.ranks


class Progress:
    """Counts guessed seconds of work against those it took."""

    def __init__(self, work: float) -> None:
        self.left = work
        self.done = 0.0
        self.begin = time.monotonic()

    def say(self, what: str) -> None:
        """A line before or after a job."""
        spent = time.monotonic() - self.begin
        left = self.left * (spent / self.done if self.done else 1)
        print(f"{spent / 60:5.1f} min, about {left / 60:.1f} left: {what}", file=sys.stderr, flush=True)

    def finish(self, work: float) -> None:
        """Counts a job as done."""
        self.done += work
        self.left -= work
