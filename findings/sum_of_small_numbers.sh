#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# num-utils 0.5-15 (Debian 12): sum, mean and bounds of numbers as LAMMPS writes them, such as 1.2e-05.
#
# Guess: numsum, numaverage and numbound read numbers in scientific notation as any other tool does, or they refuse them.
# Seen:  the exponent is cut off: the sum of 1.2e-05, 2.4e-05 and 4e-06 is 7.6, their largest is 4 (the smallest of the three), and
#        numround makes 1, 2 and 4 of them. So do numinterval, numnormalize and numprocess. Numbers without exponents, in the same
#        column, are right, so that a column whose numbers become small goes wrong half-way. It writes such numbers itself: of its
#        own sum 4e-05 numsum makes 4. No warning, and no word of it in the manual pages (a list of goals for the future has it).
# For us: thermo output, fix ave/time and dump files write overlaps, velocities and energies of grains in this way. Take datamash
#        (or awk), which is right. The tools of Shearbox use neither.
set -euo pipefail
export LC_ALL=C

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p state cache
apt=(apt-get -qq -o Dir::State="$work/state" -o Dir::State::status=/var/lib/dpkg/status -o Dir::Cache="$work/cache"
    -o APT::Sandbox::User=root)
"${apt[@]}" update
"${apt[@]}" download num-utils=0.5-15 datamash=1.7-2
for package in *.deb; do dpkg-deb -x "$package" root; done
PATH=$work/root/usr/bin:$PATH

printf '%s\n' 1.2e-05 2.4e-05 4e-06 >overlaps
printf '%s\n' 0.000012 0.000024 0.000004 >plain

seen=$(
    for file in plain overlaps; do
        echo "$file: sum $(numsum "$file"), mean $(numaverage "$file"), least $(numbound -l "$file"), largest $(numbound "$file")"
        echo "$file, datamash: $(datamash sum 1 mean 1 min 1 max 1 <"$file" | tr '\t' ' ')"
    done
    echo "rounded:" $(numround overlaps)
    echo "its own sum, read again: $(numsum plain | numsum)"
)
expected='plain: sum 4e-05, mean 1.33333333333333e-05, least 0.000004, largest 0.000024
plain, datamash: 4e-05 1.3333333333333e-05 4e-06 2.4e-05
overlaps: sum 7.6, mean 2.53333333333333, least 1.2, largest 4
overlaps, datamash: 4e-05 1.3333333333333e-05 4e-06 2.4e-05
rounded: 1 2 4
its own sum, read again: 4'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
