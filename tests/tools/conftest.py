# SPDX-License-Identifier: GPL-2.0-or-later
"""Make the package under tools/ importable as `tools/shearbox` does; reports without pictures."""

import os
import signal
import sys
from pathlib import Path

import pytest

# A background job ignores these, or one under nohup; the programs that the tests interrupt would inherit that.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)
signal.signal(signal.SIGQUIT, signal.SIG_DFL)
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as shearbox itself sets it; before anything imports numpy
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
sys.path.insert(0, str(Path(__file__).resolve().parent))
from undrawn import DRAWING  # noqa: E402  it needs the path of the tests


@pytest.fixture(name="undrawn")
def _undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is written about runs, without their pictures."""
    for name, nothing in DRAWING.items():
        monkeypatch.setattr(f"shearbox_tools.reports.run_report.{name}", nothing)
