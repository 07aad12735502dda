#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# geoeq 0.1.3: d10 and coefficient of uniformity of a sand, with finer sieves on which nothing is left.
#
# Guess: a sieve below the finest grain, with no mass on it, changes nothing.
# Seen:  d10 goes to a half, and the coefficient of uniformity from 2.2 to 4.5: the curve is interpolated from the finest sieve of all
#        that nothing passes, not from the coarsest. Sieves with equal shares are put in order by a sort that keeps none; NumPy 2 on
#        x86 with AVX2 happens to turn them, and is right, so d10 depends on the processor, too. No word of it.
# For us: gradings of the tools are of diameters, without sieves. With geoeq: leave out sieves below the first with nothing on it.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile geoeq==0.1.3 numpy==1.24.4 scipy==1.11.4 matplotlib==3.8.4 # of a NumPy that sorts alike on all processors

cat >sieves.py <<'END'
from importlib.metadata import version

from geoeq.soil import grain_size
from geoeq.soil.sieve import sieve_ana

print("geoeq", version("geoeq"))
opening, mass = [2.0, 1.0, 0.5, 0.25], [0, 100, 300, 100]  # mm, g: all on these
print(f"by hand: d10 {0.25 * 2 ** (10 / 20):.3f} mm")
for finer in [], [0.125], [0.125, 0.063]:
    result = sieve_ana(opening + finer, mass + [0] * len(finer))
    print(f"sieves {opening + finer}: finer {result['percent_finer'].tolist()} %, d10 {grain_size.grain_d10(result):.3f} mm,",
          f"d60 {grain_size.grain_d60(result):.3f} mm, uniformity {grain_size.grain_Cu(result):.2f}")
END

seen=$(venv/bin/python sieves.py)
expected='geoeq 0.1.3
by hand: d10 0.354 mm
sieves [2.0, 1.0, 0.5, 0.25]: finer [100.0, 80.0, 20.0, 0.0] %, d10 0.354 mm, d60 0.794 mm, uniformity 2.24
sieves [2.0, 1.0, 0.5, 0.25, 0.125]: finer [100.0, 80.0, 20.0, 0.0, 0.0] %, d10 0.250 mm, d60 0.794 mm, uniformity 3.17
sieves [2.0, 1.0, 0.5, 0.25, 0.125, 0.063]: finer [100.0, 80.0, 20.0, 0.0, 0.0, 0.0] %, d10 0.177 mm, d60 0.794 mm, uniformity 4.47'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
