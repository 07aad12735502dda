# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run is asked to do, kept in run.json beside its results."""

import json
import math
import re
import shlex
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NoReturn

from ..base.errors import InputError, ShearboxError
from ..base.files import DRAFT, LOCK, PACKED, RECORD, TIMINGS, write_json, write_text
from ..base.presets import HOSTS, LAMMPS, STRESSES
from .models import INPUT, PARAMETERS, SUFFIX, Model, find_model, read_variables
from .parameters import canonical, of_model, parameters

OWN_OPTION = {name: f"--{name}" for name in ("seed", "law", "dt", "stiffness")}  # of variables of parameters.in
OPTION_OF_SHEAR = {"sigma": "--stress", "speed": "--speed", "travel": "--travel"}  # of variables of shear.in
_REMEDY = "Put back a copy of it, or run in another folder"
_LOG = re.compile(r".*\.(log|out)(\.\d+)?")
_KINDS: dict[str, type | tuple[type, ...]] = {
    "model": str, "model width": (int, float), "model half_height": (int, float), "model ngrains": int,
    "speed_mm_s": (int, float), "travel_mm": (int, float), "seed": int, "law": str, "dt": str,
    "stiffness": (int, float), "parameters": dict,
}  # fmt: skip


@dataclass(frozen=True)
class Request:
    """Stresses in kPa, speed in mm/s, travel in mm, dt in s or 'auto', stiffness a factor on that of contacts.

    `settings` are variables of the decks, also of the model, that have another value than their file says.
    """

    model: Model
    stresses: tuple[float, ...]
    speed: float = 2.0
    travel: float = 8.0
    seed: int = 1
    law: str = "direct"
    dt: str = "auto"
    stiffness: float = 1.0
    settings: dict[str, str] = field(default_factory=dict)
    host: str = LAMMPS

    def identity(self, of_file: dict[str, str]) -> dict[str, Any]:
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
            **({"host": self.host} if self.host != LAMMPS else {}),
            "parameters": of_file | {name: value for name, value in self.settings.items() if name in of_file},
        }


def placed(request: Request, folder: Path) -> Request:
    """The same; the file of a model that is made of its name is in the folder of the run."""
    model = request.model
    return replace(request, model=replace(model, path=folder / model.path.name)) if model.text is not None else request


def check_folder(folder: Path, request: Request, may_replace: bool = True) -> set[float]:
    """Refuse a folder of another request, or of something else; the stresses (kPa) that an earlier run asked for. One that
    failed before it had any result is none, if it may be replaced."""
    if (folder / RECORD).exists():
        known = read_record(folder)
        there, asked = known["identity"], _identity(request)
        if differences := _differences(there, asked):
            if may_replace and _has_failed_at_once(folder):
                return set()
            advice = f"To go on with what is there: shearbox run {shlex.quote(str(folder))}. Else take another --out."
            if there["parameters"].keys() != asked["parameters"].keys():
                advice = f"Another version began it, with other variables in {PARAMETERS.name}. Take another --out."
            if not _leavings(folder):
                advice = "It has no results: remove the folder, or take another --out."
            raise InputError(f"{folder} holds another run:\n" + "\n".join([*differences, advice]))
        return set(known["stresses"])
    if folder.exists() and not folder.is_dir():
        raise InputError(f"--out {folder}: this is a file, a folder is expected")
    if (folder / PACKED).exists():
        raise InputError(f"--out {folder}: {RECORD} is lost, which says what its results are of. {_REMEDY}")
    ours = {LOCK, RECORD + DRAFT}  # of a run that is just beginning
    if folder.is_dir() and {path.name for path in folder.iterdir()} - ours:
        raise InputError(f"--out {folder}: this folder holds something else than a run (there is no {RECORD} in it)")
    return set()


def _has_failed_at_once(folder: Path) -> bool:
    """Whether an engine has left no more than logs, as with a time step that it refuses. Without a log it may be yet to start, as
    in a job that waits."""
    return not _leavings(folder) and any(_LOG.fullmatch(path.name) for path in folder.rglob("*"))


def _leavings(folder: Path) -> list[Path]:
    """What there is beside the record of a run and logs."""
    beside = re.compile(rf"{RECORD}|{TIMINGS}|{LOCK}|.*\{SUFFIX}|{_LOG.pattern}")
    return [path for path in folder.rglob("*") if not path.is_dir() and not beside.fullmatch(path.name)]


def open_folder(folder: Path, request: Request) -> None:
    """Begin the record of this request, or take up an earlier one; the folder must be locked."""
    stresses = check_folder(folder, request) | set(request.stresses)
    if request.model.text is not None:
        write_text(request.model.path, request.model.text)
    where = str(request.model.path.resolve())
    record = {"identity": _identity(request), "stresses": sorted(stresses), "model_file": where}
    write_json(folder / RECORD, record)


def _identity(request: Request) -> dict[str, Any]:
    """The identity with parameters.in as it is now."""
    return request.identity({k: v for k, v in read_variables(PARAMETERS).items() if k not in OWN_OPTION})


def recorded(folder: Path) -> Request:
    """What the run in a folder was asked for: the model as it was, whatever its file and parameters.in say now."""
    record = read_record(folder)
    identity = record["identity"]
    file = _model_file(folder, record)
    try:
        model = find_model(file)
    except InputError as error:
        raise InputError(f"{folder}: the model of this run cannot be read: {error}") from error
    there: dict[str, Any] = {
        name.removeprefix("model "): value for name, value in identity.items() if name.startswith("model ")
    }
    there |= identity["parameters"]
    now: dict[str, Any] = {**read_variables(PARAMETERS), **model.variables}
    known = parameters()
    settings = {name: canonical(str(v)) for name, v in there.items() if name in known and not _same(v, now.get(name))}
    return Request(
        model=find_model(file, of_model(settings)),
        stresses=tuple(record["stresses"]),
        speed=identity["speed_mm_s"],
        travel=identity["travel_mm"],
        seed=identity["seed"],
        law=identity["law"],
        dt=identity["dt"],
        stiffness=identity["stiffness"],
        settings=settings,
        host=identity.get("host", LAMMPS),
    )


def _model_file(folder: Path, record: dict[str, Any]) -> str:
    """In the folder of the run if the model was made of its name, else where it was; that of the decks if Shearbox has moved since."""
    there = Path(record["model_file"])
    places = (folder / there.name, there, INPUT / "models" / (record["identity"]["model"] + SUFFIX))
    return str(next((place for place in places if place.is_file()), record["model_file"]))


def read_record(folder: Path) -> dict[str, Any]:
    """`identity`, `stresses` and `model_file` of the run in a folder; the first two are always there, and whole."""
    path = folder / RECORD
    try:
        record = json.loads(path.read_text(encoding="utf-8"), parse_constant=_no_number)
    except FileNotFoundError as error:
        raise ShearboxError(f"{folder} holds no run: there is no {RECORD} in it") from error
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        return _refuse(path, f"line {error.lineno}: {error.msg}")
    except UnicodeDecodeError as error:
        return _refuse(path, f"byte {error.start} is not UTF-8")
    except (ValueError, RecursionError) as error:
        return _refuse(path, f"this is not the record of a run: {error}")
    if damage := _damage(record):
        return _refuse(path, f"this is not the record of a run: {damage}")
    return {"model_file": "", **record}


def _refuse(path: Path, problem: str) -> NoReturn:
    raise ShearboxError(f"{path}, {problem}. {_REMEDY}")


def _no_number(name: str) -> float:
    raise ValueError(f"{name} is not a number")


def _damage(record: Any) -> str | None:
    """What is missing or of the wrong kind in a record; None if nothing is."""
    if not isinstance(record, dict) or not isinstance(identity := record.get("identity"), dict):
        return "there is no identity"
    for name, kind in _KINDS.items():
        value = identity.get(name)
        if not isinstance(value, kind) or isinstance(value, bool) or (isinstance(value, (int, float)) and value <= 0):
            return f"identity: {name}: {value!r}"
    if identity.get("host", LAMMPS) not in HOSTS:
        return f"identity: host: {identity['host']!r}"
    values = [value for name, value in identity.items() if name != "parameters"]
    values += [*identity["parameters"].values(), record.get("model_file", "")]
    for value in values:
        if not isinstance(value, (str, int, float)) or not _is_finite(value):
            return f"{value!r} is neither a number nor a text"
    stresses = record.get("stresses")
    if not isinstance(stresses, list) or not stresses:
        return "there are no stresses"
    wrong = [sigma for sigma in stresses if not _is_stress(sigma)]
    return f"stresses: {wrong[0]!r}" if wrong else None


def _is_stress(value: Any) -> bool:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return is_number and STRESSES[0] <= value <= STRESSES[1]


def _is_finite(value: str | float) -> bool:
    return isinstance(value, str) or math.isfinite(value)


def _differences(there: dict[str, Any], asked: dict[str, Any]) -> list[str]:
    flat_there, flat_asked = _flat(there), _flat(asked)
    names = [n for n in {**flat_there, **flat_asked} if not _same(flat_there.get(n), flat_asked.get(n))]
    return [f"  {name}: {flat_there.get(name, '-')} there, {flat_asked.get(name, '-')} asked for" for name in names]


def _same(one: Any, other: Any) -> bool:
    """Whether two values are equal, as numbers where both are; 5e-7 is 5e-07."""
    return one == other or canonical(str(one)) == canonical(str(other))


def _flat(identity: dict[str, Any]) -> dict[str, Any]:
    return {**{k: v for k, v in identity.items() if k != "parameters"}, **identity["parameters"]}
