# SPDX-License-Identifier: GPL-2.0-or-later
"""The phases of a run: which deck, in which folder, with which variables, and when it is done."""

import os
from dataclasses import dataclass
from pathlib import Path

from .errors import InputError
from .files import CONSOLIDATED_TABLE, PACKED, PACKED_RESTART, PACKED_TABLE, SHEAR_DONE, SHEAR_TABLE
from .files import log_file, stress_folder
from .models import INPUT, read_variables
from .readers import last_value
from .request import Request

DECKS = PACK, CONSOLIDATE, SHEAR = "pack", "consolidate", "shear"
BYTES_PER_FRAME_AND_DISC = 400  # of the three dumps together; the walls' share is in it


@dataclass(frozen=True)
class Phase:
    """One call of the engine; `product` is the table that is there when it is done."""

    name: str
    folder: Path
    variables: dict[str, str]
    product: str
    sigma: float | None = None  # kPa

    @property
    def label(self) -> str:
        """How the phase is called in messages and timings."""
        return self.name if self.sigma is None else f"{self.name} {self.sigma:g} kPa"

    @property
    def deck(self) -> Path:
        """The input file of the engine."""
        return deck(self.name)

    @property
    def log(self) -> Path:
        """The engine's log."""
        return log_file(self.folder, self.name)

    @property
    def screen(self) -> Path:
        """What the engine, or mpirun, says on the screen."""
        return self.folder / f"{self.name}.out"

    @property
    def done(self) -> bool:
        """Whether an earlier run finished it: the product is there, and the engine said goodbye in the log.

        Neither alone is enough: the restart file is written after the product, and a full disk loses the last lines.
        """
        try:
            product = (self.folder / self.product).read_bytes()
            return product.endswith(b"\n") and b"\nTotal wall time:" in self.log.read_bytes()
        except OSError:
            return False

    def displacement(self) -> float:
        """Shear displacement (mm) reached so far, from the last whole row of shear.dat; 0 when there is none."""
        return last_value(self.folder / SHEAR_TABLE, "displacement_mm") or 0.0


def deck(name: str) -> Path:
    """The input file of that name."""
    return INPUT / f"{name}.in"


def packing(folder: Path, request: Request) -> Phase:
    """The phase that all stresses share."""
    return Phase(PACK, folder / PACKED, _common(request, folder / PACKED), PACKED_TABLE)


def shearing(folder: Path, request: Request, sigma: float) -> list[Phase]:
    """Consolidation and shear at one stress (kPa)."""
    place = stress_folder(folder, sigma)
    common = {**_common(request, place), "sigma": f"{sigma:g}"}
    packed = os.path.relpath(folder / PACKED / PACKED_RESTART, place)  # no blank, whatever the folder's name
    shear = {"speed": f"{request.speed:g}", "travel": f"{request.travel:g}"}
    return [
        Phase(CONSOLIDATE, place, {**common, "packed": packed}, CONSOLIDATED_TABLE, sigma),
        Phase(SHEAR, place, {**common, **shear}, SHEAR_DONE, sigma),
    ]


def disk_need(request: Request, folder: Path) -> int:
    """Bytes that the phases not yet done will write, roughly."""
    frames = 1 + int(read_variables(deck(SHEAR))["frames"])
    left = [s for s in request.stresses if not all(phase.done for phase in shearing(folder, request, s))]
    return int(len(left) * request.model.ngrains * request.model.discs * BYTES_PER_FRAME_AND_DISC * frames)


def _common(request: Request, place: Path) -> dict[str, str]:
    return {
        "model": request.model.name,
        "models": _models_from(place, request.model.path),
        "seed": str(request.seed),
        "law": request.law,
        "dt": request.dt,
        "stiffness": f"{request.stiffness:g}",
        **request.settings,
    }


def _models_from(place: Path, model: Path) -> str:
    """The folder of a model as decks can include it from there: LAMMPS takes no blanks, but from there may be none."""
    folder = str(model.parent.resolve())
    if _has_blank(folder):
        folder = os.path.relpath(folder, place.resolve())
    if _has_blank(folder + model.name):
        raise InputError(f"model {model}: LAMMPS cannot include a file with a blank in its name or that of its folder")
    return folder


def _has_blank(text: str) -> bool:
    return any(letter.isspace() for letter in text)
