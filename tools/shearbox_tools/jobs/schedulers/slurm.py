# SPDX-License-Identifier: GPL-2.0-or-later
"""Slurm, by its commands sbatch, squeue, scancel and scontrol; no accounting database is needed."""

import os
import shlex
import subprocess
from pathlib import Path

from ...base.errors import InputError, ShearboxError
from ..cluster import Cluster
from . import Job

MINUTES_A_DAY = 24 * 60
# Options that a script has of its own, and variables of the environment that come before them.
OURS = ("--array", "-a", "--job-name", "-J", "--output", "-o", "--dependency", "-d", "--signal", "--open-mode", "--requeue",
        "--no-requeue")  # fmt: skip
VARIABLES = ("SBATCH_ARRAY_INX", "SBATCH_JOB_NAME", "SBATCH_NO_REQUEUE", "SBATCH_OPEN_MODE", "SBATCH_OUTPUT",
             "SBATCH_SIGNAL")  # fmt: skip


class Slurm:
    """See the interface."""

    def check(self, folder: Path) -> None:
        """The path of a log is that of the folder as well, and a job whose log cannot be opened ends without a word."""
        path = str(folder.resolve())
        if "%" in path or "\\" in path:
            raise InputError(f"{path}: Slurm reads % and \\ in the path of a log as patterns; another folder is needed")

    def script(self, job: Job, cluster: Cluster) -> str:
        """One shell that becomes the command: it gets the signal (B:) itself, and need not pass it on."""
        for option in cluster.options:
            if option.startswith(OURS):
                raise InputError(f"{cluster.file}: options = {option!r}: 'shearbox submit' sets it itself")
            if not option.startswith("-"):
                raise InputError(
                    f"{cluster.file}: options = {option!r}: an option of sbatch is expected, such as --mem=1G"
                )
        hours, minutes = divmod(job.minutes % MINUTES_A_DAY, 60)
        options = [
            f"--job-name={job.name}",
            f"--array=1-{job.elements}" if job.elements else "",
            f"--output={job.log}_%a.log" if job.elements else f"--output={job.log}.log",
            "--open-mode=append",
            f"--nodes={job.nodes}",
            f"--ntasks={job.cores}",
            f"--time={job.minutes // MINUTES_A_DAY}-{hours:02d}:{minutes:02d}",
            f"--signal=B:USR1@{job.notice}" if job.notice else "",
            "--requeue",
            f"--partition={cluster.partition}" if cluster.partition else "",
            f"--account={cluster.account}" if cluster.account else "",
            *cluster.options,
        ]
        element = ' "$SLURM_ARRAY_TASK_ID"' if job.elements else ""
        lines = [
            "#!/bin/bash",
            *(f"#SBATCH {option}" for option in options if option),
            *cluster.commands,
            f"exec {shlex.join(job.command)}{element}",
        ]
        return "\n".join(lines) + "\n"

    def submit(self, script: Path, after: str = "") -> str:
        """The id is that of the array."""
        dependency = [f"--dependency=afterany:{after}"] if after else []
        folder = script.parent.parent
        said = _call("sbatch", "--parsable", *dependency, str(script.relative_to(folder)), folder=folder)
        return said.strip().partition(";")[0]  # the name of the cluster may follow

    def states(self, name: str) -> dict[int, str]:
        """As squeue calls them, with the reason of those that wait."""
        said = _call("squeue", "--noheader", "--array", *_of_the_user(name), "--format=%K %T %r")
        states = {}
        for line in said.splitlines():
            element, state, reason = line.split(maxsplit=2)
            waits = state == "PENDING" and reason != "None"
            states[int(element) if element.isdigit() else 0] = state.lower() + (f" ({reason})" if waits else "")
        return states

    def cancel(self, name: str) -> None:
        """By the name: an id may be another job's by now."""
        _call("scancel", *_of_the_user(name))

    def requeue(self) -> None:
        """By array and index: the id of the last element is also that of the whole array."""
        _call("scontrol", "requeue", f"{os.environ['SLURM_ARRAY_JOB_ID']}_{os.environ['SLURM_ARRAY_TASK_ID']}")


SCHEDULER = Slurm()


def _of_the_user(name: str) -> tuple[str, ...]:
    return f"--user={os.getuid()}", f"--name={name}"


def _environment() -> dict[str, str]:
    """Without the user's filters of states and names: they come before what a script says, and hide jobs."""
    return {k: v for k, v in os.environ.items() if k not in VARIABLES and not k.startswith(("SQUEUE_", "SCANCEL_"))}


def _call(*command: str, folder: Path | None = None) -> str:
    try:
        done = subprocess.run(
            command, cwd=folder, env=_environment(), capture_output=True, text=True, errors="replace", check=False
        )
    except OSError as error:
        raise ShearboxError(f"{command[0]}: {error.strerror}; is this a machine of the cluster?") from error
    if done.returncode:
        raise ShearboxError(f"{shlex.join(command)}: {done.stderr.strip() or f'status {done.returncode}'}")
    return done.stdout
