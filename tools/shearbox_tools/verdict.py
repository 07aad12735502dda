# SPDX-License-Identifier: GPL-2.0-or-later
"""What is judged by rule: whether it holds, and the numbers that say so, with as many digits as it takes to see it."""

from collections.abc import Sequence
from dataclasses import dataclass

MOST_DIGITS = 15


@dataclass(frozen=True)
class Verdict:
    """Whether something holds (None: cannot be judged) and the numbers that say so."""

    holds: bool | None
    reason: str

    def in_doubt(self, doubt: str | None) -> "Verdict":
        """The same, or where there is a doubt about what it is judged by: not judged, with the numbers so far."""
        return Verdict(None, f"{doubt}; so far {self.reason}") if doubt else self


def of_all(judged: Sequence[tuple[float, bool | None]]) -> Verdict:
    """What must hold at every stress (kPa)."""
    failed, open_ = ([f"{sigma:g} kPa" for sigma, holds in judged if holds is what] for what in (False, None))
    if failed:
        return Verdict(False, f"not at {', '.join(failed)}")
    if open_ or not judged:
        return Verdict(None, f"cannot be judged at {', '.join(open_) or 'any stress'}")
    where = {1: f"at {judged[0][0]:g} kPa", 2: "at both stresses"}
    return Verdict(True, where.get(len(judged), f"at all {len(judged)} stresses"))


def told_apart(value: float, limit: float, digits: int, sign: str = "") -> str:
    """The value with at least `digits` decimals, and more where rounding would bring it to the limit or beyond."""
    for count in range(digits, MOST_DIGITS):
        text = f"{value:{sign}.{count}f}"
        if (float(text) > limit, float(text) < limit) == (value > limit, value < limit):
            return text
    return f"{value:{sign}.{MOST_DIGITS}f}"
