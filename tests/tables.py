# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables in Markdown, and what has measured them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def table(head: Iterable[str], rows: Iterable[Iterable[str]], spaced: bool = False) -> str:
    """With a space on either side of each cell, or none where a cell is empty and in the rule below the head."""
    names = [*head]
    rule = "|" + (" --- |" if spaced else "---|") * len(names)
    return "\n".join([row(names, spaced), rule, *(row(cells, spaced) for cells in rows)])


def row(cells: Iterable[str], spaced: bool = False) -> str:
    """A line of such a table."""
    return "|" + "".join(f" {cell} |" if cell or spaced else " |" for cell in cells)


def measured_by(script: str, *words: str) -> str:
    """The command of a script of the tests (its __file__)."""
    return f"Measured by `{' '.join([str(Path(script).resolve().relative_to(ROOT)), *words])}`"
