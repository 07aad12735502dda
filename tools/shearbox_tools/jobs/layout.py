# SPDX-License-Identifier: GPL-2.0-or-later
"""How runs are laid out on a cluster: which share a job, with how many cores, and how long it may last."""

import math
from collections.abc import Sequence
from functools import cached_property

from ..base.errors import InputError
from ..running.forecast import Forecast, memory_of_all, seconds_of_all
from ..running.run_folders import Run
from .cluster import Cluster

SAFETY_FACTOR = 2  # of a job's limit: estimates are good to a factor of 2
SECONDS_AROUND = 600  # for the beginning and the end of a job
ROUND_MINUTES = 10  # limits are multiples of it
LEAST_NOTICE = 60  # s
BYTES_SEALED = 1e8  # in a second: all dumps are read once when tests are stopped, and for a report
REPORT_MINUTES = 30
LEAST_NOTICES = 3  # in a job, else it would hardly do anything


class Layout:
    """The elements of a job array: each has the tests of some runs, of which `at_a_time` run on a core for each rank.

    `asked` is how many tests run at a time; if it is None, as many as fill a node, or where its cores are not known those of
    one specimen. What needs several nodes runs alone.
    """

    def __init__(self, runs: Sequence[Run], cluster: Cluster, asked: int | None, ranks: int) -> None:
        tests = max(len(run.request.stresses) for run in runs)
        fitting = max(1, cluster.cores // ranks) if cluster.cores else asked or tests
        if asked and asked > fitting:
            raise InputError(f"--jobs {asked}: {fitting} of {ranks} ranks fit on the {cluster.cores} cores of a node")
        wanted = asked or fitting
        count = math.ceil(len(runs) / max(1, wanted // tests))
        each = math.ceil(len(runs) / count)
        self.elements = [list(runs[k : k + each]) for k in range(0, len(runs), each)]
        self.at_a_time = min(wanted, each * tests)
        self.cores = self.at_a_time * ranks
        self.nodes = math.ceil(self.cores / cluster.cores) if cluster.cores else 1
        self._ranks = ranks
        self._longest = 60 * cluster.hours
        if self._longest and 60 * self._longest < LEAST_NOTICES * self.notice:
            raise InputError(
                f"{cluster.file}: hours = {cluster.hours:g}: a job needs {self.notice} s to end, and must last "
                f"{LEAST_NOTICES} times as long"
            )

    @cached_property
    def forecasts(self) -> list[list[Forecast]]:
        """Of the runs of each element."""
        return [[Forecast(run.folder, run.request, self._ranks) for run in element] for element in self.elements]

    @property
    def seconds(self) -> float:
        """Estimate of the longest element."""
        return max(seconds_of_all(some, self.at_a_time) for some in self.forecasts)

    @property
    def memory(self) -> float:
        """Bytes that the engine needs in an element."""
        return max(memory_of_all(some, self.at_a_time) for some in self.forecasts)

    @cached_property
    def notice(self) -> int:
        """Seconds before the limit at which to ask for the end: the longest wait, with the margin, twice; and seals."""
        waits = [one.longest_wait(phase) for some in self.forecasts for one in some for phase in one.phases]
        sealing = max(sum(one.bytes_of_frames for one in some) for some in self.forecasts) / BYTES_SEALED
        return math.ceil(LEAST_NOTICE + 2 * SAFETY_FACTOR * max(waits) + sealing)

    @property
    def minutes(self) -> int:
        """That a job may last."""
        needed = _rounded_up((SAFETY_FACTOR * self.seconds + SECONDS_AROUND + self.notice) / 60)
        return min(needed, int(self._longest)) if self._longest else needed

    @property
    def report_minutes(self) -> int:
        """That the report may take: it draws all tests, and reads all their files for seals."""
        every = [one for some in self.forecasts for one in some]
        seconds = sum(one.seconds_of_report + one.bytes_of_frames / BYTES_SEALED for one in every)
        return _rounded_up(REPORT_MINUTES + SAFETY_FACTOR * seconds / 60)


def _rounded_up(minutes: float) -> int:
    return ROUND_MINUTES * math.ceil(minutes / ROUND_MINUTES)
