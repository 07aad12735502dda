# SPDX-License-Identifier: GPL-2.0-or-later
"""Working through the phases of a run, several at a time, so that it can be stopped and taken up at any moment."""

import json
import math
import signal
import subprocess
import time
from collections import deque
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from .display import Display, duration
from .engine import LEAST_FREE_BYTES, Engine, Failure, explain_failure, free_bytes, stop
from .errors import ShearboxError
from .files import TIMINGS, sync, write_json
from .phases import SHEAR, Phase, all_phases, left_to_do
from .repair import make_ready
from .request import Request
from .restarts import step_of
from .seals import Seal, look_at, seal

POLL_SECONDS = 0.1
MOST_SECONDS = 1e9  # that a phase may have taken


@dataclass
class Job:
    """A chain of phases of which the first is running."""

    phases: deque[Phase]
    process: subprocess.Popen[bytes]
    begun: float = field(default_factory=time.monotonic)
    seen: dict[str, int] = field(default_factory=dict)  # times (ns) of the checkpoints that are sealed

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

    def run(self, jobs: int) -> list[Failure]:
        """Pack, then consolidate and shear each stress, `jobs` at a time; what failed is told and returned."""
        for phase in all_phases(self._folder, self._request):
            if look_at(phase.folder / phase.product) is Seal.UNKNOWN and phase.ended:
                _seal(phase)  # the program that started its engine was killed
        pack, chains = left_to_do(self._folder, self._request)
        return self._work([pack] if pack else [], 1) or self._work(chains, jobs)

    def _work(self, chains: Iterable[list[Phase]], jobs: int) -> list[Failure]:
        """Run the chains; when one fails the others go on."""
        waiting = deque(deque(chain) for chain in chains)
        running: list[Job] = []
        failures: list[Failure] = []
        try:
            while waiting or running:
                while waiting and len(running) < jobs:
                    phases = waiting.popleft()
                    running.append(Job(phases, self._start(phases)))
                time.sleep(POLL_SECONDS)
                self._guard_disk()
                for job in list(running):
                    if not self._attend(job, failures):
                        running.remove(job)
        finally:
            self._stop(running)
        return failures

    def _start(self, phases: deque[Phase]) -> subprocess.Popen[bytes]:
        phase, notes = make_ready(phases[0])
        phases[0] = phase
        for note in notes:
            self._display.say(f"{phase.label}: {note}")
        reached = phase.displacement()
        process = self._engine.start(phase, self._lock)
        sheared = phase.name == SHEAR
        self._display.started(phase.label, self._request.travel if sheared else None, reached)
        return process

    def _attend(self, job: Job, failures: list[Failure]) -> bool:
        """Look after a job and go on to its next phase; whether there is more to do for it."""
        phase, status = job.phase, job.process.poll()
        if phase.name == SHEAR:
            self._display.moved(phase.label, phase.displacement())
        if status is None:
            _seal_checkpoints(job)
            return True
        seconds = self._record_time(job)
        _seal(phase)
        if status != 0 or not phase.ended:
            failures.append(explain_failure(phase, status))
            self._display.ended(phase.label, f"failed after {duration(seconds)}")
            return False
        phase.screen.unlink(missing_ok=True)
        self._display.ended(phase.label, f"done in {duration(seconds)}")
        job.phases.popleft()
        if job.phases:
            job.process, job.begun = self._start(job.phases), time.monotonic()
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
                _seal(job.phase)
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


def _seal(phase: Phase) -> None:
    with suppress(ShearboxError):  # a full disk has more important things to say
        phase.seal()


def _seal_checkpoints(job: Job) -> None:
    """Seal restart files that were written since the last look.

    Table and frames up to them are on the disk before their seals are: the engine writes them first.
    """
    folder = job.phase.folder
    for name in job.phase.checkpoints:
        with suppress(OSError, ShearboxError):  # it may be gone by now
            written = (folder / name).stat().st_mtime_ns
            if written == job.seen.get(name) or step_of(folder / name) is None:
                continue
            for behind in (job.phase.product, *job.phase.frames):
                sync(folder / behind)
            seal(folder, [name])
            job.seen[name] = written
