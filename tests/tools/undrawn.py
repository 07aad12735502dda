#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox`, whose reports have no pictures: to draw them takes longer than all else, and has tests of its own."""

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

REPORTING = "shearbox_tools.reports.report_on"


class Undrawn(dict[str, str]):
    """An empty picture for each name."""

    def __missing__(self, name: str) -> str:
        return ""


DRAWING = {
    name: lambda *_: Undrawn() for name in ("_diagrams", "draw_specimens", "draw_maps", "film_of")
}  # of the module run_report


def report_on(*words: Any, **options: Any) -> Path:
    """In place of that of report_on.py, which is loaded when there is something to report, as ever."""
    del sys.modules[REPORTING]
    from shearbox_tools.reports import report_on, run_report

    vars(run_report).update(DRAWING)
    return report_on.report_on(*words, **options)


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
    from shearbox_tools.commands.cli import main

    sys.modules[REPORTING] = SimpleNamespace(report_on=report_on)  # type: ignore[assignment]
    sys.exit(main())
