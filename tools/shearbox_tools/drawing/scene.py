# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of a film: the specimen, and the curves as far as they have come, with a mark where it is.

The scales are those of the whole film, so that its frames can be compared.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..analysis.moments import Moment
from ..analysis.motion import full_speed
from ..reading.readers import Columns
from .canvas import draw_scale, furnish
from .curves import DISPLACEMENT, MARGIN
from .paints import Paint
from .pictures import draw_chains, draw_discs, extent
from .style import AXIS_COLOUR, INK

SIZE = (8.0, 4.5)  # inches
SPECIMEN = (0.01, 0.14, 0.55, 0.77)  # left, bottom, width, height, of the picture
SCALE = (0.085, 0.105, 0.4, 0.022)
CURVES = {
    "tau_kPa": ("shear stress τ (kPa)", (0.66, 0.565, 0.32, 0.345)),
    "lid_mm": ("lid, up + (mm)", (0.66, 0.12, 0.32, 0.345)),
}
CURVE_COLOUR, MARK_COLOUR = "#1f4fd8", "#d62728"
SEEN = 0.98  # share of the grains of a frame that the colours reach over


class Scene:
    """A figure that shows one moment after the other."""

    def __init__(
        self, title: str, curves: Columns, first: Moment, samples: Sequence[Moment], paint: Paint | None
    ) -> None:
        """curves: the table of the shear phase; first: the specimen before shear; samples: some moments of the film, of
        which the scales are; paint: None for chains of force."""
        self.figure = Figure(figsize=SIZE)
        stop = full_speed(curves).stop or None  # afterwards displacements are all the same, and the stress has a spike
        self._curves = {name: column[:stop] for name, column in curves.items()}
        self._first, self._paint = first, paint
        self._extent = extent([*samples])
        self._widest = max(float(np.max(moment.contacts["fn"], initial=1e-9)) for moment in samples)
        self.specimen = self.figure.add_axes(SPECIMEN)
        if paint:
            self._colours = _colours(paint, samples)
            draw_scale(self.figure.add_axes(SCALE), self._colours, paint.colormap, paint.title, _extend(paint))
        self.figure.text(0.02, 0.955, title, va="center", fontsize=11, color=INK)
        self._when = self.figure.text(0.98, 0.955, "", va="center", ha="right", fontsize=11, color=INK)
        self._lines = {name: _diagram(self.figure, curves, name) for name in CURVES}

    def show(self, moment: Moment) -> None:
        """Draw that moment in place of what was there."""
        axes = self.specimen
        axes.clear()
        furnish(axes, *self._extent)
        axes.set_aspect("equal")
        if self._paint:
            draw_discs(axes, moment, self._paint.colormap(self._colours(self._paint.values(moment))))
        else:
            draw_chains(axes, moment, self._widest)
        moved = max(0.0, 1000 * moment.moved_since(self._first))
        self._when.set_text(f"{moved:.2f} mm")
        s = self._curves["displacement_mm"]
        for name, (line, mark) in self._lines.items():
            at = float(np.interp(moved, s, self._curves[name]))
            past = s < moved
            line.set_data(np.append(s[past], moved), np.append(self._curves[name][past], at))
            mark.set_data([moved], [at])


def _colours(paint: Paint, samples: Sequence[Moment]) -> Normalize:
    """Over nearly all grains of every sample."""
    values = [np.abs(paint.values(moment)[~moment.walls]) for moment in samples]
    limit = max(1e-9, *(float(np.quantile(v, SEEN)) for v in values))
    return Normalize(-limit if paint.signed else 0, limit)


def _extend(paint: Paint) -> str:
    return "both" if paint.signed else "max"


def _diagram(figure: Figure, curves: Columns, name: str) -> tuple[Line2D, Line2D]:
    """An empty curve and its mark, on axes as high as the rows at full speed; spikes of start and stop do not widen them."""
    title, place = CURVES[name]
    axes: Axes = figure.add_axes(place)
    rows = full_speed(curves)
    y = curves[name][rows if rows.stop else slice(None)]
    low, high = min(0.0, float(y.min())), max(0.0, float(y.max()))
    margin = MARGIN * (high - low)
    axes.set(xlim=(0, curves["displacement_mm"][-1]), ylim=(low - margin, high + margin))
    axes.set(ylabel=title, xlabel=DISPLACEMENT if name == list(CURVES)[-1] else "")
    axes.axhline(0, color=AXIS_COLOUR, lw=0.8, zorder=1)
    (line,) = axes.plot([], [], color=CURVE_COLOUR, lw=0.9)
    (mark,) = axes.plot([], [], "o", ms=6, color=MARK_COLOUR, mec="white", mew=1.0, zorder=4, clip_on=False)
    return line, mark
