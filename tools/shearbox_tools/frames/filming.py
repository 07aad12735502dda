# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `shearbox film`: tests as moving pictures."""

import shutil
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from subprocess import CalledProcessError

from matplotlib import rc_context
from matplotlib.animation import FFMpegWriter
from rich.console import Console

from ..analysis.moments import Film, Moment
from ..asking.request import read_record
from ..base.errors import InputError, ShearboxError
from ..base.files import RECORD, SHEAR_TABLE, drafted
from ..base.numerals import number
from ..drawing.paints import COLUMNS, make_paint
from ..drawing.scene import Scene
from ..drawing.style import RC
from ..reading.readers import Columns, read_shear
from ..running.display import Whole, make_display
from .gif_writer import GifWriter
from .selection import choose, find_tests

FPS = 12.5  # frames a second; a GIF counts in hundredths of a second
DPI = {"mp4": 160, "webm": 160, "gif": 110}
CODECS = {  # and what ffmpeg needs to be told
    "mp4": ("h264", ["-pix_fmt", "yuv420p", "-crf", "20", "-movflags", "+faststart", "-f", "mp4"]),
    "webm": (
        "libvpx-vp9",
        ["-pix_fmt", "yuv420p", "-crf", "32", "-b:v", "0", "-cpu-used", "4", "-row-mt", "1", "-f", "webm"],
    ),
}
SAMPLES = 9  # frames of which the scales are, about


@dataclass(frozen=True)
class Shot:
    """A test that is filmed, with the steps of its frames."""

    place: Path
    title: str
    load: float | None  # force of the lid on a metre of its width, N; None where it is not recorded
    curves: Columns
    film: Film
    first: Moment  # before shear
    steps: list[int]

    @property
    def ends(self) -> tuple[float, float]:
        """Displacements (mm) of the first and the last frame."""
        begin, end = (self.film.moment(step).displacement for step in (self.steps[0], self.steps[-1]))
        return begin, end


def make_films(folder: Path, by: str, form: str | None, stresses: Sequence[float], frames: str | None) -> list[Path]:
    """Film all tests in a folder, or those of the stresses (kPa), by rotation, speed, stress or chains; the files written
    are returned.

    form: mp4, webm or gif; None: mp4, or gif where there is no ffmpeg. frames: see `selection.choose`. What cannot be done
    is refused before anything is written; a film is whole or not there.
    """
    places = find_tests(folder, stresses)
    has_ffmpeg = shutil.which("ffmpeg") is not None
    if form in CODECS and not has_ffmpeg:
        raise InputError(f"--format {form} needs ffmpeg: apt-get install ffmpeg; --format gif does not")
    form = form or ("mp4" if has_ffmpeg else "gif")
    shots = [_prepare(place, by, frames) for place in places]
    labels = [str(shot.place.relative_to(folder.parent if shot.place == folder else folder)) for shot in shots]
    ends = [shot.ends for shot in shots]
    whole = Whole(
        {label: len(shot.steps) for label, shot in zip(labels, shots)},
        {label: begin / end if end else 0 for label, (begin, end) in zip(labels, ends)},
    )
    display = make_display(Console(), whole)
    written = []
    try:
        for label, shot, (begin, end) in zip(labels, shots, ends):
            path = shot.place / f"film{'' if by == 'rotation' else '_' + by}.{form}"
            display.started(label, end or None, begin)
            _write(path, form, _scene(shot, by), shot, lambda mm: display.moved(label, mm) if end else None)
            display.ended(label, f"{len(shot.steps)} frames")
            written.append(path)
    finally:
        display.close()
    return written


def _prepare(place: Path, by: str, frames: str | None) -> Shot:
    """What the record of its run says is in the title; tests by hand have the name of their folder."""
    curves = read_shear(place / SHEAR_TABLE)
    film = Film(place, curves["step"], curves["displacement_mm"], **COLUMNS.get(by, {}))
    title, load = place.resolve().name, None
    if (place.parent / RECORD).exists():
        identity = read_record(place.parent)["identity"]
        title = f"{identity['model']}, {title} kPa"
        with suppress(KeyError, ValueError):
            load = 1000 * number(place.name) * number(identity["parameters"]["thickness"])
    if by == "stress" and load is None:
        raise InputError(f"--by stress: no {RECORD} tells the thickness and the normal stress of {place}")
    return Shot(place, title, load, curves, film, film.first(), choose(frames, film.steps))


def _scene(shot: Shot, by: str) -> Scene:
    sampled = [*shot.steps[:: max(1, len(shot.steps) // (SAMPLES - 1))], shot.steps[-1]]
    samples = [shot.film.moment(step) for step in sampled]
    paint = None if by == "chains" else make_paint(by, shot.first, shot.load or 1)
    with rc_context(RC):
        return Scene(shot.title, shot.curves, shot.first, samples, paint)


def _writer(form: str) -> FFMpegWriter | GifWriter:
    if form not in CODECS:
        return GifWriter(fps=FPS)
    codec, words = CODECS[form]
    return FFMpegWriter(fps=FPS, codec=codec, extra_args=words)


def _write(path: Path, form: str, scene: Scene, shot: Shot, tell: Callable[[float], None]) -> None:
    """Frame by frame; each tells its displacement (mm)."""
    writer = _writer(form)
    with drafted(path) as draft, rc_context(RC):
        writer.setup(scene.figure, str(draft), DPI[form])
        try:
            for step in shot.steps:
                moment = shot.film.moment(step)
                scene.show(moment)
                writer.grab_frame()
                tell(moment.displacement)
        except BrokenPipeError:
            pass  # ffmpeg has ended: why, it tells at the end
        except BaseException:
            with suppress(CalledProcessError):
                writer.finish()  # so that no program goes on writing
            raise
        try:
            writer.finish()
        except CalledProcessError as error:
            raise ShearboxError(f"{path}: ffmpeg failed: {error.stderr.strip()}") from error
