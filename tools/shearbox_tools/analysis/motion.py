# SPDX-License-Identifier: GPL-2.0-or-later
"""Which rows of a shear phase are analysed: those in which the lower half moves at its full speed.

While it gathers speed, and where it stops at once, the grains' inertia shows in the stress as spikes, which are no
strength; afterwards nothing is sheared any more.
"""

import numpy as np

from ..reading.readers import Columns

TOLERANCE = 1e-3  # of the displacement in a step


def full_speed(data: Columns) -> slice:
    """Rows from the first to the last at full speed; rows are means over the interval that ends at their step.

    The means of two neighbouring intervals are apart by the full displacement of an interval only if it moved at full
    speed through both. Of those in which it moves, most do: the full displacement is their median. A table has its number
    of rows also where a test has fewer steps, and the box then stands still in most of them.
    """
    per_step = np.diff(data["displacement_mm"]) / np.diff(data["step"])
    moving = per_step[per_step > np.max(per_step, initial=0) / 2]
    if not len(moving):
        return slice(0, 0)
    full = np.flatnonzero(per_step >= (1 - TOLERANCE) * np.median(moving))
    return slice(int(full[0]), int(full[-1]) + 2)
