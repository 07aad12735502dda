#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# scinum 2.2.2: errors with two sides, such as +0.02 -0.08, of what falls as the measured number grows.
#
# Guess: what is 2 more or 1 less, taken from something, is 1 more or 2 less: the sides of an error change places in -x, 1 - x, 1
#        / x, x ** -1 and exp(-x), as they keep them in 2 x.
# Seen:  they never do. Of a dry density of 1.60 +0.02 -0.08 g/cm3 the void ratio is 0.656 +0.021 -0.083, where it lies between
#        0.636 (at 1.62) and 0.743 (at 1.52), so get("up") and get("down") answer with values that can't be; a porosity and a
#        negative number likewise. The README says that a pair is the up and the down error, and nothing of this. No warning.
# For us: void ratio and porosity fall as density grows, and a sieve or a scale errs to one side. Errors with equal sides are
#        right, as are correlations. Take the two ends by hand: f(x(UP)) and f(x(DOWN)), and sort them.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile scinum==2.2.2 numpy==2.4.6

cat >density.py <<'END'
from importlib.metadata import version

import numpy as np
from scinum import DOWN, UP, Number, ops

print("scinum", version("scinum"))
GRAINS = 2.65
density = Number(1.60, (0.02, 0.08))  # g/cm3, 0.02 more or 0.08 less
for name, of_scinum, of_number in (("2 x", lambda x: 2 * x, None), ("-x", lambda x: -x, None),
                                   ("porosity 1 - x / 2.65", lambda x: 1 - x / GRAINS, None),
                                   ("void ratio 2.65 / x - 1", lambda x: GRAINS / x - 1, None),
                                   ("x ** -1", lambda x: x**-1, None), ("exp(-x)", lambda x: ops.exp(-x), lambda x: np.exp(-x))):
    found = of_scinum(density)
    of_number = of_number or of_scinum
    ends = sorted(float(of_number(density(side))) for side in (UP, DOWN))
    print(f"{name}: from {found(DOWN):.3f} to {found(UP):.3f}; at the ends of the density {ends[0]:.3f} to {ends[1]:.3f}")
END

seen=$(venv/bin/python density.py)
expected='scinum 2.2.2
2 x: from 3.040 to 3.240; at the ends of the density 3.040 to 3.240
-x: from -1.680 to -1.580; at the ends of the density -1.620 to -1.520
porosity 1 - x / 2.65: from 0.366 to 0.404; at the ends of the density 0.389 to 0.426
void ratio 2.65 / x - 1: from 0.573 to 0.677; at the ends of the density 0.636 to 0.743
x ** -1: from 0.594 to 0.633; at the ends of the density 0.617 to 0.658
exp(-x): from 0.186 to 0.206; at the ends of the density 0.198 to 0.219'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
