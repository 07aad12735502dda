#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# qtoolkit 0.1.7: memory of a job that runs, as read from Slurm's and PBS's own words.
#
# Guess: 2 GB for each of four CPUs is `memory_per_cpu` of 2 GB, or `memory` of 8 GB of the job, by either scheduler, and the same
#        whether one asks for one job or for the list. (Both are in kB.)
# Seen:  the two are mixed up. Of Slurm's scontrol the memory of one CPU comes as that of the job: 2 GB for 8; in the list, by
#        squeue, it is `memory_per_cpu`. Of PBS the memory of the whole job comes as that of a CPU: 8 GB for 2. A Slurm job that
#        asked for 8 GB for its node has no memory at all by scontrol, and 8 GB for each CPU in the list. No error, and no word of
#        it. CPUs, nodes and time limits are right, and so are headers of scripts that are submitted.
# For us: `shearbox submit` does without it. What the next, larger model needs is off by the number of CPUs: take AllocTRES of
#        `sacct`, or TRES= of `scontrol show job`, which tell of the whole job.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile qtoolkit==0.1.7

cat >memory.py <<'END'
import warnings

warnings.simplefilter("error")
from importlib.metadata import version

from qtoolkit.io.pbs import PBSIO
from qtoolkit.io.slurm import SlurmIO

print("qtoolkit", version("qtoolkit"))
SCONTROL = """JobId=14 JobName=shear
   UserId=sand(1001) GroupId=sand(1001) MCS_label=N/A
   JobState=RUNNING Reason=None Dependency=(null)
   RunTime=01:30:05 TimeLimit=1-12:00:00 TimeMin=N/A
   Partition=main AllocNode:Sid=head:1
   NodeList=c1
   NumNodes=1 NumCPUs=4 NumTasks=4 CPUs/Task=1 ReqB:S:C:T=0:0:*:*
   TRES=cpu=4,mem=8G,node=1,billing=4
   MinCPUsNode=1 {} MinTmpDiskNode=0
   WorkDir=/home/sand
"""
QSTAT = """Job Id: 14.head
    Job_Name = shear
    Job_Owner = sand@head
    resources_used.walltime = 01:30:05
    job_state = R
    queue = main
    exec_host = c1/0*4
    Resource_List.mem = 8gb
    Resource_List.ncpus = 4
    Resource_List.nodect = 1
    Resource_List.select = 1:ncpus=4:mpiprocs=4:mem=8gb
    Resource_List.walltime = 36:00:00
"""
FIELDS = {"%i": "14", "%t": "R", "%r": "None", "%j": "shear", "%u": "sand", "%P": "main", "%l": "1-12:00:00", "%D": "1", "%C": "4",
          "%M": "1:30:05"}


def told(name, job):
    memory = ["none" if kilobytes is None else f"{kilobytes / 1024**2:g} GB"
              for kilobytes in (job.info.memory, job.info.memory_per_cpu)]
    print(f"{name}: memory {memory[0]}, memory_per_cpu {memory[1]}, {job.info.cpus} CPUs, {job.info.nodes} node,",
          f"{job.info.time_limit / 3600:g} h")


slurm, pbs = SlurmIO(), PBSIO()
squeue = slurm.get_jobs_list_cmd(None, "sand").split("-o '")[1].split("'")[0]  # the format it asks for
for asked, minimum, listed in ("2 GB a CPU", "MinMemoryCPU=2G", "2G"), ("8 GB a node", "MinMemoryNode=8G", "8G"):
    told(f"Slurm, {asked}, scontrol", slurm.parse_job_output(0, SCONTROL.format(minimum), ""))
    line = squeue
    for key, value in (FIELDS | {"%m": listed}).items():
        line = line.replace(key, value)
    told(f"Slurm, {asked}, squeue", slurm.parse_jobs_list_output(0, line + "\n", "")[0])
told("PBS, 8 GB a job, qstat", pbs.parse_job_output(0, QSTAT, ""))
END

seen=$(venv/bin/python memory.py)
expected='qtoolkit 0.1.7
Slurm, 2 GB a CPU, scontrol: memory 2 GB, memory_per_cpu none, 4 CPUs, 1 node, 36 h
Slurm, 2 GB a CPU, squeue: memory none, memory_per_cpu 2 GB, 4 CPUs, 1 node, 36 h
Slurm, 8 GB a node, scontrol: memory none, memory_per_cpu none, 4 CPUs, 1 node, 36 h
Slurm, 8 GB a node, squeue: memory none, memory_per_cpu 8 GB, 4 CPUs, 1 node, 36 h
PBS, 8 GB a job, qstat: memory none, memory_per_cpu 8 GB, 4 CPUs, 1 node, 36 h'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
