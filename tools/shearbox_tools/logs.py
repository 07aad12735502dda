# SPDX-License-Identifier: GPL-2.0-or-later
"""What a LAMMPS log tells about the program and about where its time went."""

import re
from dataclasses import dataclass, field
from pathlib import Path

from .numerals import number

_LOOP = re.compile(r"^Loop time of (\S+) on (\d+) procs for (\d+) steps", re.MULTILINE)
_MOST = 1e18  # seconds or steps: more is no log of ours
_SHARE = re.compile(r"^(Pair|Neigh|Comm|Output|Modify|Other)\s*\|[^|]*\|([^|]*)\|", re.MULTILINE)


@dataclass
class Log:
    """Versions, and seconds of the runs in it; an unreadable log has neither."""

    lammps: str | None = None
    shearbox: str | None = None
    steps: int = 0
    seconds: float = 0.0
    parts: dict[str, float] = field(default_factory=dict)  # seconds (mean over the ranks) by part of the step

    @property
    def greatest_parts(self) -> str:
        """The three parts of the step that cost most, in percent."""
        if not self.seconds:
            return "–"
        ranked = sorted(self.parts.items(), key=lambda item: -item[1])[:3]
        return ", ".join(f"{part.lower()} {100 * seconds / self.seconds:.0f}\u00a0%" for part, seconds in ranked)


def read_log(path: Path) -> Log:
    """Sums over all runs of a log."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return Log()
    log = Log(_first(r"^LAMMPS \(([^)]*)\)", text), _first(r"^Shearbox (.*)$", text))
    for seconds, _, steps in _LOOP.findall(text):
        log.seconds += _amount(seconds)
        log.steps += int(_amount(steps))
    for part, seconds in _SHARE.findall(text):
        log.parts[part] = log.parts.get(part, 0.0) + _amount(seconds.strip())
    log.parts["Other"] = max(0.0, log.seconds - sum(log.parts.values()))
    return log


def read_logs(path: Path) -> Log:
    """The log of a phase and those of its earlier attempts (NAME.1, NAME.2, ...)."""
    total = read_log(path)
    for earlier in path.parent.glob(path.name + ".*"):
        log = read_log(earlier)
        total.steps += log.steps
        total.seconds += log.seconds
        for part, spent in log.parts.items():
            total.parts[part] = total.parts.get(part, 0.0) + spent
    return total


def _amount(text: str) -> float:
    """A number as the engine writes it; 0 for what is none, as the mean of "Other", which is in the next column."""
    try:
        value = number(text)
    except ValueError:
        return 0.0
    return value if 0 <= value < _MOST else 0.0


def _first(pattern: str, text: str) -> str | None:
    match = re.search(pattern, text, re.MULTILINE)
    return match.group(1).strip() if match else None
