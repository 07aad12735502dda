# SPDX-License-Identifier: GPL-2.0-or-later
"""Working through the phases of a run, several at a time, so that it can be stopped and taken up at any moment."""

import fcntl
import json
import os
import signal
import subprocess
import time
from collections import deque
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from .display import Display, duration
from .engine import LEAST_FREE_BYTES, Engine, explain_failure, free_bytes, stop
from .errors import ShearboxError
from .files import LOCK, TIMINGS, write_json
from .phases import SHEAR, Phase, packing, shearing
from .repair import repair
from .request import Request

POLL_SECONDS = 0.2
MOST_SECONDS = 1e9  # that a phase may have taken


@dataclass
class Job:
    """A chain of phases of which the first is running."""

    phases: deque[Phase]
    process: subprocess.Popen[bytes]
    begun: float = field(default_factory=time.monotonic)

    @property
    def phase(self) -> Phase:
        """The running one."""
        return self.phases[0]


class Campaign:
    """One request carried out in its folder, whose lock is held meanwhile."""

    def __init__(self, folder: Path, request: Request, engine: Engine, display: Display, lock: int) -> None:
        self._folder = folder
        self._request = request
        self._engine = engine
        self._display = display
        self._lock = lock

    def run(self, jobs: int) -> list[str]:
        """Pack, then consolidate and shear each stress, `jobs` at a time; what failed is told and returned."""
        failures = self._work([[packing(self._folder, self._request)]], 1)
        if not failures:
            chains = [shearing(self._folder, self._request, sigma) for sigma in self._request.stresses]
            failures = self._work(chains, jobs)
        return failures

    def _work(self, chains: Iterable[list[Phase]], jobs: int) -> list[str]:
        """Run the chains; when one fails the others go on."""
        waiting = deque(left for chain in chains if (left := deque(p for p in chain if not p.done)))
        running: list[Job] = []
        failures: list[str] = []
        try:
            while waiting or running:
                while waiting and len(running) < jobs:
                    phases = waiting.popleft()
                    running.append(Job(phases, self._start(phases[0])))
                time.sleep(POLL_SECONDS)
                self._guard_disk()
                for job in list(running):
                    if not self._attend(job, failures):
                        running.remove(job)
        finally:
            self._stop(running)
        return failures

    def _start(self, phase: Phase) -> subprocess.Popen[bytes]:
        repair(phase.folder)
        reached = phase.displacement()
        process = self._engine.start(phase, self._lock)
        sheared = phase.name == SHEAR
        self._display.started(phase.label, self._request.travel if sheared else None, reached)
        return process

    def _attend(self, job: Job, failures: list[str]) -> bool:
        """Look after a job and go on to its next phase; whether there is more to do for it."""
        phase, status = job.phase, job.process.poll()
        if phase.name == SHEAR:
            self._display.moved(phase.label, phase.displacement())
        if status is None:
            return True
        seconds = self._record_time(job)
        if status != 0 or not phase.done:
            failures.append(explain_failure(phase, status))
            self._display.ended(phase.label, f"failed after {duration(seconds)}")
            return False
        phase.screen.unlink(missing_ok=True)
        self._display.ended(phase.label, f"done in {duration(seconds)}")
        job.phases.popleft()
        if job.phases:
            job.process, job.begun = self._start(job.phase), time.monotonic()
        return bool(job.phases)

    def _stop(self, running: list[Job]) -> None:
        """End what is still running; a second Ctrl-C must not cut this short."""
        alive = [job for job in running if job.process.poll() is None]
        if not alive:
            return
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
        try:
            stop([job.process for job in alive])
            for job in alive:
                self._record_time(job)
        finally:
            signal.signal(signal.SIGINT, before)

    def _record_time(self, job: Job) -> float:
        """Add the seconds of a phase to those of earlier attempts; its total is returned."""
        timings = read_timings(self._folder)
        total = timings.get(job.phase.label, 0.0) + time.monotonic() - job.begun
        with suppress(ShearboxError):  # a full disk has more important things to say
            write_json(self._folder / TIMINGS, {**timings, job.phase.label: round(total, 2)})
        return total

    def _guard_disk(self) -> None:
        free = free_bytes(self._folder)
        if free < LEAST_FREE_BYTES:
            raise ShearboxError(
                f"stopped because the disk of {self._folder} is nearly full: {free / 1e6:.0f} MB free, "
                f"{LEAST_FREE_BYTES / 1e6:.0f} are the least"
            )


def read_timings(folder: Path) -> dict[str, float]:
    """Seconds per phase, summed over all attempts; a damaged record costs the timings only."""
    try:
        timings = json.loads((folder / TIMINGS).read_text(encoding="utf-8"))
        return {
            label: float(s) for label, s in timings.items() if isinstance(s, (int, float)) and 0 <= s < MOST_SECONDS
        }
    except (OSError, ValueError, AttributeError, RecursionError):
        return {}


@contextmanager
def locked(folder: Path) -> Iterator[int]:
    """Hold the folder's lock, which engines that outlive this program keep too; yields its descriptor."""
    descriptor = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT, 0o644)
    try:
        _take(descriptor, folder)
        yield descriptor
    finally:
        os.close(descriptor)


def _take(descriptor: int, folder: Path) -> None:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise ShearboxError(f"{folder} is in use by another run, or by an engine that one left behind") from error
