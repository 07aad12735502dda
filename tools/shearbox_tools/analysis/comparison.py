# SPDX-License-Identifier: GPL-2.0-or-later
"""Ensembles side by side: their means at the stresses that all have, and how far these are from those of the first."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .differences import Difference, Mean, difference, mean, mean_angle, mean_strength
from .ensemble import lines_of, strength_of_independent
from .ensemble_results import Ensemble
from .peak import steepest
from .results import Results
from .shear import Shear

PAIRED = "paired by packing"
PAIRED_TESTS = "paired by packing, but for φ and c (Welch)"  # each test has its own packing, and a line many of them
WELCH = "Welch"
SOME_SHARED = "Welch, though some packings are the same"
ALONE = "one specimen, so no interval"


@dataclass(frozen=True)
class Quantity:
    """What is compared; means and differences are in order of the ensembles, None where they cannot be told."""

    name: str  # in files
    title: str
    unit: str
    digits: int
    sigma: float | None  # kPa; None: of all stresses
    means: Sequence[Mean | None]
    differences: Sequence[Difference | None]  # to the first, whose own is None


@dataclass(frozen=True)
class Measure:
    """A number of each test."""

    name: str
    title: str
    unit: str
    digits: int
    value: Callable[[Shear], float]


STRENGTHS = {"lid": ("", ""), "plane": ("_plane", " by the shear plane"), "smoothed": ("_smoothed", " smoothed")}
OVER_STRESSES = [
    Measure("dilation_at_peak_deg", "dilation angle ψ at the peak", "°", 1, lambda shear: shear.at_peak.dilation_deg),
    Measure("trm", "TRM at the end", "–", 3, lambda shear: float(shear.data["trm"][-1])),
]
BY_STRESS = [
    Measure("ratio_at_peak", "peak τ/σ", "–", 3, lambda shear: shear.at_peak.ratio),
    Measure("ratio_at_end", "τ/σ at the end", "–", 3, lambda shear: shear.at_end.ratio),
    *OVER_STRESSES,
    Measure("steepest_dilatancy", "steepest dilatancy", "mm/mm", 3, lambda shear: steepest(shear.lid)[1]),
    Measure("lid_highest_mm", "highest lid", "mm", 2, lambda shear: shear.lid_highest),
]


@dataclass(frozen=True)
class Comparison:
    """At least two ensembles."""

    every: Sequence[Ensemble]  # with all their stresses

    @cached_property
    def stresses(self) -> list[float]:
        """kPa: those that all specimens of all ensembles have; of independent packings those of any specimen."""
        there = [set(e.shears if e.independent else e.common) for e in self.every]
        return sorted(set.intersection(*there))

    @cached_property
    def ensembles(self) -> list[Ensemble]:
        """With these stresses only, their specimens in order of the seeds."""
        return [Ensemble(_in_order(ensemble.specimens, self.stresses)) for ensemble in self.every]

    @cached_property
    def methods(self) -> list[str | None]:
        """How the differences of each to the first are told: None of the first."""
        first, *others = self.ensembles
        return [None, *(_method(first, other) for other in others)]

    @cached_property
    def quantities(self) -> list[Quantity]:
        """Strength, and means over the stresses; then by stress."""
        if not self.stresses:
            return []
        found = []
        for by, (ending, words) in STRENGTHS.items():
            lines = [_strength(ensemble, by) for ensemble in self.ensembles]
            found.append(self._compare(f"phi{ending}_deg", f"φ{words}", "°", 1, [phi for phi, _ in lines]))
            found.append(self._compare(f"c{ending}_kPa", f"c{words}", "kPa", 1, [c for _, c in lines]))
        ends = [mean_angle(_of_specimens(e, lambda shear: shear.at_end.ratio)) for e in self.ensembles]
        found.append(self._compare("phi_ultimate_deg", "ultimate angle", "°", 1, ends))
        for m in OVER_STRESSES:
            means = [mean(_of_specimens(e, m.value)) for e in self.ensembles]
            found.append(self._compare(m.name, m.title, m.unit, m.digits, means))
        for m in BY_STRESS:
            for sigma in self.stresses:
                means = [mean(np.array([m.value(shear) for shear in e.shears[sigma]])) for e in self.ensembles]
                found.append(self._compare(m.name, m.title, m.unit, m.digits, means, sigma))
        return [quantity for quantity in found if any(quantity.means)]

    def _compare(
        self, name: str, title: str, unit: str, digits: int, means: Sequence[Mean | None], sigma: float | None = None
    ) -> Quantity:
        first = means[0]
        differences = [
            difference(first, other, method in (PAIRED, PAIRED_TESTS)) if first and other and method else None
            for other, method in zip(means, self.methods)
        ]
        return Quantity(name, title, unit, digits, sigma, means, differences)


def _method(first: Ensemble, other: Ensemble) -> str:
    if min(first.count, other.count) < 2:
        return ALONE
    if same_packings(first, other):
        return PAIRED_TESTS if first.independent else PAIRED
    return SOME_SHARED if _shared_seeds(first, other) else WELCH


def same_packings(one: Ensemble, other: Ensemble) -> bool:
    """Whether both have the same specimens before consolidation, for the same stresses, so that they differ in how these were
    sheared."""
    stresses, others = (
        {run.identity["seed"]: [s.sigma for s in run.shears] for run in e.specimens} for e in (one, other)
    )
    return stresses == others and len(_shared_seeds(one, other)) == one.count


def _shared_seeds(one: Ensemble, other: Ensemble) -> set[int]:
    """Of packings that are in both: equal seeds, and equal tables, whose digits no other model, setting or version has."""
    packings, others = ({run.identity["seed"]: run.packing for run in e.specimens} for e in (one, other))
    return {seed for seed, packing in packings.items() if packing and packing == others.get(seed)}


def _in_order(specimens: Sequence[Results], stresses: Sequence[float]) -> list[Results]:
    runs = [
        replace(
            run,
            stresses=[s for s in run.stresses if s in stresses],
            shears=[s for s in run.shears if s.sigma in stresses],
        )
        for run in specimens
    ]
    return sorted((run for run in runs if run.shears), key=lambda run: str(run.identity["seed"]))


def _strength(ensemble: Ensemble, by: str) -> tuple[Mean | None, Mean | None]:
    """phi and c; also of one specimen, whose line is made as those of an ensemble are."""
    if ensemble.line_doubts or (by == "plane" and not ensemble.judges_plane):
        return None, None
    sigma, tau = ensemble.peaks(by)
    if not ensemble.independent:
        slopes, cohesions = lines_of(sigma, tau)
        return mean_angle(slopes), mean(cohesions)
    return mean_strength(strength_of_independent(sigma, tau), len(sigma) - 2)


def _of_specimens(ensemble: Ensemble, value: Callable[[Shear], float]) -> np.ndarray:
    """(specimens,) means over the stresses of each."""
    return np.array([np.mean([value(shear) for shear in run.shears]) for run in ensemble.specimens])
