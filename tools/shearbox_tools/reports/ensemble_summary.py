# SPDX-License-Identifier: GPL-2.0-or-later
"""summary.json of ensembles: the results as numbers, with their units in the names; null stands for what is not known."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .. import __version__
from ..analysis.ensemble import EnsembleStrength, Estimate
from ..analysis.ensemble_results import RELATIONS, Ensemble, estimate
from ..analysis.grouping import LeftOut, settings_of, what_differs, what_is_set
from ..analysis.peak import Peak
from ..analysis.quasistatic import greatest
from ..analysis.results import Results
from ..analysis.shear import Shear
from ..analysis.strength import COVERAGE, known_scatter
from ..analysis.stress_dilatancy import Dilatant
from ..base.files import PAGE
from .summary import of_line, plain


def summarise_all(
    folder: Path, ensembles: Sequence[Ensemble], left_out: Sequence[LeftOut], tables: Sequence[str]
) -> dict[str, Any]:
    """Of a folder with its ensembles, whose mean curves are in `tables`; paths are as seen from the folder."""
    return plain(
        {
            "ensembles": [
                {"differs": differs, "curves": table, **_ensemble(folder, ensemble)}
                for ensemble, differs, table in zip(ensembles, what_differs(ensembles), tables)
            ],
            "left_out": [{"folder": _from(folder, one.folder), "reason": one.reason} for one in left_out],
            "coverage": COVERAGE,
            "shearbox": __version__,
        }
    )


def _ensemble(folder: Path, ensemble: Ensemble) -> dict[str, Any]:
    return {
        "model": ensemble.identity["model"],
        "specimens": [_specimen(folder, run) for run in ensemble.specimens],
        "parameters_set": what_is_set(ensemble),
        "packings": ensemble.model,
        "doubts": ensemble.doubts,
        **_strength(ensemble.strength, ""),
        **_strength(ensemble.smoothed_strength, "_smoothed"),
        **_strength(ensemble.plane_strength, "_plane"),
        "fit_alone": _fit_alone(ensemble),
        "known_scatter": known_scatter(ensemble.identity),
        "phi_ultimate_deg": _estimate(ensemble.ultimate_angle),
        "dilation_at_peak_deg": _estimate(ensemble.over_specimens(lambda shear: shear.at_peak.dilation_deg)),
        "phi_cv_at_end_deg": {name: _estimate(ensemble.critical_at_end(name)) for name in RELATIONS},
        "phi_cv_at_peak_less_at_end_deg": {name: _estimate(ensemble.change_of_critical(name)) for name in RELATIONS},
        "criteria": {
            name: {"holds": verdict.holds, "reason": verdict.reason, **_share(ensemble, name)}
            for name, verdict in ensemble.verdicts.items()
        },
        "stresses": [_stress(ensemble, sigma) for sigma in ensemble.shears],
        "settings": settings_of(ensemble.identity),
        "notes": ensemble.notes,
    }


def _strength(strength: EnsembleStrength | None, which: str) -> dict[str, Any]:
    return {
        f"phi{which}_deg": _estimate(strength.phi_deg if strength else None),
        f"c{which}_kPa": _estimate(strength.c_kPa if strength else None),
    }


def _fit_alone(ensemble: Ensemble) -> dict[str, float | None] | None:
    """The line of a single specimen, whose intervals do not hold the scatter of specimens."""
    strength = ensemble.specimens[0].strength
    return of_line(strength) if strength and ensemble.count == 1 else None


def _specimen(folder: Path, run: Results) -> dict[str, Any]:
    page = run.folder / PAGE
    peaks = {f"{shear.sigma:g}": shear.peak.value for shear in run.shears}
    own = page.exists() and run.folder != folder
    return {
        "folder": _from(folder, run.folder),
        "seed": run.identity["seed"],
        "tau_peak_kPa": peaks,
        "phi_deg": run.strength.phi_deg if run.strength else None,
        "report": _from(folder, page) if own else None,
    }


def _share(ensemble: Ensemble, feature: str) -> dict[str, int]:
    holds, judged = ensemble.share(feature)
    return {"specimens_in_which_it_holds": holds, "specimens_judged": judged}


def _stress(ensemble: Ensemble, sigma: float) -> dict[str, Any]:
    shears, curve = ensemble.shears[sigma], ensemble.curves[sigma]
    inertia = greatest([shear.inertia for shear in shears])
    return {
        "sigma_kPa": sigma,
        "specimens": len(shears),
        "peak_of_mean": _peak(curve.peak),
        "smoothed_peak_of_mean": _peak(curve.smoothed),
        "mean_of_peaks_kPa": _mean([shear.peak.value for shear in shears]),
        "mean_of_smoothed_peaks_kPa": _mean([shear.smoothed.value for shear in shears]),
        "displacement_at_peak_mm": _mean([shear.peak.position for shear in shears]),
        "tau_ultimate_kPa": _mean([shear.ultimate[0] for shear in shears]),
        "lid_at_peak_mm": _mean([float(shear.lid.series(shear.peak.position)) for shear in shears]),
        "lid_end_mm": float(curve.lid.mean[-1]),
        "at_peak": _dilatancy(shears, lambda shear: shear.at_peak),
        "at_end": _dilatancy(shears, lambda shear: shear.at_end),
        "inertial_number": inertia.number,
        "imbalance_percent": inertia.imbalance_percent,
        "criteria": {
            name: {
                "holds": verdict.holds,
                "reason": verdict.reason,
                "specimens_in_which_it_holds": sum(shear.verdicts[name].holds is True for shear in shears),
                "specimens_judged": sum(shear.verdicts[name].holds is not None for shear in shears),
            }
            for name, verdict in ensemble.verdicts_by_stress[sigma].items()
        },
    }


def _peak(peak: Peak) -> dict[str, Any]:
    return {"tau_kPa": peak.value, "displacement_mm": peak.position, "at_boundary": peak.at_boundary}


def _dilatancy(shears: Sequence[Shear], state: Any) -> dict[str, Any]:
    states: list[Dilatant] = [state(shear) for shear in shears]
    return {
        "stress_ratio": _mean([s.ratio for s in states]),
        "dilation_deg": _mean([s.dilation_deg for s in states]),
        "phi_plane_strain_deg": _mean([s.plane_strain_deg for s in states]),
        "phi_cv_rowe_deg": _mean([s.critical_by_rowe_deg for s in states]),
        "phi_cv_bolton_deg": _mean([s.critical_by_bolton_deg for s in states]),
        "specimens_at_constant_volume": sum(s.is_critical for s in states),
    }


def _mean(values: Sequence[float | None]) -> dict[str, float | None]:
    """Over specimens, also of a single one, which has no interval."""
    mean = estimate(values)
    if mean is not None:
        return _estimate(mean) or {}
    known = [value for value in values if value is not None]
    only = float(np.mean(known)) if len(known) == len(values) else None
    return {"value": only, "low": None, "high": None, "standard_deviation": None}


def _estimate(estimated: Estimate | None) -> dict[str, float | None] | None:
    if estimated is None:
        return None
    deviation = None if estimated.deviation is None else float(estimated.deviation)
    value, low, high = (float(number) for number in (estimated.value, estimated.low, estimated.high))
    return {"value": value, "low": low, "high": high, "standard_deviation": deviation}


def _from(folder: Path, path: Path) -> str:
    return str(path.relative_to(folder))
