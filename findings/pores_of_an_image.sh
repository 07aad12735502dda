#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# PoreSpy 3.2.0: distributions of pores in an image with voxel_size.
#
# Guess: densities are per unit of length, so that pdf times width adds up to 1 whatever the size of a voxel, as the manual defines
#        them; two points close to each other are both in the pores with a probability near the porosity, as it says, too.
# Seen:  two functions of four scale lengths with voxel_size, and not densities, which add up to the size of a voxel. Chords
#        weighted by their lengths add up to 1.38 for voxels of 0.01 mm, so that their mean is too large by that, and to NaN if
#        the size is given in metres. `probability` of the correlation starts at 1. No warning. Pore sizes, and chords by count, are
#        right.
# For us: for pores in pictures of specimens, or between discs drawn as pixels: leave voxel_size at 1 and scale what comes out,
#        which the manual allows, and take `probability_scaled`.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile porespy==3.2.0 numpy==1.26.4 scipy==1.17.1 numba==0.68.1

cat >pores.py <<'END'
import warnings

warnings.filterwarnings("ignore", message=".*filled_area")  # of scikit-image
import numpy as np
import porespy
from porespy import filters, metrics
from scipy.ndimage import distance_transform_edt, label

print("porespy", porespy.__version__)
random = np.random.default_rng(1)
y, x = np.mgrid[:200, :200]
pores = np.ones((200, 200), bool)
for _ in range(30):
    at, radius = random.uniform(0, 200, 2), random.uniform(8, 20)
    pores &= (x - at[0]) ** 2 + (y - at[1]) ** 2 > radius**2
chords = filters.apply_chords(pores, axis=1, spacing=3)
lengths = np.bincount(label(chords)[0].ravel())[1:]
weighted = (lengths**2).sum() / lengths.sum()
print(f"porosity {pores.mean():.2f}; chords in voxels: mean {lengths.mean():.0f}, by length {weighted:.0f}")
for voxel in 1, 0.01, 1e-5:
    found = {
        "sizes": metrics.pore_size_distribution(filters.local_thickness(pores), bins=20, log=False, voxel_size=voxel),
        "radial": metrics.radial_density_distribution(distance_transform_edt(pores), bins=20, voxel_size=voxel),
        "lineal path": metrics.lineal_path_distribution(filters.distance_transform_lin(pores), bins=20, voxel_size=voxel),
        "chords": metrics.chord_length_distribution(chords, bins=20, voxel_size=voxel),
        "chords by length": metrics.chord_length_distribution(chords, bins=20, voxel_size=voxel, normalization="length"),
    }
    print(f"voxel {voxel:g}: sums", *(f"{name} {(f.pdf * f.bin_widths).sum():.3g}," for name, f in found.items()), end=" ")
    means = [(f.pdf * f.bin_widths * f.bin_centers).sum() / voxel for name, f in found.items() if "chords" in name]
    print("means of chords", *(f"{mean:.0f}" for mean in means))
nearest = metrics.two_point_correlation(pores)
print(f"two points {nearest.distance[0]} apart: probability {nearest.probability[0]:.2f},",
      f"scaled {nearest.probability_scaled[0]:.2f}")
END

seen=$(venv/bin/python pores.py)
expected='porespy 3.2.0
porosity 0.54; chords in voxels: mean 35, by length 63
voxel 1: sums sizes 1, radial 1, lineal path 1, chords 1, chords by length 1, means of chords 35 64
voxel 0.01: sums sizes 1, radial 0.01, lineal path 0.01, chords 1, chords by length 1.38, means of chords 35 88
voxel 1e-05: sums sizes 1, radial 1e-05, lineal path 1e-05, chords 1, chords by length nan, means of chords 35 nan
two points 0.5 apart: probability 1.00, scaled 0.54'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
