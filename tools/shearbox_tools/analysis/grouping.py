# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs put together to ensembles: those that differ only in their seeds and stresses."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..asking.models import PARAMETERS, read_model, read_variables
from ..asking.parameters import canonical
from ..base.errors import ShearboxError
from .ensemble_results import Ensemble
from .results import Results

UNITS = {
    "speed_mm_s": ("speed", " mm/s"),
    "travel_mm": ("travel", " mm"),
    "phi": ("φ_μ", "°"),  # of the contacts: φ is that of the sand
}


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
    """For each ensemble what tells it from others, variables of the model from those of a model of the same name; tests run by
    hand do not know all settings."""
    settings = [settings_of(ensemble.identity) for ensemble in ensembles]
    names = list(dict.fromkeys(name for one in settings for name in one if name != "model"))
    told = []
    for one in settings:
        alike = [other for other in settings if other["model"] == one["model"]]
        differing = [name for name in names if _differs(name, alike if name.startswith(_OF_THE_MODEL) else settings)]
        told.append(", ".join(_named(name, one[name]) for name in differing if name in one))
    return told


def _differs(name: str, settings: Sequence[Mapping[str, str]]) -> bool:
    return len({one[name] for one in settings if name in one}) > 1


_OF_THE_MODEL = "model "
_ELSEWHERE = ("model", "model ngrains", "speed_mm_s", "travel_mm", "law")


def what_is_set(ensemble: Ensemble) -> str:
    """Settings that are not as parameters.in and the file of the model have them now; number of grains, speed, travel and law are
    told elsewhere."""
    usual = read_variables(PARAMETERS) | _of_its_file(ensemble.specimens[0])
    there = {name: value for name, value in settings_of(ensemble.identity).items() if name not in _ELSEWHERE}
    return ", ".join(_named(name, value) for name, value in there.items() if value != canonical(usual.get(name, "")))


def _of_its_file(run: Results) -> dict[str, str]:
    """Variables of the model as its file has them; as they were, if it is gone."""
    try:
        variables = read_model(run.model_file).variables
    except ShearboxError:
        return {name: str(value) for name, value in run.identity.items() if name.startswith(_OF_THE_MODEL)}
    return {_OF_THE_MODEL + name: str(value) for name, value in variables.items()}


def _named(name: str, value: str) -> str:
    shown, unit = UNITS.get(name, (name.removeprefix(_OF_THE_MODEL), ""))
    return f"{shown} {value}{unit}"
