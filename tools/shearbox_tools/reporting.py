# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox report`: on one run, or on all that a folder holds."""

from pathlib import Path

from .ensemble_report import report_on_runs
from .errors import ShearboxError
from .files import RECORD
from .report import report
from .specimens import find_runs


def report_on(folder: Path) -> Path:
    """Write the report of a folder, whose path is returned."""
    if (folder / RECORD).exists():
        return report(folder)
    runs = find_runs(folder)
    if not runs:
        raise ShearboxError(f"{folder} holds no run: there is no {RECORD} in it, nor below it")
    return report_on_runs(folder, runs, [])
