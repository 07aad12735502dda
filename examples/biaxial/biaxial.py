#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Biaxial test at three stresses: friction angle from the peaks, stresses inside against those on the walls, a picture."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from gallery import discs, draw, folder_of, run, save, table  # noqa: E402

STRESSES = {100: ("blue", "-"), 200: ("red", "--"), 300: ("green", "-.")}  # kPa

if __name__ == "__main__":
    folder = folder_of(__file__, __doc__)
    figure = Figure(figsize=(9, 3.8), layout="constrained")
    picture, ratio, volume = figure.subplots(1, 3)
    for sigma, (colour, line) in STRESSES.items():
        run(HERE / "biaxial.in", folder / f"{sigma}", confining=sigma)
        rows = table(folder / f"{sigma}" / "biaxial.dat")
        vertical, sideways = (rows["top_kPa"] + rows["floor_kPa"]) / 2, (rows["right_kPa"] + rows["left_kPa"]) / 2
        inside = np.max(np.abs(np.array([rows["yy_kPa"] / vertical, rows["xx_kPa"] / sideways]) - 1))
        smooth = np.convolve(vertical / sideways, np.ones(9) / 9, "valid")
        angle = np.degrees(np.arcsin((smooth.max() - 1) / (smooth.max() + 1)))
        print(
            f"{sigma} kPa: greatest ratio {smooth.max():.2f}, {angle:.1f} degrees; inside and on the walls the same"
            f" within {100 * inside:.2f} %"
        )
        ratio.plot(rows["strain_y_percent"], vertical / sideways, line, color=colour, lw=1, label=f"{sigma} kPa")
        volume.plot(rows["strain_y_percent"], -rows["strain_v_percent"], line, color=colour, lw=1)
    ratio.set(xlabel="vertical strain (%)", ylabel="σ₁/σ₃", ylim=(1, None))
    volume.set(xlabel="vertical strain (%)", ylabel="rise of volume (%)")
    ratio.legend()
    draw(picture, discs(folder / "100" / "discs.dump"), straight=(2, 3))
    picture.set(title="100 kPa, at the end")
    picture.autoscale_view()
    save(figure, HERE / "biaxial.png")
