# SPDX-License-Identifier: GPL-2.0-or-later
"""The commands `shearbox status` and `cancel`: what the jobs of a folder are doing, and their end."""

import json
import sys
import time
from pathlib import Path

from ..base.errors import ShearboxError
from ..jobs.schedulers import find_scheduler
from ..jobs.submitted import REPORT, log_of, read_jobs, run_of, said
from ..running.forecast import Forecast
from ..running.phases import SHEAR

SECONDS_TO_END = 120
POLL_SECONDS = 0.5


class Progress:
    """Of a run: how many phases it has and how many are done; how far shear has come where it is under way, mm by stress (kPa)."""

    def __init__(self, forecast: Forecast) -> None:
        left = [phase for phase in forecast.phases if not phase.done]
        self.phases = len(forecast.phases)
        self.phases_done = self.phases - len(left)
        self.displacement_mm = {
            f"{phase.sigma:g}": phase.displacement() for phase in left if phase.name == SHEAR and phase.displacement()
        }

    def __str__(self) -> str:
        sheared = [f"{sigma} kPa at {mm:.2f} mm" for sigma, mm in self.displacement_mm.items()]
        return ", ".join([f"{self.phases_done} of {self.phases} phases done", *sheared])


def status(folder: Path, as_json: bool = False) -> None:
    """Print a line for each run, and one for the report; results are looked at even if the batch system is silent."""
    jobs = read_jobs(folder)
    states: dict[int, str] | None = None
    try:
        states = find_scheduler(jobs.scheduler).states(jobs.name)
    except ShearboxError as error:
        print(f"the batch system does not answer: {error}", file=sys.stderr if as_json else sys.stdout)
    of_element = ["", *("?" if states is None else states.get(k, "") for k in range(1, len(jobs.elements) + 1))]
    told = {
        str(folder) if name == "." else name: _told(folder, name, number, of_element[number])
        for number, names in enumerate([jobs.done, *jobs.elements])
        for name in names
    }
    report = states.get(0) if states else None
    if as_json:
        runs = {
            name: {"state": state, **(vars(progress) if progress else {})} for name, (state, progress) in told.items()
        }
        print(json.dumps({"runs": runs, REPORT: report}, indent=2))
        return
    for name, (state, progress) in told.items():
        print(f"{name}: {state}" + (f"; {progress}" if progress else ""))
    if report:
        print(f"{REPORT}: {report}")


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


def _told(folder: Path, name: str, element: int, state: str) -> tuple[str, Progress | None]:
    """State and progress of a run, of element 0 if there was nothing left of it; one that cannot be read says so, and is in
    the way of no other."""
    try:
        run = run_of(folder, name)
        progress = Progress(Forecast(run.folder, run.request))
    except ShearboxError as error:
        return "; ".join(filter(None, [state, str(error)])), None
    return state or _without_a_job(folder, element, progress), progress


def _without_a_job(folder: Path, element: int, progress: Progress) -> str:
    """State of a run that the batch system knows nothing of."""
    if progress.phases_done == progress.phases:
        return "done"
    if not element:
        return "was done when the others were submitted, but its results are gone or damaged now"
    log = log_of(folder, element)
    lines = said(log)
    last = next((line for line in reversed(lines) if line.startswith("shearbox: ")), lines[-1] if lines else "nothing")
    return f"ended before it was done, see {log}: {last}"
