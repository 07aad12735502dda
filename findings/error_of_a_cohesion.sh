#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# lmfit 1.3.4: the standard error of a cohesion that must not be negative.
#
# Guess: where the best line of strength over normal stress is that with cohesion 0, the least allowed, its error is the same for
#        any starting value, or there is none.
# Seen:  the fit with the usual method, leastsq, ends at 0 from all starts, as it should; the error of the cohesion is 0.05, 0.3 or
#        3.6 kPa, or none, as the start has it, that of the slope differs by a third. Each time "success". A value at
#        its bound no longer changes with the variable that leastsq has in its place, so that its error is one of rounding.
# For us: the report fits cohesion without a bound. With lmfit, method="least_squares" gives one error for all starts; or leave out
#        the bound, or the cohesion.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q lmfit==1.3.4 numpy==2.4.6 scipy==1.17.1

cat >line.py <<'END'
import sys

import lmfit
import numpy as np

print("lmfit", lmfit.__version__)
sigma = np.array([100.0, 200, 300, 400])  # kPa
tau = 0.6 * sigma - 5 + np.array([1, -2, 1, 0])
model = lmfit.Model(lambda sigma, c, slope: c + slope * sigma, independent_vars=["sigma"])
for method in "leastsq", "least_squares":
    errors = []
    for start in 0.0, 0.1, 1.0, 5.0, 10.0, 50.0:
        fit = model.fit(tau, model.make_params(c={"value": start, "min": 0}, slope=0.5), sigma=sigma, method=method)
        c, slope = fit.params["c"], fit.params["slope"]
        print(method, start, c, slope, file=sys.stderr)
        assert fit.success and abs(c.value) < 1e-6 and abs(slope.value - 0.58333) < 1e-4
        errors.append((c.stderr, slope.stderr))
    some = np.array([pair for pair in errors if None not in pair], float)
    low, high = some.min(axis=0), some.max(axis=0)
    print(f"{method}: all succeed with c = 0; some without error: {len(some) < len(errors)};",
          f"largest by least error of c above 10: {high[0] > 10 * low[0]}, of the slope above 1.2: {high[1] > 1.2 * low[1]}")
END

seen=$(venv/bin/python line.py)
expected='lmfit 1.3.4
leastsq: all succeed with c = 0; some without error: True; largest by least error of c above 10: True, of the slope above 1.2: True
least_squares: all succeed with c = 0; some without error: False; largest by least error of c above 10: False, of the slope above 1.2: False'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
