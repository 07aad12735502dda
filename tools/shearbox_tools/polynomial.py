# SPDX-License-Identifier: GPL-2.0-or-later
"""Polynomial through a noisy, autocorrelated curve, its degree chosen by a stated rule.

The paper simplifies its shear stress curves by "a polynomial" and takes the peak. The rule used here:

1. Rows of a DEM curve are not independent (a force chain lives for many rows). The integrated correlation length of
   the residuals of the highest degree is measured, and the curve is averaged over blocks of twice that length, so
   that the blocks may be taken as independent.
2. On the blocks, degrees 3 to 8 are fitted by least squares and compared by BIC = n ln(RSS/n) + k ln n, k = degree + 2
   (Schwarz 1978). Against a curve of known peak with correlated noise, BIC had a smaller error at the peak than AICc
   and leave-one-out, which chose degrees that follow the noise; a bound of 8 keeps the greatest bend as short as
   about a tenth of the travel and the polynomial steady.
3. Its uncertainty is a residual bootstrap over the blocks in which the degree is chosen anew each time, so that the
   choice is part of the uncertainty.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import Legendre, legendre

DEGREES = range(3, 9)
BLOCKS_PER_COEFFICIENT = 3
FEWEST_ROWS = 2 * (DEGREES[0] + 1)


@dataclass(frozen=True)
class Fit:
    """Least-squares polynomial on [0, span] through n block averages."""

    design: np.ndarray  # (n, highest degree + 1) Legendre polynomials over [0, span], averaged over the blocks
    y: np.ndarray  # (n,) block averages
    span: float
    degree: int
    coefficients: np.ndarray  # (degree + 1,)
    rows_per_block: int

    @cached_property
    def series(self) -> Legendre:
        """The fitted polynomial, which can be called and differentiated."""
        return Legendre(self.coefficients, domain=[0, self.span])

    @cached_property
    def fitted(self) -> np.ndarray:
        """(n,) block averages of the polynomial."""
        return self.design[:, : self.degree + 1] @ self.coefficients

    @cached_property
    def covariance(self) -> np.ndarray:
        """Covariance of the coefficients, s^2 (V^T V)^-1 with s^2 = RSS / (n - degree - 1)."""
        vander = self.design[:, : self.degree + 1]
        variance = np.sum((self.y - self.fitted) ** 2) / self._freedom
        return variance * np.linalg.inv(vander.T @ vander)

    def error(self, x: np.ndarray | float) -> np.ndarray:
        """Standard error of the fitted value at x, for the chosen degree."""
        vander = _vander(np.atleast_1d(x), self.span, self.degree)
        return np.sqrt(np.einsum("ij,jk,ik->i", vander, self.covariance, vander))

    @property
    def end_zone(self) -> float:
        """Width of the zone at each end where the polynomial rests on one side only: the last Chebyshev interval."""
        return end_zone(self.degree, self.span)

    def replicas(self, count: int, seed: int = 1) -> list[Legendre]:
        """Polynomials fitted to resampled residuals, each with its own degree (see the rule above)."""
        rng = np.random.default_rng(seed)
        residuals = (self.y - self.fitted) * np.sqrt(len(self.y) / self._freedom)
        noise = rng.choice(residuals, size=(len(self.y), count))
        chosen, _ = _best_coefficients(self.design, self.fitted[:, None] + noise)
        return [Legendre(np.trim_zeros(c, "b"), domain=[0, self.span]) for c in chosen.T]

    @property
    def _freedom(self) -> int:
        return len(self.y) - self.degree - 1


def end_zone(degree: int, span: float) -> float:
    """span (1 - cos(pi / (degree + 1))) / 2: outside it a polynomial of this degree is held from both sides."""
    return span * (1 - np.cos(np.pi / (degree + 1))) / 2


def fit_curve(x: np.ndarray, y: np.ndarray) -> Fit:
    """Fit y(x), rows in order of x on [0, max x]; at least FEWEST_ROWS of them."""
    if len(x) < FEWEST_ROWS:
        raise ValueError(f"{len(x)} rows are too few for a polynomial: at least {FEWEST_ROWS} are needed")
    span = float(x[-1])
    vander = _vander(x, span, _affordable(len(x))[-1])
    width = _block_width(vander, y)
    design, blocks = block_averages(vander, width), block_averages(y, width)
    coefficients, degrees = _best_coefficients(design, blocks[:, None])
    degree = int(degrees[0])
    return Fit(design, blocks, span, degree, coefficients[: degree + 1, 0], width)


def block_averages(values: np.ndarray, width: int) -> np.ndarray:
    """Means of consecutive blocks of `width` rows; the few left over are dropped at the start, away from the peak."""
    count = len(values) // width
    return values[len(values) - count * width :].reshape(count, width, *values.shape[1:]).mean(axis=1)


def correlation_length(residuals: np.ndarray) -> float:
    """Integrated autocorrelation length in rows, 1/2 + sum of rho(k), cut at the first k >= 5 lengths (Sokal 1997).

    White noise has 1/2; blocks of twice this length are nearly independent.
    """
    centred = residuals - residuals.mean()
    spectrum = np.abs(np.fft.rfft(centred, 2 * len(centred))) ** 2
    covariance = np.fft.irfft(spectrum)[: len(centred)]
    if covariance[0] <= 0:
        return 0.5
    lengths = np.cumsum(covariance / covariance[0]) - 0.5
    cut = int(np.argmax(np.arange(len(lengths)) >= 5 * lengths))
    return max(0.5, float(lengths[cut]))


def _vander(x: np.ndarray, span: float, degree: int) -> np.ndarray:
    """(len(x), degree + 1) Legendre polynomials over [0, span]."""
    return legendre.legvander(2 * x / span - 1, degree)


def _affordable(rows: int) -> list[int]:
    """Degrees with at least BLOCKS_PER_COEFFICIENT rows for each coefficient; always the lowest."""
    return [d for d in DEGREES if rows >= BLOCKS_PER_COEFFICIENT * (d + 1)] or [DEGREES[0]]


def _block_width(vander: np.ndarray, y: np.ndarray) -> int:
    residuals = y - vander @ np.linalg.lstsq(vander, y, rcond=None)[0]
    widest = max(1, len(y) // (BLOCKS_PER_COEFFICIENT * vander.shape[1]))
    return min(widest, int(np.ceil(2 * correlation_length(residuals))))


def _best_coefficients(design: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients (highest degree + 1, m), padded with zeros, and degrees (m,) of least BIC for the m columns of y."""
    rows = len(design)
    degrees = _affordable(rows)
    fitted = np.zeros((len(degrees), degrees[-1] + 1, y.shape[1]))
    criterion = np.empty((len(degrees), y.shape[1]))
    for i, degree in enumerate(degrees):
        vander = design[:, : degree + 1]
        fitted[i, : degree + 1] = np.linalg.lstsq(vander, y, rcond=None)[0]
        squares = np.sum((y - vander @ fitted[i, : degree + 1]) ** 2, axis=0)
        floor = np.finfo(float).eps * np.sum(y**2, axis=0) + np.finfo(float).tiny  # an exact fit: lowest degree wins
        criterion[i] = rows * np.log(np.maximum(squares, floor) / rows) + (degree + 2) * np.log(rows)
    best = criterion.argmin(axis=0)
    return np.take_along_axis(fitted, best[None, None, :], axis=0)[0], np.asarray(degrees)[best]
