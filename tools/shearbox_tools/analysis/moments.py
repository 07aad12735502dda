# SPDX-License-Identifier: GPL-2.0-or-later
"""The specimen at one moment: its discs, the forces between them, and means over cells of a grid; SI units."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.errors import ShearboxError
from ..base.files import CELLS_DUMP, CONTACTS_DUMP, DISCS_DUMP, GRAINS_DUMP, PICTURED
from ..reading.dumps import CELLS, CONTACTS, DISCS, GRAINS, Dump
from ..reading.readers import Columns


@dataclass(frozen=True)
class Moment:
    """One frame of each dump (of the others, the frame nearest to that of the discs)."""

    displacement: float  # mm
    grains: Columns
    discs: Columns
    contacts: Columns
    cells: Columns | None  # each (layers, columns), from the floor up and from left to right; None: not there

    @property
    def walls(self) -> np.ndarray:
        """(discs,) whether a disc is of a wall."""
        return np.isin(self.discs["id"], self.grains["id"][self.grains["wall"] == 1])

    def rotation_since(self, first: "Moment") -> np.ndarray:
        """(discs,) angle (rad) that the grain of each disc has turned since another moment."""
        before = dict(zip(first.grains["id"], first.grains["angle"]))
        turned = {i: angle - before.get(i, angle) for i, angle in zip(self.grains["id"], self.grains["angle"])}
        return np.array([turned.get(i, 0.0) for i in self.discs["id"]])

    def moved_since(self, first: "Moment") -> float:
        """How far (m) the lower half has moved since another moment."""
        return lower_half_at(self.grains) - lower_half_at(first.grains)

    def branches(self) -> np.ndarray:
        """(contacts, 3, 2) from the centre of the one grain over the contact point to that of the other, in m."""
        row = {i: k for k, i in enumerate(self.grains["id"])}
        centres = np.column_stack([self.grains["x"], self.grains["y"]])
        ends = [centres[[row[i] for i in self.contacts[name]]] for name in ("id1", "id2")]
        points = np.column_stack([self.contacts["x"], self.contacts["y"]])
        return np.stack([ends[0], points, ends[1]], axis=1)


def lower_half_at(grains: Columns) -> float:
    """Mean x (m) of the wall discs of the lower half: all of them move alike."""
    return float(grains["x"][grains["lower"] == 1].mean())


def rows_of(present: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """A row of each wanted id, or any row of one that is not present."""
    order = np.argsort(present, kind="stable")
    return order[np.searchsorted(present, wanted, sorter=order).clip(max=len(order) - 1)]


def missing_frames(folder: Path) -> list[str]:
    """Files of the frames of a shear phase that are gone: they may be removed when they are no longer wanted."""
    return [name for name in PICTURED if not (folder / name).exists()]


class Film:
    """The dumps of one shear phase; displacements (mm) of the frames come from the table of the phase.

    grains, discs, contacts: columns that are read.
    """

    def __init__(
        self,
        folder: Path,
        steps: np.ndarray,
        displacements: np.ndarray,
        grains: tuple[str, ...] = GRAINS,
        discs: tuple[str, ...] = DISCS,
        contacts: tuple[str, ...] = CONTACTS,
    ) -> None:
        self._grains = Dump(folder / GRAINS_DUMP, grains)
        self._discs = Dump(folder / DISCS_DUMP, discs)
        self._contacts = Dump(folder / CONTACTS_DUMP, contacts)
        cells = folder / CELLS_DUMP
        self._cells = Dump(cells, CELLS) if cells.exists() else None
        first = self._discs.nearest(0)
        # rows of the table are averages over the interval that ends at their step: on average half of it ago
        self._steps = np.concatenate([[first], steps - np.diff(steps, prepend=first) / 2])
        self._displacements = np.concatenate([[0.0], displacements])

    @property
    def steps(self) -> list[int]:
        """Of the frames, ascending."""
        return self._discs.steps

    def at(self, displacement: float) -> Moment:
        """The frame nearest to a displacement (mm)."""
        return self.moment(float(np.interp(displacement, self._displacements, self._steps)))

    def first(self) -> Moment:
        """The specimen before shear."""
        return self.moment(self.steps[0])

    def last(self) -> Moment:
        """The specimen at the end, or as far as it has come."""
        return self.moment(self.steps[-1])

    def moment(self, wanted: float) -> Moment:
        """The frame nearest to a step."""
        step = self._discs.nearest(wanted)
        displacement = float(np.interp(step, self._steps, self._displacements))
        grains, discs, contacts = (d.frame(d.nearest(step)) for d in (self._grains, self._discs, self._contacts))
        return Moment(displacement, grains, discs, contacts, _grid(self._cells, step) if self._cells else None)


def _grid(dump: Dump, step: int) -> Columns:
    """Columns of the frame nearest to that step, each (layers, columns)."""
    cells = dump.frame(dump.nearest(step))
    x, y = np.unique(cells["x"]), np.unique(cells["y"])
    rows = np.array([cells["x"], cells["y"]])
    if (
        len(x) * len(y) != rows.shape[1]
        or np.any(rows != [np.tile(x, len(y)), np.repeat(y, len(x))])
        or rows.min() <= 0
    ):
        raise ShearboxError(f"{dump.path}: x and y of a frame are not those of the cells of a grid, along x first")
    return {name: column.reshape(len(y), len(x)) for name, column in cells.items()}


def count_lost(folder: Path, total: int, width: float, half_height: float) -> int:
    """Grains that are gone, or have their centre outside the box by more than their radius, in the last frame.

    width and half_height in m: the inside of the box is 0 < x < width, from y = 0 to the lid, and has moved below
    half_height as far as the discs of the lower half have.
    """
    dump = Dump(folder / GRAINS_DUMP, GRAINS)
    before, grains = dump.frame(dump.steps[0]), dump.frame(dump.steps[-1])
    x, y, radius = grains["x"], grains["y"], grains["radius"]
    moved = lower_half_at(grains) - lower_half_at(before)
    top = np.min((y - radius)[grains["lid"] == 1])
    left = np.where(y > half_height, 0, moved)
    inside = (x > left - radius) & (x < left + width + radius) & (y > -radius) & (y < top + radius)
    return total - int(np.sum(inside & (grains["wall"] == 0)))


def stress_tilt(folder: Path) -> float:
    """How much greater than its mean the normal stress is before shear at the right end of the box, as a share of it, by a straight
    line through its means over the columns of cells; at the left end it is as much less."""
    dump = Dump(folder / CELLS_DUMP, CELLS)
    cells = _grid(dump, dump.steps[0])
    x, stress = cells["x"][0], cells["stress_yy"].mean(axis=0)
    if len(x) < 2 or stress.mean() <= 0:
        return 0.0
    return float(np.polyfit(2 * x / (x[0] + x[-1]) - 1, stress, 1)[0] / stress.mean())
