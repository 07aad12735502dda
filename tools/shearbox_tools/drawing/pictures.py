# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of specimens: discs to scale, coloured by what they turned since the start, and the chains of force.

All pictures of a report have the same scales: of colours, and of line widths as forces over the normal stress.
"""

from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.colors import Normalize, to_rgba

from ..analysis.moments import Film, Moment
from .canvas import STRIP, Canvas, colour_scale, draw_key, round_down
from .style import RC, as_uri

DPI = 200
WALL_COLOUR = "#c9ced4"
OUTLINE_COLOUR = "#4a525a"
FORCE_COLOUR = "#7a1022"
OUTLINE = 0.05  # of a disc's radius
WIDEST_LINE = 6.0  # points
ROTATIONS = colormaps["RdBu_r"]
ROTATION_TITLE = "rotation since the start (°, anticlockwise +)"
ASIDE = 0.1  # shown beside the grains, of their width; the flanges go on


@dataclass(frozen=True)
class Stills:
    """A specimen before shear, in the frame that is nearest to the peak of the shear stress, and at the end."""

    before: Moment
    peak: Moment
    end: Moment

    @classmethod
    def of(cls, film: Film, peak: float) -> "Stills":
        """The frames of a film; peak in mm of displacement."""
        return cls(film.first(), film.at(peak), film.last())

    @property
    def moments(self) -> dict[str, Moment]:
        """By name, in order."""
        return {"before": self.before, "peak": self.peak, "end": self.end}


def draw_specimens(specimens: dict[float, Stills]) -> dict[str, str]:
    """WebP pictures as data: URIs, of specimens by their normal stress (kPa); an SVG 'rotation scale' for all of them.

    Their names are '100 peak rotation', '100 peak forces' and so on.
    """
    if not specimens:
        return {}
    turned = Normalize(-(limit := _largest_rotation(specimens)), limit)
    per_stress = max(_largest_force(stills) / sigma for sigma, stills in specimens.items())
    with rc_context(RC):
        pictures = {"rotation scale": as_uri(colour_scale(turned, ROTATIONS, ROTATION_TITLE))}
        for sigma, stills in specimens.items():
            canvas = Canvas(*extent(list(stills.moments.values())), DPI)
            for name, moment in stills.moments.items():
                rotation = np.degrees(moment.rotation_since(stills.before))
                draw_discs(canvas.axes, moment, ROTATIONS(turned(rotation)))
                pictures[f"{sigma:g} {name} rotation"] = canvas.take()
                draw_chains(canvas.axes, moment, sigma * per_stress)
                pictures[f"{sigma:g} {name} forces"] = canvas.take()
    return pictures


def _largest_rotation(specimens: dict[float, Stills]) -> float:
    """Degrees, of nearly all grains."""
    turned = [np.abs(s.end.rotation_since(s.before)[~s.end.walls]) for s in specimens.values()]
    return max(1.0, float(np.degrees(np.quantile(np.concatenate(turned), 0.98))))


def _largest_force(stills: Stills) -> float:
    return max(float(np.max(moment.contacts["fn"], initial=1e-9)) for moment in stills.moments.values())


def draw_chains(axes: Axes, moment: Moment, widest: float) -> None:
    """A line from grain to grain through their contact, as wide as its normal force is great, over faint discs.

    widest: force (N) of the widest line.
    """
    draw_discs(axes, moment, np.tile(_rgba("#f1f3f5"), (len(moment.discs["id"]), 1)), outline="#d5dade")
    widths = WIDEST_LINE * np.clip(moment.contacts["fn"], 0, None) / widest
    lines = list(moment.branches())
    style = {"colors": FORCE_COLOUR, "capstyle": "round", "joinstyle": "round"}
    axes.add_collection(LineCollection(lines, linewidths=widths, **style))
    key = round_down(widest / 2)
    draw_key(axes, (0.65, 0.73), f"{key:g} N", lw=WIDEST_LINE * key / widest, color=FORCE_COLOUR)


def extent(moments: list[Moment]) -> tuple[np.ndarray, np.ndarray]:
    """(2,) lowest and highest corner of a picture, m: box and strip; of the walls above the lid a little only."""
    x, y, radius = (np.concatenate([m.discs[name] for m in moments]) for name in ("x", "y", "radius"))
    walls = np.concatenate([m.walls for m in moments])
    left, right = np.min((x - radius)[~walls]), np.max((x + radius)[~walls])
    aside = ASIDE * (right - left)
    top = np.max((y + radius)[~walls]) + 4 * radius[walls].max()
    low = np.array([left - aside, np.min(y - radius) - STRIP * (right - left + 2 * aside)])
    return low, np.array([right + aside, min(top, np.max(y + radius))])


def draw_discs(axes: Axes, moment: Moment, colours: np.ndarray, outline: str = OUTLINE_COLOUR) -> None:
    """Discs in their colours (discs, 4), those of walls in grey. Grain after grain, first all its discs in the outline's colour, then smaller ones: a grain has one outline.

    A wall of two discs is a piece of a smooth wall: what lies between them is of it, too.
    """
    discs = moment.discs
    axes.add_collection(PolyCollection(_between(moment, 1), facecolors=outline, linewidths=0, zorder=1))
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
    axes.add_collection(
        PolyCollection(_between(moment, 1 - 2 * OUTLINE), facecolors=WALL_COLOUR, linewidths=0, zorder=3)
    )


def _between(moment: Moment, share: float) -> np.ndarray:
    """(pieces, 4, 2) corners of the rectangles between the discs of pieces of smooth walls, as wide as `share` of them, m."""
    discs = moment.discs
    ids, count = np.unique(discs["id"][moment.walls], return_counts=True)
    ends = np.flatnonzero(np.isin(discs["id"], ids[count == 2]))
    first, second = ends[np.argsort(discs["id"][ends], kind="stable")].reshape(-1, 2).T
    a, b = (np.column_stack([discs["x"][k], discs["y"][k]]) for k in (first, second))
    along = b - a
    across = np.column_stack([-along[:, 1], along[:, 0]]) / np.hypot(*along.T)[:, None]
    aside = share * discs["radius"][first][:, None] * across
    return np.stack([a + aside, b + aside, b - aside, a - aside], axis=1)


def _rgba(colour: str) -> np.ndarray:
    return np.array(to_rgba(colour))
