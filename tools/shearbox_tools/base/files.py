# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that are whole or not there, and the names of the files of a run."""

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from .errors import ShearboxError

# what the tools write into the folder of a run
RECORD = "run.json"
LOCK = ".lock"
SUMS = "SHA256SUMS"  # in each folder of a phase
TIMINGS = "timings.json"
SUMMARY = "summary.json"
PAGE = "report.html"
DRAFT = ".draft"  # ending of a file that is being written
CURVE = "curve.csv"  # in the folder of a stress

# what the decks read and write; the head of each deck says so
PACKED = "packed"  # folder of the packing
PACKED_TABLE = "packed.csv"
PACKED_RESTART = "packed.restart"
CONSOLIDATED_TABLE = "consolidated.csv"
CONSOLIDATED_RESTART = "consolidated.restart"
SHEAR_TABLE = "shear.dat"
SHEARED_RESTART = "sheared.restart"
SHEAR_RESTART = "shear.restart"
GRAINS_DUMP = "grains.dump"
DISCS_DUMP = "discs.dump"
CONTACTS_DUMP = "contacts.dump"
CELLS_DUMP = "cells.dump"
DUMPS = (GRAINS_DUMP, DISCS_DUMP, CONTACTS_DUMP, CELLS_DUMP)
PICTURED = (GRAINS_DUMP, DISCS_DUMP, CONTACTS_DUMP)  # of what pictures are made
COLUMNS = ".columns"  # ending of the file beside a dump of an earlier version that names its columns


def stress_folder(folder: Path, sigma: float) -> Path:
    """Where consolidation and shear at sigma (kPa) leave their files."""
    return folder / f"{sigma:g}"


def log_file(folder: Path, deck: str) -> Path:
    """The engine's log of a deck's run."""
    return folder / f"{deck}.log"


def state_of(path: Path) -> tuple[int, ...]:
    """Numbers that change when the file is written to, or another takes its place: what was read of it holds until then."""
    try:
        status = path.stat()
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error
    return status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns


def sync(path: Path) -> None:
    """Wait until what was written to the file is on the disk, so that a power cut does not lose it."""
    with path.open("rb") as stream:
        os.fsync(stream.fileno())


def write_text(path: Path, text: str) -> None:
    """Write the file at once: an interruption or a full disk leaves the earlier one as it was."""
    draft = path.with_name(path.name + DRAFT)
    try:
        draft.unlink(missing_ok=True)
        # x follows no link that has come in between; paths may have what is no text
        with draft.open("x", encoding="utf-8", errors="replace") as stream:
            stream.write(text)
            stream.flush()
            os.fsync(stream.fileno())
        draft.replace(path)
    except OSError as error:
        with suppress(OSError):
            draft.unlink(missing_ok=True)
        raise ShearboxError(f"{path}: {error.strerror}") from error


@contextmanager
def drafted(path: Path) -> Iterator[Path]:
    """A file to be written in its stead, which takes its place when it is whole."""
    draft = path.with_name(path.name + DRAFT)
    try:
        yield draft
        draft.replace(path)
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error
    finally:
        draft.unlink(missing_ok=True)


def write_json(path: Path, content: Any) -> None:
    """JSON with one value a line; NaN is not JSON and is an error of ours."""
    write_text(path, json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n")
