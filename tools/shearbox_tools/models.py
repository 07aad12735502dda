# SPDX-License-Identifier: GPL-2.0-or-later
"""The models of the paper's Table 1, read from input/models/, the one place where they are defined."""

import difflib
import re
from dataclasses import dataclass
from pathlib import Path

from .errors import InputError, ShearboxError

ROOT = Path(__file__).resolve().parents[2]
INPUT = ROOT / "input"

_VARIABLE = re.compile(
    r"^\s*variable\s+(\S+)\s+(?:equal|index|string|internal)\s+([^#\n]*?)\s*(?:#\s*(.*?)\s*)?$", re.MULTILINE
)
_NUMBERS = ("width", "half_height", "dmin", "dmax", "power", "ngrains")


@dataclass(frozen=True)
class Model:
    """A specimen: lengths in m; dmin and dmax are diameters of a disc, not of a grain."""

    name: str
    width: float
    half_height: float
    dmin: float
    dmax: float
    power: float
    ngrains: int
    shape: str

    @property
    def variables(self) -> dict[str, float | str]:
        """What defines the specimen, as recorded with a run."""
        return {name: getattr(self, name) for name in (*_NUMBERS, "shape")}


def read_variables(path: Path) -> dict[str, str]:
    """Names and values of the variables that a deck defines, as text."""
    return {name: value.strip("\"'") for name, value, _ in _definitions(path)}


def read_comments(path: Path) -> dict[str, str]:
    """Names of the variables that a deck defines, and what it says about them."""
    return {name: comment for name, _, comment in _definitions(path)}


def read_model(path: Path) -> Model:
    """The model in one file of input/models/."""
    variables = read_variables(path)
    missing = [name for name in (*_NUMBERS, "shape") if name not in variables]
    if missing:
        raise ShearboxError(f"{path}: there is no variable {', '.join(missing)} in it")
    try:
        numbers = {name: float(variables[name]) for name in _NUMBERS}
    except ValueError as error:
        raise ShearboxError(f"{path}: {error}") from error
    ngrains = int(numbers.pop("ngrains"))
    return Model(name=path.stem, ngrains=ngrains, shape=variables["shape"], **numbers)


def all_models(folder: Path = INPUT / "models") -> list[Model]:
    """All models, in the order of the paper's table: by discs per grain, then size, then box."""
    paths = sorted(folder.glob("*.in"))
    if not paths:
        raise ShearboxError(f"{folder}: there are no models (*.in) in it")
    return sorted((read_model(path) for path in paths), key=_table_order)


def find_model(name: str, models: list[Model]) -> Model:
    """The model of that name, or an error that suggests some."""
    for model in models:
        if model.name == name:
            return model
    names = [model.name for model in models]
    close = [n for n in names if name.lower() in n.lower()] or difflib.get_close_matches(name, names, 3, 0.5)
    hint = "Did you mean\n  " + "\n  ".join(close[:4]) if close else "'shearbox models' lists them"
    raise InputError(f"unknown model '{name}'. {hint}")


def _table_order(model: Model) -> tuple[bool, bool, float, float]:
    return (model.dmin == model.dmax, model.shape != "single", -model.dmax, model.width)


def _definitions(path: Path) -> list[tuple[str, str, str]]:
    try:
        return _VARIABLE.findall(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error
