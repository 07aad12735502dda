# SPDX-License-Identifier: GPL-2.0-or-later
"""Starting, stopping and questioning the engine, lmp_cdem or LIGGGHTS."""

import ctypes
import os
import re
import shutil
import signal
import subprocess
from dataclasses import dataclass
from pathlib import Path

from ..asking.hosts import PROGRAM, words_before
from ..base.errors import InputError
from .phases import Phase

SECONDS_TO_STOP = 10.0
LEAST_FREE_BYTES = 20_000_000
# mpirun tells a signal of a rank as a status of 128 and more
ENDED_FROM_OUTSIDE = {sign for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGXCPU)
                      for sign in (int(number), -128 - number)}  # fmt: skip
_LIBC = ctypes.CDLL(None)
_PR_SET_PDEATHSIG = 1  # of <sys/prctl.h>
# Of Open MPI 4 and 5: several runs share a machine, so ranks may be more than cores, and none is bound to one.
_OPEN_MPI = {
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
    "PRTE_MCA_hwloc_default_binding_policy": "none",
}


@dataclass(frozen=True)
class Engine:
    """The program and the number of MPI ranks of each of its runs."""

    program: Path = PROGRAM
    ranks: int = 1

    def check(self) -> None:
        """Refuse to begin without a program that can be started."""
        if not (self.program.is_file() and os.access(self.program, os.X_OK)):
            remedy = "tools/setup builds lmp_cdem, cmake --install copies it into a prefix; LIGGGHTS is Debian's package liggghts"
            raise InputError(f"the engine {self.program} is not there or cannot be run: {remedy}")
        if self.ranks > 1 and shutil.which("mpirun") is None:
            raise InputError(f"--ranks {self.ranks}: there is no mpirun (Debian: apt-get install openmpi-bin)")

    def command(self, phase: Phase) -> list[str]:
        """The command line; variables in the order of the phase."""
        mpi = ["mpirun", "-np", str(self.ranks)] if self.ranks > 1 else []  # what all of them know; more: _environment
        variables = [word for name, value in phase.variables.items() for word in ("-var", name, value)]
        return [
            *mpi,
            *words_before(phase.host),
            str(self.program),
            "-in",
            str(phase.deck),
            "-log",
            str(phase.log.name),
            *variables,
        ]

    def start(self, phase: Phase, lock: int) -> subprocess.Popen[bytes]:
        """Start a phase in its folder, in a process group of its own: the terminal's Ctrl-C does not reach it.

        `lock` is the descriptor of the folder's lock, which the engine keeps until it ends.
        """
        phase.folder.mkdir(parents=True, exist_ok=True)
        _rotate(phase.log)
        with phase.screen.open("wb") as screen:
            return subprocess.Popen(
                self.command(phase),
                cwd=phase.folder,
                stdin=subprocess.DEVNULL,
                stdout=screen,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                pass_fds=(lock,),
                preexec_fn=_end_with_parent,  # also if it is killed
                env={**os.environ, **_environment()},
            )


def stop(processes: list[subprocess.Popen[bytes]]) -> None:
    """End the process groups, politely first."""
    for sign in (signal.SIGTERM, signal.SIGKILL):
        for process in processes:
            if process.poll() is None:
                os.killpg(process.pid, sign)
        for process in processes:
            try:
                process.wait(SECONDS_TO_STOP)
            except subprocess.TimeoutExpired:
                continue


@dataclass(frozen=True)
class Failure:
    """Why a phase has failed, and whether the cause may be gone when the same is tried again."""

    message: str
    may_pass: bool


def explain_failure(phase: Phase, status: int) -> Failure:
    """The last ERROR line of its log, or what else is known, and where to read on."""
    reason = _last_error(phase.log) or _last_error(phase.screen)
    may_pass = not reason and -status in ENDED_FROM_OUTSIDE
    if not reason:
        reason = f"the engine was ended by signal {-status}" if status < 0 else f"the engine ended with status {status}"
        if status == 0:
            reason = f"the engine ended without writing {phase.product} and {phase.restart}"
    if free_bytes(phase.folder) < LEAST_FREE_BYTES:
        reason += f" (the disk is full: {free_bytes(phase.folder) / 1e6:.0f} MB free)"
        may_pass = True
    if "'dt any'" in reason:  # words of decks
        reason += "\n  With shearbox: a smaller --dt, or --dt auto"
    where = phase.log if phase.log.exists() else phase.screen
    return Failure(f"{phase.label} failed: {reason}\n  log: {where}", may_pass)


def free_bytes(folder: Path) -> int:
    """Free space on the disk of a folder that may not exist yet."""
    existing = next(p for p in (folder.resolve(), *folder.resolve().parents) if p.exists())
    return shutil.disk_usage(existing).free


def _end_with_parent() -> None:
    """Called in the child before it becomes the engine. mpirun ends its ranks when it gets this signal."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)


def _last_error(path: Path) -> str | None:
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return None
    found = [i for i, line in enumerate(lines) if re.match(r"\s*(?:\S+:\s*)?ERROR\b", line)]
    if not found:
        return None
    at = found[-1]
    last = [line for line in lines[at + 1 : at + 2] if line.startswith(("Last command", "Last input line"))]
    return "\n  ".join(line.strip() for line in [lines[at], *last])


def _rotate(path: Path) -> None:
    """Keep the logs of earlier attempts as NAME.1, NAME.2, ..."""
    if path.exists():
        number = 1
        while path.with_name(f"{path.name}.{number}").exists():
            number += 1
        path.rename(path.with_name(f"{path.name}.{number}"))


def _environment() -> dict[str, str]:
    root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"} if os.geteuid() == 0 else {}
    return {"OMP_NUM_THREADS": "1", **_OPEN_MPI, **root}
