# SPDX-License-Identifier: GPL-2.0-or-later
"""One specimen in both engines: the same grains and walls, at rest, of which no contact remembers anything, and its shear
by the decks of each engine."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import engine
import host
import numpy as np
from host import HERE, ROOT, Frame

INPUT = ROOT / "input"
GROUPS = ("lower", "upper", "lid", "floor", "left", "right", "flanges", "grains", "walls")
TYPES = {"lammps": 4, "liggghts": 2}  # of atoms in the decks; with sides of discs only two are in use
DENSITY = {"lammps": "density/disc", "liggghts": "density"}
Columns = dict[str, np.ndarray]

STATE = "\n".join(
    [f"variable in_{name} atom gmask({name})" for name in GROUPS]
    + ["dump state all custom 1 state.dump id type radius x y " + " ".join(f"v_in_{name}" for name in GROUPS)]
    + ["dump_modify state sort id format float %.17g", "run 0"]
)


def run(who: str, deck: str, folder: Path, ranks: int = 1, **variables: Any) -> None:
    """A deck of the test, as the engine `who` has it, and what is appended to it."""
    if who == "lammps":
        engine.run(f"include ${{decks}}/{deck}", folder, ranks=ranks, decks=INPUT, sides="discs", **variables)
        return
    status, output = host.start(
        f"include ${{decks}}/{deck}", folder, ranks=ranks, decks=INPUT / "liggghts", **variables
    )
    assert status == 0, "\n".join(output.splitlines()[-25:])


def consolidated(folder: Path, **variables: Any) -> Frame:
    """The grains and walls of a specimen that LAMMPS has packed and consolidated under 100 kPa."""
    run("lammps", "pack.in", folder, **variables)
    run("lammps", f"consolidate.in\n{STATE}", folder, **variables)
    return engine.read_dump(folder / "state.dump")[-1]


def hand_over(grains: Frame, who: str, folder: Path) -> None:
    """Have the engine write them as the consolidated.restart that its shear.in begins with."""
    folder.mkdir(parents=True, exist_ok=True)
    places = grains["x"], grains["y"]
    sides = [f"{a.min() - 0.01:.6f} {a.max() + 0.03:.6f} {axis}lo {axis}hi" for a, axis in zip(places, "xy")]
    lines = ["Specimen", "", f"{len(grains['id'])} atoms", f"{TYPES[who]} atom types", "", *sides]
    lines += ["-0.01 0.01 zlo zhi", "", "Atoms", ""]
    for i, kind, r, x, y in zip(*(grains[name] for name in ("id", "type", "radius", "x", "y"))):
        lines.append(f"{i:.0f} {kind:.0f} {2 * r:.17g} 1 {x:.17g} {y:.17g} 0")
    (folder / "specimen.data").write_text("\n".join(lines) + "\n")
    groups = [f"group {name} id {i:.0f}" for name in GROUPS for i in grains["id"][grains[f"v_in_{name}"] == 1]]
    (folder / "groups.in").write_text("\n".join(groups) + "\n")
    deck = "include ${decks}/specimen.in"
    variables: dict[str, Any] = {"decks": HERE, "density": DENSITY[who]}
    status, output = (
        engine.start(deck, folder, **variables) if who == "lammps" else host.start(deck, folder, **variables)
    )
    assert status == 0, "\n".join(output.splitlines()[-25:])


def sheared(who: str, folder: Path, ranks: int = 1, **variables: Any) -> Columns:
    """shear.dat of the deck shear.in."""
    run(who, "shear.in", folder, ranks, **variables)
    return shear_table(folder)


def shear_table(folder: Path) -> Columns:
    """The columns of a shear.dat."""
    with (folder / "shear.dat").open() as file:
        names = file.readline()[1:].split()
        return dict(zip(names, np.loadtxt(file, ndmin=2).T, strict=True))
