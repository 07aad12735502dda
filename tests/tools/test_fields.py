# SPDX-License-Identifier: GPL-2.0-or-later
"""Fields inside specimens that shear by known amounts under known stresses."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import synthetic

from shearbox_tools.analysis.fields import Box, Fields
from shearbox_tools.analysis.moments import Film, Moment
from shearbox_tools.base.errors import ShearboxError

BOX = Box(half_height=0.05, thickness=0.01)
TRAVEL = 7.0  # mm; of the first cells of 10 mm of the lower half, 3 mm stay inside
INNER = (slice(2, -2), slice(2, -2))  # cells that have no wall disc for a corner of a triangle


@pytest.fixture(name="film", scope="module")
def _film(tmp_path_factory: pytest.TempPathFactory) -> Film:
    folder = tmp_path_factory.mktemp("frames")
    synthetic.write_frames(folder, [0, 100], TRAVEL)
    return Film(folder, np.array([100]), np.array([TRAVEL]))


def test_homogeneous_shear(film: Film) -> None:
    """gamma = travel over height everywhere, and 0 before; known also where the lower half has left its first cells."""
    before, end = (Fields.of(moment, film.first(), BOX) for moment in (film.first(), film.last()))
    np.testing.assert_allclose(before.strain, 0, atol=1e-12)
    np.testing.assert_allclose(end.strain[INNER], 1e-3 * TRAVEL / 0.1, rtol=1e-5)
    assert np.isfinite(end.strain).all()


def deformed(moment: Moment, f: np.ndarray) -> Moment:
    """By the deformation gradient f, (2, 2), about the mean place of the lower half, which so has not moved."""
    places = np.array([moment.grains["x"], moment.grains["y"]])
    middle = places[:, moment.grains["lower"] == 1].mean(axis=1, keepdims=True)
    x, y = middle + f @ (places - middle)
    return replace(moment, grains=moment.grains | {"x": x, "y": y})


@pytest.mark.parametrize("degrees", [0, 30, 90])
def test_rotation_is_no_strain(film: Film, degrees: float) -> None:
    """Stretches 1.3 and 1 / 1.3, then turned: gamma is their difference in all cells that the grains still cover."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    first = film.first()
    strain = Fields.of(deformed(first, np.array([[c, -s], [s, c]]) @ np.diag([1.3, 1 / 1.3])), first, BOX).strain
    known = strain[np.isfinite(strain)]
    assert known.size > 20
    np.testing.assert_allclose(known, 1.3 - 1 / 1.3, rtol=1e-9)


def test_stress_is_of_the_part_inside(film: Film) -> None:
    """Cells of 500, 1000, 300 N/m: Mohr's circle in kPa; where 3 of 10 mm are inside, the same grains stand for less."""
    end = Fields.of(film.last(), film.first(), BOX)
    share = np.ones((10, 10))
    share[:5, 0] = 0.3
    np.testing.assert_allclose(end.mean_stress, 75 / share, rtol=1e-6)
    np.testing.assert_allclose(end.deviator, np.hypot(25, 30) / share, rtol=1e-6)
    np.testing.assert_allclose(end.solid, 0.82 / share, rtol=1e-6)
    # the direction in which n . stress . n is largest
    angles = np.radians(np.arange(0, 180, 0.01))
    n = np.array([np.cos(angles), np.sin(angles)])
    pressure = 500 * n[0] ** 2 + 1000 * n[1] ** 2 + 600 * n[0] * n[1]
    np.testing.assert_allclose(end.direction, angles[np.argmax(pressure)], atol=2e-4)


def test_the_outline_and_cells_outside(tmp_path: Path) -> None:
    synthetic.write_frames(tmp_path, [0, 100], 8)
    far = Film(tmp_path, np.array([100]), np.array([8.0]))
    end = Fields.of(far.last(), far.first(), BOX)
    assert np.array_equal(np.isnan(end.solid), [[row < 5 and column == 0 for column in range(10)] for row in range(10)])
    np.testing.assert_allclose(
        np.array([end.outline.min(axis=0), end.outline.max(axis=0)]), np.array([[0.0, 0.0], [0.108, 0.1]]), atol=1e-6
    )


def test_no_grid_is_refused(tmp_path: Path) -> None:
    synthetic.write_frames(tmp_path, [0], TRAVEL)
    path = tmp_path / "cells.dump"
    path.write_text(path.read_text(encoding="utf-8").replace("\n0.015 ", "\n0.016 ", 1), encoding="utf-8")
    with pytest.raises(ShearboxError, match="cells.dump: x and y of a frame"):
        Film(tmp_path, np.array([100]), np.array([TRAVEL])).first()
