#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# GrainSizeTools 3.2.1 (PyPI grainsizetools-jwestraadt): sizes of spheres from the circles in a plane section, by Saltykov's method.
#
# Guess: the unfolded frequencies are shares of the number of grains, as of "the actual 3D grain size population": for equal
#        numbers of two sizes a half each, to the few per cent that classes cost, and their volumes follow from them.
# Seen:  the smaller of two sizes, 10 and 20, gets 0.41 for 0.50, with 10 and 40 it gets 0.32, and a third of grains of 10 beside
#        20 and 40 comes out as 0.21. Circles of larger spheres are taken out of the smaller classes as they should be, but what is
#        left in a class is not divided by the size, though a plane meets a grain in proportion to it, nor by the share of its
#        circles that fall into its own class. With both the numbers are right. No warning, and no word of it.
# For us: sizes here are those of the discs themselves. Sections of sands set in resin: divide each frequency by its diameter and
#        by the share of its circles that fall into its own class, as below, and scale to 1.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile grainsizetools-jwestraadt==3.2.1 numpy==2.4.6 scipy==1.17.1 pandas==3.1.1 matplotlib==3.11.2

cat >section.py <<'END'
from contextlib import redirect_stdout
from importlib.metadata import version
from io import StringIO

import matplotlib
import numpy as np

matplotlib.use("Agg")
with redirect_stdout(StringIO()):
    from grain_size_tools import stereology

print("grainsizetools-jwestraadt", version("grainsizetools-jwestraadt"))
CLASSES, CIRCLES = 20, 200_000
rng = np.random.default_rng(0)


def circles(sizes, numbers):
    """Diameters of circles in a plane through spheres: it meets them in proportion to their sizes, at any height alike."""
    met = np.multiply(sizes, numbers)
    diameters = rng.choice(sizes, CIRCLES, p=met / met.sum())
    return diameters * np.sqrt(1 - rng.random(CIRCLES) ** 2)


def text(shares):
    return "/".join(f"{share:.2f}" for share in shares / shares.sum())


for sizes, numbers in ((10, 20), (1, 1)), ((10, 20), (8, 2)), ((10, 40), (1, 1)), ((10, 20, 40), (1, 1, 1)):
    middle, frequency = stereology.Saltykov(circles(sizes, numbers), numbins=CLASSES, return_data=True)
    width = middle[1] - middle[0]
    bottom, top = middle - width / 2, middle + width / 2
    own = np.sqrt(1 - (bottom / top) ** 2)  # share of the circles of a sphere of the size top that fall into its class
    of_size = [(middle > 0.82 * size) & (middle < 1.1 * size) for size in sizes]
    found, divided = (np.array([share[here].sum() for here in of_size]) for share in (frequency, frequency / top / own))
    print(f"sizes {sizes}, numbers {text(np.array(numbers))}: found {text(found)}, divided {text(divided)}")
END

seen=$(venv/bin/python section.py)
expected='grainsizetools-jwestraadt 3.2.1
sizes (10, 20), numbers 0.50/0.50: found 0.41/0.59, divided 0.50/0.50
sizes (10, 20), numbers 0.80/0.20: found 0.74/0.26, divided 0.80/0.20
sizes (10, 40), numbers 0.50/0.50: found 0.32/0.68, divided 0.50/0.50
sizes (10, 20, 40), numbers 0.33/0.33/0.33: found 0.21/0.32/0.46, divided 0.33/0.34/0.34'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
