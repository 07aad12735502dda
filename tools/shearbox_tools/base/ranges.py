# SPDX-License-Identifier: GPL-2.0-or-later
"""What a column of the decks' tables and dumps can hold; anything else is a damage."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from .errors import ShearboxError

_INFINITE = float("inf")
_COUNTS = ("step", "steps", "dangerous", "disc", "wall", "lower", "lid")
_FROM_ONE = ("grains", "id", "id1", "id2", "type")
_AT_LEAST_0 = ("trm", "kinetic_J", "unbalanced", "height_m", "radius")
_SHARES = ("solid_fraction", "solid_fraction_bottom", "solid_fraction_top", "wall", "lower", "lid")
_POSITIVE = ("height_m", "radius")
_LARGEST_COUNT = 2.0**53  # above, not every whole number is a double


def require_ranges(columns: Mapping[str, np.ndarray | float], path: Path) -> None:
    """Refuse values that a column of that name cannot have; of other columns, any will do."""
    for name, given in columns.items():
        values = np.atleast_1d(given)
        low = 1 if name in _FROM_ONE else 0 if name in _COUNTS + _AT_LEAST_0 + _SHARES else -_INFINITE
        whole = name in _COUNTS + _FROM_ONE
        high = 1 if name in _SHARES else _LARGEST_COUNT if whole else _INFINITE
        wrong = (values < low) | (values > high) | (whole & (values % 1 != 0)) | ((name in _POSITIVE) & (values == 0))
        if wrong.any():
            raise ShearboxError(f"{path}: {name} {values[np.argmax(wrong)]:g} cannot be")
