# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox film`: frames, the mark on the curves, colours by stress, and what is refused."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import synthetic
from matplotlib.colors import to_rgb
from PIL import Image
from synthetic import moment

from shearbox_tools.analysis.moments import Film, Moment
from shearbox_tools.asking.models import find_model
from shearbox_tools.asking.request import Request
from shearbox_tools.commands.cli import main
from shearbox_tools.drawing import scene
from shearbox_tools.drawing.paints import grain_areas, make_paint, mean_stress

STEPS = [0, 1000000, 2500000, 4000000]
TRAVEL = 8.0


@pytest.fixture(name="run", scope="module")
def _run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of two stresses whose frames are at 0, 1/3, 2/3 and all of the travel."""
    folder = tmp_path_factory.mktemp("run")
    synthetic.write_record(folder, Request(find_model("TypeA_10x5_4-8_1-circle_350"), (100.0, 200.0)))
    for sigma in (100, 200):
        place = folder / f"{sigma}"
        place.mkdir()
        synthetic.write_shear(place / "shear.dat", synthetic.curves(sigma, TRAVEL))
        synthetic.write_frames(place, STEPS, TRAVEL)
    return folder


@pytest.fixture(name="frames", scope="module")
def _frames(run: Path) -> list[np.ndarray]:
    """Of the film by rotation, as Pillow reads it: (height, width, 3) from 0 to 1 each."""
    assert main(["film", str(run), "--stress", "100", "--format", "gif"]) == 0
    with Image.open(run / "100" / "film.gif") as film:
        assert film.n_frames == len(STEPS) and film.info["duration"] == 80
        return [_frame(film, k) for k in range(film.n_frames)]


def _frame(film: Image.Image, number: int) -> np.ndarray:
    film.seek(number)
    return np.asarray(film.convert("RGB")) / 255


def test_frames(run: Path, frames: list[np.ndarray]) -> None:
    """8 x 4.5 inches at 110 dpi, and no two alike in the specimen."""
    for frame in frames:
        assert frame.shape == (495, 880, 3)
    specimens = [frame[:400, :480] for frame in frames]
    assert all(np.abs(a - b).max() > 0.2 for a, b in zip(specimens, specimens[1:]))
    assert not (run / "200" / "film.gif").exists()


def test_the_mark_is_where_the_lower_half_is(frames: list[np.ndarray]) -> None:
    """In both diagrams, from 0 to the travel, within a pixel and a half."""
    for number, frame in enumerate(frames):
        red = np.abs(frame - to_rgb(scene.MARK_COLOUR)).max(axis=2) < 0.15
        for _, (left, bottom, width, height) in scene.CURVES.values():
            top = round(495 * (1 - bottom - height))
            part = red[top - 6 : top + round(495 * height) + 6, 530:]
            assert part.sum() > 10, number
            middle = 530 + np.argwhere(part)[:, 1].mean() + 0.5
            # the last row of the table, a mean over its interval, is where the axis ends
            end = TRAVEL * (1 - 0.5 / 800)
            assert middle == pytest.approx(880 * (left + width * number / 3 * TRAVEL / end), abs=1.5)


def test_the_last_mark_is_of_the_last_row_at_full_speed(run: Path) -> None:
    """Rows after the stop have the displacement of the end, and spikes."""
    before = synthetic.curves(100, TRAVEL)
    curves = {name: np.append(column, [column[-1], column[-1]]) for name, column in before.items()}
    curves["step"][-2:] += synthetic.STEPS_PER_ROW * np.array([1, 2])
    curves["displacement_mm"][-2:] = TRAVEL
    curves["tau_kPa"][-2:], curves["lid_mm"][-2:] = -200.0, 7.0
    film = Film(run / "100", curves["step"], curves["displacement_mm"])
    picture = scene.Scene("", curves, film.first(), [film.last()], make_paint("rotation", film.first(), 1))
    picture.show(film.last())
    marks = [line for axes in picture.figure.axes for line in axes.lines if line.get_color() == scene.MARK_COLOUR]
    places = [(float(mark.get_xdata()[0]), float(mark.get_ydata()[0])) for mark in marks]
    wanted = [(TRAVEL, before[name][-1]) for name in scene.CURVES]
    assert np.allclose(places, wanted)


def test_circles_are_to_scale(run: Path) -> None:
    curves = synthetic.curves(100, TRAVEL)
    film = Film(run / "100", curves["step"], curves["displacement_mm"])
    picture = scene.Scene("", curves, film.first(), [film.last()], make_paint("rotation", film.first(), 1))
    picture.show(film.last())
    picture.specimen.apply_aspect()
    (x, _), (_, y) = picture.specimen.transData.transform([(1, 0), (0, 1)]) - picture.specimen.transData.transform(
        (0, 0)
    )
    assert x == pytest.approx(y) and x > 2000


@pytest.mark.parametrize("by", ["speed", "stress", "chains"])
def test_other_films(run: Path, by: str) -> None:
    assert main(["film", str(run), "--stress", "200", "--by", by, "--format", "gif", "--frames", "2"]) == 0
    with Image.open(run / "200" / f"film_{by}.gif") as film:
        assert film.n_frames == 1


def test_stress_of_a_grain() -> None:
    """Pressed by F from two sides: half the trace is 2 r F / (2 A), with A = pi r^2 of a disc. Two discs that overlap have
    the area of both less that of the lens between them."""
    disc = moment([1, 2, 3], [0.0, 2.0, -2.0])
    discs = disc.discs | {"type": np.array([1, 2, 2])}
    force = {"fx": np.array([-5.0, 5.0]), "fy": np.zeros(2)}
    contacts = {"id1": np.array([1, 1]), "id2": np.array([2, 3]), "x": np.array([1.0, -1]), "y": np.zeros(2), **force}
    grains = disc.grains | {"x": np.array([0.0, 2, -2]), "y": np.zeros(3)}
    pressed = type(disc)(0, grains, discs, contacts, None)
    areas = grain_areas(pressed)
    assert areas[1] == pytest.approx(np.pi, rel=1e-3)
    assert mean_stress(pressed, areas)[0] == pytest.approx(5 / np.pi, rel=1e-3)
    two = moment([1, 1, 2], [0.0, 1.0, 9.0])
    lens = 2 * np.pi / 3 - np.sqrt(3) / 2
    assert grain_areas(type(two)(0, two.grains, two.discs | {"type": np.array([1, 1, 2])}, {}, None))[
        1
    ] == pytest.approx(2 * np.pi - lens, rel=1e-3)


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="no ffmpeg: apt-get install ffmpeg")
@pytest.mark.parametrize(("form", "codec"), [("mp4", "h264"), ("webm", "vp9")])
def test_films_by_ffmpeg(run: Path, form: str, codec: str) -> None:
    assert main(["film", str(run), "--stress", "200", "--format", form, "--frames", "::2"]) == 0
    entries = "stream=codec_name,width,height,pix_fmt,nb_read_frames"
    words = ["-v", "error", "-count_frames", "-show_entries", entries, "-of", "json", str(run / "200" / f"film.{form}")]
    (seen,) = json.loads(subprocess.run(["ffprobe", *words], check=True, capture_output=True).stdout)["streams"]
    assert (seen["codec_name"], seen["pix_fmt"], seen["nb_read_frames"]) == (codec, "yuv420p", "2")
    assert (seen["width"], seen["height"]) == (1280, 720)


FORMATS = [
    "gif",
    pytest.param(
        "mp4", marks=pytest.mark.skipif(not shutil.which("ffmpeg"), reason="no ffmpeg: apt-get install ffmpeg")
    ),
]


@pytest.mark.parametrize("form", FORMATS)
def test_no_half_film_is_left(run: Path, monkeypatch: pytest.MonkeyPatch, form: str) -> None:
    """Stopped at the second frame, what was there before is as it was, and nothing else is there."""
    path = run / "100" / f"film_speed.{form}"
    path.write_text("before")
    show, shown = scene.Scene.show, []

    def stop(self: scene.Scene, moment: Moment) -> None:
        shown.append(moment)
        if len(shown) == 2:
            raise KeyboardInterrupt
        show(self, moment)

    monkeypatch.setattr(scene.Scene, "show", stop)
    assert main(["film", str(run), "--stress", "100", "--by", "speed", "--format", form]) == 130
    assert path.read_text() == "before" and not list(path.parent.glob("*.draft"))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--stress", "300"], "--stress 300: the folders of tests in .* are 100 200"),
        (["--frames", "4"], "--frames 4: a number, or FROM:TO:EVERY, of 0 to 3 is expected"),
    ],
)
def test_nonsense_is_refused(run: Path, capsys: pytest.CaptureFixture[str], words: list[str], message: str) -> None:
    assert main(["film", str(run), "--format", "gif", *words]) == 2
    assert re.search(message, capsys.readouterr().err)


def test_without_ffmpeg(run: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """What needs it is refused; nothing else is asked for than what there can be."""
    monkeypatch.setenv("PATH", "")
    assert main(["film", str(run), "--format", "mp4"]) == 2
    said = capsys.readouterr().err
    assert said == "shearbox: --format mp4 needs ffmpeg: apt-get install ffmpeg; --format gif does not\n"
    assert main(["film", str(run), "--stress", "200", "--frames", "-1"]) == 0
    assert (run / "200" / "film.gif").stat().st_size > 1000


def test_what_cannot_be_filmed(run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """No test; no dumps; no frame in them; no record of the thickness."""
    place = tmp_path / "100"
    place.mkdir()

    def refused(*words: str) -> str:
        assert main(["film", str(tmp_path), "--format", "gif", *words]) in (1, 2)
        return capsys.readouterr().err

    assert "holds no test" in refused()
    shutil.copy(run / "100" / "shear.dat", place)
    assert "there is no grains.dump, discs.dump, contacts.dump, so there are no frames" in refused()
    for name in ("grains", "discs", "contacts"):
        shutil.copy(run / "100" / f"{name}.dump", place)
    assert "--by stress: no run.json tells the thickness" in refused("--by", "stress")
    (place / "discs.dump").write_text("ITEM: TIMESTEP\n0\n")
    assert "discs.dump: there is no whole frame in it" in refused()
