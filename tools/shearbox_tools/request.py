# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run is asked to do, checked before anything starts, and kept in run.json beside its results."""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .errors import InputError, ShearboxError
from .files import RECORD, write_json
from .models import PARAMETERS, Model, read_variables
from .presets import LAWS


@dataclass(frozen=True)
class Request:
    """Stresses in kPa, speed in mm/s, travel in mm, dt in s or 'auto', stiffness a factor on that of contacts."""

    model: Model
    stresses: tuple[float, ...]
    speed: float = 2.0
    travel: float = 8.0
    seed: int = 1
    law: str = "direct"
    dt: str = "auto"
    stiffness: float = 1.0

    def identity(self, parameters: dict[str, str]) -> dict[str, Any]:
        """Everything the results depend on, less the stresses, each of which has a folder of its own."""
        return {
            "model": self.model.name,
            **{f"model {name}": value for name, value in self.model.variables.items()},
            "speed_mm_s": self.speed,
            "travel_mm": self.travel,
            "seed": self.seed,
            "law": self.law,
            "dt": self.dt,
            "stiffness": self.stiffness,
            "parameters": parameters,
        }


def check(request: Request) -> None:
    """Refuse values that cannot be meant; all of them are named at once."""
    problems = [*_stress_problems(request.stresses), *_shear_problems(request), *_dt_problems(request.dt)]
    if request.law not in LAWS:
        problems.append(f"--law {request.law}: one of {', '.join(LAWS)} is expected")
    if not 0.01 <= request.stiffness <= 100:
        problems.append(f"--stiffness {request.stiffness:g}: a factor from 0.01 to 100 is expected")
    if not 0 < request.seed < 2**31:
        problems.append(f"--seed {request.seed}: a whole number from 1 to {2**31 - 1} is expected")
    if problems:
        raise InputError("\n".join(problems))


def _stress_problems(stresses: tuple[float, ...]) -> list[str]:
    problems = []
    for stress in stresses:
        what = f"--stress {stress:g}"
        if not math.isfinite(stress) or stress <= 0:
            problems.append(f"{what}: a stress above 0 kPa is expected")
        elif stress > 5000:
            problems.append(f"{what}: kPa are expected, at most 5000; {stress:g} Pa would be {stress / 1000:g}")
        elif stress < 1:
            problems.append(f"{what}: kPa are expected, at least 1; {stress:g} MPa would be {stress * 1000:g}")
    if len(set(stresses)) < len(stresses):
        problems.append(f"--stress {' '.join(f'{s:g}' for s in stresses)}: a stress is named twice")
    return problems


def _shear_problems(request: Request) -> list[str]:
    problems = []
    width = request.model.width * 1000
    share = float(read_variables(PARAMETERS)["flanges"])
    if not 0.001 <= request.speed <= 1000:
        hint = f"; {request.speed:g} m/s would be {request.speed * 1000:g}" if 1e-6 <= request.speed < 0.001 else ""
        problems.append(f"--speed {request.speed:g}: 0.001 to 1000 mm/s are expected{hint}")
    if not 0.1 <= request.travel <= share * width:
        hint = f"; {request.travel:g} m would be {request.travel * 1000:g}" if 1e-4 <= request.travel < 0.1 else ""
        problems.append(
            f"--travel {request.travel:g}: 0.1 to {share * width:g} mm, {share:g} of the box's width, "
            f"are expected{hint}"
        )
    return problems


def _dt_problems(dt: str) -> list[str]:
    if dt == "auto":
        return []
    try:
        seconds = float(dt)
    except ValueError:
        return [f"--dt {dt}: 'auto' or a time step in s is expected, such as 5e-7"]
    if 1e-10 <= seconds <= 1e-4:
        return []
    return [f"--dt {dt}: 'auto' or 1e-10 to 1e-4 s are expected"]


def open_folder(folder: Path, request: Request, parameters: dict[str, str]) -> None:
    """Make the folder of this request or take up an earlier one; refuse a folder of another request."""
    asked = request.identity(parameters)
    path = folder / RECORD
    stresses = set(request.stresses)
    if path.exists():
        known = read_record(folder)
        there = known["identity"]
        if there != asked:
            raise InputError(f"{folder} holds another run:\n" + "\n".join(_differences(there, asked)))
        stresses |= set(known["stresses"])
    elif folder.exists() and not folder.is_dir():
        raise InputError(f"--out {folder}: this is a file, a folder is expected")
    elif folder.is_dir() and any(folder.iterdir()):
        raise InputError(f"--out {folder}: this folder holds something else than a run (there is no {RECORD} in it)")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--out {folder}: {error.strerror}") from error
    where = str(request.model.path.resolve())
    write_json(path, {"identity": asked, "stresses": sorted(stresses), "model_file": where})


def read_record(folder: Path) -> dict[str, Any]:
    """`identity`, `stresses` and `model_file` of the run in a folder; the first two are always there."""
    path = folder / RECORD
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        _ = record["identity"]["model"], record["stresses"][0]
        return record
    except FileNotFoundError as error:
        raise ShearboxError(f"{folder} holds no run: there is no {RECORD} in it") from error
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise ShearboxError(f"{path}, line {error.lineno}: {error.msg}") from error
    except (KeyError, IndexError, TypeError) as error:
        raise ShearboxError(f"{path}: this is not the record of a run ({error!r})") from error


def _differences(there: dict[str, Any], asked: dict[str, Any]) -> list[str]:
    flat_there, flat_asked = _flat(there), _flat(asked)
    names = [n for n in {**flat_there, **flat_asked} if flat_there.get(n) != flat_asked.get(n)]
    return [f"  {name}: {flat_there.get(name, '-')} there, {flat_asked.get(name, '-')} asked for" for name in names]


def _flat(identity: dict[str, Any]) -> dict[str, Any]:
    parameters = identity.get("parameters", {})
    return {**{k: v for k, v in identity.items() if k != "parameters"}, **parameters}
