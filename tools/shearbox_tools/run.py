# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox run`: check everything, carry it out, report."""

import argparse
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

from rich.console import Console

from .campaign import Campaign
from .checks import check
from .display import make_display
from .engine import PROGRAM, Engine, Failure, free_bytes
from .errors import InputError, ShearboxError
from .forecast import Forecast
from .lock import locked
from .models import INPUT, PARAMETERS, find_model
from .parameters import canonical, of_model, read_settings
from .phases import DECKS, deck, disk_need, shearing
from .request import OWN_OPTION, Request, check_folder, open_folder, recorded

SPARE_BYTES = 100_000_000
DEFAULT_STRESSES = (100.0, 200.0, 300.0, 400.0)  # kPa


def run(options: argparse.Namespace) -> None:
    """Carry out the command line; raises ShearboxError when something is wrong or has failed."""
    folder, request = _asked(vars(options))
    engine = Engine(getattr(options, "engine", PROGRAM).resolve(), options.ranks)
    console = Console()
    check(request)
    _check_machine(min(options.jobs, len(request.stresses)), engine, console)
    check_folder(folder, request)
    forecast = Forecast(folder, request, options.jobs)
    if options.dry_run:
        _say(console, f"{forecast.phases}\nin all {forecast.total}, into {folder}")
        return
    _check_disk(folder, request)
    with locked(folder) as lock:
        open_folder(folder, request)
        _say(console, f"left: {forecast.total}")
        failures = _carry_out(folder, request, engine, options.jobs, console, lock)
        problems = _report(folder, console) if any(_sheared(folder, request)) else []
    if failures:
        problems += [failure.message for failure in failures] + ["The other results are kept."]
    if any(failure.may_pass for failure in failures):
        problems.append("The same command goes on where this one stopped.")
    if problems:
        raise ShearboxError("\n".join(problems))


def _asked(given: dict[str, Any]) -> tuple[Path, Request]:
    """The folder, and what is to be in it: as given; what is not is as recorded there, or by default."""
    settings = read_settings(given.get("set", []), OWN_OPTION)
    if "out" in given:
        folder = given["out"]
        request = Request(find_model(given["model"], of_model(settings)), DEFAULT_STRESSES, settings=settings)
    elif Path(given["model"]).is_dir():
        folder = Path(given["model"])
        request = recorded(folder)
        settings = request.settings | settings
        request = replace(request, model=find_model(str(request.model.path), of_model(settings)), settings=settings)
    else:
        raise InputError(
            f"--out is needed, or the folder of an earlier run in place of MODEL; {given['model']} is none"
        )
    changes = {name: given[name] for name in ("speed", "travel", "seed", "law", "stiffness") if name in given}
    if "stress" in given:
        changes["stresses"] = tuple(sorted(given["stress"]))
    if "dt" in given:
        changes["dt"] = canonical(given["dt"].strip())
    return folder, replace(request, **changes)


def _report(folder: Path, console: Console) -> list[str]:
    """Report, and say where; what is wrong with it is returned."""
    from .report import report  # with its libraries a second of loading, which a refusal need not wait for

    try:
        page = report(folder)
    except ShearboxError as error:
        return [str(error)]
    _say(console, f"report: {page}")
    return []


def _say(console: Console, text: str) -> None:
    console.print(text, markup=False, highlight=False, soft_wrap=True)


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
