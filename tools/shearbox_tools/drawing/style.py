# SPDX-License-Identifier: GPL-2.0-or-later
"""How pictures look, in one place. Curves differ by colour, dashes and mark: any one of them tells them apart."""

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

matplotlib.use("Agg")


@dataclass(frozen=True)
class Look:
    """Of all that belongs to one normal stress."""

    colour: str
    dashes: Any  # a line style of matplotlib
    mark: str

    def dasharray(self, width: float) -> str:
        """The dashes of a line of that width, as SVG has them."""
        return "none" if self.dashes == "-" else " ".join(f"{width * length:g}" for length in self.dashes[1])


PAPER_LOOKS = {  # blue, red, green, black
    100: Look("#1f4fd8", "-", "o"),
    200: Look("#d62728", (0, (6, 1.6)), "s"),
    300: Look("#1a9641", (0, (7, 1.6, 1.4, 1.6)), "^"),
    400: Look("#111111", (0, (1.4, 1.2)), "D"),
}
OTHER_LOOKS = (
    Look("#e08214", (0, (10, 2)), "v"),
    Look("#7b3294", (0, (3, 1.4)), "P"),
    Look("#17a2b8", (0, (7, 1.4, 1.4, 1.4, 1.4, 1.4)), "<"),
    Look("#8c510a", (0, (4, 3)), "X"),
    Look("#c51b7d", (0, (1.4, 2.6)), ">"),
    Look("#4d4d4d", (0, (12, 2, 3, 2)), "h"),
)
ALL_LOOKS = (*PAPER_LOOKS.values(), *OTHER_LOOKS)  # of what belongs to no stress, but is to be told apart
LINE_COLOUR = "#555d66"  # of what belongs to no stress
INK = "#23282e"
AXIS_COLOUR = "#8a929b"  # also of lines at zero

SIZE = (4.4, 3.4)  # of a diagram, inches: text is readable where three of them stand side by side, and on a phone
RC = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e3e6ea",
    "grid.linewidth": 0.6,
    "axes.edgecolor": AXIS_COLOUR,
    "axes.labelcolor": INK,
    "axes.axisbelow": True,
    "xtick.color": "#4a525a",
    "ytick.color": "#4a525a",
    "legend.frameon": False,
    "legend.fontsize": 8,
    "svg.hashsalt": "shearbox",
}


def looks(stresses: Sequence[float]) -> dict[float, Look]:
    """Those of the paper for its four stresses, others in order of appearance."""
    others = iter(OTHER_LOOKS * (1 + len(stresses) // len(OTHER_LOOKS)))
    return {s: PAPER_LOOKS.get(int(s) if s == int(s) else -1) or next(others) for s in stresses}


def diagram(x: str, y: str) -> tuple[Figure, Axes]:
    """An empty diagram with the names of its axes."""
    figure = Figure(figsize=SIZE, layout="constrained")
    axes = figure.add_subplot()
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    return figure, axes


def name_stresses(axes: Axes, of: dict[float, Look]) -> None:
    """A legend of the stresses, above the diagram."""
    for sigma, look in of.items():
        axes.plot([], [], look.mark, color=look.colour, ls=look.dashes, lw=1.8, ms=4.5, label=f"{sigma:g} kPa")
    axes.legend(
        ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0), columnspacing=1.2, handlelength=2.8, handletextpad=0.5
    )


def as_uri(figure: Figure) -> str:
    """The figure as an SVG in a data: URI, to be embedded in a page. (Figure.savefig draws what has a layout twice.)"""
    buffer = io.BytesIO()
    FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None})
    return data_uri(buffer, "svg+xml")


def data_uri(image: io.BytesIO, kind: str) -> str:
    """An image as a data: URI."""
    return f"data:image/{kind};base64,{base64.b64encode(image.getvalue()).decode()}"
