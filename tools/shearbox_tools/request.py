# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run is asked to do, checked before anything starts, and kept in run.json beside its results."""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from .errors import InputError, ShearboxError
from .files import DRAFT, LOCK, PACKED, RECORD, write_json
from .models import PARAMETERS, Model, read_variables
from .presets import LAWS

_NUMBERS = ("speed_mm_s", "travel_mm", "seed", "stiffness", "model ngrains", "model width", "model half_height")
_REMEDY = "Put back a copy of it, or run in another folder"


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


def check_folder(folder: Path, request: Request, parameters: dict[str, str]) -> set[float]:
    """Refuse a folder of another request, or of something else; the stresses (kPa) that an earlier run asked for."""
    if (folder / RECORD).exists():
        known = read_record(folder)
        there, asked = known["identity"], request.identity(parameters)
        if there != asked:
            raise InputError(f"{folder} holds another run:\n" + "\n".join(_differences(there, asked)))
        return set(known["stresses"])
    if folder.exists() and not folder.is_dir():
        raise InputError(f"--out {folder}: this is a file, a folder is expected")
    if (folder / PACKED).exists():
        raise InputError(f"--out {folder}: {RECORD} is lost, which says what its results are of. {_REMEDY}")
    ours = {LOCK, RECORD + DRAFT}  # of a run that is just beginning
    if folder.is_dir() and {path.name for path in folder.iterdir()} - ours:
        raise InputError(f"--out {folder}: this folder holds something else than a run (there is no {RECORD} in it)")
    return set()


def open_folder(folder: Path, request: Request, parameters: dict[str, str]) -> None:
    """Begin the record of this request, or take up an earlier one; the folder must be locked."""
    stresses = check_folder(folder, request, parameters) | set(request.stresses)
    where = str(request.model.path.resolve())
    record = {"identity": request.identity(parameters), "stresses": sorted(stresses), "model_file": where}
    write_json(folder / RECORD, record)


def read_record(folder: Path) -> dict[str, Any]:
    """`identity`, `stresses` and `model_file` of the run in a folder."""
    path = folder / RECORD
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        return {"model_file": "", **record} if _is_record(record) else _refuse(path, "this is not the record of a run")
    except FileNotFoundError as error:
        raise ShearboxError(f"{folder} holds no run: there is no {RECORD} in it") from error
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        return _refuse(path, f"line {error.lineno}: {error.msg}")
    except UnicodeDecodeError as error:
        return _refuse(path, f"byte {error.start} is not UTF-8")


def _refuse(path: Path, problem: str) -> NoReturn:
    raise ShearboxError(f"{path}, {problem}. {_REMEDY}")


def _is_record(record: Any) -> bool:
    """Whether all is there that a report reads."""
    try:
        identity, stresses = record["identity"], record["stresses"]
        parameters = identity["parameters"]
        texts = [identity["model"], identity["law"], identity["dt"], record.get("model_file", "")]
        numbers = [identity[name] for name in _NUMBERS] + stresses
    except (KeyError, TypeError, AttributeError):
        return False
    return (
        isinstance(parameters, dict)
        and len(stresses) > 0
        and all(isinstance(text, str) for text in texts)
        and all(type(x) in (int, float) and math.isfinite(x) and x > 0 for x in numbers)
    )


def _differences(there: dict[str, Any], asked: dict[str, Any]) -> list[str]:
    flat_there, flat_asked = _flat(there), _flat(asked)
    names = [n for n in {**flat_there, **flat_asked} if flat_there.get(n) != flat_asked.get(n)]
    return [f"  {name}: {flat_there.get(name, '-')} there, {flat_asked.get(name, '-')} asked for" for name in names]


def _flat(identity: dict[str, Any]) -> dict[str, Any]:
    parameters = identity.get("parameters", {})
    return {**{k: v for k, v in identity.items() if k != "parameters"}, **parameters}
