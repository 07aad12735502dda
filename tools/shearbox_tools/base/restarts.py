# SPDX-License-Identifier: GPL-2.0-or-later
"""Restart files: what tells from outside that one of LAMMPS is whole, and of which step it is.

The format is that of LAMMPS's write_restart.cpp: a mark, byte order and revision; then entries, each a number that says
what it is and its value; at the very end the mark again. The step is the entry after the names of version and units. LIGGGHTS's have
no marks: they begin with the entry of the version.
"""

import os
import struct
from pathlib import Path

MARK = b"LammpS RestartT\0"
_START = struct.Struct("=16sii")  # mark, byte order, revision
_NUMBER = struct.Struct("=i")
_STEP = struct.Struct("=q")
_VERSION, _UNITS, _NTIMESTEP = 0, 4, 5  # entries, as lmprestart.h numbers them; texts have their length in front
_OF_LIGGGHTS = b"Version LIGGGHTS"  # after the number of the entry and its length
_HEAD = 4096  # bytes, more than the entries up to the step


def step_of(path: Path) -> int | None:
    """The step of a restart file; None if it is not there, or not whole."""
    try:
        with path.open("rb") as stream:
            head = stream.read(_HEAD)
            stream.seek(-len(MARK), os.SEEK_END)
            tail = stream.read()
        return _step(head) if head.startswith(MARK) and tail == MARK else None
    except (OSError, struct.error):
        return None


def is_whole(path: Path) -> bool:
    """Whether it can be read, as far as can be seen: one of LIGGGHTS has a beginning; its deck writes it before it says goodbye."""
    try:
        with path.open("rb") as stream:
            head = stream.read(2 * _NUMBER.size + len(_OF_LIGGGHTS))
    except OSError:
        return False
    return head[2 * _NUMBER.size :] == _OF_LIGGGHTS or step_of(path) is not None


def _step(head: bytes) -> int:
    at = _START.size
    while True:
        (entry,) = _NUMBER.unpack_from(head, at)
        at += _NUMBER.size
        if entry == _NTIMESTEP:
            return int(_STEP.unpack_from(head, at)[0])
        (value,) = _NUMBER.unpack_from(head, at)
        at += _NUMBER.size + (max(0, value) if entry in (_VERSION, _UNITS) else 0)
