#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Pymunk 7.3.1 (of Chipmunk): kinetic energy of a body, and inertia of a grain with rounded corners.
#
# Guess: kinetic_energy is half of m v^2 + I w^2. A radius of a polygon counts in its inertia as it counts in its area and mass.
# Seen:  kinetic_energy is all of it: a disc that falls has twice the energy it has lost in height. A rounded polygon has its mass
#        with the radius, but the inertia of the sharp one inside: nearly a disc, it turns 95 times too easily. No word of either.
# For us: energies are those of LAMMPS, and clumps are of discs. With Pymunk: halve the energy, and build a rounded grain of discs
#        and sharp polygons, or set body.moment.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q pymunk==7.3.1

cat >energy.py <<'END'
import math

import pymunk

print("pymunk", pymunk.version)
space = pymunk.Space()
space.gravity = 0, -10
disc = pymunk.Body(mass=2, moment=1)
disc.angular_velocity = 3
space.add(disc, pymunk.Circle(disc, 1))
for _ in range(1000):
    space.step(0.001)
v, w = disc.velocity.length, disc.angular_velocity
print(f"fallen {-disc.position.y:.2f}, work of gravity {-disc.position.y * 20:.1f},",
      f"energy {disc.mass * v * v / 2 + disc.moment * w * w / 2:.1f} by hand, {disc.kinetic_energy:.1f} by Pymunk")
for half in 1, 0.1:
    grain = pymunk.Body()
    shape = pymunk.Poly(grain, [(-half, -half), (half, -half), (half, half), (-half, half)], radius=1)
    shape.density = 1
    space.add(grain, shape)
    square, sides, corners = (2 * half) ** 2, 2 * half, math.pi
    offset = 4 / (3 * math.pi)  # centroid of a quarter of a disc, from each straight side
    inertia = square * (2 * half) ** 2 / 6  # of the square, the four rectangles at its sides, the four quarters of a disc
    inertia += 4 * sides * ((sides**2 + 1) / 12 + (half + 0.5) ** 2)
    inertia += math.pi / 2 - math.pi * 2 * offset**2 + math.pi * 2 * (half + offset) ** 2
    print(f"square of {2 * half:g} rounded by 1: mass {grain.mass:.3f}, right {square + 4 * sides + corners:.3f};",
          f"inertia {grain.moment:.3f}, right {inertia:.3f}")
END

seen=$(venv/bin/python energy.py)
expected='pymunk 7.3.1
fallen 4.99, work of gravity 99.9, energy 104.5 by hand, 209.0 by Pymunk
square of 2 rounded by 1: mass 15.142, right 15.142; inertia 10.094, right 37.187
square of 0.2 rounded by 1: mass 3.982, right 3.982; inertia 0.027, right 2.525'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
