# SPDX-License-Identifier: GPL-2.0-or-later
"""Submits small ensembles, waits for them, compares them with what an undisturbed run leaves, and keeps a diary of it."""

from __future__ import annotations

import atexit
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from cluster import Cluster, wait_for
from rich.console import Console

ROOT = Path(__file__).resolve().parents[2]
SHEARBOX = str(ROOT / "tools" / "shearbox")
MODEL = str(ROOT / "tests" / "robustness" / "grit.in")
OPTIONS = ["--stress", "100", "--travel", "1", "--jobs", "1"]
COMPARED = ("packed/packed.csv", *(f"100/{name}" for name in ("consolidated.csv", "shear.dat", "grains.dump",
            "discs.dump", "contacts.dump", "cells.dump")))  # fmt: skip

sys.path.insert(0, str(ROOT / "tools"))
from shearbox_tools.asking.request import open_folder  # noqa: E402
from shearbox_tools.base.lock import locked  # noqa: E402
from shearbox_tools.commands.cli import make_parser  # noqa: E402
from shearbox_tools.commands.run import carry_out, prepare  # noqa: E402
from shearbox_tools.reading.readers import last_value  # noqa: E402


class Bench:
    """`options` go to shearbox, `environment` to the engine; `diary` has what happened, a line each."""

    def __init__(self, cluster: Cluster, folder: Path, options: Sequence[str], **environment: str) -> None:
        self.cluster = cluster
        self.out = folder / 'it\'s a "test"'
        self._options = [*OPTIONS, *options]
        self._environment = cluster.environment | environment
        self._begun = time.monotonic()
        self.diary: list[str] = []

    def say(self, text: str) -> None:
        """Into the diary, with the time since the beginning."""
        self.diary += [f"{time.monotonic() - self._begun:5.0f} s  {line}" for line in text.splitlines()]

    def shearbox(self, *words: str, status: int = 0) -> str:
        """What a command says, or complains of if it is to fail."""
        done = subprocess.run([SHEARBOX, *words], env=self._environment, capture_output=True, text=True, check=False)
        assert done.returncode == status, f"{words}: {done.returncode}, {done.stdout}{done.stderr}"
        said = (done.stderr if status else done.stdout).strip().replace(str(self.out), "DIR")
        self.say(f"$ shearbox {' '.join(words).replace(str(self.out), 'DIR').replace(MODEL, 'grit.in')}\n{said}")
        return said

    def submit(self, seeds: int, *more: str, status: int = 0) -> str:
        """An ensemble; the id of its tests, or what it complains of if it is to fail."""
        said = self.shearbox(
            "submit", MODEL, "--out", str(self.out), "--seeds", str(seeds), *self._options, *more, status=status
        )
        return said.split("job ")[-2].partition(":")[0] if not status else said

    def scontrol(self, *words: str) -> None:
        """As the administrator of the cluster would."""
        self.say(f"$ scontrol {' '.join(words)}")
        done = subprocess.run(["scontrol", *words], env=self._environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr

    def travel(self, seed: int) -> float:
        """Shear displacement (mm) so far."""
        return last_value(self.out / f"seed_{seed}" / "100" / "shear.dat", "displacement_mm") or 0.0

    def wait_for_travel(self, *seeds: int, mm: float = 0.15) -> None:
        """Until so much of their shear is done."""
        wait_for(lambda: all(self.travel(seed) > mm for seed in seeds))

    def one_job_a_node(self) -> str:
        """A file for --cluster."""
        path = self.out.parent / "cluster.toml"
        path.write_text('options = ["--exclusive"]\n', encoding="utf-8")
        return str(path)

    def queued(self, job: str) -> dict[str, str]:
        """State and reason of what has not ended of a job, by element."""
        return {name: f"{state} {reason}" for name, state, reason in self.cluster.queue() if name.startswith(job)}

    def wait_for_end(self, job: str) -> None:
        """Of a job, all of its elements."""
        wait_for(lambda: not self.queued(job))

    def log(self, element: int) -> str:
        """Of an element."""
        return (self.out / "jobs" / f"tests_{element}.log").read_text(encoding="utf-8")

    def check_bits(self, *seeds: int) -> None:
        """All results of these are those of an undisturbed run."""
        for seed in seeds:
            whole = undisturbed(seed, *self._options)
            for name in COMPARED:
                assert (self.out / f"seed_{seed}" / name).read_bytes() == (whole / name).read_bytes(), (seed, name)
            self.say(f"seed_{seed}: the same bits as undisturbed")


@cache
def undisturbed(seed: int, *options: str) -> Path:
    """The folder of a run without Slurm, and without a report, which would take longer than all else."""
    folder = Path(tempfile.mkdtemp(prefix="whole"))
    atexit.register(shutil.rmtree, folder)
    given = make_parser().parse_args(["run", MODEL, "--out", str(folder / "run"), "--seed", str(seed), *options])
    out, runs, engine = prepare(given, [vars(given)])
    with locked(out) as lock:
        open_folder(out, runs[0].request)
        assert not carry_out(runs, engine, 1, {out: lock}, Console(quiet=True))
    return out
