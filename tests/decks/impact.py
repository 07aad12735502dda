# SPDX-License-Identifier: GPL-2.0-or-later
"""Head-on collisions, and the closed forms of their restitution, which test_restitution.py explains."""

from __future__ import annotations

import math

STIFFNESS = 1e8  # N/m
DIAMETER = 4e-3  # m

DECK = """
include ${decks}/start.in
fix move grains cdem/integrate dt any    # 20 steps a contact and more; the limit of a packing does not matter here
timestep ${dt}
run ${steps}
include ${decks}/end.in
"""
CLUMPS = """
group grains type 3
fix shape all cdem/shape density ${density} type 1 single type 2 single type 3 ${cross}
fix move"""


def restitution(h: float) -> float:
    return math.exp(-math.pi * h / math.sqrt(1 - h * h))


def restitution_without_pull(h: float) -> float:
    root = math.sqrt(1 - h * h)
    return math.exp(-h / root * (math.pi - math.atan2(2 * h * root, 1 - 2 * h * h)))
