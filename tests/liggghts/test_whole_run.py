# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox run --host liggghts`: from nothing to a report, as with LAMMPS."""

import json
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from host import ROOT
from same_grains import Columns, shear_table

SHEARBOX = ROOT / "tools" / "shearbox"
MODEL = "TypeA_10x5_4-8_1-circle_350"
SIDES = ("--set", "sides=discs")


def command(out: Path, *options: str) -> list[str]:
    return [str(SHEARBOX), "run", MODEL, "--out", str(out), "--host", "liggghts", "--accuracy", "fast", *options]


def shearbox(out: Path, *options: str) -> str:
    done = subprocess.run(command(out, *SIDES, *options), capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def table(out: Path, sigma: int) -> Columns:
    return shear_table(out / str(sigma))


@pytest.fixture(scope="module", name="done")
def _done(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("host") / "of blanks"
    shearbox(out, "--stress", "100", "200")
    return out


def test_from_nothing_to_a_report(done: Path) -> None:
    summary = json.loads((done / "summary.json").read_text())
    assert summary["complete"] and summary["problems"] == []
    assert summary["versions"]["liggghts"].startswith("3.8") and "lammps" not in summary["versions"]
    assert "100, 200 kPa: liggghts writes no frames, so there is no picture" in summary["notes"]
    assert (done / "report.html").stat().st_size > 100_000


@pytest.mark.parametrize("sigma", [100, 200])
def test_the_test_is_that_of_the_decks(done: Path, sigma: int) -> None:
    """The lid feels what it applies, the half has gone 8 mm, and shear stress is between those of loose discs and of a wall."""
    curve = table(done, sigma)
    assert len(curve["step"]) == 800 and curve["displacement_mm"][-1] == pytest.approx(8, abs=0.02)
    assert curve["sigma_kPa"].mean() == pytest.approx(sigma, rel=0.01)
    assert 0.2 * sigma < curve["tau_kPa"][100:].mean() < sigma


def test_run_by_hand_it_has_the_same_report(done: Path, tmp_path: Path) -> None:
    """Without the record, and with the names that LIGGGHTS gives its logs, which are those of the last deck."""
    run = json.loads((done / "summary.json").read_text())
    place = tmp_path / "by_hand"
    place.mkdir()
    for name, path in {
        "packed.csv": "packed/packed.csv",
        "shear.dat": "100/shear.dat",
        "log.liggghts": "100/shear.log",
    }.items():
        shutil.copy(done / path, place / name)
    told = subprocess.run([str(SHEARBOX), "report", str(place)], capture_output=True, text=True, timeout=60)
    assert told.returncode == 0, told.stderr
    summary = json.loads((place / "summary.json").read_text())
    for name in ("model", "law", "speed_mm_s", "travel_mm", "packing"):
        assert summary[name] == run[name], name
    assert summary["stresses"][0]["tau_peak_kPa"] == run["stresses"][0]["tau_peak_kPa"]


def test_what_is_done_is_not_done_again(done: Path) -> None:
    before = {path: path.stat().st_mtime_ns for path in done.rglob("*.dat")}
    again = subprocess.run([str(SHEARBOX), "run", str(done)], capture_output=True, text=True, timeout=120)
    assert again.returncode == 0 and "started" not in again.stdout, again.stdout + again.stderr
    assert {path: path.stat().st_mtime_ns for path in done.rglob("*.dat")} == before


def test_another_host_is_another_run(done: Path) -> None:
    words = [str(SHEARBOX), "run", MODEL, "--out", str(done), "--accuracy", "fast", *SIDES, "--stress", "100"]
    refused = subprocess.run(words, capture_output=True, text=True, timeout=60)
    assert refused.returncode == 2 and "host: liggghts there, - asked for" in refused.stderr


def test_killed_in_shear_it_begins_that_anew(tmp_path: Path, done: Path) -> None:
    """With the same curve; there are no restart files on the way."""
    out = tmp_path / "run"
    process = subprocess.Popen(
        command(out, *SIDES, "--stress", "100"), stdout=subprocess.DEVNULL, start_new_session=True
    )
    until = time.monotonic() + 120
    while not (out / "100" / "shear.dat").exists() or (out / "100" / "shear.dat").stat().st_size < 10_000:
        assert time.monotonic() < until and process.poll() is None
        time.sleep(0.02)
    process.send_signal(signal.SIGTERM)
    assert process.wait(60) != 0
    assert len((out / "100" / "shear.dat").read_text().splitlines()) < 800
    told = shearbox(out, "--stress", "100")
    assert "shear 100 kPa: started" in told and "consolidate" not in told
    one, other = table(done, 100), table(out, 100)
    for name in one:
        np.testing.assert_array_equal(one[name], other[name])


def test_two_ranks(tmp_path: Path) -> None:
    shearbox(tmp_path / "run", "--stress", "100", "--ranks", "2")
    assert "2 by 1 by 1 MPI processor grid" in (tmp_path / "run" / "100" / "shear.log").read_text()
    assert table(tmp_path / "run", 100)["sigma_kPa"].mean() == pytest.approx(100, rel=0.01)


def test_a_packing_that_is_too_long_says_how_far_it_is(tmp_path: Path) -> None:
    words = command(tmp_path / "run", *SIDES, "longest=1000", "--stress", "100")
    failed = subprocess.run(words, capture_output=True, text=True, timeout=300)
    assert failed.returncode != 0
    assert "the grains do not bear the lid after 1000 steps of compaction: it feels" in failed.stderr


def test_without_liggghts(tmp_path: Path) -> None:
    """What is missing, before anything is written."""
    path = {"PATH": f"{tmp_path}:/nowhere"}
    (tmp_path / "python3").symlink_to("/usr/bin/python3")
    words = ["/usr/bin/python3", *command(tmp_path / "run", *SIDES)]
    refused = subprocess.run(words, capture_output=True, text=True, timeout=60, env=os.environ | path)
    assert refused.returncode == 2 and "Debian's package liggghts" in refused.stderr, refused.stderr
    assert not (tmp_path / "run").exists()
