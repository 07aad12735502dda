#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# interlace-lme 0.3.2 (interlace): degrees of freedom of a mixed model of a few specimens, by Satterthwaite's method.
#
# Guess: of six specimens, each tested at four stresses, they are those of the closed form, as the data are balanced: 17 for the
#        effect of stress (24 tests less 6 specimens and 1).
# Seen:  75, more than there are tests, and 7.3 for the intercept, where 5.5 is right. With two groups of specimens 89, and 4.9 for
#        their difference, where 4 is right. Its own Kenward and Roger are right, as is mixedlm. Errors are right, so p are too
#        small: 0.120 for 0.132. fe_conf_int takes 1.96 errors with either method: an interval of 3.5 degrees for one of 5.0. No
#        warning; the manual says validated against R.
# For us: ensembles of a few packings, sheared at the same stresses, are such data; the tools compare packing by packing or by
#        Welch's test. Take mixedlm or lme-python; or df_method="kenward-roger", and intervals from fe_bse and
#        Student's t.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile interlace-lme==0.3.2 mixedlm==1.3.0 numpy==2.4.6 scipy==1.17.1 pandas==3.1.1 formulaic==1.2.2 \
  statsmodels==0.15.0

cat >freedom.py <<'END'
import warnings

warnings.simplefilter("error", UserWarning)
from importlib.metadata import version

import interlace
import mixedlm
import numpy as np
import pandas as pd
from scipy import stats

print("interlace-lme", version("interlace-lme"), "mixedlm", version("mixedlm"))
angles = np.array(  # secant friction angles of six specimens at 100, 200, 300, 400 kPa
    [[39.9, 38.7, 37.6, 37.2], [41.2, 40.3, 38.7, 38.6], [38.8, 38.1, 36.9, 35.8],
     [38.2, 37.5, 36.1, 35.6], [39.5, 37.9, 37.4, 36.4], [36.9, 36.5, 35.1, 34.4]]
)
tests = pd.DataFrame({"angle": angles.ravel(), "stress": np.tile([100.0, 200, 300, 400], 6),
                      "specimen": np.repeat(list("abcdef"), 4), "moist": np.repeat([0.0, 1.0], 12)})

# closed form of both effects: the slope within specimens, the difference between their means
stress = tests.stress.to_numpy().reshape(6, 4) - 250
slope = (stress * angles).sum() / (stress**2).sum()
within = angles - angles.mean(axis=1, keepdims=True) - slope * stress
print(f"closed form: errors {np.sqrt((within**2).sum() / 17 / (stress**2).sum()):.5f} (stress)",
      f"{np.sqrt(sum(group.var(ddof=1) for group in np.split(angles.mean(axis=1), 2)) / 3):.2f} (moist), df 17 and 4")
for method in "satterthwaite", "kenward-roger":
    fit = interlace.fit("angle ~ moist + stress", tests, groups="specimen", df_method=method)
    low, high = fit.fe_conf_int.loc["moist"]
    print(f"interlace, {method}: errors {fit.fe_bse['stress']:.5f} {fit.fe_bse['moist']:.2f}, df {fit.fe_df['stress']:.0f}",
          f"and {fit.fe_df['moist']:.1f}, moist p = {fit.fe_pvalues['moist']:.3f}, interval {low:.1f} to {high:.1f}")
    reach = stats.t.ppf(0.975, 4) * fit.fe_bse["moist"]
print(f"Student's t of 4: interval {fit.fe_params['moist'] - reach:.1f} to {fit.fe_params['moist'] + reach:.1f}")
other = mixedlm.lmer("angle ~ moist + stress + (1 | specimen)", tests)
print("mixedlm, satterthwaite: df", " and ".join(f"{df:.1f}" for df in mixedlm.satterthwaite_df(other).df[:0:-1]),
      f"moist p = {mixedlm.pvalues_with_ddf(other)['moist'][2]:.3f}")
for method in "satterthwaite", "kenward-roger":
    fit = interlace.fit("angle ~ stress", tests, groups="specimen", df_method=method)
    print(f"without groups, {method}: df {fit.fe_df['stress']:.0f} and {fit.fe_df['Intercept']:.1f}")
END

seen=$(venv/bin/python freedom.py)
expected='interlace-lme 0.3.2 mixedlm 1.3.0
closed form: errors 0.00049 (stress) 0.90 (moist), df 17 and 4
interlace, satterthwaite: errors 0.00049 0.90, df 89 and 4.9, moist p = 0.120, interval -3.5 to 0.1
interlace, kenward-roger: errors 0.00049 0.90, df 17 and 4.0, moist p = 0.134, interval -3.5 to 0.1
Student'\''s t of 4: interval -4.2 to 0.8
mixedlm, satterthwaite: df 17.0 and 4.0 moist p = 0.132
without groups, satterthwaite: df 75 and 7.3
without groups, kenward-roger: df 17 and 5.5'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
