# SPDX-License-Identifier: GPL-2.0-or-later
"""The report on many runs: report.html, summary.json, a table of mean curves for each ensemble; and each run's own."""

import signal
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from os import sched_getaffinity
from pathlib import Path

from .ensemble_curves import draw_ensembles
from .ensemble_results import Ensemble
from .ensemble_summary import summarise_all
from .errors import ShearboxError
from .files import PAGE, SUMMARY, write_json, write_text
from .grouping import LeftOut, put_together
from .mean_curve import as_csv
from .page import render
from .report import write_report
from .results import Results, read_results

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
    read, unread = _read_all(runs, each)
    ensembles, incomplete = put_together([*read, *others])
    unread += damaged
    left_out = [*unread, *incomplete]
    if not ensembles:
        reasons = [f"{one.folder}: {one.reason}" for one in left_out]
        raise ShearboxError(f"{folder}: no specimen is complete yet\n" + "\n".join(reasons))
    tables = ["curves.csv"] if len(ensembles) == 1 else [f"curves_{k + 1}.csv" for k in range(len(ensembles))]
    for table, ensemble in zip(tables, ensembles):
        write_text(folder / table, as_csv(list(ensemble.curves.values())))
    summary = summarise_all(folder, ensembles, left_out, tables)
    write_json(folder / SUMMARY, summary)
    page = folder / PAGE
    write_text(page, render(TEMPLATE, summary=summary, pictures=draw_ensembles(ensembles), name=folder.resolve().name))
    problems = [one.reason for one in unread] + [problem for run in read for problem in run.problems]
    if problems:
        raise ShearboxError(f"{page} is written, but not all files can be read:\n" + "\n".join(problems))
    return page


def _read_all(folders: Sequence[Path], each: bool) -> tuple[list[Results], list[LeftOut]]:
    """Read runs, and write their own reports or not, as many at a time as there are cores."""
    read: list[Results] = []
    unread: list[LeftOut] = []
    with ProcessPoolExecutor(len(sched_getaffinity(0)), initializer=_end_at_once) as pool:
        results = [pool.submit(_read_one, folder, each) for folder in folders]
        try:
            for folder, result in zip(folders, (future.result() for future in results)):
                if isinstance(result, Results):
                    read.append(result)
                else:
                    unread.append(LeftOut(folder, result))
        finally:
            pool.shutdown(cancel_futures=True)
    return read, unread


def _end_at_once() -> None:
    """When it is stopped: the program that started this process has a message for that."""
    for sign in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(sign, signal.SIG_DFL)


def _read_one(folder: Path, each: bool) -> Results | str:
    """A run, of which a report is written if it is wanted and there is anything to tell; or why it cannot be read."""
    try:
        results = read_results(folder)
    except ShearboxError as error:
        return str(error)
    try:
        if each and results.shears:
            write_report(results)
    except ShearboxError as error:
        if not results.problems:  # these are told with the ensemble
            return str(error)
    return results
