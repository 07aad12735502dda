# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox run`: check everything, carry it out, report."""

import argparse
import os
from pathlib import Path

from rich.console import Console

from .campaign import Campaign
from .display import make_display
from .engine import PROGRAM, Engine, Failure, free_bytes
from .errors import InputError, ShearboxError
from .lock import locked
from .models import INPUT, PARAMETERS, all_models, find_model, read_variables
from .phases import DECKS, deck, disk_need, shearing
from .request import Request, check, check_folder, open_folder

SPARE_BYTES = 100_000_000
GIVEN = {"model", "seed", "law", "dt", "stiffness", "sigma", "speed", "travel"}  # they come from the command line


def run(options: argparse.Namespace) -> None:
    """Carry out the command line; raises ShearboxError when something is wrong or has failed."""
    request = Request(
        model=find_model(options.model, all_models()),
        stresses=tuple(sorted(options.stress)),
        speed=options.speed,
        travel=options.travel,
        seed=options.seed,
        law=options.law,
        dt=options.dt,
        stiffness=options.stiffness,
    )
    engine = Engine((options.engine or PROGRAM).resolve(), options.ranks)
    console = Console()
    check(request)
    _check_machine(min(options.jobs, len(request.stresses)), engine, console)
    parameters = {k: v for k, v in read_variables(PARAMETERS).items() if k not in GIVEN}
    folder: Path = options.out
    check_folder(folder, request, parameters)
    _check_disk(folder, request)
    with locked(folder) as lock:
        open_folder(folder, request, parameters)
        failures = _carry_out(folder, request, engine, options.jobs, console, lock)
        problems = _report(folder, console) if any(_sheared(folder, request)) else []
    if failures:
        problems += [failure.message for failure in failures] + ["The other results are kept."]
    if any(failure.may_pass for failure in failures):
        problems.append("The same command goes on where this one stopped.")
    if problems:
        raise ShearboxError("\n".join(problems))


def _report(folder: Path, console: Console) -> list[str]:
    """Report, and say where; what is wrong with it is returned."""
    from .report import report  # with its libraries a second of loading, which a refusal need not wait for

    try:
        page = report(folder)
    except ShearboxError as error:
        return [str(error)]
    console.print(f"report: {page}", markup=False, highlight=False, soft_wrap=True)
    return []


def _carry_out(folder: Path, request: Request, engine: Engine, jobs: int, console: Console, lock: int) -> list[Failure]:
    reached = sum(min(s, request.travel) for s in _sheared(folder, request))
    display = make_display(console, request.travel * len(request.stresses), reached)
    try:
        return Campaign(folder, request, engine, display, lock).run(jobs)
    finally:
        display.close()


def _sheared(folder: Path, request: Request) -> list[float]:
    """Displacement (mm) that each stress has reached."""
    return [shearing(folder, request, sigma)[1].displacement() for sigma in request.stresses]


def _check_machine(jobs: int, engine: Engine, console: Console) -> None:
    for name, value in (("--jobs", jobs), ("--ranks", engine.ranks)):
        if not 1 <= value <= 256:
            raise InputError(f"{name} {value}: 1 to 256 are expected")
    engine.check()
    missing = [path.name for path in (PARAMETERS, *map(deck, DECKS)) if not path.is_file()]
    if missing:
        raise InputError(f"{INPUT} lacks {', '.join(missing)}")
    cores = len(os.sched_getaffinity(0))
    if jobs * engine.ranks > cores:
        console.print(f"note: {jobs} jobs of {engine.ranks} ranks share {cores} cores: fewer would be faster")


def _check_disk(folder: Path, request: Request) -> None:
    need, free = disk_need(request, folder) + SPARE_BYTES, free_bytes(folder)
    if free < need:
        raise InputError(f"--out {folder}: about {need / 1e6:.0f} MB will be written, {free / 1e6:.0f} MB are free")
