# SPDX-License-Identifier: GPL-2.0-or-later
"""What is judged by rule: whether it holds, and the numbers that say so, with as many digits as it takes to see it."""

from collections.abc import Sequence
from dataclasses import dataclass

MOST_DIGITS = 15


@dataclass(frozen=True)
class Verdict:
    """Whether something holds and the numbers that say so; None: it is open, since it cannot be judged, or as `undecided` says."""

    holds: bool | None
    reason: str
    undecided: str = ""

    def in_doubt(self, doubt: str | None) -> "Verdict":
        """The same, or where there is a doubt about what it is judged by: not judged, with the numbers so far."""
        return Verdict(None, f"{doubt}; so far {self.reason}") if doubt else self


def of_all(judged: Sequence[tuple[float, Verdict]]) -> Verdict:
    """What must hold at every stress (kPa)."""
    if failed := [sigma for sigma, verdict in judged if verdict.holds is False]:
        return Verdict(False, f"not at {_listed(failed)}")
    if not judged:
        return Verdict(None, "cannot be judged at any stress")
    open_: dict[str, list[float]] = {}
    for sigma, verdict in judged:
        if verdict.holds is None:
            open_.setdefault(verdict.undecided, []).append(sigma)
    if open_:
        told = [
            f"open at {_listed(s)}: {why}" if why else f"cannot be judged at {_listed(s)}" for why, s in open_.items()
        ]
        return Verdict(None, "; ".join(told))
    where = {1: f"at {judged[0][0]:g} kPa", 2: "at both stresses"}
    return Verdict(True, where.get(len(judged), f"at all {len(judged)} stresses"))


def _listed(stresses: Sequence[float]) -> str:
    return ", ".join(f"{sigma:g} kPa" for sigma in stresses)


def told_apart(value: float, limit: float, digits: int, sign: str = "") -> str:
    """The value with at least `digits` decimals, and more where rounding would bring it to the limit or beyond."""
    for count in range(digits, MOST_DIGITS):
        text = f"{value:{sign}.{count}f}"
        if (float(text) > limit, float(text) < limit) == (value > limit, value < limit):
            return text
    return f"{value:{sign}.{MOST_DIGITS}f}"
