# SPDX-License-Identifier: GPL-2.0-or-later
"""One run at a time in a folder: its lock, and who holds it."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from .errors import InputError, ShearboxError
from .files import LOCK

REMOVED = " (deleted)"  # as /proc marks the name of a file that is open but was removed


@contextmanager
def locked(folder: Path) -> Iterator[int]:
    """Make the folder and hold its lock, which engines that outlive this program keep too; yields its descriptor."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        descriptor = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o644)
    except OSError as error:
        raise InputError(f"--out {folder}: {error.strerror}") from error
    try:
        _take(descriptor, folder)
        yield descriptor
    finally:
        os.close(descriptor)


def _take(descriptor: int, folder: Path) -> None:
    lock = str(folder.resolve() / LOCK)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise ShearboxError(_in_use(folder, _who_has_open({lock, lock + REMOVED}))) from error
    except OSError as error:
        raise ShearboxError(
            f"{folder}: no file can be locked there ({error.strerror}), so two runs could meet in it: take --out on "
            "another file system"
        ) from error
    if others := _who_has_open({lock + REMOVED}):  # they hold a lock that was removed since
        raise ShearboxError(_in_use(folder, others))


def _in_use(folder: Path, others: dict[int, str]) -> str:
    text = f"{folder} is in use by another run"
    if not others:
        return f"{text}, on another machine or of another user"
    who = ", ".join(f"{number} ({name})" for number, name in others.items())
    return f"{text}: process {who}; wait for its end, or end it: kill {' '.join(map(str, others))}"


def _who_has_open(names: set[str]) -> dict[int, str]:
    """Number and name of the other processes that have one of the files open, as far as we may see."""
    others = {}
    for process in Path("/proc").glob("[0-9]*"):
        if int(process.name) == os.getpid():
            continue
        with suppress(OSError):  # it has ended, or is of another user
            if any(os.readlink(descriptor) in names for descriptor in (process / "fd").iterdir()):
                others[int(process.name)] = (process / "comm").read_text(encoding="utf-8", errors="replace").strip()
    return others
