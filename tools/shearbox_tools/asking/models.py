# SPDX-License-Identifier: GPL-2.0-or-later
"""Models, read from their files: those of the paper's Table 1 are in input/models/, others anywhere."""

import difflib
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import InputError, ShearboxError
from ..base.numerals import number
from ..base.presets import FORM
from .grains import area_over_largest, discs_of, read_template
from .named import model_text
from .solid import Grading

ROOT = Path(__file__).resolve().parents[3]
INPUT = ROOT / "input"
PARAMETERS = INPUT / "parameters.in"
SUFFIX = ".in"
SOLID_FRACTION = 0.82  # of a packing: of all models from 0.81 to 0.84, of equal discs 0.89

_WORD = r"\"[^\"]*\"|'[^']*'|[^\s\"'#]+"
_VARIABLE = re.compile(
    rf"[ \t\r]*variable[ \t]+(\w+)[ \t]+(equal|index|string|internal)[ \t]+({_WORD})[ \t\r]*(?:#[ \t]*(.*?)[ \t\r]*)?",
    re.ASCII,
)
RANGE = re.compile(r"\s*\[(.+?)(, whole)?\]$")  # at the end of a comment: what a variable may be
_NUMBERS = ("width", "half_height", "dmin", "dmax", "power", "ngrains")


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
    further: dict[str, str] = field(default_factory=dict)  # variables that the tools do not need
    text: str | None = None  # of the file, if it is yet to be written: a model that is made of its name

    @property
    def name(self) -> str:
        """What the decks call it."""
        return self.path.stem

    @property
    def discs(self) -> int:
        """Discs of a grain."""
        return len(discs_of(self.shape))

    @property
    def variables(self) -> dict[str, float | str]:
        """What defines the specimen, as recorded with a run."""
        return {name: getattr(self, name) for name in (*_NUMBERS, "shape")} | self.further

    @cached_property
    def half_heights(self) -> float:
        """How high the packed grains will be, over the height of one half of the box; to some percent."""
        diameters = Grading(self.dmin, self.dmax, self.power).diameters(self.ngrains)
        area = area_over_largest(self.shape) * np.sum(diameters**2)
        return float(area / (SOLID_FRACTION * self.width * self.half_height))


def read_variables(path: Path) -> dict[str, str]:
    """Names and values of the variables that a deck defines, as text."""
    return {name: value.strip("\"'") for name, _, value, _ in definitions(path)}


def read_comments(path: Path) -> dict[str, str]:
    """Names of the variables that a deck defines, and what it says about them, less what they may be."""
    return {name: RANGE.sub("", comment) for name, _, _, comment in definitions(path)}


def read_model(path: Path, settings: dict[str, str] | None = None) -> Model:
    """The model in a file, with other values for some of its variables."""
    return _model(path, _text(path), settings, None)


def _model(path: Path, text: str, settings: dict[str, str] | None, made: str | None) -> Model:
    """The model that a text describes; `made` is the text again if the file is yet to be written."""
    variables = _model_variables(path, text) | (settings or {})
    missing = [name for name in (*_NUMBERS, "shape") if name not in variables]
    if missing:
        raise ShearboxError(f"{path}: there is no variable {', '.join(missing)} in it")
    numbers = {}
    for name in _NUMBERS:
        try:
            numbers[name] = number(variables.pop(name))
        except ValueError as error:
            raise ShearboxError(f"{path}: {name}: {error}; units are those of {PARAMETERS.name}: SI") from error
    ngrains = int(numbers["ngrains"])
    if ngrains != numbers.pop("ngrains"):
        raise ShearboxError(f"{path}: ngrains: a whole number is expected")
    shape = read_template(variables.pop("shape"), path)
    return Model(path=path, ngrains=ngrains, shape=shape, further=variables, text=made, **numbers)


def _model_variables(path: Path, text: str) -> dict[str, str]:
    """The variables of a model, which has nothing else: what LAMMPS would read otherwise than we do is refused."""
    variables: dict[str, str] = {}
    for line in _joined(text):
        if not line.split("#")[0].strip(" \t\r"):
            continue
        found = _VARIABLE.fullmatch(line)
        if not found or found[2] != "index":
            raise ShearboxError(f"{path}: 'variable NAME index VALUE' is expected, not {line.strip()[:60]!r}")
        if found[1] in variables:
            raise ShearboxError(f"{path}: there are several variables {found[1]}")
        variables[found[1]] = found[3].strip("\"'")
    return variables


def model_files(folder: Path = INPUT / "models") -> list[Path]:
    """The files of all models in a folder."""
    paths = sorted(folder.glob(f"*{SUFFIX}"))
    if not paths:
        raise ShearboxError(f"{folder}: there are no models (*.in) in it")
    return paths


def all_models(folder: Path = INPUT / "models") -> list[Model]:
    """All models, in the order of the paper's table."""
    return sorted((read_model(path) for path in model_files(folder)), key=table_order)


def find_model(name: str, settings: dict[str, str] | None = None, friction: float = 0.0) -> Model:
    """The model of that name, or in that file, with other values for some of its variables; or an error that helps.

    friction: friction angle (degrees) with which grains are packed, for names that leave their number to us.
    """
    try:
        known = {path.stem: path for path in model_files()}
        if name.endswith(SUFFIX) or name in known:
            return read_model(known.get(name, Path(name)), settings)
        if text := model_text(name, friction):
            return _model(Path(name + SUFFIX), text, settings, text)
    except ShearboxError as error:
        raise InputError(str(error)) from error
    close = [n for n in known if name.lower() in n.lower()] or difflib.get_close_matches(name, known, 3, 0.5)
    hint = "Did you mean\n  " + "\n  ".join(close[:4]) + "\n" if close else "'shearbox models' lists them. "
    raise InputError(f"unknown model '{name}'. {hint}A name may also be {FORM}. A file of your own ends in {SUFFIX}")


def is_of_the_decks(identity: Mapping[str, Any]) -> bool:
    """Whether the model of a run is the one of that name in the decks, in all its variables."""
    path = INPUT / "models" / (identity["model"] + SUFFIX)
    if not path.is_file():
        return False
    return all(identity.get(f"model {name}") == value for name, value in read_model(path).variables.items())


def table_order(model: Model) -> tuple[bool, bool, float, float]:
    """The key that sorts models as the paper's table does: by discs per grain, then size, then box."""
    return (model.dmin == model.dmax, model.discs > 1, -model.dmax, model.width)


def definitions(path: Path) -> list[tuple[str, str, str, str]]:
    """Name, style, value and comment of the variables that are defined by a line of their own."""
    return [(m[1], m[2], m[3], m[4] or "") for line in lines(path) if (m := _VARIABLE.fullmatch(line))]


def lines(path: Path) -> list[str]:
    """Lines as LAMMPS takes them: & continues one."""
    return _joined(_text(path))


def _text(path: Path) -> str:
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error
    if "\0" in text:
        raise ShearboxError(f"{path}: this is not text, there are null bytes in it")
    return text


def _joined(text: str) -> list[str]:
    return re.sub(r"&[ \t\r]*\n", "", text).split("\n")
