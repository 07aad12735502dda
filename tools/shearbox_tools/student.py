# SPDX-License-Identifier: GPL-2.0-or-later
"""Quantile of Student's t, the only distribution the report needs (so SciPy is not a dependency)."""

import math


def central_probability(t: float, dof: int) -> float:
    """P(|T| < t) for integer degrees of freedom, t >= 0: the finite series of Abramowitz & Stegun 26.7.3 and 26.7.4."""
    theta = math.atan(t / math.sqrt(dof))
    cosine, sine = math.cos(theta), math.sin(theta)
    odd = dof % 2
    term = cosine if odd else 1.0
    total = term if dof > 1 else 0.0
    for k in range(2 + odd, dof - 1, 2):
        term *= cosine * cosine * (k - 1) / k
        total += term
    return 2 / math.pi * (theta + sine * total) if odd else sine * total


def t_quantile(coverage: float, dof: int) -> float:
    """Half-width t of the interval |T| < t that holds with probability `coverage`, by bisection."""
    low, high = 0.0, 1.0
    while central_probability(high, dof) < coverage:
        high *= 2
    for _ in range(80):
        middle = (low + high) / 2
        if central_probability(middle, dof) < coverage:
            low = middle
        else:
            high = middle
    return high
