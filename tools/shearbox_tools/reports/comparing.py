# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox compare`: compare.html, compare.json and compare.csv."""

import csv
import io
import os
import string
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import __version__
from ..analysis.by_hand import read_by_hand
from ..analysis.comparison import Comparison, Quantity
from ..analysis.differences import Difference, Mean
from ..analysis.ensemble_results import Ensemble
from ..analysis.grouping import LeftOut, put_together, settings_of, what_differs
from ..analysis.read_runs import read_all, read_quietly
from ..analysis.strength import COVERAGE
from ..base.errors import InputError, ShearboxError
from ..base.files import PAGE, write_json, write_text
from ..drawing.comparison_curves import draw_comparison
from ..drawing.style import ALL_LOOKS
from .page import render
from .report_on import runs_and_tests
from .summary import plain

TEMPLATE = "compare.html.j2"
NAME = "compare"


@dataclass(frozen=True)
class Member:
    """An ensemble, and the folder that was given."""

    folder: Path
    ensemble: Ensemble


def compare(folders: Sequence[Path], out: Path) -> tuple[Path, list[str]]:
    """Compare the ensembles in the folders, each of which holds one or several; the page's path is returned, and
    why some of them have no φ and c.

    Raises ShearboxError without writing if there are not at least two, or more than curves can be told apart.
    """
    if twice := sorted({str(folder) for folder in folders if folders.count(folder) > 1}):
        raise InputError(f"{twice[0]} is named twice")
    members: list[Member] = []
    left_out: list[LeftOut] = []
    for folder in folders:
        ensembles, without = _read(folder)
        members += [Member(folder, ensemble) for ensemble in ensembles]
        left_out += without
    places = [run.folder.resolve() for member in members for run in member.ensemble.specimens]
    if shared := next((place for place in places if places.count(place) > 1), None):
        raise InputError(f"{shared} is in more than one of the folders: nothing can be compared with itself")
    if not 2 <= len(members) <= len(ALL_LOOKS):
        there = [f"{member.folder}: {member.ensemble.identity['model']}" for member in members]
        reasons = [f"{one.folder}: {one.reason}" for one in left_out]
        raise ShearboxError(
            "\n".join([f"2 to {len(ALL_LOOKS)} ensembles are compared, there are {len(members)}", *there, *reasons])
        )
    return write_comparison(members, left_out, out)


def write_comparison(members: Sequence[Member], left_out: Sequence[LeftOut], out: Path) -> tuple[Path, list[str]]:
    """The same of what has been read."""
    comparison = Comparison([member.ensemble for member in members])
    summary = plain(_summary(members, comparison, left_out, out))
    _make_folder(out)
    write_json(out / f"{NAME}.json", summary)
    write_text(out / f"{NAME}.csv", _table(summary))
    names = [one["name"] for one in summary["ensembles"]]
    page = out / f"{NAME}.html"
    write_text(
        page, render(TEMPLATE, summary=summary, looks=ALL_LOOKS, pictures=draw_comparison(names, comparison.every))
    )
    return page, [f"{e['name']} ({e['folder']}): {doubt}" for e in summary["ensembles"] for doubt in e["doubts"]]


def _read(folder: Path) -> tuple[list[Ensemble], list[LeftOut]]:
    """Nothing is written."""
    runs, by_hand = runs_and_tests(folder)
    read, unread = read_all(runs, read_quietly)
    try:
        tests, damaged = read_by_hand(by_hand, None, None)
    except InputError as error:
        raise InputError(
            f"{error}. 'shearbox compare' has no such option: it needs the logs of tests by hand"
        ) from error
    ensembles, left_out = put_together([*read, *tests])
    return ensembles, [*unread, *damaged, *left_out]


def _make_folder(out: Path) -> None:
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--out {out}: {error.strerror}") from error


def _summary(
    members: Sequence[Member], comparison: Comparison, left_out: Sequence[LeftOut], out: Path
) -> dict[str, Any]:
    """compare.json, in the folder `out`; units are in the names, null is what is not known."""
    differs = what_differs(comparison.every)
    there = zip(string.ascii_uppercase, members, differs, comparison.methods, comparison.ensembles)
    return {
        "stresses_kPa": comparison.stresses,
        "not_compared": sorted({s for e in comparison.every for s in e.shears} - set(comparison.stresses)),
        "coverage": COVERAGE,
        "ensembles": [
            {
                "name": name,
                "folder": str(member.folder),
                "model": member.ensemble.identity["model"],
                "differs": difference,
                "specimens": member.ensemble.count,
                "seeds": [run.identity["seed"] for run in member.ensemble.specimens],
                "packings": member.ensemble.model,
                "method": method,
                "doubts": compared.line_doubts,
                "notes": member.ensemble.notes,
                "report": os.path.relpath(page, out) if (page := member.folder / PAGE).exists() else None,
                **_totals(member.ensemble),
                "settings": settings_of(member.ensemble.identity),
            }
            for name, member, difference, method, compared in there
        ],
        "quantities": [_quantity(quantity) for quantity in comparison.quantities],
        "left_out": [{"folder": str(one.folder), "reason": one.reason} for one in left_out],
        "shearbox": __version__,
    }


def _totals(ensemble: Ensemble) -> dict[str, int | None]:
    shears = [shear for of_stress in ensemble.shears.values() for shear in of_stress]
    return {
        "grains_lost": _sum_of_known([shear.lost for shear in shears]),
        "dangerous_builds": _sum_of_known([shear.dangerous_builds for shear in shears]),
    }


def _sum_of_known(counts: list[int | None]) -> int | None:
    known = [count for count in counts if count is not None]
    return sum(known) if len(known) == len(counts) else None


def _quantity(quantity: Quantity) -> dict[str, Any]:
    return {
        "quantity": quantity.name,
        "title": quantity.title,
        "unit": quantity.unit,
        "digits": quantity.digits,
        "sigma_kPa": quantity.sigma,
        "means": [_interval(mean) for mean in quantity.means],
        "differences": [_interval(difference) for difference in quantity.differences],
    }


def _interval(told: Mean | Difference | None) -> dict[str, float | None] | None:
    return None if told is None else {"value": told.value, "low": told.low, "high": told.high}


def _table(summary: dict[str, Any]) -> str:
    """compare.csv: a row for each quantity and ensemble."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    ends = ("", "_low", "_high")
    rows.writerow(["quantity", "sigma_kPa", "ensemble", "folder", "specimens", *(f"mean{end}" for end in ends),
                   *(f"difference{end}" for end in ends), "method"])  # fmt: skip
    for quantity in summary["quantities"]:
        for one, mean, difference in zip(summary["ensembles"], quantity["means"], quantity["differences"]):
            numbers = [(told or {}).get(end) for told in (mean, difference) for end in ("value", "low", "high")]
            first = [quantity["quantity"], quantity["sigma_kPa"], one["name"], one["folder"], one["specimens"]]
            rows.writerow([*first, *numbers, one["method"]])
    return text.getvalue()
