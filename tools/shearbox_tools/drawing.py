# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of specimens: discs to scale, coloured by what they turned since the start, and the chains of force.

All pictures of a report have the same scales: of colours, and of line widths as forces over the normal stress.
"""

from dataclasses import dataclass

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
FORCE_COLOUR = "#7a1022"
INK = "#23282e"
OUTLINE = 0.05  # of a disc's radius
WIDEST_LINE = 6.0  # points
ROTATIONS = colormaps["RdBu_r"]
PICTURE_WIDTH = 4.2  # inches
ASIDE = 0.1  # shown beside the grains, of their width; the flanges go on
STRIP = 0.1  # height of the strip with scale and arrow, of the picture's width
STRIP_FONT = 12  # points
SCALE_WIDTH = 3.6  # of the scale of colours, inches


@dataclass(frozen=True)
class Stills:
    """A specimen before shear, at the peak of the shear stress, and at the end."""

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
        pictures = {"rotation scale": as_uri(_rotation_scale(turned), "svg")}
        for sigma, stills in specimens.items():
            for name, moment in stills.moments.items():
                for kind, picture in (
                    ("rotation", _rotation(stills, moment, turned)),
                    ("forces", _forces(stills, moment, sigma * per_stress)),
                ):
                    pictures[f"{sigma:g} {name} {kind}"] = as_uri(picture, "webp")
    return pictures


def _largest_rotation(specimens: dict[float, Stills]) -> float:
    """Degrees, of nearly all grains."""
    turned = [np.abs(s.end.rotation_since(s.before)[~s.end.walls]) for s in specimens.values()]
    return max(1.0, float(np.degrees(np.quantile(np.concatenate(turned), 0.98))))


def _largest_force(stills: Stills) -> float:
    return max(float(np.max(moment.contacts["fn"], initial=1e-9)) for moment in stills.moments.values())


def _rotation(stills: Stills, moment: Moment, turned: Normalize) -> Figure:
    figure, axes = _picture(stills)
    rotation = np.degrees(moment.rotation_since(stills.before))
    _draw_discs(axes, moment, ROTATIONS(turned(rotation)))
    return figure


def _forces(stills: Stills, moment: Moment, widest: float) -> Figure:
    """A line from grain to grain through their contact, as wide as its normal force is great, over faint discs.

    widest: force (N) of the widest line.
    """
    figure, axes = _picture(stills)
    _draw_discs(axes, moment, np.tile(_rgba("#f1f3f5"), (len(moment.discs["id"]), 1)), outline="#d5dade")
    widths = WIDEST_LINE * np.clip(moment.contacts["fn"], 0, None) / widest
    lines = list(moment.branches())
    style = {"colors": FORCE_COLOUR, "capstyle": "round", "joinstyle": "round"}
    axes.add_collection(LineCollection(lines, linewidths=widths, **style))
    key = _round_down(widest / 2)
    _draw_key(axes, (0.7, 0.78), f"{key:g} N", lw=WIDEST_LINE * key / widest, color=FORCE_COLOUR)
    return figure


def _picture(stills: Stills) -> tuple[Figure, Axes]:
    """An empty picture of all moments' extent, with scale bar and arrow of shear."""
    low, high = _extent(list(stills.moments.values()))
    width, height = high - low
    figure = Figure(figsize=(PICTURE_WIDTH, PICTURE_WIDTH * height / width))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    axes.axis("off")
    bar = _round_down(1000 * width / 5)
    _draw_key(axes, (0.02, 0.02 + bar / (1000 * width)), f"{bar:g} mm", lw=2.5, color=INK, capstyle="butt")
    middle = STRIP * width / height / 2
    axes.annotate(
        "shear", (0.66, middle), (0.45, middle), xycoords="axes fraction", va="center", fontsize=STRIP_FONT, color=INK,
        arrowprops={"arrowstyle": "-|>", "lw": 1.8, "color": INK, "mutation_scale": 16},
    )  # fmt: skip
    return figure, axes


def _draw_key(axes: Axes, ends: tuple[float, float], text: str, lw: float, color: str, capstyle: str = "round") -> None:
    """A piece of a line in the strip, between fractions of its length, and to its right what it stands for."""
    x, y = np.array(axes.get_xlim()), np.array(axes.get_ylim())
    middle = STRIP / 2 * np.ptp(x) / np.ptp(y)
    axes.plot(ends, [middle] * 2, transform=axes.transAxes, lw=lw, color=color, solid_capstyle=capstyle)
    axes.annotate(
        text, (ends[1], middle), (6, 0), "axes fraction", "offset points", va="center", fontsize=STRIP_FONT, color=INK
    )


def _extent(moments: list[Moment]) -> tuple[np.ndarray, np.ndarray]:
    """(2,) lowest and highest corner of a picture, m: box and strip; of the walls above the lid a little only."""
    x, y, radius = (np.concatenate([m.discs[name] for m in moments]) for name in ("x", "y", "radius"))
    walls = np.concatenate([m.walls for m in moments])
    left, right = np.min((x - radius)[~walls]), np.max((x + radius)[~walls])
    aside = ASIDE * (right - left)
    top = np.max((y + radius)[~walls]) + 4 * radius[walls].max()
    low = np.array([left - aside, np.min(y - radius) - STRIP * (right - left + 2 * aside)])
    return low, np.array([right + aside, min(top, np.max(y + radius))])


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


def _rotation_scale(turned: Normalize) -> Figure:
    figure = Figure(figsize=(SCALE_WIDTH, 0.6), layout="constrained")
    bar = figure.colorbar(
        ScalarMappable(turned, ROTATIONS), cax=figure.add_subplot(), orientation="horizontal", extend="both"
    )
    bar.set_label("rotation since the start (°, anticlockwise +)")
    bar.outline.set_visible(False)
    return figure


def _round_down(value: float) -> float:
    """The greatest of 1, 2, 5, 10, 20, 50, ... (and 0.5, 0.2, ...) that is not above the value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * max(step for step in (1, 2, 5) if step * power <= value * (1 + 1e-9)))


def _rgba(colour: str) -> np.ndarray:
    return np.array(to_rgba(colour))
