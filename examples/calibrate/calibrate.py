#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Finds the friction angle between grains with which a specimen has a wanted friction angle, by root finding of scipy.

Specimens scatter, so the function is rough: the same packings are taken for all values, and the answer is told to a degree. A
quarter of an hour on two cores. Interrupted, the same command goes on: values that were tried are not tried again.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import matplotlib
import numpy as np
from scipy.optimize import brentq

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import shearbox  # noqa: E402

MODEL = "TypeA_10x5_4-8_1-circle_350"
BETWEEN = (5.0, 45.0)  # degrees, of the friction angle between grains


def strength(friction: float, options: argparse.Namespace) -> float:
    """Mean friction angle (degrees) of the specimens, by the stresses on the shear plane."""
    friction = round(friction, 2)  # also the name of its folder
    tests = shearbox.run(
        MODEL, options.out / f"{friction:g}", seeds=options.seeds, speed=options.speed, set={"phi": friction}
    )
    angles = [test.phi_plane_deg for test in tests if test.phi_plane_deg is not None]
    print(f"φ_μ = {friction:5.2f}°: φ = {np.mean(angles):.1f}°, of {np.round(angles, 1)}", flush=True)
    return float(np.mean(angles))


def main() -> None:
    """Finds it, and draws what was tried."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--target", type=float, default=27, help="wanted friction angle, degrees (default: 27)")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3, 4], help="packings (default: 1 2 3 4)")
    parser.add_argument("--speed", type=float, default=100, help="shear speed, mm/s (default: 100)")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "calibrate", help="default: results/calibrate")
    options = parser.parse_args()
    tried: dict[float, float] = {}

    def misses(friction: float) -> float:
        tried[friction] = strength(friction, options)
        return tried[friction] - options.target

    low, high = (misses(end) + options.target for end in BETWEEN)
    if not low < options.target < high:
        raise ValueError(
            f"--target {options.target:g}: between {low:.1f} and {high:.1f}° are reached, by φ_μ from {BETWEEN[0]:g} to {BETWEEN[1]:g}°"
        )
    found = brentq(misses, *BETWEEN, xtol=1.0)
    print(f"φ_μ = {found:.0f}° gives φ = {options.target:g}°")
    figure, axes = plt.subplots(figsize=(4.4, 3.4), layout="constrained")
    axes.plot(*zip(*sorted(tried.items())), "o", color="#1f4fd8", mfc="none")
    axes.axhline(options.target, color="#8a929b", lw=0.8)
    axes.axvline(found, color="#8a929b", lw=0.8, ls="--")
    axes.set(xlabel="friction angle between grains φ_μ (°)", ylabel="friction angle φ on the shear plane (°)")
    figure.savefig(options.out / "calibrate.svg", metadata={"Date": None})


if __name__ == "__main__":
    try:
        main()
    except (shearbox.Error, ValueError) as error:
        sys.exit(f"calibrate: {error}")
    except KeyboardInterrupt:
        sys.exit("interrupted: the same command goes on from here")
