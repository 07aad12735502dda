#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Pours grains of three discs into a box with smooth walls, weighs them by its floor, and draws them."""

import sys
from pathlib import Path

from matplotlib.figure import Figure

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from gallery import discs, draw, folder_of, run, save  # noqa: E402

if __name__ == "__main__":
    folder = folder_of(__file__, __doc__)
    print(next(line for line in run(HERE / "pour.in", folder).splitlines() if line.startswith("floor_N")))
    figure = Figure(figsize=(4.5, 3.6), layout="constrained")
    axes = figure.subplots()
    draw(axes, discs(folder / "discs.dump"), straight=(2, 3))
    axes.set(xlim=(-0.6, 10.6), ylim=(-0.6, 7), title="400 grains of three discs, at rest")
    save(figure, HERE / "pour.png")
