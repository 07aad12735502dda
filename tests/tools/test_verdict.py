# SPDX-License-Identifier: GPL-2.0-or-later
"""What a verdict says: numbers beside it never look as if it were another."""

import pytest

from shearbox_tools.base.verdict import Verdict, of_all, told_apart


@pytest.mark.parametrize(
    "value, limit, digits, text",
    [
        (95.0, 90, 0, "95"),
        (89.96, 90, 0, "89.96"),
        (90.04, 90, 0, "90.04"),
        (90.0, 90, 0, "90"),
        (0.97951, 0.98, 3, "0.9795"),
        (0.9799996, 0.98, 3, "0.9799996"),
        (-0.0004, 0, 3, "-0.0004"),
        (float("nan"), 0, 1, "nan"),
    ],
)
def test_as_many_digits_as_it_takes(value: float, limit: float, digits: int, text: str) -> None:
    assert told_apart(value, limit, digits) == text


def test_a_doubt_leaves_the_numbers() -> None:
    verdict = Verdict(True, "τ is 95 %")
    assert verdict.in_doubt(None) is verdict
    assert verdict.in_doubt("sheared to 0.13 mm only") == Verdict(None, "sheared to 0.13 mm only; so far τ is 95 %")


@pytest.mark.parametrize(
    "stresses, words", [([100.0], "at 100 kPa"), ([100.0, 200], "at both stresses"), ([1.0, 2, 3], "at all 3 stresses")]
)
def test_what_holds_everywhere_says_where(stresses: list[float], words: str) -> None:
    assert of_all([(sigma, Verdict(True, "")) for sigma in stresses]) == Verdict(True, words)


def test_what_is_open_says_why() -> None:
    """That something cannot be judged, or that it is not decided."""
    undecided = Verdict(None, "-0.1 to 0.2", "the interval holds 0")
    judged = [(100.0, undecided), (200.0, Verdict(True, "")), (300.0, Verdict(None, "too short")), (400.0, undecided)]
    words = "open at 100 kPa, 400 kPa: the interval holds 0; cannot be judged at 300 kPa"
    assert of_all(judged) == Verdict(None, words)
    assert of_all([*judged, (500.0, Verdict(False, ""))]) == Verdict(False, "not at 500 kPa")
    assert undecided.in_doubt("too short").undecided == "", "then it cannot be judged"
