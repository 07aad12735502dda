#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Mahotas 1.4.19: roundness of a grain in an image.
#
# Guess: mahotas.features.roundness is perimeter^2 / (4 pi area), 1 for a disc and more for any other shape, to the few per cent
#        that pixels cost, however the grain lies.
# Seen:  the perimeter is the number of pixels on the border, which makes a slanted side up to 30 % too short: a disc has 0.81, a
#        square 1.26, and 0.63 when it is turned by 45 degrees: "rounder" than the disc. The manual says "Roundness".
# For us: nothing here reads images. Of grains in images take perimeters that know directions: skimage.measure.perimeter_crofton, or
#        for a disc at least, mahotas.labeled.perimeter, 5 % too long.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile mahotas==1.4.19 numpy==2.4.6 scikit-image==0.26.0

cat >roundness.py <<'END'
import mahotas
import numpy as np
from skimage.measure import perimeter_crofton

print("mahotas", mahotas.__version__)
x, y = (np.mgrid[:500, :500] - 249.7).reshape(2, 500, 500)
shapes = {"disc": (x**2 + y**2 < 150**2, 1)}
for degrees in 0, 22.5, 45:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    shapes[f"square turned by {degrees}"] = (np.maximum(abs(x * c + y * s), abs(y * c - x * s)) < 150, 4 / np.pi)
for name, (image, true) in shapes.items():
    other = perimeter_crofton(image) ** 2 / (4 * np.pi * image.sum())
    labeled = mahotas.labeled.perimeter(image) ** 2 / (4 * np.pi * image.sum())
    print(f"{name}: true {true:.2f}, mahotas {mahotas.features.roundness(image):.2f},",
          f"by its perimeter {labeled:.2f}, by that of scikit-image {other:.2f}")
END

seen=$(venv/bin/python roundness.py)
expected='mahotas 1.4.19
disc: true 1.00, mahotas 0.81, by its perimeter 1.11, by that of scikit-image 1.00
square turned by 0: true 1.27, mahotas 1.26, by its perimeter 1.26, by that of scikit-image 1.14
square turned by 22.5: true 1.27, mahotas 1.08, by its perimeter 1.48, by that of scikit-image 1.34
square turned by 45: true 1.27, mahotas 0.63, by its perimeter 1.27, by that of scikit-image 1.14'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
