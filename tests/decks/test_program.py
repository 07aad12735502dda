# SPDX-License-Identifier: GPL-2.0-or-later
"""The program lmp_cdem and the plugin themselves: what they register, and how they end when something is wrong."""

import ctypes
import os
import re
import struct
import subprocess
import sys
from datetime import datetime
from pathlib import Path

import pytest
from engine import ENVIRONMENT, PROGRAM

STYLES = {
    "pair": {"cdem"},
    "fix": {
        "cdem/audit",
        "cdem/grains",
        "cdem/history",
        "cdem/integrate",
        "cdem/lid",
        "cdem/move",
        "cdem/shape",
        "cdem/trm",
    },
    "compute": {
        "cdem/average",
        "cdem/contacts",
        "cdem/discs",
        "cdem/energy",
        "cdem/force",
        "cdem/grid",
        "cdem/limit",
        "cdem/signal",
        "cdem/trm",
    },
    "dump": {"cdem/local"},
    "command": {"cdem/create"},
    "run": {"verlet/cdem"},
}
SCENE = """
units si
dimension 2
newton off
atom_style sphere
comm_modify vel yes
region box block 0 1 0 1 -0.5 0.5
create_box 1 box
pair_style cdem law direct
pair_coeff * * 1e6 1e6 0.1 0.1 30
"""


def run(
    cwd: Path, deck: str | None, ranks: int = 1, *options: str, file: str = "in.test", **environment: str
) -> subprocess.CompletedProcess[str]:
    """Run a deck (None: the file is there already, or is not to be); a deadlock shows as a time-out."""
    if deck is not None:
        (cwd / "in.test").write_text(deck)
    command = [str(PROGRAM), "-in", file, "-log", "none", *options]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), *command]
    return subprocess.run(
        command,
        cwd=cwd,
        env=ENVIRONMENT | environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=60,
    )


@pytest.mark.parametrize("ranks", [1, 4])
def test_styles_survive_clear(tmp_path: Path, ranks: int) -> None:
    done = run(tmp_path, SCENE + "clear" + SCENE, ranks)
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_style_is_registered(tmp_path: Path) -> None:
    done = run(tmp_path, "info styles pair styles fix styles compute styles dump styles command styles integrate")
    words = set(done.stdout.split())
    assert set.union(*STYLES.values()) - {"cdem"} <= words
    assert set.union(*STYLES.values()) <= words


def test_banner_names_version_once(tmp_path: Path) -> None:
    done = run(tmp_path, 'print "hello"', ranks=4)
    assert done.stdout.count("Shearbox ") == 1


@pytest.mark.parametrize("ranks", [1, 4])
def test_missing_input_file_fails(tmp_path: Path, ranks: int) -> None:
    done = run(tmp_path, None, ranks)
    assert done.returncode != 0
    assert "Cannot open input script in.test" in done.stdout + done.stderr


@pytest.mark.parametrize("ranks", [1, 4])
def test_error_in_deck_fails(tmp_path: Path, ranks: int) -> None:
    done = run(tmp_path, "pair_style nonsense", ranks)
    assert done.returncode != 0
    assert "nonsense" in done.stdout + done.stderr


@pytest.mark.parametrize("folder", ["decks", "my decks"])
def test_parts_of_a_deck_are_found_beside_it(tmp_path: Path, folder: str) -> None:
    decks = tmp_path / "a blank" / folder
    decks.mkdir(parents=True)
    (decks / "whole.in").write_text("include ${decks}/part.in")
    (decks / "part.in").write_text('print "here"')
    cwd = tmp_path / "a blank" / "results"
    cwd.mkdir()
    done = run(cwd, None, file=str(decks / "whole.in"))
    if " " in folder:  # LAMMPS cannot
        assert f"include cannot read from folder '../{folder}'" in done.stdout
    else:
        assert "here" in done.stdout.splitlines()


def as_if_linked_symbolic(library: bytes) -> bytes:
    """An ELF file whose own symbols go first, as with -Bsymbolic: DT_SYMBOLIC in a spare entry of its dynamic section."""
    phoff, phentsize, phnum = (*struct.unpack_from("<Q", library, 32), *struct.unpack_from("<HH", library, 54))
    headers = [struct.unpack_from("<IIQQQQ", library, phoff + i * phentsize) for i in range(phnum)]
    start, size = next((offset, size) for type_, _, offset, _, _, size in headers if type_ == 2)  # PT_DYNAMIC
    entries = range(start, start + size, 16)
    end = next(at for at in entries if library[at : at + 8] == bytes(8))  # DT_NULL
    assert end + 16 in entries, "there is no spare entry"
    return library[:end] + struct.pack("<QQ", 16, 0) + library[end + 16 :]


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_library_that_takes_no_styles_is_named(tmp_path: Path, ranks: int) -> None:
    loads = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout
    library = Path(re.findall(r"(\S*liblammps\S*) \(", loads)[0])
    (tmp_path / library.name).write_bytes(as_if_linked_symbolic(library.read_bytes()))
    done = run(tmp_path, SCENE, ranks, LD_LIBRARY_PATH=str(tmp_path))
    assert done.returncode != 0
    assert "ERROR: The styles of Shearbox are not there: this LAMMPS library calls its own" in done.stdout


def test_error_in_one_partition_ends_the_others(tmp_path: Path) -> None:
    (tmp_path / "in.0").write_text("pair_style nonsense")
    (tmp_path / "in.1").write_text("shell sleep 100")
    done = run(tmp_path, "variable part world 0 1\ninclude in.${part}", 4, "-partition", "1", "3")
    assert done.returncode != 0


def plugin_styles() -> None:
    """Load the plugin as `plugin load` does, into a LAMMPS that has no such command; print what it registers."""

    class Plugin(ctypes.Structure):
        _fields_ = [(name, ctypes.c_char_p) for name in ("version", "style", "name", "info", "author")] + [
            ("creator", ctypes.c_void_p),
            ("handle", ctypes.c_void_p),
        ]

    def number_of(version: str) -> int:  # "29 Sep 2021" -> 20210929
        return int(datetime.strptime(version, "%d %b %Y").strftime("%Y%m%d"))

    def register(plugin: "ctypes._Pointer[Plugin]", _lmp: int) -> None:
        style = plugin.contents
        assert style.creator and number_of(style.version.decode()) == lammps.lammps_version(lmp)
        print(style.style.decode(), style.name.decode())

    ctypes.CDLL("libmpi.so.40", mode=ctypes.RTLD_GLOBAL)
    lammps = ctypes.CDLL("liblammps.so.0", mode=ctypes.RTLD_GLOBAL)
    lammps.lammps_open_no_mpi.restype = ctypes.c_void_p
    arguments = [b"lmp", b"-log", b"none", b"-screen", b"none"]
    argv = (ctypes.c_char_p * len(arguments))(*arguments)
    lmp = ctypes.c_void_p(lammps.lammps_open_no_mpi(len(arguments), argv, None))
    plugin = ctypes.CDLL(str(PROGRAM.with_name("cdemplugin.so")))
    plugin.lammpsplugin_init(lmp, None, ctypes.CFUNCTYPE(None, ctypes.POINTER(Plugin), ctypes.c_void_p)(register))
    for name in STYLES["dump"]:  # the loader has no dump styles: the plugin puts them into LAMMPS's table
        if lammps.lammps_has_style(lmp, b"dump", name.encode()):
            print("dump", name)


def load_plugin(**environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, __file__], env=os.environ | environment, capture_output=True, text=True, timeout=60
    )


def test_plugin_registers_every_style() -> None:
    done = load_plugin()
    assert done.returncode == 0, done.stderr
    assert {tuple(line.split()) for line in done.stdout.splitlines()} == {
        (kind, name) for kind, names in STYLES.items() for name in names
    }


def test_plugin_refuses_another_lammps(tmp_path: Path) -> None:
    source = tmp_path / "other.c"
    source.write_text("int lammps_version(void *lmp) { return 20000101; }\n")
    other = tmp_path / "other.so"
    subprocess.run(["gcc", "-shared", "-fPIC", "-w", str(source), "-o", str(other)], check=True)
    done = load_plugin(LD_PRELOAD=str(other))
    assert done.stdout == ""
    assert re.search(r"compiled for LAMMPS 20\d{6}, but this is LAMMPS 20000101", done.stderr)


if __name__ == "__main__":
    plugin_styles()
