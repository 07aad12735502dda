# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenes of the benchmarks: how each is made, and the jobs that step it with every engine."""

from __future__ import annotations

import re
import shutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from engines import CDEM, HERE, LIGGGHTS, ROOT, STOCK, Job, start

AREAL_DENSITY = 26.5  # kg/m^2
KN = 1.0e8  # N/m, of the decks
INPUT = ROOT / "input"
FULL_TEST = 8.0, 800, 100  # mm, rows of output, frames


@dataclass(frozen=True)
class Bed:
    """A bed at rest (variables of bed.in), copies of it, ranks, and for how many disc-steps it runs."""

    bed: Mapping[str, float | str]
    copies: tuple[int, int] = (1, 1)
    ranks: int = 1
    disc_steps: float = 6e7
    more: Mapping[str, object] = field(default_factory=dict)  # variables of scene.in
    instructions: str = ""  # instruction set of ours; then the peers have no part

    @property
    def discs(self) -> int:
        """Discs of all grains."""
        return int(self.bed["n"]) * (3 if self.clumps else 1) * self.copies[0] * self.copies[1]

    @property
    def clumps(self) -> bool:
        """Whether the grains are of three discs."""
        return self.bed.get("shape") == "triple"

    def jobs(self, beds: Path, share: float) -> list[Job]:
        """A job for each engine, ours first; makes the bed if it is not there yet. `share` shortens the jobs. None for
        LIGGGHTS with grains of three discs: it makes its rigid bodies itself, and cannot take them from a bed.
        """
        folder = pack(self.bed, beds)
        steps = max(100, round(share * self.disc_steps / self.discs))
        shared = {"decks": HERE, "steps": steps, "nx": self.copies[0], "ny": self.copies[1], **self.more}

        def job(engine: str, deck: str, data: str, **variables: str) -> Job:
            values: dict[str, object] = {**shared, "data": folder / data, **variables}
            return Job(engine, HERE / deck, values, steps, self.discs, self.ranks)

        if self.clumps:
            ours = job(CDEM, "cdem.in", "bed.restart", shape="triple", restart="1")
            return [ours, job(STOCK, "stock_rigid.in", "rigid.data")]
        if self.instructions:
            return [job(CDEM, "cdem.in", "bed.data", options=f"instructions {self.instructions}")]
        ours = job(CDEM, "cdem.in", "bed.data")
        return [ours, job(STOCK, "stock.in", "bed.data"), job(LIGGGHTS, "liggghts.in", "bed.data")]


@dataclass(frozen=True)
class Shear:
    """The direct shear test of input/shear.in, from the start, at full speed at once."""

    travel: float = 8  # mm
    speed: float = 2  # mm/s
    sigma: float = 100  # kPa
    stiffness: float = 1  # factor on that of all contacts
    model: str = "TypeA_10x5_4-8_1-circle_350"
    ranks: int = 1

    @property
    def discs(self) -> int:
        """Discs of all grains."""
        return int(self.model.split("_")[-1])

    def jobs(self, beds: Path, share: float) -> list[Job]:
        """A job for each engine, ours first; makes the specimen if it is not there yet. `share` shortens the travel.
        All have the time step that ours chooses, and the full test's intervals of output in steps.
        """
        folder = consolidate(self.model, self.sigma, self.stiffness, beds)
        scene = (folder / "shear.scene").read_text()
        dt = float(re.findall(r"variable dt index (\S+)", scene)[0])
        travel = share * self.travel
        full, *outputs = FULL_TEST
        rows, frames = (max(1, round(travel / full * number)) for number in outputs)
        steps = row_steps(travel / self.speed / dt / rows) * rows
        test = {"sigma": self.sigma, "speed": self.speed, "travel": travel, "rows": rows, "frames": frames}
        files = {"data": folder / "shear.data", "scene": folder / "shear.scene"}
        material = {"kn": KN * self.stiffness, "ks": KN / 4 * self.stiffness}
        peers: dict[str, object] = {"decks": HERE, **files, **test, **material}
        ours = {"decks": INPUT, "model": self.model, "stiffness": self.stiffness, "ramp": 0, "audit": "no", **test}
        restart = (folder / "consolidated.restart",)
        return [
            Job(CDEM, INPUT / "shear.in", ours, steps, self.discs, files=restart),
            Job(STOCK, HERE / "shear_stock.in", peers, steps, self.discs),
            Job(LIGGGHTS, HERE / "shear_liggghts.in", peers, steps, self.discs),
        ]


Scene = Bed | Shear


def row_steps(wanted: float) -> int:
    """Steps of a row of shear.dat, rounded up as in input/shear.in."""
    samples = np.ceil(wanted / 25 if wanted < 2500 else 100)
    sample = int(np.ceil(wanted / samples))
    return sample * int(np.ceil(wanted / sample))


SMALL: Mapping[str, float | str] = {"n": 350, "width": 0.1, "dmin": 0.004, "dmax": 0.008}
THOUSAND: Mapping[str, float | str] = {"n": 1000, "width": 0.08}
MIDDLE: Mapping[str, float | str] = {"n": 1500, "width": 0.1}
LARGE: Mapping[str, float | str] = {"n": 9000, "width": 0.3}
CLUMPS: Mapping[str, float | str] = {"n": 500, "width": 0.1, "shape": "triple"}

SHEAR = "shear test"
BY_SIZE = ("1e3 discs", "1e4 discs", "1e5 discs", "1e6 discs")
BY_WIDTH = {"1500 discs, baseline": 2, "1500 discs, avx2": 4, "1500 discs": 8}  # doubles in a vector
BY_RANKS = ("1e5 discs", "1e5 discs, 2 ranks")
SCENES: dict[str, Scene] = {
    "1500 discs": Bed(MIDDLE),
    "1500 discs, avx2": Bed(MIDDLE, instructions="avx2"),
    "1500 discs, baseline": Bed(MIDDLE, instructions="baseline"),
    "350 discs": Bed(SMALL),
    "9000 discs": Bed(LARGE),
    "500 grains of three discs": Bed(CLUMPS),
    SHEAR: Shear(),
    "1e3 discs": Bed(THOUSAND),
    "1e4 discs": Bed(THOUSAND, copies=(2, 5)),
    "1e5 discs": Bed(THOUSAND, copies=(20, 5), disc_steps=1e8),
    "1e5 discs, 2 ranks": Bed(THOUSAND, copies=(20, 5), ranks=2, disc_steps=1e8),
    "1e6 discs": Bed(THOUSAND, copies=(50, 20), disc_steps=2e8),
}


def pack(bed: Mapping[str, float | str], beds: Path) -> Path:
    """The folder with a bed, packed if it is not there yet."""
    folder = beds / "-".join(str(value) for value in bed.values())
    if not folder.exists():
        made = folder.with_name(folder.name + ".new")  # an interrupted packing leaves no folder that looks whole
        start(Job(CDEM, HERE / "bed.in", bed), made)
        plain_atoms(made / "bed.data")
        write_rigid(made)
        made.rename(folder)
    return folder


def consolidate(model: str, sigma: float, stiffness: float, beds: Path) -> Path:
    """The folder with a specimen of a model, consolidated under a stress with a stiffness."""
    folder = beds / f"{model}-{sigma:g}-{stiffness:g}"
    if not folder.exists():
        made = folder.with_name(folder.name + ".new")
        about = {"decks": INPUT, "model": model, "stiffness": stiffness, "sides": "discs"}  # the peers have no lines
        start(Job(CDEM, INPUT / "pack.in", about), made / "packed")
        packed = made / "packed" / "packed.restart"
        start(Job(CDEM, INPUT / "consolidate.in", {**about, "packed": packed, "sigma": sigma}), made / "consolidated")
        restart = made / "consolidated" / "consolidated.restart"
        start(Job(CDEM, HERE / "shear_bed.in", about, files=(restart,)), made / "shear")
        plain_atoms(made / "shear" / "shear.data")
        without_types_of_lines(made / "shear" / "shear.data")
        shutil.move(made / "shear", folder)
        shutil.rmtree(made)
    return folder


def plain_atoms(data: Path) -> None:
    """Takes the atom style out of the heading of a data file, which LIGGGHTS does not understand."""
    data.write_text(re.sub(r"^Atoms # sphere", "Atoms", data.read_text(), flags=re.M))


def without_types_of_lines(data: Path) -> None:
    """Takes types 3 and 4 out of a data file, of which there are no atoms: the peers want coefficients of all types."""
    data.write_text(re.sub(r"^4( +atom types)", r"2\1", data.read_text(), flags=re.M))


def write_rigid(folder: Path) -> None:
    """From bed.data and bed.discs, the same bed with an atom a disc and a molecule a grain: rigid.data."""
    head, atoms = (folder / "bed.data").read_text().split("Atoms\n")
    rows = np.array([line.split() for line in atoms.split("Velocities")[0].strip().splitlines()], float)
    walls = rows[rows[:, 1] == 2]
    discs = np.loadtxt(folder / "bed.discs", skiprows=9, ndmin=2)
    grain, x, y, r = discs[:, 0], discs[:, 2], discs[:, 3], discs[:, 4]
    x, y, r = np.append(x, walls[:, 4]), np.append(y, walls[:, 5]), np.append(r, walls[:, 2] / 2)
    kind = np.append(np.ones(len(grain)), np.full(len(walls), 2))
    body = np.append(grain, np.zeros(len(walls)))
    density = AREAL_DENSITY * 3 / (4 * r)  # of a sphere with the mass of the disc
    lines = [
        f"{i} {kind[i - 1]:.0f} {2 * r[i - 1]:.17g} {density[i - 1]:.17g} {x[i - 1]:.17g} {y[i - 1]:.17g} 0"
        for i in range(1, len(r) + 1)
    ]
    molecules = [f"{i} {m:.0f}" for i, m in enumerate(body, 1)]
    head = re.sub(r"\d+ atoms", f"{len(r)} atoms", head)
    text = f"{head}Atoms\n\n" + "\n".join(lines) + "\n\nMolecules\n\n" + "\n".join(molecules) + "\n"
    (folder / "rigid.data").write_text(text)
