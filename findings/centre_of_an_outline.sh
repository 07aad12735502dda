#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# pracma 2.4.2 (R, Debian 12): centre and length of the outline of a grain.
#
# Guess: the centre and the length are those of the closed outline, as the area is: one page of the manual tells of all three, and
#        that a polygon is closed, so that its last point should not be the same as the first.
# Seen:  only polyarea closes it. poly_length lacks the last side, 6 for a square of 2 x 2. poly_center counts all sides but one, and
#        divides by the whole area: near the origin the centre is off by little, at 10, 10 that of a grain of 60 corners is at 9.4,
#        9.6, and that of a square at 23.5, 25; the farther off, the worse. No warning.
# For us: outlines of grains in images come open, as contours do. Repeat the first corner for poly_center and poly_length; polyarea
#        does not mind. Grains of the models are of discs.
set -euo pipefail
export LC_ALL=C

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p state cache
apt=(apt-get -qq -o Dir::State="$work/state" -o Dir::State::status=/var/lib/dpkg/status -o Dir::Cache="$work/cache"
    -o APT::Sandbox::User=root)
"${apt[@]}" update
needed=$("${apt[@]}" install --simulate --no-install-recommends r-cran-pracma=2.4.2-1 | awk '/^Inst/ { print $2 }')
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
suppressMessages(library(pracma))
cat("pracma", format(packageVersion("pracma")), "\n")
turn <- 2 * pi * (0:59) / 60
measures <- function(x, y) {
  centre <- poly_center(x, y)
  sprintf("area %.3f, length %.3f, centre %.2f %.2f", polyarea(x, y), poly_length(x, y), centre[1] + 1e-9, centre[2] + 1e-9)
}
show <- function(name, x, y) {
  cat(sprintf("%s: %s; with the first corner again: %s\n", name, measures(x, y), measures(c(x, x[1]), c(y, y[1]))))
}
for (place in c(0, 10, 100)) {
  show(sprintf("square at %g, %g", place, place), place + c(-1, 1, 1, -1), place + c(-1, -1, 1, 1))
  show(sprintf("60 corners at %g, %g", place, place), place + 3 * cos(turn), place + 2 * sin(turn))
}
END

seen=$("$R" --vanilla --no-echo -f run.R)
expected='pracma 2.4.2 
square at 0, 0: area 4.000, length 6.000, centre 0.17 0.00; with the first corner again: area 4.000, length 8.000, centre 0.00 0.00
60 corners at 0, 0: area 18.815, length 15.648, centre -0.03 0.00; with the first corner again: area 18.815, length 15.858, centre 0.00 0.00
square at 10, 10: area 4.000, length 6.000, centre 23.50 25.00; with the first corner again: area 4.000, length 8.000, centre 10.00 10.00
60 corners at 10, 10: area 18.815, length 15.648, centre 9.41 9.55; with the first corner again: area 18.815, length 15.858, centre 10.00 10.00
square at 100, 100: area 4.000, length 6.000, centre 1733.50 1750.00; with the first corner again: area 4.000, length 8.000, centre 100.00 100.00
60 corners at 100, 100: area 18.815, length 15.648, centre 63.71 64.80; with the first corner again: area 18.815, length 15.858, centre 100.00 100.00'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
