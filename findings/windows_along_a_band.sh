#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# FF-PIV 0.2.1 (ffpiv): displacements of grains in an image, in windows that are not square.
#
# Guess: an image that has moved by 3 pixels to the right and 2 up has u = 3 and v = -2 to 0.1 pixel in windows of any size: the
#        manual takes a "size in y (first) and x (second) dimension", and gives the grid of such windows.
# Seen:  so it is in square windows. In flat ones, 32 high and 64 wide, v is 13.5; in tall ones -17; of 48 by 64, 6: the size of a
#        window across is taken for that upwards, and its middle is sought in the wrong place. Parts of a pixel are lost, too: u
#        is between 1.1 and 5.6. Coordinates and the shape of the results are right. No warning; only windows twice as flat again
#        end in an error.
# For us: a shear band or the gap of a box is flat, and so are windows for it. Take square ones with more overlap across the band,
#        or OpenPIV, of which it was made: 0.26.1 has 3.0 and -1.9 in windows of 32 by 64.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile ffpiv==0.2.1 numpy==2.4.6 numba==0.68.1 rocket-fft==0.4.1 pyFFTW==0.15.1
export HOME=$work XDG_CACHE_HOME=$work/cache
export NUMBA_DISABLE_JIT=1  # of the engine "numba", which has the same answers, but takes a minute to build

cat >band.py <<'END'
from importlib.metadata import version

import ffpiv
import numpy as np

print("ffpiv", version("ffpiv"))
RIGHT, DOWN = 3, -2
speckles = np.random.default_rng(1).integers(0, 256, (330, 330)).astype(float)
for axis in 0, 1:
    speckles = np.apply_along_axis(np.convolve, axis, speckles, np.array([1, 4, 6, 4, 1]) / 16, mode="same")
speckles = speckles.round().astype(np.uint8)
before, after = (image[5:-5, 5:-5] for image in (speckles, np.roll(speckles, (DOWN, RIGHT), axis=(0, 1))))
for high, wide in (64, 64), (32, 32), (32, 64), (64, 32), (48, 64), (80, 64):
    for engine in "fftw", "numpy":
        u, v = ffpiv.piv(before, after, window_size=(high, wide), engine=engine)
        right = (abs(u - RIGHT) < 0.5) & (abs(v - DOWN) < 0.5)
        print(f"{high} high, {wide} wide, {engine}: u {np.median(u):.1f}, v {np.median(v):.1f},",
              f"right to half a pixel in {right.sum()} of {u.size} windows")
END

seen=$(venv/bin/python band.py)
expected='ffpiv 0.2.1
64 high, 64 wide, fftw: u 3.0, v -2.0, right to half a pixel in 25 of 25 windows
64 high, 64 wide, numpy: u 3.0, v -2.0, right to half a pixel in 25 of 25 windows
32 high, 32 wide, fftw: u 2.9, v -1.9, right to half a pixel in 100 of 100 windows
32 high, 32 wide, numpy: u 2.9, v -1.9, right to half a pixel in 100 of 100 windows
32 high, 64 wide, fftw: u 3.0, v 13.5, right to half a pixel in 1 of 50 windows
32 high, 64 wide, numpy: u 3.0, v 13.5, right to half a pixel in 1 of 50 windows
64 high, 32 wide, fftw: u 3.0, v -17.0, right to half a pixel in 0 of 50 windows
64 high, 32 wide, numpy: u 3.0, v -17.0, right to half a pixel in 0 of 50 windows
48 high, 64 wide, fftw: u 3.3, v 6.0, right to half a pixel in 0 of 30 windows
48 high, 64 wide, numpy: u 3.3, v 6.0, right to half a pixel in 0 of 30 windows
80 high, 64 wide, fftw: u 3.0, v -10.0, right to half a pixel in 0 of 20 windows
80 high, 64 wide, numpy: u 3.0, v -10.0, right to half a pixel in 0 of 20 windows'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
