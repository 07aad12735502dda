# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox` as a program, on an engine that only pretends."""

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

TESTS = Path(__file__).resolve().parent
SHEARBOX = TESTS.parents[1] / "tools" / "shearbox"
UNDRAWN = TESTS / "undrawn.py"
MODEL = "TypeA_10x5_4-8_1-circle_350"
# the report takes longer than all else here, and has tests of its own
WITHOUT_REPORT = f"""
import sys, types
sys.path.insert(0, {str(SHEARBOX.parent)!r})
sys.modules["shearbox_tools.reports.report_on"] = types.SimpleNamespace(report_on=lambda folder, each: folder / "report.html")
from shearbox_tools.commands.cli import main
sys.exit(main())
"""


def command(folder: Path, *options: str, model: str = MODEL, program: Path = UNDRAWN) -> list[str]:
    return [str(program), "run", model, "--out", str(folder), "--engine", str(TESTS / "fake_engine.py"), *options]


def shearbox(
    folder: Path, *options: str, model: str = MODEL, program: Path = UNDRAWN, **environment: str
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command(folder, *options, model=model, program=program),
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=120,
    )


def start(*words: str, **environment: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", WITHOUT_REPORT, "run", *words, "--engine", str(TESTS / "fake_engine.py")],
        env={**os.environ, **environment},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def finish(run: subprocess.Popen[str]) -> subprocess.CompletedProcess[str]:
    told, complaints = run.communicate(timeout=120)
    return subprocess.CompletedProcess(run.args, run.returncode, told, complaints)


def go_on(folder: Path, *options: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """As it was asked for."""
    return finish(start(str(folder), *options, **environment))


def events(diary: Path) -> list[list[str]]:
    """Event, phase, folder, and restart file of every engine."""
    return [line.split() for line in diary.read_text(encoding="utf-8").splitlines()]


def wait_for(condition: Callable[[], object], seconds: float = 30) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.05)
