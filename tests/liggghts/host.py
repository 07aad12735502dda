# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a deck through an unmodified LIGGGHTS that loads build/liggghts_cdem.so, and reads what comes out.

A deck begins with `include ${decks}/start.in`, which reads the discs that the test gives and sets one material.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.append(str(ROOT / "tests" / "decks"))

from engine import ENVIRONMENT, Disc, Frame, read_dump  # noqa: E402

PROGRAM = shutil.which("liggghts")
LIBRARY = ROOT / "build" / "liggghts_cdem.so"
TIMEOUT = float(os.environ.get("SHEARBOX_TIMEOUT", 120))  # s


@dataclass
class Run:
    directory: Path
    output: str

    def series(self, name: str, column: str) -> np.ndarray:
        """A column of all frames of a dump: one row a frame, one column a disc, by id."""
        return np.array([f[column][np.argsort(f["id"])] for f in read_dump(self.directory / name)])

    @property
    def end(self) -> Frame:
        frame = read_dump(self.directory / "end.dump")[-1]
        order = np.argsort(frame["id"])
        return Frame(frame.step, {name: values[order] for name, values in frame.columns.items()})


def start(deck: str, directory: Path, *, ranks: int = 1, preload: bool = True, **variables: object) -> tuple[int, str]:
    """Exit status and output of a deck, whatever comes."""
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "deck.in").write_text(deck)
    command = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    command += ["env", f"LD_PRELOAD={LIBRARY}"] if preload else []
    command += [str(PROGRAM), "-in", "deck.in"]
    for name, value in ({"decks": HERE} | variables).items():
        command += ["-var", name, f"{value:.17g}" if isinstance(value, float) else str(value)]
    done = subprocess.run(
        command, cwd=directory, env=ENVIRONMENT, timeout=TIMEOUT, text=True, errors="replace",
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip
    return done.returncode, done.stdout


def run(
    deck: str,
    directory: Path,
    discs: Sequence[Disc],
    box: tuple[float, float, float, float] = (-0.02, 0.02, -0.02, 0.02),
    **options: object,
) -> Run:
    directory.mkdir(parents=True, exist_ok=True)
    write_data(directory / "discs.data", discs, box)
    status, output = start(deck, directory, **options)  # type: ignore[arg-type]
    assert status == 0, "\n".join(output.splitlines()[-25:])
    return Run(directory, output)


def write_data(file: Path, discs: Sequence[Disc], box: tuple[float, float, float, float]) -> None:
    """LIGGGHTS takes no comment after Atoms, and the density is set by start.in."""
    xlo, xhi, ylo, yhi = box
    lines = ["Discs of a test", "", f"{len(discs)} atoms", "2 atom types", ""]
    lines += [f"{xlo:.17g} {xhi:.17g} xlo xhi", f"{ylo:.17g} {yhi:.17g} ylo yhi", "-0.5 0.5 zlo zhi", "", "Atoms", ""]
    lines += [f"{i} {d.type} {d.diameter:.17g} 1 {d.x:.17g} {d.y:.17g} 0" for i, d in enumerate(discs, 1)]
    lines += ["", "Velocities", ""]
    lines += [f"{i} {d.vx:.17g} {d.vy:.17g} 0 0 0 {d.omega:.17g}" for i, d in enumerate(discs, 1)]
    file.write_text("\n".join(lines) + "\n")
