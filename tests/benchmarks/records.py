# SPDX-License-Identifier: GPL-2.0-or-later
"""What was measured, a line of JSON each, so that an interruption costs at most the run it hits."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Generic, TypeVar

T = TypeVar("T")  # a dataclass of plain values


class Records(Generic[T]):
    """The records of a file, in the order in which they were added; a last line without its end does not count."""

    def __init__(self, file: Path, kind: type[T]) -> None:
        self.file = file
        text = file.read_text() if file.exists() else ""
        whole = text[: text.rfind("\n") + 1]
        if whole != text:
            file.write_text(whole)
        self.found = [kind(**json.loads(line)) for line in whole.splitlines()]

    def add(self, record: T) -> None:
        """Keeps a record."""
        self.found.append(record)
        with self.file.open("a") as stream:
            stream.write(json.dumps(asdict(record)) + "\n")
