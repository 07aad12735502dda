#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# photoelastimetry 0.6.0: degree and angle of linear polarisation of an image of photoelastic grains.
#
# Guess: of light that is polarised in full the degree, DoLP, is 1, and the angle, AoLP, is that of the light, if the image comes
#        from split_channels of the same package.
# Seen:  split_channels hands on the intensities at 0, 45, 90 and 135 degrees in this order, DoLP and AoLP take them for 0, 90, 45
#        and 135: light of every angle gets one of two angles, 67.5 and 157.5 degrees, and a degree from 0 to 0.5 that tells of its
#        angle. In the order they expect the angle is right, and the degree half the true one: the sum of all four intensities is
#        twice that of the light. No warning, and no word of an order.
# For us: forces between photoelastic discs are what two-dimensional tests are compared with. Take compute_stokes_components of the
#        same package with the four channels of split_channels: both are right.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile --no-deps photoelastimetry==0.6.0 numpy==2.4.6 tqdm==4.70.1

cat >light.py <<'END'
from importlib.metadata import version

import numpy as np
from photoelastimetry.image import AoLP, DoLP, compute_stokes_components
from photoelastimetry.io import split_channels

print("photoelastimetry", version("photoelastimetry"))
filters = np.array([[0, 45], [135, 90]])  # degrees: four pixels of the camera


def both(degree, angle):
    return f"{degree[0, 0, 0]:.2f} at {np.degrees(angle[0, 0, 0]) % 180:.1f}"


for degree, angle in (1, 10), (1, 20), (1, 70), (1, 110), (0.4, 70):
    pixels = (1 + degree * np.cos(2 * np.radians(angle - filters))) / 2
    image = split_channels(np.tile(pixels, (4, 4)))
    s0, s1, s2 = compute_stokes_components(*np.moveaxis(image, -1, 0))
    other = image[..., [0, 2, 1, 3]]
    print(f"true {degree:.2f} at {angle:.1f} degrees: DoLP at AoLP {both(DoLP(image), AoLP(image))},",
          f"in the other order {both(DoLP(other), AoLP(other))},",
          f"by Stokes components {both(np.hypot(s1, s2) / s0, np.arctan2(s2, s1) / 2)}")
END

seen=$(venv/bin/python light.py)
expected='photoelastimetry 0.6.0
true 1.00 at 10.0 degrees: DoLP at AoLP 0.21 at 157.5, in the other order 0.50 at 10.0, by Stokes components 1.00 at 10.0
true 1.00 at 20.0 degrees: DoLP at AoLP 0.04 at 157.5, in the other order 0.50 at 20.0, by Stokes components 1.00 at 20.0
true 1.00 at 70.0 degrees: DoLP at AoLP 0.50 at 67.5, in the other order 0.50 at 70.0, by Stokes components 1.00 at 70.0
true 1.00 at 110.0 degrees: DoLP at AoLP 0.04 at 67.5, in the other order 0.50 at 110.0, by Stokes components 1.00 at 110.0
true 0.40 at 70.0 degrees: DoLP at AoLP 0.20 at 67.5, in the other order 0.20 at 70.0, by Stokes components 0.40 at 70.0'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
