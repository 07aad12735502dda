# SPDX-License-Identifier: GPL-2.0-or-later
"""What is asked for and may not be meant: it is told, and not refused."""

import math

from .forecast import stability_limit
from .grains import length_over_largest
from .numerals import number
from .parameters import parameters
from .request import Request

LARGEST_COEFFICIENT = 1.5  # of friction that is taken for one: as an angle in degrees it would be next to nothing
FEWEST_ACROSS = 10  # grains in the width of a box, by ASTM D3080


def cautions(request: Request) -> list[str]:
    """A sentence for each."""
    model = request.model
    return [*_angles(request.settings), *_step(request), *narrow(model.width, model.dmax, model.shape)]


def narrow(width: float, dmax: float, shape: str) -> list[str]:
    """Whether the box has the width (m) that its largest grains need; dmax is the diameter of their largest disc."""
    across = width / (dmax * length_over_largest(shape))
    if across > FEWEST_ACROSS * (1 - 1e-9):
        return []
    return [
        f"the box is {across:.3g} of its largest grains wide; standards for direct shear ask for {FEWEST_ACROSS} or more "
        "(ASTM D3080)"
    ]


def _angles(settings: dict[str, str]) -> list[str]:
    """Coefficients of friction in place of angles."""
    known = parameters()
    angles = {name: number(value) for name, value in settings.items() if "(degrees)" in known[name].meaning}
    return [
        f"{name} = {value:g} is an angle of {value:g} degrees; a coefficient of friction of {value:g} is "
        f"{name} {math.degrees(math.atan(value)):.2f}"
        for name, value in angles.items()
        if 0 < value < LARGEST_COEFFICIENT
    ]


def _step(request: Request) -> list[str]:
    limit = stability_limit(request)
    if request.dt == "auto" or number(request.dt) <= limit:
        return []
    return [
        f"--dt {request.dt}: the stability limit of the smallest discs is about {limit:.2g} s, and the engine refuses a step beyond "
        "that of the scene; --dt auto takes a stable one"
    ]
