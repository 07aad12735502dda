# SPDX-License-Identifier: GPL-2.0-or-later
"""Reading the tables that the decks write; a damaged file is named together with the line that is wrong."""

from pathlib import Path

import numpy as np

from .errors import ShearboxError

SHEAR_COLUMNS = (
    "step",
    "displacement_mm",
    "tau_kPa",
    "sigma_kPa",
    "lid_mm",
    "tau_upper_kPa",
    "trm",
    "kinetic_J",
    "dangerous",
    "work_J",
    "residual_J",
)

Columns = dict[str, np.ndarray]


def read_shear(path: Path) -> Columns:
    """Block averages over the shear phase, in order of the steps.

    After an interruption some steps are written again: the last row of a step counts. A last line without its end
    is what an engine that was stopped leaves behind, and is left out.
    """
    rows: dict[int, list[float]] = {}
    for number, line in enumerate(_whole_lines(path), start=1):
        if not line.strip() or line.startswith("#"):
            continue
        row = parse_numbers(line, len(SHEAR_COLUMNS), path, number)
        rows[int(row[0])] = row
    if not rows:
        raise ShearboxError(f"{path}: there are no rows of data in it")
    table = np.array([rows[step] for step in sorted(rows)])
    return dict(zip(SHEAR_COLUMNS, table.T))


def read_row(path: Path) -> dict[str, float]:
    """The one row of numbers of a csv file with a header."""
    lines = [line.replace(",", " ") for line in _whole_lines(path) if line.strip()]
    if len(lines) < 2:
        raise ShearboxError(f"{path}: a header and a row of numbers are expected, there are {len(lines)} whole lines")
    header = lines[0].split()
    return dict(zip(header, parse_numbers(lines[1], len(header), path, 2)))


def parse_numbers(line: str, count: int, path: Path, number: int) -> list[float]:
    """The `count` finite numbers of line `number` of the file."""
    words = line.split()
    if len(words) != count:
        raise ShearboxError(
            f"{path}, line {number}: {count} values are expected, there are {len(words)}: {short(line)}"
        )
    try:
        values = [float(word) for word in words]
    except ValueError as error:
        raise ShearboxError(f"{path}, line {number}: not a number in {short(line)}") from error
    if not np.all(np.isfinite(values)):
        raise ShearboxError(f"{path}, line {number}: a value that is not finite in {short(line)}")
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
