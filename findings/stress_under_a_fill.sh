#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# geotech-references 1.4.1: stress in the ground under a fill, by the table of Boussinesq's solutions in DM 7.1 (dm7_1.chapter4).
#
# Guess: with the angles that its manual names the stress is that of the integral of Boussinesq's line loads: half the load below
#        the edge of a wide fill, all of it far below the fill, and none far outside.
# Seen:  boussinesq_semi_infinite_load takes its angle "from the vertical"; with that it gives 0 below the edge, half the load far
#        inside, and a tension of half the load outside: half the load is missing everywhere, and only with the angle from the
#        ground outside is it right. boussinesq_terrace_load names its two angles the wrong way round: as told, a fill of 100 kPa
#        weighs 374 kPa where it is long level. No error, not even for a tension. Strip, rectangle and circle are right.
# For us: an overburden is a normal stress of the shear box. With this package: add pi / 2 to the angle of a semi-infinite load,
#        and give the terrace the angle over its slope as alpha and that over its level part as beta.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile geotech-references==1.4.1 numpy==2.4.6 scipy==1.17.1

cat >fill.py <<'END'
from importlib.metadata import version
from math import atan2, hypot, pi

from geotech_references.dm7_1 import chapter4
from scipy.integrate import quad

print("geotech-references", version("geotech-references"))
LOAD, DEPTH, SLOPE = 100.0, 2.0, 3.0  # kPa, m, m: the slope of the terrace rises from 0 to SLOPE


def integral(load, x, start):
    """Vertical stress below x of a load over the ground from start to infinity, as one of line loads."""
    line = lambda s: load(s) * 2 * DEPTH**3 / (pi * ((x - s) ** 2 + DEPTH**2) ** 2)
    return sum(quad(line, *ends)[0] for ends in ((start, SLOPE), (SLOPE, 30), (30, float("inf"))))


def seen_from(x, s):
    """Angle from the vertical at which the point below x sees the place s of the ground."""
    return atan2(s - x, DEPTH)


for x in -4.0, 0.0, 1.0, 12.0:
    edge = -seen_from(x, 0)  # from the vertical to the edge, positive below the load
    told, turned = (
        chapter4.boussinesq_semi_infinite_load(LOAD, x, DEPTH, hypot(x, DEPTH), angle) for angle in (edge, pi / 2 + edge)
    )
    print(f"wide fill, {x:g} m from its edge: {integral(lambda s: LOAD, x, 0):.1f}, as told {told:.1f}, from the ground {turned:.1f}")
for x in -1.0, 1.0, 6.0, 12.0:
    slope, level = seen_from(x, SLOPE) - seen_from(x, 0), pi / 2 - seen_from(x, SLOPE)
    told, swapped = (
        chapter4.boussinesq_terrace_load(LOAD, x, SLOPE, *angles) for angles in ((level, slope), (slope, level))
    )
    true = integral(lambda s: LOAD * min(s / SLOPE, 1), x, 0)
    print(f"terrace, {x:g} m from its toe: {true:.1f}, as told {told:.1f}, the other way round {swapped:.1f}")
END

seen=$(venv/bin/python fill.py)
expected='geotech-references 1.4.1
wide fill, -4 m from its edge: 2.0, as told -48.0, from the ground 2.0
wide fill, 0 m from its edge: 50.0, as told 0.0, from the ground 50.0
wide fill, 1 m from its edge: 77.5, as told 27.5, from the ground 77.5
wide fill, 12 m from its edge: 99.9, as told 49.9, from the ground 99.9
terrace, -1 m from its toe: 7.9, as told 15.6, the other way round 7.9
terrace, 1 m from its toe: 38.3, as told 48.1, the other way round 38.3
terrace, 6 m from its toe: 98.2, as told 171.0, the other way round 98.2
terrace, 12 m from its toe: 99.9, as told 373.9, the other way round 99.9'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
