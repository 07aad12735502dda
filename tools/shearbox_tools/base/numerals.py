# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers as LAMMPS reads them, which is not as Python does: no underscores, blanks, other alphabets' digits, nan or inf."""

import math
import re

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")


def is_numeral(text: str) -> bool:
    """Whether the whole text is a number; it may be too large for one of ours."""
    return _NUMBER.fullmatch(text) is not None


def number(text: str) -> float:
    """The finite number that the whole text is; ValueError if it is none."""
    value = float(text) if is_numeral(text) else math.nan
    if not math.isfinite(value):
        raise ValueError(f"'{text}' is not a number")
    return value


def numeral(value: float) -> str:
    """The number as text, always the same for the same number."""
    return f"{value:.15g}"
