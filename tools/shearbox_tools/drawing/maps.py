# SPDX-License-Identifier: GPL-2.0-or-later
"""Maps of the fields inside specimens. All maps of a report have the same scales of colours; these are perceptually
uniform, so they are read in grey as well."""

from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Colormap, Normalize
from matplotlib.patches import Polygon

from ..analysis.fields import Fields
from .canvas import STRIP, Canvas, colour_scale, draw_key, round_down
from .style import INK, RC, as_uri

ASIDE = 0.05  # shown beside the box, of its width
DPI = 130  # 300 on A4
UNKNOWN_COLOUR = "#e3e6ea"
RANGE = (0.02, 0.98)  # quantiles of the cells of each map that the colours reach over
ARM = 0.65  # from the middle of a cross, of the shorter side of a cell, where stress is largest: few crosses leave their cell


@dataclass(frozen=True)
class Kind:
    """What a map shows."""

    colormap: Colormap
    title: str
    from_zero: bool


KINDS = {
    "solid": Kind(colormaps["cividis"], "solid fraction", False),
    "strain": Kind(colormaps["magma_r"], "shear strain γ since the start", True),
    "stress": Kind(colormaps["viridis"], "mean stress over σ of the lid", True),
}


def draw_maps(specimens: dict[float, dict[str, Fields]]) -> dict[str, str]:
    """WebP pictures as data: URIs, of the fields of specimens by their normal stress (kPa) and the name of the moment.

    Their names are '100 peak solid', '100 peak strain', '100 peak stress' and so on; the SVGs 'solid scale', 'strain
    scale' and 'stress scale' are for all of them.
    """
    if not specimens:
        return {}
    every = [(sigma, name, fields) for sigma, by_name in specimens.items() for name, fields in by_name.items()]
    largest = max(float(np.nanquantile(f.mean_stress + f.deviator, RANGE[1])) / sigma for sigma, _, f in every)
    pictures = {}
    with rc_context(RC):
        canvases = {sigma: Canvas(*_extent(list(by_name.values())), DPI) for sigma, by_name in specimens.items()}
        for key, kind in KINDS.items():
            colours = _colours([_values(key, fields, sigma) for sigma, _, fields in every], kind.from_zero)
            extend = "max" if kind.from_zero else "both"
            pictures[f"{key} scale"] = as_uri(colour_scale(colours, kind.colormap, kind.title, extend))
            for sigma, name, fields in every:
                canvas = canvases[sigma]
                _draw_cells(canvas.axes, fields, _values(key, fields, sigma), colours, kind)
                if key == "stress":
                    _draw_crosses(canvas.axes, fields, largest * sigma)
                pictures[f"{sigma:g} {name} {key}"] = canvas.take()
    return pictures


def _values(key: str, fields: Fields, sigma: float) -> np.ndarray:
    return {"solid": fields.solid, "strain": fields.strain, "stress": fields.mean_stress / sigma}[key]


def _colours(values: list[np.ndarray], from_zero: bool) -> Normalize:
    lows, highs = np.transpose([np.nanquantile(v, RANGE) for v in values])
    low = 0.0 if from_zero else float(lows.min())
    return Normalize(low, max(float(highs.max()), low + 1e-3))


def _draw_cells(axes: Axes, fields: Fields, values: np.ndarray, colours: Normalize, kind: Kind) -> None:
    """Inside the outline of the box."""
    box = axes.add_patch(Polygon(fields.outline, facecolor=UNKNOWN_COLOUR, edgecolor="none"))
    own = Normalize(colours.vmin, colours.vmax)  # one for all would call back meshes that are being cleared away
    mesh = axes.pcolormesh(fields.x, fields.y, np.ma.masked_invalid(values), norm=own, cmap=kind.colormap)
    mesh.set_clip_path(box)
    axes.add_patch(Polygon(fields.outline, fill=False, edgecolor=INK, linewidth=1.5, joinstyle="miter"))


def _extent(moments: list[Fields]) -> tuple[np.ndarray, np.ndarray]:
    """(2,) lowest and highest corner of a picture, m: the boxes of all moments, and the strip."""
    corners = np.concatenate([fields.outline for fields in moments])
    low, high = corners.min(axis=0), corners.max(axis=0)
    aside = ASIDE * (high - low)[0]
    strip = STRIP * ((high - low)[0] + 2 * aside)
    return low - [aside, strip + aside], high + aside


def _draw_crosses(axes: Axes, fields: Fields, largest: float) -> None:
    """In each cell a cross in the directions of the principal stresses, as long as they are great.

    largest: stress (kPa) whose arm is ARM of a cell.
    """
    longest = 2 * ARM * min(fields.x[1], fields.y[1])
    centres = np.stack(np.meshgrid(_middles(fields.x), _middles(fields.y)), axis=-1)
    arms = []
    for stress, turn in (
        (fields.mean_stress + fields.deviator, 0),
        (fields.mean_stress - fields.deviator, np.pi / 2),
    ):
        angle = fields.direction + turn
        arm = (longest / 2 * stress / largest)[..., None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        arms.append(np.stack([centres - arm, centres + arm], axis=-2)[np.isfinite(stress)])
    lines = list(np.concatenate(arms))
    for colour, width in (("white", 2.4), (INK, 1.3)):  # dark, with a border that is seen on dark cells
        axes.add_collection(LineCollection(lines, colors=colour, linewidths=width, capstyle="round"))
    key = round_down(largest)
    length = key / largest * longest / np.ptp(axes.get_xlim())
    draw_key(axes, (0.65, 0.65 + length), f"{key:g} kPa", lw=1.3, color=INK)


def _middles(edges: np.ndarray) -> np.ndarray:
    return (edges[1:] + edges[:-1]) / 2
