# SPDX-License-Identifier: GPL-2.0-or-later
"""How long the phases of a run took: timings.json in its folder."""

import json
from contextlib import suppress
from pathlib import Path

from .errors import ShearboxError
from .files import TIMINGS, write_json

MOST_SECONDS = 1e9  # that a phase may have taken


def read_timings(folder: Path) -> dict[str, float]:
    """Seconds per phase, summed over all attempts; a damaged record costs the timings only."""
    try:
        timings = json.loads((folder / TIMINGS).read_text(encoding="utf-8"))
        return {
            label: float(s) for label, s in timings.items() if isinstance(s, (int, float)) and 0 <= s < MOST_SECONDS
        }
    except (OSError, ValueError, AttributeError, RecursionError):
        return {}


def add_time(folder: Path, label: str, seconds: float) -> float:
    """Add the seconds of a phase to those of earlier attempts; its total is returned."""
    timings = read_timings(folder)
    total = timings.get(label, 0.0) + seconds
    with suppress(ShearboxError):  # a full disk has more important things to say
        write_json(folder / TIMINGS, {**timings, label: round(total, 2)})
    return total
