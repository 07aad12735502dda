# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs put together to ensembles: those that differ only in their seeds and stresses."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .ensemble_results import Ensemble
from .models import PARAMETERS, read_variables
from .parameters import canonical
from .results import Results

UNITS = {"speed_mm_s": ("speed", " mm/s"), "travel_mm": ("travel", " mm")}


@dataclass(frozen=True)
class LeftOut:
    """A run that is in no ensemble, and why."""

    folder: Path
    reason: str


def put_together(runs: Iterable[Results]) -> tuple[list[Ensemble], list[LeftOut]]:
    """Ensembles in order of their first runs. Incomplete and damaged runs are left out, and a packing that is there
    already: it is no specimen more."""
    groups: dict[tuple[tuple[str, str], ...], list[Results]] = {}
    left_out = []
    for run in runs:
        if not run.complete:
            left_out.append(LeftOut(run.folder, "; ".join([*run.problems, *run.doubts])))
            continue
        group = groups.setdefault(tuple(sorted(settings_of(run.identity).items())), [])
        same = next((other for other in group if other.identity["seed"] == run.identity["seed"]), None)
        if same:
            left_out.append(LeftOut(run.folder, f"the same packing as {same.folder.name}: seed {run.identity['seed']}"))
        else:
            group.append(run)
    return [Ensemble(group) for group in groups.values()], left_out


def settings_of(identity: Mapping[str, Any]) -> dict[str, str]:
    """All that a run was asked for but its seed, as text that is the same for the same value."""
    flat = {name: value for name, value in identity.items() if name not in ("parameters", "seed")}
    return {name: canonical(str(value)) for name, value in (flat | identity["parameters"]).items()}


def what_differs(ensembles: Sequence[Ensemble]) -> list[str]:
    """For each ensemble what tells it from others of the same model; tests run by hand do not know all settings."""
    settings = [settings_of(ensemble.identity) for ensemble in ensembles]
    names = [
        name
        for name in dict.fromkeys(name for one in settings for name in one)
        if not name.startswith("model") and len({one[name] for one in settings if name in one}) > 1
    ]
    return [", ".join(_named(name, one[name]) for name in names if name in one) for one in settings]


_ELSEWHERE = ("model", "speed_mm_s", "travel_mm", "law")


def what_is_set(ensemble: Ensemble) -> str:
    """Settings that are not as parameters.in has them now; size of the grains, speed, travel and law are told elsewhere."""
    usual = {name: canonical(value) for name, value in read_variables(PARAMETERS).items()}
    there = {name: value for name, value in settings_of(ensemble.identity).items() if not name.startswith(_ELSEWHERE)}
    return ", ".join(_named(name, value) for name, value in there.items() if value != usual.get(name))


def _named(name: str, value: str) -> str:
    shown, unit = UNITS.get(name, (name, ""))
    return f"{shown} {value}{unit}"
