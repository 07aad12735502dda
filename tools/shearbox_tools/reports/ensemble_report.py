# SPDX-License-Identifier: GPL-2.0-or-later
"""The report on many runs: report.html, summary.json, a table of mean curves for each ensemble; and each run's own."""

import json
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ..analysis.grouping import LeftOut, put_together
from ..analysis.mean_curve import as_csv
from ..analysis.read_runs import read_all, read_quietly
from ..analysis.results import Results
from ..base.errors import ShearboxError
from ..base.files import PAGE, SUMMARY, write_json, write_text
from ..drawing.ensemble_curves import draw_ensembles
from .ensemble_summary import summarise_all
from .page import render
from .run_report import write_files

TEMPLATE = "ensemble.html.j2"


def report_on_runs(
    folder: Path,
    runs: Sequence[Path],
    others: Sequence[Results] = (),
    damaged: Sequence[LeftOut] = (),
    each: bool = True,
) -> Path:
    """Write the report on the folder of runs, and that of each, or not; `others`, of which some are damaged, have none of
    their own. Its path is returned.

    Raises ShearboxError after writing if files are damaged, and without writing if no run is complete.
    """
    read, unread = read_all(runs, _read_and_report if each else read_quietly)
    ensembles, incomplete = put_together([*read, *others])
    unread += damaged
    left_out = [*unread, *incomplete]
    if not ensembles:
        reasons = [f"{one.folder}: {one.reason}" for one in left_out]
        raise ShearboxError(f"{folder}: no specimen is complete yet\n" + "\n".join(reasons))
    tables = ["curves.csv"] if len(ensembles) == 1 else [f"curves_{k + 1}.csv" for k in range(len(ensembles))]
    _remove_others(folder, tables)
    for table, ensemble in zip(tables, ensembles):
        write_text(folder / table, as_csv(list(ensemble.curves.values())))
    summary = summarise_all(folder, ensembles, left_out, tables)
    write_json(folder / SUMMARY, summary)
    page = folder / PAGE
    write_text(page, render(TEMPLATE, summary=summary, pictures=draw_ensembles(ensembles), name=folder.resolve().name))
    problems = [one.reason for one in unread] + [
        problem for run in read for problem in [*run.problems, *run.frame_problems]
    ]
    if problems:
        raise ShearboxError(f"{page} is written, but not all files can be read:\n" + "\n".join(problems))
    return page


def _remove_others(folder: Path, tables: Sequence[str]) -> None:
    """Tables of an earlier report on more or fewer ensembles, by its summary: nobody would see that they are not of this one."""
    try:
        summary = json.loads((folder / SUMMARY).read_text(encoding="utf-8"))
        before = {str(one["curves"]) for one in summary["ensembles"]}
    except (OSError, ValueError, LookupError, TypeError, RecursionError):
        return
    for name in before - {*tables}:
        if re.fullmatch(r"curves(_\d+)?\.csv", name):
            (folder / name).unlink(missing_ok=True)


def _read_and_report(folder: Path) -> Results | str:
    """A run, of which a report is written if there is anything to tell; or why it cannot be read. Whether it counts has nothing
    to do with its pictures."""
    results = read_quietly(folder)
    if isinstance(results, str):
        return results
    try:
        return replace(results, frame_problems=write_files(results)) if results.shears else results
    except ShearboxError as error:
        return replace(results, frame_problems=(*results.frame_problems, str(error)))
