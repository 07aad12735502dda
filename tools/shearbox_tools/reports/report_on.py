# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox report`: on one run, or on all that a folder holds."""

from dataclasses import replace
from pathlib import Path

from ..analysis.by_hand import read_by_hand
from ..base.errors import InputError, ShearboxError
from ..base.files import RECORD, SHEAR_TABLE
from ..running.run_folders import find_runs
from .ensemble_report import report_on_runs
from .run_report import report, write_report


def report_on(folder: Path, model: str | None = None, speed: float | None = None, each: bool = True) -> Path:
    """Write the report of a folder, whose path is returned; model and speed (mm/s) are for tests run by hand.

    Of several runs, each has its own report, too, or not. One specimen of tests run by hand has that of a run.
    """
    if (folder / RECORD).exists():
        _refuse_options(folder, model, speed)
        return report(folder)
    runs, by_hand = runs_and_tests(folder)
    if not by_hand:
        _refuse_options(folder, model, speed)
    tests, damaged = read_by_hand(by_hand, model, speed)
    if len(tests) == 1 and not runs and not damaged:
        return write_report(replace(tests[0], folder=folder))
    return report_on_runs(folder, runs, tests, damaged, each=each)


def runs_and_tests(folder: Path) -> tuple[list[Path], list[Path]]:
    """Folders of runs, and of tests run by hand; at least one."""
    found = find_runs(folder, (RECORD, SHEAR_TABLE))
    if not found:
        raise ShearboxError(f"{folder} holds no run: there is no {RECORD} in it, nor below it, and no {SHEAR_TABLE}")
    runs = [place for place in found if (place / RECORD).exists()]
    return runs, [place for place in found if place not in runs]


def _refuse_options(folder: Path, model: str | None, speed: float | None) -> None:
    for option, value in (("--model", model), ("--speed", speed)):
        if value is not None:
            raise InputError(f"{option} {value}: {RECORD} tells it of what is in {folder}")
