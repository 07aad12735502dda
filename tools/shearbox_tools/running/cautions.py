# SPDX-License-Identifier: GPL-2.0-or-later
"""What is asked for and may not be meant: it is told, and not refused."""

import math

from ..asking.box_width import narrow
from ..asking.parameters import parameters
from ..asking.request import Request
from ..base.numerals import number
from .forecast import stability_limit

LARGEST_COEFFICIENT = 1.5  # of friction that is taken for one: as an angle in degrees it would be next to nothing


def cautions(request: Request) -> list[str]:
    """A sentence for each."""
    model = request.model
    return [*_angles(request.settings), *_step(request), *narrow(model.width, model.dmax, model.shape)]


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
