#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# AMEP 1.3.0 (amep): bond order and neighbours of discs in a box with periodic sides.
#
# Guess: in a perfect triangular lattice that fits its periodic box |psi_6| of psi_k is 1 for every disc, and the six neighbours that
#        next_neighbors names are those at the distances it tells.
# Seen:  discs away from the sides have 1, the 38 of 200 at the sides as little as 0.34, though they have the same surroundings: the
#        neighbour across the side is found, but the bond seems to go to its place on this side. next_neighbors counts six for each,
#        with right distances, but names other discs for 104 of 1200: some of the images of the box are kept, and their numbers are
#        read as if all were. No warning: periodic boundaries are the default of both.
# For us: a shear box has walls, but packings and shear cells are periodic. Take psi_k of amep.pbc.pbc_points(coords, box,
#        thickness=...) with pbc=False, and of that the first rows; and next_neighbors with width=1. Or freud.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile amep==1.3.0 numpy==2.4.6 scipy==1.17.1 numba==0.68.1 h5py==3.16.0 matplotlib==3.11.2 \
  scikit-image==0.26.0 gsd==5.0.1 chemfiles==0.10.4

cat >lattice.py <<'END'
import logging

logging.disable(logging.INFO)
from importlib.metadata import version

import amep
import numpy as np

print("amep", version("amep"))
box = np.array([[0, 10], [0, 10 * np.sqrt(3)], [-0.5, 0.5]])
row, column = np.mgrid[:20, :10].reshape(2, -1)
discs = np.c_[column + row % 2 / 2 + 0.25, (row + 0.5) * np.sqrt(3) / 2, np.zeros(200)]

images = amep.pbc.pbc_points(discs, box, thickness=3)
for name, order in ("periodic", amep.order.psi_k(discs, box)), ("images", amep.order.psi_k(images, box, pbc=False)[:200]):
    order = abs(order)
    print(f"{name}: |psi_6| least {order.min():.2f}, mean {order.mean():.2f}, {(order < 0.999).sum()} of 200 below 1")
length = box[:, 1] - box[:, 0]
for width in 0.5, 1:
    number, distances, neighbours, *_ = amep.order.next_neighbors(discs, box, width=width)
    apart = discs[np.concatenate(neighbours).astype(int)] - np.repeat(discs, number, axis=0)
    apart = np.linalg.norm(apart - length * np.round(apart / length), axis=1)
    print(f"width {width}: {set(number.tolist())} neighbours, distances {min(map(min, distances)):.2f} to",
          f"{max(map(max, distances)):.2f}, of discs at other distances {(apart > 1.01).sum()} of {number.sum()}")
END

seen=$(venv/bin/python lattice.py)
expected='amep 1.3.0
periodic: |psi_6| least 0.34, mean 0.93, 38 of 200 below 1
images: |psi_6| least 1.00, mean 1.00, 0 of 200 below 1
width 0.5: {6} neighbours, distances 1.00 to 1.00, of discs at other distances 104 of 1200
width 1: {6} neighbours, distances 1.00 to 1.00, of discs at other distances 0 of 1200'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
