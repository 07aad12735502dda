#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# SciPy 1.17.1: scipy.stats.quantile with weights (new in 1.17) that are not counts.
#
# Guess: weights count by their shares, as in numpy.quantile and in other libraries, or they are refused: the sizes of a sand by
#        mass are the same whether masses are in g, kg, or shares of 1.
# Seen:  true of few methods, and not of the default, `linear`: there the sum of the weights is the number of observations. With
#        less than one in all, quantiles run backwards: d10 is larger than d90 and than most of the grains. No warning.
# For us: masses in SI, or areas of discs, are such weights. Take numpy.quantile(..., method="inverted_cdf", weights=...).
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q scipy==1.17.1 numpy==2.4.6

cat >sizes.py <<'END'
import numpy as np
import scipy
from scipy import stats

print("scipy", scipy.__version__)
diameter = np.array([2.0, 3.0, 4.0, 5.0, 6.0, 8.0])  # mm
grams = np.array([1.0, 2.0, 4.0, 4.0, 2.0, 1.0])
shares = [0.1, 0.5, 0.9]


def text(values):
    return " ".join(f"{value:.2f}" for value in values)


for unit, weights in ("g", grams), ("kg", grams / 1000), ("share of mass", grams / grams.sum()):
    other = np.quantile(diameter, shares, method="inverted_cdf", weights=weights)
    print(f"d10 d50 d90 by {unit}: {text(stats.quantile(diameter, shares, weights=weights))} | numpy {text(other)}")
END

seen=$(venv/bin/python sizes.py)
expected='scipy 1.17.1
d10 d50 d90 by g: 3.00 4.50 6.00 | numpy 3.00 4.00 6.00
d10 d50 d90 by kg: 7.41 5.04 2.68 | numpy 3.00 4.00 6.00
d10 d50 d90 by share of mass: 2.00 2.00 2.00 | numpy 3.00 4.00 6.00'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
