#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# DuckDB 2.0.1 and PyArrow 26.0.1: rows of a Parquet file whose number is NaN.
#
# Guess: a filter finds the same rows in a Parquet file as in the same table in memory, NaN or not.
# Seen:  it does not. The file keeps the least and largest of a column without NaN, and both readers take these as the truth
#        about all rows. DuckDB, for which NaN is above all numbers, counts it below 100 in a file and above 100 in memory.
#        PyArrow loses the row if the filter is "not below 100". No word of it.
# For us: `shearbox export --to parquet` goes through pandas, which writes null for NaN, and null is filtered right. Who writes
#        tables of results with PyArrow itself: pyarrow.array(column, from_pandas=True).
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q duckdb==2.0.1 pyarrow==26.0.1 numpy==2.4.6

cat >filter.py <<'END'
import duckdb
import numpy as np
import pyarrow
from pyarrow import dataset, parquet

print("duckdb", duckdb.__version__, "pyarrow", pyarrow.__version__)
stress = np.arange(10.0)  # of ten cells, the fourth of which is empty
stress[3] = np.nan


def counts(name, **how):
    cells = pyarrow.table({"stress": pyarrow.array(stress, **how)})
    parquet.write_table(cells, f"{name}.parquet")
    below = dataset.field("stress") < 100
    print(name, "pyarrow, not below 100: memory", cells.filter(~below).num_rows, end=" ")
    print("file", dataset.dataset(f"{name}.parquet").to_table(filter=~below).num_rows)
    for condition in "stress < 100", "stress > 100":
        memory = duckdb.sql(f"SELECT count(*) FROM cells WHERE {condition}").fetchall()[0][0]
        file = duckdb.sql(f"SELECT count(*) FROM '{name}.parquet' WHERE {condition}").fetchall()[0][0]
        print(name, "duckdb,", condition.split()[1], "100: memory", memory, "file", file)


counts("nan")
counts("null", from_pandas=True)
END

seen=$(venv/bin/python filter.py)
expected='duckdb 2.0.1 pyarrow 26.0.1
nan pyarrow, not below 100: memory 1 file 0
nan duckdb, < 100: memory 9 file 10
nan duckdb, > 100: memory 1 file 0
null pyarrow, not below 100: memory 0 file 0
null duckdb, < 100: memory 9 file 9
null duckdb, > 100: memory 0 file 0'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
