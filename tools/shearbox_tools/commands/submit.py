# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox submit`, the same as `run` by jobs of a batch system; and what these jobs do."""

import argparse
import signal
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from rich.console import Console

from ..base.errors import ShearboxError
from ..base.files import write_text
from ..base.lock import locked
from ..base.words import about, amount, duration
from ..jobs.cluster import read_cluster
from ..jobs.layout import Layout
from ..jobs.schedulers import Job, Scheduler, find_scheduler
from ..jobs.submitted import JOBS, REPORT, TESTS, Jobs, name_of, read_jobs
from ..running.engine import Engine
from ..running.forecast import Forecast
from ..running.phases import all_phases
from ..running.run_folders import Run
from .run import carry_out, cautions_of, check_disk, opened, prepare

PROGRAM = Path(__file__).resolve().parents[2] / "shearbox"


def submit(options: argparse.Namespace, asked: list[dict[str, Any]]) -> None:
    """Submit what is left to do of what is asked for: all tests in an array of jobs, and the report after them."""
    given = vars(options)
    cluster = read_cluster(given.get("cluster"))
    scheduler = find_scheduler(cluster.scheduler)
    out, runs, engine = prepare(options, asked)
    scheduler.check(out)
    left = [run for run in runs if not all(phase.done for phase in all_phases(run.folder, run.request))]
    if not left:
        print(f"nothing is left to do in {out}; 'shearbox report' writes its report")
        return
    layout = Layout(left, cluster, given.get("jobs"), engine.ranks)
    scripts = {name: scheduler.script(job, cluster) for name, job in _jobs(out, layout).items()}
    print(_in_words(layout))
    for text in cautions_of(runs):
        print(f"note: {text}")
    if options.dry_run:
        for name, script in scripts.items():
            print(f"\n{_script(out, name)}:\n{script}", end="")
        return
    check_disk(out, [one for some in layout.forecasts for one in some])
    elements = [[str(run.folder.relative_to(out)) for run in element] for element in layout.elements]
    program = str(engine.program.absolute())
    submitted = {run.folder for run in left}
    done = [str(run.folder.relative_to(out)) for run in runs if run.folder not in submitted]
    record = Jobs(cluster.scheduler, name_of(out), elements, layout.at_a_time, engine.ranks, program, done)
    _refuse_jobs(out, record, scheduler)
    with opened(out, runs):  # their records are begun; jobs, which may begin at once, lock them by themselves
        pass
    _hand_over(out, record, scripts, scheduler)


def element(folder: Path, number: int) -> None:
    """Carry out an element of what was submitted; asked to end before its limit, it begins again to go on."""
    jobs = read_jobs(folder)
    runs = jobs.runs(folder, number)
    engine = Engine(Path(jobs.engine), jobs.ranks)
    engine.check()
    before = _phases_done(runs)
    try:
        with ExitStack() as stack:
            locks = {run.folder: stack.enter_context(locked(run.folder)) for run in runs}
            problems = carry_out(runs, engine, jobs.at_a_time, locks, Console())
    except KeyboardInterrupt as interruption:
        if interruption.args != (signal.SIGUSR1,):
            raise
        if _phases_done(runs) <= before:
            raise ShearboxError(
                "nothing was done before the limit of the job that it could go on from: it needs a longer one"
            ) from interruption
        print("the limit of the job is near: it begins again later, to go on", flush=True)
        find_scheduler(jobs.scheduler).requeue()
        return
    if problems:
        raise ShearboxError("\n".join(problems))


def _phases_done(runs: list[Run]) -> float:
    """How many, parts of them included."""
    forecasts = [Forecast(run.folder, run.request) for run in runs]
    return sum(one.share_done(phase) for one in forecasts for phase in one.phases)


def _jobs(out: Path, layout: Layout) -> dict[str, Job]:
    name, shearbox = name_of(out), [sys.executable, str(PROGRAM)]
    tests = Job(
        name=name,
        command=[*shearbox, "element", str(out.absolute())],
        log=f"{JOBS}/{TESTS}",
        minutes=layout.minutes,
        elements=len(layout.elements),
        cores=layout.cores,
        nodes=layout.nodes,
        notice=layout.notice,
    )
    report = Job(name, [*shearbox, "report", str(out.absolute())], f"{JOBS}/{REPORT}", layout.report_minutes)
    return {TESTS: tests, REPORT: report}


def _in_words(layout: Layout) -> str:
    count = len(layout.elements)
    runs = max(map(len, layout.elements))
    return (
        f"{count} job{'s' * (count > 1)} of {runs} specimen{'s' * (runs > 1)}, {layout.at_a_time} tests at a time on "
        f"{layout.cores} cores: {about(layout.seconds)} each, at most {duration(60 * layout.minutes)}; "
        f"{amount(layout.memory)} of memory"
    )


def _script(out: Path, name: str) -> Path:
    return out / JOBS / f"{name}.sh"


def _hand_over(out: Path, record: Jobs, scripts: dict[str, str], scheduler: Scheduler) -> None:
    """Record the jobs and submit them, unless somebody else was faster."""
    with locked(out / JOBS):
        _refuse_jobs(out, record, scheduler)
        record.write(out)
        for name, script in scripts.items():
            write_text(_script(out, name), script)
        tests = scheduler.submit(_script(out, TESTS))
        print(f"job {tests}: the tests", flush=True)
        print(f"job {scheduler.submit(_script(out, REPORT), after=tests)}: the report after them")


def _refuse_jobs(out: Path, record: Jobs, scheduler: Scheduler) -> None:
    """Jobs of this folder that have not ended would meet the new ones in it."""
    if states := scheduler.states(record.name):
        raise ShearboxError(
            f"{out}: its jobs have not ended: {', '.join(sorted(set(states.values())))}. 'shearbox status' tells more, "
            "'shearbox cancel' ends them"
        )
