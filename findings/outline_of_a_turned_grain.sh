#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# pyefd 1.8.0: normalised elliptic Fourier descriptors of the outline of a grain.
#
# Guess: they are the same however the grain lies, moved, turned or enlarged, and start with 1, 0, 0, as the manual says, so that
#        these three are left out of the features. At most the two ends of the long axis may be taken for each other.
# Seen:  turned by half a turn, a grain has all of them with the other sign, and -1 in front. Which sign comes depends on how the
#        long axis lies, and on where the outline starts: without the first three, grains of one shape fall into two groups,
#        opposite to each other, and the mean of 360 orientations is 0 for every one. No word of it.
# For us: shapes of real grains come from such outlines; models here are of discs. Multiply by coeffs[0, 0], and, for the two ends
#        of the axis, the rows of even harmonics by the sign of one of them that is not near 0: one shape then has one set.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile pyefd==1.8.0 numpy==2.4.6

cat >outline.py <<'END'
from importlib.metadata import version

import numpy as np
from pyefd import elliptic_fourier_descriptors

print("pyefd", version("pyefd"))
grain = np.array([[0, 0], [4, 0], [5, 1.5], [3, 3], [0.5, 2]])


def descriptors(degrees, start=0):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    outline = np.roll(grain, -start, axis=0) @ [[c, s], [-s, c]]
    return elliptic_fourier_descriptors(outline, order=4, normalize=True)


def show(name, coeffs):
    print(f"{name}: first {coeffs[0, 0]:.0f}, then {np.round(coeffs.ravel()[3:8], 3).tolist()}")


def mended(coeffs):
    coeffs = coeffs * coeffs[0, 0]
    coeffs[1::2] *= np.sign(coeffs[1, 2])
    return coeffs


for degrees in 0, 120, 180, 300:
    show(f"turned by {degrees}", descriptors(degrees))
show("started at the third corner", descriptors(0, 2))
turned = [descriptors(degrees) for degrees in range(360)]
print("largest mean of 360 orientations:", f"{abs(np.mean(turned, axis=0)).max():.3f}")
everyone = [mended(descriptors(degrees, start)) for degrees in range(0, 360, 7) for start in range(5)]
print("mended, all the same:", np.allclose(everyone, everyone[0], atol=1e-12))
END

seen=$(venv/bin/python outline.py)
expected='pyefd 1.8.0
turned by 0: first -1, then [-0.65, -0.012, -0.031, -0.064, 0.033]
turned by 120: first -1, then [-0.65, -0.012, -0.031, -0.064, 0.033]
turned by 180: first 1, then [0.65, 0.012, 0.031, 0.064, -0.033]
turned by 300: first 1, then [0.65, 0.012, 0.031, 0.064, -0.033]
started at the third corner: first 1, then [0.65, -0.012, -0.031, -0.064, 0.033]
largest mean of 360 orientations: 0.000
mended, all the same: True'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
