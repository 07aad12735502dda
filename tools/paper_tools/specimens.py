# SPDX-License-Identifier: GPL-2.0-or-later
"""What each specimen of a campaign has measured: numbers and curves of each test, strengths and features over its stresses."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from shearbox_tools.analysis.differences import mean_angle
from shearbox_tools.analysis.ensemble import lines_of
from shearbox_tools.analysis.ensemble_results import FEATURES, holds_in
from shearbox_tools.analysis.grouping import LeftOut
from shearbox_tools.analysis.peak import steepest
from shearbox_tools.analysis.read_runs import read_all, read_quietly
from shearbox_tools.analysis.results import Results
from shearbox_tools.analysis.shear import LARGEST_ERROR_PERCENT, Shear
from shearbox_tools.analysis.stress_dilatancy import ultimate_rows
from shearbox_tools.base.timings import read_timings
from shearbox_tools.running.run_folders import find_runs

Numbers = dict[str, float]

# Of a test, with units. Ratios are of stresses; those of the plane are of the stresses on the shear plane.
NUMBERS = {
    "peak": "greatest τ/σ of the polynomial",
    "peak_mm": "shear displacement there, mm",
    "peak_smoothed": "greatest τ/σ of the smoothed data",
    "peak_plane": "greatest τ on the shear plane over σ there, polynomials",
    "plane_load": "σ on the shear plane there, over the lid's",
    "mean": "mean τ over mean σ",
    "mean_plane": "the same on the shear plane",
    "mean_inside": "mean shear stress over mean normal stress inside, of the stress tensor of all grains",
    "tensor_deg": "mobilised friction angle of that tensor at the peak of τ, by its principal stresses, degrees",
    "end": "τ/σ in the last fifth",
    "sharpness": "greatest τ over that of the last fifth",
    "dilation_deg": "dilation angle at the peak of τ, degrees",
    "steepest": "steepest rise of the lid, mm/mm",
    "highest_mm": "highest place of the lid, mm",
    "late_rate": "mean rise of the lid in the second half of the travel, mm/mm",
    "trm": "TRM at the end",
    "roughness": "scatter of τ around its polynomial, over mean τ",
    "inertial": "mean inertial number inside",
    "coordination": "coordination number before shear",
    "solid": "solid fraction before shear",
    "sides_rest": "vertical load on the sides of the upper half over the lid's, before shear",
    "sides_peak": "the same at the peak of τ",
    "flanges_peak": "load on flanges of the upper half over the lid's, at the peak of τ",
}


PLACES = np.linspace(0.1, 7.9, 79)  # of curves, shear displacements in mm
CURVES = ("tau_kPa", "lid_mm", "trm")
JUDGED = FEATURES[:3]  # what the paper says of every test


@dataclass(frozen=True)
class Specimen:
    """One packing, sheared at several normal stresses (kPa); angles of its strength in degrees, cohesions in kPa, nan where not all of
    its peaks can be judged.

    `tests` are NUMBERS by stress, nan where one is not known, and `curves` those of CURVES (3, 79) at PLACES, where they are
    known. `holds`: each of JUDGED; None, that it cannot be judged. `hours` are those that it took, nan if unknown.
    """

    seed: int
    tests: dict[float, Numbers]
    phi: float
    c: float
    phi_plane: float
    c_plane: float
    curves: dict[float, np.ndarray]
    holds: dict[str, bool | None]
    hours: float

    @property
    def is_followed(self) -> bool:
        """Whether the polynomials follow the curves at all stresses."""
        return all(map(follows, self.tests.values()))

    def mean(self, name: str) -> float:
        """Of a number of NUMBERS, over the stresses; of a strength, itself. What is read at the peaks of polynomials is not known where
        these do not follow the curves."""
        if name in (*STRENGTHS, *AT_PEAKS) and not self.is_followed:
            return np.nan
        if name in STRENGTHS:
            return float(getattr(self, name))
        return float(np.mean([numbers[name] for numbers in self.tests.values()]))


def missed(test: Numbers) -> float:
    """How far the peak of the polynomial is from that of the smoothed data, as a share of it."""
    return abs(test["peak"] / test["peak_smoothed"] - 1)


def follows(test: Numbers) -> bool:
    """Whether that is no more than a peak may be uncertain, as far as it is known."""
    return not missed(test) > LARGEST_ERROR_PERCENT / 100


AT_PEAKS = ("peak", "peak_mm", "peak_plane", "plane_load", "sharpness", "dilation_deg")
STRENGTHS = ("phi", "c", "phi_plane", "c_plane")
ANGLES = ("phi", "phi_plane")  # of slopes


@dataclass(frozen=True)
class Group:
    """The specimens of an entry of a campaign, in the order of their seeds."""

    name: str
    model: str
    speed: float  # mm/s
    specimens: list[Specimen]

    def values(self, name: str) -> np.ndarray:
        """(specimens,) of a number of NUMBERS, in the mean over the stresses, or of a strength; of those of which it is known."""
        values = np.array([specimen.mean(name) for specimen in self.specimens])
        return values[np.isfinite(values)]

    def linear(self, name: str) -> np.ndarray:
        """The same; of angles to first order around that of their mean slope, which is the mean of what is returned."""
        values = self.values(name)
        if name not in ANGLES or not len(values):
            return values
        linear = mean_angle(np.tan(np.radians(values))).values
        assert linear is not None
        return linear

    @property
    def stresses(self) -> list[float]:
        """kPa, in order."""
        return sorted({sigma for one in self.specimens for sigma in one.tests})

    @property
    def drawn(self) -> list[Specimen]:
        """Specimens whose curves are known."""
        return [one for one in self.specimens if one.curves]

    def at(self, sigma: float, name: str) -> np.ndarray:
        """(specimens,) of a number of NUMBERS, of the tests at one stress (kPa) in which it is known and their polynomials follow."""
        values = np.array([test[name] for test in self.tests_at(sigma)])
        return values[np.isfinite(values)]

    def tests_at(self, sigma: float) -> list[Numbers]:
        """Those at one stress (kPa) whose polynomials follow the curves."""
        tests = [one.tests[sigma] for one in self.specimens if sigma in one.tests]
        return [test for test in tests if follows(test)]


def read_specimens(folder: Path) -> tuple[dict[str, list[Specimen]], list[LeftOut]]:
    """Those below the folder of a campaign by the names of their entries, without runs that have not ended; and what is damaged."""
    places = find_runs(folder) if folder.is_dir() else []
    entries: dict[str, list[Specimen]] = {}
    every, damaged = read_all(places, read_quietly)
    for run in every:
        if run.complete and run.knows_plane and len(run.shears) > 1:
            entries.setdefault(run.folder.relative_to(folder).parts[0], []).append(specimen(run))
        damaged += [LeftOut(run.folder, problem) for problem in run.problems]
    return entries, damaged


def specimen(results: Results) -> Specimen:
    """The numbers of a run that is complete."""
    lid = [(shear.sigma, shear.peak.value) for shear in results.shears]
    plane = [(shear.plane.sigma_at_peak, shear.plane.peak.value) for shear in results.shears if shear.plane]
    phi, c = _strength(lid, not results.doubts)
    phi_plane, c_plane = _strength(plane, not results.doubts and results.judges_plane)
    return Specimen(
        seed=int(results.identity["seed"]),
        tests={shear.sigma: numbers(shear, results.consolidations.get(shear.sigma, {})) for shear in results.shears},
        phi=phi,
        c=c,
        phi_plane=phi_plane,
        c_plane=c_plane,
        curves={shear.sigma: curves(shear) for shear in results.shears},
        holds={name: holds_in(results, name) for name in JUDGED},
        hours=sum(read_timings(results.folder).values()) / 3600,
    )


def _strength(peaks: list[tuple[float, float]], judged: bool) -> tuple[float, float]:
    """Angle (degrees) and cohesion (kPa) of a line through peaks (sigma, tau), where these are judged."""
    if not judged:
        return np.nan, np.nan
    slope, c = lines_of(*np.array(peaks).T)
    return float(np.degrees(np.arctan(slope))), float(c)


def curves(shear: Shear) -> np.ndarray:
    """(3, 79): CURVES at PLACES; nan beyond the travel."""
    s = shear.data["displacement_mm"]
    return np.array([np.interp(PLACES, s, shear.data[name], np.nan, np.nan) for name in CURVES])


def numbers(shear: Shear, bed: Numbers) -> Numbers:
    """Those of NUMBERS of one test; `bed` is the table of its consolidation, empty if that is gone."""
    rows = {name: column[shear.rows] for name, column in shear.data.items()}
    s, plane = rows["displacement_mm"], shear.plane
    assert plane is not None
    at_peak = int(np.argmin(np.abs(s - shear.peak.position)))
    near = slice(max(0, at_peak - len(s) // 40), at_peak + len(s) // 40 + 1)  # a twentieth of the travel
    lid = np.mean(rows["sigma_kPa"])
    half = len(s) // 2
    return {
        "peak": shear.at_peak.ratio,
        "peak_mm": shear.peak.position,
        "peak_smoothed": shear.smoothed.value / shear.sigma,
        "peak_plane": plane.peak.value / plane.sigma_at_peak,
        "plane_load": plane.sigma_at_peak / shear.sigma,
        "mean": float(np.mean(rows["tau_kPa"]) / lid),
        "mean_plane": float(np.mean(rows["plane_tau_kPa"]) / np.mean(rows["plane_kPa"])),
        "mean_inside": float(np.mean(rows["stress_xy_kPa"]) / np.mean(rows["stress_yy_kPa"])),
        "tensor_deg": _mobilised(*(float(np.mean(rows[f"stress_{of}_kPa"][near])) for of in ("xx", "yy", "xy"))),
        "end": shear.at_end.ratio,
        "sharpness": shear.peak.value / float(np.mean(rows["tau_kPa"][ultimate_rows(len(s))])),
        "dilation_deg": shear.at_peak.dilation_deg,
        "steepest": steepest(shear.lid)[1],
        "highest_mm": float(np.max(rows["lid_mm"])),
        "late_rate": float((rows["lid_mm"][-1] - rows["lid_mm"][half]) / (s[-1] - s[half])),
        "trm": float(rows["trm"][-1]),
        "roughness": float(np.std(rows["tau_kPa"] - shear.tau.series(s)) / np.mean(rows["tau_kPa"])),
        "inertial": float(np.mean(rows["inertial"])),
        "coordination": float(shear.data["coordination"][0]),
        "solid": bed.get("solid_fraction", np.nan),
        "sides_rest": float(shear.data["sides_upper_kPa"][0] / lid),
        "sides_peak": float(np.mean(rows["sides_upper_kPa"][near]) / lid),
        "flanges_peak": float(np.mean(rows["flanges_upper_kPa"][near]) / lid),
    }


def _mobilised(xx: float, yy: float, xy: float) -> float:
    """Angle (degrees) whose sine is the radius of Mohr's circle over its centre."""
    return float(np.degrees(np.arcsin(2 * np.hypot((xx - yy) / 2, xy) / (xx + yy))))
