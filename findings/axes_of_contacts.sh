#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# pycircstat2 0.1.15: summary of directions that have no sense, such as those of contacts, by Axial.
#
# Guess: all angles of the summary are of the directions given, as the mean is: for axes spread evenly about 30 degrees the median
#        is near 30, too, and lies in its interval beside the mean in its own.
# Seen:  angles are doubled for the analysis, and of the results only the mean and its interval are halved. Beside a mean of 30 the
#        summary tells a median of 60 with an interval from 56 to 64, and deviations that are twice as large as those of the axes.
#        No word of it.
# For us: directions of contacts and of long axes of grains are such axes. Halve median, median_lb, median_ub, s and s0 by hand.
#        Fabric of the tools is a tensor, which has no such question.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile pycircstat2==0.1.15 numpy==2.4.6 scipy==1.17.1 pandas==3.1.1 matplotlib==3.11.2

cat >axes.py <<'END'
from importlib.metadata import version

import numpy as np
from pycircstat2 import Axial
from scipy.special import ndtri

print("pycircstat2", version("pycircstat2"))
for centre in 30, 70:
    axes = (centre + 15 * ndtri((np.arange(400) + 0.5) / 400)) % 180
    found = Axial(axes, unit="degree")
    print(f"axes about {centre} with a standard deviation of 15 degrees:", end=" ")
    print(", ".join(f"{name} {np.degrees(getattr(found, name)):.0f}" for name in
                    ("mean", "mean_lb", "mean_ub", "median", "median_lb", "median_ub", "s0")))
END

seen=$(venv/bin/python axes.py)
expected='pycircstat2 0.1.15
axes about 30 with a standard deviation of 15 degrees: mean 30, mean_lb 29, mean_ub 31, median 60, median_lb 56, median_ub 64, s0 30
axes about 70 with a standard deviation of 15 degrees: mean 70, mean_lb 69, mean_ub 71, median 140, median_lb 136, median_ub 144, s0 30'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
