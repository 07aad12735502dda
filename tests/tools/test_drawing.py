# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of specimens."""

import numpy as np
import pytest

from shearbox_tools.drawing import _between
from shearbox_tools.specimen import Moment


def moment(ids: list[int], x: list[float]) -> Moment:
    """Discs of radius 1 in a row; of grain 1, which is free, and of walls."""
    discs = {"id": np.array(ids), "x": np.array(x), "y": np.zeros(len(x)), "radius": np.ones(len(x))}
    grains = {"id": np.unique(ids), "wall": (np.unique(ids) != 1).astype(float)}
    return Moment(0, grains, discs, {}, None)


def test_what_lies_between_the_ends_of_a_smooth_wall() -> None:
    """A rectangle of half the width for the wall of two discs; none for the grain of two, or the wall of one."""
    pieces = _between(moment([2, 1, 1, 2, 3], [0, 5, 6, 4, 9]), 0.5)
    assert pieces.shape == (1, 4, 2)
    assert sorted(map(tuple, pieces[0])) == pytest.approx([(0, -0.5), (0, 0.5), (4, -0.5), (4, 0.5)])
    assert _between(moment([1, 3], [0, 2]), 1).shape == (0, 4, 2)
