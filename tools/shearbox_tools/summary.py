# SPDX-License-Identifier: GPL-2.0-or-later
"""summary.json: the results as numbers, with their units in the names."""

import platform
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import __version__
from .campaign import read_timings
from .features import Verdict, steepest_dilatancy
from .files import PACKED, log_file
from .logs import Log, read_logs
from .phases import CONSOLIDATE, PACK, SHEAR
from .results import Results, Shear
from .strength import COVERAGE, Line

DIGITS = 6


def summarise(results: Results) -> dict[str, Any]:
    """Everything that the report says in numbers; null stands for what is not known."""
    identity = results.identity
    summary = {
        "model": identity["model"],
        "seed": identity["seed"],
        "law": identity["law"],
        "stiffness": identity["stiffness"],
        "speed_mm_s": identity["speed_mm_s"],
        "travel_mm": identity["travel_mm"],
        "grains": identity["model ngrains"],
        "complete": results.complete,
        "notes": results.notes,
        "problems": results.problems,
        **_strength(results.line),
        "stresses": [_stress(results, shear) for shear in results.shears],
        "criteria": _criteria(results),
        "packing": results.packing,
        "timings_s": read_timings(results.folder),
        "versions": _versions(results),
        "parameters": {**identity["parameters"], **{k: v for k, v in identity.items() if k.startswith("model ")}},
    }
    return _plain(summary)


def _strength(line: Line | None) -> dict[str, Any]:
    if line is None:
        return {"phi_deg": None, "c_kPa": None}
    return {
        "phi_deg": line.phi_deg,
        "phi_half_width_deg": line.phi_half_width_deg,
        "c_kPa": line.c_kPa,
        "c_half_width_kPa": line.c_half_width_kPa,
        "coverage": COVERAGE,
        "r_squared": line.r_squared,
        "chi2_reduced": line.chi2_reduced,
        "phi_through_origin_deg": line.phi_through_origin_deg,
    }


def _stress(results: Results, shear: Shear) -> dict[str, Any]:
    peak = shear.peak
    steepest, rate = steepest_dilatancy(shear.lid)
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
        "tau_polynomial_degree": shear.tau.degree,
        "lid_polynomial_degree": shear.lid.degree,
        "lid_at_peak_mm": float(shear.lid.series(peak.position)),
        "lid_highest_mm": float(np.max(shear.lid.series(np.linspace(0, shear.lid.span, 401)))),
        "lid_end_mm": float(shear.lid.series(shear.lid.span)),
        "steepest_dilatancy_mm_per_mm": rate,
        "displacement_at_steepest_mm": steepest,
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


def _criteria(results: Results) -> dict[str, Any]:
    """The three features: that of all stresses together, and those that must hold for every stress."""
    criteria = {"proportional": _verdict(results.proportional)}
    for name in ("dilates", "peak_at_steepest_dilatancy"):
        verdicts = [shear.verdicts[name].holds for shear in results.shears]
        failed = [f"{s.sigma:g} kPa" for s, holds in zip(results.shears, verdicts) if not holds]
        reason = f"not at {', '.join(failed)}" if failed else f"at all {len(verdicts)} stresses"
        criteria[name] = {"holds": not failed if verdicts else None, "reason": reason}
    return criteria


def _verdict(verdict: Verdict) -> dict[str, Any]:
    return {"holds": verdict.holds, "reason": verdict.reason}


def _time_step(shear: Shear, speed: float) -> float | None:
    """dt from steps and displacements; the speed (mm/s) is constant between the ramp and the stop at the end."""
    steps, displacement = shear.data["step"], shear.data["displacement_mm"]
    begin, end = len(steps) // 2, 3 * len(steps) // 4
    if steps[end] == steps[begin]:
        return None
    seconds = (displacement[end] - displacement[begin]) / speed
    return float(f"{seconds / (steps[end] - steps[begin]):.4g}")


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
        "lammps": next((log.lammps for log in logs if log.lammps), None),
        "python": platform.python_version(),
        "numpy": np.__version__,
    }


def _plain(value: Any) -> Any:
    """The same as JSON knows it: numbers rounded to what they are worth, no NaN."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, (float, np.floating)):
        return float(f"{value:.{DIGITS}g}") if np.isfinite(value) else None
    return value
