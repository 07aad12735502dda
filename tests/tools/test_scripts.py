# SPDX-License-Identifier: GPL-2.0-or-later
"""The scripts of the repository, started as a stranger would: through links, in other locales, in another user's clone."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = [
    "tools/quickstart",
    "tools/setup",
    "tools/test",
    ".ci/checks",
    ".ci/run",
    "tests/sanitize",
    "tests/unit/arm64",
]


@pytest.mark.parametrize("script", SCRIPTS)
def test_through_a_link(tmp_path: Path, script: str) -> None:
    """Up to where it goes to the root of the repository: what follows is replaced by a look at where it is."""
    copy = tmp_path / "repository" / script
    copy.parent.mkdir(parents=True)
    begin, change, rest = (ROOT / script).read_text(encoding="utf-8").partition('\ncd "')
    where = change + rest.partition("\n")[0]
    copy.write_text(f"{begin}\n{where.strip()}\npwd\n", encoding="utf-8")
    copy.chmod(0o755)
    (tmp_path / "first").symlink_to(copy)
    (tmp_path / "second").symlink_to("first")
    for link in (copy, tmp_path / "first", tmp_path / "second"):
        said = subprocess.run([link], cwd="/", capture_output=True, text=True, timeout=30)
        assert said.stdout.splitlines() == [str(tmp_path / "repository")], said.stderr


@pytest.mark.parametrize("encoding", ["latin-1", "ascii"])
def test_a_terminal_without_all_letters(encoding: str) -> None:
    for words in (["models"], ["parameters"], ["run", "nö\udcff", "--out", "ö"]):
        said = subprocess.run(
            [ROOT / "tools" / "shearbox", *words], env={**os.environ, "PYTHONIOENCODING": encoding},
            capture_output=True, timeout=60,
        )  # fmt: skip
        assert b"Traceback" not in said.stderr
        assert said.returncode == (2 if words[0] == "run" else 0)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a clone to another user")
def test_version_in_a_clone_of_another_user(tmp_path: Path) -> None:
    clone = tmp_path / "clone"
    git = ["git", "-C", str(clone), "-c", "user.name=a", "-c", "user.email=a"]
    subprocess.run(["git", "init", "-q", clone], check=True)
    subprocess.run([*git, "commit", "-q", "--allow-empty", "-m", "first"], check=True)
    for path in (clone, *clone.rglob("*")):
        shutil.chown(path, 65534)
    words = [
        f"-DSOURCE={clone}",
        f"-DOUTPUT={tmp_path / 'version.h'}",
        "-DVERSION=1",
        "-P",
        str(ROOT / "tools/version.cmake"),
    ]
    subprocess.run(["cmake", *words], check=True, capture_output=True)
    assert "no git" not in (tmp_path / "version.h").read_text(encoding="utf-8")
