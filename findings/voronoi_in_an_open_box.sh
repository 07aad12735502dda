#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# freud 3.4.0 (freud-analysis): Voronoi cells of points in a box without periodic sides.
#
# Guess: with box.periodic = False the cells at the sides end there, and a point has no neighbour on the opposite side.
# Seen:  cells and neighbours are those of the periodic box, to the last bit: cells stick out of the box, and points at the left
#        side are neighbours of points at the right. No word of it, though neighbour queries do heed the box, or refuse it.
# For us: areas of cells at walls, local solid fractions and bond order from such neighbours are wrong. compute cdem/average and
#        cdem/grid take a rectangle inside the box. With freud: leave out points whose cell reaches beyond the walls.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q freud-analysis==3.4.0 numpy==2.4.6

cat >cells.py <<'END'
import freud
import numpy as np

SIDE = 10.0
print("freud", freud.__version__)
points = np.zeros((500, 3))
points[:, :2] = np.random.default_rng(1).uniform(-SIDE / 2, SIDE / 2, (500, 2))
areas = {}
for periodic in (True, False):
    box = freud.box.Box.square(SIDE)
    box.periodic = [periodic, periodic, False]
    voronoi = freud.locality.Voronoi().compute((box, points))
    apart = np.abs(points[voronoi.nlist.point_indices] - points[voronoi.nlist.query_point_indices]).max(axis=1)
    beyond = sum(np.abs(corners).max() > SIDE / 2 for corners in voronoi.polytopes)
    areas[periodic] = voronoi.volumes.copy()
    print("periodic", periodic, "| neighbours across the box:", (apart > SIDE / 2).sum() > 0, end=" ")
    print("| cells that stick out:", beyond > 0, "| sides of the box read back:", box.periodic.tolist())
print("same areas:", np.array_equal(areas[True], areas[False]))
END

seen=$(venv/bin/python cells.py)
expected='freud 3.4.0
periodic True | neighbours across the box: True | cells that stick out: True | sides of the box read back: [True, True, False]
periodic False | neighbours across the box: True | cells that stick out: True | sides of the box read back: [False, False, False]
same areas: True'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
