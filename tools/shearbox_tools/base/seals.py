# SPDX-License-Identifier: GPL-2.0-or-later
"""Checksums of files that are whole, so that damage is seen before anyone reads them.

They are in SHA256SUMS beside the files, where `sha256sum -c SHA256SUMS` checks them too; size and time of a file are in a comment,
by which it is known at once, without reading it, that nobody wrote to it. A file is sealed while nobody writes to it; before an
engine writes to it again the seal is taken off.
"""

import hashlib
import re
from collections.abc import Iterable
from enum import Enum
from functools import cache
from pathlib import Path
from typing import NamedTuple

from .errors import ShearboxError
from .files import SUMS, state_of, sync, write_text

_LINE = re.compile(r"^([0-9a-f]{64})  (\S+)$(?:\n# (\d+ bytes, \d+ ns)$)?", re.MULTILINE)


class _Sealed(NamedTuple):
    """What is kept of a file; in folders of an earlier version without its state."""

    digest: str
    state: str


class Seal(Enum):
    """What is known of a file."""

    INTACT = "as it was sealed"
    ALTERED = "not as it was sealed"
    MISSING = "not there"
    UNKNOWN = "never sealed"


def seal(folder: Path, names: Iterable[str]) -> None:
    """Seal those of the files that are there, once they are on the disk; forget what is not there any more."""
    there = [name for name in names if (folder / name).is_file()]
    for name in there:
        try:
            sync(folder / name)
        except OSError as error:
            raise ShearboxError(f"{folder / name}: {error.strerror}") from error
    known = {name: sealed for name, sealed in _read(folder).items() if (folder / name).exists()}
    _write(folder, known | {name: _Sealed(_digest_of(folder / name), _state(folder / name)) for name in there})


def unseal(folder: Path, names: Iterable[str]) -> None:
    """Forget what is known of the files."""
    _write(folder, {name: sealed for name, sealed in _read(folder).items() if name not in set(names)})


def look_at(path: Path, at_once: bool = False) -> Seal:
    """Compare a file with its seal; `at_once`: one with the size and time of then is not read."""
    if not path.is_file():
        return Seal.MISSING
    sealed = _read(path.parent).get(path.name)
    if sealed is None:
        return Seal.UNKNOWN
    same = (at_once and sealed.state == _state(path)) or sealed.digest == _digest_of(path)
    return Seal.INTACT if same else Seal.ALTERED


def refuse_altered(path: Path) -> None:
    """Raise ShearboxError for a file that is not as it was sealed."""
    if look_at(path) is Seal.ALTERED:
        raise ShearboxError(
            f"{path} has changed since it was written ({SUMS} beside it): "
            "'shearbox run' with the options of before makes it anew"
        )


def _read(folder: Path) -> dict[str, _Sealed]:
    """By name; a damaged list is an empty one, or has wrong digests."""
    try:
        text = (folder / SUMS).read_text(encoding="utf-8", errors="replace")
    except OSError:
        return {}
    return {name: _Sealed(digest, state) for digest, name, state in _LINE.findall(text)}


def _write(folder: Path, known: dict[str, _Sealed]) -> None:
    if known != _read(folder):
        lines = [f"{one.digest}  {name}\n" + (f"# {one.state}\n" if one.state else "") for name, one in known.items()]
        write_text(folder / SUMS, "".join(lines))


def _state(path: Path) -> str:
    _, size, written, _ = state_of(path)
    return f"{size} bytes, {written} ns"


def _digest_of(path: Path) -> str:
    try:
        return _digest(path, *state_of(path))
    except OSError as error:
        raise ShearboxError(f"{path}: {error.strerror}") from error


@cache
def _digest(path: Path, *_: int) -> str:
    """Of the file in that state (state_of): dumps are large, and asked for several times."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
