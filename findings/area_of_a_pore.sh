#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# PyVista 0.49.1 with VTK 9.7.2: areas of polygons that are not convex.
#
# Guess: the area of a plane polygon is that of its corners (shoelace formula), convex or not, and its integrals are right.
# Seen:  `area`, compute_cell_sizes and integrate_data add triangles about the first corner without their sign: too large where
#        the polygon is not convex, by a factor that depends on which corner stands first. Triangulated first, or clipped, it is
#        right. No word of it.
# For us: pores between grains (loops of contacts) and outlines of grains of several discs are such polygons. `shearbox export --to
#        vtk` writes squares and points, which are right. With polygons of your own: mesh.triangulate() before anything is summed.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q pyvista==0.49.1 vtk==9.7.2 numpy==2.4.6

cat >pore.py <<'END'
import numpy as np
import pyvista
from vtk import vtkVersion

print("pyvista", pyvista.__version__, "vtk", vtkVersion().GetVTKVersion())


def shapes():
    yield "pore", np.array([[0, 0, 0], [4, 0, 0], [4, 4, 0], [2, 1, 0], [0, 4, 0]], float), range(5)
    right = np.radians(np.arange(-120, 121, 10))
    left = np.radians(np.arange(60, 301, 10))
    x = np.r_[1 + np.cos(right), np.cos(left) - 1]
    y = np.r_[np.sin(right), np.sin(left)]
    yield "grain of two discs", np.c_[x, y, np.zeros(len(x))], (0, 16, 48)


for name, corners, firsts in shapes():
    x, y = corners[:, 0], corners[:, 1]
    print(f"{name}: shoelace {abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2:.3f}")
    for first in firsts:
        mesh = pyvista.PolyData(np.roll(corners, -first, axis=0), faces=[len(x), *range(len(x))])
        mesh.cell_data["stress"] = [100.0]
        sizes, integral = mesh.compute_cell_sizes()["Area"][0], mesh.integrate_data()["stress"][0]
        print(f"  first corner {first}: area {mesh.area:.3f}, cell size {sizes:.3f}, mean of a stress of 100:"
              f" {integral / mesh.triangulate().area:.1f}, area of triangles {mesh.triangulate().area:.3f}")
END

seen=$(venv/bin/python pore.py)
expected='pyvista 0.49.1 vtk 9.7.2
pore: shoelace 10.000
  first corner 0: area 14.000, cell size 14.000, mean of a stress of 100: 140.0, area of triangles 10.000
  first corner 1: area 14.000, cell size 14.000, mean of a stress of 100: 140.0, area of triangles 10.000
  first corner 2: area 22.000, cell size 22.000, mean of a stress of 100: 220.0, area of triangles 10.000
  first corner 3: area 10.000, cell size 10.000, mean of a stress of 100: 100.0, area of triangles 10.000
  first corner 4: area 22.000, cell size 22.000, mean of a stress of 100: 220.0, area of triangles 10.000
grain of two discs: shoelace 6.766
  first corner 0: area 6.879, cell size 6.879, mean of a stress of 100: 101.7, area of triangles 6.766
  first corner 16: area 6.957, cell size 6.957, mean of a stress of 100: 102.8, area of triangles 6.766
  first corner 48: area 7.010, cell size 7.010, mean of a stress of 100: 103.6, area of triangles 6.766'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
