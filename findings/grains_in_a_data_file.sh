#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# lammpsio 0.9.0 (the source of 0.10.0, for Python 3.12 and later, has the same lines): grains in data and dump files of LAMMPS.
#
# Guess: places, masses and box are read as they were written, to ten digits or so, whatever their unit; and a velocity in a data
#        file is that of the atom whose number stands before it.
# Seen:  numbers are written with six or eight decimals, in any unit. In SI two grains of 0.2 mm that press on each other no longer
#        touch, and in a dump their mass is 0 and a box of 1.2345678 mm is 1.235 mm wide. Velocities are read as those of other
#        atoms if the section Atoms is not in the order of numbers, but sorted by place, say, and the section Velocities is: LAMMPS
#        itself takes any order. No warning, and no word of it.
# For us: data files and dumps of the decks are written by LAMMPS, in order. With lammpsio: write in mm and micrograms and scale what
#        is read, and give both sections the same order.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile lammpsio==0.9.0 numpy==2.4.6

cat >grains.py <<'END'
from importlib.metadata import version
from pathlib import Path

import lammpsio
import numpy as np

print("lammpsio", version("lammpsio"))
for unit, length, mass in ("SI", 1e-3, 1e-9), ("mm and micrograms", 1, 1):
    snapshot = lammpsio.Snapshot(2, lammpsio.Box([0, 0, 0], np.multiply([1.2345678, 1, 1], length)), step=0)
    snapshot.position = np.multiply([[0.5, 0.5, 0.5], [0.699997, 0.5, 0.5]], length)
    snapshot.mass = np.full(2, 11.1) * mass
    snapshot.typeid = [1, 1]
    schema = {"id": 0, "typeid": 1, "mass": 2, "position": (3, 4, 5)}
    [dump] = lammpsio.DumpFile.create("dump", schema, snapshot)
    data = lammpsio.DataFile.create("data", snapshot, "atomic").read()
    for name, found in ("dump", dump), ("data", data):
        overlap = 0.2 * length - np.ptp(found.position[:, 0])
        print(f"{unit}, {name}: overlap {overlap / length * 1e6:.2f} of 3 nm, mass {found.mass[0] / mass:.1f} of 11.1 micrograms,",
              f"box {found.box.high[0] / length:.7f} of 1.2345678 mm")
Path("data").write_text("""grains

3 atoms
1 atom types
0 1 xlo xhi
0 1 ylo yhi
0 1 zlo zhi

Atoms # atomic

3 1 0.1 0.5 0.5
1 1 0.2 0.5 0.5
2 1 0.3 0.5 0.5

Velocities

1 10 0 0
2 20 0 0
3 30 0 0
""")
found = lammpsio.DataFile("data").read()
print("velocities of atoms:", {int(atom): float(v) for atom, v in sorted(zip(found.id, found.velocity[:, 0]))})
END

seen=$(venv/bin/python grains.py)
expected='lammpsio 0.9.0
SI, dump: overlap 0.00 of 3 nm, mass 0.0 of 11.1 micrograms, box 1.2350000 of 1.2345678 mm
SI, data: overlap 0.00 of 3 nm, mass 11.1 of 11.1 micrograms, box 1.2345678 of 1.2345678 mm
mm and micrograms, dump: overlap 3.00 of 3 nm, mass 11.1 of 11.1 micrograms, box 1.2345680 of 1.2345678 mm
mm and micrograms, data: overlap 3.00 of 3 nm, mass 11.1 of 11.1 micrograms, box 1.2345678 of 1.2345678 mm
velocities of atoms: {1: 20.0, 2: 30.0, 3: 10.0}'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
