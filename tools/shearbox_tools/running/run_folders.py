# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of an ensemble: each is an ordinary run, with a folder, a request and a packing of its own."""

import os
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from ..asking.request import Request, check_folder, read_record
from ..base.errors import InputError, ShearboxError
from ..base.files import LOCK, RECORD
from .phases import Phase

MOST_SEEDS = 200  # of an ensemble: each of its runs keeps a file open, its lock
LARGEST_SEED = 2146  # that 1000000 SEED + 100 SIGMA is one of LAMMPS's
OF_ITS_OWN = "kPa"  # ending of the folder of a packing that serves one stress


@dataclass(frozen=True)
class Run:
    """A request in its folder; `name` tells it from other runs that are carried out with it."""

    folder: Path
    request: Request
    name: str = ""

    def label(self, phase: Phase) -> str:
        """How one of its phases is called among those of all runs."""
        return f"{self.name} {phase.label}".lstrip()


def planned(out: Path, request: Request, seeds: Iterable[int], independent: bool) -> list[Run]:
    """A run for each seed, with all stresses; or for each seed and stress (`independent`)."""
    if not independent:
        folders = {f"seed_{seed}": replace(request, seed=seed) for seed in seeds}
    else:
        folders = {
            f"seed_{seed}_{sigma:g}{OF_ITS_OWN}": replace(request, seed=own_seed(seed, sigma), stresses=(sigma,))
            for seed in seeds
            for sigma in request.stresses
        }
    return [Run(out / name, asked, name) for name, asked in folders.items()]


def own_seed(seed: int, sigma: float) -> int:
    """The seed of the packing for one stress (kPa, two decimals): another one for every pair."""
    return 1_000_000 * seed + round(100 * sigma)


def read_seeds(given: list[int | range], independent: bool, stresses: Iterable[float]) -> list[int]:
    """One number is how many, from 1 on; several, or ranges, are the seeds themselves. Refuses what cannot be meant."""
    text = f"--seeds {' '.join(map(_as_given, given))}"
    ranges = [one if isinstance(one, range) else range(one, one + 1) for one in given]
    hint = ""
    if len(given) == 1 and isinstance(given[0], int):
        ranges, hint = [range(1, given[0] + 1)], f"; --seed {given[0]} is one specimen with that seed"
    count = sum(max(0, some.stop - some.start) for some in ranges)  # before a list of them could fill the memory
    if not 1 <= count <= MOST_SEEDS:
        raise InputError(f"{text}: 1 to {MOST_SEEDS} specimens are expected{hint * (count > 0)}")
    seeds = [seed for some in ranges for seed in some]
    if len(set(seeds)) < len(seeds):
        raise InputError(f"{text}: a seed is named twice")
    if independent and not all(1 <= seed <= LARGEST_SEED for seed in seeds):
        raise InputError(f"{text}: with --independent, 1 to {LARGEST_SEED} are expected")
    for sigma in stresses:
        if independent and round(sigma, 2) != sigma:
            raise InputError(f"--stress {sigma:g}: with --independent, at most two decimals are expected")
    return seeds


def _as_given(seeds: int | range) -> str:
    return f"{seeds.start}-{seeds.stop - 1}" if isinstance(seeds, range) else str(seeds)


def find_runs(folder: Path, marks: tuple[str, ...] = (RECORD,)) -> list[Path]:
    """Folders at or below one that hold a file of such a name, in order of their names; what is below them is theirs. Links to
    folders are followed, each folder is found once.

    Raises ShearboxError for a folder that cannot be read: a mean without its specimens would not be missed.
    """
    found, seen = [], set()
    for place, below, files in os.walk(folder, onerror=_refuse, followlinks=True):
        if (real := os.path.realpath(place)) in seen:
            below.clear()
            continue
        seen.add(real)
        if any(mark in files for mark in marks):
            found.append(Path(place))
            below.clear()
    return sorted(found, key=_natural)


def _refuse(error: OSError) -> None:
    if isinstance(error, FileNotFoundError):
        return  # what is not there holds no run
    raise ShearboxError(f"{error.filename}: this folder cannot be read: {error.strerror}") from error


def check_out(out: Path, runs: list[Run]) -> None:
    """Refuse a folder that holds something else than runs which differ from these only in their seeds."""
    if (out / RECORD).exists():
        raise InputError(
            f"--out {out} holds a run of one specimen: without --seeds it goes on, else take another --out"
        )
    if out.exists() and not out.is_dir():
        raise InputError(f"--out {out}: this is a file, a folder is expected")
    for run in runs:
        check_folder(run.folder, run.request)
    there = find_runs(out) if out.is_dir() else []
    ours = {LOCK, *(run.name for run in runs)}  # also of an ensemble that is just beginning
    if not there and out.is_dir() and {path.name for path in out.iterdir()} - ours:
        raise InputError(
            f"--out {out}: this folder holds something else than runs (there is no {RECORD} in any folder)"
        )
    for other in there:
        if other.name.endswith(OF_ITS_OWN) != runs[0].name.endswith(OF_ITS_OWN):
            raise InputError(f"--out {out} holds {other.name}, with --independent or without; take another --out")
        request = replace(runs[0].request, seed=read_record(other)["identity"]["seed"])
        check_folder(other, request, may_replace=other in {run.folder for run in runs})


def _natural(path: Path) -> list[tuple[int, str]]:
    """The key that puts seed_2 before seed_10."""
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in re.split(r"(\d+)", str(path))]
