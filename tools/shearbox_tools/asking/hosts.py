# SPDX-License-Identifier: GPL-2.0-or-later
"""The programs that carry out a test: where they are, how they are started, and which decks they have."""

import shutil
from dataclasses import dataclass
from pathlib import Path

from ..base.errors import InputError
from ..base.presets import LAMMPS, LIGGGHTS
from .models import INPUT, ROOT

# In the repository ROOT is where all is built; installed below a prefix, ROOT is <prefix>/share/shearbox.
BUILT = (ROOT / "CMakeLists.txt").exists()
PROGRAM = ROOT / "build" / "lmp_cdem" if BUILT else ROOT.parents[1] / "bin" / "lmp_cdem"
LIBRARY = ROOT / "build" / "liggghts_cdem.so" if BUILT else ROOT.parents[1] / "lib" / "shearbox" / "liggghts_cdem.so"


@dataclass(frozen=True)
class Host:
    """`goodbye` begins the last line of the log of a deck that has come to its end; `slowness` is what a step takes over
    that of LAMMPS (tests/benchmarks, tests/validation/liggghts)."""

    decks: Path
    goodbye: bytes
    slowness: float
    # of the settings of a test, those that its decks do not have, with the one value that it goes on with
    fixed: dict[str, str]


HOSTS = {
    LAMMPS: Host(INPUT, b"Total wall time:", 1, {}),
    LIGGGHTS: Host(
        INPUT / "liggghts",
        b"All done",
        5,
        {"sides": "discs", "shape": "single", "phi_packing": "0", "rolling": "0", "cohesion": "0", "inertia": "1",
         "frames": "100", "audit": "yes"},
    ),
}  # fmt: skip


def default_program(host: str) -> Path:
    """The engine, which may not be there."""
    return PROGRAM if host == LAMMPS else Path(shutil.which("liggghts") or "liggghts")


def words_before(host: str) -> list[str]:
    """What stands before the program in a command line: LIGGGHTS, which is not ours, has the law from a library."""
    return [] if host == LAMMPS else ["env", f"LD_PRELOAD={LIBRARY}"]


def check_host(host: str) -> None:
    """Refuse to begin without what the host needs beside its program."""
    if host != LIGGGHTS:
        return
    if not LIBRARY.is_file():
        raise InputError(
            f"--host liggghts: there is no {LIBRARY}. tools/setup --liggghts installs LIGGGHTS and builds it"
        )
    if any(mark in str(LIBRARY) for mark in " :"):
        raise InputError(f"--host liggghts: {LIBRARY}: LD_PRELOAD takes no path with a blank or a colon")
