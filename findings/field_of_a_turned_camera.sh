#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# PIVPy 0.4.0 (pivpy): displacements of grains turned by rotate, as for a camera that was not level.
#
# Guess: "rotates the coordinate system and velocity field" turns places and vectors alike, so that a rigid rotation stays one, and
#        what has no direction stays as it was: vorticity, change of volume, largest shear.
# Seen:  vectors turn, and places stay where they are. A quarter turn makes a swelling of 0.2 of a rigid rotation of 0.1; a
#        settlement of 2 % has no change of volume any more, and rotates instead. Half a turn makes it swell by 2 %. For a camera
#        that is 5 degrees off, a rigid rotation of 0.1 swells by 0.017. No warning, and no word of it: the manual tells that
#        coordinates are turned as well, and that it works best where the spacing is the same in x and y, as here.
# For us: displacements of real shear boxes come from such pictures, and dilation is what is looked for in them. Turn the pictures
#        (scipy.ndimage.rotate) before displacements are computed, or take only what has no direction, before rotate.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
# --no-deps: it asks for a notebook server and a language model's client, 600 MB, which the numbers don't need
venv/bin/pip install -q --no-compile --no-deps pivpy==0.4.0 numpy==2.4.6 scipy==1.17.1 xarray==2026.9.0 pandas==3.1.1 \
  packaging==26.4 python-dateutil==2.9.0 six==1.17.0 matplotlib==3.11.2 pillow==13.0.0 pyparsing==3.3.3 cycler==0.12.1 \
  kiwisolver==1.5.1 fonttools==4.68.0

cat >turn.py <<'END'
import warnings

warnings.simplefilter("error", UserWarning)
from importlib.metadata import version

import numpy as np
import pivpy.pivpy
import xarray as xr

print("pivpy", version("pivpy"))
axis = np.arange(-5.0, 6.0)
x, y = np.meshgrid(axis, axis)
FIELDS = {"rigid rotation": np.array([[0, -0.1], [0.1, 0]]), "settlement": np.array([[0, 0], [0, -0.02]])}


def invariants(gradient):
    (xx, xy), (yx, yy) = gradient
    shear = np.hypot((xx - yy) / 2, (xy + yx) / 2)
    return yx - xy, xx + yy, shear


def text(values):
    return " ".join(f"{value + 0.0:6.3f}" for value in np.round(values, 6))


for name, gradient in FIELDS.items():
    u, v = np.tensordot(gradient, [x, y], 1)
    for degrees in 0, 5, 90, 180:
        field = xr.Dataset({"u": (("y", "x"), u), "v": (("y", "x"), v)}, coords={"x": axis, "y": axis})
        turned = field.piv.rotate(float(degrees))
        found = []
        for what in "curl", "divergence", "max_shear":
            values = turned.piv.vec2scal(what, name=what)[what].values
            assert np.ptp(values) < 1e-9
            found.append(values[5, 5])
        cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        turn = np.array([[cos, sin], [-sin, cos]])
        print(f"{name} turned by {degrees:3d}: vorticity, change of volume, largest shear",
              text(found), "| closed form", text(invariants(turn @ gradient @ turn.T)))
END

seen=$(venv/bin/python turn.py)
expected='pivpy 0.4.0
rigid rotation turned by   0: vorticity, change of volume, largest shear  0.200  0.000  0.000 | closed form  0.200  0.000  0.000
rigid rotation turned by   5: vorticity, change of volume, largest shear  0.199  0.017  0.000 | closed form  0.200  0.000  0.000
rigid rotation turned by  90: vorticity, change of volume, largest shear  0.000  0.200  0.000 | closed form  0.200  0.000  0.000
rigid rotation turned by 180: vorticity, change of volume, largest shear -0.200  0.000  0.000 | closed form  0.200  0.000  0.000
settlement turned by   0: vorticity, change of volume, largest shear  0.000 -0.020  0.010 | closed form  0.000 -0.020  0.010
settlement turned by   5: vorticity, change of volume, largest shear  0.002 -0.020  0.010 | closed form  0.000 -0.020  0.010
settlement turned by  90: vorticity, change of volume, largest shear  0.020  0.000  0.010 | closed form  0.000 -0.020  0.010
settlement turned by 180: vorticity, change of volume, largest shear  0.000  0.020  0.010 | closed form  0.000 -0.020  0.010'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
