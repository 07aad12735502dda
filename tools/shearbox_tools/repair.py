# SPDX-License-Identifier: GPL-2.0-or-later
"""Cutting off what a stopped engine left half written, before another one appends to it."""

import os
from collections.abc import Callable
from pathlib import Path

from .dumps import last_whole_byte
from .files import CONTACTS_DUMP, DISCS_DUMP, GRAINS_DUMP, SHEAR_RESTARTS, SHEAR_TABLE


def repair(folder: Path) -> None:
    """Cut each file that a continued phase appends to at the end of its last whole row or frame."""
    _cut(folder / SHEAR_TABLE, _last_line_end)
    for name in (GRAINS_DUMP, DISCS_DUMP, CONTACTS_DUMP):
        _cut(folder / name, last_whole_byte)
    _drop_lone_restart(folder)


def _cut(path: Path, find_end: Callable[[Path], int]) -> None:
    if path.is_file():
        size, end = path.stat().st_size, find_end(path)
        if end < size:
            os.truncate(path, end)


def _last_line_end(path: Path) -> int:
    return path.read_bytes().rfind(b"\n") + 1


def _drop_lone_restart(folder: Path) -> None:
    """Of two restart files the older one is whole; a single one may have been cut off while it was written."""
    found = [folder / name for name in SHEAR_RESTARTS if (folder / name).exists()]
    if len(found) == 1:
        found[0].unlink()
