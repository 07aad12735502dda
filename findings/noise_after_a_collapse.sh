#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# pandas 3.1.1, Bottleneck 1.6.0 and Numbagg 0.9.6: moving standard deviations of a run that collapses and comes to rest.
#
# Guess: a row counts as long as it is in the window: all are as computed window by window, at least by pandas.
# Seen:  sums are carried along, and what rounding left in them stays to the end of the series. Of an energy that falls by twelve
#        decades, 266 of 391 deviations are off by more than a per cent with pandas too, and the last is 200,000 times the true one.
#        One row of 1e9 times the others spoils all after it in Bottleneck; in Numbagg variances become negative and deviations NaN.
#        No word of it. Polars 2.1.0 is right in both.
# For us: kinetic energies span such a range, and so does any column after one bad row. To judge rest by the deviation of an energy
#        take its logarithm, or numpy.lib.stride_tricks.sliding_window_view, or Polars. The tools here have no moving deviations.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q pandas==3.1.1 polars==2.1.0 bottleneck==1.6.0 numbagg==0.9.6 numba==0.68.1 numpy==2.4.6

cat >noise.py <<'END'
from importlib.metadata import version

import bottleneck
import numbagg
import numpy as np
import pandas as pd
import polars

print(*(f"{name} {version(name)}" for name in ("pandas", "polars", "bottleneck", "numbagg")))
noise = 1 + 0.1 * np.random.default_rng(1).normal(size=400)
falls = noise * np.maximum(10.0 ** (-np.arange(400) / 20), 1e-12)  # J
jumps = 1e-9 * noise
jumps[20] = 1
for name, energy in ("falls", falls), ("jumps once", jumps):
    true = np.lib.stride_tricks.sliding_window_view(energy, 10).std(axis=1, ddof=1)
    found = {
        "pandas": pd.Series(energy).rolling(10).std().to_numpy(),
        "polars": polars.Series(energy).rolling_std(10).to_numpy(),
        "bottleneck": bottleneck.move_std(energy, 10, ddof=1),
        "numbagg": numbagg.move_std(energy, window=10),
    }
    print(f"energy {name}: deviations off by more than 1 %, of them NaN, more than 10,000 times too large")
    for library, deviation in found.items():
        ratios = deviation[9:] / true
        off = ~(np.abs(ratios - 1) < 0.01)
        some = {False: "none", True: "the last"}
        print(f"  {library}: {'more than half' if off.mean() > 0.5 else off.sum()},",
              f"{some[bool(np.isnan(ratios[-1]))]}, {some[bool(ratios[-1] > 1e4)]}")
print("numbagg's variances below 0:", bool((numbagg.move_var(jumps, window=10) < 0).any()))
END

seen=$(venv/bin/python noise.py)
expected='pandas 3.1.1 polars 2.1.0 bottleneck 1.6.0 numbagg 0.9.6
energy falls: deviations off by more than 1 %, of them NaN, more than 10,000 times too large
  pandas: more than half, none, the last
  polars: 0, none, none
  bottleneck: more than half, none, the last
  numbagg: more than half, none, the last
energy jumps once: deviations off by more than 1 %, of them NaN, more than 10,000 times too large
  pandas: 0, none, none
  polars: 0, none, none
  bottleneck: more than half, none, none
  numbagg: more than half, the last, none
numbagg'\''s variances below 0: True'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
