#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# SciPy 1.17.1 writes a NetCDF file of a run, netcdfjs 4.0.0 (npm) reads it: whole numbers of one or two bytes, a row a time.
#
# Guess: as many numbers come back for each time as there are grains, and the same ones.
# Seen:  so it is with numbers of four and eight bytes. Beside another variable over time rows of small ones have more: types of three
#        grains come back as 0, 1, 2, -32767, and one flag for each time as 0, 129, 129, 129. Rows in a file begin at multiples of
#        four bytes, and what fills them up is read as data, so that a mean or a count is off. Even numbers of grains with two bytes,
#        and a variable alone, which is not filled up, show nothing. And a byte has no sign: -1 comes back as 255. No warning.
# For us: types and flags of grains are such numbers. Cut rows to the length that reader.dimensions tells, or write "i" in place of
#        "h" and "b". `shearbox export` writes no NetCDF.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q scipy==1.17.1 numpy==2.4.6
npm install --silent --no-fund --no-audit --no-save --ignore-scripts --prefix . netcdfjs@4.0.0 >/dev/null

cat >write.py <<'END'
import numpy as np
import scipy
from scipy.io import netcdf_file

print("scipy", scipy.__version__)
for name, kinds in {"alone": "h", "beside": "bhid", "four": "bhid"}.items():
    with netcdf_file(f"{name}.nc", "w") as file:
        file.createDimension("time", None)
        file.createDimension("grain", 4 if name == "four" else 3)
        variables = [file.createVariable(kind, kind, ("time", "grain")) for kind in kinds]
        if name != "alone":
            variables.append(file.createVariable("flag", "b", ("time",)))
        for time in range(2):
            for variable in variables:
                variable[time] = -time if variable.dimensions == ("time",) else np.arange(variable.shape[1]) + 10 * time
END
cat >read.mjs <<'END'
import { readFileSync } from 'node:fs';
import { NetCDFReader } from 'netcdfjs';

for (const name of ['alone', 'beside', 'four']) {
  const reader = new NetCDFReader(readFileSync(`${name}.nc`));
  const grains = reader.dimensions.find((dimension) => dimension.name === 'grain').size;
  const rows = reader.variables.map((variable) => `${variable.name} ${JSON.stringify(reader.getDataVariable(variable.name))}`);
  console.log(`${name}, ${grains} grains: ${rows.join(', ')}`);
}
END

seen=$(
    venv/bin/python write.py
    echo "netcdfjs $(node -p "require('./node_modules/netcdfjs/package.json').version")"
    node read.mjs
)
expected='scipy 1.17.1
netcdfjs 4.0.0
alone, 3 grains: h [[0,1,2],[10,11,12]]
beside, 3 grains: b [[0,1,2,129],[10,11,12,129]], h [[0,1,2,-32767],[10,11,12,-32767]], i [[0,1,2],[10,11,12]], d [[0,1,2],[10,11,12]], flag [[0,129,129,129],[255,129,129,129]]
four, 4 grains: b [[0,1,2,3],[10,11,12,13]], h [[0,1,2,3],[10,11,12,13]], i [[0,1,2,3],[10,11,12,13]], d [[0,1,2,3],[10,11,12,13]], flag [[0,129,129,129],[255,129,129,129]]'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
