#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# spatstat.geom 3.0-6 with deldir 1.0-6 (R, Debian 12): areas of Voronoi cells of grains, by dirichletAreas, in metres.
#
# Guess: the areas add up to the box, whatever the unit, and are those of the tiles that dirichlet of the same package finds.
# Seen:  in mm so it is. In m all areas are rounded to whole 0.000001 m^2: in a box of 0.12 x 0.05 m those of 350 grains are off by
#        up to 25 %, though their sum is right; in one of 12 x 5 mm all but two are 0, and the sum is 3 % of the box. The tiles
#        themselves are right. No warning; the manual says that areas are "computed exactly using analytic geometry".
# For us: solid fractions and pores by Voronoi cells, where grains are read from dumps in SI. Take tile.areas(dirichlet(X)), or
#        give mm. Shearbox needs no Voronoi cells for solid fractions.
set -euo pipefail
export LC_ALL=C

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p state cache
apt=(apt-get -qq -o Dir::State="$work/state" -o Dir::State::status=/var/lib/dpkg/status -o Dir::Cache="$work/cache"
    -o APT::Sandbox::User=root)
"${apt[@]}" update
needed=$("${apt[@]}" install --simulate --no-install-recommends r-cran-spatstat.geom=3.0-6-1 r-cran-deldir=1.0-6-1+b1 |
    awk '/^Inst/ { print $2 }')
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

cat >cells.R <<'END'
suppressMessages(library(spatstat.geom))
cat("spatstat.geom", format(packageVersion("spatstat.geom")), "deldir", format(packageVersion("deldir")), "\n")
index <- 1:350
along <- (index^2 * sqrt(2)) %% 1  # scattered, without random numbers
across <- (index^2 * sqrt(3)) %% 1
for (length in c(120, 12, 0.12, 0.012)) {
  height <- length * 5 / 12
  grains <- ppp(along * length, across * height, c(0, length), c(0, height))
  cells <- dirichletAreas(grains) / (length * height)
  tiles <- tile.areas(dirichlet(grains)) / (length * height)
  error <- abs(cells / tiles - 1)
  cat(sprintf("box %g x %g: areas add up to %.3f, tiles to %.3f; areas of 0: %d, off by more than 5 %%: %d, largest: %.0f %%\n",
    length, height, sum(cells), sum(tiles), sum(cells == 0), sum(error > 0.05), 100 * max(error)))
}
END

seen=$("$R" --vanilla --no-echo -f cells.R)
expected='spatstat.geom 3.0.6 deldir 1.0.6 
box 120 x 50: areas add up to 1.000, tiles to 1.000; areas of 0: 0, off by more than 5 %: 0, largest: 0 %
box 12 x 5: areas add up to 1.000, tiles to 1.000; areas of 0: 0, off by more than 5 %: 0, largest: 0 %
box 0.12 x 0.05: areas add up to 1.000, tiles to 1.000; areas of 0: 0, off by more than 5 %: 21, largest: 25 %
box 0.012 x 0.005: areas add up to 0.033, tiles to 1.000; areas of 0: 348, off by more than 5 %: 350, largest: 100 %'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
