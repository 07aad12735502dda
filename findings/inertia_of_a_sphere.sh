#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# trimesh 5.2.0: mass and moments of inertia of grains as primitives with a density.
#
# Guess: with a density set, mass and moment_inertia both count it, as for the same grain as a mesh: 2/5 m r^2 for a sphere.
# Seen:  mass does. moment_inertia and principal_inertia_components of Sphere and Cylinder are those of density 1, which for sand in SI
#        is 2650 times too small; those of Box and Capsule are right, and so is mass_properties["inertia"] of all. (volume is that
#        of the true sphere, and mass that of its triangles, 0.9 % less.) No word of it.
# For us: inertia of grains is by closed forms. With trimesh: primitive.to_mesh() before anything is asked, or multiply by density.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q trimesh==5.2.0 numpy==2.4.6 scipy==1.17.1

cat >inertia.py <<'END'
import trimesh
from trimesh import primitives

print("trimesh", trimesh.__version__)
RADIUS, DENSITY = 0.5, 2650.0
shapes = {
    "sphere": primitives.Sphere(radius=RADIUS),
    "cylinder": primitives.Cylinder(radius=RADIUS, height=1),
    "capsule": primitives.Capsule(radius=RADIUS, height=1),
    "box": primitives.Box(extents=[1, 1, 1]),
}
for name, shape in shapes.items():
    shape.density = DENSITY
    mesh = shape.to_mesh()
    mesh.density = DENSITY
    for kind, grain in ("primitive", shape), ("mesh", mesh):
        moments = grain.moment_inertia[2, 2], grain.principal_inertia_components.min(), grain.mass_properties["inertia"][2, 2]
        print(f"{name}, {kind}: mass {grain.mass:.1f}, of its volume {DENSITY * grain.volume:.1f};",
              "about z by mass and square of radius:", *(f"{moment / grain.mass / RADIUS**2:.5f}" for moment in moments))
END

seen=$(venv/bin/python inertia.py)
expected='trimesh 5.2.0
sphere, primitive: mass 1375.6, of its volume 1387.5; about z by mass and square of radius: 0.00015 0.00015 0.39770
sphere, mesh: mass 1375.6, of its volume 1375.6; about z by mass and square of radius: 0.39770 0.39770 0.39770
cylinder, primitive: mass 2068.0, of its volume 2081.3; about z by mass and square of radius: 0.00019 0.00019 0.49680
cylinder, mesh: mass 2068.0, of its volume 2068.0; about z by mass and square of radius: 0.49680 0.49680 0.49680
capsule, primitive: mass 3459.9, of its volume 3468.8; about z by mass and square of radius: 0.45906 0.45906 0.45906
capsule, mesh: mass 3459.9, of its volume 3459.9; about z by mass and square of radius: 0.45906 0.45906 0.45906
box, primitive: mass 2650.0, of its volume 2650.0; about z by mass and square of radius: 0.66667 0.66667 0.66667
box, mesh: mass 2650.0, of its volume 2650.0; about z by mass and square of radius: 0.66667 0.66667 0.66667'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
