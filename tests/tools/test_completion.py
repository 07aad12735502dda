# SPDX-License-Identifier: GPL-2.0-or-later
"""What the command line offers a shell, asked as bash asks it."""

import importlib.util
import os
import subprocess
from pathlib import Path

import pytest

SHEARBOX = Path(__file__).resolve().parents[2] / "tools" / "shearbox"
pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("argcomplete") is None,
    reason="no argcomplete: tools/setup --ci installs python3-argcomplete",
)


def offered(line: str, folder: Path) -> list[str]:
    """Completions of a line that ends where the cursor is, in this folder; the answer comes through file descriptor 8."""
    answer = folder / ".answer"
    asked = {"_ARGCOMPLETE": "1", "COMP_LINE": line, "COMP_POINT": str(len(line)), "_ARGCOMPLETE_IFS": "\n"}
    command = f'exec 8>"{answer}" 9>/dev/null; exec "{SHEARBOX}"'
    subprocess.run(["bash", "-c", command], env=os.environ | asked, cwd=folder, check=True, timeout=60)
    return [word.strip() for word in answer.read_text().split("\n") if word.strip()]


def test_commands_options_and_values(tmp_path: Path) -> None:
    assert {"run", "report", "compare", "film", "submit"} <= set(offered("shearbox ", tmp_path))
    assert offered("shearbox run --acc", tmp_path) == ["--accuracy"]
    assert offered("shearbox film x --format ", tmp_path)[-3:] == ["mp4", "webm", "gif"]


def test_models_and_folders(tmp_path: Path) -> None:
    (tmp_path / "TypeA_mine").mkdir()
    found = offered("shearbox run TypeA_", tmp_path)
    assert "TypeA_mine/" in found and "TypeA_10x5_T-2_1-circle_2500" in found
    assert all(name.startswith("TypeA_") for name in found)
