# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of specimens."""

import pytest
from synthetic import moment

from shearbox_tools.drawing.pictures import _between


def test_what_lies_between_the_ends_of_a_smooth_wall() -> None:
    """A rectangle of half the width for the wall of two discs; none for the grain of two, or the wall of one."""
    pieces = _between(moment([2, 1, 1, 2, 3], [0, 5, 6, 4, 9]), 0.5)
    assert pieces.shape == (1, 4, 2)
    assert sorted(map(tuple, pieces[0])) == pytest.approx([(0, -0.5), (0, 0.5), (4, -0.5), (4, 0.5)])
    assert _between(moment([1, 3], [0, 2]), 1).shape == (0, 4, 2)
