# SPDX-License-Identifier: GPL-2.0-or-later
"""Models, read from their files: those of the paper's Table 1 are in input/models/, others anywhere."""

import difflib
import re
from dataclasses import dataclass, field
from pathlib import Path

from .errors import InputError, ShearboxError

ROOT = Path(__file__).resolve().parents[2]
INPUT = ROOT / "input"
PARAMETERS = INPUT / "parameters.in"
SUFFIX = ".in"

_VARIABLE = re.compile(
    r"^\s*variable\s+(\S+)\s+(?:equal|index|string|internal)\s+([^#\n]*?)\s*(?:#\s*(.*?)\s*)?$", re.MULTILINE
)
_NUMBERS = ("width", "half_height", "dmin", "dmax", "power", "ngrains")
_DISCS = {"single": 1, "triple": 3}  # of templates that have a name


@dataclass(frozen=True)
class Model:
    """A specimen: lengths in m; dmin and dmax are diameters of a grain's largest disc, not of a grain.

    The shape is a template of fix cdem/shape; one from a file is written out, so that it is known what it was.
    """

    path: Path
    width: float
    half_height: float
    dmin: float
    dmax: float
    power: float
    ngrains: int
    shape: str
    further: dict[str, str] = field(default_factory=dict)  # variables of the file that the tools do not need

    @property
    def name(self) -> str:
        """What the decks call it."""
        return self.path.stem

    @property
    def discs(self) -> int:
        """Discs of a grain."""
        kind, *rest = self.shape.split()
        return int(rest[0]) if kind == "discs" else _DISCS[kind]

    @property
    def variables(self) -> dict[str, float | str]:
        """What defines the specimen, as recorded with a run."""
        return {name: getattr(self, name) for name in (*_NUMBERS, "shape")} | self.further


def read_variables(path: Path) -> dict[str, str]:
    """Names and values of the variables that a deck defines, as text."""
    return {name: value.strip("\"'") for name, value, _ in _definitions(path)}


def read_comments(path: Path) -> dict[str, str]:
    """Names of the variables that a deck defines, and what it says about them."""
    return {name: comment for name, _, comment in _definitions(path)}


def read_model(path: Path) -> Model:
    """The model in a file."""
    variables = read_variables(path)
    missing = [name for name in (*_NUMBERS, "shape") if name not in variables]
    if missing:
        raise ShearboxError(f"{path}: there is no variable {', '.join(missing)} in it")
    try:
        numbers = {name: float(variables.pop(name)) for name in _NUMBERS}
    except ValueError as error:
        raise ShearboxError(f"{path}: {error}") from error
    ngrains = int(numbers.pop("ngrains"))
    shape = _written_out(variables.pop("shape"), path)
    return Model(path=path, ngrains=ngrains, shape=shape, further=variables, **numbers)


def _written_out(shape: str, path: Path) -> str:
    """The template of a model; one from a file beside the model's has its discs put in. The engine checks them."""
    kind, *rest = shape.split() or ["nothing"]
    if kind == "file" and len(rest) == 1:
        rows = [line.split("#")[0].split() for line in _text(path.parent / rest[0]).splitlines()]
        discs = [row for row in rows if row]
        return " ".join(["discs", str(len(discs)), *(word for row in discs for word in row)])
    if (kind in _DISCS and not rest) or (kind == "discs" and rest and rest[0].isdigit()):
        return shape
    raise ShearboxError(f"{path}: shape {shape}: single, triple, 'discs N x y r ...' or 'file NAME' is expected")


def all_models(folder: Path = INPUT / "models") -> list[Model]:
    """All models, in the order of the paper's table: by discs per grain, then size, then box."""
    paths = sorted(folder.glob(f"*{SUFFIX}"))
    if not paths:
        raise ShearboxError(f"{folder}: there are no models (*.in) in it")
    return sorted((read_model(path) for path in paths), key=_table_order)


def find_model(name: str, models: list[Model]) -> Model:
    """The model of that name, or in that file; or an error that suggests some."""
    if name.endswith(SUFFIX):
        try:
            return read_model(Path(name))
        except ShearboxError as error:
            raise InputError(str(error)) from error
    for model in models:
        if model.name == name:
            return model
    names = [model.name for model in models]
    close = [n for n in names if name.lower() in n.lower()] or difflib.get_close_matches(name, names, 3, 0.5)
    known = f"'shearbox models' lists them; a file of your own ends in {SUFFIX}"
    hint = "Did you mean\n  " + "\n  ".join(close[:4]) if close else known
    raise InputError(f"unknown model '{name}'. {hint}")


def _table_order(model: Model) -> tuple[bool, bool, float, float]:
    return (model.dmin == model.dmax, model.discs > 1, -model.dmax, model.width)


def _definitions(path: Path) -> list[tuple[str, str, str]]:
    return _VARIABLE.findall(re.sub(r"&[ \t]*\n", " ", _text(path)))  # & continues a line


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error
