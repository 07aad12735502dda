#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# pwlf 2.7.0: standard errors, R2 and p of a bent line (piecewise linear) whose points have known scatter (weights).
#
# Guess: with weights of one over the standard deviation of each point, as the manual has them, errors, R2 and p are those of
#        weighted least squares, or at least R2 does not depend on the unit.
# Seen:  without weights so it is, and with them the line is right. Errors of its slopes, which have no unit, are 0.034 for data in
#        kPa, 0.000034 for all the same in MPa and 34 in Pa, where 0.0096 is right (known: 0.022). R2 is -13 in MPa, and is 1.00000
#        in Pa. So the bend is nearly sure, certain or nothing (p of 0.02, 0 and 1), where p = 0.00009. No warning, no word of it.
# For us: strength over normal stress of several specimens, or stress over displacement, is such a line. Take the place of the bend
#        from pwlf, and the rest from WLS of statsmodels.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile pwlf==2.7.0 statsmodels==0.15.0 numpy==2.4.6 scipy==1.17.1 pandas==3.1.1

cat >bent.py <<'END'
from importlib.metadata import version

import numpy as np
import pwlf
import statsmodels.api as sm

print("pwlf", version("pwlf"))
stress = np.array([50.0, 100, 150, 200, 250, 300, 400, 500])  # kPa
strength = np.array([42.0, 79, 120, 155, 182, 211, 269, 325])  # kPa, mean of several specimens
scatter = np.array([2.0, 3, 3, 4, 4, 5, 7, 8])  # kPa, of each mean
BEND = 200


def show(name, parameters, errors, r2, p):
    print(f"{name}: slope {parameters[1]:.3f}, change {parameters[2]:.3f}, errors {errors[1]:.2g} {errors[2]:.2g},",
          f"R2 {r2:.5f}, p of change", f"{p[2]:.1g}" if p[2] > 1e-10 else "< 1e-10")


for unit, factor in ("kPa", 1), ("MPa", 1e-3), ("Pa", 1e3):
    x, y, deviation = factor * stress, factor * strength, factor * scatter
    design = np.c_[np.ones(8), x - x[0], np.maximum(x - factor * BEND, 0)]
    for name, weights in (f"{unit}, no weights", np.ones(8)), (f"{unit}, weights", 1 / deviation):
        line = pwlf.PiecewiseLinFit(x, y, weights=None if "no" in name else weights)
        line.fit_with_breaks(factor * np.array([50, BEND, 500]))
        show(f"{name}: pwlf", line.beta, line.standard_errors(), line.r_squared(), line.p_values())
        right = sm.WLS(y, design, weights=weights**2).fit()
        show(f"{name}: WLS", right.params, right.bse, right.rsquared, right.pvalues)
known = np.sqrt(np.diag(np.linalg.inv(design.T / deviation**2 @ design)))
print("deviations taken as known: errors", " ".join(f"{error:.3g}" for error in known[1:]))
END

seen=$(venv/bin/python bent.py)
expected='pwlf 2.7.0
kPa, no weights: pwlf: slope 0.752, change -0.185, errors 0.011 0.015, R2 0.99984, p of change 5e-05
kPa, no weights: WLS: slope 0.752, change -0.185, errors 0.011 0.015, R2 0.99984, p of change 5e-05
kPa, weights: pwlf: slope 0.757, change -0.195, errors 0.034 0.061, R2 0.99999, p of change 0.02
kPa, weights: WLS: slope 0.757, change -0.195, errors 0.0096 0.017, R2 0.99973, p of change 9e-05
MPa, no weights: pwlf: slope 0.752, change -0.185, errors 0.011 0.015, R2 0.99984, p of change 5e-05
MPa, no weights: WLS: slope 0.752, change -0.185, errors 0.011 0.015, R2 0.99984, p of change 5e-05
MPa, weights: pwlf: slope 0.757, change -0.195, errors 3.4e-05 6.1e-05, R2 -13.47872, p of change < 1e-10
MPa, weights: WLS: slope 0.757, change -0.195, errors 0.0096 0.017, R2 0.99973, p of change 9e-05
Pa, no weights: pwlf: slope 0.752, change -0.185, errors 0.011 0.015, R2 0.99984, p of change 5e-05
Pa, no weights: WLS: slope 0.752, change -0.185, errors 0.011 0.015, R2 0.99984, p of change 5e-05
Pa, weights: pwlf: slope 0.757, change -0.195, errors 34 61, R2 1.00000, p of change 1
Pa, weights: WLS: slope 0.757, change -0.195, errors 0.0096 0.017, R2 0.99973, p of change 9e-05
deviations taken as known: errors 0.0225 0.0401'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
