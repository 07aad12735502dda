#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# geolysis 0.24.1: names of sands with fines of low plasticity, and group index of AASHTO.
#
# Guess: a sand with more than 12 % of fines has the two names SC-SM where its plasticity lies in the hatched zone of the chart, at 4 to
#        7 on or above the A-line, and is SM below that line. The group index is that of the formula of the manual, or of the same
#        one with each bracket not below 0.
# Seen:  the other way round: in the zone the name is SC, below the line SM-SC. (Fines alone, in the zone, are ML-CL, which is right;
#        below the line they are, too, and not ML.) In the group index brackets below 0 count as 1: a silt that has 6 by the
#        formula, and 8 with brackets not below 0, is A-4(9). No word of it.
# For us: the names are those of reports on real sands. Look at the chart for every plasticity index of 4 to 7. Models here are clean.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile geolysis==0.24.1 func-validator==1.5.0

cat >names.py <<'END'
from importlib.metadata import version

from geolysis.soil_classifier import create_aashto_classifier, create_uscs_classifier

print("geolysis", version("geolysis"))
for liquid, plastic in (22, 16), (28, 23), (35, 22):
    index = liquid - plastic
    above = index >= 0.73 * (liquid - 20)
    names = "SC-SM, CL-ML" if above and 4 <= index <= 7 else "SC, CL" if above else "SM, ML"
    found = [create_uscs_classifier(liquid, plastic, fines, sand=100 - fines).classify().symbol for fines in (30, 60)]
    print(f"liquid limit {liquid}, plasticity {index}, A-line {0.73 * (liquid - 20):.1f}:",
          f"sand and fines by the chart {names}, by geolysis {', '.join(found)}")
liquid, plastic, fines = 38, 30, 75
a, b, c, d = fines - 35, liquid - 40, fines - 15, liquid - plastic - 10
print(f"group index: by the formula {a * (0.2 + 0.005 * b) + 0.01 * c * d:.1f},",
      f"none below 0 {min(a, 40) * (0.2 + 0.005 * max(b, 0)) + 0.01 * min(c, 40) * max(d, 0):.1f},",
      "by geolysis", create_aashto_classifier(liquid, plastic, fines).classify().symbol)
END

seen=$(venv/bin/python names.py)
expected='geolysis 0.24.1
liquid limit 22, plasticity 6, A-line 1.5: sand and fines by the chart SC-SM, CL-ML, by geolysis SC, ML-CL
liquid limit 28, plasticity 5, A-line 5.8: sand and fines by the chart SM, ML, by geolysis SM-SC, ML-CL
liquid limit 35, plasticity 13, A-line 10.9: sand and fines by the chart SC, CL, by geolysis SC, CL
group index: by the formula 6.4, none below 0 8.0, by geolysis A-4(9)'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
