#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# OVITO 3.17.2: shear strain by AtomicStrainModifier in a two-dimensional cell.
#
# Guess: shear strain is an invariant, as the manual calls it: in a plane half the difference of the principal strains, or the von
#        Mises measure of three dimensions; the same however the shear lies to the axes.
# Seen:  it is sqrt(xy^2 + (xx - yy)^2 / 2), where 1/4 would be invariant: a pure shear along the axes is 1.41 times what the same
#        shear is at 45 degrees to them. The tensor is right. If the cell is left three-dimensional (and periodic in z), shear
#        strain is right as well, but volumetric strain is a third of the trace and not a half. No word of it.
# For us: grains that are squeezed upright stand out by up to 1.41 against a band that shears along x, which is what one looks for
#        in a shear box. Take the tensor and sqrt(xy^2 + (xx - yy)^2 / 4). Strains of the grid are computed without OVITO.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q ovito==3.17.2 numpy==2.4.6

cat >strain.py <<'END'
import warnings

warnings.filterwarnings("ignore", message=".*OVITO.*PyPI")
import numpy as np
import ovito
from ovito.data import DataCollection, SimulationCell
from ovito.modifiers import AtomicStrainModifier
from ovito.pipeline import Pipeline, StaticSource

print("ovito", ovito.version_string)
points = np.random.default_rng(1).uniform(0, 20, (400, 2))


def grains(positions, plane):
    data = DataCollection()
    data.create_particles(count=len(points)).create_property("Position", data=np.c_[positions, np.zeros(len(points))])
    cell = SimulationCell(pbc=(False, False, True), is2D=plane)
    cell[...] = [[40, 0, 0, -10], [0, 40, 0, -10], [0, 0, 1, -0.5]]
    data.objects.append(cell)
    return StaticSource(data=data)


stretch = np.diag([1.05, 1 / 1.05])
green = (stretch**2 - np.eye(2)) / 2
print(f"half the difference of principal strains {(green[0, 0] - green[1, 1]) / 2:.4f}, half the trace {np.trace(green) / 2:.4f}")
for degrees in 0, 22.5, 45:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    turn = np.array([[c, -s], [s, c]])
    for plane in True, False:
        pipeline = Pipeline(source=grains(points @ (turn @ stretch @ turn.T), plane))
        modifier = AtomicStrainModifier(cutoff=3, output_strain_tensors=True)
        modifier.reference = grains(points, plane)
        pipeline.modifiers.append(modifier)
        found = pipeline.compute().particles
        xx, yy, _, xy = found["Strain Tensor"][0][:4]
        shear, volumetric = np.array(found["Shear Strain"]), np.array(found["Volumetric Strain"])
        assert np.ptp(shear) < 1e-9
        print(f"at {degrees} degrees, 2D {plane}: shear strain {shear[0]:.4f}, volumetric {volumetric[0]:.4f},",
              f"of the tensor {np.hypot(xy, (xx - yy) / 2):.4f}")
END

seen=$(venv/bin/python strain.py)
expected='ovito 3.17.2
half the difference of principal strains 0.0489, half the trace 0.0024
at 0 degrees, 2D True: shear strain 0.0691, volumetric 0.0024, of the tensor 0.0489
at 0 degrees, 2D False: shear strain 0.0489, volumetric 0.0016, of the tensor 0.0489
at 22.5 degrees, 2D True: shear strain 0.0599, volumetric 0.0024, of the tensor 0.0489
at 22.5 degrees, 2D False: shear strain 0.0489, volumetric 0.0016, of the tensor 0.0489
at 45 degrees, 2D True: shear strain 0.0489, volumetric 0.0024, of the tensor 0.0489
at 45 degrees, 2D False: shear strain 0.0489, volumetric 0.0016, of the tensor 0.0489'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
