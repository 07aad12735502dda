# SPDX-License-Identifier: GPL-2.0-or-later
"""HTML pages, each a single file that opens without a network."""

import math
import re
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from ..base.words import duration

TEMPLATES = Path(__file__).parent / "templates"


def render(template: str, **values: Any) -> str:
    """The page that a template of the folder `templates` makes of the values; those it names must be there."""
    return environment(TEMPLATES).get_template(template).render(**values)


@cache
def environment(*folders: Path) -> Environment:
    """Of templates in the folders, with the filters of all pages; it keeps what it has compiled."""
    made = Environment(
        loader=FileSystemLoader(folders),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters.update(duration=duration, number=number, minus=minus, signs=signs)
    return made


def number(value: float | None, digits: int = 4) -> str:
    """A number as people write it; a dash for what is not known."""
    if value is None or math.isnan(value):
        return "–"
    return minus(f"{value:.{digits}g}".replace("e-0", "e-").replace("e+0", "e"))


def minus(text: str) -> str:
    """The text with a minus sign for its hyphen, and none before a zero."""
    return text.lstrip("+-") if not text.strip("+-0.") else text.replace("-", "−")


def signs(text: str) -> str:
    """A sentence with minus signs before its negative numbers and exponents; words and names keep their hyphens."""
    return re.sub(r"((?<!\w)|(?<=\de))-(?=\d)", "−", text)
