#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Coal 3.0.3 (coal, once hpp-fcl): gap and overlap of small grains in SI units.
#
# Guess: gap and overlap of an ellipsoid and a sphere are those of the closed form to a part in a thousand of the grain or better,
#        for sand in m as for the same grains a thousand times as large.
# Seen:  so it is with an ellipsoid of 1 m (half its long axis). At 1 mm and 0.1 mm an overlap of a thousandth of that is 20 % too
#        small and a gap as wide 30 % too wide; at 10 micrometres grains that overlap by a hundredth have a gap of 4 %, and do not
#        touch. The tolerances of its iterations, 1e-6, know of no size: with smaller ones all is right. No warning.
# For us: contacts of the models are of discs, in closed form. With Coal: lengths in sizes of a grain, or gjk_tolerance and
#        epa_tolerance of every request as 1e-6 times that size.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile coal==3.0.3 numpy==2.4.6

cat >contact.py <<'END'
from importlib.metadata import version

import coal
import numpy as np

print("coal", version("coal"))
AXES, RADIUS = np.array([1, 0.6, 0.5]), 0.7
NORMAL = np.array([2, 2, 1]) / 3
SURFACE = AXES**2 * NORMAL / np.linalg.norm(AXES * NORMAL)  # where the ellipsoid has this normal


def found(size, gap, tolerance):
    """Gap, negative for an overlap, of ellipsoid and sphere along their common normal, in sizes."""
    place = coal.Transform3s(np.eye(3), size * (SURFACE + (RADIUS + gap) * NORMAL))
    request = coal.DistanceRequest()
    if tolerance:
        request.gjk_tolerance = request.epa_tolerance = tolerance
    shapes = coal.Ellipsoid(*size * AXES), coal.Sphere(size * RADIUS)
    return coal.distance(shapes[0], coal.Transform3s(), shapes[1], place, request, coal.DistanceResult()) / size


for size in 1, 1e-3, 1e-4, 1e-5:
    for name, tolerance in ("default", None), ("1e-6 of the size", 1e-6 * size):
        gaps = ", ".join(f"{found(size, gap, tolerance):.4f} for {gap}" for gap in (0.01, 0.001, -0.001, -0.01))
        print(f"grains of {size:g} m, tolerance {name}: {gaps}")
END

seen=$(venv/bin/python contact.py)
expected='coal 3.0.3
grains of 1 m, tolerance default: 0.0100 for 0.01, 0.0010 for 0.001, -0.0010 for -0.001, -0.0100 for -0.01
grains of 1 m, tolerance 1e-6 of the size: 0.0100 for 0.01, 0.0010 for 0.001, -0.0010 for -0.001, -0.0100 for -0.01
grains of 0.001 m, tolerance default: 0.0103 for 0.01, 0.0013 for 0.001, -0.0008 for -0.001, -0.0098 for -0.01
grains of 0.001 m, tolerance 1e-6 of the size: 0.0100 for 0.01, 0.0010 for 0.001, -0.0010 for -0.001, -0.0100 for -0.01
grains of 0.0001 m, tolerance default: 0.0103 for 0.01, 0.0013 for 0.001, -0.0008 for -0.001, -0.0098 for -0.01
grains of 0.0001 m, tolerance 1e-6 of the size: 0.0100 for 0.01, 0.0010 for 0.001, -0.0010 for -0.001, -0.0100 for -0.01
grains of 1e-05 m, tolerance default: 0.0573 for 0.01, 0.0492 for 0.001, 0.0474 for -0.001, 0.0392 for -0.01
grains of 1e-05 m, tolerance 1e-6 of the size: 0.0100 for 0.01, 0.0010 for 0.001, -0.0010 for -0.001, -0.0100 for -0.01'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
