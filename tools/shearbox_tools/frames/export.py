# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox export`: frames of shear phases in the formats of other programs."""

import importlib
from collections.abc import Sequence
from pathlib import Path

from ..base.errors import InputError, ShearboxError
from ..base.files import write_text
from ..reading.readers import Columns
from .selection import choose, find_tests
from .table_files import write_csv, write_ovito, write_parquet
from .tables import GRID, NAMES, Instant, Tables

NEEDS = {  # modules, and where they are from; pyarrow 18 wants a newer NumPy than Debian 12 has
    "vtk": {"vtkmodules": "apt-get install python3-vtk9"},
    "parquet": {"pandas": "apt-get install python3-pandas", "pyarrow": "pip install 'pyarrow<18'"},
}
TIMES = "frames.csv"  # the series of all formats


def export(folder: Path, form: str, out: Path | None, stresses: Sequence[float], frames: str | None) -> list[Path]:
    """Write the frames of all tests in a folder, or of those of the stresses (kPa); the folders written are returned.

    frames: see `selection.choose`. What cannot be done is refused before anything is written. A file is whole or not there, and the
    series is written last; written again, files are replaced, and those of frames that are not chosen any more are removed.
    """
    _require_modules(form)
    opened = [(place, Tables(place)) for place in find_tests(folder, stresses)]
    chosen = [(place, tables, choose(frames, tables.steps)) for place, tables in opened]
    written = []
    for place, tables, steps in chosen:
        target = (out or folder / "export") / form / place.relative_to(folder)
        _write_test(target, form, tables, steps)
        written.append(target)
    return written


def _require_modules(form: str) -> None:
    for module, hint in NEEDS.get(form, {}).items():
        try:
            importlib.import_module(module)
        except ImportError as error:
            raise InputError(f"--to {form}: {error}; {hint}") from error


def _write_test(target: Path, form: str, tables: Tables, steps: list[int]) -> None:
    """Files are numbered as the frames of the dumps are, whichever of them are chosen."""
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ShearboxError(f"{target}: {error.strerror}") from error
    number = {step: k for k, step in enumerate(tables.steps)}
    instants = [tables.instant(step) for step in steps]
    names: list[str] = []
    earlier = _frames_in(target, form)
    for instant in instants:
        frame = tables.frame(instant.step)
        names = list(frame)
        for name, table in frame.items():
            file = target / _file(form, name, number[instant.step])
            _write(file, form, name, table, instant)
            earlier.discard(file)
    for file in earlier:
        file.unlink()
    if form == "vtk":
        from .vtk_files import write_series

        for name in names:
            files = [_file(form, name, number[step]) for step in steps]
            write_series(target / f"{name}.pvd", files, instants)
    write_text(
        target / TIMES, "frame,step,displacement_mm,time_s\n" + "".join(_row(number[i.step], i) for i in instants)
    )


def _row(number: int, instant: Instant) -> str:
    time = "" if instant.time_s is None else f"{instant.time_s:.9g}"
    return f"{number},{instant.step},{instant.displacement_mm:.9g},{time}\n"


def _file(form: str, name: str, number: int) -> str:
    ending = {"csv": "csv", "parquet": "parquet", "ovito": "dump", "vtk": "vtr" if name == GRID else "vtp"}[form]
    return f"{name}_{number:05}.{ending}"


def _frames_in(target: Path, form: str) -> set[Path]:
    """Of all frames that were written there before."""
    return {path for name in NAMES for path in target.glob(_file(form, name, 0).replace("0" * 5, "[0-9]" * 5))}


def _write(path: Path, form: str, name: str, table: Columns, instant: Instant) -> None:
    """Libraries that a format needs are imported for it alone."""
    if form == "vtk":
        from .vtk_files import write_grid, write_points

        if name == GRID:
            write_grid(path, table, instant)
        else:
            write_points(path, table, instant)
    elif form == "ovito":
        write_ovito(path, table, instant)
    elif form == "parquet":
        write_parquet(path, table)
    else:
        write_csv(path, table)
