# SPDX-License-Identifier: GPL-2.0-or-later
"""The table that `shearbox models` prints."""

from rich import box
from rich.console import Console
from rich.table import Table

from .models import Model, all_models


def print_models() -> None:
    """One line a model; as wide as it needs to be when it does not go to a terminal."""
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("model", no_wrap=True)
    for name in ("box, cm", "discs, mm", "discs/grain", "grains"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("size law", no_wrap=True)
    for model in all_models():
        table.add_row(*_row(model))
    console = Console()
    if not console.is_terminal:
        console.width = 120
    console.print(table)


def _row(model: Model) -> tuple[str, ...]:
    low, high = model.dmin * 1000, model.dmax * 1000
    return (
        model.name,
        f"{model.width * 100:g} × {2 * model.half_height * 100:g}",
        f"{low:g}" if low == high else f"{low:g}–{high:g}",
        str(model.discs),
        str(model.ngrains),
        "equal" if low == high else f"n(d) ∝ d^{model.power:g}" if model.power else "uniform",
    )
