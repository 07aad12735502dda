# SPDX-License-Identifier: GPL-2.0-or-later
"""The program lmp_cdem and the plugin themselves: what they register, and how they end when something is wrong."""

import ctypes
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
        command = ["mpirun", "-np", str(ranks), *command]
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


class Plugin(ctypes.Structure):
    """What a plugin registers: lammpsplugin_t."""

    _fields_ = [(name, ctypes.c_char_p) for name in ("version", "style", "name", "info", "author")] + [
        ("creator", ctypes.c_void_p),
        ("handle", ctypes.c_void_p),
    ]


Register = ctypes.CFUNCTYPE(None, ctypes.POINTER(Plugin), ctypes.c_void_p)


def plugin_styles() -> None:
    """Load the plugin as `plugin load` does, into a LAMMPS that has no such command; print what it registers."""

    def number_of(version: str) -> int:  # "29 Sep 2021" -> 20210929
        return int(datetime.strptime(version, "%d %b %Y").strftime("%Y%m%d"))

    pair_creators: list[int] = []

    def register(plugin: "ctypes._Pointer[Plugin]", _lmp: int) -> None:
        style = plugin.contents
        assert style.creator and number_of(style.version.decode()) == lammps.lammps_version(lmp)
        print(style.style.decode(), style.name.decode())
        if style.style == b"pair":
            pair_creators.append(style.creator)

    def print_those_in_tables() -> None:  # the plugin puts them there where LAMMPS's loader does not know their kind
        for kind, category in (("dump", b"dump"), ("run", b"integrate")):
            for name in STYLES[kind]:
                if lammps.lammps_has_style(lmp, category, name.encode()):
                    print(kind, name)

    ctypes.CDLL("libmpi.so.40", mode=ctypes.RTLD_GLOBAL)
    lammps = ctypes.CDLL("liblammps.so.0", mode=ctypes.RTLD_GLOBAL)
    lammps.lammps_open_no_mpi.restype = ctypes.c_void_p
    arguments = [b"lmp", b"-log", b"none", b"-screen", b"none"]
    argv = (ctypes.c_char_p * len(arguments))(*arguments)
    lmp = ctypes.c_void_p(lammps.lammps_open_no_mpi(len(arguments), argv, None))
    plugin = ctypes.CDLL(str(PROGRAM.with_name("cdemplugin.so")))
    plugin.lammpsplugin_init(lmp, None, Register(register))
    print_those_in_tables()
    print("clear")
    lammps.lammps_command(lmp, b"clear")  # the tables are as at the start; newer loaders put back what they know
    for creator in pair_creators:
        ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p)(creator)(lmp)
    print_those_in_tables()


def load_plugin(*stranger: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, __file__, *stranger], capture_output=True, text=True, timeout=60)


def test_plugin_registers_every_style() -> None:
    done = load_plugin()
    assert done.returncode == 0, done.stderr
    loaded, restored = done.stdout.split("clear\n")
    assert {tuple(line.split()) for line in loaded.splitlines()} == {
        (kind, name) for kind, names in STYLES.items() for name in names
    }
    assert "dump cdem/local" in restored.splitlines()


# What the plugin asks of the LAMMPS that loads it; one that answers so is refused.
STRANGER = """
#include <stdio.h>
int lammps_version(void *lmp) { return VERSION; }
int lammps_extract_setting(void *lmp, const char *name) { return name[0] == 't' ? TAGINT : 0; }
int lammps_config_has_mpi_support(void) { return MPI; }
int MPI_Get_library_version(char *name, int *length) { return *length = sprintf(name, "MPICH Version:\\t5.0.2"); }
"""
BIGBIG = "LAMMPS_SIZES:STRING=BIGBIG" in PROGRAM.with_name("CMakeCache.txt").read_text(encoding="utf-8")
IDS, OTHER_IDS = (8, 4) if BIGBIG else (4, 8)
REFUSED: dict[str, tuple[dict[str, int], str]] = {
    "version": ({"VERSION": 20000101}, r"compiled for LAMMPS 20\d{6}, but this is LAMMPS 20000101"),
    "ids": (
        {"TAGINT": OTHER_IDS},
        f"ids of {8 * IDS} bits, but those of this LAMMPS have {8 * OTHER_IDS}: .* -DLAMMPS_SIZES=",
    ),
    "no MPI": ({"MPI": 0}, "compiled with Open MPI, but this LAMMPS has no MPI"),
    "other MPI": ({}, "compiled with Open MPI, but this LAMMPS runs with MPICH Version: 5.0.2"),
}


def plugin_refusal(stranger: str) -> None:
    """Load the plugin into a library that answers as a LAMMPS does; nothing is to be registered."""
    ctypes.CDLL(stranger, mode=ctypes.RTLD_GLOBAL)
    plugin = ctypes.CDLL(str(PROGRAM.with_name("cdemplugin.so")))
    plugin.lammpsplugin_init(None, None, Register(lambda plugin, _lmp: print(plugin.contents.name)))


@pytest.mark.parametrize("case", REFUSED)
def test_plugin_refuses_another_lammps(tmp_path: Path, case: str) -> None:
    other, message = REFUSED[case]
    version = re.findall(r"^version (\d+)", run(tmp_path, 'print "version $(version)"').stdout, re.M)[0]
    answers = {"VERSION": version, "TAGINT": IDS, "MPI": 8} | other
    source, library = tmp_path / "stranger.c", tmp_path / "stranger.so"
    source.write_text(STRANGER)
    defines = [f"-D{name}={value}" for name, value in answers.items()]
    subprocess.run(["gcc", "-shared", "-fPIC", *defines, str(source), "-o", str(library)], check=True)
    done = load_plugin(str(library))
    assert (done.returncode, done.stdout) == (0, "")
    assert len(done.stderr.splitlines()) == 1
    assert re.search(f"ERROR: plugin refused: Shearbox was .*{message}", done.stderr)


if __name__ == "__main__":
    plugin_refusal(*sys.argv[1:]) if sys.argv[1:] else plugin_styles()
