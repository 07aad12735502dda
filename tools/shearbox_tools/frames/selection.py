# SPDX-License-Identifier: GPL-2.0-or-later
"""Which of the tests and frames in a folder a command is about."""

from collections.abc import Sequence
from pathlib import Path

from ..analysis.moments import missing_frames
from ..base.errors import InputError, ShearboxError
from ..base.files import SHEAR_TABLE
from ..running.run_folders import find_runs


def find_tests(folder: Path, stresses: Sequence[float]) -> list[Path]:
    """Folders of shear phases, by hand or of runs, all or those of the stresses (kPa); each has frames."""
    found = find_runs(folder, (SHEAR_TABLE,))
    if not found:
        raise ShearboxError(f"{folder} holds no test: there is no {SHEAR_TABLE} in it, nor below it")
    names = {f"{sigma:g}" for sigma in stresses}
    if unknown := sorted(names - {place.name for place in found}):
        there = " ".join(sorted({place.name for place in found}))
        raise InputError(f"--stress {' '.join(unknown)}: the folders of tests in {folder} are {there}")
    places = [place for place in found if not names or place.name in names]
    for place in places:
        if missing := missing_frames(place):
            raise ShearboxError(f"{place}: there is no {', '.join(missing)}, so there are no frames")
    return places


def choose(frames: str | None, steps: list[int]) -> list[int]:
    """Steps of the frames that are asked for: all, or FROM:TO:EVERY as in Python, or one by its number; -1 is the last."""
    if frames is None:
        return steps
    try:
        parts = [int(part) if part else None for part in frames.split(":")]
        chosen = steps[slice(*parts)] if len(parts) > 1 else [steps[int(frames)]]
    except (ValueError, TypeError, IndexError):
        chosen = []
    if not chosen:
        raise InputError(f"--frames {frames}: a number, or FROM:TO:EVERY, of 0 to {len(steps) - 1} is expected")
    return chosen
