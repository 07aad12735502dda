# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox report`: summary.json, a curve.csv per stress, and report.html."""

import io
from pathlib import Path
from typing import Any

import numpy as np

from .curves import draw_curves
from .drawing import draw_specimen
from .errors import ShearboxError
from .files import CURVE, PAGE, SUMMARY, write_json, write_text
from .models import PARAMETERS, read_comments
from .page import render
from .results import Results, read_results
from .shear import Shear
from .specimen import Film, missing_frames
from .strength import KNOWN_SCATTER
from .summary import phase_logs, summarise


def report(folder: Path) -> Path:
    """Analyse the folder and write its report, whose path is returned.

    Raises ShearboxError after writing when files are damaged, and without writing when there is nothing to report on.
    """
    results = read_results(folder)
    if not results.shears:
        raise ShearboxError(f"{folder}: nothing to report on yet\n" + "\n".join([*results.problems, *results.notes]))
    pictures = _pictures(results)
    summary = summarise(results)
    for shear in results.shears:
        write_text(shear.folder / CURVE, _curve(shear))
    write_json(folder / SUMMARY, summary)
    page = folder / PAGE
    write_text(page, _page(results, summary, pictures))
    if results.problems:
        raise ShearboxError(f"{page} is written, but not all files can be read:\n" + "\n".join(results.problems))
    return page


def _pictures(results: Results) -> dict[str, str]:
    """Data URIs by name: the diagrams, and a picture of the specimen per stress where its dumps can be read."""
    pictures = draw_curves(results)
    for shear in results.shears:
        if missing_frames(shear.folder):
            continue  # there is a note
        try:
            film = Film(shear.folder, shear.data["step"], shear.data["displacement_mm"])
            pictures[f"specimen {shear.sigma:g}"] = draw_specimen(film, shear.peak.position)
        except ShearboxError as error:
            if str(error) not in results.problems:  # the search for lost grains may have met it before
                results.problems.append(str(error))
    return pictures


def _curve(shear: Shear) -> str:
    """The table of a shear phase with its fitted curves and dilatancy rate, as CSV."""
    s = shear.data["displacement_mm"]
    columns = {name: column for name, column in shear.data.items() if name != "step"}
    columns["step"] = shear.data["step"]
    columns["tau_fit_kPa"] = shear.tau.series(s)
    columns["lid_fit_mm"] = shear.lid.series(s)
    columns["dilatancy_rate"] = shear.lid.series.deriv()(s)
    text = io.StringIO()
    np.savetxt(
        text, np.column_stack(list(columns.values())), fmt="%.8g", delimiter=",", header=",".join(columns), comments=""
    )
    return text.getvalue()


def _page(results: Results, summary: dict[str, Any], pictures: dict[str, str]) -> str:
    return render(
        "report.html.j2", summary=summary, shears=results.shears, line=results.line, pictures=pictures,
        logs=phase_logs(results), consolidations=results.consolidations, known_scatter=KNOWN_SCATTER,
        comments=_comments(results.model_file),
    )  # fmt: skip


def _comments(model: Path) -> dict[str, str]:
    """What the decks say about their variables; the page goes without when they are not there."""
    try:
        of_model = read_comments(model)
        return {**read_comments(PARAMETERS), **{f"model {k}": text for k, text in of_model.items()}}
    except ShearboxError:
        return {}
