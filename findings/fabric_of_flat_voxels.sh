#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# fabrictensor 1.0.2: fabric of grains in an image whose slices lie farther apart than its pixels.
#
# Guess: with voxel_spacing compute_fabric gives the same fabric whatever the shape of a voxel: a third in each direction for equal
#        spheres in places by chance, to 0.05, by all of its methods.
# Seen:  true of MIL, SVD and INTERCEPTS. Of every second slice, with a spacing of 2, SKELETON finds 0.55 across the slices and
#        0.22 along them, farther off than without the spacing and to the other side; and S2 finds 0 across the slices, the same to
#        the last digit as without the spacing, which it does not take. No warning: of the other arguments the manual says which
#        methods use them, of this one it does not.
# For us: fabric of real sands comes from such images; here it is that of contacts and of areas. Scale the image to cubic voxels
#        first, or take one of the three methods that are right.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile fabrictensor==1.0.2 numpy==2.4.6 scipy==1.17.1 scikit-image==0.26.0 pillow==13.0.0 matplotlib==3.11.2

cat >fabric.py <<'END'
from contextlib import redirect_stdout
from importlib.metadata import version
from io import StringIO

import fabrictensor
import numpy as np

print("fabrictensor", version("fabrictensor"))
SIZE, RADIUS = 96, 8
grid = np.mgrid[:SIZE, :SIZE, :SIZE]
spheres = np.zeros((SIZE, SIZE, SIZE), np.uint8)
for centre in np.random.default_rng(0).uniform(-6, SIZE + 6, (260, 3)):
    spheres[((grid - centre[:, None, None, None]) ** 2).sum(axis=0) <= RADIUS**2] = 1
directions = fabrictensor.fibonacci_sphere(257)
for method in "MIL", "SVD", "INTERCEPTS", "SKELETON", "S2":
    found = []
    for image, spacing in (spheres, 1), (spheres[::2], 2), (spheres[::2], 1):
        with redirect_stdout(StringIO()):
            result = fabrictensor.compute_fabric(
                method, image, np.ones(image.shape, bool), directions, n_rays=400, n_points=800, voxel_spacing=(spacing, 1, 1)
            )
        fabric = np.diag(result["M2"]) / np.trace(result["M2"])  # along x, y and z
        found.append("/".join(f"{share + 0:.2f}" for share in fabric))
    print(f"{method}: all slices {found[0]}; every second {found[1]}, and without its spacing {found[2]}")
END

seen=$(venv/bin/python fabric.py)
expected='fabrictensor 1.0.2
MIL: all slices 0.33/0.32/0.34; every second 0.35/0.33/0.32, and without its spacing 0.47/0.43/0.10
SVD: all slices 0.33/0.33/0.34; every second 0.33/0.33/0.35, and without its spacing 0.41/0.40/0.19
INTERCEPTS: all slices 0.34/0.33/0.33; every second 0.31/0.33/0.35, and without its spacing 0.43/0.45/0.13
SKELETON: all slices 0.34/0.33/0.33; every second 0.23/0.22/0.55, and without its spacing 0.36/0.35/0.29
S2: all slices 0.33/0.34/0.33; every second 0.50/0.50/0.00, and without its spacing 0.50/0.50/0.00'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
