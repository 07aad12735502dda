#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# SPAM 0.9.1 (spam, Software for the Practical Analysis of Materials): strain from displacements on a grid, by FfieldRegularGeers.
#
# Guess: a uniform deformation is found exactly, inside and at the sides of the grid: the way of Geers fits a linear field to the
#        nodes around each node, and linear the displacements are.
# Seen:  so it is inside. On the outermost nodes of a specimen that is compressed by 1 % everywhere the volumetric strain goes from
#        -2.8 % to +2.5 %, as if some of its edges dilated; on those of a plane grid from -9.9 % to +8.0 %. The mean over a large
#        grid hides it, and a rigid motion shows nothing of it. It looks as if sums over neighbours that lie on one side only were
#        divided as if they lay on all sides. No warning, and no word of it. FfieldRegularQ8 is right everywhere.
# For us: strain beside the walls and the gap is what one looks for in a shear box, and what such fields of real tests are compared
#        with. Take FfieldRegularQ8, or leave out all nodes within the radius of a side (the script spam-regularStrain has both
#        ways).
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile spam==0.9.1 spambind==0.9 numpy==2.4.6 scipy==1.17.1 scikit-image==0.26.0 numba==0.68.1

cat >strain.py <<'END'
from importlib.metadata import version

import numpy as np
import spam.deformation

print("spam", version("spam"))
NODES, SPACING = 9, 10.0
along = np.arange(NODES) * SPACING
UNIFORM = np.diag([1, 0.99, 1])  # compressed by 1 % along the second axis
SIDE = np.ones((NODES, NODES, NODES), bool)
SIDE[1:-1, 1:-1, 1:-1] = False

for name, first in ("specimen", along), ("plane", np.zeros(1)):
    nodes = np.stack(np.meshgrid(first, along, along, indexing="ij"), axis=-1)
    moved = nodes @ (UNIFORM - np.eye(3)).T
    side = SIDE if len(first) > 1 else SIDE[4:5]
    for way in "Q8", "Geers":
        found = getattr(spam.deformation, f"FfieldRegular{way}")(moved, [SPACING] * 3)
        volumetric = 100 * (np.linalg.det(found) - 1)
        places = {"inside": volumetric[~side], "sides": volumetric[side]} if way == "Geers" else {"cells": volumetric}
        for place, strain in places.items():
            strain = strain + 0.0
            print(f"{name}, {way}, {place}: volumetric strain {strain.min():.2f} to {strain.max():.2f} %, mean {strain.mean():.2f} %")
rigid = np.zeros((NODES, NODES, NODES, 3)) + [0, 5, 0]
print(f"rigid motion, Geers: {abs(spam.deformation.FfieldRegularGeers(rigid, [SPACING] * 3) - np.eye(3)).max():.6f}")
END

seen=$(venv/bin/python strain.py)
expected='spam 0.9.1
specimen, Q8, cells: volumetric strain -1.00 to -1.00 %, mean -1.00 %
specimen, Geers, inside: volumetric strain -1.00 to -1.00 %, mean -1.00 %
specimen, Geers, sides: volumetric strain -2.79 to 2.54 %, mean -1.01 %
plane, Q8, cells: volumetric strain -1.00 to -1.00 %, mean -1.00 %
plane, Geers, inside: volumetric strain -1.00 to -1.00 %, mean -1.00 %
plane, Geers, sides: volumetric strain -9.91 to 8.00 %, mean -0.96 %
rigid motion, Geers: 0.000000'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
