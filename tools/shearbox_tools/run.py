# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox run`: check everything, carry it out, report."""

import argparse
import os
from pathlib import Path

from rich.console import Console

from .campaign import Campaign, locked
from .display import make_display
from .engine import PROGRAM, Engine, free_bytes
from .errors import InputError, ShearboxError
from .models import INPUT, PARAMETERS, all_models, find_model, read_variables
from .phases import DECKS, deck, disk_need, shearing
from .request import Request, check, open_folder

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
    _check_disk(folder, request)
    open_folder(folder, request, parameters)
    from .report import report  # with its libraries a second of loading, which a refusal need not wait for

    with locked(folder) as lock:
        failures = _carry_out(folder, request, engine, options.jobs, console, lock)
        page = report(folder) if any(_sheared(folder, request)) else None
    if page:
        console.print(f"report: {page}", markup=False, highlight=False, soft_wrap=True)
    if failures:
        raise ShearboxError(
            "\n".join(failures) + "\nThe other results are kept; the same command goes on where this one stopped."
        )


def _carry_out(folder: Path, request: Request, engine: Engine, jobs: int, console: Console, lock: int) -> list[str]:
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
