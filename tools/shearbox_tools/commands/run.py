# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox run`: check everything, carry it out, report."""

import argparse
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from itertools import zip_longest
from pathlib import Path
from typing import Any

from rich.console import Console

from ..asking.hosts import HOSTS, check_host, default_program
from ..asking.models import PARAMETERS, find_model, read_variables
from ..asking.parameters import canonical, of_model, read_settings
from ..asking.request import OPTION_OF_SHEAR, OWN_OPTION, Request, check_folder, open_folder, placed, recorded
from ..base.errors import InputError, ShearboxError
from ..base.files import RECORD
from ..base.lock import locked
from ..base.numerals import number, numeral
from ..base.presets import DENSITIES, PACKING_FRICTION
from ..base.words import amount, duration
from ..running.campaign import Campaign
from ..running.cautions import cautions
from ..running.checks import check
from ..running.display import Display, Whole, make_display
from ..running.engine import Engine, free_bytes
from ..running.forecast import Forecast, memory_of_all, total
from ..running.phases import DECKS, shearing
from ..running.run_folders import Run, check_out, find_runs, planned, read_seeds
from .campaign_file import is_campaign

SPARE_BYTES = 100_000_000
MOST_RUNS = 900  # each keeps a file open, its lock
# options that say how runs are carried out, not what they are
BESIDE_A_RUN = ("model", "out", "only", "jobs", "ranks", "engine", "dry_run", "cluster", "command")
DEFAULT_STRESSES = (100.0, 200.0, 300.0, 400.0)  # kPa


def run(options: argparse.Namespace, asked: list[dict[str, Any]]) -> None:
    """Carry out what is asked for; raises ShearboxError when something is wrong or has failed."""
    out, runs, engine = prepare(options, asked)
    console = Console()
    _note_cores(min(options.jobs, tests_of(runs)), engine.ranks, console)
    for text in cautions_of(runs):
        _say(console, f"note: {text}")
    forecasts = _forecasts_of(runs, engine)
    if options.dry_run:
        _say(console, f"{forecast_text(runs, forecasts)}\nin all {total(forecasts, options.jobs)}, into {out}")
        return
    check_disk(out, forecasts)
    _check_memory(forecasts, options.jobs)
    with opened(out, runs) as locks:
        problems = carry_out(runs, engine, options.jobs, locks, console)
        if any(any(_sheared(one)) for one in runs):
            problems = _report(out, console, each=len(asked) == 1) + problems
    if problems:
        raise ShearboxError("\n".join(problems))


@contextmanager
def opened(out: Path, runs: list[Run]) -> Iterator[dict[Path, int]]:
    """Locks of the folder of all and of those of the runs, whose records are begun or taken up."""
    with ExitStack() as stack:
        folders = dict.fromkeys([out, *(one.folder for one in runs)])
        locks = {folder: stack.enter_context(locked(folder)) for folder in folders}
        for one in runs:
            open_folder(one.folder, one.request)
        yield locks


def prepare(options: argparse.Namespace, asked: list[dict[str, Any]]) -> tuple[Path, list[Run], Engine]:
    """The folder of all that is asked for, its runs, and the engine, all of them checked; nothing is written."""
    many = is_campaign(options.model)
    groups = [_planned(given, f"{options.model}: [runs.{given['out'].name}]: " if many else "") for given in asked]
    out = getattr(options, "out", groups[0][0])
    _refuse_within_a_run(out, out.resolve().parents if not many else (out, *out.resolve().parents))
    runs = _in_turn(out, groups)
    if len(runs) > MOST_RUNS:
        raise InputError(f"{len(runs)} runs are asked for, at most {MOST_RUNS} are expected in one go")
    host = _host_of(runs)
    engine = Engine(getattr(options, "engine", default_program(host)).resolve(), options.ranks)
    for name, value in (("--jobs", min(getattr(options, "jobs", 1), tests_of(runs))), ("--ranks", engine.ranks)):
        if not 1 <= value <= 256:
            raise InputError(f"{name} {value}: 1 to 256 are expected")
    engine.check()
    check_host(host)
    missing = [p for p in (PARAMETERS, *(HOSTS[host].decks / f"{name}.in" for name in DECKS)) if not p.is_file()]
    if missing:
        raise InputError(f"{missing[0].parent} lacks {', '.join(path.name for path in missing)}")
    for (folder, some), given in zip(groups, asked):
        _check_folders(folder, some, given)
    return out, runs, engine


def _planned(given: dict[str, Any], name: str) -> tuple[Path, list[Run]]:
    try:
        out, asked = _asked(given)
        runs = [replace(one, request=placed(one.request, one.folder)) for one in asked]
        for one in runs:
            check(one.request)
    except InputError as error:
        raise InputError(f"{name}{error}") from error
    return out, runs


def _host_of(runs: list[Run]) -> str:
    """Of all of them."""
    hosts = sorted({one.request.host for one in runs})
    if len(hosts) > 1:
        raise InputError(f"--host: {' and '.join(hosts)} are asked for, one for all runs is expected")
    return hosts[0]


def _refuse_within_a_run(out: Path, places: Iterable[Path]) -> None:
    """What is there would never be seen: what is below a run is the run's."""
    for place in places:
        if (place / RECORD).exists():
            raise InputError(f"--out {out}: {place} holds a run, and what is in it would be taken for a part of that")


def _in_turn(out: Path, groups: list[tuple[Path, list[Run]]]) -> list[Run]:
    """The first specimens of all groups, then the second ones: what is done tells something of all of them."""
    turns = zip_longest(*(runs for _, runs in groups))
    in_turn = [one for turn in turns for one in turn if one]
    return in_turn if len(groups) == 1 else [replace(one, name=str(one.folder.relative_to(out))) for one in in_turn]


def tests_of(runs: list[Run]) -> int:
    """How many tests they are: one for each stress."""
    return sum(len(one.request.stresses) for one in runs)


def cautions_of(runs: list[Run]) -> list[str]:
    """Each once."""
    return list(dict.fromkeys(text for one in runs for text in cautions(one.request)))


def carry_out(
    runs: list[Run],
    engine: Engine,
    jobs: int,
    locks: Mapping[Path, int],
    console: Console,
    show: Callable[[Whole], Display] | None = None,
) -> list[str]:
    """Work through the runs, whose folders are locked and open; what has failed is returned. Progress of the whole is shown on the
    console, unless there is another display of it.

    Asked to end by SIGUSR1, it does so with restart files of now, and raises KeyboardInterrupt.
    """
    forecasts = _forecasts_of(runs, engine)
    _say(console, f"left: {total(forecasts, jobs)}")
    work = _whole(runs, forecasts)
    display = show(work) if show else make_display(console, work)
    campaign = Campaign(runs, engine, display, locks)
    listens = threading.current_thread() is threading.main_thread()  # others cannot be sent signals
    before = signal.signal(signal.SIGUSR1, lambda *_: campaign.end()) if listens else None
    try:
        failures = campaign.run(jobs)
    finally:
        if listens:
            signal.signal(signal.SIGUSR1, before)
        display.close()
    problems = [failure.message for failure in failures]
    if campaign.stopped:
        for problem in problems:
            _say(console, problem)
        raise KeyboardInterrupt(signal.SIGUSR1)
    if failures:
        problems.append("The other results are kept.")
    if any(failure.may_pass for failure in failures):
        problems.append("The same command goes on where this one stopped.")
    return problems


def _asked(given: dict[str, Any]) -> tuple[Path, list[Run]]:
    """The folder, and what is to be in it: as given; what is not is as recorded there, or by default."""
    if "out" not in given and Path(given["model"]).is_dir() and not (Path(given["model"]) / RECORD).exists():
        return _ensemble_there(Path(given["model"]), given)
    folder, request = _one_asked(given)
    if "seeds" not in given:
        if "independent" in given:
            raise InputError("--independent: it is of the specimens of --seeds, which is not given")
        return folder, [Run(folder, request)]
    if "seed" in given or "out" not in given:
        raise InputError(f"--seeds: {'--seed is given, too' if 'seed' in given else 'MODEL and --out are needed'}")
    independent = "independent" in given
    seeds = read_seeds(given["seeds"], independent, request.stresses)
    return folder, planned(folder, request, seeds, independent)


def _ensemble_there(folder: Path, given: dict[str, Any]) -> tuple[Path, list[Run]]:
    """Several runs, each of which goes on as it was asked for."""
    folders = find_runs(folder)
    if not folders:
        raise InputError(f"{folder} holds no run: there is no {RECORD} in it, nor below it")
    changes = [f"--{name}" for name in given if name not in BESIDE_A_RUN]
    if changes:
        raise InputError(
            f"{folder} holds {len(folders)} runs, which go on as they were asked for: leave out {', '.join(changes)}, or "
            "give MODEL and --out"
        )
    return folder, [Run(one, recorded(one), str(one.relative_to(folder))) for one in folders]


def _one_asked(given: dict[str, Any]) -> tuple[Path, Request]:
    settings = _settings(given)
    if "out" in given:
        folder = given["out"]
        model = find_model(given["model"], of_model(settings), _packing_friction(settings))
        request = Request(model, DEFAULT_STRESSES, settings=settings)
    elif Path(given["model"]).is_dir():
        folder = Path(given["model"])
        request = recorded(folder)
        settings = request.settings | settings
        request = replace(request, model=find_model(str(request.model.path), of_model(settings)), settings=settings)
    else:
        raise InputError(
            f"--out is needed, or the folder of an earlier run in place of MODEL; {given['model']} is none"
        )
    changes = {name: given[name] for name in ("speed", "travel", "seed", "host", "law", "stiffness") if name in given}
    if "stress" in given:
        changes["stresses"] = tuple(sorted(given["stress"]))
    if "dt" in given:
        changes["dt"] = canonical(given["dt"].strip())
    return folder, replace(request, **changes)


def _settings(given: dict[str, Any]) -> dict[str, str]:
    """Of --set and --density."""
    settings = read_settings(given.get("set", []), OWN_OPTION | OPTION_OF_SHEAR)
    if "density" not in given:
        return settings
    if PACKING_FRICTION in settings:
        raise InputError(f"--density: --set {PACKING_FRICTION} is given, too")
    return settings | {PACKING_FRICTION: numeral(DENSITIES[given["density"]])}


def _packing_friction(settings: dict[str, str]) -> float:
    return number((read_variables(PARAMETERS) | settings)[PACKING_FRICTION])


def _check_folders(out: Path, runs: list[Run], given: dict[str, Any]) -> None:
    if "seeds" in given:
        check_out(out, runs)
        return
    for one in runs:
        check_folder(one.folder, one.request)


def _forecasts_of(runs: list[Run], engine: Engine) -> list[Forecast]:
    """What is left to do of each, on the ranks that the engine has."""
    return [Forecast(one.folder, one.request, engine.ranks) for one in runs]


def forecast_text(runs: list[Run], forecasts: list[Forecast]) -> str:
    """Each phase of a single run; of several, a line for each, under that of their model and settings."""
    if len(runs) == 1:
        return "\n".join([forecasts[0].head, *forecasts[0].lines])
    under: dict[str, list[str]] = {}
    for one, forecast in zip(runs, forecasts):
        left = [phase for phase in forecast.phases if not phase.done]
        what = f"{len(left)} phases, {duration(forecast.seconds)} one after the other" if left else "done"
        stresses = " ".join(f"{sigma:g}" for sigma in one.request.stresses)
        line = f"{one.name}: seed {one.request.seed}, {stresses} kPa: {what}"
        under.setdefault(forecast.head, []).append(line)
    return "\n".join(line for head, lines in under.items() for line in (head, *lines))


def _whole(runs: list[Run], forecasts: list[Forecast]) -> Whole:
    """All their phases, with what is done of them."""
    phases = [
        (one.label(phase), forecast, phase) for one, forecast in zip(runs, forecasts) for phase in forecast.phases
    ]
    return Whole(
        {label: forecast.work(phase) for label, forecast, phase in phases},
        {label: forecast.share_done(phase) for label, forecast, phase in phases},
    )


def _report(folder: Path, console: Console, each: bool) -> list[str]:
    """Report, on each run by itself, too, or not, and say where; what is wrong with it is returned."""
    from ..reports.report_on import (
        report_on,
    )  # with its libraries a second of loading, which a refusal need not wait for

    try:
        page = report_on(folder, each=each)
    except ShearboxError as error:
        return [str(error)]
    _say(console, f"report: {page}")
    return []


def _say(console: Console, text: str) -> None:
    console.print(text, markup=False, highlight=False, soft_wrap=True)


def _sheared(one: Run) -> list[float]:
    """Displacement (mm) that each stress has reached."""
    return [shearing(one.folder, one.request, sigma)[1].displacement() for sigma in one.request.stresses]


def _note_cores(jobs: int, ranks: int, console: Console) -> None:
    cores = len(os.sched_getaffinity(0))
    if jobs * ranks > cores:
        many = [
            f"{count} {what}{'s' * (count > 1)}" for count, what in ((jobs, "job"), (ranks, "rank"), (cores, "core"))
        ]
        _say(console, f"note: there are {many[2]} for {many[0]} of {many[1]}: fewer would be faster")


def check_disk(folder: Path, forecasts: list[Forecast]) -> None:
    """Refuse to begin what will not fit."""
    need, free = sum(forecast.disk for forecast in forecasts) + SPARE_BYTES, free_bytes(folder)
    if free < need:
        raise InputError(f"--out {folder}: about {amount(need)} will be written, {amount(free)} are free")


def _check_memory(forecasts: list[Forecast], jobs: int) -> None:
    """Refuse what this machine could not hold: its processes would be killed after hours."""
    need, there = memory_of_all(forecasts, jobs), os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    if there < need:
        raise InputError(f"about {amount(need)} of memory are needed, this machine has {amount(there)}")
