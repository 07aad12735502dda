# SPDX-License-Identifier: GPL-2.0-or-later
"""The commands `shearbox status` and `cancel`: what the jobs of a folder are doing, and their end."""

import time
from pathlib import Path

from .errors import ShearboxError
from .forecast import Forecast
from .jobs import JOBS, REPORT, TESTS, read_jobs
from .phases import SHEAR
from .schedulers import find_scheduler
from .specimens import Run

SECONDS_TO_END = 120
POLL_SECONDS = 0.5


def status(folder: Path) -> None:
    """Print a line for each run, and one for the report; results are looked at even if the batch system is silent."""
    jobs = read_jobs(folder)
    states: dict[int, str] | None = None
    try:
        states = find_scheduler(jobs.scheduler).states(jobs.name)
    except ShearboxError as error:
        print(f"the batch system does not answer: {error}")
    for number in range(1, len(jobs.elements) + 1):
        for run in jobs.runs(folder, number):
            state = "?" if states is None else states.get(number, "")
            print(f"{run.name or folder}: {_state(folder, run, number, state)}; {_progress(run)}")
    if states and 0 in states:
        print(f"{REPORT}: {states[0]}")


def cancel(folder: Path) -> None:
    """End the jobs, and wait until they have ended; what they have done stays."""
    jobs = read_jobs(folder)
    scheduler = find_scheduler(jobs.scheduler)
    scheduler.cancel(jobs.name)
    until = time.monotonic() + SECONDS_TO_END
    while states := scheduler.states(jobs.name):
        if time.monotonic() > until:
            raise ShearboxError(
                f"{folder}: after {SECONDS_TO_END} s its jobs are still {', '.join(set(states.values()))}"
            )
        time.sleep(POLL_SECONDS)
    print("its jobs have ended; nothing is lost: 'shearbox submit' with the same options goes on")


def _state(folder: Path, run: Run, element: int, state: str) -> str:
    if state or all(phase.done for phase in Forecast(run.folder, run.request).phases):
        return state or "done"
    log = folder / JOBS / f"{TESTS}_{element}.log"
    return f"ended before it was done, see {log}: {_last_words(log)}"


def _last_words(log: Path) -> str:
    """What a job said last."""
    try:
        lines = log.read_text(encoding="utf-8", errors="replace").split("\n")
    except OSError:
        return "there is none"
    said = [line.strip() for line in lines if line.strip()]
    return next((line for line in reversed(said) if line.startswith("shearbox: ")), said[-1] if said else "nothing")


def _progress(run: Run) -> str:
    forecast = Forecast(run.folder, run.request)
    done = [phase for phase in forecast.phases if phase.done]
    sheared = [phase for phase in forecast.phases if phase.name == SHEAR and phase not in done and phase.displacement()]
    return ", ".join(
        [f"{len(done)} of {len(forecast.phases)} phases done"]
        + [f"{phase.sigma:g} kPa at {phase.displacement():.2f} mm" for phase in sheared]
    )
