# SPDX-License-Identifier: GPL-2.0-or-later
"""What is in a folder of results, read and analysed; nothing is written here."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from .errors import ShearboxError
from .features import Verdict, dilates, peak_at_steepest, proportional
from .files import CONSOLIDATED_TABLE, PACKED, PACKED_TABLE, SHEAR_DONE, SHEAR_TABLE, stress_folder
from .peak import Peak, find_peak
from .polynomial import FEWEST_ROWS, Fit, fit_curve
from .readers import Columns, read_row, read_shear
from .request import read_record
from .specimen import count_lost
from .strength import Line, fit_line


@dataclass(frozen=True)
class Shear:
    """The shear phase at one stress; stresses in kPa, lengths in mm."""

    sigma: float
    folder: Path
    data: Columns
    complete: bool
    tau: Fit
    lid: Fit
    peak: Peak
    lost: int | None  # grains outside the box in the last frame

    @property
    def reached(self) -> float:
        """Shear displacement so far."""
        return float(self.data["displacement_mm"][-1])

    @cached_property
    def verdicts(self) -> dict[str, Verdict]:
        """The features that can be judged for one stress alone."""
        return {
            "dilates": dilates(self.lid, self.peak),
            "peak_at_steepest_dilatancy": peak_at_steepest(self.tau, self.peak, self.lid),
        }

    @property
    def felt_error(self) -> float:
        """Mean stress that the lid feels over the applied one, less 1."""
        return float(np.mean(self.data["sigma_kPa"]) / self.sigma - 1)

    @property
    def energy_error(self) -> float | None:
        """Energy that the audit misses over the work put in: the error of the time step; None without an audit."""
        work, residual = self.data["work_J"][-1], self.data["residual_J"][-1]
        return float(residual / work) if work != 0 else None

    @property
    def dangerous_builds(self) -> int:
        """Neighbour lists built too late; the counter begins anew when the phase is continued."""
        counts = self.data["dangerous"]
        steps = np.diff(counts, prepend=0)
        return int(np.sum(np.where(steps < 0, counts, steps)))


@dataclass(frozen=True)
class Results:
    """All that a folder holds; `problems` are damages, `notes` what else a reader must know."""

    folder: Path
    identity: dict[str, Any]
    model_file: Path  # where the model was; it may be gone
    stresses: list[float]  # asked for, kPa
    packing: dict[str, float] | None
    consolidations: dict[float, dict[str, float]]
    shears: list[Shear]
    problems: list[str]
    notes: list[str]

    @property
    def complete(self) -> bool:
        """Whether all that was asked for is there, to the end and undamaged."""
        return not self.problems and len(self.shears) == len(self.stresses) and all(s.complete for s in self.shears)

    @cached_property
    def line(self) -> Line | None:
        """Coulomb's line through the peaks, of at least two stresses."""
        if len(self.shears) < 2:
            return None
        points = [(s.sigma, s.peak.value, s.peak.value_error) for s in self.shears]
        return fit_line(*np.array(points).T)

    @cached_property
    def proportional(self) -> Verdict:
        """The feature that needs all stresses."""
        return proportional(
            np.array([s.sigma for s in self.shears]), np.array([s.peak.value for s in self.shears]), self.line
        )


def read_results(folder: Path) -> Results:
    """Read and analyse; what is damaged becomes a problem, and the rest is read all the same."""
    record = read_record(folder)
    problems: list[str] = []
    notes: list[str] = []
    consolidations: dict[float, dict[str, float]] = {}
    shears = []
    packing = _optional(folder / PACKED / PACKED_TABLE, problems)
    for sigma in sorted(record["stresses"]):
        row = _optional(stress_folder(folder, sigma) / CONSOLIDATED_TABLE, problems)
        if row is not None:
            consolidations[sigma] = row
        shear = _read_shear(folder, sigma, record["identity"], problems, notes)
        if shear is not None:
            shears.append(shear)
            if not shear.complete:
                notes.append(f"{sigma:g} kPa has reached {shear.reached:.2f} mm only")
            if shear.peak.at_boundary:
                where = f"{shear.peak.position:.2f} mm"
                notes.append(
                    f"{sigma:g} kPa: τ has no peak within the travel; its greatest value, at {where}, is taken"
                )
    identity, stresses = record["identity"], record["stresses"]
    model_file = Path(record.get("model_file", ""))
    return Results(folder, identity, model_file, stresses, packing, consolidations, shears, problems, notes)


def _read_shear(
    folder: Path, sigma: float, identity: dict[str, Any], problems: list[str], notes: list[str]
) -> Shear | None:
    place = stress_folder(folder, sigma)
    path = place / SHEAR_TABLE
    if not path.exists():
        notes.append(f"{sigma:g} kPa has not been sheared yet")
        return None
    try:
        data = read_shear(path)
    except ShearboxError as error:
        problems.append(str(error))
        return None
    if len(data["step"]) < FEWEST_ROWS:
        notes.append(f"{sigma:g} kPa has {len(data['step'])} rows of data only, too few to fit a curve")
        return None
    tau = fit_curve(data["displacement_mm"], data["tau_kPa"])
    lid = fit_curve(data["displacement_mm"], data["lid_mm"], through_origin=True)
    lost = _lost(place, identity, problems)
    return Shear(sigma, place, data, (place / SHEAR_DONE).exists(), tau, lid, find_peak(tau), lost)


def _lost(place: Path, identity: dict[str, Any], problems: list[str]) -> int | None:
    try:
        return count_lost(place, identity["model ngrains"], identity["model width"], identity["model half_height"])
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
