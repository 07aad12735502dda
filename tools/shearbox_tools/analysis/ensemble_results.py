# SPDX-License-Identifier: GPL-2.0-or-later
"""An ensemble: complete specimens that differ only in their packings, analysed together."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..base.verdict import Verdict, of_all, told_apart
from .ensemble import EnsembleStrength, Estimate, as_angle, mean_of, strength_of_independent, strength_of_shared
from .features import dilates, peak_at_steepest, proportional
from .mean_curve import MeanCurve, average
from .quasistatic import Inertia, greatest
from .results import Results
from .shear import Shear, doubt_of
from .strength import fit_line
from .stress_dilatancy import Dilatant

FEATURES = ("proportional", "dilates", "peak_at_steepest_dilatancy", "quasi_static")
SHARED, INDEPENDENT = "shared packings", "independent packings"
RELATIONS: dict[str, Callable[[Dilatant], float | None]] = {
    "rowe": lambda state: state.critical_by_rowe_deg,
    "bolton": lambda state: state.critical_by_bolton_deg,
}


def _peak_on_plane(shear: Shear) -> tuple[float, float]:
    assert shear.plane is not None
    return shear.plane.sigma_at_peak, shear.plane.peak.value


# (sigma, tau) in kPa: of the polynomial, of the smoothed data, and on the shear plane
PEAKS: dict[str, Callable[[Shear], tuple[float, float]]] = {
    "lid": lambda shear: (shear.sigma, shear.peak.value),
    "smoothed": lambda shear: (shear.sigma, shear.smoothed.value),
    "plane": _peak_on_plane,
}


@dataclass(frozen=True)
class Ensemble:
    """At least one specimen, each complete; a stress may be missing in some."""

    specimens: Sequence[Results]

    @property
    def identity(self) -> dict[str, Any]:
        """That of its first specimen; others have another seed."""
        return self.specimens[0].identity

    @property
    def count(self) -> int:
        """Specimens."""
        return len(self.specimens)

    @cached_property
    def shears(self) -> dict[float, list[Shear]]:
        """By stress (kPa), in order."""
        every = [shear for specimen in self.specimens for shear in specimen.shears]
        return {sigma: [s for s in every if s.sigma == sigma] for sigma in sorted({s.sigma for s in every})}

    @cached_property
    def curves(self) -> dict[float, MeanCurve]:
        """Means over the specimens, by stress."""
        return {sigma: average(shears) for sigma, shears in self.shears.items()}

    @property
    def independent(self) -> bool:
        """Whether each stress of each specimen has a packing of its own."""
        return all(len(specimen.shears) == 1 for specimen in self.specimens) and len(self.shears) > 1

    @property
    def common(self) -> list[float]:
        """Stresses that all specimens have."""
        return [sigma for sigma, shears in self.shears.items() if len(shears) == self.count]

    @property
    def model(self) -> str:
        """Which model of ensemble.py holds."""
        return INDEPENDENT if self.independent else SHARED

    @property
    def notes(self) -> Sequence[str]:
        """What a reader must know, of several specimens with the names of their folders."""
        if self.count == 1:
            return self.specimens[0].notes
        return [f"{run.folder.name}: {note}" for run in self.specimens for note in run.notes]

    @property
    def line_doubts(self) -> list[str]:
        """Why there is no line through its peaks, if so."""
        doubts = [f"{run.folder}: {doubt}" for run in self.specimens for doubt in run.doubts]
        if self.independent and self.count < 3:
            doubts.append(f"{self.count} peaks: at least 3 are needed")
        if not self.independent and len(self.common) < 2:
            doubts.append(f"stresses that all specimens have: {len(self.common)}; at least 2 are needed")
        return doubts

    @property
    def doubts(self) -> list[str]:
        """Why there is no strength of the ensemble, if so."""
        return self.line_doubts + ["one specimen: how others differ is not in it"] * (self.count < 2)

    @cached_property
    def strength(self) -> EnsembleStrength | None:
        """By the peaks of the polynomials."""
        return self._strength("lid")

    @cached_property
    def smoothed_strength(self) -> EnsembleStrength | None:
        """By those of the smoothed data."""
        return self._strength("smoothed")

    @cached_property
    def plane_strength(self) -> EnsembleStrength | None:
        """By the stresses on the shear plane, where these are known: by the peaks of their polynomials."""
        return self._strength("plane") if self.judges_plane else None

    @property
    def judges_plane(self) -> bool:
        """Whether the stresses on the shear plane are known of all specimens, and all peaks of them can be judged."""
        return all(specimen.judges_plane for specimen in self.specimens)

    def peaks(self, by: str) -> tuple[np.ndarray, np.ndarray]:
        """sigma and tau (kPa) of the peaks by one of PEAKS: of shared packings (specimens, stresses), at those that all
        have; of independent ones (peaks,)."""
        point = PEAKS[by]
        if self.independent:
            sigma, tau = np.array([point(shear) for shears in self.shears.values() for shear in shears]).T
        else:
            sigma, tau = np.array([[point(shear) for shear in self.shears[sigma]] for sigma in self.common]).T
        return sigma, tau

    def _strength(self, by: str) -> EnsembleStrength | None:
        if self.doubts:
            return None
        return (strength_of_independent if self.independent else strength_of_shared)(*self.peaks(by))

    @cached_property
    def ultimate_angle(self) -> Estimate | None:
        """Angle (degrees) whose tangent is the mean of tau / sigma at the end of the travel."""
        mean = self.over_specimens(lambda shear: shear.at_end.ratio)
        return None if mean is None else as_angle(mean)

    def over_specimens(self, value: Callable[[Shear], float | None]) -> Estimate | None:
        """Mean over specimens of the mean over their stresses, of shared packings over those that all have: what differs from stress to
        stress is no scatter. None of a single specimen, or where it cannot be told."""
        counted = self.shears if self.independent else self.common
        every = [[value(shear) for shear in specimen.shears if shear.sigma in counted] for specimen in self.specimens]
        return estimate([float(np.mean(np.array(row, float))) if row and None not in row else None for row in every])

    def critical_at_end(self, relation: str) -> Estimate | None:
        """phi_cv (degrees) of the end by 'rowe' or 'bolton'."""
        by = RELATIONS[relation]
        return self.over_specimens(lambda shear: by(shear.at_end))

    def change_of_critical(self, relation: str) -> Estimate | None:
        """phi_cv of the peak less that of the end (degrees) by 'rowe' or 'bolton': 0 where the relation holds."""
        by = RELATIONS[relation]

        def change(shear: Shear) -> float | None:
            peak, end = by(shear.at_peak), by(shear.at_end)
            return None if peak is None or end is None else peak - end

        return self.over_specimens(change)

    def share(self, feature: str) -> tuple[int, int]:
        """Specimens in which a feature holds, and those in which it can be judged; all stresses of one count together."""
        judged = [holds for holds in (holds_in(run, feature) for run in self.specimens) if holds is not None]
        return sum(judged), len(judged)

    @cached_property
    def verdicts(self) -> dict[str, Verdict]:
        """The features of the mean curves and mean peaks, all stresses together."""
        by_stress = {name: [(sigma, v[name]) for sigma, v in self.verdicts_by_stress.items()] for name in FEATURES[1:]}
        return {"proportional": self._proportional()} | {name: of_all(judged) for name, judged in by_stress.items()}

    @cached_property
    def peak_doubts(self) -> dict[float, str | None]:
        """By stress, why the peak of the mean curve cannot be taken for the strength, if so."""
        return {
            sigma: doubt_of(curve.peak, min(s.reached for s in self.shears[sigma]), self.shears[sigma][0].width)
            for sigma, curve in self.curves.items()
        }

    @cached_property
    def verdicts_by_stress(self) -> dict[float, dict[str, Verdict]]:
        """Those that can be judged at one stress."""
        judged = {}
        for sigma, curve in self.curves.items():
            shears, doubt = self.shears[sigma], self.peak_doubts[sigma]
            steepest = peak_at_steepest(curve.tau_fit, curve.peak, curve.lid_fit)
            judged[sigma] = {
                "dilates": _dilates(shears).in_doubt(doubt),
                "peak_at_steepest_dilatancy": steepest.in_doubt(doubt),
                "quasi_static": _quasi_static([shear.inertia for shear in shears]),
            }
        return judged

    def _proportional(self) -> Verdict:
        """Of the means of the peaks, with the weights of the model: 1 / sigma^2."""
        sigma = np.array(list(self.shears) if self.independent else self.common)
        peaks = np.array([np.mean([shear.peak.value for shear in self.shears[s]]) for s in sigma])
        verdict = proportional(sigma, peaks, fit_line(sigma, peaks, sigma) if len(sigma) > 1 else None)
        return verdict.in_doubt("not all peaks can be judged" if any(self.peak_doubts.values()) else None)


def estimate(values: Sequence[float | None]) -> Estimate | None:
    """Mean over specimens with its interval; None of a single one, or where a value is missing."""
    known = [value for value in values if value is not None]
    return mean_of(np.array(known)) if len(known) == len(values) > 1 else None


def holds_in(run: Results, feature: str) -> bool | None:
    """Whether a feature holds in a specimen, at all its stresses; None: cannot be judged."""
    if feature == "proportional":
        return run.proportional.holds
    return of_all([(shear.sigma, shear.verdicts[feature]) for shear in run.shears]).holds


def _quasi_static(specimens: Sequence[Inertia]) -> Verdict:
    """It holds for an ensemble if it does for each of its specimens; told are their greatest numbers."""
    judged = [one.quasi_static.holds for one in specimens]
    share = f"in {sum(holds is True for holds in judged)} of {len(judged)} specimens"
    holds = None if None in judged and False not in judged else all(judged)
    return Verdict(holds, f"{share}; at most: {greatest(specimens).quasi_static.reason}")


def _dilates(shears: Sequence[Shear]) -> Verdict:
    """Feature 2 on the ensemble: where tau is at its peak the lid's mean is above its start, by the interval of the mean.

    It is open where the interval holds 0. A single specimen is judged by its own curve.
    """
    rise = estimate([float(shear.lid.series(shear.peak.position)) for shear in shears])
    if rise is None:
        return dilates(shears[0].lid, shears[0].peak)
    reason = (
        f"lid at the peak {rise.value:+.3f} mm, 95 % interval of the mean from {told_apart(float(rise.low), 0, 3, '+')} "
        f"to {rise.high:+.3f} mm (all of it > 0)"
    )
    if rise.low <= 0 < rise.high:
        return Verdict(None, reason, "the 95 % interval of the mean holds 0; more specimens would tell")
    return Verdict(bool(rise.low > 0), reason)
