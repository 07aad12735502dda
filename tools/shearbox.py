# SPDX-License-Identifier: GPL-2.0-or-later
"""Shearbox in a script or a notebook: run tests, read what they gave, as tables of pandas::

    import shearbox

    (test,) = shearbox.run("TypeA_10x5_4-8_1-circle_350", "results/first", stress=[100, 200], speed=200)
    print(test.phi_deg, test.peaks())
    test.curve(100).plot(x="displacement_mm", y="tau_kPa")
    test.frame(100, -1)["contacts"]

There is a test for each specimen: one here, eight with seeds=8. Stresses are in kPa, lengths of the test in mm, angles in
degrees; frames are in SI units. What cannot be done raises shearbox.Error, with the reason. Needs python3-pandas, and this folder
in PYTHONPATH.
"""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pandas as pd
from rich.console import Console

from shearbox_tools.analysis.polynomial import Fit
from shearbox_tools.analysis.results import Results, read_results
from shearbox_tools.analysis.shear import Shear
from shearbox_tools.base.errors import InputError, ShearboxError
from shearbox_tools.commands.campaign_file import words_of
from shearbox_tools.commands.run import carry_out, opened, prepare
from shearbox_tools.commands.run_options import parse_run
from shearbox_tools.frames.tables import Tables
from shearbox_tools.reports.report_on import report_on
from shearbox_tools.running.display import Whole
from shearbox_tools.running.run_folders import find_runs

Error = ShearboxError
Progress = Callable[[float, str], None]

__all__ = ["Error", "Progress", "Test", "read", "run", "runs"]


class Test:
    """One specimen, sheared at one or several normal stresses; read from its folder."""

    __test__ = False  # not one of pytest's

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)
        self.results: Results = read_results(self.folder)

    @property
    def model(self) -> str:
        """Name of the model."""
        return str(self.results.identity["model"])

    @property
    def seed(self) -> int:
        """Of the packing."""
        return int(self.results.identity["seed"])

    @property
    def stresses(self) -> list[float]:
        """Those for which there is a curve, kPa."""
        return [shear.sigma for shear in self.results.shears]

    @property
    def doubts(self) -> list[str]:
        """Why there is no strength, if so."""
        return self.results.doubts

    @property
    def phi_deg(self) -> float | None:
        """Friction angle by the peaks of the polynomials and the lid's stress; None if it cannot be told."""
        line = self.results.strength
        return line.phi_deg if line else None

    @property
    def c_kPa(self) -> float | None:
        """Cohesion of the same line."""
        line = self.results.strength
        return line.c_kPa if line else None

    @property
    def phi_plane_deg(self) -> float | None:
        """Friction angle by the stresses on the shear plane."""
        line = self.results.plane_strength
        return line.phi_deg if line else None

    def curve(self, sigma: float) -> pd.DataFrame:
        """All columns of shear.dat at a stress, a row for each interval of the displacement; and the fitted curves tau_fit_kPa
        and lid_fit_mm, in the rows at full speed."""
        shear = self._shear(sigma)
        table = pd.DataFrame(shear.data)
        for name, fit in (("tau_fit_kPa", shear.tau), ("lid_fit_mm", shear.lid)):
            table[name] = _fitted(table["displacement_mm"], shear, fit)
        return table

    def peaks(self) -> pd.DataFrame:
        """A row for each stress: peak of the polynomial and of the smoothed data with their errors, dilation angle, ultimate
        stress, TRM at the end."""
        rows = [
            {
                "sigma_kPa": shear.sigma,
                "tau_kPa": shear.peak.value,
                "tau_error_kPa": shear.peak.value_error,
                "displacement_mm": shear.peak.position,
                "tau_smoothed_kPa": shear.smoothed.value,
                "tau_smoothed_error_kPa": shear.smoothed.value_error,
                "dilation_deg": shear.at_peak.dilation_deg,
                "tau_ultimate_kPa": shear.ultimate[0],
                "trm": float(shear.data["trm"][-1]),
            }
            for shear in self.results.shears
        ]
        return pd.DataFrame(rows).set_index("sigma_kPa")

    def frames(self, sigma: float) -> pd.DataFrame:
        """Step, displacement (mm) and time (s) of the frames at a stress, in order."""
        tables = self._tables(sigma)
        return pd.DataFrame([vars(tables.instant(step)) for step in tables.steps])

    def frame(self, sigma: float, number: int) -> dict[str, pd.DataFrame]:
        """Grains, discs, walls, contacts and cells of a frame, by these names; -1 is the last."""
        tables = self._tables(sigma)
        try:
            step = tables.steps[number]
        except IndexError:
            raise InputError(f"frame {number}: there are {len(tables.steps)} of {sigma:g} kPa") from None
        return {name: pd.DataFrame(columns) for name, columns in tables.frame(step).items()}

    def report(self) -> Path:
        """Write report.html, summary.json and the curves; the path of the page."""
        return report_on(self.folder)

    def _shear(self, sigma: float) -> Shear:
        for shear in self.results.shears:
            if shear.sigma == sigma:
                return shear
        known = ", ".join(f"{s:g}" for s in self.stresses) or "none"
        raise InputError(f"{self.folder}: there is no curve of {sigma} kPa; there are {known}")

    def _tables(self, sigma: float) -> Tables:
        return Tables(self._shear(sigma).folder)


def run(
    model: str | Path,
    out: str | Path,
    *,
    progress: Progress | None = None,
    jobs: int = 2,
    ranks: int = 1,
    engine: str | Path | None = None,
    **options: Any,
) -> list[Test]:
    """Carry out what `shearbox run MODEL --out OUT` does, and read it; a test for each specimen.

    `options` are those of the command, such as stress=[100, 200], speed=20, seeds=4, set={"phi": 30}. What is done already is
    not done again. `progress` is called with the share of all that is done, from 0 to 1, and what is going on.
    """
    words = [str(model), "--out", str(out), "--jobs", str(jobs), "--ranks", str(ranks)]
    words += ["--engine", str(engine)] if engine else []
    for name, value in options.items():
        words += words_of(name, value)
    given, asked = parse_run(words)
    if given.dry_run:
        raise InputError("dry-run: this is for the command line alone")
    folder, planned, program = prepare(given, asked)
    with opened(folder, planned) as locks:
        show = partial(_Teller, tell=progress or (lambda share, text: None))
        problems = carry_out(planned, program, jobs, locks, Console(quiet=True), show)
    if problems:
        raise ShearboxError("\n".join(problems))
    return [Test(one.folder) for one in planned]


def read(folder: str | Path) -> Test:
    """The run in a folder."""
    return Test(folder)


def runs(folder: str | Path) -> list[Test]:
    """All runs at or below a folder."""
    return [Test(place) for place in find_runs(Path(folder))]


def _fitted(displacement: pd.Series, shear: Shear, fit: Fit) -> pd.Series:
    within = displacement.iloc[shear.rows]
    return pd.Series(fit.series(within.to_numpy()), within.index)


class _Teller:
    """Tells progress by a function; see Display in display.py."""

    def __init__(self, work: Whole, tell: Progress) -> None:
        self._work, self._tell = work, tell
        self._travels: dict[str, float] = {}

    def started(self, label: str, travel: float | None, reached: float) -> None:
        self._travels[label] = travel or 0.0
        self._say(label)

    def moved(self, label: str, displacement: float) -> None:
        self._work.reached(label, displacement / self._travels[label])
        self._say(label)

    def ended(self, label: str, note: str) -> None:
        self._work.reached(label, 1)
        self._say(f"{label}: {note}")

    def given_up(self, labels: list[str]) -> None:
        self._work.give_up(labels)

    def say(self, text: str) -> None:
        self._say(text)

    def close(self) -> None:
        pass

    def _say(self, text: str) -> None:
        self._tell(self._work.done / self._work.total if self._work.total else 1.0, text)
