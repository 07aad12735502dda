# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of the specimen: discs to scale, coloured by what they turned since the start, and the chains of force."""

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import Normalize, to_rgba
from matplotlib.figure import Figure

from .specimen import Film, Moment
from .style import RC, as_uri

WALL_COLOUR = "#c9ced4"
OUTLINE_COLOUR = "#4a525a"
OUTLINE = 0.05  # of a disc's radius
WIDEST_LINE = 4.5  # points
ROTATIONS = colormaps["RdBu_r"]
PANEL_HEIGHT = 3.0  # inches


def draw_specimen(film: Film, peak: float) -> str:
    """Before shear, at its end, and the forces at the peak (displacement in mm), as a PNG in a data: URI."""
    first, last, loaded = film.first(), film.last(), film.at(peak)
    with rc_context(RC):
        return as_uri(_figure(first, last, loaded), "png")


def _figure(first: Moment, last: Moment, loaded: Moment) -> Figure:
    low, high = _extent([first, last])
    width = PANEL_HEIGHT * (high[0] - low[0]) / (high[1] - low[1])
    figure = Figure(figsize=(3 * width + 0.9, PANEL_HEIGHT + 0.4), layout="constrained")
    panels = figure.subplots(1, 3)
    rotation = np.degrees(last.rotation_since(first))
    limit = max(1.0, float(np.quantile(np.abs(rotation[~last.walls]), 0.98)))
    scale = Normalize(-limit, limit)
    _draw_discs(panels[0], first, ROTATIONS(scale(np.zeros(len(first.walls)))))
    _draw_discs(panels[1], last, ROTATIONS(scale(rotation)))
    panels[0].set_title("before shear")
    panels[1].set_title(f"after {last.displacement:.1f} mm")
    _draw_forces(panels[2], loaded)
    for axes in panels:
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        axes.axis("off")
    bar = figure.colorbar(ScalarMappable(scale, ROTATIONS), ax=panels[1], shrink=0.8, pad=0.01, extend="both")
    bar.set_label("rotation (°, anticlockwise +)")
    bar.outline.set_visible(False)
    return figure


def _extent(moments: list[Moment]) -> tuple[np.ndarray, np.ndarray]:
    """(2,) lowest and highest corner of what is shown, m: all discs, but of the walls above the lid a little only."""
    x, y, radius = (np.concatenate([m.discs[name] for m in moments]) for name in ("x", "y", "radius"))
    walls = np.concatenate([m.walls for m in moments])
    top = np.max((y + radius)[~walls]) + 4 * radius[walls].max()
    low = np.array([np.min(x - radius), np.min(y - radius)])
    return low, np.array([np.max(x + radius), min(top, np.max(y + radius))])


def _draw_discs(axes: Axes, moment: Moment, colours: np.ndarray, outline: str = OUTLINE_COLOUR) -> None:
    """Grain after grain, first all its discs in the outline's colour, then smaller ones: a grain has one outline."""
    discs = moment.discs
    order = np.lexsort((discs["disc"], discs["id"]))
    same = np.cumsum(np.diff(discs["id"][order], prepend=-1) != 0)  # number of the grain
    layers = np.concatenate([2 * same, 2 * same + 1])
    drawn = np.argsort(layers, kind="stable")
    rows = np.concatenate([order, order])[drawn]
    inner = (layers[drawn] % 2).astype(bool)
    faces = np.where(moment.walls[:, None], _rgba(WALL_COLOUR), colours)[rows]
    faces[~inner] = _rgba(outline)
    size = 2 * discs["radius"][rows] * np.where(inner, 1 - 2 * OUTLINE, 1)
    axes.add_collection(
        EllipseCollection(
            size, size, np.zeros_like(size), units="xy", linewidths=0, facecolors=faces,
            offsets=np.column_stack([discs["x"][rows], discs["y"][rows]]), offset_transform=axes.transData,
        )
    )  # fmt: skip


def _draw_forces(axes: Axes, moment: Moment) -> None:
    """A line from grain to grain through their contact, as wide as its normal force is great, over faint discs."""
    faint = np.tile(_rgba("#f1f3f5"), (len(moment.discs["id"]), 1))
    _draw_discs(axes, moment, faint, outline="#d5dade")
    force = np.clip(moment.contacts["fn"], 0, None)
    axes.set_title(f"normal forces at the peak, {moment.displacement:.1f} mm")
    if not len(force):
        return
    greatest = float(force.max())
    axes.add_collection(
        LineCollection(
            list(moment.branches()),
            linewidths=WIDEST_LINE * force / greatest,
            colors="#7a1022",
            capstyle="round",
            joinstyle="round",
        )
    )
    axes.text(0.5, -0.01, f"widest line: {greatest:.0f} N", transform=axes.transAxes, ha="center", va="top", fontsize=8)


def _rgba(colour: str) -> np.ndarray:
    return np.array(to_rgba(colour))
