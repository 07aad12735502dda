#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# ADIOS2 2.12.1 (PyPI adios2 2.12.1.1001): Stream.write of a column of a table.
#
# Guess: an array that is a view, such as a column, every second row or a transpose, is written as it reads, or is refused.
# Seen:  as many numbers as the view has are written as they lie in memory from its first on: of a table with the columns x and
#        y, "x" gets x, y, x, y ... Name, shape and type in the file are right, and nothing is said.
# For us: columns of tables of grains are such views. Write numpy.ascontiguousarray(column). `shearbox export` writes no ADIOS.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q adios2==2.12.1.1001 numpy==2.4.6

cat >columns.py <<'END'
import adios2
import numpy as np

print("adios2", adios2.__version__)
table = np.array([[1.0, 10.0], [2.0, 20.0], [3.0, 30.0], [4.0, 40.0]])  # a grain a row: x, y
arrays = {"x": table[:, 0], "copy of x": np.ascontiguousarray(table[:, 0]), "by column": table.T}
with adios2.Stream("grains.bp", "w") as stream:
    for name, array in arrays.items():
        stream.write(name, array, list(array.shape), [0] * array.ndim, list(array.shape))
with adios2.FileReader("grains.bp") as reader:
    for name, array in arrays.items():
        print(f"{name}: written {array.tolist()}, read {reader.read(name).tolist()}")
END

seen=$(venv/bin/python columns.py)
expected='adios2 2.12.1.1001
x: written [1.0, 2.0, 3.0, 4.0], read [1.0, 10.0, 2.0, 20.0]
copy of x: written [1.0, 2.0, 3.0, 4.0], read [1.0, 2.0, 3.0, 4.0]
by column: written [[1.0, 2.0, 3.0, 4.0], [10.0, 20.0, 30.0, 40.0]], read [[1.0, 10.0, 2.0, 20.0], [3.0, 30.0, 4.0, 40.0]]'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
