# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run will do, about how long that takes, how much it writes, and the memory that it needs.

All times are estimates: steps from the stability limit of the smallest disc and from what packing has taken in boxes up to
210 cm high (tests/validation/packing); the time of a step from the log of the packing if that is done, else as measured on
one machine.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ..asking.hosts import HOSTS
from ..asking.models import PARAMETERS, read_variables
from ..asking.request import Request
from ..base.logs import read_logs
from ..base.numerals import number
from ..base.restarts import step_of
from ..base.words import about, amount, duration
from ..reading.readers import last_value
from .disk import BYTES_OF_RESTART, bytes_of_frames
from .phases import CONSOLIDATE, PACK, SHEAR, Phase, frames_of, packing, rows_of_shear, shearing

SECONDS = {PACK: 45e-9, CONSOLIDATE: 25e-9, SHEAR: 25e-9}  # a disc and step; loose grains need new lists all the time
SECONDS_PER_DISC_AND_FRAME = 18e-6
SECONDS_PER_DISC_REPORTED = 240e-6  # of a test (tests/validation/ranks)
BYTES_PER_DISC, BYTES_PER_RANK = 2.6e3, 45e6  # of memory, half of the former for frames (tests/validation/ranks)
# for each disc of a grain; those of packing times the root of the height in smallest grains, as was measured: a high box takes
# waves longer to cross
STEPS_OF_PACKING, STEPS_OF_CONSOLIDATION = 6_000, 10_000
STEPS_OF_ROW = 33  # that a row of shear.dat takes as long as: every grain and contact is in its means
# with a step smaller than usual, over their ratio: stiff contacts need more, large grains that dt_max holds less
MORE_STEPS = 0.6


class Forecast:
    """Of what is left to do of a request in its folder, by phases of so many ranks, which share their grains evenly; nothing is
    written."""

    def __init__(self, folder: Path, request: Request, ranks: int = 1) -> None:
        self._request = request
        self._ranks = ranks
        self._packing = packing(folder, request)
        self._shearing = [phase for sigma in request.stresses for phase in shearing(folder, request, sigma)]
        self._dt = time_step(request)
        self._discs = request.model.ngrains * request.model.discs
        self._slowness = (self._recorded_pace() or HOSTS[request.host].slowness * SECONDS[PACK]) / SECONDS[PACK]

    @property
    def head(self) -> str:
        """A line for the model, and one for each setting."""
        request, model = self._request, self._request.model
        usual = Request(model, ())
        options = {name: getattr(request, name) for name in ("host", "law", "dt", "stiffness")}
        asked = {name: value for name, value in options.items() if value != getattr(usual, name)} | request.settings
        return "\n".join(
            [
                f"{model.name}: {model.ngrains} grains of {model.discs} disc{'s' * (model.discs > 1)}, box "
                f"{100 * model.width:g} x {200 * model.half_height:g} cm, {request.travel:g} mm at {request.speed:g} mm/s",
                *(f"{name} = {value}" for name, value in asked.items()),
            ]
        )

    @property
    def lines(self) -> list[str]:
        """A line for each phase."""
        return [f"{phase.label}: {self._what(phase)}" for phase in self.phases]

    @property
    def phases(self) -> list[Phase]:
        """All of them, in the order of the work."""
        return [self._packing, *self._shearing]

    @property
    def pace(self) -> float:
        """Seconds of a core for a disc and step of shear."""
        return self._slowness * SECONDS[SHEAR]

    @property
    def bytes(self) -> float:
        """Of frames that will still be written."""
        return sum((1 - self.share_done(phase)) * size for phase, size in self._frames)

    @property
    def disk(self) -> float:
        """Bytes that will still be needed: frames, a restart file of each phase that is not done, and two more of one under way."""
        left = sum(not phase.done for phase in self.phases)
        return self.bytes + (left + 2 * (left > 0)) * BYTES_OF_RESTART * self._discs

    @property
    def bytes_of_frames(self) -> float:
        """Of tests that are not done, as large as they will be in the end."""
        return sum(size for phase, size in self._frames if not phase.done)

    @property
    def seconds_of_report(self) -> float:
        """That drawing all tests takes."""
        return self.tests * self._discs * SECONDS_PER_DISC_REPORTED

    @property
    def tests(self) -> int:
        """One for each stress."""
        return len(self._request.stresses)

    @property
    def memory(self) -> float:
        """Bytes that the engine needs, on all ranks."""
        return self._discs * BYTES_PER_DISC + self._ranks * BYTES_PER_RANK

    @property
    def seconds(self) -> float:
        """Time still to go, of all phases one after the other."""
        return sum(map(self.left, self.phases))

    def seconds_with(self, jobs: int) -> float:
        """The same with so many phases at a time, on cores of their own: nothing runs beside the packing."""
        stresses = len(self._request.stresses)
        share = math.ceil(stresses / jobs) / stresses
        return self.left(self._packing) + share * sum(map(self.left, self._shearing))

    def work(self, phase: Phase) -> float:
        """Time of a whole phase. Frames are written by one rank."""
        frames = frames_of(phase.variables) if phase.frames else 0
        rows = rows_of_shear() if phase.name == SHEAR else 0
        steps = self._steps(phase) + STEPS_OF_ROW * rows
        return self._discs * (
            steps * self._slowness * SECONDS[phase.name] / self._ranks + frames * SECONDS_PER_DISC_AND_FRAME
        )

    def longest_wait(self, phase: Phase) -> float:
        """Time until a phase that is asked to end does: it looks after each row of shear, or as grains are checked for rest."""
        steps = number((read_variables(PARAMETERS) | self._request.settings)["check"])
        return self.work(phase) / (rows_of_shear() if phase.name == SHEAR else max(1.0, self._steps(phase) / steps))

    def share_done(self, phase: Phase) -> float:
        """The part of a phase that is done, from 0 to 1, up to its latest restart file: what is behind that is done again. Of one that
        ends when the grains are at rest, about."""
        if phase.done:
            return 1.0
        reached = max((step_of(phase.folder / name) or 0 for name in phase.checkpoints), default=0)
        if phase.name == SHEAR:
            written = last_value(phase.folder / phase.product, "step") or math.inf
            return min(1.0, phase.displacement() / self._request.travel) * min(1.0, reached / written)
        begin = step_of(self._packing.folder / self._packing.restart) or 0 if phase.name == CONSOLIDATE else 0
        share = max(0, reached - begin) / self._steps(phase)
        # it may need more steps than expected: then the share still grows, and stays below 1
        return share if share < 0.9 else 1 - 0.01 / (share - 0.8)

    def left(self, phase: Phase) -> float:
        """Time still to go."""
        return (1 - self.share_done(phase)) * self.work(phase)

    @property
    def _frames(self) -> list[tuple[Phase, float]]:
        """Phases that write frames, and the bytes that these take."""
        return [(phase, bytes_of_frames(self._request)) for phase in self._shearing if phase.frames]

    def _what(self, phase: Phase) -> str:
        if phase.done:
            return "done"
        step = f" of {self._dt:.2g} s" if phase.name == SHEAR else ""
        steps = (1 - self.share_done(phase)) * self._steps(phase)
        return f"about {float(f'{steps:.2g}'):,.0f} steps{step}, {duration(self.left(phase))}"

    def _steps(self, phase: Phase) -> float:
        model = self._request.model
        if phase.name == SHEAR:
            return self._request.travel / self._request.speed / self._dt
        steps: float = STEPS_OF_CONSOLIDATION
        if phase.name == PACK:
            steps = STEPS_OF_PACKING * math.sqrt(2 * model.half_height / model.dmin)
        return model.discs * steps * max(1.0, MORE_STEPS * _usual_step(self._request) / self._dt)

    def _recorded_pace(self) -> float | None:
        """Seconds of a core for a disc and step of the packing, if it is done."""
        log = read_logs(self._packing.log)
        return log.core_seconds / log.steps / self._discs if self._packing.done and log.steps else None


def seconds_of_all(forecasts: Sequence[Forecast], jobs: int) -> float:
    """Time still to go for all of them, with so many phases at a time."""
    return max(sum(f.seconds for f in forecasts) / jobs, *(f.seconds_with(jobs) for f in forecasts), 0.0)


def memory_of_all(forecasts: Sequence[Forecast], jobs: int) -> float:
    """Bytes that so many tests at a time need at most."""
    tests = sum(forecast.tests for forecast in forecasts)
    return min(jobs, tests) * max(forecast.memory for forecast in forecasts)


def total(forecasts: Sequence[Forecast], jobs: int) -> str:
    """A line of the time that is left for all of them, what it goes by, and the memory and disk that are needed."""
    at_a_time = min(jobs, sum(forecast.tests for forecast in forecasts))
    how = f"with {at_a_time} phases at a time" if at_a_time > 1 else "one phase after the other"
    paces = sorted({f"{1e9 * f.pace:.0f}" for f in forecasts}, key=float)
    return (
        f"{about(seconds_of_all(forecasts, jobs))} {how}, without the report; "
        f"{amount(memory_of_all(forecasts, jobs))} of memory, {amount(sum(f.disk for f in forecasts))} of disk (an estimate from "
        f"{' to '.join(dict.fromkeys([paces[0], paces[-1]]))} ns a disc and step of shear, good to a factor of 2)"
    )


def time_step(request: Request) -> float:
    """The step (s) that is asked for, or about what auto will take."""
    if request.dt != "auto":
        return number(request.dt)
    most = number((read_variables(PARAMETERS) | request.settings)["dt_max"])
    return min(0.9 * stability_limit(request), most / math.sqrt(request.stiffness))


def _usual_step(request: Request) -> float:
    """With the stiffness of the decks and no largest step: steps of packing were counted with it."""
    decks = read_variables(PARAMETERS)
    usual = request.settings | {name: decks[name] for name in ("kn", "ks")}
    return 0.9 * stability_limit(replace(request, stiffness=1.0, settings=usual))


def stability_limit(request: Request) -> float:
    """Of the smallest disc in a triangular lattice of its like, s (src/core/stability.h): other contacts of the scene, as those
    of a wall, may have a lower one."""
    texts = read_variables(PARAMETERS) | request.settings
    p = {name: number(texts[name]) for name in ("kn", "ks", "hn", "hs", "density", "thickness")}
    mass = p["density"] * p["thickness"] * math.pi / 4 * request.model.dmin**2
    kn, ks = request.stiffness * p["kn"], request.stiffness * p["ks"]
    stiffness = 6 * kn + 3 * ks
    damping = math.sqrt(2 * mass) * (6 * p["hn"] * math.sqrt(kn) + 3 * p["hs"] * math.sqrt(ks))
    return 4 * mass / (math.sqrt(damping**2 + 4 * mass * stiffness) + damping)
