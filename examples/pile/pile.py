#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of several heights and two sizes spread into piles: how far they run, and a picture."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from gallery import Columns, discs, draw, folder_of, run, save  # noqa: E402

ASPECTS = (0.5, 1.0, 1.5)
SMALL, LARGE = 0.04, 0.06  # m, half of the width of the column


def height(of: Columns) -> float:
    """Of the column (m): mean of the highest grains in strips of 6 mm."""
    grain = of["type"] == 1
    x, top = of["x"][grain], (of["y"] + of["radius"])[grain]
    strips = np.floor(x / 0.006)
    return float(np.mean([np.max(top[strips == strip]) for strip in np.unique(strips)]))


def reach(of: Columns) -> float:
    """Half of the width of the pile (m): the grains that hang together, over gaps of less than a tenth of a grain."""
    grain = of["type"] == 1
    place, radius = np.column_stack([of["x"], of["y"]])[grain], of["radius"][grain]
    pairs = cKDTree(place).query_pairs(2.1 * np.max(radius), output_type="ndarray")
    gap = np.hypot(*(place[pairs[:, 0]] - place[pairs[:, 1]]).T) - radius[pairs].sum(axis=1)
    pairs = pairs[gap < 0.2 * np.mean(radius)]
    links = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(place), len(place)))
    _, member = connected_components(links, directed=False)
    pile = member == np.argmax(np.bincount(member))
    return float(np.ptp(place[pile, 0]) / 2)


def spread(folder: Path, aspect: float, half: float) -> tuple[float, float, Columns]:
    """Aspect ratio of the column that stood, how far it ran over half its width, and the discs of the pile."""
    run(HERE / "pile.in", folder, aspect=aspect, half=half)
    column, pile = (discs(folder / "discs.dump", frame) for frame in (0, 1))
    return height(column) / half, reach(pile) / half - 1, pile


if __name__ == "__main__":
    folder = folder_of(__file__, __doc__)
    figure = Figure(figsize=(7, 5), layout="constrained")
    rows = figure.subplots(len(ASPECTS), sharex=True)
    for aspect, axes in zip(ASPECTS, rows, strict=True):
        for half in (SMALL, LARGE):
            a, ran, pile = spread(folder / f"{aspect:g}_{half:g}", aspect, half)
            print(f"a = {a:.2f}, {200 * half:g} cm wide: ran {ran:.2f} half widths, {ran / a:.2f} a")
        draw(axes, pile)  # the gates are gone
        axes.set(xlim=(-24, 24), ylim=(-0.5, 9.5), title=f"a = {a:.2f}: the pile of a column {200 * LARGE:g} cm wide")
        axes.plot(100 * LARGE * np.array([-1, -1, 1, 1]), 100 * LARGE * np.array([0, a, a, 0]), "k--", lw=1)
        axes.label_outer()
    save(figure, HERE / "pile.png")
