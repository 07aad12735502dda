#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Polars 2.1.0 (and Awkward Array 2.14.0): sums of single precision by group, of many rows.
#
# Guess: the sum of a group is that of the same rows without groups, to the precision of the numbers, 1e-7: long sums are pairwise,
#        compensated or in double precision.
# Seen:  group_by(...).agg(sum) adds one row after the other in single precision: the mass of 4 million equal grains is 1.5 % off
#        (the digits change from run to run), and of 40 million rows of 1 the count of each thread stands still at 2^24. Right are
#        sum() without groups, sum().over(group) and mean() of the group, and DuckDB and pandas. In Awkward Array
#        ak.sum(..., axis=-1) is as wrong. The manual of Polars tells of casts of short integers before sums, and nothing of this.
# For us: tables of `shearbox export` have double precision. Columns from VTK, GSD or other dumps in single precision:
#        cast(Float64) before sums by size, run or frame.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q polars==2.1.0 awkward==2.14.0 duckdb==2.0.1 pandas==3.1.1 pyarrow==26.0.1 numpy==2.4.6

cat >sums.py <<'END'
from importlib.metadata import version

import awkward
import duckdb
import numpy as np
import polars

print(*(f"{name} {version(name)}" for name in ("polars", "awkward", "duckdb", "pandas")))
SIZES, GRAINS = 2, 4_000_000  # of each size
mass = np.repeat(np.array([0.1, 0.3], np.float32), GRAINS)
grains = polars.DataFrame({"size": np.repeat(np.arange(SIZES), GRAINS), "mass": mass})
true = mass[[0, -1]].astype(float) * GRAINS
lazy = grains.lazy().group_by("size")
mean = polars.col("mass").mean() * GRAINS
wide = polars.col("mass").cast(polars.Float64).sum()


def by_size(table):
    return table.sort("size")["mass"].to_numpy()


found = {
    "group_by": by_size(grains.group_by("size").agg(polars.col("mass").sum())),
    "group_by, streaming": by_size(lazy.agg(polars.col("mass").sum()).collect(engine="streaming")),
    "group_by, mean by number": by_size(lazy.agg(mean).collect()),
    "group_by, as Float64": by_size(lazy.agg(wide).collect()),
    "over": by_size(grains.select("size", polars.col("mass").sum().over("size")).unique("size")),
    "filter": np.array([grains.filter(size=size)["mass"].sum() for size in range(SIZES)]),
    "duckdb": np.array(duckdb.sql("SELECT sum(mass) FROM grains GROUP BY size ORDER BY size").fetchall())[:, 0],
    "pandas": grains.to_pandas().groupby("size")["mass"].sum().to_numpy(),
    "awkward, axis=-1": awkward.sum(awkward.unflatten(mass, GRAINS), axis=-1).to_numpy(),
}
for way, masses in found.items():
    off = abs(masses / true - 1).max()
    print(f"{way}:", "off by more than a thousandth" if off > 1e-3 else "off by more than a millionth" if off > 1e-6 else "right")
ones = polars.DataFrame({"group": np.zeros(40_000_000, np.int8), "one": np.ones(40_000_000, np.float32)})
counted = ones.lazy().group_by("group").agg(polars.col("one").sum()).collect(engine="streaming")["one"][0]
stuck = counted < 4e7 and counted % 2**24 == 0
print(f"40 million ones: sum {ones['one'].sum():.0f}, by group a multiple of 2^24 below that: {stuck}")
END

seen=$(POLARS_MAX_THREADS=2 venv/bin/python sums.py)
expected='polars 2.1.0 awkward 2.14.0 duckdb 2.0.1 pandas 3.1.1
group_by: off by more than a thousandth
group_by, streaming: off by more than a thousandth
group_by, mean by number: right
group_by, as Float64: right
over: right
filter: right
duckdb: right
pandas: right
awkward, axis=-1: off by more than a thousandth
40 million ones: sum 40000000, by group a multiple of 2^24 below that: True'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
