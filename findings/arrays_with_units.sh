#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# unyt 3.2.0 with NumPy 2.4.6: functions of NumPy on arrays with units.
#
# Guess: a function of NumPy does with units what it does with numbers, as the manual tells of its support for them, or it refuses:
#        angles in degrees are unwrapped as degrees, as sin and tan take them, and lengths in m are divided by lengths in mm.
# Seen:  unwrap of 350, 10 and 30 degrees gives 350, 349.3 and 350.4. 3 m // 400 mm is 0 and not 7, though 3 m % 400 mm is right.
#        einsum of two arrays in m is in m, where @ has m^2. hstack stacks rows as vstack does. copyto(..., where=) of one
#        value in Pa turns all of an array in kPa into Pa, without their numbers. The determinant of a stack of five 2 x 2
#        tensors in kPa is in kPa^5. None of these warns.
# For us: fabric, stress and rotations of grains are computed with just these. unwrap(x.to_value("rad")); floor(x / y); @ in place
#        of einsum; concatenate in place of hstack. The tools compute in SI without a library of units.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile unyt==3.2.0 numpy==2.4.6

cat >units.py <<'END'
import numpy as np
import unyt
from unyt import unyt_array as array

print("unyt", unyt.__version__)


def show(name, result):
    print(f"{name}: {np.round(np.asarray(result), 2).tolist()} {getattr(result, 'units', 'no unit')}")


rotation = array([350.0, 10.0, 30.0], "degree")
show("unwrap", np.unwrap(rotation))
show("unwrap in radians", np.degrees(np.unwrap(rotation.to_value("rad"))))
show("3 m // 400 mm", array([3.0], "m") // array([400.0], "mm"))
show("3 m % 400 mm", array([3.0], "m") % array([400.0], "mm"))
branch = array([[3.0, 0.0], [0.0, 1.0]], "m")
show("einsum", np.einsum("ci,cj->ij", branch, branch))
show("matmul", branch.T @ branch)
stress = array([[100.0], [200.0]], "kPa"), array([[300.0], [400.0]], "kPa")
show("hstack", np.hstack(stress))
show("concatenate", np.concatenate(stress, axis=1))
mended = array([100.0, 200.0, 300.0], "kPa")
np.copyto(mended, array([250000.0], "Pa"), where=[False, True, False])
show("copyto where", mended)
show("det", np.linalg.det(array([np.eye(2)] * 5, "kPa")))
END

seen=$(venv/bin/python units.py)
expected='unyt 3.2.0
unwrap: [350.0, 349.29, 350.44] degree
unwrap in radians: [350.0, 370.0, 390.0] no unit
3 m // 400 mm: [0.0] dimensionless
3 m % 400 mm: [0.2] m
einsum: [[9.0, 0.0], [0.0, 1.0]] m
matmul: [[9.0, 0.0], [0.0, 1.0]] m**2
hstack: [[100.0], [200.0], [300.0], [400.0]] kPa
concatenate: [[100.0, 300.0], [200.0, 400.0]] kPa
copyto where: [100.0, 250000.0, 300.0] Pa
det: [1.0, 1.0, 1.0, 1.0, 1.0] kPa**5'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
