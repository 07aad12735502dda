#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# imea 0.3.5: circles about a grain, and spreads of its lengths, from a binary image.
#
# Guess: the circumscribing circle of a disc of 100 pixels is 100 wide, as is the inscribing one, wherever in the image the disc
#        lies: the measures are called invariant to translation. With a resolution in mm per pixel all lengths are in mm.
# Seen:  both circles depend on where the grain lies: 71 and 128 pixels near one corner, 480 and 680 on the other side. Standard
#        deviations of lengths stay in pixels beside means in mm: "22 +- 62 mm" for a grain of 30 mm. No word of either, no warning.
# For us: shapes of real grains come from such images. Take diameter_min_enclosing_circle and diameter_max_inclosing_circle, which
#        are right, and multiply the columns that end in _std by the resolution. Models of grains here are discs, without images.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile imea==0.3.5 numpy==2.4.6 scipy==1.17.1 scikit-image==0.26.0 opencv-python-headless==5.0.0.93 \
  pandas==2.3.3

cat >circles.py <<'END'
from importlib.metadata import version

import imea
import numpy as np

print("imea", version("imea"))
rows, columns = np.mgrid[:400, :400]
for x, y in (60, 60), (340, 60), (200, 200):
    disc = (columns - x) ** 2 + (rows - y) ** 2 <= 50**2
    grain = imea.shape_measurements_2d(disc).iloc[0]
    print(f"disc of 100 pixels at {x}, {y}: circumscribing {grain.diameter_circumscribing_circle:.0f},",
          f"inscribing {grain.diameter_inscribing_circle:.0f},",
          f"smallest about it {grain.diameter_min_enclosing_circle:.0f},",
          f"largest in it {grain.diameter_max_inclosing_circle:.0f}")
ellipse = ((columns - 200) / 150) ** 2 + ((rows - 200) / 60) ** 2 <= 1
for resolution in 1, 0.1:
    grain = imea.shape_measurements_2d(ellipse, spatial_resolution_xy=resolution).iloc[0]
    print(f"ellipse, {resolution} mm per pixel: Feret diameter {grain.feret_mean:.1f} +- {grain.feret_std:.1f},",
          f"chords {grain.allchords_mean:.1f} +- {grain.allchords_std:.1f}")
END

seen=$(venv/bin/python circles.py 2>/dev/null)
expected='imea 0.3.5
disc of 100 pixels at 60, 60: circumscribing 128, inscribing 71, smallest about it 100, largest in it 100
disc of 100 pixels at 340, 60: circumscribing 680, inscribing 480, smallest about it 100, largest in it 100
disc of 100 pixels at 200, 200: circumscribing 523, inscribing 325, smallest about it 100, largest in it 100
ellipse, 1 mm per pixel: Feret diameter 220.6 +- 62.5, chords 119.0 +- 63.4
ellipse, 0.1 mm per pixel: Feret diameter 22.1 +- 62.5, chords 11.9 +- 63.4'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
