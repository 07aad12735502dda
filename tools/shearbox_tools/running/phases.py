# SPDX-License-Identifier: GPL-2.0-or-later
"""The phases of a run: which deck, in which folder, with which variables, and when it is done."""

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ..asking.hosts import HOSTS
from ..asking.models import INPUT, PARAMETERS, read_variables
from ..asking.request import Request
from ..base.errors import InputError, ShearboxError
from ..base.files import CONSOLIDATED_RESTART, CONSOLIDATED_TABLE, DUMPS, PACKED, PACKED_RESTART, PACKED_TABLE
from ..base.files import SHEAR_RESTART, SHEAR_TABLE, SHEARED_RESTART, log_file, state_of, stress_folder
from ..base.numerals import number
from ..base.presets import LAMMPS
from ..base.restarts import is_whole
from ..base.seals import Seal, look_at, seal, unseal
from ..reading.readers import last_value, read_row, read_shear

_LISTENS = re.compile(rb"^compute\s+\w+\s+all\s+cdem/signal\b", re.MULTILINE)  # not a comment on it
DECKS = PACK, CONSOLIDATE, SHEAR = "pack", "consolidate", "shear"


@dataclass(frozen=True)
class Phase:
    """One call of the engine: what it writes is a table, a restart file of the end, and perhaps frames."""

    name: str
    folder: Path
    variables: dict[str, str]
    product: str  # the table
    restart: str
    frames: tuple[str, ...] = ()
    sigma: float | None = None  # kPa
    host: str = LAMMPS

    @property
    def label(self) -> str:
        """How the phase is called in messages and timings."""
        return self.name if self.sigma is None else f"{self.name} {self.sigma:g} kPa"

    @property
    def deck(self) -> Path:
        """The input file of the engine."""
        return HOSTS[self.host].decks / f"{self.name}.in"

    @property
    def log(self) -> Path:
        """The engine's log."""
        return log_file(self.folder, self.name)

    @property
    def screen(self) -> Path:
        """What the engine, or mpirun, says on the screen."""
        return self.folder / f"{self.name}.out"

    @property
    def ended(self) -> bool:
        """Whether the engine has come to the end: it said goodbye, and all it should have written is whole.

        Neither alone is enough: a full disk loses the last lines.
        """
        try:
            goodbye = b"\n" + HOSTS[self.host].goodbye in self.log.read_bytes()
        except OSError:
            return False
        return goodbye and is_whole(self.folder / self.restart) and self._is_whole()

    @property
    def done(self) -> bool:
        """Whether it came to the end, its table is as it was then, and so, by size and time, are frames that are still there."""
        product = look_at(self.folder / self.product)
        if product is Seal.UNKNOWN:
            return self.ended
        return self._is_whole() and not self._altered_frames(at_once=True)

    @property
    def intact(self) -> bool:
        """Whether it is done, and the frames are as they were in every byte: much to read."""
        return self.done and not self._altered_frames()

    def _altered_frames(self, at_once: bool = False) -> bool:
        return any(look_at(self.folder / name, at_once) is Seal.ALTERED for name in self.frames)

    def _is_whole(self) -> bool:
        """Whether the table is complete; checkpoints are removed after all else."""
        path = self.folder / self.product
        try:
            complete = look_at(path) is not Seal.ALTERED and _is_complete(path, *state_of(path))
        except ShearboxError:
            return False
        return complete and not any((self.folder / name).exists() for name in self.checkpoints)

    @property
    def leads_on(self) -> bool:
        """Whether the next phase can begin with its restart file."""
        path = self.folder / self.restart
        return look_at(path) is Seal.INTACT or (look_at(path) is Seal.UNKNOWN and is_whole(path))

    def seal(self) -> None:
        """Seal what there is while no engine runs, at its end or where it was stopped."""
        restarts = [n for n in (self.restart, *self.checkpoints) if is_whole(self.folder / n)]
        seal(self.folder, [self.product, *self.frames, *restarts])

    def unseal(self) -> None:
        """Before an engine writes again; what it goes on from stays sealed."""
        gone = [name for name in self.checkpoints if not (self.folder / name).exists()]
        unseal(self.folder, [self.product, *self.frames, self.restart, *gone])

    @property
    def checkpoints(self) -> tuple[str, ...]:
        """Restart files that it writes while it runs: a and b in turn, c where it was asked to end."""
        name = SHEAR_RESTART if self.name == SHEAR else self.restart
        return tuple(f"{name}.{letter}" for letter in "abc") if self.host == LAMMPS else ()

    @property
    def drafts(self) -> tuple[str, ...]:
        """What an engine that was killed leaves half written."""
        return (f"{SHEAR_RESTART}.draft", "shear.whole") if self.name == SHEAR else (f"{self.restart}.draft",)

    @property
    def listens(self) -> bool:
        """Whether the engine, by its log, has come to where its deck makes it listen to the signal that asks it to end."""
        try:
            return _LISTENS.search(self.log.read_bytes()) is not None
        except OSError:
            return False

    def displacement(self) -> float:
        """Shear displacement (mm) reached so far, from the last whole row of shear.dat; 0 when there is none."""
        return last_value(self.folder / SHEAR_TABLE, "displacement_mm") or 0.0


def packing(folder: Path, request: Request) -> Phase:
    """The phase that all stresses share."""
    place = folder / PACKED
    return Phase(PACK, place, _common(request, place), PACKED_TABLE, PACKED_RESTART, host=request.host)


def shearing(folder: Path, request: Request, sigma: float) -> list[Phase]:
    """Consolidation and shear at one stress (kPa)."""
    place = stress_folder(folder, sigma)
    common = {**_common(request, place), "sigma": f"{sigma:g}"}
    packed = os.path.relpath(folder / PACKED / PACKED_RESTART, place)  # no blank, whatever the folder's name
    shear = {"speed": f"{request.speed:g}", "travel": f"{request.travel:g}"}
    dumps = DUMPS if request.host == LAMMPS else ()
    consolidate = {**common, "packed": packed}
    return [
        Phase(CONSOLIDATE, place, consolidate, CONSOLIDATED_TABLE, CONSOLIDATED_RESTART, (), sigma, request.host),
        Phase(SHEAR, place, {**common, **shear}, SHEAR_TABLE, SHEARED_RESTART, dumps, sigma, request.host),
    ]


def all_phases(folder: Path, request: Request) -> list[Phase]:
    """In the order of the work."""
    return [packing(folder, request), *(p for sigma in request.stresses for p in shearing(folder, request, sigma))]


def left_to_do(folder: Path, request: Request) -> tuple[list[Phase], list[list[Phase]]]:
    """The packing, if it has to be made, and what each stress lacks.

    What is done but has lost its restart file is done again only where a later phase needs that file.
    """
    chains = []
    for sigma in request.stresses:
        consolidate, shear = shearing(folder, request, sigma)
        left = [] if shear.intact else [shear]
        if not consolidate.done or (left and not consolidate.leads_on):
            left.insert(0, consolidate)
        chains.append(left)
    pack = packing(folder, request)
    needed = any(phase.name == CONSOLIDATE for left in chains for phase in left)
    return [] if pack.done and (pack.leads_on or not needed) else [pack], [left for left in chains if left]


@cache
def _is_complete(path: Path, *_: int) -> bool:
    """Whether a table in that state (state_of) has all its rows: those of a campaign are asked for many times."""
    return len(read_shear(path)["step"]) == rows_of_shear() if path.name == SHEAR_TABLE else bool(read_row(path))


def rows_of_shear() -> int:
    """Rows of a shear.dat that is complete."""
    return int(read_variables(INPUT / f"{SHEAR}.in")["rows"])


def frames_of(settings: Mapping[str, str]) -> int:
    """Frames of a shear phase, after the first."""
    return int(number(settings.get("frames") or read_variables(PARAMETERS)["frames"]))


def steps_between_frames(settings: Mapping[str, str], steps_between_rows: int) -> int:
    """As shear.in has it."""
    return steps_between_rows * rows_of_shear() // frames_of(settings)


def _common(request: Request, place: Path) -> dict[str, str]:
    common = {
        "model": request.model.name,
        "models": _folder_from(place, request.model.path, "model"),
        "seed": str(request.seed),
        "law": request.law,
        "dt": request.dt,
        "stiffness": f"{request.stiffness:g}",
        **request.settings,
    }
    if request.host == LAMMPS:  # lmp_cdem knows where its decks are
        return common
    decks = _folder_from(place, HOSTS[request.host].decks / f"{PACK}.in", "deck")
    return {**common, "decks": decks, "dt": "0" if request.dt == "auto" else request.dt}


def _folder_from(place: Path, file: Path, what: str) -> str:
    """The folder of a file as decks can include it from there: LAMMPS takes no blanks, but from there may be none."""
    folder = str(file.parent.resolve())
    if _has_blank(folder):
        folder = os.path.relpath(folder, place.resolve())
    if _has_blank(folder + file.name):
        raise InputError(f"{what} {file}: LAMMPS cannot include a file with a blank in its name or that of its folder")
    return folder


def _has_blank(text: str) -> bool:
    return any(letter.isspace() for letter in text)
