# SPDX-License-Identifier: GPL-2.0-or-later
"""Fields inside a specimen at one moment, in the cells of the grid of the decks: solid fraction, shear strain, stress."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import LinearNDInterpolator

from .moments import Moment

LEAST_INSIDE = 0.25  # of a cell: with less of it in the box, its means are of hardly any grain


@dataclass(frozen=True)
class Box:
    """What the decks know about the box, in m."""

    half_height: float
    thickness: float


@dataclass(frozen=True)
class Fields:
    """Means over the part of each cell that is inside the box; (layers, columns) from the floor up and from left to right.

    The cells stay where the upper half is; the lower half moves out of them on its right, and its left side into them. NaN
    where less than LEAST_INSIDE of a cell is inside, or no grain.
    """

    x: np.ndarray  # (columns + 1,) edges of the cells, m
    y: np.ndarray  # (layers + 1,)
    outline: np.ndarray  # (8, 2) corners of the box, m
    solid: np.ndarray  # solid fraction
    strain: np.ndarray  # shear strain since the start
    mean_stress: np.ndarray  # kPa, pressure positive
    deviator: np.ndarray  # half the difference of the principal stresses, kPa
    direction: np.ndarray  # of the major principal stress, rad from the direction of shear

    @classmethod
    def of(cls, moment: Moment, first: Moment, box: Box) -> "Fields":
        """At a moment whose cells are known; first: the specimen before shear."""
        cells = moment.cells
        assert cells is not None
        x, y = (_edges(cells["x"][0]), _edges(cells["y"][:, 0]))
        moved = moment.moved_since(first)
        inside = _inside(x, y, moved, box.half_height)
        known = np.where((inside >= LEAST_INSIDE) & (cells["solid"] > 0), 1, np.nan)
        per_area = known / np.maximum(inside, LEAST_INSIDE)
        # N/m, means over the whole cell, to kPa
        xx, yy, xy = (cells[f"stress_{k}"] * per_area / (1000 * box.thickness) for k in ("xx", "yy", "xy"))
        return cls(
            x,
            y,
            _outline(x[-1], y[-1], moved, box.half_height),
            cells["solid"] * per_area,
            _shear_strain(moment, first, _corners(x, y, moved, box.half_height)) * known,
            (xx + yy) / 2,
            np.hypot((xx - yy) / 2, xy),
            np.arctan2(2 * xy, xx - yy) / 2,
        )


def _edges(centres: np.ndarray) -> np.ndarray:
    """Of equal cells from 0 on."""
    return np.linspace(0, centres[0] + centres[-1], len(centres) + 1)


def _inside(x: np.ndarray, y: np.ndarray, moved: float, half_height: float) -> np.ndarray:
    """(layers, columns) share of each cell that the side of the lower half, at x = moved, has not moved over."""
    below = np.clip((half_height - y[:-1]) / np.diff(y), 0, 1)[:, None]
    return 1 - below * np.clip((moved - x[:-1]) / np.diff(x), 0, 1)


def _outline(width: float, height: float, moved: float, half_height: float) -> np.ndarray:
    lower = [(0, half_height), (0, 0), (width, 0), (width, half_height)]
    upper = [(width, half_height), (width, height), (0, height), (0, half_height)]
    return np.array([(x + moved, y) for x, y in lower] + upper)


def _corners(x: np.ndarray, y: np.ndarray, moved: float, half_height: float) -> np.ndarray:
    """(layers + 1, columns + 1, 2) corners of the cells, those that the left side of the lower half has reached upon it."""
    corners = np.stack(np.meshgrid(x, y), axis=-1)
    corners[y < half_height, :, 0] = np.maximum(x, moved)
    return corners


def _shear_strain(moment: Moment, first: Moment, corners: np.ndarray) -> np.ndarray:
    """(layers, columns) difference of the principal stretches since the first moment: gamma in simple shear, 0 in rotation.

    With A, the mean of the gradient du/dx of the displacements over a cell in its present place, F^-1 = 1 - A; and the
    singular values of a matrix of 2 x 2 differ by sqrt((A_xx - A_yy)^2 + (A_xy + A_yx)^2) whatever it turns (if its
    determinant is positive). The mean of a gradient follows from the displacements on the border (theorem of Gauss); these
    are linear between the centres of grains and wall discs, on triangles of Delaunay (Bagi 1996).
    """
    places, moves = _moves(moment, first)
    u = LinearNDInterpolator(places, moves)(corners)
    (x_a, y_a), (x_b, y_b) = (np.moveaxis(d, -1, 0) for d in _diagonals(corners))
    (u_a, v_a), (u_b, v_b) = (np.moveaxis(d, -1, 0) for d in _diagonals(u))
    twice_area = x_a * y_b - x_b * y_a
    xx_less_yy = (u_a * y_b - u_b * y_a) - (x_a * v_b - x_b * v_a)
    xy_and_yx = (x_a * u_b - x_b * u_a) + (v_a * y_b - v_b * y_a)
    return np.hypot(xx_less_yy, xy_and_yx) / np.where(twice_area > 0, twice_area, np.nan)


def _moves(moment: Moment, first: Moment) -> tuple[np.ndarray, np.ndarray]:
    """(n, 2) centres of the grains and wall discs of both moments, and how they have moved, m."""
    _, now, before = np.intersect1d(moment.grains["id"], first.grains["id"], return_indices=True)
    places = np.column_stack([moment.grains["x"], moment.grains["y"]])[now]
    return places, places - np.column_stack([first.grains["x"], first.grains["y"]])[before]


def _diagonals(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What differs along the diagonals of the cells: to the upper right, and to the upper left."""
    return corners[1:, 1:] - corners[:-1, :-1], corners[1:, :-1] - corners[:-1, 1:]
