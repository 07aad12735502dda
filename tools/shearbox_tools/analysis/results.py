# SPDX-License-Identifier: GPL-2.0-or-later
"""What is in a folder of results, read and analysed; nothing is written here."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ..asking.box_width import narrow_by_record
from ..asking.request import read_record
from ..base.errors import ShearboxError
from ..base.files import CELLS_DUMP, CONSOLIDATED_TABLE, GRAINS_DUMP, PACKED, PACKED_TABLE, SHEAR_TABLE, stress_folder
from ..base.notes import Remark, said_once
from ..base.presets import LAMMPS
from ..base.verdict import Verdict
from ..reading.readers import read_row, read_shear
from ..running.phases import rows_of_shear
from .ensemble import Estimate, as_angle, mean_of
from .features import proportional
from .moments import count_lost, missing_frames, stress_tilt
from .motion import full_speed
from .peak import Peak
from .plane import line_on_plane
from .polynomial import FEWEST_ROWS
from .shear import Shear, analyse
from .strength import Line, fit_line

Value = TypeVar("Value")


@dataclass(frozen=True)
class Results:
    """All that a folder holds."""

    folder: Path
    identity: dict[str, Any]
    model_file: Path  # where the model was; it may be gone
    stresses: list[float]  # asked for, kPa
    packing: dict[str, float] | None
    consolidations: dict[float, dict[str, float]]
    shears: list[Shear]
    problems: tuple[str, ...]  # damages of tables
    frame_problems: tuple[str, ...]  # of dumps: no number of the strength needs them
    notes: tuple[str, ...]  # what else a reader must know

    @property
    def complete(self) -> bool:
        """Whether the tables of all that was asked for are there, to the end and undamaged."""
        return not self.problems and len(self.shears) == len(self.stresses) and all(s.complete for s in self.shears)

    @property
    def doubts(self) -> list[str]:
        """Why there is no strength yet, if so: a line through the peaks is then that of the peaks so far."""
        missing = sorted(set(self.stresses) - {shear.sigma for shear in self.shears})
        doubts = [f"{sigma:g} kPa: there is no curve" for sigma in missing]
        return doubts + [f"{shear.sigma:g} kPa: {shear.doubt}" for shear in self.shears if shear.doubt]

    @cached_property
    def line(self) -> Line | None:
        """Coulomb's line through the peaks of the polynomials, of at least two stresses."""
        return self._line([shear.peak for shear in self.shears])

    @property
    def strength(self) -> Line | None:
        """The line, if there are no doubts: what is told as φ and c."""
        return None if self.doubts else self.line

    @property
    def plane_strength(self) -> Line | None:
        """The same by the stresses on the shear plane."""
        return None if self.doubts else self.plane_line

    @cached_property
    def smoothed_line(self) -> Line | None:
        """The same through the peaks of the smoothed data."""
        return self._line([shear.smoothed for shear in self.shears])

    @property
    def knows_plane(self) -> bool:
        """Whether the stresses on the shear plane are known at all stresses of the lid."""
        return all(shear.plane for shear in self.shears)

    @property
    def judges_plane(self) -> bool:
        """Whether all their peaks can be judged, too."""
        return self.knows_plane and not any(shear.plane_doubt for shear in self.shears)

    @cached_property
    def plane_line(self) -> Line | None:
        """That by the stresses on the shear plane, where these are known and their peaks can be judged."""
        planes = [shear.plane for shear in self.shears if shear.plane]
        if not self.judges_plane or len({plane.sigma_at_peak for plane in planes}) < 2:
            return None
        return line_on_plane(planes)

    @cached_property
    def ultimate_angle(self) -> Estimate | None:
        """Angle (degrees) whose tangent is the mean of tau / sigma at the end, with its interval over the stresses."""
        if len(self.shears) < 2:
            return None
        return as_angle(mean_of(np.array([shear.at_end.ratio for shear in self.shears])))

    @cached_property
    def proportional(self) -> Verdict:
        """The feature that needs all stresses."""
        verdict = proportional(
            np.array([s.sigma for s in self.shears]), np.array([s.peak.value for s in self.shears]), self.line
        )
        return verdict.in_doubt("not all peaks can be judged" if self.doubts else None)

    def _line(self, peaks: list[Peak]) -> Line | None:
        if len(peaks) < 2:
            return None
        points = [(s.sigma, peak.value, peak.value_error) for s, peak in zip(self.shears, peaks)]
        return fit_line(*np.array(points).T)


def read_results(folder: Path) -> Results:
    """Read and analyse; what is damaged becomes a problem, and the rest is read all the same."""
    record = read_record(folder)
    problems: list[str] = []
    frame_problems: list[str] = []
    remarks: list[Remark] = []
    consolidations: dict[float, dict[str, float]] = {}
    shears = []
    packing = _optional(folder / PACKED / PACKED_TABLE, problems)
    for sigma in sorted(record["stresses"]):
        row = _optional(stress_folder(folder, sigma) / CONSOLIDATED_TABLE, problems)
        if row is not None:
            consolidations[sigma] = row
        shear = _read_shear(folder, sigma, record["identity"], row or {}, problems, frame_problems, remarks)
        if shear is not None:
            shears.append(shear)
            remarks += [(sigma, text) for text in shear.remarks]
    identity, stresses = record["identity"], record["stresses"]
    model_file = Path(record.get("model_file", ""))
    notes = tuple(said_once(remarks) + narrow_by_record(identity))
    told = tuple(problems), tuple(frame_problems), notes
    return Results(folder, identity, model_file, stresses, packing, consolidations, shears, *told)


def _read_shear(
    folder: Path,
    sigma: float,
    identity: dict[str, Any],
    bed: dict[str, float],
    problems: list[str],
    frame_problems: list[str],
    remarks: list[Remark],
) -> Shear | None:
    place = stress_folder(folder, sigma)
    path = place / SHEAR_TABLE
    if not path.exists():
        remarks.append((sigma, "not sheared yet"))
        return None
    try:
        data = read_shear(path)
    except ShearboxError as error:
        problems.append(str(error))
        return None
    rows = full_speed(data)
    if rows.stop - rows.start < FEWEST_ROWS:
        remarks.append((sigma, f"{rows.stop - rows.start} rows at full speed only, too few to fit a curve"))
        return None
    missing = missing_frames(place)
    if (host := identity.get("host", LAMMPS)) != LAMMPS:
        remarks.append((sigma, f"{host} writes no frames, so there is no picture"))
    elif missing:
        without = f"no {', '.join(missing)} and so no picture; without its {SHEAR_TABLE} it would be run again"
        remarks.append((sigma, without))
    complete = len(data["step"]) == rows_of_shear()
    return analyse(sigma, place, data, rows, complete, identity, bed, *told_by_frames(place, identity, frame_problems))


def told_by_frames(place: Path, identity: dict[str, Any], problems: list[str]) -> tuple[int | None, float | None]:
    """Grains outside the box in the last frame, and the tilt of the normal stress in the first; None where there are no frames, or
    where these are damaged, which becomes a problem."""

    def lost() -> int:
        return count_lost(place, identity["model ngrains"], identity["model width"], identity["model half_height"])

    lost_in_last = _told(place / GRAINS_DUMP, lost, problems)
    return lost_in_last, _told(place / CELLS_DUMP, lambda: stress_tilt(place), problems)


def _told(path: Path, read: Callable[[], Value], problems: list[str]) -> Value | None:
    if not path.exists():
        return None
    try:
        return read()
    except ShearboxError as error:
        problems.append(str(error))
        return None


def _optional(path: Path, problems: list[str]) -> dict[str, float] | None:
    if not path.exists():
        return None
    try:
        return read_row(path)
    except ShearboxError as error:
        problems.append(str(error))
        return None
