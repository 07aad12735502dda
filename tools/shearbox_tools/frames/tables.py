# SPDX-License-Identifier: GPL-2.0-or-later
"""Frames of a shear phase as tables for other programs, with all columns of the dumps, in SI units."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..analysis.moments import lower_half_at
from ..base.files import CELLS_DUMP, CONTACTS_DUMP, DISCS_DUMP, GRAINS_DUMP, SHEAR_TABLE
from ..reading.dumps import CELLS, CONTACTS, DISCS, GRAINS, Dump
from ..reading.readers import Columns, read_shear

GRID = "cells"  # the table of the cells of a grid
NAMES = ("grains", "discs", "walls", "contacts", GRID)  # of the tables


@dataclass(frozen=True)
class Instant:
    """When a frame was written."""

    step: int
    displacement_mm: float  # of the lower half
    time_s: float | None  # since the start of shear; None in results of an earlier version


class Tables:
    """The dumps of a shear phase, frame by frame, with rows in the order of ids: in the dumps it changes as LAMMPS sorts atoms.

    grains    of grains.dump, walls left out; and rotation (rad), moved_x, moved_y (m), since the first frame
    discs     of discs.dump, walls left out; and rotation
    walls     of discs.dump: two discs of one id are the ends of a piece of a smooth wall
    contacts  of contacts.dump; and branch_x, branch_y (m), from the centre of grain 2 to that of grain 1. For a wall the
              point of contact stands for its centre: so the sum of force times branch is that of Love's mean stress
    cells     of cells.dump, if it is there: means over whole cells
    """

    def __init__(self, folder: Path) -> None:
        self._grains = Dump(folder / GRAINS_DUMP, GRAINS)
        self._discs = Dump(folder / DISCS_DUMP, DISCS)
        self._contacts = Dump(folder / CONTACTS_DUMP, CONTACTS)
        self._cells = Dump(folder / CELLS_DUMP, CELLS) if (folder / CELLS_DUMP).exists() else None
        self._shear = read_shear(folder / SHEAR_TABLE)
        self._first = self._grains.frame(self._grains.steps[0])

    @property
    def steps(self) -> list[int]:
        """Of the frames that all dumps have."""
        dumps = [self._grains, self._discs, self._contacts, *([self._cells] if self._cells else [])]
        return sorted(set.intersection(*(set(dump.steps) for dump in dumps)))

    def instant(self, step: int) -> Instant:
        """The displacement is that of the wall discs themselves: rows of the table are means over an interval."""
        moved = 1000 * (lower_half_at(self._grains.frame(step)) - lower_half_at(self._first))
        if "time_s" not in self._shear:
            return Instant(step, moved, None)
        return Instant(step, moved, step * float(self._shear["time_s"][-1] / self._shear["step"][-1]))

    def frame(self, step: int) -> dict[str, Columns]:
        """The tables of one frame, by name."""
        grains = _in_order(self._grains.whole_frame(step), "id")
        discs = _in_order(self._discs.whole_frame(step), "id", "disc")
        contacts = _in_order(self._contacts.whole_frame(step), "id1", "id2", "disc1", "disc2")
        grains |= {"rotation": self._since(grains, "angle")}
        grains |= {f"moved_{axis}": self._since(grains, axis) for axis in "xy"}
        grain = _rows_of(grains, discs["id"])
        discs |= {"rotation": grains["rotation"][grain]}
        of_wall = grains["wall"][grain] == 1
        tables = {
            "grains": _rows(grains, grains["wall"] == 0),
            "discs": _rows(discs, ~of_wall),
            "walls": _rows(discs, of_wall),
            "contacts": _with_branches(contacts, grains),
        }
        return tables | ({GRID: self._cells.whole_frame(step)} if self._cells else {})

    def _since(self, grains: Columns, column: str) -> np.ndarray:
        """By how much a column has changed since the first frame; 0 for what was not there."""
        _, now, before = np.intersect1d(grains["id"], self._first["id"], return_indices=True)
        change = np.zeros(len(grains["id"]))
        change[now] = grains[column][now] - self._first[column][before]
        return change


def _in_order(columns: Columns, *keys: str) -> Columns:
    """Sorted by the first key, then the second, and so on, of those that there are."""
    return _rows(columns, np.lexsort([columns[key] for key in reversed(keys) if key in columns]))


def _rows_of(grains: Columns, ids: np.ndarray) -> np.ndarray:
    """Where the grains of these ids are; grains are in the order of theirs."""
    return np.searchsorted(grains["id"], ids)


def _rows(columns: Columns, which: np.ndarray) -> Columns:
    return {name: column[which] for name, column in columns.items()}


def _with_branches(contacts: Columns, grains: Columns) -> Columns:
    first, second = _rows_of(grains, contacts["id1"]), _rows_of(grains, contacts["id2"])
    branches = {}
    for axis in "xy":
        ends = [np.where(grains["wall"][k] == 1, contacts[axis], grains[axis][k]) for k in (first, second)]
        branches[f"branch_{axis}"] = ends[0] - ends[1]
    return contacts | branches
