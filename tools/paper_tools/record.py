# SPDX-License-Identifier: GPL-2.0-or-later
"""Specimens as tables: specimens.csv has a row for each specimen and stress, curves.csv one for each of its curves.

A report writes both, and a later one can add its own specimens to theirs.
"""

import csv
import io
from collections.abc import Iterable, Mapping
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from shearbox_tools.base.errors import InputError
from shearbox_tools.base.files import write_text

from .specimens import CURVES, JUDGED, NUMBERS, PLACES, STRENGTHS, Numbers, Specimen

SPECIMENS, CURVE_TABLE = "specimens.csv", "curves.csv"
DRAWN = ("smooth", "discs")  # campaigns whose curves are drawn
_KEY = ("campaign", "entry", "seed")
_AT = [f"{place:.1f}" for place in PLACES]
_HOLDS: dict[bool | None, str] = {True: "yes", False: "no", None: ""}

Campaigns = Mapping[str, Mapping[str, list[Specimen]]]  # specimens by campaign and entry
Row = Mapping[str, Any]


def write_record(campaigns: Campaigns, folder: Path) -> None:
    """Both tables, into the folder."""
    every = [
        (dict(zip(_KEY, (name, entry, one.seed))), one)
        for name, entries in campaigns.items()
        for entry, some in entries.items()
        for one in some
    ]
    numbers = [
        key
        | {strength: _text(getattr(one, strength)) for strength in STRENGTHS}
        | {name: _HOLDS[one.holds[name]] for name in JUDGED}
        | {"hours": _text(one.hours), "sigma_kPa": _text(sigma)}
        | {name: _text(value) for name, value in test.items()}
        for key, one in every
        for sigma, test in one.tests.items()
    ]
    curves = [
        key | {"sigma_kPa": _text(sigma), "curve": name} | {place: _text(v, 4) for place, v in zip(_AT, row)}
        for key, one in every
        if key["campaign"] in DRAWN
        for sigma, rows in one.curves.items()
        for name, row in zip(CURVES, rows)
    ]
    _write(folder / SPECIMENS, [*_KEY, *STRENGTHS, *JUDGED, "hours", "sigma_kPa", *NUMBERS], numbers)
    _write(folder / CURVE_TABLE, [*_KEY, "sigma_kPa", "curve", *_AT], curves)


def read_record(folder: Path) -> dict[str, dict[str, list[Specimen]]]:
    """What write_record has written there; what an earlier version did not write is not known."""
    curves: dict[tuple[str, ...], list[list[float]]] = {}
    for row in _read(folder / CURVE_TABLE) if (folder / CURVE_TABLE).exists() else []:
        curves.setdefault((*_key(row), row["sigma_kPa"]), []).append([float(row[place]) for place in _AT])
    campaigns: dict[str, dict[str, list[Specimen]]] = {}
    for key, rows in groupby(_read(folder / SPECIMENS), _key):
        tests = list(rows)
        known = {
            float(row["sigma_kPa"]): np.array(curves[(*key, row["sigma_kPa"])])
            for row in tests
            if (*key, row["sigma_kPa"]) in curves
        }
        campaigns.setdefault(key[0], {}).setdefault(key[1], []).append(_specimen(tests, known))
    return campaigns


def _specimen(tests: list[Row], curves: dict[float, np.ndarray]) -> Specimen:
    """Of its rows."""
    first = tests[0]
    judged = {text: holds for holds, text in _HOLDS.items()}
    numbers: dict[float, Numbers] = {
        float(row["sigma_kPa"]): {name: float(row.get(name, "nan")) for name in NUMBERS} for row in tests
    }
    return Specimen(
        seed=int(first["seed"]),
        tests=numbers,
        **{name: float(first[name]) for name in STRENGTHS},
        curves=curves,
        holds={name: judged[first.get(name, "")] for name in JUDGED},
        hours=float(first.get("hours", "nan")),
    )


def _key(row: Row) -> tuple[str, ...]:
    return tuple(row[name] for name in _KEY)


def _text(value: float, digits: int = 5) -> str:
    return f"{value:.{digits}g}"


def _write(file: Path, names: list[str], rows: Iterable[Row]) -> None:
    text = io.StringIO()
    table = csv.DictWriter(text, names, lineterminator="\n")
    table.writeheader()
    table.writerows(rows)
    write_text(file, text.getvalue())


def _read(file: Path) -> list[Row]:
    try:
        with file.open(encoding="utf-8", newline="") as stream:
            return list(csv.DictReader(stream))
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}") from error
