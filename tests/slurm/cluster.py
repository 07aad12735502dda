# SPDX-License-Identifier: GPL-2.0-or-later
"""A cluster of one node: a real Slurm in a folder, with ports, keys and processes of its own, and no accounting database."""

from __future__ import annotations

import getpass
import os
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "scontrol")
PATH = os.environ["PATH"] + ":/usr/sbin"
SECONDS = 120.0  # for anything that takes half a minute on an idle machine
CPUS = 8  # whatever the machine has
# A requeued job waits for its credential to expire: two minutes, unless cred_expire says less, of which 5 s is the least.
CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={controller_port}
SlurmdPort={node_port}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
MailProg=/bin/true
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=test Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


class NotThere(Exception):
    """Why there can be no Slurm here."""


class Cluster:
    """Starts it; `environment` is for the programs that are to use it."""

    def __init__(self) -> None:
        missing = [name for name in PROGRAMS if shutil.which(name, path=PATH) is None]
        if missing:
            raise NotThere(f"{', '.join(missing)} not there; tools/setup --ci installs Slurm")
        self.folder = Path(tempfile.mkdtemp(prefix="slurm"))
        self.node = socket.gethostname().partition(".")[0]
        self.environment = {**os.environ, "PATH": PATH, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self._configure()
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        munge = self.folder / "munge"
        options = {"key-file": "key", "socket": "socket", "pid-file": "pid", "log-file": "log", "seed-file": "seed"}
        try:
            self._start("munged", "--foreground", *(f"--{name}={munge / file}" for name, file in options.items()))
            wait_for(lambda: self._runs("munged") and (munge / "socket").exists())
            self.start_controller()
            self.start_node()
            wait_for(lambda: self._runs("slurmd") and self.state_of_node() == "idle")
        except AssertionError as error:
            logs = [path.read_text(errors="replace")[-500:] for path in sorted(self.folder.glob("*.log"))]
            self.stop()
            raise NotThere(f"it does not start: {error}; {logs}") from error

    def _configure(self) -> None:
        for name in ("munge", "state", "spool"):
            (self.folder / name).mkdir(parents=True, mode=0o755)
        self.folder.chmod(0o755)  # the socket is for all users
        (self.folder / "munge" / "key").write_bytes(os.urandom(128))
        (self.folder / "munge" / "key").chmod(0o600)
        sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(2)]
        ports = [one.getsockname()[1] for one in sockets]
        for one in sockets:
            one.close()
        text = CONFIGURATION.format(
            folder=self.folder, host=self.node, user=getpass.getuser(), cpus=CPUS,
            controller_port=ports[0], node_port=ports[1],
        )  # fmt: skip
        (self.folder / "slurm.conf").write_text(text)

    def _start(self, name: str, *options: str) -> None:
        program = shutil.which(name, path=PATH)
        assert program
        with (self.folder / f"{name}.log").open("ab") as log:
            self._processes[name] = subprocess.Popen(
                [program, *options], env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log
            )

    def start_controller(self) -> None:
        """At first, or again."""
        self._start("slurmctld", "-D")
        wait_for(lambda: self._runs("slurmctld") and self.state_of_node() != "")

    def start_node(self) -> None:
        """At first, or anew."""
        self._end("slurmd")
        self._start("slurmd", "-D")

    def stop_controller(self, job: str) -> None:
        """As a crash does, but not before the controller has saved its jobs: it does that up to 5 s after a change, and
        forgets what was submitted since. A comment on a job is such a change."""
        changed = time.time()
        self.call("scontrol", "update", f"JobId={job}", "Comment=saved")
        wait_for(lambda: (self.folder / "state" / "job_state").stat().st_mtime > changed)
        self._processes["slurmctld"].kill()
        self._processes["slurmctld"].wait()

    def _runs(self, name: str) -> bool:
        status = self._processes[name].poll()
        assert status is None, f"{name} has ended with status {status}"
        return True

    def clear(self) -> None:
        """End all jobs."""
        self.call("scancel", f"--user={getpass.getuser()}")
        wait_for(lambda: not self.queue(), 30)

    def stop(self) -> None:
        """End all processes, and remove the folder."""
        for name in ("slurmd", "slurmctld", "munged"):
            self._end(name)
        shutil.rmtree(self.folder)

    def _end(self, name: str) -> None:
        if name in self._processes:
            self._processes[name].terminate()
            self._processes[name].wait()

    def call(self, *command: str) -> str:
        """What a command says; nothing if it fails."""
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False)
        return "" if done.returncode else done.stdout.strip()

    def state_of_node(self) -> str:
        """As sinfo calls it."""
        return self.call("sinfo", "--noheader", "--format=%T")

    def queue(self) -> list[list[str]]:
        """Id with index, state and reason of what has not ended."""
        said = self.call("squeue", "--noheader", "--array", "--format=%i %T %r")
        return [line.split(maxsplit=2) for line in said.splitlines()]


def wait_for(condition: Callable[[], object], seconds: float = SECONDS) -> None:
    """Until it holds."""
    until = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < until, "waited in vain"
        time.sleep(0.1)
