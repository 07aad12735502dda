# SPDX-License-Identifier: GPL-2.0-or-later
"""What goes wrong on clusters, and what has to happen then. The first line of each is its title."""

from __future__ import annotations

import json
from collections.abc import Callable
from datetime import datetime, timedelta

from bench import Bench
from cluster import wait_for

NOTICE = 61  # s before the limit, at which jobs of these small tests are asked to end


def limit_requeue_failure(bench: Bench) -> None:
    """One job reaches its time limit, one is requeued, one fails

    The limit is moved to where that signal is due. Slurm looks at limits twice a minute.
    """
    job = bench.submit(3)
    bench.wait_for_travel(1, 2)
    end = datetime.now() + timedelta(seconds=NOTICE)
    bench.scontrol("update", f"JobId={job}_1", f"EndTime={end:%Y-%m-%dT%H:%M:%S}")
    bench.scontrol("requeue", f"{job}_2")
    wait_for(lambda: "begins again" in bench.log(1))
    assert (bench.out / "seed_1" / "100" / "shear.restart.c").exists(), "of the last row"
    bench.shearbox("status", str(bench.out))
    bench.wait_for_end(job)
    said = bench.shearbox("status", str(bench.out))
    assert said.count("done; 3 of 3 phases done") == 2
    assert "seed_3: ended before it was done" in said and "pack failed" in said
    told = json.loads(bench.shearbox("status", str(bench.out), "--json"))["runs"]
    assert told["seed_1"] == {"state": "done", "phases": 3, "phases_done": 3, "displacement_mm": {}}
    assert told["seed_3"]["phases_done"] == 0 and "pack failed" in told["seed_3"]["state"]
    bench.check_bits(1, 2)
    wait_for((bench.out / "report.html").exists)
    bench.say("report.html is there")


def drained(bench: Bench) -> None:
    """The node is drained while one job runs and one waits"""
    job = bench.submit(2, "--cluster", bench.one_job_a_node())
    bench.wait_for_travel(1)
    bench.scontrol("update", f"NodeName={bench.cluster.node}", "State=DRAIN", "Reason=repair")
    wait_for(lambda: "DRAINED" in bench.queued(job).get(f"{job}_2", "") and len(bench.queued(job)) == 1)
    said = bench.shearbox("status", str(bench.out))
    assert "seed_1: done" in said and "seed_2: pending" in said and "DRAINED" in said
    bench.scontrol("update", f"NodeName={bench.cluster.node}", "State=RESUME")
    bench.wait_for_end(job)
    bench.check_bits(1, 2)


def down(bench: Bench) -> None:
    """The node fails, and comes back"""
    job = bench.submit(1)
    bench.wait_for_travel(1)
    bench.scontrol("update", f"NodeName={bench.cluster.node}", "State=DOWN", "Reason=fire")
    wait_for(lambda: "PENDING" in bench.queued(job)[f"{job}_1"])
    bench.cluster.start_node()
    bench.say("slurmd is started")
    bench.shearbox("status", str(bench.out))
    bench.wait_for_end(job)
    bench.check_bits(1)


def cancelled(bench: Bench) -> None:
    """The jobs are cancelled, and submitted again"""
    bench.submit(2)
    bench.wait_for_travel(1, 2)
    assert "its jobs have not ended: pending (Dependency), running" in bench.submit(2, status=1)
    bench.shearbox("cancel", str(bench.out))
    assert not bench.cluster.queue()
    assert "ended before it was done" in bench.shearbox("status", str(bench.out))
    job = bench.submit(2)
    bench.wait_for_end(job)
    assert bench.log(1).count("shear 100 kPa: started at") == 1, "it goes on, from a restart file on the way"
    bench.check_bits(1, 2)


def controller(bench: Bench) -> None:
    """The controller of Slurm is killed, and started again when the tests have ended"""
    job = bench.submit(1)
    bench.wait_for_travel(1)
    bench.cluster.stop_controller(job)
    bench.say("slurmctld is killed")
    said = bench.shearbox("status", str(bench.out))
    assert "the batch system does not answer" in said and "seed_1: ?" in said and "100 kPa at" in said
    wait_for(lambda: "shear 100 kPa: done" in bench.log(1))
    bench.cluster.start_controller()
    bench.say("slurmctld is started")
    bench.wait_for_end(job)
    wait_for((bench.out / "report.html").exists)
    bench.say("report.html is there")
    bench.check_bits(1)


# and how long a test has to take (s), so that there is time for them
FAULTS: dict[Callable[[Bench], None], int] = {
    limit_requeue_failure: 45,
    drained: 6,
    down: 40,
    cancelled: 40,
    controller: 25,
}
