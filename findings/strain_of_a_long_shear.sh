#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# AL-DIC 1.0.3 (PyPI al-dic, pyALDIC): large strains of an image by compute_strain, of Almansi's measure (strain_type=1).
#
# Guess: of a uniform deformation each strain measure has its closed form: 0 for a rigid rotation, (1 - 1/l^2) / 2 for a stretch l
#        by Almansi and (l^2 - 1) / 2 by Green; in simple shear both have a normal strain along the thickness.
# Seen:  so it is with Green. "Eulerian-Almansi" makes a strain of -0.043 of a rotation by 17 degrees, 0.25 of a stretch of 1.2,
#        where 0.153 is right, and simple shear has no normal strain. Each normal component h of the gradient becomes h / (1 - h),
#        whatever the others are. The source names the right formula, (I - F^-T F^-1) / 2, above its own. No warning.
# For us: in a shear band strains are large and grains turn: volume would seem to be lost by rotation alone. Take strain_type=2
#        (Green), and Almansi's by hand from displacement gradients, which are those of strain_type=0 only: with 1 and 2 dudx and
#        its like hold strains, too. Infinitesimal strains, Green's, invariants and sides of the field are right.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile numpy==2.4.6 scipy==1.17.1 numba==0.68.1 opencv-python-headless==5.0.0.93
# without its other requirements, which are those of its window (Qt, 500 MB)
venv/bin/pip install -q --no-compile --no-deps al-dic==1.0.3
export NUMBA_CACHE_DIR=$work/numba

cat >strain.py <<'END'
from importlib.metadata import version

import numpy as np
from al_dic.core.config import dicpara_default
from al_dic.core.data_structures import GridxyROIRange
from al_dic.mesh.mesh_setup import mesh_setup
from al_dic.strain.compute_strain import compute_strain
from al_dic.utils.region_analysis import precompute_node_regions

print("al-dic", version("al-dic"))
MEASURES = "infinitesimal", "Almansi", "Green"
angle = 0.3
size = (129, 129)
along = np.arange(16, 113, 8.0)


def settings(measure):
    roi = GridxyROIRange((16, 112), (16, 112))
    return dicpara_default(strain_type=MEASURES.index(measure), method_to_compute_strain=2, img_size=size, winstepsize=8,
                           winsize=16, gridxy_roi_range=roi, img_ref_mask=np.ones(size))


mesh = mesh_setup(along, along, settings("Green"))
regions = precompute_node_regions(mesh.coordinates_fem, np.ones(size), size)
identity = np.eye(2)
for name, gradient in (("rotation by 17 degrees", [[np.cos(angle) - 1, -np.sin(angle)], [np.sin(angle), np.cos(angle) - 1]]),
                       ("stretch 1.2 and 0.9", [[0.2, 0], [0, -0.1]]), ("simple shear 0.5", [[0, 0.5], [0, 0]])):
    gradient = np.array(gradient)
    moved = (mesh.coordinates_fem - 64) @ gradient.T
    inverse = np.linalg.inv(identity + gradient)
    known = {"infinitesimal": (gradient + gradient.T) / 2, "Almansi": (identity - inverse.T @ inverse) / 2,
             "Green": (gradient + gradient.T + gradient.T @ gradient) / 2}
    for measure in MEASURES:
        found = compute_strain(mesh, settings(measure), moved.ravel(), regions)
        parts = np.array([found.strain_exx, found.strain_eyy, -found.strain_exy])  # told for a y axis upwards
        assert np.ptp(parts, axis=1).max() < 1e-6
        xx, yy, xy = np.round(parts.mean(axis=1), 3) + 0.0
        right = np.round(known[measure], 3) + 0.0
        print(f"{name}, {measure}: xx {xx}, yy {yy}, xy {xy}; right {right[0, 0]}, {right[1, 1]}, {right[0, 1]}")
END

seen=$(venv/bin/python strain.py)
expected='al-dic 1.0.3
rotation by 17 degrees, infinitesimal: xx -0.045, yy -0.045, xy 0.0; right -0.045, -0.045, 0.0
rotation by 17 degrees, Almansi: xx -0.043, yy -0.043, xy 0.0; right 0.0, 0.0, 0.0
rotation by 17 degrees, Green: xx 0.0, yy 0.0, xy 0.0; right 0.0, 0.0, 0.0
stretch 1.2 and 0.9, infinitesimal: xx 0.2, yy -0.1, xy 0.0; right 0.2, -0.1, 0.0
stretch 1.2 and 0.9, Almansi: xx 0.25, yy -0.091, xy 0.0; right 0.153, -0.117, 0.0
stretch 1.2 and 0.9, Green: xx 0.22, yy -0.095, xy 0.0; right 0.22, -0.095, 0.0
simple shear 0.5, infinitesimal: xx 0.0, yy 0.0, xy 0.25; right 0.0, 0.0, 0.25
simple shear 0.5, Almansi: xx 0.0, yy 0.0, xy 0.25; right 0.0, -0.125, 0.25
simple shear 0.5, Green: xx 0.0, yy 0.125, xy 0.25; right 0.0, 0.125, 0.25'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
