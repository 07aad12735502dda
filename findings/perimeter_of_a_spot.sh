#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# SPAM 0.9.1 (spam, Software for the Practical Analysis of Materials): perimeter of a grain in a binary image.
#
# Guess: spam.measurements.perimeter is the length of the border, to the few per cent that pixels cost: it grows with the grain,
#        and with the size of a pixel in either direction.
# Seen:  every square has 8.94 pixels, whatever its size: only its four corners count. A disc has 0.47 to 0.57 of its
#        circumference. Where pixels are not square the second of the two numbers of aspectRatio is not used. No warning, and the
#        manual says "The perimeter". Volume and surface area of the same module are right.
# For us: shapes of real grains come from such images; models here are of discs. Take skimage.measure.perimeter_crofton, or
#        surfaceArea of a stack of equal slices by its height.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile spam==0.9.1 spambind==0.9 numpy==2.4.6 scipy==1.17.1 scikit-image==0.26.0 numba==0.68.1

cat >perimeter.py <<'END'
from importlib.metadata import version
from math import pi

import numpy as np
import spam.measurements
from skimage.measure import perimeter_crofton

print("spam", version("spam"))
row, column = np.mgrid[:200, :200] - 100


def told(name, spot, true, **pixel):
    """Perimeter by SPAM beside the true one, and that by scikit-image for square pixels."""
    length = spam.measurements.perimeter(spot.astype(np.uint8), **pixel)
    other = "" if pixel else f", by scikit-image {perimeter_crofton(spot):.1f}"
    print(f"{name}: {length:.2f} for {true:.1f}{other}")


for radius in 10, 30, 60:
    told(f"disc of radius {radius}", row**2 + column**2 <= radius**2, 2 * pi * radius)
for side in 10, 20, 40:
    told(f"square of {side}", (0 <= row) & (row < side) & (0 <= column) & (column < side), 4 * side)
disc = row**2 + column**2 <= 30**2
for pixel in (1.0, 1.0), (2.0, 2.0), (1.0, 2.0), (2.0, 1.0):
    # A disc of 30 pixels in pixels of 1 by 2 is an ellipse, whose perimeter is 9.688448 times the shorter half axis.
    told(f"disc in pixels of {pixel}", disc, 30 * (9.688448 if pixel[0] != pixel[1] else 2 * pi * pixel[0]), aspectRatio=pixel)
END

seen=$(venv/bin/python perimeter.py)
expected='spam 0.9.1
disc of radius 10: 35.78 for 62.8, by scikit-image 65.2
disc of radius 30: 89.44 for 188.5, by scikit-image 190.2
disc of radius 60: 178.89 for 377.0, by scikit-image 377.8
square of 10: 8.94 for 40.0, by scikit-image 36.8
square of 20: 8.94 for 80.0, by scikit-image 74.7
square of 40: 8.94 for 160.0, by scikit-image 150.6
disc in pixels of (1.0, 1.0): 89.44 for 188.5
disc in pixels of (2.0, 2.0): 178.89 for 377.0
disc in pixels of (1.0, 2.0): 89.44 for 290.7
disc in pixels of (2.0, 1.0): 178.89 for 290.7'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
