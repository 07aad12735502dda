#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# MDTraj 1.11.1.post2: grains in dump files of LAMMPS with scaled coordinates (xs ys zs, which `dump atom` writes by default).
#
# Guess: a grain is read at the place where it is, whatever the columns: x and xs of the same grain and box give the same place,
#        and a grain at rest stays at rest while the box follows the others.
# Seen:  scaled coordinates are read as places, as they stand: neither the length of the box nor where it begins is counted, though
#        the box itself is read right. All grains lie between 0 and 1, and grains that rest move as the box grows. No warning: the
#        manual says which columns are taken first, scaled ones before unwrapped ones, so that a file with both is read wrong, too.
#        With x y z and with xu yu zu all is right, and Chemfiles reads all of these files right.
# For us: dumps of the decks write x and y. With scaled dumps of others: `dump_modify scale no`, or Chemfiles.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile mdtraj==1.11.1.post2 chemfiles==0.10.4 numpy==2.4.6 scipy==1.17.1

cat >rest.py <<'END'
from importlib.metadata import version

import chemfiles
import mdtraj
import numpy as np

print("mdtraj", version("mdtraj"), "chemfiles", version("chemfiles"))
GRAINS = np.array([[2, 5, 0], [7, 5, 0]])  # at rest
BOXES = [(0, 10), (-2, 10), (-4, 14)]  # in x, of three frames
ANGSTROM = 10  # the unit it takes the file to have; its own is nm

topology = mdtraj.Topology()
residue = topology.add_residue("GRN", topology.add_chain())
for _ in GRAINS:
    topology.add_atom("G", mdtraj.element.virtual, residue)


def write(columns):
    """Dump file of the grains in each of the boxes."""
    lines = []
    for step, x in enumerate(BOXES):
        low, high = np.array([x, (0, 10), (-0.5, 0.5)]).T
        scaled = (GRAINS - low) / (high - low)
        rows = np.hstack([scaled if "s" in trio else GRAINS for trio in columns.split(", ")])
        lines.append(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(GRAINS)}\nITEM: BOX BOUNDS ss ss pp")
        lines += [f"{a} {b}" for a, b in zip(low, high)] + ["ITEM: ATOMS id type " + columns.replace(",", "")]
        lines += [f"{grain} 1 " + " ".join(f"{number:.12g}" for number in row) for grain, row in enumerate(rows, 1)]
    with open("rest.lammpstrj", "w") as file:
        file.write("\n".join(lines) + "\n")


def text(places):
    return " ".join("/".join(f"{x:.2f}" for x in frame) for frame in places)


for columns in "x y z", "xu yu zu", "xs ys zs", "xs ys zs, xu yu zu":
    write(columns)
    read = mdtraj.load("rest.lammpstrj", top=topology)
    with chemfiles.Trajectory("rest.lammpstrj", "r", "LAMMPS") as file:
        frames = [file.read() for _ in BOXES]
        others = [frame.positions[:, 0].copy() for frame in frames]
    boxes = " ".join(f"{length:.0f}" for length in read.unitcell_lengths[:, 0] * ANGSTROM)
    print(f"{columns}: by MDTraj {text(read.xyz[:, :, 0] * ANGSTROM)} in boxes of {boxes}; by Chemfiles {text(others)}")
END

seen=$(venv/bin/python rest.py)
expected='mdtraj 1.11.1.post2 chemfiles 0.10.4
x y z: by MDTraj 2.00/7.00 2.00/7.00 2.00/7.00 in boxes of 10 12 18; by Chemfiles 2.00/7.00 2.00/7.00 2.00/7.00
xu yu zu: by MDTraj 2.00/7.00 2.00/7.00 2.00/7.00 in boxes of 10 12 18; by Chemfiles 2.00/7.00 2.00/7.00 2.00/7.00
xs ys zs: by MDTraj 0.20/0.70 0.33/0.75 0.33/0.61 in boxes of 10 12 18; by Chemfiles 2.00/7.00 2.00/7.00 2.00/7.00
xs ys zs, xu yu zu: by MDTraj 0.20/0.70 0.33/0.75 0.33/0.61 in boxes of 10 12 18; by Chemfiles 2.00/7.00 2.00/7.00 2.00/7.00'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
