# SPDX-License-Identifier: GPL-2.0-or-later
"""summary.json: the results as numbers, with their units in the names."""

import platform
from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import __version__
from ..analysis.peak import steepest
from ..analysis.plane import OnPlane
from ..analysis.results import Results
from ..analysis.shear import Shear
from ..analysis.strength import COVERAGE, Line
from ..analysis.stress_dilatancy import Dilatant
from ..base.files import PACKED, log_file
from ..base.logs import Log, read_logs
from ..base.presets import LAMMPS
from ..base.timings import read_timings
from ..base.verdict import Verdict, of_all
from ..running.phases import CONSOLIDATE, PACK, SHEAR

DIGITS = 6


def summarise(results: Results) -> dict[str, Any]:
    """Everything that the report says in numbers; null stands for what is not known."""
    identity = results.identity
    summary = {
        "model": identity["model"],
        "seed": identity["seed"],
        "law": identity["law"],
        "stiffness": identity.get("stiffness"),
        "speed_mm_s": identity["speed_mm_s"],
        "travel_mm": identity["travel_mm"],
        "grains": identity["model ngrains"],
        "complete": results.complete,
        "notes": results.notes,
        "problems": [*results.problems, *results.frame_problems],
        **_strength(results),
        "stresses": [_stress(results, shear) for shear in results.shears],
        "criteria": _criteria(results),
        "packing": results.packing,
        "timings_s": read_timings(results.folder),
        "versions": _versions(results),
        "parameters": {**identity["parameters"], **{k: v for k, v in identity.items() if k.startswith("model ")}},
    }
    return plain(summary)


def _strength(results: Results) -> dict[str, Any]:
    """Of one specimen: intervals are of the fit alone. Numbers are null as long as there are doubts."""
    line, smoothed, ultimate = results.strength, results.smoothed_line, results.ultimate_angle
    if not (line and smoothed and ultimate):
        return {"phi_deg": None, "c_kPa": None, "doubts": results.doubts}
    return {
        **of_line(line),
        "coverage": COVERAGE,
        "specimens": 1,
        "interval_holds_scatter_of_specimens": False,
        "doubts": [],
        "r_squared": line.r_squared,
        "chi2_reduced": line.chi2_reduced,
        "phi_through_origin_deg": line.phi_through_origin_deg,
        **of_line(results.plane_strength, "_plane"),
        "phi_smoothed_deg": smoothed.phi_deg,
        "phi_smoothed_half_width_deg": smoothed.phi_half_width_deg,
        "c_smoothed_kPa": smoothed.c_kPa,
        "phi_ultimate_deg": float(ultimate.value),
        "phi_ultimate_interval_deg": [float(ultimate.low), float(ultimate.high)],
    }


def of_line(line: Line | None, which: str = "") -> dict[str, float | None]:
    """Friction angle and cohesion with their half-widths, of the fit alone; None without a line."""
    return {
        f"phi{which}_deg": line.phi_deg if line else None,
        f"phi{which}_half_width_deg": line.phi_half_width_deg if line else None,
        f"c{which}_kPa": line.c_kPa if line else None,
        f"c{which}_half_width_kPa": line.c_half_width_kPa if line else None,
    }


def _stress(results: Results, shear: Shear) -> dict[str, Any]:
    peak = shear.peak
    at_steepest, rate = steepest(shear.lid)
    return {
        "sigma_kPa": shear.sigma,
        "complete": shear.complete,
        "dt_s": _time_step(shear, results.identity["speed_mm_s"]),
        "displacement_reached_mm": shear.reached,
        "tau_peak_kPa": peak.value,
        "tau_peak_error_kPa": peak.value_error,
        "displacement_at_peak_mm": peak.position,
        "displacement_at_peak_error_mm": peak.position_error,
        "peak_at_boundary": peak.at_boundary,
        "doubt": shear.doubt,
        "fitted_from_mm": float(shear.data["displacement_mm"][shear.rows][0]),
        "fitted_to_mm": float(shear.data["displacement_mm"][shear.rows][-1]),
        "tau_residual_kPa": shear.residual,
        "tau_peak_smoothed_kPa": shear.smoothed.value,
        "tau_peak_smoothed_error_kPa": shear.smoothed.value_error,
        "displacement_at_smoothed_peak_mm": shear.smoothed.position,
        "peaks_differ": shear.peaks_differ,
        "inertial_number": shear.inertia.number,
        "imbalance_percent": shear.inertia.imbalance_percent,
        "tau_polynomial_degree": shear.tau.degree,
        "lid_polynomial_degree": shear.lid.degree,
        "lid_at_peak_mm": float(shear.lid.series(peak.position)),
        "lid_highest_mm": shear.lid_highest,
        "lid_end_mm": float(shear.lid.series(shear.lid.span)),
        "steepest_dilatancy_mm_per_mm": rate,
        "displacement_at_steepest_mm": at_steepest,
        "tau_ultimate_kPa": shear.ultimate[0],
        "tau_ultimate_error_kPa": shear.ultimate[1],
        **_on_plane(shear.plane),
        "at_peak": _dilatancy(shear.at_peak),
        "at_end": _dilatancy(shear.at_end),
        "trm": float(shear.data["trm"][-1]),
        "felt_stress_mean_kPa": float(np.mean(shear.data["sigma_kPa"])),
        "felt_stress_error_percent": 100 * shear.felt_error,
        "work_J": float(shear.data["work_J"][-1]),
        "energy_error_percent": None if shear.energy_error is None else 100 * shear.energy_error,
        "grains_lost": shear.lost,
        "dangerous_builds": shear.dangerous_builds,
        "consolidation": results.consolidations.get(shear.sigma),
        "criteria": {name: _verdict(v) for name, v in shear.verdicts.items()},
    }


def _on_plane(plane: OnPlane | None) -> dict[str, float | bool | None]:
    """Stresses on the shear plane; null where they are not known."""
    return {
        "plane_tau_peak_kPa": plane.peak.value if plane else None,
        "plane_tau_peak_error_kPa": plane.peak.value_error if plane else None,
        "displacement_at_plane_peak_mm": plane.peak.position if plane else None,
        "plane_peak_at_boundary": plane.peak.at_boundary if plane else None,
        "plane_at_peak_kPa": plane.sigma_at_peak if plane else None,
        "plane_at_peak_error_kPa": plane.sigma_at_peak_error if plane else None,
        "plane_at_end_kPa": plane.at_end[0] if plane else None,
        "plane_tau_at_end_kPa": plane.at_end[1] if plane else None,
    }


def _dilatancy(state: Dilatant) -> dict[str, float | bool | None]:
    return {
        "stress_ratio": state.ratio,
        "dilation_deg": state.dilation_deg,
        "is_critical": state.is_critical,
        "phi_plane_strain_deg": state.plane_strain_deg,
        "phi_cv_rowe_deg": state.critical_by_rowe_deg,
        "phi_cv_bolton_deg": state.critical_by_bolton_deg,
    }


def _criteria(results: Results) -> dict[str, Any]:
    """What is judged of all stresses together, and what must hold for every stress."""
    criteria = {"proportional": _verdict(results.proportional)}
    for name in ("dilates", "peak_at_steepest_dilatancy", "quasi_static"):
        criteria[name] = _verdict(of_all([(s.sigma, s.verdicts[name]) for s in results.shears]))
    return criteria


def _verdict(verdict: Verdict) -> dict[str, Any]:
    return {"holds": verdict.holds, "reason": verdict.reason}


def _time_step(shear: Shear, speed: float) -> float:
    """dt from steps and displacements in the rows at full speed (mm/s)."""
    steps, displacement = (np.ptp(shear.data[name][shear.rows]) for name in ("step", "displacement_mm"))
    return float(f"{displacement / speed / steps:.4g}")


def phase_logs(results: Results) -> dict[str, Log]:
    """The logs of all phases by their label."""
    logs = {PACK: read_logs(log_file(results.folder / PACKED, PACK))}
    for shear in results.shears:
        for name in (CONSOLIDATE, SHEAR):
            logs[f"{name} {shear.sigma:g} kPa"] = read_logs(log_file(shear.folder, name))
    return logs


def _versions(results: Results) -> dict[str, str | None]:
    logs = list(phase_logs(results).values())
    return {
        "shearbox": __version__,
        "engine": next((log.shearbox for log in logs if log.shearbox), None),
        results.identity.get("host", LAMMPS): next((log.host for log in logs if log.host), None),
        "python": platform.python_version(),
        "numpy": np.__version__,
    }


def plain(value: Any) -> Any:
    """The same as JSON knows it: numbers rounded to what they are worth, no NaN."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (float, np.floating)):
        return float(f"{value:.{DIGITS}g}") if np.isfinite(value) else None
    return value
