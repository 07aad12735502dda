# SPDX-License-Identifier: GPL-2.0-or-later
"""What the grains of a film are coloured by: rotation, speed or stress."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import Colormap

from ..analysis.moments import Moment, rows_of
from ..asking.grains import area_over_largest
from ..reading.dumps import CONTACTS, DISCS, GRAINS
from .pictures import ROTATION_TITLE, ROTATIONS

# of the dumps, beyond those that every picture is made of
COLUMNS: dict[str, dict[str, tuple[str, ...]]] = {
    "speed": {"grains": (*GRAINS, "vx", "vy")},
    "stress": {"discs": (*DISCS, "type"), "contacts": (*CONTACTS, "fx", "fy")},
}


@dataclass(frozen=True)
class Paint:
    """A colour for each disc, by a value of its grain."""

    values: Callable[[Moment], np.ndarray]  # (discs,)
    colormap: Colormap
    title: str
    signed: bool  # colours reach as far below 0 as above, else from 0 on


def make_paint(by: str, first: Moment, load: float) -> Paint:
    """rotation since the first moment, speed, or stress over that of the lid, whose force on a metre of width is load (N)."""
    if by == "speed":
        return Paint(_speed, colormaps["viridis"], "speed of the centre (mm/s)", False)
    if by == "stress":
        areas = grain_areas(first)
        return Paint(
            lambda moment: mean_stress(moment, areas) / load,
            colormaps["magma_r"],
            "mean stress of the grain over σ of the lid",
            False,
        )
    return Paint(lambda moment: np.degrees(moment.rotation_since(first)), ROTATIONS, ROTATION_TITLE, True)


def grain_areas(moment: Moment) -> np.ndarray:
    """By id: the area (m2) of the union of a grain's discs. Grains of a type are similar, and one of each is measured."""
    discs, ids = moment.discs, moment.discs["id"].astype(int)
    largest = np.zeros(ids.max() + 1)
    np.maximum.at(largest, ids, discs["radius"])
    areas = np.full(len(largest), np.nan)
    for kind in np.unique(discs["type"][~moment.walls]):
        of_kind = ids[(discs["type"] == kind) & ~moment.walls]
        one = ids == of_kind[0]
        numbers = np.column_stack([discs[name][one] for name in ("x", "y", "radius")]).ravel()
        shape = " ".join(["discs", str(one.sum()), *(f"{value:.17g}" for value in numbers)])
        areas[of_kind] = area_over_largest(shape) * (2 * largest[of_kind]) ** 2
    return areas


def mean_stress(moment: Moment, areas: np.ndarray) -> np.ndarray:
    """(discs,) of each disc's grain, N/m (over the thickness it is a pressure); nan of walls.

    Half the trace of Love's mean stress, -1/A times the sum over contacts of (x_c - x) f, with the force f on the grain at
    x_c: the sum does not depend on x, where the grain is at rest (Bagi, Mechanics of Materials 22 (1996) 165).
    """
    force = np.column_stack([moment.contacts["fx"], moment.contacts["fy"]])
    centre1, point, centre2 = np.moveaxis(moment.branches(), 1, 0)
    pressed = np.zeros(len(areas))
    for name, centre, sign in (("id1", centre1, -1), ("id2", centre2, 1)):
        work = sign * np.sum((point - centre) * force, axis=1)
        pressed += np.bincount(moment.contacts[name].astype(int), work, len(areas))
    return (pressed / (2 * areas))[moment.discs["id"].astype(int)]


def _speed(moment: Moment) -> np.ndarray:
    grains = moment.grains
    row = rows_of(grains["id"], moment.discs["id"])
    return 1000 * np.hypot(grains["vx"], grains["vy"])[row]
