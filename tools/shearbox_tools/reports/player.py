# SPDX-License-Identifier: GPL-2.0-or-later
"""The player of a report: frames of the shear phases, packed so that a page can hold them, for templates/player.js.

Grains are rigid: a frame is where the bodies (grains and pieces of the walls) are, what the grains have turned, and what
they bear. How discs lie on a body is told once, as in the first frame.
"""

import base64
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_hex

from ..analysis.moments import Film, Moment, rows_of
from ..analysis.motion import full_speed
from ..analysis.shear import Shear
from ..drawing.canvas import round_down
from ..drawing.paints import COLUMNS, Paint, make_paint
from ..drawing.pictures import OUTLINE, OUTLINE_COLOUR, WALL_COLOUR, extent
from ..drawing.scene import SEEN
from ..drawing.style import looks
from ..reading.readers import Columns

MOST_FRAMES = 26  # of a test, first and last among them; the player goes straight from one to the next
FEWEST_FRAMES = 5
MOST_PLACES = 250_000  # bodies times frames of a test: some 2 MB of the page
MOST_BODIES = 50_000  # their numbers are packed into 16 bits
ROWS = 200  # of the curves, at full speed
SHADES = 48
CHOSEN_COLOUR = "#ff00c8"  # in no scale of colours
LAST = np.iinfo(np.uint16).max


def film_of(shears: Sequence[Shear], thickness: float) -> dict[str, Any]:
    """What player.js plays; nothing if each test has too many grains. thickness (m) is that of the grains.

    Raises ShearboxError where the dumps lack columns or are damaged.
    """
    tests: dict[float, dict[str, Any]] = {}
    paints: dict[str, Paint] = {}
    for shear in shears:
        film = Film(shear.folder, shear.data["step"], shear.data["displacement_mm"], **COLUMNS["stress"])
        first = film.first()
        if frames := _frames(film, len(first.grains["id"])):
            paints = _paints(first, 1000 * shear.sigma * thickness)
            tests[shear.sigma] = _test(shear, [first, *map(film.moment, frames[1:])], paints)
    if not tests:
        return {}
    scales = [
        _scale(name, paint, np.concatenate([test["values"][name].ravel() for test in tests.values()]))
        for name, paint in paints.items()
    ]
    colours = looks([shear.sigma for shear in shears])
    for sigma, test in tests.items():
        test["colour"] = colours[sigma].colour
        test["values"] = {name: packed(values) for name, values in test["values"].items()}
    discs = {"wall": WALL_COLOUR, "outline": OUTLINE_COLOUR, "chosen": CHOSEN_COLOUR, "inner": 1 - 2 * OUTLINE}
    return {"tests": list(tests.values()), "paints": scales, **discs}


def packed(values: np.ndarray) -> dict[str, Any]:
    """(frames, n) numbers as whole ones of 16 bits: low + step times these. Of frames after the first the change, modulo
    2^16; first all low bytes, then all high ones, most of which are the same; then zlib and base64."""
    low, high = float(values.min()), float(values.max())
    step = (high - low) / LAST if high > low else 1.0
    whole = np.round((values - low) / step).astype(np.uint16)
    change = np.diff(whole, axis=0, prepend=np.zeros((1, whole.shape[1]), np.uint16))
    halves = change.astype("<u2").ravel().view(np.uint8).reshape(-1, 2).T
    return {"low": low, "step": step, "data": base64.b64encode(zlib.compress(halves.tobytes(), 9)).decode()}


def _frames(film: Film, bodies: int) -> list[int]:
    """Steps of the frames to play; none if there would be too few."""
    count = min(MOST_FRAMES, MOST_PLACES // bodies, len(film.steps))
    if count < min(FEWEST_FRAMES, len(film.steps)) or bodies > MOST_BODIES:
        return []
    return [film.steps[k] for k in np.linspace(0, len(film.steps) - 1, count).round().astype(int)]


def _paints(first: Moment, load: float) -> dict[str, Paint]:
    """By name; load: of the lid on a metre of width, N."""
    contacts = Paint(_contacts, colormaps["viridis"], "contacts of the grain", False)
    return {**{by: make_paint(by, first, load) for by in ("rotation", "stress")}, "contacts": contacts}


def _contacts(moment: Moment) -> np.ndarray:
    ids = moment.discs["id"].astype(int)
    partners = np.concatenate([moment.contacts["id1"], moment.contacts["id2"]]).astype(int)
    return np.bincount(partners, minlength=ids.max() + 1)[ids]


def _test(shear: Shear, moments: Sequence[Moment], paints: dict[str, Paint]) -> dict[str, Any]:
    bodies = _Bodies(moments[0], paints)
    low, high = extent([moments[0], moments[-1]])
    moving = np.arange(len(shear.data["step"]))[full_speed(shear.data)]
    rows = moving[np.linspace(0, len(moving) - 1, ROWS).round().astype(int)]
    return {
        "sigma": shear.sigma,
        "displacement": _short([moment.displacement for moment in moments]),
        "curves": {  # from the beginning on, before the first row
            name: [0.0, *_short(shear.data[name][rows])] for name in ("displacement_mm", "tau_kPa", "lid_mm")
        },
        "low": low.tolist(),
        "high": high.tolist(),
        "bar_mm": round_down(1000 * (high[0] - low[0]) / 5),
        "bodies": len(bodies.ids),
        "discs": bodies.discs(),
        **bodies.frames(moments),
    }


class _Bodies:
    """The grains of the first frame and then its walls, each by their ids."""

    def __init__(self, first: Moment, paints: dict[str, Paint]) -> None:
        self._first, self._paints = first, paints
        self.ids = first.grains["id"][np.lexsort((first.grains["id"], first.grains["wall"]))].astype(int)
        self._grains = int(np.sum(first.grains["wall"] == 0))

    def discs(self) -> dict[str, Any]:
        """Of each disc: number of its body, place on it when it has not turned yet, radius (m); those of a body in a row."""
        discs, centres = self._first.discs, self._places(self._first.grains)
        number = {body: k for k, body in enumerate(self.ids)}
        of = np.array([number[int(i)] for i in discs["id"]])
        order = np.argsort(of, kind="stable")
        columns = {
            "body": of,
            "dx": discs["x"] - centres[0][of],
            "dy": discs["y"] - centres[1][of],
            "r": discs["radius"],
        }
        return {name: packed(column[None, order]) for name, column in columns.items()}

    def frames(self, moments: Sequence[Moment]) -> dict[str, Any]:
        """Ids of grains; of each frame places (m) of bodies, and of grains the values of the paints. What is lost stays where
        it was."""
        places = [self._places(self._first.grains)]
        values = [self._values(self._first)]
        for moment in moments[1:]:
            there = np.isin(self.ids, moment.grains["id"])
            places.append(np.where(there, self._places(moment.grains), places[-1]))
            values.append(np.where(there[: self._grains], self._values(moment), values[-1]))
        x, y = np.moveaxis(np.array(places), 1, 0)
        return {
            "ids": packed(self.ids[None, : self._grains]),
            "x": packed(x),
            "y": packed(y),
            "values": dict(zip(self._paints, np.moveaxis(np.array(values), 1, 0))),
        }

    def _places(self, grains: Columns) -> np.ndarray:
        row = rows_of(grains["id"], self.ids)
        return np.array([grains["x"][row], grains["y"][row]])

    def _values(self, moment: Moment) -> np.ndarray:
        disc = rows_of(moment.discs["id"], self.ids[: self._grains])
        return np.array([paint.values(moment)[disc] for paint in self._paints.values()])


def _scale(name: str, paint: Paint, values: np.ndarray) -> dict[str, Any]:
    high = max(1e-9, float(np.quantile(np.abs(values), SEEN)))
    shades = [to_hex(paint.colormap(k / (SHADES - 1))) for k in range(SHADES)]
    return {"name": name, "title": paint.title, "low": -high if paint.signed else 0.0, "high": high, "shades": shades}


def _short(values: Sequence[float] | np.ndarray) -> list[float]:
    return [float(f"{value:.5g}") for value in values]
