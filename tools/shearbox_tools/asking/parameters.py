# SPDX-License-Identifier: GPL-2.0-or-later
"""The variables that a run may set: input/parameters.in says what each is and, in [ ], what it may be."""

import difflib
import math
import re
from dataclasses import dataclass
from pathlib import Path

from ..base.errors import InputError, ShearboxError
from ..base.numerals import number, numeral
from .models import INPUT, PARAMETERS, RANGE, ROOT, definitions, lines

PACK_DECK, SHEAR_DECK = INPUT / "pack.in", INPUT / "shear.in"
_OF_THE_MODEL = re.compile(r"^#   (\w+) +(.*\])$")
# The tools themselves read these.
_NEEDED = ("seed", "flanges", "kn", "ks", "hn", "hs", "density", "thickness", "stiffness", "law", "dt", "dt_max",
           "phi_packing")  # fmt: skip
# What changes nothing as long as another has this value.
_IDLE_WHILE = (("phi_wall", "ks_wall", "0"), ("ks_wall", "phi_wall", "0"), ("side_pitch", "sides", "smooth"))


@dataclass(frozen=True)
class Parameter:
    """A variable of the decks: `value` is that of parameters.in, or None if the model's file has it."""

    name: str
    value: str | None
    meaning: str
    allowed: str  # as the deck says it
    words: tuple[str, ...] = ()  # that it may be; more may follow one that ends in ...
    low: float = math.inf  # a number may be from low to high
    high: float = -math.inf
    whole: bool = False

    def problem(self, value: str | float) -> str | None:
        """What is wrong with a value; None if nothing is."""
        first, *more = str(value).split() or [""]
        if (f"{first} ..." if more else first) in self.words:
            return None
        try:
            amount = number(str(value))
            if self.low <= amount <= self.high and not (self.whole and amount != int(amount)):
                return None
        except ValueError:
            pass
        shown = f"{value:g}" if isinstance(value, float) else value
        return f"{self.name} {shown}: {self.allowed} is expected: {self.meaning}"


def parameters(path: Path = PARAMETERS) -> dict[str, Parameter]:
    """All of them by name, those of the model last."""
    listed: list[tuple[str, str | None, str]] = [(name, value, said) for name, _, value, said in definitions(path)]
    listed += [(name, None, said) for line in lines(path) for name, said in _OF_THE_MODEL.findall(line)]
    known = {name: _parameter(name, value, said) for name, value, said in listed if RANGE.search(said)}
    missing = [name for name in _NEEDED if name not in known]
    if missing:
        raise ShearboxError(f"{path}: there is no variable {', '.join(missing)} with what it may be in [ ]")
    return known


def _parameter(name: str, value: str | None, comment: str) -> Parameter:
    found = RANGE.search(comment)
    assert found
    words, low, high = [], math.inf, -math.inf
    for choice in found[1].split(" or "):
        try:
            low, high = map(number, choice.split(" to "))
        except ValueError:
            words.append(choice)
    return Parameter(
        name, value, comment[: found.start()], found[1] + (found[2] or ""), tuple(words), low, high, bool(found[2])
    )


def read_settings(texts: list[str], own_option: dict[str, str]) -> dict[str, str]:
    """NAME=VALUE of the command line; `own_option` has the names that are set by an option of their own."""
    known = parameters()
    settings: dict[str, str] = {}
    problems = []
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not equals or not value:
            problems.append(f"--set {text}: NAME=VALUE is expected, such as phi=30")
        elif name in own_option:
            problems.append(f"--set {text}: the option for this is {own_option[name]}")
        elif name not in known:
            problems.append(f"--set {text}: {_unknown(name, value, known, own_option)}")
        elif name in settings:
            problems.append(f"--set {text}: {name} is set twice")
        elif problem := known[name].problem(value):
            problems.append(f"--set {problem}")
        else:
            settings[name] = canonical(value)
    problems += _idle(settings, known)
    if problems:
        raise InputError("\n".join(problems))
    return settings


def _unknown(name: str, value: str, known: dict[str, Parameter], own_option: dict[str, str]) -> str:
    """Where a variable is that none of these is, or which of them may be meant: by its name, or by a word of its meaning."""
    if name in _variables_of(SHEAR_DECK) and name not in _variables_of(PACK_DECK):
        deck = SHEAR_DECK.relative_to(ROOT)
        return f"{name} is a variable of {deck} alone: run that deck by hand with -var {name} {value}"
    word = re.compile(rf"\b{re.escape(name)}\b", re.IGNORECASE)
    meant = difflib.get_close_matches(name, known, 1) or [p.name for p in known.values() if word.search(p.meaning)]
    hint = f", did you mean {', '.join(own_option.get(other, other) for other in meant)}" if meant else ""
    return f"there is no parameter {name}{hint}; 'shearbox parameters' lists them"


def _variables_of(deck: Path) -> set[str]:
    """Those that a command line may give."""
    return {name for name, style, _, _ in definitions(deck) if style == "index"}


def _idle(settings: dict[str, str], known: dict[str, Parameter]) -> list[str]:
    """What is set, and would change nothing."""
    values = {name: canonical(parameter.value or "") for name, parameter in known.items()} | settings
    return [
        f"--set {name}={settings[name]}: it changes nothing as long as {other} is {idle}"
        for name, other, idle in _IDLE_WHILE
        if name in settings and settings[name] != canonical(known[name].value or "") and values[other] == idle
    ]


def of_model(settings: dict[str, str]) -> dict[str, str]:
    """Those that belong to the model."""
    known = parameters()
    return {name: value for name, value in settings.items() if known[name].value is None}


def canonical(value: str) -> str:
    """The same text for the same value."""
    try:
        return numeral(number(value))
    except ValueError:
        return value
