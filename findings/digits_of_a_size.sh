#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# python-ags4 1.2.0: numbers of a laboratory with significant figures (types 1SF, 2SF, 3SF of AGS4).
#
# Guess: convert_to_text rounds to as many figures as the type has, and a file it wrote passes rule 8 (data of the type told) of
#        check_file of the same package.
# Seen:  a number that rounding carries to the next power of ten gets one figure more: a size of 9.997 mm is written 10.00, a
#        coefficient of curvature of 0.97 as 1.0. The checker of the package rejects its own writer's file, and who reads it takes
#        the number for ten times as precise. No warning, and no word of it.
# For us: the tools write no AGS. Gradings and tests of real sands come in it: round to the figures first, then convert:
#        float(f"{x:.3g}").
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile python-ags4==1.2.0 pandas==2.3.3 numpy==2.4.6

cat >figures.py <<'END'
import contextlib
import io
from importlib.metadata import version

import pandas as pd
from python_ags4 import AGS4

print("python-ags4", version("python-ags4"))
columns = {  # headings and types of the standard dictionary: size in mm, coefficient of curvature, compressibility in m2/MN
    "GRAT_SIZE": ("GRAT", "3SF", [9.997, 0.09998, 4.756]),
    "GRAG_CC": ("GRAG", "1SF", [0.97, 0.095, 0.94]),
    "CONS_INMV": ("CONS", "2SF", [0.0997, 9.96, 0.0994]),
}
for heading, (group, kind, numbers) in columns.items():
    results = {}
    for name, values in ("as they are", numbers), ("rounded first", [float(f"{x:.{kind[0]}g}") for x in numbers]):
        table = pd.DataFrame({"HEADING": ["UNIT", "TYPE", *["DATA"] * 3], heading: ["", kind, *values]})
        with contextlib.redirect_stdout(io.StringIO()):
            written = AGS4.convert_to_text(table)
            AGS4.dataframe_to_AGS4({group: written}, {group: list(written.columns)}, "out.ags")
            errors = AGS4.check_file("out.ags").get("AGS Format Rule 8", [])
        print(f"{heading} ({kind}) {values} {name}: {', '.join(written[heading].tolist()[2:])}")
        for error in errors:
            print("  rule 8:", error["desc"])
END

seen=$(venv/bin/python figures.py 2>/dev/null)
expected='python-ags4 1.2.0
GRAT_SIZE (3SF) [9.997, 0.09998, 4.756] as they are: 10.00, 0.1000, 4.76
  rule 8: Value 10.00 in GRAT_SIZE not of data type 3SF. (Expected: 10.0)
  rule 8: Value 0.1000 in GRAT_SIZE not of data type 3SF. (Expected: 0.100)
GRAT_SIZE (3SF) [10.0, 0.1, 4.76] rounded first: 10.0, 0.100, 4.76
GRAG_CC (1SF) [0.97, 0.095, 0.94] as they are: 1.0, 0.10, 0.9
  rule 8: Value 1.0 in GRAG_CC not of data type 1SF. (Expected: 1)
  rule 8: Value 0.10 in GRAG_CC not of data type 1SF. (Expected: 0.1)
GRAG_CC (1SF) [1.0, 0.1, 0.9] rounded first: 1, 0.1, 0.9
CONS_INMV (2SF) [0.0997, 9.96, 0.0994] as they are: 0.100, 10.0, 0.099
  rule 8: Value 0.100 in CONS_INMV not of data type 2SF. (Expected: 0.10)
  rule 8: Value 10.0 in CONS_INMV not of data type 2SF. (Expected: 10)
CONS_INMV (2SF) [0.1, 10.0, 0.099] rounded first: 0.10, 10, 0.099'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
