#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# grainsize 0.2.4: mean size of the grains of a sediment, by GrainSize.create_stats_df.
#
# Guess: the mean is that of the sizes weighted by their shares, arithmetic or geometric, in um as median and mode beside it.
# Seen:  median and mode are right. The mean is the size whose share is nearest to the mean of the shares, on either side of the
#        peak: 186 for a sand with a mean of 314 (geometric: 300), 127 for a silt of 55 (40), 5 for a finer silt of 33 (20), and 7
#        for half sand, half clay, of 159 (30). std and skewness in that table are of the shares, too: the more uniform a sediment,
#        the larger is its std. No warning; only a helper tells that it looks for the size of "the mean frequency".
# For us: gradings of real sands come from laser instruments, whose tables it reads and cleans. Take sizes and shares of its
#        dataframe and compute the moments, as the script does. Sizes of models are drawn from a grading that is known.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile grainsize==0.2.4 numpy==2.4.6 scipy==1.17.1 pandas==3.1.1 matplotlib==3.11.2 seaborn==0.13.2

cat >mean.py <<'END'
from importlib.metadata import version

import numpy as np
import pandas as pd
from grainsize import GrainSize

print("grainsize", version("grainsize"))
sizes = np.round(np.geomspace(0.01, 3500, 101), 3)  # classes of a laser instrument, in micrometres


def sediment(middle, spread):
    share = np.exp(-0.5 * (np.log(sizes / middle) / spread) ** 2)
    return np.round(100 * share / share.sum(), 2)


sediments = {"sand": sediment(300, 0.3), "silt": sediment(40, 0.8), "fine silt": sediment(20, 1),
             "sand and clay": (sediment(300, 0.3) + sediment(3, 0.6)) / 2}
found = GrainSize(dataframe=pd.DataFrame(list(sediments.values()), columns=sizes)).create_stats_df()
for (name, share), row in zip(sediments.items(), found.itertuples()):
    log = np.average(np.log(sizes), weights=share)
    spread = np.exp(np.sqrt(np.average((np.log(sizes) - log) ** 2, weights=share)))
    print(f"{name}: median {row.median:.0f}, mode {row.mode:.0f}, mean {row.mean:.1f}, std {row.std:.1f} | of sizes: mean",
          f"{np.average(sizes, weights=share):.0f}, geometric {np.exp(log):.0f} and std {spread:.2f}")
END

seen=$(venv/bin/python mean.py)
expected='grainsize 0.2.4
sand: median 310, mode 310, mean 185.8, std 6.1 | of sizes: mean 314, geometric 300 and std 1.35
silt: median 40, mode 40, mean 126.7, std 2.3 | of sizes: mean 55, geometric 40 and std 2.22
fine silt: median 21, mode 19, mean 4.6, std 1.8 | of sizes: mean 33, geometric 20 and std 2.72
sand and clay: median 111, mode 310, mean 6.7, std 2.2 | of sizes: mean 159, geometric 30 and std 10.50'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
