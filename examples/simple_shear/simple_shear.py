#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Simple shear of a dense and a loose layer, drained and undrained, and against a spring: stress paths and a picture."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from gallery import Columns, discs, draw, folder_of, run, save, table  # noqa: E402

CASES = {  # boundary, friction angle of packing: label, colour, line
    ("stress", 0): ("dense, drained", "blue", "-"),
    ("volume", 0): ("dense, undrained", "red", "--"),
    ("stiffness", 0): ("dense, against a spring", "green", "-."),
    ("stress", 27): ("loose, drained", "black", ":"),
    ("volume", 27): ("loose, undrained", "orange", (0, (5, 1))),
}


def late_ratio(rows: Columns) -> float:
    """Mean τ over mean σ on the lid in the second half of shear."""
    late = rows["strain"] > rows["strain"][-1] / 2
    return float(np.mean(rows["tau_lid_kPa"][late]) / np.mean(rows["sigma_lid_kPa"][late]))


if __name__ == "__main__":
    folder = folder_of(__file__, __doc__)
    figure = Figure(figsize=(10, 4.2), layout="constrained")
    picture, curves, path = figure.subplots(1, 3)
    for (boundary, packed), (label, colour, line) in CASES.items():
        run(HERE / "simple_shear.in", folder, boundary=boundary, phi_packing=packed)
        rows = table(folder / f"{boundary}_{packed}.dat")
        sigma, tau, height = rows["sigma_lid_kPa"], rows["tau_lid_kPa"], rows["height_mm"]
        print(
            f"{label}: σ from {sigma[0]:.0f} to {sigma[-20:].mean():.0f} kPa, height from {height[0]:.3f} to "
            f"{height[-1]:.3f} mm, τ/σ in the second half {late_ratio(rows):.3f}"
        )
        bears = sigma > 5  # kPa; below, a layer is a liquid, and τ/σ the ratio of two small numbers
        curves.plot(
            rows["strain"], np.where(bears, tau / sigma, np.nan), linestyle=line, color=colour, lw=1, label=label
        )
        path.loglog(sigma[bears], tau[bears], linestyle=line, color=colour, lw=1)
        if (boundary, packed) == ("stress", 0):
            draw(picture, discs(folder / "discs.dump"))
    picture.set(title="dense, drained, at the end")
    picture.autoscale_view()
    curves.set(xlabel="shear strain", ylabel="τ/σ on the lid", ylim=(0, 0.7))
    curves.legend(fontsize=7)
    path.set(xlabel="σ on the lid (kPa)", ylabel="τ (kPa)")
    save(figure, HERE / "simple_shear.png")
