# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox run --seeds` with an engine that only pretends: one pool for all specimens, interruption, failures, refusals."""

import fcntl
import json
import re
import signal
import subprocess
from pathlib import Path

import pytest
from command import MODEL, events, finish, go_on, start, wait_for

TWO = ("--seeds", "2", "--stress", "100", "200")


def shearbox(folder: Path, *options: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return finish(start(MODEL, "--out", str(folder), *options, **environment))


@pytest.fixture(name="folder")
def _folder(tmp_path: Path) -> Path:
    return tmp_path / "results"


def identity(folder: Path) -> dict:
    return json.loads((folder / "run.json").read_text(encoding="utf-8"))["identity"]


def test_two_specimens_keep_two_cores_busy(folder: Path, tmp_path: Path) -> None:
    """Packings run side by side, and the stresses of one specimen beside the packing of the next."""
    diary = tmp_path / "diary"
    done = shearbox(folder, "--seeds", "3", "--stress", "100", "200", FAKE_DIARY=str(diary))
    assert done.returncode == 0, done.stderr
    told = [line for line in done.stdout.splitlines() if line.startswith("seed_")]
    assert told[:2] == ["seed_1 pack: started", "seed_2 pack: started"]
    at_once = [0]
    for line in told:
        at_once.append(at_once[-1] + (1 if line.endswith("started") else -1))
    assert max(at_once) == 2
    assert told.index("seed_3 pack: started") > min(told.index(f"seed_{n} shear 100 kPa: started") for n in (1, 2))
    assert [identity(folder / f"seed_{n}")["seed"] for n in (1, 2, 3)] == [1, 2, 3]

    before = diary.stat().st_size
    assert go_on(folder, FAKE_DIARY=str(diary)).returncode == 0
    assert go_on(folder / "seed_2", FAKE_DIARY=str(diary)).returncode == 0, "a run by itself"
    assert diary.stat().st_size == before, "nothing is left to do"


def test_a_seed_and_a_stress_may_follow(folder: Path, tmp_path: Path) -> None:
    diary = tmp_path / "diary"
    assert shearbox(folder, "--seeds", "3", "7", "--stress", "100").returncode == 0
    more = ("--seeds", "3", "5-5", "7", "--stress", "100", "300")
    assert shearbox(folder, *more, FAKE_DIARY=str(diary)).returncode == 0
    sheared = {place for event, phase, place in events(diary) if (event, phase) == ("end", "shear")}
    assert sheared == {"seed_3/300", "seed_5/100", "seed_5/300", "seed_7/300"}


def test_every_stress_may_have_a_packing_of_its_own(folder: Path) -> None:
    assert shearbox(folder, *TWO, "--independent").returncode == 0
    there = {path.parent.name: identity(path.parent)["seed"] for path in folder.glob("*/run.json")}
    assert there == {
        "seed_1_100kPa": 1010000, "seed_1_200kPa": 1020000, "seed_2_100kPa": 2010000, "seed_2_200kPa": 2020000,
    }  # fmt: skip
    assert go_on(folder / "seed_2_100kPa").returncode == 0
    assert "holds seed_1_100kPa, with --independent or without" in shearbox(folder, *TWO).stderr


@pytest.mark.parametrize("sign, how", [(signal.SIGINT, "command"), (signal.SIGKILL, "folder")])
def test_stopped_and_taken_up_again(folder: Path, tmp_path: Path, sign: signal.Signals, how: str) -> None:
    """What comes out is what an undisturbed run leaves."""
    options = (*TWO, "--jobs", "3")
    run = start(MODEL, "--out", str(folder), *options, FAKE_SECONDS="20")
    wait_for(lambda: all((folder / s / "100" / "shear.restart.a").exists() for s in ("seed_1", "seed_2")))
    run.send_signal(sign)
    run.communicate(timeout=15)

    def unlocked() -> bool:
        for lock in folder.glob("**/.lock"):
            with lock.open("r+") as stream:
                try:
                    fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    return False
        return True

    wait_for(unlocked)
    diary = tmp_path / "diary"
    given = [MODEL, "--out", str(folder), *options] if how == "command" else [str(folder)]
    done = finish(start(*given, FAKE_DIARY=str(diary)))
    assert done.returncode == 0, done.stderr
    assert not any(phase == "pack" for _, phase, *_ in events(diary))
    assert any(line[0] == "start" and len(line) == 4 for line in events(diary)), "it went on from a restart file"
    whole = tmp_path / "whole"
    assert shearbox(whole, *options).returncode == 0
    for place in ("seed_1/100", "seed_1/200", "seed_2/100", "seed_2/200"):
        assert (folder / place / "shear.dat").read_bytes() == (whole / place / "shear.dat").read_bytes()


@pytest.mark.parametrize("place, left", [("seed_1/packed", "pack"), ("seed_1/200", "shear 200 kPa")])
def test_a_specimen_that_fails_does_not_cost_the_others(folder: Path, place: str, left: str) -> None:
    failed = shearbox(folder, "--seeds", "3", "--stress", "100", "200", FAKE_FAIL=place)
    assert failed.returncode == 1
    assert f"seed_1 {left} failed: ERROR: Lost atoms" in failed.stderr and str(folder / "seed_1") in failed.stderr
    assert all(
        (folder / seed / sigma / "sheared.restart").exists()
        for seed in ("seed_2", "seed_3")
        for sigma in ("100", "200")
    )
    assert "The other results are kept" in failed.stderr


def test_a_specimen_in_use_is_named(folder: Path) -> None:
    first = start(MODEL, "--out", str(folder / "seed_2"), "--seed", "2", "--stress", "100", FAKE_SECONDS="15")
    wait_for(lambda: (folder / "seed_2" / "100" / "shear.dat").exists())
    refused = shearbox(folder, "--seeds", "2", "--stress", "100")
    first.send_signal(signal.SIGINT)
    finish(first)
    assert refused.returncode == 1
    assert re.search(rf"seed_2 is in use by another run: process .*\b{first.pid} ", refused.stderr)


def test_a_dry_run_tells_of_all(folder: Path) -> None:
    """Eight times the disk of one; and two at a time all of the work takes half of it."""
    told = {n: shearbox(folder, "--dry-run", "--seeds", n).stdout for n in ("1", "8")}
    assert not folder.exists()
    sizes = {n: int(re.findall(r"(\d+) MB of disk", text)[0]) for n, text in told.items()}
    assert sizes["8"] == pytest.approx(8 * sizes["1"], abs=8)
    assert told["8"].count("9 phases") == 8 and told["8"].count("350 grains") == 1


REFUSED = [
    (["--seeds", "1", "2", "1"], "--seeds 1 2 1: a seed is named twice"),
    (["--seeds", "0"], "--seeds 0: 1 to 200 specimens"),
    (["--seeds", "123456789"],
     "--seeds 123456789: 1 to 200 specimens are expected; --seed 123456789 is one specimen with that seed"),
    (["--seeds", "1-1000000000"], "--seeds 1-1000000000: 1 to 200 specimens are expected"),
    (["--seeds", "1-" + 30 * "9"], "9: 1 to 200 specimens are expected"),
    (["--seeds", "0", "1"], "--seed 0: 1 to 2147483647"),
    (["--seeds", "2", "--seed", "1"], "--seeds: --seed is given, too"),
    (["--independent"], "--independent: it is of the specimens of --seeds"),
    (["--seeds", "1", "3000", "--independent"], "with --independent, 1 to 2146 are expected"),
    (["--seeds", "2", "--independent", "--stress", "100", "10.125"], "--stress 10.125: with --independent, at most two"),
    (["--seeds", "2", "--stress", "0"], "--stress 0: a stress above 0 kPa"),
    (["--seeds", "two"], "argument --seeds: 'two': a number, or a range such as 4-8, is expected"),
    (["--seeds", "4-"], "'4-': a number, or a range such as 4-8, is expected"),
    (["--seeds", "8-4"], "--seeds 8-4: 1 to 200 specimens"),
    (["--seeds", "4-6", "5"], "--seeds 4-6 5: a seed is named twice"),
    (["--seeds", "2", "--out", "/proc/nothing"], "--out /proc/nothing"),
]  # fmt: skip


@pytest.mark.parametrize("options, message", REFUSED, ids=[" ".join(options) for options, _ in REFUSED])
def test_what_cannot_be_meant_is_refused_before_anything_starts(folder: Path, options: list[str], message: str) -> None:
    refused = shearbox(folder, *options)
    assert refused.returncode == 2, refused.stdout
    assert message in refused.stderr and "Traceback" not in refused.stderr
    assert not folder.exists()


@pytest.fixture(name="used", scope="module")
def _used(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("used") / "results"
    assert shearbox(folder, "--seeds", "1", "2", "--stress", "100").returncode == 0
    return folder


@pytest.mark.parametrize(
    "options, message",
    [
        (["--seeds", "2", "--speed", "3"], "speed_mm_s: 2.0 there, 3.0 asked for"),
        (["--seeds", "5", "6", "--speed", "3"], "seed_1 holds another run:"),
        (["--seeds", "2", "--set", "phi=30"], "phi: 27 there, 30 asked for"),
        (["--seeds", "2", "--independent"], "holds seed_1, with --independent or without"),
        ([], "holds something else than a run"),
    ],
)
def test_a_folder_of_another_request_is_refused(used: Path, options: list[str], message: str) -> None:
    before = {path: path.stat().st_mtime_ns for path in used.rglob("*")}
    refused = shearbox(used, "--stress", "100", *options)
    assert refused.returncode == 2 and message in refused.stderr, refused.stderr
    assert {path: path.stat().st_mtime_ns for path in used.rglob("*")} == before


def test_a_folder_of_something_else_is_refused(folder: Path, used: Path) -> None:
    folder.mkdir()
    (folder / "letter.txt").write_text("dear", encoding="utf-8")
    assert "holds something else than runs" in shearbox(folder, "--seeds", "2").stderr
    assert "holds a run of one specimen" in shearbox(used / "seed_1", "--seeds", "2").stderr
    assert [path.name for path in folder.iterdir()] == ["letter.txt"]


def test_runs_that_are_there_go_on_as_they_were_asked_for(used: Path) -> None:
    refused = go_on(used, "--stress", "300")
    assert refused.returncode == 2
    assert (
        "holds 2 runs, which go on as they were asked for: leave out --stress" in go_on(used, "--stress", "300").stderr
    )


def test_a_folder_without_runs_is_no_ensemble(folder: Path) -> None:
    folder.mkdir()
    refused = go_on(folder)
    assert refused.returncode == 2 and "holds no run" in refused.stderr
