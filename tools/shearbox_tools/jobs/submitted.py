# SPDX-License-Identifier: GPL-2.0-or-later
"""What was submitted of a folder, as it is kept in jobs/ beside the results, with the scripts and logs of the jobs."""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path

from ..asking.request import recorded
from ..base.errors import InputError, ShearboxError
from ..base.files import write_json
from ..running.run_folders import Run

JOBS = "jobs"
TESTS, REPORT = "tests", "report"  # the two jobs, as their scripts and logs are called
_RECORD = "jobs.json"
_BEGINS = "--- submitted "


@dataclass(frozen=True)
class Jobs:
    """The folders of the runs of each element, relative to that of all, how they are carried out, and what was done before."""

    scheduler: str
    name: str
    elements: list[list[str]]
    at_a_time: int  # tests of an element
    ranks: int
    engine: str
    done: Sequence[str] = ()  # runs of which nothing was left

    def runs(self, folder: Path, element: int) -> list[Run]:
        """Those of an element, from 1 on, as they are recorded in their folders."""
        if not 1 <= element <= len(self.elements):
            raise InputError(
                f"element {element}: 1 to {len(self.elements)} are expected, see {folder / JOBS / _RECORD}"
            )
        return [run_of(folder, name) for name in self.elements[element - 1]]

    def write(self, folder: Path) -> None:
        """Keep it in a folder, and begin anew in the logs of its elements, which may have been those of other runs."""
        write_json(folder / JOBS / _RECORD, asdict(self))
        for number, names in enumerate(self.elements, 1):
            with log_of(folder, number).open("a", encoding="utf-8") as log:
                log.write(f"{_BEGINS}{datetime.now():%Y-%m-%d %H:%M:%S}: {', '.join(names)}\n")


def log_of(folder: Path, element: int) -> Path:
    """What the jobs of an element say."""
    return folder / JOBS / f"{TESTS}_{element}.log"


def said(log: Path) -> list[str]:
    """Lines of a log since its element was submitted last, without empty ones; none if there is no log."""
    try:
        text = log.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return []
    lines = [line.strip() for line in text.split("\n")]
    last = max((k for k, line in enumerate(lines) if line.startswith(_BEGINS)), default=-1)
    return [line for line in lines[last + 1 :] if line]


def run_of(folder: Path, name: str) -> Run:
    """A run of what was submitted of a folder, as it is recorded in its own; "." is the folder itself."""
    return Run(folder / name, recorded(folder / name), "" if name == "." else name)


def read_jobs(folder: Path) -> Jobs:
    """What was submitted of a folder. The record in a copy of it is refused: it tells of the jobs of the first one."""
    path = folder / JOBS / _RECORD
    try:
        jobs = Jobs(**json.loads(path.read_text(encoding="utf-8")))
    except FileNotFoundError as error:
        raise InputError(f"{folder}: nothing was submitted of it, there is no {JOBS}/{_RECORD}") from error
    except (OSError, ValueError, TypeError) as error:
        raise ShearboxError(f"{path}: this is not the record of a submission: {error}") from error
    if jobs.name != name_of(folder):
        raise InputError(
            f"{folder}: its record of jobs is of the folder that it was copied or moved from: jobs {jobs.name} of the batch "
            "system. 'shearbox submit' submits from here what is left to do"
        )
    return jobs


def name_of(folder: Path) -> str:
    """By which its jobs, and no others, are known to the batch system, however the path to it is written."""
    return f"shearbox_{hashlib.sha256(str(folder.resolve()).encode()).hexdigest()[:8]}"
