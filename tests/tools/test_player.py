# SPDX-License-Identifier: GPL-2.0-or-later
"""The player of a report, in a browser: the grains are where the dumps have them, and are told with what the dumps say."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic
from browser import needs_browser, told

from shearbox_tools.analysis.moments import Film, Moment
from shearbox_tools.analysis.results import read_results
from shearbox_tools.asking.models import find_model
from shearbox_tools.asking.request import Request
from shearbox_tools.drawing.paints import COLUMNS, grain_areas, mean_stress
from shearbox_tools.reports import player
from shearbox_tools.reports.run_report import report

pytestmark = needs_browser

STEPS = [0, 1000000, 2000000, 4000000]
SIGMA = 100.0
THICKNESS = 0.01  # m, of input/parameters.in
LEAN, TURN = 0.5, 0.8  # rad: of the grain of two discs in the first frame, and from frame to frame
PROBE = """
const part = name => document.querySelector(`#player [data-part=${name}]`);
const film = JSON.parse(document.getElementById('film').textContent), test = film.tests[0];
const waiting = setInterval(() => {
  if (!document.getElementById('player').dataset.ready) return;
  clearInterval(waiting);
  const found = PROBES.map(([at, x, y]) => {
    part('slider').value = at;
    part('slider').oninput();
    const box = part('specimen').getBoundingClientRect(), scale = box.width / (test.high[0] - test.low[0]);
    const [right, down] = [(x - test.low[0]) * scale, (test.high[1] - y) * scale];
    const pixel = part('specimen').getContext('2d').getImageData(2 * right, 2 * down, 1, 1).data.slice(0, 3);
    part('specimen').dispatchEvent(new PointerEvent('pointermove', {clientX: box.left + right, clientY: box.top + down}));
    return {grain: part('grain').textContent, now: part('now').textContent, pixel: [...pixel]};
  });
  document.body.textContent = JSON.stringify(found);
}, 20);
"""


@pytest.fixture(name="folder", scope="module")
def _folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run with a report, in which grain 1 is of two discs and turns."""
    folder = tmp_path_factory.mktemp("run")
    synthetic.write_record(folder, Request(find_model("TypeA_10x5_4-8_1-circle_350"), (SIGMA,)))
    place = folder / f"{SIGMA:g}"
    place.mkdir()
    synthetic.write_shear(place / "shear.dat", synthetic.curves(SIGMA, 8))
    synthetic.write_frames(place, STEPS, 8)
    make_pair(place)
    report(folder)
    return folder


def make_pair(place: Path) -> None:
    """Of grain 1, of a type of its own: one disc on either side of its centre, half as large."""
    for name in ("grains", "discs"):
        lines: list[str] = []
        frame = -1
        for line in (place / f"{name}.dump").read_text(encoding="utf-8").splitlines():
            words = line.split()
            frame += line == "ITEM: TIMESTEP"
            if words[0] == "1" and len(words) > 7:
                lines += turned_pair(words, frame * TURN) if name == "discs" else [turned_grain(words, frame * TURN)]
            else:
                lines.append(line)
        text = "\n".join(lines) + "\n"
        (place / f"{name}.dump").write_text(with_a_row_more(text) if name == "discs" else text, encoding="utf-8")


def turned_grain(words: list[str], angle: float) -> str:
    return " ".join([words[0], "3", *words[2:9], f"{angle:.6g}", *words[10:]])


def turned_pair(words: list[str], angle: float) -> list[str]:
    x, y, radius = float(words[2]), float(words[3]), float(words[5]) / 2
    rows = []
    for disc, side in enumerate((-1, 1)):
        where = x + side * radius * np.cos(LEAN + angle), y + side * radius * np.sin(LEAN + angle)
        rows.append(f"1 {disc} {where[0]:.8g} {where[1]:.8g} 0 {radius:.8g} {angle:.6g} 3")
    return rows


def with_a_row_more(text: str) -> str:
    """In the head of each frame."""
    return re.sub(r"(?<=ITEM: NUMBER OF ATOMS\n)\d+", lambda match: str(int(match[0]) + 1), text)


def film(folder: Path) -> Film:
    shear = read_results(folder).shears[0]
    return Film(shear.folder, shear.data["step"], shear.data["displacement_mm"], **COLUMNS["stress"])


def probe(folder: Path, places: list[tuple[float, float, float]], tmp_path: Path) -> list[dict[str, Any]]:
    """What the player shows at moments (frames) and places (m)."""
    page = tmp_path / "page.html"
    script = f"<script>{PROBE.replace('PROBES', json.dumps(places))}</script></body>"
    page.write_text((folder / "report.html").read_text(encoding="utf-8").replace("</body>", script), encoding="utf-8")
    found: list[dict[str, Any]] = told(tmp_path, page, "--window-size=1200,900", "--virtual-time-budget=20000")
    return found


def expected(first: Moment, moment: Moment, grain: int) -> tuple[float, int, float]:
    """Degrees turned, contacts, and stress (kPa) of a grain."""
    disc = int(np.flatnonzero(moment.discs["id"] == grain)[0])
    pairs = np.column_stack([moment.contacts["id1"], moment.contacts["id2"]])
    stress = mean_stress(moment, grain_areas(first))[disc] / (1000 * THICKNESS)
    return float(np.degrees(moment.rotation_since(first)[disc])), int(np.sum(pairs == grain)), float(stress)


def test_grains_are_where_they_are(folder: Path, tmp_path: Path) -> None:
    """In all frames: hit near the edge on all sides, by the right number, and told with the right values."""
    frames = film(folder)
    moments = [frames.moment(step) for step in STEPS]
    rng = np.random.default_rng(1)
    wanted, places = [], []
    for k, moment in enumerate(moments):
        grains = moment.grains
        for row in rng.choice(np.flatnonzero((grains["wall"] == 0) & (grains["id"] > 1)), 12, replace=False):
            angle = rng.uniform(0, 2 * np.pi)
            aside = 0.93 * grains["radius"][row]
            x, y = grains["x"][row] + aside * np.cos(angle), grains["y"][row] + aside * np.sin(angle)
            wanted.append((int(grains["id"][row]), *expected(moments[0], moment, int(grains["id"][row]))))
            places.append((float(k), float(x), float(y)))
    for shown, (grain, turned, contacts, stress) in zip(probe(folder, places, tmp_path), wanted):
        numbers = [float(word.replace("−", "-")) for word in re.findall(r"[−\d.]*\d", shown["grain"])]
        assert numbers[0] == grain
        assert numbers[1] == pytest.approx(turned, abs=0.06)
        assert numbers[3] == contacts
        assert numbers[4] == pytest.approx(stress, abs=0.6)


def test_discs_turn_with_their_grain(folder: Path, tmp_path: Path) -> None:
    """Of the grain of two discs: their centres are hit, in frames and half-way between two; what is beside them is not."""
    frames = film(folder)
    places = []
    for at in (0.0, 1.0, 2.0, 3.0, 1.5):
        x, y = np.mean([centre(frames, STEPS[k]) for k in (int(np.floor(at)), int(np.ceil(at)))], axis=0)
        for angle in LEAN + at * TURN + np.array([0, np.pi, np.pi / 2]):
            radius = 0.00277 / 2 * 1.7
            places.append((at, x + radius * np.cos(angle), y + radius * np.sin(angle)))
    found = [shown["grain"].startswith("Grain 1:") for shown in probe(folder, places, tmp_path)]
    assert found == 5 * [True, True, False]


def centre(frames: Film, step: int) -> tuple[float, float]:
    grains = frames.moment(step).grains
    row = int(np.flatnonzero(grains["id"] == 1)[0])
    return float(grains["x"][row]), float(grains["y"][row])


def test_colours_and_moment(folder: Path, tmp_path: Path) -> None:
    """White before anything has turned, grey on the lid, and by the scale of colours later."""
    frames = film(folder)
    first, last = frames.moment(0), frames.moment(STEPS[-1])
    turned = last.rotation_since(first)
    row = int(np.argmax(np.where(last.discs["id"] > 1, turned, 0)))
    lid = int(np.flatnonzero(first.grains["lid"] == 1)[3])
    places = [
        (0.0, first.discs["x"][row], first.discs["y"][row]),
        (0.0, first.grains["x"][lid], first.grains["y"][lid]),
        (3.0, last.discs["x"][row], last.discs["y"][row]),
    ]
    middle, grey, red = probe(folder, [(at, float(x), float(y)) for at, x, y in places], tmp_path)
    assert min(middle["pixel"]) > 240
    assert grey["pixel"] == [0xC9, 0xCE, 0xD4] and grey["grain"] == "Point at a grain, or touch it."
    assert red["pixel"][0] > 2 * red["pixel"][1]
    assert middle["now"] == "0.00 mm, τ 0.0 kPa (line), lid 0.000 mm (dashes)" and red["now"].startswith("8.00 mm")


def test_packing() -> None:
    """Within half a step of 16 bits, which is what the browser unpacks (other tests); changes may be of either sign."""
    values = np.cumsum(np.random.default_rng(2).normal(size=(7, 50)), axis=0)
    packed = player.packed(values)
    assert packed["low"] == values.min()
    assert packed["step"] == pytest.approx(np.ptp(values) / 65535)
    assert player.packed(np.full((1, 3), 4.0))["low"] == 4.0


def test_too_many_grains(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Fewer frames, and none of too many grains; a report without a player."""
    results = read_results(folder)
    bodies = len(film(folder).first().grains["id"])
    monkeypatch.setattr(player, "MOST_PLACES", 3 * bodies)
    monkeypatch.setattr(player, "FEWEST_FRAMES", 3)
    assert len(player.film_of(results.shears, THICKNESS)["tests"][0]["displacement"]) == 3
    monkeypatch.setattr(player, "FEWEST_FRAMES", 4)
    assert player.film_of(results.shears, THICKNESS) == {}
    monkeypatch.setattr(player, "FEWEST_FRAMES", 2)
    monkeypatch.setattr(player, "MOST_BODIES", bodies - 1)
    assert player.film_of(results.shears, THICKNESS) == {}
    page = report(folder).read_text(encoding="utf-8")
    assert 'id="player"' not in page and "no player: these are too many grains for a page" in page


def test_a_column_that_is_not_there(tmp_path: Path) -> None:
    """Dumps of an earlier version: the page says why there is no player, and has all else."""
    synthetic.write_record(tmp_path / "run", Request(find_model("TypeA_10x5_4-8_1-circle_350"), (SIGMA,)))
    place = tmp_path / "run" / f"{SIGMA:g}"
    place.mkdir()
    synthetic.write_shear(place / "shear.dat", synthetic.curves(SIGMA, 8))
    synthetic.write_frames(place, STEPS, 8)
    dump = place / "contacts.dump"
    dump.write_text(dump.read_text(encoding="utf-8").replace(" fx fy ", " gx gy "), encoding="utf-8")
    page = report(tmp_path / "run").read_text(encoding="utf-8")
    assert 'id="player"' not in page and "no player: " in page and "fx" in page
