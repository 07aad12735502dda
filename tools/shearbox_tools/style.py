# SPDX-License-Identifier: GPL-2.0-or-later
"""How pictures look, in one place."""

import base64
import io

import matplotlib
from matplotlib.figure import Figure

matplotlib.use("Agg")

PAPER_COLOURS = {100: "#1f4fd8", 200: "#d62728", 300: "#1a9641", 400: "#111111"}  # blue, red, green, black
OTHER_COLOURS = ("#e08214", "#7b3294", "#17a2b8", "#8c510a", "#c51b7d", "#4d4d4d")

RC = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e3e6ea",
    "grid.linewidth": 0.6,
    "axes.edgecolor": "#8a929b",
    "axes.labelcolor": "#23282e",
    "axes.axisbelow": True,
    "xtick.color": "#4a525a",
    "ytick.color": "#4a525a",
    "legend.frameon": False,
    "legend.fontsize": 8,
    "svg.hashsalt": "shearbox",
}


def colours(stresses: list[float]) -> dict[float, str]:
    """The paper's colour for its four stresses, others in order of appearance."""
    others = iter(OTHER_COLOURS * (1 + len(stresses) // len(OTHER_COLOURS)))
    return {s: PAPER_COLOURS.get(int(s) if s == int(s) else -1) or next(others) for s in stresses}


def as_uri(figure: Figure, kind: str) -> str:
    """The figure as a data: URI, 'svg' or 'png', to be embedded in a page."""
    buffer = io.BytesIO()
    metadata = {"Date": None} if kind == "svg" else None
    figure.savefig(buffer, format=kind, dpi=200, metadata=metadata)
    mime = "image/svg+xml" if kind == "svg" else "image/png"
    return f"data:{mime};base64,{base64.b64encode(buffer.getvalue()).decode()}"
