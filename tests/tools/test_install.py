# SPDX-License-Identifier: GPL-2.0-or-later
"""`cmake --install` gives a folder that works without the repository, wherever it is moved to."""

import os
import re
import subprocess
from pathlib import Path

import pytest
import shearbox_tools

ROOT = Path(__file__).resolve().parents[2]
MODEL = "TypeA_10x5_2-4_3-circle_350"
SOON_PACKED = "TypeA_10x5_4-8_1-circle_350"
MODULES = Path("/usr/share/modules/init/bash")
# No more than a new user has: nothing here may point to the repository. Open MPI 5 does not begin without a home.
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
ENVIRONMENT = {"PATH": "/usr/bin:/bin", "HOME": str(Path.home()), **AS_ROOT}


@pytest.fixture(scope="module", name="prefix")
def _prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Installed into one folder, then moved to another."""
    folder = tmp_path_factory.mktemp("install")
    subprocess.run(
        ["cmake", "--install", ROOT / "build", "--prefix", folder / "first"], check=True, capture_output=True
    )
    return (folder / "first").rename(folder / "moved")  # no blank: LAMMPS's include takes none


def start(*command: str | Path, cwd: Path) -> str:
    done = subprocess.run(command, cwd=cwd, env=ENVIRONMENT, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_nothing_names_the_repository(prefix: Path) -> None:
    """Neither texts nor programs do, their search paths for libraries included."""
    files = [path for path in prefix.rglob("*") if path.is_file()]
    assert len(files) > 50
    # As a whole path: a repository at /shearbox is not named by share/shearbox.
    named = re.compile(rb"(?<![\w.~-])" + re.escape(os.fsencode(ROOT)) + rb"(?![\w-])")
    assert [path for path in files if named.search(path.read_bytes())] == []
    assert not any(path.is_symlink() and path.readlink().is_absolute() for path in prefix.rglob("*"))


def test_command_through_a_link(prefix: Path, tmp_path: Path) -> None:
    link = tmp_path / "sb"
    link.symlink_to(prefix / "bin" / "shearbox")
    assert start(link, "--version", cwd=tmp_path) == f"shearbox {shearbox_tools.__version__}\n"
    assert MODEL in start(link, "models", cwd=tmp_path)


def test_a_short_run(prefix: Path, tmp_path: Path) -> None:
    short = ["--accuracy", "fast", "--travel", "0.1", "--stress", "100"]
    said = start(prefix / "bin" / "shearbox", "run", SOON_PACKED, "--out", "results", *short, cwd=tmp_path)
    assert "report.html" in said
    assert (tmp_path / "results" / "report.html").stat().st_size > 100_000


def test_another_size_of_ids_is_refused(tmp_path: Path) -> None:
    """What configures for the sizes of the library does not for the others."""
    cache = dict(re.findall(r"^(LAMMPS_\w+):\w+=(.*)$", (ROOT / "build" / "CMakeCache.txt").read_text(), re.MULTILINE))
    other = {"SMALLBIG": "BIGBIG", "BIGBIG": "SMALLBIG"}[cache["LAMMPS_SIZES"]]
    configure: list[str | Path] = ["cmake", "-S", ROOT, "-B", tmp_path, "-DSHEARBOX_TESTS=OFF"]
    configure += [f"-D{name}={value}" for name, value in (cache | {"LAMMPS_SIZES": other}).items()]
    refused = subprocess.run(configure, capture_output=True, text=True, timeout=60)
    assert refused.returncode != 0
    assert f"give -DLAMMPS_SIZES={cache['LAMMPS_SIZES']}" in " ".join(refused.stderr.split())


def test_engine(prefix: Path, tmp_path: Path) -> None:
    (tmp_path / "deck.in").write_text("dimension 2\natom_style sphere\npair_style none\ninfo styles pair\n")
    said = start(prefix / "bin" / "lmp_cdem", "-in", "deck.in", cwd=tmp_path)
    assert re.search(r"\bcdem\b", said)


def test_plugin_and_styles_are_side_by_side(prefix: Path) -> None:
    """As the plugin looks for them; Debian's LAMMPS has no PLUGIN package to load it with."""
    names = {path.name for path in (prefix / "lib" / "shearbox").iterdir()}
    assert names - {"liggghts_cdem.so"} == {"cdemplugin.so", "cdemstyles.so"}  # the third where LIGGGHTS is installed


@pytest.mark.skipif(not MODULES.exists(), reason="needs Debian's environment-modules")
def test_modulefile(prefix: Path, tmp_path: Path) -> None:
    """Loaded, its commands and its module of Python are those of the folder; unloaded, there are none."""
    load = f". {MODULES}; module use {prefix}/share/shearbox/modulefiles; module load shearbox"
    commands = ["command -v shearbox lmp_cdem", "/usr/bin/python3 -c 'import shearbox; print(shearbox.__file__)'"]
    said = start("bash", "-c", "\n".join([load, *commands, "module unload shearbox", "echo $PATH"]), cwd=tmp_path)
    files = [prefix / "bin" / "shearbox", prefix / "bin" / "lmp_cdem", prefix / "share/shearbox/tools/shearbox.py"]
    assert said.splitlines() == [*map(str, files), ENVIRONMENT["PATH"]]
