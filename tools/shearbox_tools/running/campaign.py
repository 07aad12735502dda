# SPDX-License-Identifier: GPL-2.0-or-later
"""Working through the phases of runs, several at a time, so that they can be stopped and taken up at any moment."""

import signal
import subprocess
import time
from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..base.errors import ShearboxError
from ..base.files import sync
from ..base.restarts import step_of
from ..base.seals import Seal, look_at, seal
from ..base.timings import add_time
from ..base.words import duration
from .display import Display
from .engine import LEAST_FREE_BYTES, Engine, Failure, explain_failure, free_bytes, stop
from .phases import SHEAR, Phase, all_phases, left_to_do
from .repair import make_ready, refuse_lost_frames
from .run_folders import Run

POLL_SECONDS = 0.1
SECONDS_TO_ASK_AGAIN = 10.0


@dataclass
class Chain:
    """Phases of a run, one after the other, and the chains that can begin when they are done."""

    run: Run
    phases: deque[Phase]
    then: list["Chain"] = field(default_factory=list)

    @property
    def labels(self) -> list[str]:
        """Of all its phases, and of those that wait for them."""
        return [self.run.label(phase) for phase in self.phases] + [label for c in self.then for label in c.labels]


@dataclass
class Job:
    """A chain of which the first phase is running."""

    chain: Chain
    process: subprocess.Popen[bytes]
    begun: float = field(default_factory=time.monotonic)
    asked: float | None = None  # when it was last asked to end
    seen: dict[str, int] = field(default_factory=dict)  # times (ns) of the checkpoints that are sealed

    @property
    def phase(self) -> Phase:
        """The running one."""
        return self.chain.phases[0]

    @property
    def label(self) -> str:
        """How it is called among all."""
        return self.chain.run.label(self.phase)


class Campaign:
    """Runs carried out in their folders, whose locks are held meanwhile."""

    def __init__(self, runs: Sequence[Run], engine: Engine, display: Display, locks: Mapping[Path, int]) -> None:
        self._runs = runs
        self._engine = engine
        self._display = display
        self._locks = locks
        self._disks = list({run.folder.stat().st_dev: run.folder for run in runs}.values())  # a folder on each
        self._failures: list[Failure] = []
        self._ending = False
        self.stopped = False  # before all was done, as asked

    def end(self) -> None:
        """Begin nothing more; running phases end as soon as they have written a restart file."""
        self._ending = True

    def run(self, jobs: int) -> list[Failure]:
        """Pack, consolidate and shear, `jobs` phases of all runs at a time; what failed is told and returned.

        A failure ends what needs that phase, and nothing else. Stresses of a specimen that has been packed come before
        the packing of the next: specimens are finished one by one.
        """
        waiting = deque(chain for run in self._runs for chain in _left_to_do(run))
        running: list[Job] = []
        try:
            while running or (waiting and not self._ending):
                while waiting and len(running) < jobs and not self._ending:
                    chain = waiting.popleft()
                    running.append(Job(chain, self._start(chain)))
                time.sleep(POLL_SECONDS)
                self._guard_disk()
                if self._ending:
                    self._ask_to_end(running)
                for job in list(running):
                    if not self._attend(job):
                        running.remove(job)
                        if not job.chain.phases:
                            waiting.extendleft(reversed(job.chain.then))
        finally:
            self._stop(running)
        self.stopped |= bool(waiting)
        return self._failures

    def _start(self, chain: Chain) -> subprocess.Popen[bytes]:
        phase, notes = make_ready(chain.phases[0])
        chain.phases[0] = phase
        label = chain.run.label(phase)
        for note in notes:
            self._display.say(f"{label}: {note}")
        reached = phase.displacement()
        process = self._engine.start(phase, self._locks[chain.run.folder])
        self._display.started(label, chain.run.request.travel if phase.name == SHEAR else None, reached)
        return process

    def _attend(self, job: Job) -> bool:
        """Look after a job and go on to its next phase; whether there is more to do for it."""
        phase, status = job.phase, job.process.poll()
        if phase.name == SHEAR:
            self._display.moved(job.label, phase.displacement())
        if status is None:
            _seal_checkpoints(job)
            return True
        seconds = _record_time(job)
        _seal(phase)
        if job.asked is not None and not phase.ended:
            self._display.ended(job.label, f"stopped after {duration(seconds)}, as asked")
            self.stopped = True
            return False
        if status != 0 or not phase.ended:
            failure = explain_failure(phase, status)
            self._failures.append(replace(failure, message=f"{job.chain.run.name} {failure.message}".lstrip()))
            self._display.ended(job.label, f"failed after {duration(seconds)}")
            self._display.given_up(job.chain.labels)
            return False
        phase.screen.unlink(missing_ok=True)
        self._display.ended(job.label, f"done in {duration(seconds)}")
        job.chain.phases.popleft()
        if not job.chain.phases or self._ending:
            self.stopped |= bool(job.chain.phases)
            return False
        job.process, job.begun = self._start(job.chain), time.monotonic()
        return True

    def _ask_to_end(self, jobs: list[Job]) -> None:
        """Each of them again and again: a signal may be lost. Ranks that do not listen yet have nothing to lose, and mpirun may wait
        for ever for those that the signal has ended."""
        for job in jobs:
            if job.asked is not None and time.monotonic() < job.asked + SECONDS_TO_ASK_AGAIN:
                continue
            job.asked = time.monotonic()
            if job.phase.checkpoints and (self._engine.ranks == 1 or job.phase.listens):
                job.process.send_signal(signal.SIGUSR1)  # mpirun passes it on; see compute cdem/signal
            else:
                stop([job.process])

    def _stop(self, running: list[Job]) -> None:
        """End what is still running; a second Ctrl-C must not cut this short."""
        alive = [job for job in running if job.process.poll() is None]
        if not alive:
            return
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
        try:
            stop([job.process for job in alive])
            for job in alive:
                _record_time(job)
                _seal(job.phase)
        finally:
            signal.signal(signal.SIGINT, before)

    def _guard_disk(self) -> None:
        folder = min(self._disks, key=free_bytes)
        free = free_bytes(folder)
        if free < LEAST_FREE_BYTES:
            raise ShearboxError(
                f"stopped because the disk of {folder} is nearly full: {free / 1e6:.0f} MB free, "
                f"{LEAST_FREE_BYTES / 1e6:.0f} are the least"
            )


def _left_to_do(run: Run) -> list[Chain]:
    """What can begin at once: the packing, or if there is one, what each stress lacks."""
    for phase in all_phases(run.folder, run.request):
        refuse_lost_frames(phase)
        if look_at(phase.folder / phase.product) is Seal.UNKNOWN and phase.ended:
            _seal(phase)  # the program that started its engine was killed
    pack, left = left_to_do(run.folder, run.request)
    chains = [Chain(run, deque(phases)) for phases in left]
    return [Chain(run, deque(pack), chains)] if pack else chains


def _record_time(job: Job) -> float:
    """Seconds that its phase took, with those of earlier attempts."""
    return add_time(job.chain.run.folder, job.phase.label, time.monotonic() - job.begun)


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
            for behind in (job.phase.product, *job.phase.frames) if job.phase.name == SHEAR else ():
                sync(folder / behind)
            seal(folder, [name])
            job.seen[name] = written
