#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# GMT 6.4.0 (gmt, Debian 12): the line of a shear box, strength over normal stress, by gmt regress.
#
# Guess: slope, cohesion and their errors are those of least squares by the closed form, the same in Pa as in MPa, and with known
#        errors (-Wy) those of weighted least squares; by least absolute differences (-N1) the line doesn't depend on the unit.
# Seen:  lines of least squares are right. "sigma_slope" and "sigma_intercept" are those of readings that scatter by 1, whatever the
#        unit and whatever the scatter: a slope of 0.673 +- 0.030 and a cohesion of 14.5 +- 8.1 kPa come out with errors of 0.0045
#        and 0.5 kPa for stresses in kPa, 0.000004 and 0.0005 kPa in Pa, 4.5 and 500 kPa in MPa. With an error of 8 kPa told for
#        each reading the slope's error is right, but the cohesion's is 4.0 for 9.8 kPa: that of the line at the mean stress, not
#        at 0. The 95 % bands of the same command (-Fc) are right. With -N1 the slope, too, depends on the unit: the lid lifts
#        by 0.10 mm per mm in mm and in um, and by 0.00 if its lift is given in m. No warning; the manual has the names of the
#        errors, no more.
# For us: errors of friction and cohesion that look plausible in kPa. Take bands (-Fc), or scipy.stats.linregress; for -N1 scale
#        both axes to numbers near 1. The report of Shearbox does not use GMT.
set -euo pipefail
export LC_ALL=C

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p state cache home
apt=(apt-get -qq -o Dir::State="$work/state" -o Dir::State::status=/var/lib/dpkg/status -o Dir::Cache="$work/cache"
    -o APT::Sandbox::User=root)
"${apt[@]}" update
needed=$("${apt[@]}" install --simulate --no-install-recommends gmt=6.4.0+dfsg-2 | awk '/^Inst/ { print $2 }')
# shellcheck disable=SC2086
[[ -z $needed ]] || "${apt[@]}" download $needed
for package in *.deb; do [[ ! -e $package ]] || dpkg-deb -x "$package" root; done
libraries=$work/root/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$libraries:$work/root/usr/lib:$libraries/blas:$libraries/lapack GMT_USERDIR=$work/home
if [[ -d root/usr/share/gmt ]]; then export PATH=$work/root/usr/bin:$PATH GMT_SHAREDIR=$work/root/usr/share/gmt; fi

# four specimens: normal stress and strength in kPa
printf '%s\n' '100 82' '200 145' '300 224' '400 280' >strength
# lift of the lid, in mm, while it dilates, over displacement, in mm; one reading is off
printf '%s\n' '1 0.11' '2 0.19' '3 0.32' '4 0.29' '5 0.51' >lift

seen=$(
    gmt --version
    while read -r unit kpa; do
        awk -v kpa="$kpa" '{ print $1 / kpa, $2 / kpa }' strength | gmt regress -Fp -N2 |
            awk -v unit="$unit" -v kpa="$kpa" \
                '{ printf "in %s: slope %.4f +- %.6f, cohesion %.2f +- %.4f kPa\n", unit, $6, $8, $7 * kpa, $9 * kpa }'
    done <<'END'
Pa 0.001
kPa 1
MPa 1000
END
    awk '{ print $1, $2, 8 }' strength | gmt regress -Fp -N2 -Wy |
        awk '{ printf "each +- 8 kPa: slope %.4f +- %.4f, cohesion %.2f +- %.2f kPa\n", $6, $8, $7, $9 }'
    gmt regress strength -Fxmc -C95 -N2 | awk '/^[0-9]/ { printf "95 %% at %g kPa: %.2f +- %.2f\n", $1, $2, $3 }'
    while read -r mm name; do
        for norm in 2 1; do
            awk -v mm="$mm" '{ printf "%.10g %.10g\n", $1, $2 * mm }' lift | gmt regress -Fp -N$norm |
                awk -v mm="$mm" -v name="$name" -v norm="$norm" \
                    '{ printf "lift in %s, -N%s: %.2f mm per mm\n", name, norm, $6 / mm }'
        done
    done <<'END'
1 mm
1000 um
0.001 m
END
)
expected='6.4.0
in Pa: slope 0.6730 +- 0.000004, cohesion 14.50 +- 0.0005 kPa
in kPa: slope 0.6730 +- 0.004472, cohesion 14.50 +- 0.5000 kPa
in MPa: slope 0.6730 +- 4.472136, cohesion 14.50 +- 500.0000 kPa
each +- 8 kPa: slope 0.6730 +- 0.0358, cohesion 14.50 +- 4.00 kPa
95 % at 100 kPa: 81.80 +- 23.92
95 % at 200 kPa: 149.10 +- 15.66
95 % at 300 kPa: 216.40 +- 15.66
95 % at 400 kPa: 283.70 +- 23.92
lift in mm, -N2: 0.09 mm per mm
lift in mm, -N1: 0.10 mm per mm
lift in um, -N2: 0.09 mm per mm
lift in um, -N1: 0.10 mm per mm
lift in m, -N2: 0.09 mm per mm
lift in m, -N1: 0.00 mm per mm'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
