# SPDX-License-Identifier: GPL-2.0-or-later
"""Starts the engines and reads what they say about a run: loop time, its phases, neighbour rebuilds, peak memory."""

from __future__ import annotations

import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.append(str(ROOT / "tests" / "decks"))
from engine import TO_MEASURE  # noqa: E402

CDEM, STOCK, LIGGGHTS = "cdem", "LAMMPS", "LIGGGHTS"
PROGRAMS = {CDEM: str(ROOT / "build" / "lmp_cdem"), STOCK: "lmp", LIGGGHTS: "liggghts"}
PACKAGES = {CDEM: "tools/setup", STOCK: "apt-get install lammps", LIGGGHTS: "apt-get install liggghts"}
VERSIONS = {CDEM: r"Shearbox (.*)", STOCK: r"LAMMPS \((.*)\)", LIGGGHTS: r"LIGGGHTS-PUBLIC ([^,]*)"}
PHASES = ("pair", "neigh", "comm", "output", "modify", "other")


def build_of(tree: Path) -> str:
    """Ten digits that tell the engine of a tree from other builds: scenes are kept by it, as restart files are of one build."""
    return hashlib.sha256((tree / "build" / "lmp_cdem").read_bytes()).hexdigest()[:10]


class EngineError(RuntimeError):
    """An engine ended with an error."""


@dataclass(frozen=True)
class Job:
    """A deck for an engine."""

    engine: str
    deck: Path
    variables: Mapping[str, object]
    steps: int = 0  # expected, to guess how long it takes
    discs: int = 1  # of grains: what the time is divided by
    ranks: int = 1
    files: tuple[Path, ...] = ()  # wanted in the folder of the run


@dataclass(frozen=True)
class Usage:
    """What a program used; 0 is not known."""

    peak_bytes: int
    processor: float  # share of its time in which it had a processor


@dataclass(frozen=True)
class Sample:
    """A run of a job."""

    seconds: float  # of the loop, everything included, as the engine says
    steps: int
    discs: int
    builds: int  # of neighbour lists
    dangerous: int
    peak_bytes: int  # resident memory at most, of a single rank; 0 for several
    phases: dict[str, float] = field(default_factory=dict)  # s
    processor: float = 0.0  # share of the time in which the program had a processor; 0: not known

    @property
    def ns(self) -> float:
        """Time per disc and step, ns."""
        return self.scaled(self.seconds)

    def scaled(self, seconds: float) -> float:
        """Seconds of the loop, per disc and step, in ns."""
        return seconds / self.steps / self.discs * 1e9


def installed(engine: str) -> bool:
    """Whether the engine's program is there."""
    return shutil.which(PROGRAMS[engine]) is not None


def version(engine: str) -> str:
    """The version that the engine prints when it starts."""
    found = re.search(VERSIONS[engine], ask(engine, "")[1])
    return found[1] if found else "unknown"


def machine() -> dict[str, str]:
    """Processor, system, and versions of the engines that are installed."""
    cpuinfo = Path("/proc/cpuinfo").read_text()
    model = re.search(r"model name\s*: (.*)", cpuinfo)
    flags = set(cpuinfo.split())
    vectors = [name for name in ("sse2", "avx2", "avx512f", "asimd") if name in flags]
    return {
        "processor": f"{model[1] if model else platform.machine()}, {os.cpu_count()} cores, {' '.join(vectors)}",
        "system": f"{platform.freedesktop_os_release()['PRETTY_NAME']}, Linux {platform.release()}",
        **{engine: version(engine) for engine in PROGRAMS if installed(engine)},
    }


def ask(engine: str, deck: str) -> tuple[int, str]:
    """Exit status and output of some lines of a deck."""
    words = [PROGRAMS[engine], "-log", "none"]
    done = subprocess.run(words, input=deck, env=TO_MEASURE, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


def execute(job: Job, folder: Path, core: int | None = None) -> Sample:
    """Runs a job in a folder of its own, on a certain core if it is of one rank, and measures it."""
    text, usage = start(job, folder, core)
    return read(text, job, usage if job.ranks == 1 else Usage(0, 0))


def start(job: Job, folder: Path, core: int | None = None) -> tuple[str, Usage]:
    """What a job prints and uses."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for file in job.files:
        shutil.copy(file, folder)
    launch = ["mpirun", "--oversubscribe", "--bind-to", "core", "-np", str(job.ranks)] if job.ranks > 1 else []
    if core is not None and job.ranks == 1:
        launch = ["taskset", "-c", str(core)]  # becomes the engine, so that memory is the engine's
    words = [*launch, PROGRAMS[job.engine], "-in", str(job.deck), "-log", "none"]
    for name, value in job.variables.items():
        words += ["-var", name, str(value)]
    status, usage = wait(words, folder)
    text = (folder / "output").read_text(errors="replace")
    if status:
        raise EngineError(f"{' '.join(words)}\nin {folder} ended with status {status}:\n{text[-1500:]}")
    return text, usage


def wait(words: list[str], folder: Path) -> tuple[int, Usage]:
    """Exit status of a program and what it used; its output goes to the file `output`."""
    begin = time.monotonic()
    with (folder / "output").open("w") as output:
        process = subprocess.Popen(
            words, cwd=folder, env=TO_MEASURE, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT
        )
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except KeyboardInterrupt:
            process.terminate()
            process.wait()
            raise
    process.returncode = os.waitstatus_to_exitcode(status)
    share = (usage.ru_utime + usage.ru_stime) / (time.monotonic() - begin)
    return process.returncode, Usage(usage.ru_maxrss * 1024, min(1.0, share))


def read(text: str, job: Job, usage: Usage) -> Sample:
    """What the engine printed about its last run."""
    last = text[text.rindex("Loop time of") :]
    seconds = float(re.findall(r"Loop time of (\S+)", last)[0])
    return Sample(
        seconds,
        steps=int(re.findall(r" for (\d+) steps", last)[0]),
        discs=job.discs,
        builds=int(re.findall(r"Neighbor list builds = (\d+)", last)[0]),
        dangerous=int(re.findall(r"Dangerous builds = (\d+)", last)[0]),
        peak_bytes=usage.peak_bytes,
        phases=phases(last, seconds),
        processor=usage.processor,
    )


def phases(text: str, seconds: float) -> dict[str, float]:
    """Seconds by phase (mean over ranks), from the table of LAMMPS or the lines of LIGGGHTS."""
    found = re.findall(r"^(\w+) *\|[^|]*\| *([\d.e+-]+) *\|", text, re.M) + re.findall(
        r"^(\w+) +time \(%\) = ([\d.e+-]+)", text, re.M
    )
    spent = {"output" if name == "Outpt" else name.lower(): float(value) for name, value in found}
    spent = {name: value for name, value in spent.items() if name in PHASES}
    if "other" not in spent:
        spent["other"] = seconds - sum(spent.values())
    return {name: spent.get(name, 0.0) for name in PHASES}
