# SPDX-License-Identifier: GPL-2.0-or-later
"""The shear phase at one stress, analysed."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ..base.verdict import Verdict, told_apart
from ..reading.readers import Columns
from .features import dilates, peak_at_steepest
from .peak import Peak, find_peak
from .plane import OnPlane, on_plane
from .polynomial import Fit, end_zone, fit_curve
from .quasistatic import Inertia, imbalance_percent, inertial_number
from .smoothed import find_smoothed_peak
from .stress_dilatancy import Dilatant, ultimate, ultimate_rows

# limits beyond which a peak is not taken for the strength, this project's choice
LARGEST_ERROR_PERCENT = 25
LEAST_ERROR_PERCENT = 1e-7  # less is round-off, as of a stress that is the same in all rows
LEAST_TRAVEL_PERCENT = 1  # of the width
LEAST_TRAVEL_WITHOUT_PEAK_PERCENT = 5
LARGEST_TILT = 0.5  # of the normal stress; in tests of boxes up to 15 cm it is 0.03 to 0.14 (rms), 0.44 at most


@dataclass(frozen=True)
class Shear:
    """Stresses in kPa, lengths in mm. The curves are fitted to the rows at full speed."""

    sigma: float
    folder: Path
    data: Columns
    complete: bool
    width: float
    rows: slice  # at full speed
    tau: Fit
    lid: Fit
    peak: Peak  # of the polynomial, as in the paper
    smoothed: Peak  # of the smoothed data
    inertia: Inertia
    lost: int | None  # grains outside the box in the last frame
    tilt: float | None  # of the normal stress along the box before shear, as moments.stress_tilt has it

    @property
    def reached(self) -> float:
        """Shear displacement so far."""
        return float(self.data["displacement_mm"][-1])

    @property
    def residual(self) -> float:
        """Root mean square distance of the stress, averaged over blocks, from its polynomial."""
        return float(np.sqrt(np.mean((self.tau.y - self.tau.fitted) ** 2)))

    @property
    def peaks_differ(self) -> bool:
        """Whether the two peaks are apart by more than their standard errors together.

        They come from the same data: on curves that a polynomial follows, 4 of 150 pairs were.
        """
        return abs(self.peak.value - self.smoothed.value) > self.peak.value_error + self.smoothed.value_error

    @cached_property
    def doubt(self) -> str | None:
        """Why the peak cannot be taken for the strength, if so."""
        return (
            doubt_of(self.peak, self.reached, self.width) if self.complete else f"sheared to {self.reached:.2f} mm only"
        )

    @cached_property
    def plane_doubt(self) -> str | None:
        """Why that on the shear plane, where it is known, cannot, though that of the lower half can."""
        return doubt_of(self.plane.peak, self.reached, self.width) if self.plane and not self.doubt else None

    @cached_property
    def verdicts(self) -> dict[str, Verdict]:
        """What can be judged for one stress alone."""
        return {
            "dilates": dilates(self.lid, self.peak).in_doubt(self.doubt),
            "peak_at_steepest_dilatancy": peak_at_steepest(self.tau, self.peak, self.lid).in_doubt(self.doubt),
            "quasi_static": self.inertia.quasi_static,
        }

    @property
    def remarks(self) -> list[str]:
        """What a reader of the numbers must know; numbers that the report has elsewhere are not in it."""
        remarks = []
        if self.doubt:
            remarks.append(self.doubt if not self.complete else f"the peak cannot be judged: {self.doubt}")
        if self.plane_doubt:
            remarks.append(f"the peak on the shear plane cannot be judged: {self.plane_doubt}")
        remarks += _edge_remark("τ", self.peak)
        if self.plane:
            remarks += _edge_remark("τ on the shear plane", self.plane.peak)
        if self.peaks_differ:
            remarks.append(
                "the polynomial's peak is not that of the smoothed data: they are apart by more than their errors"
            )
        if self.tilt and abs(self.tilt) > LARGEST_TILT:
            remarks.append(
                f"before shear the normal stress goes from {1 - self.tilt:.2f} of its mean at the left end of the box to "
                f"{1 + self.tilt:.2f} at the right: the specimen is not even"
            )
        if self.verdicts["quasi_static"].holds is False:
            remarks.append("not quasi-static; shear more slowly")
        return remarks

    @cached_property
    def plane(self) -> OnPlane | None:
        """Stresses on the shear plane, where the table has them."""
        return on_plane(self.data, self.rows)

    @cached_property
    def ultimate(self) -> tuple[float, float]:
        """Ultimate stress and its standard error: of the last fifth of the rows at full speed."""
        return ultimate(self.data["tau_kPa"][self.rows])

    @property
    def at_peak(self) -> Dilatant:
        """Stress ratio and dilatancy at the peak of the polynomial; where that is the end of the travel, dilatancy is that before the
        end zone, in which the slope of the lid's polynomial is hardly held."""
        position = min(self.peak.position, self.lid.span - end_zone(self.lid.span))
        return Dilatant(self.peak.value / self.sigma, float(self.lid.series.deriv()(position)))

    @cached_property
    def at_end(self) -> Dilatant:
        """Those of the last fifth; the dilatancy is the slope of a line through the lid's heights."""
        s, lid = (self.data[name][self.rows] for name in ("displacement_mm", "lid_mm"))
        last = ultimate_rows(len(s))
        slope = np.polyfit(s[last], lid[last], 1)[0]
        return Dilatant(self.ultimate[0] / self.sigma, float(slope))

    @property
    def lid_highest(self) -> float:
        """Greatest height of the lid by its polynomial."""
        return float(np.max(self.lid.series(np.linspace(0, self.lid.span, 401))))

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
    def dangerous_builds(self) -> int | None:
        """Neighbour lists built too late; None if they were not counted. The counter begins anew when the phase is continued."""
        if (counts := self.data.get("dangerous")) is None:
            return None
        steps = np.diff(counts, prepend=0)
        return int(np.sum(np.where(steps < 0, counts, steps)))


def doubt_of(peak: Peak, reached: float, width: float) -> str | None:
    """Why a peak cannot be taken for the strength, if so, of a curve that goes as far (mm) in a box so wide (mm)."""
    if peak.value <= 0:
        return f"τ at its peak is {told_apart(peak.value, 0, 0)} kPa: a strength is above 0"
    percent = 100 * peak.value_error / peak.value
    if percent < LEAST_ERROR_PERCENT:
        return f"τ = {peak.value:.0f} kPa without any scatter: how uncertain it is cannot be told"
    if percent > LARGEST_ERROR_PERCENT:
        return f"τ = {peak.value:.0f} ± {peak.value_error:.0f} kPa is too uncertain (error ≤ {LARGEST_ERROR_PERCENT} %)"
    travel = 100 * reached / width
    rises = peak.at_boundary and not peak.falls
    least = LEAST_TRAVEL_WITHOUT_PEAK_PERCENT if rises else LEAST_TRAVEL_PERCENT
    if travel < least:
        without = " without a peak" if rises else ""
        return f"sheared by {told_apart(travel, least, 1)} % of the width{without} (≥ {least} %)"
    return None


def _edge_remark(name: str, peak: Peak) -> list[str]:
    """What is to be said of a peak that is none."""
    if not peak.at_boundary:
        return []
    if peak.falls:
        return [
            f"{name} falls from {peak.position:.2f} mm on, where its polynomial is first held: taken is its value there, and a peak before it may be "
            "higher; the zone is a twentieth of the travel, so shear less far to see it"
        ]
    return [f"{name} has no peak within the travel; its greatest value is taken"]


def analyse(
    sigma: float,
    folder: Path,
    data: Columns,
    rows: slice,
    complete: bool,
    identity: dict[str, Any],
    bed: dict[str, float],
    lost: int | None,
    tilt: float | None,
) -> Shear:
    """Fit the curves to at least FEWEST_ROWS rows of `data`, and find their peaks.

    identity is that of the run; bed is the table of the consolidated specimen, empty where there is none.
    """
    s, tau = data["displacement_mm"][rows], data["tau_kPa"][rows]
    curve, lid = fit_curve(s, tau), fit_curve(s, data["lid_mm"][rows], through_origin=True)
    upper = data.get("tau_upper_kPa")
    imbalance = None if upper is None else imbalance_percent(tau, upper[rows])
    inertia = Inertia(_inertial_number(sigma, identity, bed), imbalance)
    width = 1000 * identity["model width"]
    peaks = find_peak(curve), find_smoothed_peak(s, tau)
    return Shear(sigma, folder, data, complete, width, rows, curve, lid, *peaks, inertia, lost, tilt)


def _inertial_number(sigma: float, identity: dict[str, Any], bed: dict[str, float]) -> float | None:
    """I; None where grains, their density or the specimen are not recorded."""
    try:
        density, height = float(identity["parameters"]["density"]), bed["height_m"]
        area = bed["solid_fraction"] * identity["model width"] * height / bed["grains"]
    except (KeyError, ValueError, ZeroDivisionError):
        return None
    return inertial_number(identity["speed_mm_s"] / 1000, 1000 * sigma, area, density, height)
