# SPDX-License-Identifier: GPL-2.0-or-later
"""Curves of several specimens at one stress, averaged at equal shear displacements."""

import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .peak import Peak, find_peak
from .polynomial import Fit, fit_curve
from .shear import Shear
from .smoothed import find_smoothed_peak


@dataclass(frozen=True)
class Band:
    """Mean of n specimens (rows,), their standard deviation, and the standard error of the mean; nan if n is 1."""

    mean: np.ndarray
    deviation: np.ndarray
    error: np.ndarray


@dataclass(frozen=True)
class MeanCurve:
    """Displacements in mm (rows,), stress in kPa, the lid's rise in mm."""

    sigma: float
    count: int  # specimens
    displacement: np.ndarray
    tau: Band
    lid: Band

    @cached_property
    def tau_fit(self) -> Fit:
        """Polynomial of the mean stress."""
        return fit_curve(self.displacement, self.tau.mean)

    @cached_property
    def lid_fit(self) -> Fit:
        """That of the lid's mean rise."""
        return fit_curve(self.displacement, self.lid.mean, through_origin=True)

    @cached_property
    def peak(self) -> Peak:
        """Of the polynomial; its errors are those of the fit, without the scatter of specimens."""
        return find_peak(self.tau_fit)

    @cached_property
    def smoothed(self) -> Peak:
        """Of the mean stress smoothed."""
        return find_smoothed_peak(self.displacement, self.tau.mean)


def average(shears: Sequence[Shear]) -> MeanCurve:
    """Specimens at the same stress, each interpolated in its rows at full speed, from where the last of them has reached
    it to where the first ends."""
    curves = [{name: shear.data[name][shear.rows] for name in NAMES} for shear in shears]
    start = max(curve["displacement_mm"][0] for curve in curves)
    end = min(curve["displacement_mm"][-1] for curve in curves)
    s = np.linspace(start, end, min(len(curve["displacement_mm"]) for curve in curves))
    tau, lid = (band_of([np.interp(s, c["displacement_mm"], c[name]) for c in curves]) for name in NAMES[1:])
    return MeanCurve(shears[0].sigma, len(shears), s, tau, lid)


NAMES = ("displacement_mm", "tau_kPa", "lid_mm")


def as_csv(curves: Sequence[MeanCurve]) -> str:
    """One table of all stresses."""
    blocks = []
    for curve in curves:
        bands = [values for band in (curve.tau, curve.lid) for values in (band.mean, band.deviation, band.error)]
        first = [np.full(len(curve.displacement), value) for value in (curve.sigma, curve.count)]
        blocks.append(np.column_stack([*first, curve.displacement, *bands]))
    names = [f"{what}_{part}{unit}" for what, unit in (("tau", "_kPa"), ("lid", "_mm"))
             for part in ("mean", "standard_deviation", "standard_error")]  # fmt: skip
    header = ",".join(["sigma_kPa", "specimens", "displacement_mm", *names])
    text = io.StringIO()
    np.savetxt(text, np.vstack(blocks), fmt="%.8g", delimiter=",", header=header, comments="")
    return text.getvalue()


def band_of(rows: Sequence[np.ndarray] | np.ndarray) -> Band:
    """Of the curves of specimens at the same places."""
    values = np.array(rows)
    count = len(values)
    deviation = values.std(axis=0, ddof=1) if count > 1 else np.full(values.shape[1], np.nan)
    return Band(values.mean(axis=0), deviation, deviation / np.sqrt(count))
