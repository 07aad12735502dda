# SPDX-License-Identifier: GPL-2.0-or-later
"""Reading single frames out of LAMMPS dumps that may be much larger than a frame."""

import mmap
import os
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.errors import ShearboxError
from ..base.files import COLUMNS
from ..base.ranges import require_ranges
from ..base.seals import refuse_altered
from .readers import Columns, parse_numbers, require, short

GRAINS = ("id", "x", "y", "radius", "angle", "wall", "lower", "lid")  # columns that are needed
DISCS = ("id", "disc", "x", "y", "radius")
CONTACTS = ("id1", "id2", "x", "y", "fn")
CELLS = ("x", "y", "solid", "stress_xx", "stress_yy", "stress_xy")

_FRAME = re.compile(rb"ITEM: TIMESTEP\r?\n")
_LAST_OF_HEAD = (b"ITEM: ATOMS", b"ITEM: ENTRIES")
_LONGEST_HEAD = 4096  # bytes
_ENDLESS = 1 << 62
_REFERENCE = re.compile(r"[cfv]_([^\[]+)(?:\[(\d+)\])?")


@dataclass(frozen=True)
class _Head:
    """What stands above the rows of a frame."""

    step: int
    count: int  # rows
    names: list[str]
    lines: int  # of the head itself


class Dump:
    """A dump, of which the given columns are read, by their names.

    A column has the name of what it is taken from: v_angle is the variable angle. In dumps of an earlier version, c_discs[3]
    is the third of the names in the file discs.columns beside the dump.

    After an interruption some frames are written again: the last frame of a step counts. A last frame that is not
    whole is what an engine that was stopped leaves behind, and is left out; anywhere else it is an error.
    """

    def __init__(self, path: Path, columns: tuple[str, ...] = ()) -> None:
        self.path = path
        self.columns = columns
        self._names_file = path.with_suffix(COLUMNS)
        for file in (path, self._names_file):
            refuse_altered(file)
        self._given = (
            self._names_file.read_text(encoding="utf-8", errors="replace").split() if self._names_file.exists() else []
        )
        self._blocks = self._read_index()

    @property
    def steps(self) -> list[int]:
        """Steps of the whole frames, ascending; there is at least one."""
        if not self._blocks:
            raise ShearboxError(f"{self.path}: there is no whole frame in it")
        return sorted(self._blocks)

    def nearest(self, step: float) -> int:
        """The step that has a frame and is nearest to the given one."""
        return min(self.steps, key=lambda s: abs(s - step))

    def cut(self, step: int) -> None:
        """Cut the file off after the frame of that step."""
        os.truncate(self.path, self._blocks[step][1])

    def frame(self, step: int) -> Columns:
        """Columns of the frame of that step, each (rows,), in the units of the dump."""
        return self._read(step, self.columns)

    def whole_frame(self, step: int) -> Columns:
        """All columns of the frame of that step, by their names."""
        return self._read(step, None)

    def _read(self, step: int, wanted: tuple[str, ...] | None) -> Columns:
        start, end = self._blocks[step]
        with self.path.open("rb") as stream:
            stream.seek(start)
            lines = stream.read(end - start).splitlines()
        head = self._head(lines, start)
        names = [self._name(word) for word in head.names]
        require(names, self.columns, self.path, self._hint(names))
        body = [line.decode(errors="replace") for line in lines[head.lines : head.lines + head.count]]
        table = self._table(body, head, start)
        columns = {name: table[:, names.index(name)] for name in (names if wanted is None else wanted)}
        require_ranges(columns, self.path)
        return columns

    def _read_index(self) -> dict[int, tuple[int, int]]:
        """Bytes from and to of the last whole frame of each step."""
        try:
            with self.path.open("rb") as stream:
                if not stream.seek(0, 2):
                    raise ShearboxError(f"{self.path}: the file is empty")
                with mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data:
                    return self._index(data)
        except OSError as error:
            raise ShearboxError(f"{self.path}: {error.strerror}") from error

    def _index(self, data: mmap.mmap) -> dict[int, tuple[int, int]]:
        starts = _frame_starts(data)
        if not starts or starts[0] != 0:
            first = data[: data.find(b"\n") + 1].decode(errors="replace")
            raise ShearboxError(f"{self.path}, line 1: 'ITEM: TIMESTEP' is expected, not {short(first)}")
        index = {}
        for start, end in zip(starts, [*starts[1:], len(data)]):
            text = data[start:end]
            head = self._head(text[:_LONGEST_HEAD].splitlines(), start)
            rows = text.count(b"\n") - head.lines
            if rows == head.count:
                index[head.step] = (start, end)
            elif rows > head.count or end < len(data):
                line = self._line_number(start)
                raise ShearboxError(f"{self.path}, line {line}: a frame of {rows} rows that should have {head.count}")
        return index

    def _head(self, lines: list[bytes], offset: int) -> _Head:
        """Step, number of rows and names of the columns; a head that is cut off asks for more rows than there are."""
        last = next((i for i, line in enumerate(lines) if line.startswith(_LAST_OF_HEAD)), None)
        if last is None or last < 4:
            return _Head(-1, _ENDLESS, [], 0)
        return _Head(
            self._integer(lines, 1, offset),
            self._integer(lines, 3, offset),
            lines[last].decode(errors="replace").split()[2:],
            last + 1,
        )

    def _integer(self, lines: list[bytes], index: int, offset: int) -> int:
        value = _whole(lines[index])
        if value is None:
            line, text = self._line_number(offset) + index, lines[index].decode(errors="replace")
            raise ShearboxError(f"{self.path}, line {line}: a whole number is expected, not {short(text)}")
        return value

    def _hint(self, names: list[str]) -> str:
        nameless = [name for name in names if name.endswith("]")]
        return f"; {self._names_file.name} could say what {nameless[0]} is, but does not" if nameless else ""

    def _name(self, word: str) -> str:
        """What a column is called, or the word that stands for it if nothing gives it a name."""
        reference = _REFERENCE.fullmatch(word)
        if not reference:
            return word
        name, number = reference.groups()
        if number is None:
            return name
        return dict(enumerate(self._given, start=1)).get(int(number), word)

    def _table(self, body: list[str], head: _Head, offset: int) -> np.ndarray:
        """(rows, columns) numbers; the exact line of a damage is only looked for when there is one."""
        if not body:
            return np.empty((0, len(head.names)))
        try:
            table = np.loadtxt(body, ndmin=2)
            if table.shape == (len(body), len(head.names)) and np.all(np.isfinite(table)):
                return table
        except ValueError:
            pass
        first = self._line_number(offset) + head.lines
        return np.array([parse_numbers(s, len(head.names), self.path, first + i) for i, s in enumerate(body)])

    def _line_number(self, offset: int) -> int:
        """Number of the line that begins at that byte."""
        with self.path.open("rb") as stream:
            return stream.read(offset).count(b"\n") + 1


def _whole(word: bytes) -> int | None:
    """The whole number of a line, or None."""
    return int(word) if re.fullmatch(rb"\s*[0-9]{1,18}\s*", word) else None


def _frame_starts(data: bytes | mmap.mmap) -> list[int]:
    """Where lines begin that begin a frame; a pattern for the beginning of a line takes many times as long."""
    found = (match.start() for match in _FRAME.finditer(data))
    return [at for at in found if at == 0 or data[at - 1 : at] == b"\n"]
