# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox run` from the command line, with an engine that only pretends: order, interruption, failures, refusals."""

import argparse
import fcntl
import json
import os
import re
import shutil
import signal
import subprocess
import threading
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import pytest
from command import MODEL, SHEARBOX, TESTS, command, shearbox, wait_for
from rich.console import Console
from shearbox_tools.analysis import read_runs
from shearbox_tools.asking.models import INPUT, find_model
from shearbox_tools.asking.named import model_text
from shearbox_tools.asking.request import Request
from shearbox_tools.base.lock import locked
from shearbox_tools.base.presets import DENSITIES, SPEEDS
from shearbox_tools.base.restarts import step_of
from shearbox_tools.commands import cli
from shearbox_tools.running.campaign import Campaign
from shearbox_tools.running.display import Whole, make_display
from shearbox_tools.running.engine import Engine
from shearbox_tools.running.phases import packing
from shearbox_tools.running.run_folders import Run


def summary(folder: Path) -> dict:
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def rows(folder: Path, sigma: int) -> int:
    return len((folder / str(sigma) / "curve.csv").read_text(encoding="utf-8").splitlines()) - 1


@pytest.fixture(name="folder")
def _folder(tmp_path: Path) -> Path:
    return tmp_path / "results"


def test_all_stresses_from_nothing_to_the_report(folder: Path, tmp_path: Path) -> None:
    diary = tmp_path / "diary"
    done = shearbox(folder, program=SHEARBOX, FAKE_DIARY=str(diary), FAKE_SECONDS="1")
    assert done.returncode == 0, done.stderr
    assert "400 kPa: done in" in done.stdout
    assert (folder / "report.html").stat().st_size > 100_000
    result = summary(folder)
    assert result["complete"]
    assert result["phi_deg"] == pytest.approx(26.6, abs=1.5)
    assert result["criteria"]["proportional"]["holds"]
    assert [stress["sigma_kPa"] for stress in result["stresses"]] == [100, 200, 300, 400]
    assert all(stress["grains_lost"] == 0 for stress in result["stresses"])
    assert rows(folder, 300) == 800

    events = diary.read_text(encoding="utf-8").split("\n")
    assert events[:2] == ["start pack packed", "end pack packed"], "packed once, before all else"
    at_once = most = 0
    for event in events:
        at_once += event.startswith("start") - event.startswith("end")
        most = max(most, at_once)
    assert most == 2

    before = diary.stat().st_size
    assert shearbox(folder, FAKE_DIARY=str(diary)).returncode == 0
    assert diary.stat().st_size == before, "nothing is left to do"


def test_another_stress_may_follow(folder: Path) -> None:
    assert shearbox(folder, "--stress", "100").returncode == 0
    assert summary(folder)["phi_deg"] is None
    assert shearbox(folder, "--stress", "250").returncode == 0
    assert [stress["sigma_kPa"] for stress in summary(folder)["stresses"]] == [100, 250]
    assert summary(folder)["phi_deg"] is not None


@pytest.mark.parametrize("sign, status", [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)])
def test_stopped_and_taken_up_again(folder: Path, tmp_path: Path, sign: signal.Signals, status: int) -> None:
    options = ("--stress", "100", "200", "300")
    engine = subprocess.Popen(
        command(folder, *options), env={**os.environ, "FAKE_SECONDS": "40"}, stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    wait_for(lambda: all((folder / s / f"shear.restart.{k}").exists() for s in ("100", "200") for k in "ab"))
    engine.send_signal(sign)
    _, message = engine.communicate(timeout=15)
    assert engine.returncode == status
    assert "To go on:" in message and str(folder) in message
    with (folder / ".lock").open("r+") as lock:  # the engines have ended: nobody holds the lock
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    assert (folder / "timings.json").exists()

    before = (folder / "100" / "shear.dat").read_text(encoding="utf-8").splitlines()
    diary = tmp_path / "diary"
    done = shearbox(folder, *options, FAKE_DIARY=str(diary))
    assert done.returncode == 0, done.stderr
    assert "pack: started" not in done.stdout and "of no use" not in done.stdout
    begun = re.findall("start shear 100 ([ab])", diary.read_text(encoding="utf-8"))
    assert len(begun) == 1, "it went on from one of the restart files"
    assert (folder / "100" / "shear.dat").read_text(encoding="utf-8").splitlines()[: len(before)] == before
    assert summary(folder)["complete"]
    assert rows(folder, 100) == rows(folder, 300) == 800


def test_under_nohup_a_hang_up_stops_nothing(folder: Path) -> None:
    """Which is all that nohup does; other signals stop it as ever."""
    engine = subprocess.Popen(
        ["nohup", *command(folder, "--stress", "100")], env={**os.environ, "FAKE_SECONDS": "40"},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    wait_for(lambda: (folder / "100" / "shear.restart.a").exists())
    reached = step_of(folder / "100" / "shear.restart.a")
    engine.send_signal(signal.SIGHUP)
    wait_for(lambda: engine.poll() is not None or step_of(folder / "100" / "shear.restart.a") != reached)
    assert engine.poll() is None
    engine.send_signal(signal.SIGTERM)
    engine.communicate(timeout=15)
    assert engine.returncode == 143


def test_processes_that_read_runs_ignore_what_was_ignored_before_them() -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with ProcessPoolExecutor(1, initializer=read_runs._end_at_once) as pool:
            heard = [pool.submit(signal.getsignal, sign).result() for sign in (signal.SIGHUP, signal.SIGTERM)]
    finally:
        signal.signal(signal.SIGHUP, before)
    assert heard == [signal.SIG_IGN, signal.SIG_DFL]


def test_asked_to_end_it_goes_on_from_the_row_that_it_has_reached(folder: Path, tmp_path: Path) -> None:
    """As a batch system asks before a job's limit; a stress that has not begun does not begin."""
    options = ("--stress", "100", "200", "300")
    engine = subprocess.Popen(
        command(folder, *options), env={**os.environ, "FAKE_SECONDS": "40"}, stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    wait_for(lambda: all((folder / s / f"shear.restart.{k}").exists() for s in ("100", "200") for k in "ab"))
    engine.send_signal(signal.SIGUSR1)
    said, message = engine.communicate(timeout=15)
    assert engine.returncode == 128 + signal.SIGUSR1
    assert "To go on:" in message and said.count("as asked") == 2 and "300 kPa" not in said
    reached = {s: step_of(folder / s / "shear.restart.c") for s in ("100", "200")}
    before = {s: (folder / s / "shear.dat").read_text(encoding="utf-8").splitlines() for s in reached}
    for s, lines in before.items():
        assert int(lines[-1].split()[0]) == reached[s], "its last row is that of the restart file"
    diary = tmp_path / "diary"
    done = shearbox(folder, *options, FAKE_DIARY=str(diary))
    assert done.returncode == 0, done.stderr
    assert re.findall("start shear [12]00 ([abc])", diary.read_text(encoding="utf-8")) == ["c", "c"]
    for s, lines in before.items():
        assert (folder / s / "shear.dat").read_text(encoding="utf-8").splitlines()[: len(lines)] == lines
        assert not list((folder / s).glob("shear.restart.*"))
    assert summary(folder)["complete"]


def test_asked_to_end_while_it_packs(folder: Path, tmp_path: Path) -> None:
    slow = tmp_path / "slow"
    slow.write_text("#!/bin/sh\nexec sleep 60\n", encoding="utf-8")
    slow.chmod(0o755)
    engine = subprocess.Popen([*command(folder), "--engine", str(slow)], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    wait_for(lambda: (folder / "packed" / "pack.out").exists())
    engine.send_signal(signal.SIGUSR1)
    engine.communicate(timeout=15)
    assert engine.returncode == 128 + signal.SIGUSR1
    assert shearbox(folder, "--stress", "100").returncode == 0


@pytest.mark.parametrize("listens", [False, True])
def test_ranks_are_asked_to_end_once_they_listen(folder: Path, tmp_path: Path, listens: bool) -> None:
    """Before that an mpirun loses the signal, or waits for ever for ranks that it has ended; they have nothing to lose yet."""
    (tmp_path / "mpirun").write_text(
        "#!/bin/sh\nshift 2\n" + ('exec "$@"\n' if listens else "trap '' USR1\nexec sleep 60\n"), encoding="utf-8"
    )
    (tmp_path / "mpirun").chmod(0o755)
    engine = subprocess.Popen(
        command(folder, "--stress", "100", "--ranks", "2"), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "FAKE_SECONDS": "40"},
    )  # fmt: skip
    wait_for((folder / "100" / "shear.restart.a" if listens else folder / "packed" / "pack.out").exists)
    engine.send_signal(signal.SIGUSR1)
    engine.communicate(timeout=30)
    assert engine.returncode == 128 + signal.SIGUSR1
    assert (folder / "100" / "shear.restart.c").exists() == listens


def test_what_has_not_heard_is_asked_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An engine that hears the second signal only."""
    monkeypatch.setattr("shearbox_tools.running.campaign.SECONDS_TO_ASK_AGAIN", 0.5)
    deaf, begun = tmp_path / "deaf", tmp_path / "begun"
    deaf.write_text(
        "#!/bin/bash\ntrap 'trap \"exit 0\" USR1' USR1\n" + f"touch {begun}\nwhile true; do sleep 0.1; done\n",
        encoding="utf-8",
    )
    deaf.chmod(0o755)
    one = Run(tmp_path / "results", Request(find_model(MODEL), (100.0,)))
    console = Console(quiet=True)
    with locked(one.folder) as lock:
        campaign = Campaign([one], Engine(deaf), make_display(console, Whole({}, {})), {one.folder: lock})

        def ask() -> None:
            wait_for(begun.exists)
            campaign.end()

        asking = threading.Thread(target=ask)
        asking.start()
        assert campaign.run(1) == [] and campaign.stopped
        asking.join()


@pytest.mark.parametrize("deck", ["checkpoints.in", "shear.in"])
def test_a_log_shows_where_a_deck_begins_to_listen(folder: Path, deck: str) -> None:
    """LAMMPS's log has the lines of the decks, comments too."""
    phase = packing(folder, Request(find_model(MODEL), (100.0,)))
    phase.folder.mkdir(parents=True)
    assert not phase.listens
    for line in (INPUT / deck).read_text(encoding="utf-8").splitlines(keepends=True):
        with phase.log.open("a", encoding="utf-8") as log:
            log.write(line)
        if line.startswith("compute") and "cdem/signal" in line:
            break
        assert not phase.listens
    assert phase.listens


def test_a_failed_stress_does_not_cost_the_others(folder: Path) -> None:
    failed = shearbox(folder, FAKE_FAIL="200")
    assert failed.returncode == 1
    assert "shear 200 kPa failed: ERROR: Lost atoms: original 350 current 349" in failed.stderr
    assert f"log: {folder / '200' / 'shear.log'}" in failed.stderr
    assert not summary(folder)["complete"]
    assert "200 kPa: sheared to 4.00 mm only" in summary(folder)["notes"]
    assert [stress["complete"] for stress in summary(folder)["stresses"]] == [True, False, True, True]

    assert shearbox(folder).returncode == 0
    assert summary(folder)["complete"]
    assert (folder / "200" / "shear.log.1").exists(), "the log of the failure is kept"


def test_what_failed_is_said_although_the_report_fails_too(folder: Path) -> None:
    """And that the same command goes on is not said: it would fail in the same way."""
    assert shearbox(folder, "--stress", "100").returncode == 0
    (folder / "report.html.draft").mkdir()
    failed = shearbox(folder, FAKE_FAIL="200")
    assert "shear 200 kPa failed: ERROR: Lost atoms" in failed.stderr
    assert "report.html: Is a directory" in failed.stderr
    assert "The other results are kept" in failed.stderr and "goes on" not in failed.stderr


def test_a_table_that_is_gone_is_made_again(folder: Path) -> None:
    """All else of the same run stays."""
    assert shearbox(folder, "--stress", "100", "200").returncode == 0
    kept = {path: path.read_bytes() for path in (folder / "200").iterdir()}
    table = (folder / "100" / "shear.dat").read_bytes()
    (folder / "100" / "shear.dat").unlink()
    (folder / "packed" / "packed.restart").unlink()
    again = shearbox(folder, "--stress", "100", "200")
    assert again.returncode == 0, again.stderr
    assert [line for line in again.stdout.splitlines() if "started" in line] == ["shear 100 kPa: started"]
    assert (folder / "100" / "shear.dat").read_bytes() == table
    assert {path: path.read_bytes() for path in (folder / "200").iterdir()} == kept


def test_a_failed_packing_ends_the_run(folder: Path) -> None:
    failed = shearbox(folder, FAKE_FAIL="packed")
    assert failed.returncode == 1
    assert "pack failed: ERROR: Lost atoms" in failed.stderr
    assert not (folder / "100").exists()


@pytest.mark.parametrize("seeds", [[], ["--seeds", "2"]])
def test_a_run_that_failed_at_once_is_begun_anew(folder: Path, seeds: list[str]) -> None:
    """Its time step, say, was refused by the engine: nobody wants to go on with it, nor with its stresses."""
    assert shearbox(folder, "--engine", "/bin/false", "--dt", "1e-5", "--stress", "200", *seeds).returncode == 1
    done = shearbox(folder, "--stress", "100", *seeds)
    assert done.returncode == 0, done.stderr
    record = json.loads((folder / ("seed_2" if seeds else "") / "run.json").read_text(encoding="utf-8"))
    assert record["identity"]["dt"] == "auto" and record["stresses"] == [100]
    assert "holds another run" in shearbox(folder, "--stress", "100", "--dt", "1e-7", *seeds).stderr


@pytest.mark.parametrize("left", ["run.json", "packed/packed.restart.a"])
def test_a_run_that_may_be_gone_on_with_is_not_begun_anew(folder: Path, left: str) -> None:
    """One without a log may be yet to start, as in a job that waits; and a restart file is a result."""
    assert shearbox(folder, "--engine", "/bin/false", "--dt", "1e-5").returncode == 1
    if left == "run.json":
        shutil.rmtree(folder / "packed")
    else:
        (folder / left).write_text("state", encoding="utf-8")
    refused = shearbox(folder, "--stress", "100")
    assert refused.returncode == 2 and "holds another run" in refused.stderr
    assert ("It has no results: remove the folder" in refused.stderr) == (left == "run.json")


def test_a_specimen_that_failed_and_is_not_asked_for_again_is_told(folder: Path) -> None:
    assert shearbox(folder, "--engine", "/bin/false", "--dt", "1e-5", "--seeds", "2").returncode == 1
    refused = shearbox(folder, "--stress", "100", "--seeds", "1")
    assert refused.returncode == 2 and f"{folder / 'seed_2'} holds another run" in refused.stderr


def test_a_step_that_the_engine_refuses_has_the_words_of_the_tools(folder: Path, tmp_path: Path) -> None:
    engine = tmp_path / "engine"
    engine.write_text(
        "#!/bin/sh\necho \"ERROR: take 'dt auto', or 'dt any' to run nevertheless\"\nexit 1\n", encoding="utf-8"
    )
    engine.chmod(0o755)
    failed = shearbox(folder, "--engine", str(engine))
    assert "With shearbox: a smaller --dt, or --dt auto\n  log: " in failed.stderr


def test_an_engine_that_is_killed_is_named(folder: Path, tmp_path: Path) -> None:
    engine = tmp_path / "engine"
    engine.write_text("#!/bin/sh\nkill -9 $$\n", encoding="utf-8")
    engine.chmod(0o755)
    failed = shearbox(folder, "--engine", str(engine))
    assert failed.returncode == 1
    assert "ended by signal 9" in failed.stderr and "The same command goes on" in failed.stderr


def test_ranks_are_started_by_words_that_any_mpirun_knows(folder: Path, tmp_path: Path) -> None:
    """MPICH's and Intel's refuse the options of Open MPI's, as this one does."""
    (tmp_path / "mpirun").write_text('#!/bin/sh\n[ "$1 $2" = "-np 2" ] && shift 2 && exec "$@"\n', encoding="utf-8")
    (tmp_path / "mpirun").chmod(0o755)
    done = shearbox(folder, "--ranks", "2", "--stress", "100", PATH=f"{tmp_path}:{os.environ['PATH']}")
    assert done.returncode == 0, done.stderr


def test_an_engine_that_writes_nothing_is_found_out(folder: Path) -> None:
    failed = shearbox(folder, "--engine", "/bin/true")
    assert failed.returncode == 1
    assert "ended without writing packed.csv" in failed.stderr


def test_an_engine_that_cannot_be_started_is_named(folder: Path, tmp_path: Path) -> None:
    engine = tmp_path / "engine"
    engine.write_text("neither a script nor a program", encoding="utf-8")
    engine.chmod(0o755)
    failed = shearbox(folder, "--engine", str(engine))
    assert failed.returncode == 1
    assert f"Exec format error: '{engine}'" in failed.stderr
    assert "Traceback" not in failed.stderr


def test_two_runs_in_one_folder(folder: Path) -> None:
    first = subprocess.Popen(
        command(folder, "--stress", "100", program=SHEARBOX), env={**os.environ, "FAKE_SECONDS": "8"},
        stdout=subprocess.DEVNULL,
    )  # fmt: skip
    wait_for(lambda: (folder / "100" / "shear.dat").exists())
    second = shearbox(folder, "--stress", "100")
    first.send_signal(signal.SIGINT)
    first.wait(30)
    assert second.returncode == 1
    assert re.search(rf"is in use by another run: process .*\b{first.pid} \(shearbox\)", second.stderr)


@pytest.mark.parametrize(
    "options, speed",
    [
        ([], 2),
        (["--accuracy", "reference"], 2),
        (["--accuracy", "fast"], SPEEDS["fast"]),
        (["--speed", "7"], 7),
    ],
)
def test_accuracy_sets_the_speed_that_is_not_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, options: list[str], speed: float
) -> None:
    given: list[dict] = []
    monkeypatch.setattr("shearbox_tools.commands.run.run", lambda options, asked: given.extend(asked))
    assert cli.main(["run", MODEL, "--out", str(tmp_path), *options]) == 0
    assert given[0].get("speed", Request.speed) == speed


def test_accuracy_and_stiffness_reach_the_decks(folder: Path) -> None:
    options = ("--stress", "100", "--stiffness", "0.5")
    assert shearbox(folder, "--accuracy", "fast", *options).returncode == 0
    assert (summary(folder)["speed_mm_s"], summary(folder)["stiffness"]) == (SPEEDS["fast"], 0.5)
    again = shearbox(folder, "--speed", f"{SPEEDS['fast']}", *options)
    assert again.returncode == 0, "the same settings, said otherwise"
    assert "speed_mm_s" in shearbox(folder, *options).stderr


REFUSED = [
    (["--stress", "0"], "--stress 0: a stress above 0 kPa"),
    (["--host", "liggghts"], "--host liggghts: sides is smooth; only sides=discs is possible there"),
    (
        ["--host", "liggghts", "--set", "sides=discs", "phi_packing=45"],
        "phi_packing is 45; only phi_packing=0 is possible",
    ),
    (
        ["--set", "frames=3"],
        "--set frames=3: a number that divides the 800 rows of shear.dat is expected, such as 2 or 4; else",
    ),
    (["--host", "liggghts", "--set", "sides=discs", "frames=5"], "frames is 5; only frames=100 is possible there"),
    (["--stress", "-100"], "--stress -100: a stress above 0 kPa"),
    (["--stress", "nan"], "--stress nan: a stress above 0 kPa"),
    (["--stress", "100000"], "100000 Pa would be 100"),
    (["--stress", "0.1"], "0.1 MPa would be 100"),
    (["--stress", "100", "100"], "named twice"),
    (["--stress", "many"], "'many' is not a number of kPa"),
    (["--stress", "100,200"], "Between stresses are blanks: --stress 100 200"),
    (["--stress", "100", "--stress", "100.0000001"], "named twice"),
    (["--stress", "1234.567"], "at most six digits are expected, such as 1234.57"),
    (["--speed", "2.0000001"], "--speed 2.0000001: at most six digits"),
    (["--speed", "0"], "--speed 0: 0.001 to 1000 mm/s"),
    (["--speed", "-2"], "--speed -2: 0.001 to 1000 mm/s"),
    (["--speed", "0.0002"], "0.0002 m/s would be 0.2"),
    (["--travel", "0"], "--travel 0: 0.1 to 25 mm"),
    (["--travel", "80"], "--travel 80: 0.1 to 25 mm"),
    (["--travel", "0.008"], "0.008 m would be 8"),
    (["--seed", "0"], "--seed 0: 1 to 2147483647, whole is expected"),
    (["--seed", "1.5"], "invalid int value: '1.5'"),
    (["--accuracy", "fast", "--speed", "7"], "argument --speed: not allowed with argument --accuracy"),
    (["--accuracy", "high"], "invalid choice: 'high' (choose from 'reference', 'standard', 'fast')"),
    (["--law", "mixed"], "invalid choice: 'mixed'"),
    (["--dt", "soon"], "--dt soon: auto or 1e-10 to 1e-4 is expected: time step (s)"),
    (["--dt", "1"], "--dt 1: auto or 1e-10 to 1e-4 is expected"),
    (["--dt", "5_0e-8"], "--dt 5_0e-8: auto or"),
    (["--dt", "-1e-6"], "expected one argument"),
    (["--stiffness", "0"], "--stiffness 0: 0.01 to 100 is expected"),
    (["--stiffness", "nan"], "--stiffness nan: 0.01 to 100 is expected"),
    (["--stiffness", "1e8"], "--stiffness 1e+08: 0.01 to 100 is expected"),
    (["--jobs", "0"], "--jobs 0: 1 to 256"),
    (["--ranks", "-1"], "--ranks -1: 1 to 256"),
    (["--engine", "/nowhere/lmp"], "the engine /nowhere/lmp is not there"),
    (["--out", "/proc/nothing"], "--out /proc/nothing:"),
    (["--unknown"], "unrecognized arguments: --unknown"),
    (["--set", "travel=9"], "--set travel=9: the option for this is --travel"),
]


@pytest.mark.parametrize("options, message", REFUSED, ids=[" ".join(options) for options, _ in REFUSED])
def test_bad_options_are_refused_before_anything_starts(folder: Path, options: list[str], message: str) -> None:
    refused = shearbox(folder, *options)
    assert refused.returncode == 2, refused.stdout
    assert message.replace("'", "") in refused.stderr.replace("'", "")  # argparse of Python 3.13 quotes less
    assert "usage:" not in refused.stderr
    assert "Traceback" not in refused.stderr
    assert not folder.exists()


def test_all_problems_are_named_at_once(folder: Path) -> None:
    refused = shearbox(folder, "--stress", "-1", "--speed", "0", "--seed", "-3")
    assert all(option in refused.stderr for option in ("--stress", "--speed", "--seed"))


@pytest.mark.parametrize(
    "name, suggestion",
    [
        ("TypeA_10x5_4-8_1-circle-350", "TypeA_10x5_4-8_1-circle_350"),
        ("typeb", "TypeB_15x5_4-8_1-circle_550"),
        ("sand", "'shearbox models' lists them"),
        ("TypeA_10x5_4-8_2-circle_350", "DISCS of a grain, 1 or 3"),
    ],
)
def test_an_unknown_model_gets_suggestions(folder: Path, name: str, suggestion: str) -> None:
    refused = shearbox(folder, model=name)
    assert refused.returncode == 2
    assert f"unknown model '{name}'" in refused.stderr
    assert suggestion in refused.stderr


def test_a_model_made_of_its_name(folder: Path, tmp_path: Path) -> None:
    """Its file is in the folder of the run, which may be moved, and goes on there."""
    name = "TypeC_12.5x5_4-8_1-circle_auto"
    assert shearbox(folder, "--stress", "100", "--density", "loose", model=name).returncode == 0
    assert (folder / f"{name}.in").read_text(encoding="utf-8") == model_text(name, DENSITIES["loose"])
    assert summary(folder)["parameters"]["phi_packing"] == "45"
    assert summary(folder)["model"] == name
    moved = folder.rename(tmp_path / "moved")
    further = [
        str(SHEARBOX),
        "run",
        str(moved),
        "--stress",
        "200",
        "--dry-run",
        "--engine",
        str(TESTS / "fake_engine.py"),
    ]
    assert subprocess.run(further, capture_output=True, timeout=120).returncode == 0
    other = shearbox(moved, "--stress", "100", model=name)
    assert other.returncode == 2 and "model ngrains" in other.stderr and "phi_packing" in other.stderr


def test_density_is_given_once(folder: Path) -> None:
    refused = shearbox(folder, "--density", "loose", "--set", "phi_packing=3")
    assert refused.returncode == 2 and "--density: --set phi_packing is given, too" in refused.stderr


def test_a_model_file_of_ones_own(folder: Path, tmp_path: Path) -> None:
    path = tmp_path / "pebbles.in"
    text = (SHEARBOX.parents[1] / "input" / "models" / f"{MODEL}.in").read_text(encoding="utf-8")
    text = text.replace("index 350", "index 250")
    path.write_text(text.replace("index single", 'index "discs 2 0 0 1 1 0 1"'), encoding="utf-8")
    assert shearbox(folder, "--stress", "100", model=str(path)).returncode == 0
    assert summary(folder)["model"] == "pebbles"
    assert summary(folder)["parameters"]["model shape"] == "discs 2 0 0 1 1 0 1"
    assert "inner width of the box" in (folder / "report.html").read_text(encoding="utf-8")
    path.write_text(text, encoding="utf-8")
    changed = shearbox(folder, "--stress", "100", model=str(path))
    assert changed.returncode == 2
    assert "model shape: discs 2 0 0 1 1 0 1 there, single asked for" in changed.stderr
    gone = shearbox(folder, model=str(tmp_path / "none.in"))
    assert gone.returncode == 2 and "none.in: No such file" in gone.stderr


@pytest.fixture(name="used", scope="module")
def _used(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("used") / "results"
    assert shearbox(folder, "--stress", "100").returncode == 0
    return folder


@pytest.mark.parametrize(
    "options, model, difference",
    [
        (["--speed", "3"], MODEL, "speed_mm_s: 2.0 there, 3.0 asked for"),
        (["--travel", "7"], MODEL, "travel_mm: 8.0 there, 7.0 asked for"),
        (["--seed", "2"], MODEL, "seed: 1 there, 2 asked for"),
        (["--law", "incremental"], MODEL, "law: direct there, incremental asked for"),
        (["--dt", "1e-7"], MODEL, "dt: auto there, 1e-07 asked for"),
        (["--stiffness", "0.1"], MODEL, "stiffness: 1.0 there, 0.1 asked for"),
        ([], "TypeB_15x5_4-8_1-circle_550", f"model: {MODEL} there, TypeB_15x5_4-8_1-circle_550 asked for"),
    ],
)
def test_a_folder_of_another_request_is_refused(used: Path, options: list[str], model: str, difference: str) -> None:
    before = {path: path.stat().st_mtime_ns for path in used.rglob("*")}
    refused = shearbox(used, "--stress", "100", *options, model=model)
    assert refused.returncode == 2
    assert f"{used} holds another run" in refused.stderr
    assert difference in refused.stderr
    assert refused.stderr.count(" asked for") == (1 if options else 3), "only what differs"
    assert {path: path.stat().st_mtime_ns for path in used.rglob("*")} == before


@pytest.mark.parametrize("asked", ["as before", "as it was asked for"])
def test_what_was_packed_by_other_decks_does_not_go_on(used: Path, tmp_path: Path, asked: str) -> None:
    """Their parameters.in did not have the friction of packing, which was done in another way."""
    folder = tmp_path / "older"
    shutil.copytree(used, folder)
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    del record["identity"]["parameters"]["phi_packing"]
    (folder / "run.json").write_text(json.dumps(record), encoding="utf-8")
    words = [SHEARBOX, "run", *([MODEL, "--out", folder] if asked == "as before" else [folder]), "--stress", "200"]
    refused = subprocess.run([*map(str, words), "--dry-run"], capture_output=True, text=True, timeout=120)
    assert refused.returncode == 2
    assert "phi_packing: - there, 0 asked for" in refused.stderr
    assert "Another version began it" in refused.stderr


def test_a_folder_of_something_else_is_refused(folder: Path) -> None:
    folder.mkdir()
    (folder / "letter.txt").write_text("dear", encoding="utf-8")
    refused = shearbox(folder)
    assert refused.returncode == 2
    assert "holds something else than a run" in refused.stderr
    assert [path.name for path in folder.iterdir()] == ["letter.txt"]


def test_a_file_is_not_a_folder(folder: Path) -> None:
    folder.write_text("", encoding="utf-8")
    refused = shearbox(folder)
    assert refused.returncode == 2
    assert "this is a file" in refused.stderr


@pytest.mark.parametrize(
    "text, message", [("{", "run.json, line 1"), ("[]", "not the record of a run"), ("", "line 1. .*another folder")]
)
def test_a_damaged_record_is_named(folder: Path, text: str, message: str) -> None:
    folder.mkdir()
    (folder / "run.json").write_text(text, encoding="utf-8")
    refused = shearbox(folder)
    assert refused.returncode == 1
    assert re.search(message, refused.stderr)
    assert (folder / "run.json").read_text(encoding="utf-8") == text


def test_help_of_every_command() -> None:
    commands: list[list[str]] = [[], ["models"], ["run"], ["report"]]
    for words in commands:
        done = subprocess.run([str(SHEARBOX), *words, "--help"], capture_output=True, text=True, timeout=30)
        assert done.returncode == 0
        assert done.stdout.startswith("usage: shearbox")


def test_help_is_as_it_is_meant() -> None:
    """A percent sign is written twice in the help of an option, and once in a description."""
    for parser in subcommands().values():
        assert "%%" not in parser.format_help()


def subcommands() -> dict[str, argparse.ArgumentParser]:
    (commands,) = [action.choices for action in cli.make_parser()._actions if isinstance(action.choices, dict)]
    return commands
