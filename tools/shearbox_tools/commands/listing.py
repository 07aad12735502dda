# SPDX-License-Identifier: GPL-2.0-or-later
"""The tables that `shearbox models` and `shearbox parameters` print."""

import json

from rich import box
from rich.console import Console
from rich.table import Table

from ..asking.models import Model, model_files, read_model, table_order
from ..asking.parameters import parameters
from ..asking.request import OWN_OPTION
from ..base.errors import ShearboxError

BROKEN = {"may be": 24, "meaning, unit": None}  # columns that go on in a further line, and how wide they are at most


def print_models(as_json: bool = False) -> None:
    """One line a model, and one for each file that is none; as JSON, with the variables of its file, the models alone."""
    models, problems = [], []
    for path in model_files():
        try:
            models.append(read_model(path))
        except ShearboxError as error:
            problems.append(str(error))
    models.sort(key=table_order)
    if as_json:
        print(json.dumps([{"name": m.name, "discs": m.discs, **m.variables} for m in models], indent=2))
        return
    table = _table("model", "box, cm", "discs, mm", "discs/grain", "grains", "size law")
    for model in models:
        table.add_row(*_row(model))
    console = _console()
    console.print(table)
    for problem in problems:
        console.print(f"not a model: {problem}", markup=False, highlight=False, soft_wrap=True)


def print_parameters(as_json: bool = False) -> None:
    """One line a variable; in JSON the value of those that the model has is null."""
    if as_json:
        known = [(p.name, p.value, p.allowed, p.meaning.strip()) for p in parameters().values()]
        print(json.dumps([dict(zip(("name", "value", "allowed", "meaning"), one)) for one in known], indent=2))
        return
    table = _table("name", "value", "may be", "meaning, unit", right=())
    for parameter in parameters().values():
        option = f" ({OWN_OPTION[parameter.name]})" if parameter.name in OWN_OPTION else ""
        value = "of the model" if parameter.value is None else parameter.value
        table.add_row(parameter.name, value, parameter.allowed, parameter.meaning + option)
    _console().print(table)


def _table(*columns: str, right: tuple[str, ...] = ("box, cm", "discs, mm", "discs/grain", "grains")) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for name in columns:
        whole, most = name not in BROKEN, BROKEN.get(name)
        table.add_column(
            name, justify="right" if name in right else "left", no_wrap=whole, max_width=most, overflow="fold"
        )
    return table


def _console() -> Console:
    """As wide as a table needs to be when it does not go to a terminal."""
    console = Console()
    if not console.is_terminal:
        console.width = 200
    return console


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
