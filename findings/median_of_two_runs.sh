#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Dask 2026.8.0: quantiles of a column over the files of several runs.
#
# Guess: quantiles are approximate, as the manual says, to about a per cent with 10,000 rows a file; and the median is one number.
# Seen:  of two files with grains of different sizes, d10 is 20 % too large, and the median 12, 35 or 65 % as one asks for it beside
#        d10 and d90, by describe, or alone: quantiles of the files are merged, and the fewer are asked for, the fewer there are
#        to merge. The same rows, shuffled, have better ones. No warning.
# For us: tables by `shearbox export --to parquet` are a file for each frame, and files differ, as runs do. Take the exact ones of
#        DuckDB, Polars or pandas; or ask Dask for a hundred quantiles and use three.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q dask==2026.8.0 pandas==3.1.1 pyarrow==26.0.1 numpy==2.4.6

cat >median.py <<'END'
import dask
import dask.dataframe
import numpy as np
import pandas as pd

print("dask", dask.__version__)
random = np.random.default_rng(1)
runs = [pd.DataFrame({"d": random.lognormal(mean, 0.3, 10_000)}) for mean in (0, 1)]
for number, run in enumerate(runs):
    run.to_parquet(f"{number}.parquet")
every = pd.concat(runs)
d = dask.dataframe.read_parquet("*.parquet")["d"]
asked = [0.1, 0.5, 0.9]
print("true d10, d50, d90:", every["d"].quantile(asked).round(2).tolist())
print("dask d10, d50, d90:", d.quantile(asked).compute().round(2).tolist())
print(f"median by describe: {d.describe().compute()['50%']:.2f}, alone: {d.quantile(0.5).compute():.2f}")
print("of 99 quantiles:", d.quantile(np.arange(1, 100) / 100).compute().iloc[[9, 49, 89]].round(2).tolist())
shuffled = dask.dataframe.from_pandas(every.sample(frac=1, random_state=1, ignore_index=True), npartitions=2)["d"]
print("shuffled:", shuffled.quantile(asked).compute().round(2).tolist())
END

seen=$(venv/bin/python median.py)
expected='dask 2026.8.0
true d10, d50, d90: [0.77, 1.65, 3.47]
dask d10, d50, d90: [0.93, 1.85, 3.25]
median by describe: 2.22, alone: 2.71
of 99 quantiles: [0.77, 1.63, 3.47]
shuffled: [0.78, 1.65, 3.48]'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
