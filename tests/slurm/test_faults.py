# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox submit`, `status` and `cancel` with a real Slurm that has no accounting database, and an engine that only
pretends: what happens when things go wrong."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from bench import ROOT, Bench
from cluster import Cluster, NotThere
from faults import FAULTS

ENGINE = ["--engine", str(ROOT / "tests" / "tools" / "fake_engine.py")]


@pytest.fixture(name="cluster", scope="session")
def _cluster() -> Iterator[Cluster]:
    try:
        cluster = Cluster()
    except NotThere as why:
        pytest.skip(f"Slurm: {why}")
    yield cluster
    cluster.stop()


@contextmanager
def told(bench: Bench) -> Iterator[Bench]:
    """Whatever comes of it, its diary is printed, and no job is left."""
    try:
        yield bench
    finally:
        print("\n".join(bench.diary))
        bench.cluster.clear()


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.__name__)
def test_no_work_is_lost(fault: Callable[[Bench], None], cluster: Cluster, tmp_path: Path) -> None:
    with told(Bench(cluster, tmp_path, ENGINE, FAKE_SECONDS=str(FAULTS[fault]), FAKE_FAIL="seed_3/packed")) as bench:
        fault(bench)


def test_ranks(cluster: Cluster, tmp_path: Path) -> None:
    """The engine itself, on two ranks, is requeued: the same bits as without Slurm."""
    with told(Bench(cluster, tmp_path, ["--ranks", "2"])) as bench:
        job = bench.submit(1)
        bench.wait_for_travel(1)
        bench.scontrol("requeue", f"{job}_1")
        bench.wait_for_end(job)
        assert "on 2 procs" in (bench.out / "seed_1" / "100" / "shear.log").read_text(encoding="utf-8")
        assert "shear 100 kPa: started at 0." in bench.log(1), "it goes on, from a restart file on the way"
        bench.check_bits(1)
