# SPDX-License-Identifier: GPL-2.0-or-later
"""The version is told once, in shearbox_tools/__init__.py; all that names it says the same."""

import re
import subprocess
from pathlib import Path

import shearbox_tools

ROOT = Path(__file__).resolve().parents[2]


def test_of_the_citation() -> None:
    found = re.findall(r"^version: (.*)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
    assert found == [shearbox_tools.__version__]


def test_of_the_program() -> None:
    started = subprocess.run(
        [ROOT / "build" / "lmp_cdem", "-in", "/dev/null", "-log", "none"], capture_output=True, text=True, timeout=60
    )
    assert re.findall(r"^Shearbox (\S+) \(", started.stdout, re.MULTILINE) == [shearbox_tools.__version__]
