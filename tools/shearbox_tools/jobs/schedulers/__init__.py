# SPDX-License-Identifier: GPL-2.0-or-later
"""What a batch system must be able to do. Each is a file here, of that name, with a SCHEDULER in it."""

import importlib
import pkgutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ...base.errors import InputError
from ..cluster import Cluster


@dataclass(frozen=True)
class Job:
    """What is asked of a batch system: once (`elements` 0), or for each element of an array, from 1 on.

    The command has the number of the element as a further, last word. It is sent SIGUSR1 at least `notice` seconds before
    the limit, if that is not 0. What it says goes to LOG.log, or LOG_N.log of element N, in the folder it is submitted from.
    """

    name: str
    command: Sequence[str]
    log: str
    minutes: int
    elements: int = 0
    cores: int = 1  # of all nodes together
    nodes: int = 1
    notice: int = 0


class Scheduler(Protocol):
    """A batch system. What asks it raises ShearboxError with what it says."""

    def check(self, folder: Path) -> None:
        """Refuse a folder from which jobs cannot be submitted."""

    def script(self, job: Job, cluster: Cluster) -> str:
        """The job's script."""

    def submit(self, script: Path, after: str = "") -> str:
        """Submit a script from the folder above its own, to begin when job `after` has ended, however; the job's id."""

    def states(self, name: str) -> dict[int, str]:
        """States, by element, of what has not ended of the user's jobs of that name; 0 is one that is no array."""

    def cancel(self, name: str) -> None:
        """End the user's jobs of that name."""

    def requeue(self) -> None:
        """Have the element in which this is called begin again."""


def find_scheduler(name: str) -> Scheduler:
    """The batch system of that name."""
    known = sorted(module.name for module in pkgutil.iter_modules(__path__))
    if name not in known:
        raise InputError(f"scheduler {name}: {' or '.join(known)} is expected")
    scheduler: Scheduler = importlib.import_module(f"{__name__}.{name}").SCHEDULER
    return scheduler
