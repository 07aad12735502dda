#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# SALib 1.6.0: Sobol indices of a study in which one run has failed.
#
# Guess: with NaN for that run the indices are NaN.
# Seen:  all indices and their confidence intervals are exactly 0, without a word: no parameter has any influence, and that for
#        sure. (A few hundred good runs beside it don't matter.)
# For us: a study of parameters with `shearbox run --set` can have failed runs: look for NaN before the analysis, and run these
#        again. Runs can't just be left out: the sample has its order.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q SALib==1.6.0 numpy==2.4.6 scipy==1.17.1

cat >indices.py <<'END'
from importlib.metadata import version

import numpy as np
from SALib.analyze import rbd_fast, sobol
from SALib.sample import sobol as sample

print("SALib", version("SALib"))
problem = {"num_vars": 2, "names": ["phi", "kn"], "bounds": [[20, 40], [1e7, 1e8]]}
runs = sample.sample(problem, 64, calc_second_order=False, seed=1)
strength = runs[:, 0] + 1e-7 * runs[:, 1]
failed = strength.copy()
failed[5] = np.nan
for name, result in ("all", strength), ("one failed", failed):
    found = sobol.analyze(problem, result, calc_second_order=False, seed=1)
    print(f"{name} of {len(runs)} runs:", *(f"{key} {np.round(found[key], 2).tolist()}" for key in ("S1", "S1_conf", "ST")))
print("rbd_fast:", [float(index) for index in rbd_fast.analyze(problem, runs, failed, seed=1)["S1"]])
END

seen=$(venv/bin/python indices.py)
expected='SALib 1.6.0
all of 256 runs: S1 [0.86, 0.17] S1_conf [0.29, 0.14] ST [0.84, 0.17]
one failed of 256 runs: S1 [0.0, 0.0] S1_conf [0.0, 0.0] ST [0.0, 0.0]
rbd_fast: [nan, nan]'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
