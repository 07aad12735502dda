# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a box is wide enough for its grains."""

from typing import Any

from .grains import length_over_largest

FEWEST_ACROSS = 10  # grains in the width of a box, by ASTM D3080


def narrow(width: float, dmax: float, shape: str) -> list[str]:
    """Whether the box has the width (m) that its largest grains need; dmax is the diameter of their largest disc."""
    across = width / (dmax * length_over_largest(shape))
    if across > FEWEST_ACROSS * (1 - 1e-9):
        return []
    return [
        f"the box is {across:.3g} of its largest grains wide; standards for direct shear ask for {FEWEST_ACROSS} or more "
        "(ASTM D3080)"
    ]


def narrow_by_record(identity: dict[str, Any]) -> list[str]:
    """The same of a run; nothing where its record does not tell the grains."""
    try:
        return narrow(*(identity[f"model {name}"] for name in ("width", "dmax", "shape")))
    except (LookupError, ValueError, TypeError, AttributeError, ArithmeticError):
        return []
