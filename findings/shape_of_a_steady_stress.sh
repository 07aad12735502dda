#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Miller 6.6.0 (mlr, Debian 12): skewness, kurtosis and standard deviation of a column that scatters little about a large mean.
#
# Guess: mlr stats1 gives what other tools give, to 3 digits: of a stress of 100 kPa +- 10 Pa, or of balls of 5 mm +- 1 um, the file
#        has all the digits that this needs.
# Seen:  standard deviations are right, until the scatter is some ten millionths of the mean: 101325 +- 0.01 Pa has one of 0.00605,
#        where 0.00586 is right. Kurtosis fails a thousand times sooner: evenly spread values, whose kurtosis is -1.2, have -3 at
#        100 kPa +- 10 Pa, 1.4 for the balls, 360 thousand at +- 1 Pa and -3e10 at +- 0.1 Pa, where the skewness is 8700 for 0. It
#        looks as if sums of powers were taken of the values as they are, not of their differences from the mean. No warning.
# For us: is the servo's stress normally distributed, does a size have a tail? Of logs and tables take the moments by datamash, or
#        take the mean away first. The report of Shearbox does not use Miller.
set -euo pipefail
export LC_ALL=C

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p state cache
apt=(apt-get -qq -o Dir::State="$work/state" -o Dir::State::status=/var/lib/dpkg/status -o Dir::Cache="$work/cache"
    -o APT::Sandbox::User=root)
"${apt[@]}" update
"${apt[@]}" download miller=6.6.0-2+b3 datamash=1.7-2
for package in *.deb; do dpkg-deb -x "$package" root; done
PATH=$work/root/usr/bin:$PATH

# 101 values spread evenly over mean +- width, out of order
values() {
    awk -v mean="$1" -v width="$2" 'BEGIN { for (i = 0; i < 101; i++) printf "%.7f\n", mean + width * (i * 37 % 101 - 50) / 50 }'
}
brief() { awk '{ printf "%.3g %.2g %.2g", $1, $2 ^ 2 < 1e-6 ? 0 : $2, $3 }'; }

seen=$(
    mlr --version
    while read -r mean width; do
        echo "$mean +- $width: deviation, skewness, kurtosis" \
            "by miller $(values "$mean" "$width" | mlr --inidx --onidx stats1 -a stddev,skewness,kurtosis -f 1 | brief)," \
            "by datamash $(values "$mean" "$width" | datamash sstdev 1 pskew 1 pkurt 1 | brief)"
    done <<'END'
100 10
100000 10
100000 1
100000 0.1
101325 0.01
5 0.001
END
)
expected='mlr 6.6.0
100 +- 10: deviation, skewness, kurtosis by miller 5.86 0 -1.2, by datamash 5.86 0 -1.2
100000 +- 10: deviation, skewness, kurtosis by miller 5.86 0.0024 -3, by datamash 5.86 0 -1.2
100000 +- 1: deviation, skewness, kurtosis by miller 0.586 0 3.6e+05, by datamash 0.586 0 -1.2
100000 +- 0.1: deviation, skewness, kurtosis by miller 0.0585 8.7e+03 -3.2e+10, by datamash 0.0586 0 -1.2
101325 +- 0.01: deviation, skewness, kurtosis by miller 0.00605 -5e+06 2.4e+14, by datamash 0.00586 0 -1.2
5 +- 0.001: deviation, skewness, kurtosis by miller 0.000586 0 1.4, by datamash 0.000586 0 -1.2'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
