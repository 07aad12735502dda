#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# MPICH 5.0.2 and mpi4py 4.1.2: MPI_Allreduce of the maximum, where one rank has NaN.
#
# Guess: all ranks get the same number, be it NaN or the largest of the others: that is what "all" promises.
# Seen:  on two ranks one gets NaN and the other a number; on four, one also gets a number that is not the largest of all.
#        No error. (Open MPI 5.0.11 gave all ranks the same, which is at times not the largest number either.) Ranks that
#        branch on such a maximum part ways, and the run hangs in the next collective call.
# For us: the guard of fix cdem/integrate puts infinity in place of NaN before it asks for the largest motion. So must every
#        maximum or minimum that ranks branch on.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q mpich==5.0.2 mpi4py==4.1.2 numpy==2.4.6

cat >largest.py <<'END'
import numpy as np
from mpi4py import MPI

world = MPI.COMM_WORLD
if world.rank == 0:
    print(*MPI.Get_library_version().split()[:3])
for odd in range(world.size):
    mine = np.array([np.nan if world.rank == odd else float(world.rank)])
    largest = np.empty(1)
    world.Allreduce(mine, largest, MPI.MAX)
    on_ranks = world.gather(largest[0])
    if world.rank == 0:
        print(f"{world.size} ranks, NaN on {odd}:", *on_ranks)
END

seen=$(for ranks in 2 4; do
  LD_LIBRARY_PATH=$PWD/venv/lib timeout 60 venv/bin/mpiexec -n $ranks venv/bin/python largest.py
done)
expected='MPICH Version: 5.0.2
2 ranks, NaN on 0: 1.0 nan
2 ranks, NaN on 1: nan 0.0
MPICH Version: 5.0.2
4 ranks, NaN on 0: 3.0 3.0 3.0 nan
4 ranks, NaN on 1: 3.0 3.0 nan 3.0
4 ranks, NaN on 2: 3.0 nan 3.0 1.0
4 ranks, NaN on 3: nan 2.0 1.0 2.0'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
