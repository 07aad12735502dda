# SPDX-License-Identifier: GPL-2.0-or-later
"""What a LAMMPS log tells about the program and about where its time went."""

import re
from dataclasses import dataclass, field
from pathlib import Path

_NUMBER = r"\d{1,15}(?:\.\d*)?(?:e[-+]?\d\d)?"
_LOOP = re.compile(rf"^Loop time of ({_NUMBER}) on (\d{{1,9}}) procs for (\d{{1,18}}) steps", re.MULTILINE)
# "Other" has its mean in the next column, and is not looked for; the second form is LIGGGHTS's
_LIGGGHTS = r"^LIGGGHTS \(Version LIGGGHTS-PUBLIC ([^,]*),"
_SHARE = re.compile(
    rf"^(Pair|Neigh|Comm|Output|Modify)\s*(?:\|[^|]*\||time \(%\) =)\s*({_NUMBER})\s*[|(]", re.MULTILINE
)


@dataclass
class Log:
    """Versions, and seconds of the runs in it; an unreadable log has neither."""

    host: str | None = None  # of LAMMPS or LIGGGHTS
    shearbox: str | None = None
    steps: int = 0
    seconds: float = 0.0
    core_seconds: float = 0.0  # of all ranks together
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
    log = Log(_first(r"^LAMMPS \(([^)]*)\)", text) or _first(_LIGGGHTS, text), _first(r"^Shearbox (.*)$", text))
    for seconds, ranks, steps in _LOOP.findall(text):
        log.seconds += float(seconds)
        log.core_seconds += float(seconds) * int(ranks)
        log.steps += int(steps)
    for part, seconds in _SHARE.findall(text):
        log.parts[part] = log.parts.get(part, 0.0) + float(seconds)
    log.parts["Other"] = max(0.0, log.seconds - sum(log.parts.values()))
    return log


def read_logs(path: Path) -> Log:
    """The log of a phase and those of its earlier attempts (NAME.1, NAME.2, ...)."""
    total = read_log(path)
    for earlier in path.parent.glob(path.name + ".*"):
        log = read_log(earlier)
        total.steps += log.steps
        total.seconds += log.seconds
        total.core_seconds += log.core_seconds
        for part, spent in log.parts.items():
            total.parts[part] = total.parts.get(part, 0.0) + spent
    return total


def _first(pattern: str, text: str) -> str | None:
    match = re.search(pattern, text, re.MULTILINE)
    return match.group(1).strip() if match else None
