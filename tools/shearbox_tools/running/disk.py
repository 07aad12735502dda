# SPDX-License-Identifier: GPL-2.0-or-later
"""How much the files of a test take on the disk, roughly."""

from ..asking.models import PARAMETERS, read_variables
from ..asking.request import Request
from ..base.numerals import number
from .phases import frames_of

# in the four dumps of a frame together; the former with its share of contacts and cells
BYTES_PER_DISC, BYTES_PER_WALL_DISC = 350, 120
BYTES_OF_RESTART = 380  # for a disc, of a restart file
HALF_HEIGHTS = 2.5  # of the sides: compact.in leaves half of one above the lid


def bytes_of_frames(request: Request) -> float:
    """Of a test that is finished."""
    grains = BYTES_PER_DISC * request.model.ngrains * request.model.discs
    return (1 + frames_of(request.settings)) * (grains + BYTES_PER_WALL_DISC * wall_discs(request))


def wall_discs(request: Request) -> float:
    """Discs, or pieces of smooth walls, of floor and lid, the sides and four flanges, as build.in has them; of grains of several discs
    they are larger, and so fewer."""
    model, texts = request.model, read_variables(PARAMETERS) | request.settings
    size, close, flanges = (number(texts[name]) for name in ("wall_disc", "side_pitch", "flanges"))
    diameter = size * model.dmin
    pitch = diameter if texts["sides"] == "smooth" else close * diameter
    sides = 2 * HALF_HEIGHTS * model.half_height + 4 * (flanges * model.width + diameter)
    return 2 * model.width / diameter + sides / pitch
