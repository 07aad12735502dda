# SPDX-License-Identifier: GPL-2.0-or-later
"""Many runs, read as many at a time as there are cores."""

import signal
from collections.abc import Callable, Sequence
from concurrent import futures
from os import sched_getaffinity
from pathlib import Path

from ..base.errors import ShearboxError
from .grouping import LeftOut
from .results import Results, read_results


def read_all(folders: Sequence[Path], read_one: Callable[[Path], Results | str]) -> tuple[list[Results], list[LeftOut]]:
    """What read_one, a function of a module, makes of each run; or why it cannot be read."""
    read: list[Results] = []
    unread: list[LeftOut] = []
    with futures.ProcessPoolExecutor(len(sched_getaffinity(0)), initializer=_end_at_once) as pool:
        results = [pool.submit(read_one, folder) for folder in folders]
        try:
            for folder, result in zip(folders, (future.result() for future in results)):
                if isinstance(result, Results):
                    read.append(result)
                else:
                    unread.append(LeftOut(folder, result))
        finally:
            pool.shutdown(cancel_futures=True)
    return read, unread


def read_quietly(folder: Path) -> Results | str:
    """A run, of which nothing is written; or why it cannot be read."""
    try:
        return read_results(folder)
    except ShearboxError as error:
        return str(error)


def _end_at_once() -> None:
    """When it is stopped: the program that started this process has a message for that."""
    for sign in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(sign) != signal.SIG_IGN:
            signal.signal(sign, signal.SIG_DFL)
