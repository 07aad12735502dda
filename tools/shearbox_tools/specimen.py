# SPDX-License-Identifier: GPL-2.0-or-later
"""The specimen at one moment: its discs, and the forces between them; SI units."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .dumps import CONTACTS, DISCS, GRAINS, Dump
from .readers import Columns

GRAIN, WALL = 1, 2  # atom types of the decks


@dataclass(frozen=True)
class Moment:
    """One frame of the three dumps (contacts: the frame nearest to it)."""

    displacement: float  # mm
    discs: Columns
    contacts: Columns

    @property
    def walls(self) -> np.ndarray:
        """(discs,) whether a disc is of a wall."""
        return self.discs["type"] == WALL

    def branches(self) -> np.ndarray:
        """(contacts, 2, 2) from the one disc's centre to the other's, in m."""
        places = {key: i for i, key in enumerate(_keys(self.discs["id"], self.discs["disc"]))}
        ends = []
        for name in ("1", "2"):
            keys = _keys(self.contacts[f"id{name}"], self.contacts[f"disc{name}"])
            rows = [places[key] for key in keys]
            ends.append(np.column_stack([self.discs["x"][rows], self.discs["y"][rows]]))
        return np.stack(ends, axis=1) if len(ends[0]) else np.empty((0, 2, 2))


class Film:
    """The dumps of one shear phase; displacements (mm) of the frames come from the table of the phase."""

    def __init__(self, folder: Path, steps: np.ndarray, displacements: np.ndarray) -> None:
        self._discs = Dump(folder / "discs.dump", DISCS)
        self._contacts = Dump(folder / "contacts.dump", CONTACTS)
        first = self._discs.nearest(0)
        # rows of the table are averages over the interval that ends at their step: on average half of it ago
        self._steps = np.concatenate([[first], steps - np.diff(steps, prepend=first) / 2])
        self._displacements = np.concatenate([[0.0], displacements])

    def at(self, displacement: float) -> Moment:
        """The frame nearest to a displacement (mm)."""
        wanted = float(np.interp(displacement, self._displacements, self._steps))
        return self._moment(self._discs.nearest(wanted))

    def first(self) -> Moment:
        """The specimen before shear."""
        return self._moment(self._discs.steps[0])

    def last(self) -> Moment:
        """The specimen at the end, or as far as it has come."""
        return self._moment(self._discs.steps[-1])

    def _moment(self, step: int) -> Moment:
        displacement = float(np.interp(step, self._steps, self._displacements))
        return Moment(displacement, self._discs.frame(step), self._contacts.frame(self._contacts.nearest(step)))


def count_lost(folder: Path, total: int, width: float, half_height: float) -> int:
    """Grains that are gone, or have their centre outside the box by more than their radius, in the last frame.

    width and half_height in m: the inside of the upper half is 0 < x < width, and that of the lower half is the same
    moved by the shear displacement, which the floor tells.
    """
    dump = Dump(folder / "grains.dump", GRAINS)
    grains = dump.frame(dump.steps[-1])
    x, y, radius, walls = grains["x"], grains["y"], grains["radius"], grains["type"] == WALL
    shift = x[walls & (y < 0)].mean() - width / 2
    lid = y[walls & (y > half_height + 3 * radius[walls].max()) & (x > 0) & (x < width)]
    left = np.where(y > half_height, 0, shift)
    inside = (x > left - radius) & (x < left + width + radius) & (y > -radius)
    if len(lid):
        inside &= y < lid.min() + radius
    return total - int(np.sum(inside & ~walls))


def _keys(ids: np.ndarray, discs: np.ndarray) -> Iterator[tuple[int, int]]:
    return zip(ids.astype(int), discs.astype(int))
