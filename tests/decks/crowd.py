# SPDX-License-Identifier: GPL-2.0-or-later
"""A periodic field of grains that overlap, move and spin: something of everything that outputs may tell."""

from __future__ import annotations

import math
from pathlib import Path

from engine import Disc, Run, run

SIDE, SPACING = 8, 0.005
PERIOD = SIDE * SPACING
# Two materials, as walls are smooth.
CROWD_START = """
include ${decks}/start.in
pair_coeff 1 2 ${kn} 0 ${hn} 0 ${phi}
fix shape all cdem/shape type 1 ${shape} type 2 single density ${density} orient 7
fix move grains cdem/integrate dt auto 2e-6
"""
SWELLING = {"single": 1.04, "triple": 1.3}  # of a grain's diameter beyond the spacing


def crowd(shape: str) -> list[Disc]:
    """A periodic field of grains of two sizes that overlap, move and spin; its lowest row is wall."""
    discs = []
    for k in range(SIDE**2):
        row, column = divmod(k, SIDE)
        x, y = ((c + 0.5) * SPACING + 4e-5 * math.sin(7 * k + c) for c in (column, row))
        diameter = SPACING * (SWELLING[shape] if k % 3 else 1.01)
        if row == 0:
            discs.append(Disc(x, y, diameter, type=2))
        else:
            discs.append(Disc(x, y, diameter, 0.3 * math.sin(3 * k), 0.3 * math.cos(5 * k), 100 * math.sin(k)))
    return discs


def run_crowd(deck: str, directory: Path, law: str, ranks: int, shape: str = "single") -> Run:
    return run(
        CROWD_START + deck, directory, discs=crowd(shape), box=(0, PERIOD, 0, PERIOD), ranks=ranks, bx="p", by="p",
        law=law, shape=shape, kn=1e6, ks=2.5e5, phi=5,
    )  # fmt: skip
