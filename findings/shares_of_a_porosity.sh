#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# shapleyx 0.7.0: shares of parameters (Sobol indices, Shapley effects) in the scatter of a small number, such as a porosity.
#
# Guess: shares don't depend on the unit of the output: the same for a porosity of 0.38 +- 0.02 as for one of 38 +- 2 %, and
#        near those of the closed form.
# Seen:  in per cent they are right: 0.75, 0.20 and 0.05. As a number the first is 0.75, "scaled" 1.00, and the others are 0: only
#        friction matters. A lift of the lid of 0.3 mm, given in m, has no parameter that matters: effects are 0, and scaled NaN.
#        Terms that scatter by less than 0.01, in the unit of the output whatever it is, are dropped: the least precision at which
#        that happens, threshold_lambda, is fixed at 1e4. No warning, and no word of a unit; of the lift it prints that it has
#        chosen no basis function, and goes on.
# For us: porosities, strains, stress ratios and lifts in m are such numbers in studies by `shearbox run --set`. Divide the output
#        by its standard deviation first, or give threshold_lambda as 1e4 over its variance.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile shapleyx==0.7.0 numpy==2.4.6 scipy==1.17.1 pandas==2.3.3 scikit-learn==1.9.1

cat >shares.py <<'END'
import contextlib
import io
import warnings

warnings.simplefilter("error", UserWarning)
from importlib.metadata import version

import matplotlib

matplotlib.use("agg")
import numpy as np
import pandas as pd
from shapleyx import rshdmr

print("shapleyx", version("shapleyx"))
runs = np.random.default_rng(1).uniform(size=(200, 3))
NAMES = ["friction", "rolling", "speed"]
WANTED = np.array([0.75, 0.20, 0.05])
standard = (runs - 0.5) * np.sqrt(12) @ np.sqrt(WANTED)  # standard deviation of 1
print("closed form:", *WANTED)


def told(name, output, method="ard", **more):
    table = pd.DataFrame(runs, columns=NAMES).assign(Y=output)
    words = io.StringIO()
    with contextlib.redirect_stdout(words):
        analysis = rshdmr(table, polys=[2, 1], n_jobs=1, resampling=False, method=method, **more)
        _, shapley, _ = analysis.run_all()
    shapley = shapley.set_index("label").loc[NAMES]
    chosen = [line.split(":")[1].split("(")[0].strip() for line in words.getvalue().splitlines() if "functions selected" in line]
    print(f"{name}, {method}: effects", *(f"{value:.2f}" for value in shapley["effect"].astype(float)),
          "| scaled", *(f"{value:.2f}" for value in shapley["scaled effect"].astype(float)), "| chosen", *chosen)


for method in "ard", "ard_sk":
    told("porosity in %", 38 + 2 * standard, method)
    told("porosity", 0.38 + 0.02 * standard, method)
    told("lift in m", 3e-4 + 1e-4 * standard, method)
told("porosity by its standard deviation", standard)
told("porosity, threshold_lambda", 0.38 + 0.02 * standard, threshold_lambda=1e4 / 0.02**2)
END

seen=$(venv/bin/python shares.py)
expected='shapleyx 0.7.0
closed form: 0.75 0.2 0.05
porosity in %, ard: effects 0.75 0.20 0.05 | scaled 0.75 0.20 0.05 | chosen 3 / 9
porosity, ard: effects 0.75 0.00 0.00 | scaled 1.00 0.00 0.00 | chosen 1 / 9
lift in m, ard: effects 0.00 0.00 0.00 | scaled nan nan nan | chosen 0 / 9
porosity in %, ard_sk: effects 0.75 0.20 0.05 | scaled 0.75 0.20 0.05 | chosen 3 / 9
porosity, ard_sk: effects 0.78 0.00 0.00 | scaled 1.00 0.00 0.00 | chosen 1 / 9
lift in m, ard_sk: effects 0.00 0.00 0.00 | scaled nan nan nan | chosen 0 / 9
porosity by its standard deviation, ard: effects 0.75 0.20 0.05 | scaled 0.75 0.20 0.05 | chosen 3 / 9
porosity, threshold_lambda, ard: effects 0.75 0.20 0.05 | scaled 0.75 0.20 0.05 | chosen 3 / 9'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
