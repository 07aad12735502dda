# SPDX-License-Identifier: GPL-2.0-or-later
"""Templates of fix cdem/shape, as far as the tools must know them: the discs, and the area of their union."""

from pathlib import Path

import numpy as np

from ..base.errors import ShearboxError
from ..base.numerals import number

MOST_DISCS = 1000
TOUCHING = 1e-6  # as in src/core/grain_shape.h: largest gap between joined discs, over the smaller radius
LEAST_DIFFERENCE = 0.02  # as there: of centres and radii of two discs, over the smaller radius
_NAMED = {"single": [[0, 0, 1]], "triple": [[-1, 0, 1], [1, 0, 1], [0, 3**0.5, 1]]}
_STRIPS = 2000


def read_template(shape: str, path: Path) -> str:
    """The template that a model in the file `path` names; one from a file beside it has its discs put in."""
    kind, *rest = shape.split() or ["nothing"]
    if kind == "file" and len(rest) == 1:
        source = path.parent / rest[0]
        words = _discs_in(source)
        shape = " ".join(["discs", str(len(words) // 3), *words])
    elif kind == "discs" and len(rest) > 1 and rest[0].isdecimal() and rest[0].isascii():
        source, shape = path, " ".join([kind, str(int(rest[0])), *rest[1:]])
    elif shape in _NAMED:
        return shape
    else:
        raise ShearboxError(f"{path}: shape {shape}: single, triple, 'discs N x y r ...' or 'file NAME' is expected")
    try:
        _check(discs_of(shape))
    except ValueError as error:
        raise ShearboxError(f"{source}: the grain's template is wrong: {error}") from error
    return shape


def discs_of(shape: str) -> np.ndarray:
    """(discs, 3) x y r of a template without a file, in its own unit; ValueError if it is none."""
    kind, *words = shape.split()
    if kind in _NAMED:
        return np.array(_NAMED[kind])
    count, values = int(words[0]), [number(word) for word in words[1:]]
    if len(values) != 3 * count:
        raise ValueError(f"{count} discs with x y r are {3 * count} numbers, there are {len(values)}")
    return np.array(values).reshape(count, 3)


def area_over_largest(shape: str) -> float:
    """Area of the union of the discs over the square of the diameter of the largest one, to 0.1 %."""
    discs = discs_of(shape)
    x, y, r = ((discs - [*discs[0, :2], 0]) / np.max(discs[:, 2])).T
    at = np.min(y - r) + (np.arange(_STRIPS) + 0.5) * (np.max(y + r) - np.min(y - r)) / _STRIPS
    covered = sum(_covered(x, r, y - level) for level in at)
    return float(covered * (at[1] - at[0]) / 4)


def length_over_largest(shape: str) -> float:
    """The greatest distance across the grain over the diameter of its largest disc."""
    discs = discs_of(shape)
    apart = discs[:, None, :2] - discs[None, :, :2]
    r = discs[:, 2]
    return float(np.max(np.hypot(*apart.T) + r + r[:, None]) / (2 * np.max(r)))


def _covered(x: np.ndarray, r: np.ndarray, off: np.ndarray) -> float:
    """Length that the discs cover of a horizontal line, from which their centres are `off`."""
    cut = np.abs(off) < r
    half = np.sqrt(r[cut] ** 2 - off[cut] ** 2)
    left, right = x[cut] - half, x[cut] + half
    order = np.argsort(left)
    left, right = left[order], right[order]
    reached = np.maximum.accumulate(np.concatenate([[-np.inf], right]))[:-1]  # by those that begin further left
    return float(np.sum(np.maximum(0, right - np.maximum(left, reached))))


def _discs_in(source: Path) -> list[str]:
    """All words of a file of lines 'x y r'."""
    try:
        lines = source.read_text(encoding="utf-8", errors="replace").split("\n")
    except OSError as error:
        raise ShearboxError(f"{source}: {error.strerror}") from error
    words: list[str] = []
    for count, line in enumerate(lines, start=1):
        row = line.split("#")[0].split()
        if not (_is_disc(row) or not row) or not line.replace("\t", " ").rstrip("\r").isprintable():
            raise ShearboxError(
                f"{source}, line {count}: 'x y r' of a disc with r > 0 is expected, not {line.strip()[:60]!r}"
            )
        words += row
    return words


def _is_disc(row: list[str]) -> bool:
    try:
        _, _, radius = map(number, row)
    except ValueError:
        return False
    return radius > 0


def _check(discs: np.ndarray) -> None:
    """Refuse what the engine would; ValueError says why."""
    if not 1 <= len(discs) <= MOST_DISCS:
        raise ValueError(f"it has {len(discs)} discs, 1 to {MOST_DISCS} are allowed")
    x, y, r = discs.T
    if np.any(r <= 0):
        raise ValueError(f"disc {np.argmax(r <= 0) + 1} has the radius {r[r <= 0][0]:g}, it must be positive")
    apart = np.hypot(x[:, None] - x, y[:, None] - y)
    inside = (apart + r[:, None] <= r * (1 + 1e-12)) & ~np.eye(len(r), dtype=bool)
    if inside.any():
        inner, outer = np.argwhere(inside)[0] + 1
        raise ValueError(f"disc {inner} is a duplicate of, or lies inside, disc {outer}")
    alike = np.tril(apart + np.abs(r[:, None] - r) < LEAST_DIFFERENCE * np.minimum(r[:, None], r), -1)
    if alike.any():
        one, other = np.argwhere(alike)[0] + 1
        raise ValueError(
            f"disc {one} nearly coincides with disc {other}: distance of centres and difference of radii "
            "must add up to 2 % of the smaller radius"
        )
    joined = apart <= r[:, None] + r + TOUCHING * np.minimum(r[:, None], r)
    reached = joined[0]
    for _ in r:
        reached = joined[reached].any(axis=0)
    if not reached.all():
        raise ValueError(f"disc {np.argmin(reached) + 1} is disconnected from disc 1")
