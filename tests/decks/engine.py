# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a deck through lmp_cdem and reads what comes out.

A deck is LAMMPS input text. It usually begins with `include ${decks}/start.in`, which reads the discs that the test
gives and sets one material, and ends with `include ${decks}/end.in`, which writes the state of all discs with every bit.
SHEARBOX_LMP in the environment names another program than build/lmp_cdem.
"""

from __future__ import annotations

import math
import os
import subprocess
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

DECKS = Path(__file__).resolve().parent
PROGRAM = Path(os.environ.get("SHEARBOX_LMP", DECKS.parents[1] / "build" / "lmp_cdem"))
GRID = {1: (1, 1), 2: (2, 1), 4: (2, 2)}  # ranks along x and y: a border always passes through the middle of the box
TIMEOUT = float(os.environ.get("SHEARBOX_TIMEOUT", 120))  # s; a few are enough, but on a busy machine ranks wait
DENSITY = 26.5  # kg/m^2, areal: 2650 kg/m^3 x 0.01 m

# Open MPI: root is fine. Without mpirun no daemon is wanted, and after an error no second of grace: both take longer than
# a small case. So does its look for the networks of clusters: a message goes through memory here. Its folder is our own: one
# that is shared with other programs may vanish while we start, as they end.
SESSIONS = tempfile.TemporaryDirectory(prefix="mpi-")
TO_MEASURE = os.environ | {
    "OMP_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_ess_singleton_isolated": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",  # no options, since other MPIs' mpirun refuses them
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",  # of Open MPI 5
    "PRTE_MCA_hwloc_default_binding_policy": "none",
    "OMPI_MCA_pml": "ob1",
    "OMPI_MCA_odls_base_sigkill_timeout": "0",
    "OMPI_MCA_orte_tmpdir_base": SESSIONS.name,
}
# More ranks than cores is fine for cases this small; where speed is measured, ranks must not give way.
ENVIRONMENT = TO_MEASURE | {"OMPI_MCA_mpi_yield_when_idle": "1"}


class EngineError(AssertionError):
    """The engine ended with an error; the message holds its last ERROR and the end of its output."""


@dataclass(frozen=True)
class Disc:
    """A disc at the start: m, m/s, rad/s. Type 1 is a grain, 2 a wall."""

    x: float
    y: float
    diameter: float = 4e-3
    vx: float = 0
    vy: float = 0
    omega: float = 0
    type: int = 1

    @property
    def radius(self) -> float:
        return self.diameter / 2

    @property
    def mass(self) -> float:
        return DENSITY * math.pi * self.radius**2

    @property
    def inertia(self) -> float:
        return self.mass * self.radius**2 / 2


Table = dict[str, np.ndarray]


@dataclass
class Frame:
    """One frame of a dump; columns by name, rows by id."""

    step: int
    columns: Table

    def __getitem__(self, column: str) -> np.ndarray:
        return self.columns[column]


@dataclass
class Run:
    """What a run of the engine left behind."""

    directory: Path
    log: str

    def dump(self, name: str) -> list[Frame]:
        return read_dump(self.directory / name)

    def series(self, name: str, column: str) -> np.ndarray:
        """A column of all frames: one row a frame, one column a disc."""
        return np.array([frame[column] for frame in self.dump(name)])

    @property
    def end(self) -> Frame:
        """The state that end.in wrote."""
        return self.dump("end.dump")[-1]

    @property
    def thermo(self) -> Table:
        """The thermo output of the last run command."""
        lines = self.log.splitlines()
        first = max(i for i, line in enumerate(lines) if line.split()[:1] == ["Step"])
        last = next(i for i in range(first, len(lines)) if lines[i].startswith("Loop time"))
        rows = [[float(word) for word in line.split()] for line in lines[first + 1 : last] if is_numbers(line)]
        return dict(zip(lines[first].split(), np.array(rows).T, strict=True))

    def printed(self, name: str) -> float:
        """The value of a line `name = value` of the log, the last one."""
        values = [line.split("=")[1] for line in self.log.splitlines() if line.startswith(f"{name} = ")]
        return float(values[-1])


def run(
    deck: str,
    directory: Path,
    *,
    discs: Sequence[Disc] = (),
    box: tuple[float, float, float, float] = (-0.02, 0.02, -0.02, 0.02),
    ranks: int = 1,
    **variables: object,
) -> Run:
    """Runs the deck in `directory`, with the discs in discs.data and the variables as -var; fails if the engine does."""
    if discs:
        directory.mkdir(parents=True, exist_ok=True)
        write_data(directory / "discs.data", discs, box)
    status, output = start(deck, directory, ranks=ranks, **variables)
    if status != 0:
        errors = [line for line in output.splitlines() if "ERROR" in line] or ["no ERROR line"]
        tail = "\n".join(output.splitlines()[-25:])
        raise EngineError(f"{errors[-1]}\n(exit status {status}, {ranks} ranks, in {directory})\n...\n{tail}")
    return Run(directory, (directory / "log.lammps").read_text())


def start(deck: str, directory: Path, *, ranks: int = 1, **variables: object) -> tuple[int, str]:
    """Exit status and output of a deck, whatever comes."""
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "deck.in").write_text(deck)
    px, py = GRID[ranks]
    command = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    command += [str(PROGRAM), "-in", "deck.in", "-nocite"]
    for name, value in ({"decks": DECKS, "px": px, "py": py} | variables).items():
        command += ["-var", name, f"{value:.17g}" if isinstance(value, float) else str(value)]
    try:
        done = subprocess.run(
            command, cwd=directory, env=ENVIRONMENT, timeout=TIMEOUT, text=True, errors="replace",
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
    except subprocess.TimeoutExpired as expired:
        output = expired.stdout if isinstance(expired.stdout, str) else (expired.stdout or b"").decode(errors="replace")
        raise EngineError(f"no end after {TIMEOUT} s: {' '.join(command)}\n{output[-2000:]}") from None
    return done.returncode, done.stdout


def write_data(file: Path, discs: Sequence[Disc], box: tuple[float, float, float, float]) -> None:
    """LAMMPS data file for atom_style sphere; the density is set by start.in."""
    xlo, xhi, ylo, yhi = box
    types = max(2, *(d.type for d in discs)) if discs else 2
    lines = ["Discs of a test", "", f"{len(discs)} atoms", f"{types} atom types", ""]
    lines += [
        f"{xlo:.17g} {xhi:.17g} xlo xhi",
        f"{ylo:.17g} {yhi:.17g} ylo yhi",
        "-0.5 0.5 zlo zhi",
        "",
        "Atoms # sphere",
        "",
    ]
    lines += [f"{i} {d.type} {d.diameter:.17g} 1 {d.x:.17g} {d.y:.17g} 0" for i, d in enumerate(discs, 1)]
    lines += ["", "Velocities", ""]
    lines += [f"{i} {d.vx:.17g} {d.vy:.17g} 0 0 0 {d.omega:.17g}" for i, d in enumerate(discs, 1)]
    file.write_text("\n".join(lines) + "\n")


def read_dump(file: Path) -> list[Frame]:
    """Frames of a dump of style custom or local."""
    frames: list[Frame] = []
    lines = iter(file.read_text().splitlines())
    step = count = 0
    for line in lines:
        if line == "ITEM: TIMESTEP":
            step = int(next(lines))
        elif line.startswith("ITEM: NUMBER OF"):
            count = int(next(lines))
        elif line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES")):
            names = line.split()[2:]
            rows = np.array([next(lines).split() for _ in range(count)], dtype=float).reshape(count, len(names))
            frames.append(Frame(step, dict(zip(names, rows.T, strict=True))))
    return frames


def is_numbers(line: str) -> bool:
    try:
        return bool([float(word) for word in line.split()])
    except ValueError:
        return False


def same_bits(
    a: Frame, b: Frame, columns: Iterable[str] = ("id", "x", "y", "vx", "vy", "omegaz", "fx", "fy", "tqz")
) -> bool:
    """Whether two states agree in every bit; prints the columns that do not, with their largest difference."""
    same = True
    for column in columns:
        if not np.array_equal(a[column], b[column]):
            print(f"{column} differs by up to {np.max(np.abs(a[column] - b[column])):.3g}")
            same = False
    return same
