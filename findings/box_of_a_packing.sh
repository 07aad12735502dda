#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# peclet.dem 1.1.0 (PyPI peclet-dem): the box of a packing in a dump file of LAMMPS, by export_lammps.
#
# Guess: the box in the file is the domain of set_domain, periodic where the domain is, and places and radii are those of the grains
#        to the precision they have (single).
# Seen:  the box is the extent of the grains, spheres and all, made 10 % longer, whatever the domain: a solid fraction of 0.52 reads
#        as 0.39, and so does the 0.26 of a bed that fills half of its domain. If one side is periodic all three are told to be ("pp pp
#        pp"): grains that touch across a side of the cell are two diameters apart across a side of the file. Numbers have six
#        decimals, so that in SI places in a powder of 9.4 micrometres are whole micrometres, and its radius is 6 % too large. No
#        warning, and no word of it. Restitution by both engines, and rolling after a slide, are right.
# For us: packings of others come as such dumps, and dumps of the decks are written by LAMMPS, with the box of the model. Take origin,
#        extent, periodic, get_positions and get_scales, and write the file by hand.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q peclet-dem==1.1.0 numpy==2.4.6

cat >box.py <<'END'
import importlib.metadata
import math

import numpy as np
from peclet import dem

print("peclet-dem", importlib.metadata.version("peclet-dem"))


def show(name, radius, layers, periodic):
    """Touching spheres of a cubic lattice, 10 x 10 x layers, in a domain of 10 x 10 x 10."""
    length = 20 * radius
    sim = dem.Simulation(capacity=8000)
    sim.initialize_shape("sphere", 1.0)
    sim.set_global_scale(radius)
    sim.set_domain(extent=(length,) * 3, origin=(0, 0, 0), periodic=periodic)
    places = (np.indices((10, 10, layers)).reshape(3, -1).T * 2 + 1) * radius
    sim.set_positions(places.astype(np.float32))
    sim.set_scales_uniform(1.0)
    sim.export_lammps("grains.dump", 0)
    lines = open("grains.dump").read().splitlines()
    low, high = np.array([line.split() for line in lines[5:8]], float).T
    read = np.array([line.split()[2:6] for line in lines[9:]], float)
    solid = len(read) * 4 / 3 * math.pi * radius**3
    across = read[:, 0].min() + (high - low)[0] - read[:, 0].max()  # from the last grain to the first, across the side
    gaps = np.diff(np.unique(np.sort(read[:, 0])))
    print(f"{name}: {lines[4][6:]}; box / domain {np.round((high - low) / length, 2).tolist()};",
          f"solid fraction {solid / length**3:.2f}, in the file {solid / (high - low).prod():.2f};",
          f"neighbours, in diameters: inside {gaps.min() / radius / 2:.2f} to {gaps.max() / radius / 2:.2f},",
          f"across the side {across / radius / 2:.2f}; radius {read[0, 3] / radius:.2f}")


show("sand", 0.001, 10, (True, True, True))
show("bed", 0.001, 5, (True, True, False))
show("powder", 4.7e-6, 10, (True, True, True))
END

seen=$(OMP_NUM_THREADS=1 OMP_PROC_BIND=false venv/bin/python box.py)
expected='peclet-dem 1.1.0
sand: BOX BOUNDS pp pp pp; box / domain [1.1, 1.1, 1.1]; solid fraction 0.52, in the file 0.39; neighbours, in diameters: inside 1.00 to 1.00, across the side 2.00; radius 1.00
bed: BOX BOUNDS pp pp pp; box / domain [1.1, 1.1, 0.55]; solid fraction 0.26, in the file 0.39; neighbours, in diameters: inside 1.00 to 1.00, across the side 2.00; radius 1.00
powder: BOX BOUNDS pp pp pp; box / domain [1.1, 1.1, 1.1]; solid fraction 0.52, in the file 0.39; neighbours, in diameters: inside 0.96 to 1.06, across the side 2.06; radius 1.06'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
