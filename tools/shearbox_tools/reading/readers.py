# SPDX-License-Identifier: GPL-2.0-or-later
"""Reading the tables that the decks write; a damaged file is named together with the line that is wrong."""

import math
import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..base.errors import ShearboxError
from ..base.numerals import number
from ..base.ranges import require_ranges
from ..base.seals import refuse_altered

# Columns of shear.dat without which there is no report; it puts all others into its curves, too.
NEEDED = ("step", "displacement_mm", "tau_kPa", "sigma_kPa", "lid_mm", "trm", "work_J", "residual_J")
# Columns of packed.csv and consolidated.csv.
BED = ("grains", "height_m", "solid_fraction", "solid_fraction_bottom", "solid_fraction_top", "unbalanced", "kinetic_J",
       "steps")  # fmt: skip

Columns = dict[str, np.ndarray]


def read_shear(path: Path) -> Columns:
    """Block averages over the shear phase, in order of the steps, by the names that the header gives.

    Rows are of evenly spaced steps, the first as far from 0; missing ones are an error. After a continuation by hand
    there is a second header, and some steps are written again: the last row of a step counts. A last line without its
    end is what an engine that was stopped leaves behind, and is left out.
    """
    refuse_altered(path)
    names: list[str] = []
    rows: dict[int, list[float]] = {}
    for where, line in enumerate(_whole_lines(path), start=1):
        if line.startswith("#"):
            names = _header(line, names, path, where)
        elif line.strip():
            if not names:
                raise ShearboxError(f"{path}, line {where}: a header '# step ...' is expected, not {short(line)}")
            row = parse_numbers(line, len(names), path, where)
            rows[int(row[names.index("step")])] = row
    if not rows:
        raise ShearboxError(f"{path}: there are no rows of data in it")
    _refuse_gaps(sorted(rows), path)
    table = dict(zip(names, np.array([rows[step] for step in sorted(rows)]).T))
    require_ranges(table, path)
    return table


def _refuse_gaps(steps: list[int], path: Path) -> None:
    between = min(np.diff([0, *steps]))
    for before, step in zip([0, *steps], steps):
        if step != before + between:
            raise ShearboxError(f"{path}: the rows between the steps {before} and {step} are missing")


def cut_rows(path: Path, step: int) -> None:
    """Cut the table off after the row of that step, and a last line that has no end."""
    end = 0
    with path.open("rb") as stream:
        for line in stream:
            if not line.endswith(b"\n"):
                break
            if line.strip() and not line.startswith(b"#") and float(line.split()[0]) > step:
                break
            end += len(line)
    os.truncate(path, end)


def _header(line: str, before: list[str], path: Path, number: int) -> list[str]:
    """The names in a header line, which must be the same wherever it is repeated."""
    names = line.lstrip("#").split()
    if before and names != before:
        raise ShearboxError(f"{path}, line {number}: the header is no longer '{' '.join(before)}': {short(line)}")
    require(names, NEEDED, path)
    return names


def require(names: Sequence[str], needed: Sequence[str], path: Path, hint: str = "") -> None:
    """Refuse a file that lacks columns, or names one twice."""
    missing = [name for name in needed if name not in names]
    if missing:
        raise ShearboxError(f"{path}: there is no column {', '.join(missing)}; the columns are {' '.join(names)}{hint}")
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ShearboxError(f"{path}: there are several columns {', '.join(twice)}")


def last_value(path: Path, column: str) -> float | None:
    """The value of a column of shear.dat in its last whole row, without reading the others; None when there is none."""
    try:
        with path.open("rb") as stream:
            names = stream.readline().decode(errors="replace").lstrip("#").split()
            size = stream.seek(0, os.SEEK_END)
            stream.seek(max(0, size - 1000))
            lines = stream.read().split(b"\n")[:-1]
        row = next(line.split() for line in reversed(lines) if not line.startswith(b"#"))
        return number(row[names.index(column)].decode())
    except (OSError, StopIteration, IndexError, ValueError):
        return None


def read_row(path: Path) -> dict[str, float]:
    """The one row of numbers of the csv file of a packing or a consolidation."""
    refuse_altered(path)
    lines = [line.replace(",", " ") for line in _whole_lines(path) if line.strip()]
    if len(lines) < 2:
        raise ShearboxError(f"{path}: a header and a row of numbers are expected, there are {len(lines)} whole lines")
    header = lines[0].split()
    values = parse_numbers(lines[1], len(header), path, 2)
    require(header, BED, path)
    row = dict(zip(header, values))
    require_ranges(row, path)
    return row


def parse_numbers(line: str, count: int, path: Path, at: int) -> list[float]:
    """The `count` finite numbers of line `at` of the file."""
    words = line.split()
    if len(words) != count:
        raise ShearboxError(f"{path}, line {at}: {count} values are expected, there are {len(words)}: {short(line)}")
    try:
        values = [float(word) for word in words]
    except ValueError as error:
        raise ShearboxError(f"{path}, line {at}: not a number in {short(line)}") from error
    if not all(map(math.isfinite, values)):
        raise ShearboxError(f"{path}, line {at}: a value that is not finite in {short(line)}")
    if not line.isascii() or "_" in line:  # float() takes 1_000, and digits of other alphabets
        raise ShearboxError(f"{path}, line {at}: not a number in {short(line)}")
    return values


def short(line: str) -> str:
    """A line as it is quoted in a message."""
    text = line.strip()
    return repr(text if len(text) <= 60 else text[:57] + "...")


def _whole_lines(path: Path) -> list[str]:
    """Lines of the file, less a last one without its end."""
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines(keepends=True)
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error
    return lines if not lines or lines[-1].endswith("\n") else lines[:-1]
