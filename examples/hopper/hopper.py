#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Empties a hopper through openings of several widths: its rate against the law of Beverloo, and a picture."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from scipy.optimize import curve_fit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from gallery import discs, draw, folder_of, run, save, table  # noqa: E402

OPENINGS = (0.02, 0.025, 0.03, 0.035)  # m
GRAIN = 0.0035  # m, mean diameter
G = 9.81  # m/s^2


def rate(folder: Path) -> tuple[float, float]:
    """Grains a second while the first half of them leaves, after 0.2 s; and the same of the second quarter over the first."""
    rows = table(folder / "rate.dat")
    t, left = rows["time_s"], rows["grains"]

    def slope(begin: float, end: float) -> float:
        part = (t >= begin) & (t <= end)
        return float(np.polyfit(t[part], left[part], 1)[0])

    end = min(t[-1], float(t[np.argmax(left > 750)]) or t[-1])
    middle = (0.2 + end) / 2
    return slope(0.2, end), slope(middle, end) / slope(0.2, middle)


def beverloo(opening: np.ndarray, c: float, k: float) -> np.ndarray:
    """Areas of grains a second, over d^2: c sqrt(g) (D - k d)^1.5."""
    return c * np.sqrt(G) * np.maximum(opening - k * GRAIN, 0) ** 1.5


if __name__ == "__main__":
    folder = folder_of(__file__, __doc__)
    area = np.pi / 4 * np.mean(np.linspace(3e-3, 4e-3, 101) ** 2)  # of a grain
    flows = []
    for opening in OPENINGS:
        run(HERE / "hopper.in", folder / f"{opening:g}", opening=opening)
        grains, later = rate(folder / f"{opening:g}")
        flows.append(area * grains)
        print(f"D = {1000 * opening:g} mm: {grains:.0f} grains/s, {later:.2f} times as many later on as at first")
    (c, k), _ = curve_fit(beverloo, np.array(OPENINGS), flows, p0=(0.6, 1.5))
    off = np.array(flows) / beverloo(np.array(OPENINGS), c, k) - 1
    print(f"C rho = {c:.2f}, k = {k:.2f}: off by {100 * np.max(np.abs(off)):.1f} % at most")
    figure = Figure(figsize=(7, 4), layout="constrained")
    picture, diagram = figure.subplots(1, 2)
    draw(picture, discs(folder / "0.03" / "discs.dump", 1), straight=(2, 3, 4))
    picture.set(xlim=(-1, 11), ylim=(-8, 10), title="D = 30 mm, after 0.6 s")
    d = np.linspace(k * GRAIN, 0.04, 100)
    diagram.plot(1000 * np.array(OPENINGS), 1e4 * np.array(flows), "o", label="measured")
    diagram.plot(1000 * d, 1e4 * beverloo(d, c, k), "-", label=f"{c:.2f} √g (D − {k:.1f} d)^1.5")
    diagram.set(xlabel="opening D (mm)", ylabel="area of grains a second (cm²/s)", xlim=(0, 40), ylim=(0, None))
    diagram.grid(alpha=0.3)
    diagram.legend()
    save(figure, HERE / "hopper.png")
