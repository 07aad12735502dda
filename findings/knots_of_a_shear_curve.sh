#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# earth 5.3.2 (R, Debian 12; multivariate adaptive regression splines): a shear curve with displacements in m.
#
# Guess: knots, fit and R2 are the same whatever the unit of stress or displacement.
# Seen:  of stress so it is (by default it is scaled first, as the manual has it), and of displacements in mm. In m a line from 0 to
#        60 kPa that bends once starts at 9 kPa and bends twice, one from 0 to a peak of 100 kPa starts at 17, and a peak within the
#        first of 10 mm is lost: R2 = 0, one stress for all displacements, where in mm half of the scatter is explained. No warning,
#        and the manual names no unit for x.
# For us: the report fits no splines. To find peak and bends of curves in SI: earth(x / max(x), y), or displacements in mm.
set -euo pipefail
export LC_ALL=C

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p state cache
apt=(apt-get -qq -o Dir::State="$work/state" -o Dir::State::status=/var/lib/dpkg/status -o Dir::Cache="$work/cache"
    -o APT::Sandbox::User=root)
"${apt[@]}" update
needed=$("${apt[@]}" install --simulate --no-install-recommends r-cran-earth=5.3.2-1 | awk '/^Inst/ { print $2 }')
# shellcheck disable=SC2086
[[ -z $needed ]] || "${apt[@]}" download $needed
for package in *.deb; do [[ ! -e $package ]] || dpkg-deb -x "$package" root; done
R=R
if [[ -d root/usr/lib/R/bin ]]; then
    libraries=$work/root/usr/lib/x86_64-linux-gnu
    export R_HOME=$work/root/usr/lib/R
    mv "$R_HOME/etc/Renviron.ucf" "$R_HOME/etc/Renviron"  # as its installation does
    export LD_LIBRARY_PATH=$R_HOME/lib:$libraries:$libraries/blas:$libraries/lapack
    R=$R_HOME/bin/exec/R
fi
export R_LIBS=$work/root/usr/lib/R/site-library

cat >run.R <<'END'
suppressMessages(library(earth))
cat("earth", format(packageVersion("earth")), "\n")
shear <- seq(0, 10, length.out = 101)  # mm
curves <- list(loose = pmin(shear, 4) * 15, dense = approx(c(0, 3, 7, 10), c(0, 100, 60, 60), shear)$y,
  stiff = approx(c(0, 1, 2, 10), c(0, 100, 60, 60), shear)$y)
for (name in names(curves)) for (unit in c(1, 0.01, 0.001, 1e-6)) {
  model <- earth(shear * unit, curves[[name]])
  knots <- unique(sort(model$cuts[model$cuts != 0])) / unit
  cat(sprintf("%s, 1 mm as %g: knots at %s mm; R2 %.3f; at 0, 1 and 3 mm %.1f, %.1f and %.1f kPa\n", name, unit,
    paste(sprintf("%.1f", knots), collapse = ", "), model$rsq, round(predict(model, 0), 1) + 0, predict(model, unit),
    predict(model, 3 * unit)))
}
END

seen=$("$R" --vanilla --no-echo -f run.R)
expected='earth 5.3.2 
loose, 1 mm as 1: knots at 4.0 mm; R2 1.000; at 0, 1 and 3 mm 0.0, 15.0 and 45.0 kPa
loose, 1 mm as 0.01: knots at 4.0 mm; R2 1.000; at 0, 1 and 3 mm 0.0, 15.0 and 45.0 kPa
loose, 1 mm as 0.001: knots at 0.8, 4.0 mm; R2 0.991; at 0, 1 and 3 mm 9.0, 12.2 and 44.5 kPa
loose, 1 mm as 1e-06: knots at 0.8, 4.0 mm; R2 0.991; at 0, 1 and 3 mm 9.0, 12.2 and 44.5 kPa
dense, 1 mm as 1: knots at 2.8, 4.0, 7.2 mm; R2 0.997; at 0, 1 and 3 mm -1.1, 33.5 and 94.8 kPa
dense, 1 mm as 0.01: knots at 2.8, 4.0, 7.2 mm; R2 0.997; at 0, 1 and 3 mm -1.1, 33.5 and 94.8 kPa
dense, 1 mm as 0.001: knots at 0.8, 2.8, 5.6, 6.8 mm; R2 0.973; at 0, 1 and 3 mm 17.2, 25.5 and 98.4 kPa
dense, 1 mm as 1e-06: knots at 0.8, 2.8, 5.6, 6.8 mm; R2 0.973; at 0, 1 and 3 mm 17.2, 25.5 and 98.4 kPa
stiff, 1 mm as 1: knots at 1.6, 2.8, 4.0, 5.2 mm; R2 0.550; at 0, 1 and 3 mm 26.8, 66.0 and 57.6 kPa
stiff, 1 mm as 0.01: knots at 1.6, 2.8, 4.0, 5.2 mm; R2 0.550; at 0, 1 and 3 mm 26.8, 66.0 and 57.6 kPa
stiff, 1 mm as 0.001: knots at 1.6, 2.8 mm; R2 0.000; at 0, 1 and 3 mm 60.7, 60.7 and 60.7 kPa
stiff, 1 mm as 1e-06: knots at 1.6, 2.8 mm; R2 0.000; at 0, 1 and 3 mm 60.7, 60.7 and 60.7 kPa'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
