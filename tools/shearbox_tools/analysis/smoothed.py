# SPDX-License-Identifier: GPL-2.0-or-later
"""Peak of the smoothed data, to hold against that of the polynomial.

The curve is smoothed by parabolas fitted to the rows around each row (Savitzky and Golay 1964), over a fifth of the
travel. On curves of known peak with correlated noise this width had the smallest error among a quarter to an eighth:
wider ones cut early peaks off, narrower ones follow the noise.

The error is that of a moving block bootstrap (Kuensch 1989): blocks of the residuals, long enough to hold the
correlation of the rows, are drawn and added to a curve, which is smoothed again. Both that curve and the residuals
come from smoothing twice as widely, since the narrower smoothing takes part of the noise along (Haerdle and Bowman
1988). The highest point of a noisy curve is too high: by how much, the replicas show, and that is subtracted.
"""

import numpy as np
from scipy.signal import savgol_filter

from .peak import Peak
from .polynomial import LENGTHS_PER_BLOCK, correlation_length, end_zone

SHARE = 5  # the window is the travel over this
ORDER = 2  # of the local polynomial
REPLICAS = 400


def smooth(y: np.ndarray) -> np.ndarray:
    """Rows (..., n) at equal distances, smoothed."""
    return _savgol(y, y.shape[-1] // SHARE)


def find_smoothed_peak(x: np.ndarray, y: np.ndarray, seed: int = 1) -> Peak:
    """Greatest value of y (n,) smoothed, less its bias; n >= FEWEST_ROWS rows at equal distances of x on [0, max x].

    It is looked for from `end_zone` on, as that of the polynomial: before, the parabolas rest on one side only.
    """
    start = int(np.searchsorted(x, end_zone(float(x[-1]))))
    x, curve = x[start:], smooth(y)[start:]
    top = int(np.argmax(curve))
    trend = _savgol(y, 2 * len(y) // SHARE)
    replicas = smooth(trend + _resampled(y - trend, np.random.default_rng(seed)))[:, start:]
    heights, places = replicas.max(axis=1), x[replicas.argmax(axis=1)]
    bias = float(np.mean(heights) - np.max(smooth(trend)[start:]))
    shift = float(np.sqrt(np.mean((places - x[top]) ** 2)))
    return Peak(float(curve[top]) - bias, float(np.std(heights)), float(x[top]), shift, top in (0, len(x) - 1))


def _savgol(y: np.ndarray, width: int) -> np.ndarray:
    odd = max(ORDER + 1, width) | 1
    return savgol_filter(y, min(odd, (y.shape[-1] - 1) | 1), ORDER)


def _resampled(residuals: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """(REPLICAS, n) rows of blocks drawn from the residuals (n,), wherever they begin."""
    rows = len(residuals)
    length = min(rows // 2, int(np.ceil(LENGTHS_PER_BLOCK * correlation_length(residuals))))
    starts = rng.integers(0, rows - length + 1, size=(REPLICAS, -(-rows // length)))
    drawn = (starts[:, :, None] + np.arange(length)).reshape(REPLICAS, -1)[:, :rows]
    return (residuals - residuals.mean())[drawn]
