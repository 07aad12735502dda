# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox report`: summary.json, a curve.csv per stress, and report.html."""

import io
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import rc_context

from ..analysis.fields import Box, Fields
from ..analysis.moments import Film, missing_frames
from ..analysis.results import Results, read_results
from ..analysis.shear import Shear
from ..analysis.strength import known_scatter
from ..asking.models import PARAMETERS, read_comments
from ..base.errors import ShearboxError
from ..base.files import CURVE, PAGE, SUMMARY, write_json, write_text
from ..base.numerals import number
from ..drawing import curves, states
from ..drawing.maps import draw_maps
from ..drawing.pictures import Stills, draw_specimens
from ..drawing.style import RC, as_uri
from .page import render
from .player import film_of
from .summary import phase_logs, summarise

PAGE_TEMPLATE = "report.html.j2"


def report(folder: Path) -> Path:
    """Analyse the folder and write its report, whose path is returned.

    Raises ShearboxError after writing when files are damaged, and without writing when there is nothing to report on.
    """
    return write_report(read_results(folder))


def write_report(results: Results) -> Path:
    """The same of what has been read."""
    folder = results.folder
    if not results.shears:
        raise ShearboxError(f"{folder}: nothing to report on yet\n" + "\n".join([*results.problems, *results.notes]))
    page = folder / PAGE
    problems = [*results.problems, *write_files(results)]
    if problems:
        raise ShearboxError(f"{page} is written, but not all files can be read:\n" + "\n".join(problems))
    return page


def write_files(results: Results) -> tuple[str, ...]:
    """The files of the report of a folder in which there is something to tell; damages of dumps are returned."""
    folder = results.folder
    specimens, unseen = _specimens(results.shears)
    film, note = _film(results, specimens)
    # Each once: the search for lost grains may have met it before.
    frame_problems = tuple(dict.fromkeys([*results.frame_problems, *unseen]))
    told = replace(results, frame_problems=frame_problems, notes=(*results.notes, *note))
    summary = summarise(told)
    for shear in results.shears:
        write_text(shear.folder / CURVE, _curve(shear))
    write_json(folder / SUMMARY, summary)
    write_text(folder / PAGE, _page(told, summary, specimens, film))
    return frame_problems


def _diagrams(results: Results) -> dict[str, str]:
    """SVGs as data: URIs by name; of further columns of the tables 'column NAME'."""
    with rc_context(RC):
        figures = {
            "strength": states.strength(results),
            "stress": curves.stress(results),
            "lid": curves.lid(results),
            "dilatancy": curves.dilatancy(results),
            **{f"ratio by {by}": figure for by, figure in curves.stress_ratios(results).items()},
            "stress paths": states.stress_paths(results),
            "stress dilatancy": states.stress_dilatancy(results),
            **{f"column {name}": figure for name, figure in curves.other_columns(results).items()},
        }
        return {name: as_uri(figure) for name, figure in figures.items()}


def _specimens(shears: Sequence[Shear]) -> tuple[dict[float, Stills], list[str]]:
    """By stress (kPa), where the dumps can be read; and what is damaged."""
    specimens = {}
    problems = []
    for shear in shears:
        if missing_frames(shear.folder):
            continue  # there is a note
        try:
            film = Film(shear.folder, shear.data["step"], shear.data["displacement_mm"])
            specimens[shear.sigma] = Stills.of(film, shear.peak.position)
        except ShearboxError as error:
            problems.append(str(error))
    return specimens, problems


def _fields(results: Results, specimens: dict[float, Stills]) -> dict[float, dict[str, Fields]]:
    """By stress (kPa) and name of the moment, where the frames of the cells are there and the thickness is recorded."""
    thickness = _thickness(results)
    if thickness is None:
        return {}
    box = Box(results.identity["model half_height"], thickness)
    return {
        sigma: {name: Fields.of(moment, stills.before, box) for name, moment in stills.moments.items()}
        for sigma, stills in specimens.items()
        if stills.before.cells is not None
    }


def _film(results: Results, specimens: dict[float, Stills]) -> tuple[dict[str, Any], list[str]]:
    """For the player, where the frames can be read and the thickness is recorded; or a note, why there is none."""
    thickness = _thickness(results)
    shears = [shear for shear in results.shears if shear.sigma in specimens]
    if not shears or thickness is None:
        return {}, []
    try:
        film = film_of(shears, thickness)
    except ShearboxError as error:
        return {}, [f"no player: {error}"]
    return film, [] if film else ["no player: these are too many grains for a page; shearbox film shows them"]


def _thickness(results: Results) -> float | None:
    """Of the grains, m; None if it is not recorded."""
    try:
        return number(results.identity["parameters"]["thickness"])
    except (KeyError, ValueError):
        return None


def _curve(shear: Shear) -> str:
    """The table of a shear phase with its fitted curves and dilatancy rate, as CSV; steps of slow tests have ten digits."""
    s = shear.data["displacement_mm"]
    columns = {name: column for name, column in shear.data.items() if name != "step"}
    columns["step"] = shear.data["step"]
    columns["tau_fit_kPa"] = shear.tau.series(s)
    if shear.plane:
        columns["plane_fit_kPa"] = shear.plane.sigma.series(s)
        columns["plane_tau_fit_kPa"] = shear.plane.tau.series(s)
    columns["lid_fit_mm"] = shear.lid.series(s)
    columns["dilatancy_rate"] = shear.lid.series.deriv()(s)
    text = io.StringIO()
    np.savetxt(
        text, np.column_stack(list(columns.values())), fmt="%.10g", delimiter=",", header=",".join(columns), comments=""
    )
    return text.getvalue()


def _page(results: Results, summary: dict[str, Any], specimens: dict[float, Stills], film: dict[str, Any]) -> str:
    """Its size in MB is told on itself."""
    fields = _fields(results, specimens)
    values = dict(
        summary=summary, line=results.strength, plane_line=results.plane_strength, knows_plane=results.knows_plane, diagrams=_diagrams(results),
        pictures=draw_specimens(specimens), specimens=specimens, film=film, maps=draw_maps(fields), mapped=list(fields), columns=curves.OTHERS, logs=phase_logs(results),
        row_mm=max(map(_row_mm, results.shears)), consolidations=[(f"{sigma:g}", bed) for sigma, bed in results.consolidations.items()], known_scatter=known_scatter(results.identity), comments=_comments(results.model_file),
    )  # fmt: skip
    size = len(render(PAGE_TEMPLATE, **values, size_MB=0))
    return render(PAGE_TEMPLATE, **values, size_MB=size / 1e6)


def _row_mm(shear: Shear) -> float:
    """Shear displacement over which a row of the table at full speed is a mean."""
    return float(np.mean(np.diff(shear.data["displacement_mm"][shear.rows])))


def _comments(model: Path) -> dict[str, str]:
    """What the decks say about their variables; the page goes without when they are not there."""
    try:
        of_model = read_comments(model)
        return {**read_comments(PARAMETERS), **{f"model {k}": text for k, text in of_model.items()}}
    except ShearboxError:
        return {}
