# SPDX-License-Identifier: GPL-2.0-or-later
"""Synthetic runs that differ in their seeds, and specimens made of one run."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import synthetic

from shearbox_tools.analysis.results import Results
from shearbox_tools.asking.models import find_model
from shearbox_tools.asking.request import Request

REQUEST = Request(find_model("TypeA_10x5_4-8_1-circle_350"), (100.0, 200.0, 300.0))
ROWS, TRAVEL = 800, 8.0
FACTORS = {1: 0.9, 2: 1.0, 3: 1.2}  # of tau, by seed


def write_run(folder: Path, request: Request, factor: float = 1.0, rows: int = ROWS, lid: float = 1.0) -> Path:
    """Smooth curves: tau is `factor` times that of `base`, the lid rises `lid` times as much as there."""
    synthetic.write_record(folder, request)
    for sigma in request.stresses:
        place = folder / f"{sigma:g}"
        place.mkdir()
        columns = base(sigma)
        columns["tau_kPa"] = factor * columns["tau_kPa"]
        columns["lid_mm"] = lid * columns["lid_mm"]
        synthetic.write_shear(place / "shear.dat", columns, slice(0, rows))
    return folder


def base(sigma: float) -> dict[str, np.ndarray]:
    """Peak 0.5 sigma + 5 kPa at 2.5 mm, without noise; the lid follows the stress, and rises steepest just before."""
    columns = synthetic.curves(sigma, TRAVEL, ROWS)
    s = columns["displacement_mm"]
    tau = synthetic.softening(s, 0.5 * sigma + 5, 2.5, 0.3 * sigma)
    return columns | {
        "tau_kPa": tau,
        "tau_upper_kPa": tau,
        "lid_mm": 0.5 / (1 + np.exp(-(s - 2) / 0.5)) - 0.5 / (1 + np.exp(4)),
    }


def only(run: Results, *stresses: float) -> Results:
    return replace(run, stresses=list(stresses), shears=[s for s in run.shears if s.sigma in stresses])


def specimens(base: Results, seeds: list[int], shift: float = 0.0) -> list[Results]:
    """Peaks c + s sigma with scatter of their own, and TRM at the end, by seed; the same packing for a seed."""
    runs = []
    for seed in seeds:
        rng = np.random.default_rng(seed + int(1e6 * shift))
        packed = np.random.default_rng(seed).normal(size=3)  # what specimens of a packing have in common
        c, slope = 5 + packed[0], 0.6 + 0.05 * packed[1] + shift + 0.01 * rng.normal()
        trm = 0.5 + 0.1 * packed[2] + shift + 0.02 * rng.normal()
        shears = [
            replace(
                shear,
                peak=replace(shear.peak, value=c + slope * shear.sigma + rng.normal()),
                data=shear.data | {"trm": np.full(len(shear.data["trm"]), trm)},
            )
            for shear in base.shears
        ]
        packing = synthetic.bed() | {"kinetic_J": 1e-12 * seed}
        runs.append(replace(base, identity=base.identity | {"seed": seed}, shears=shears, packing=packing))
    return runs
