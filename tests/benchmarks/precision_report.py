# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables (Markdown) and figures of work_precision."""

from __future__ import annotations

import json
import math
import statistics
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import impacts
import matplotlib.pyplot as plt
import numpy as np
import settling
from cases import FULL_TEST
from engines import CDEM, STOCK
from matplotlib.axes import Axes
from records import Records
from report import COLOURS, table
from whole_tests import SPEEDS, REFERENCE, SETTINGS, STRESSES, Outcome, Setting

Array = np.ndarray[Any, np.dtype[np.float64]]
MARKERS = {CDEM: "o", STOCK: "s"}
SIGNIFICANT = 2  # standard errors
VISIBLE = (2, 5)  # differences of means, %


@dataclass(frozen=True)
class Trial:
    """A run of impacts, settling or presets, and how wrong it was."""

    part: str
    scene: str
    engine: str
    level: float  # steps a contact; of presets the travel, mm
    steps: int
    discs: int
    seconds: float  # of the loop; of long ones those in which there was a processor
    errors: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Curve:
    """Errors of an engine against the time of its runs (s), by steps a contact."""

    engine: str
    levels: list[float]
    seconds: list[float]
    errors: list[float]

    def time_for(self, error: float) -> float | None:
        """Time that an error takes, between runs on the line in the double-logarithmic plot; None if it is not reached.

        Errors do not always fall with the step: what counts is the largest step from which on all are as small.
        """
        if not self.errors or self.errors[-1] > error:
            return None
        last = max((i for i, e in enumerate(self.errors) if e > error), default=None)
        if last is None:
            return self.seconds[0]
        (t0, t1), (e0, e1) = self.seconds[last : last + 2], self.errors[last : last + 2]
        share = math.log(e0 / error) / math.log(e0 / e1)
        return t0 * (t1 / t0) ** share


def settling_curves(trials: list[Trial], scene: str, kind: str) -> list[Curve]:
    """One for each engine; the time is that of the fastest round."""
    found = []
    for engine in COLOURS:
        there = [t for t in trials if (t.part, t.scene, t.engine) == ("settling", scene, engine)]
        levels = sorted({t.level for t in there})
        by_level = [[t for t in there if t.level == level] for level in levels]
        if levels:
            seconds = [min(t.seconds for t in some) for some in by_level]
            found.append(Curve(engine, levels, seconds, [some[0].errors[kind] for some in by_level]))
    return found


def windows(trials: list[Trial]) -> str:
    """The time over which beds are compared."""
    seconds = {t.scene: t.errors["seconds"] for t in trials if t.part == "settling"}
    spans = (f"{1e3 * s:.3g} of {1e3 * settling.SCENES[name].seconds:.3g} ms of {name}" for name, s in seconds.items())
    return f"Compared are the first {', '.join(spans)}."


def impact_curves(trials: list[Trial], scene: str) -> list[Curve]:
    """One for each engine; the time an impact is that of its steps, which all take as long (median of the rounds)."""
    found = []
    for engine in COLOURS:
        there = [t for t in trials if (t.part, t.scene, t.engine) == ("impacts", scene, engine)]
        steps = [t.seconds / t.steps for t in there if t.level == impacts.TIMED]
        there = sorted((t for t in there if t.level != impacts.TIMED), key=lambda t: t.level)
        if steps and there:
            seconds = [t.steps * statistics.median(steps) / impacts.PAIRS for t in there]
            found.append(Curve(engine, [t.level for t in there], seconds, [t.errors["velocity"] for t in there]))
    return found


def curve_table(found: list[Curve], unit: float, name: str) -> str:
    """Error and time of every engine by steps a contact."""
    head = ["steps a contact", *(f"{c.engine}: error (%)" for c in found), *(f"{c.engine}: {name}" for c in found)]
    rows = []
    for level in sorted({level for c in found for level in c.levels}):
        index = [c.levels.index(level) for c in found]
        rows.append(
            [f"{level:g}"]
            + [f"{100 * c.errors[i]:.2g}" for c, i in zip(found, index, strict=True)]
            + [f"{c.seconds[i] / unit:.3g}" for c, i in zip(found, index, strict=True)]
        )
    return table(head, rows)


def needed_table(scenes: dict[str, list[Curve]], errors: tuple[float, ...], unit: float, name: str) -> str:
    """Time that each engine needs for an error, and how many times as long the peers need."""
    rows = []
    for scene, found in scenes.items():
        for error in errors:
            times = {c.engine: c.time_for(error) for c in found}
            ours = times[CDEM]
            cells = [f"{t / unit:.3g}" if t else "not reached" for t in times.values()]
            ratios = [f"{t / ours:.1f}" if t and ours else "–" for e, t in times.items() if e != CDEM]
            rows.append([scene, f"{100 * error:g}", *cells, *ratios])
    engines = [c.engine for c in next(iter(scenes.values()))]
    head = ["scene", "error (%)", *(f"{e} ({name})" for e in engines), *(f"× {e}" for e in engines if e != CDEM)]
    return table(head, rows)


# whole tests


@dataclass(frozen=True)
class Measure:
    """A number that a specimen gives, and how it is called."""

    name: str
    value: Callable[[Outcome], float]


def mean_ratio(stresses: list[float]) -> float:
    """Mean of tau over sigma."""
    return float(np.mean(np.array(stresses) / STRESSES))


MEASURES = [
    Measure("φ (degrees)", lambda o: o.phi_deg),
    Measure("mean of peak τ/σ", lambda o: mean_ratio(o.tau_peak_kPa)),
    Measure("mean τ/σ", lambda o: mean_ratio(o.tau_mean_kPa)),
    Measure("steepest dilatancy", lambda o: float(np.mean(o.steepest))),
]


@dataclass(frozen=True)
class Difference:
    """Mean relative difference of pairs of runs with the same seed, in %."""

    percent: float
    deviation: float  # of the pairs, standard
    pairs: int

    @property
    def error(self) -> float:
        """Standard error of the mean."""
        return self.deviation / math.sqrt(self.pairs)

    @property
    def resolved(self) -> bool:
        """Whether the mean is more than chance."""
        return abs(self.percent) > SIGNIFICANT * self.error

    def __str__(self) -> str:
        return f"{self.percent:+.1f} ± {self.error:.1f} %" + " **" * self.resolved


def difference(measure: Measure, outcomes: list[Outcome], base: list[Outcome]) -> Difference:
    """Seed by seed: a packing has more influence than a setting, and with another speed it is even the same specimen."""
    known = {o.seed: measure.value(o) for o in base}
    found = [100 * (measure.value(o) / known[o.seed] - 1) for o in outcomes if o.seed in known]
    if len(found) < 2:
        return Difference(math.nan, math.nan, len(found))
    return Difference(statistics.mean(found), statistics.stdev(found), len(found))


def seconds_a_test(outcomes: list[Outcome]) -> float:
    """Shear phase at one stress, s of the processor, mean over stresses and median over seeds."""
    return statistics.median(o.shear_s / len(STRESSES) for o in outcomes)


def by_setting(outcomes: list[Outcome]) -> dict[Setting, list[Outcome]]:
    """Settings with two seeds or more."""
    found = {setting: [o for o in outcomes if o.setting == setting.name] for setting in SETTINGS}
    return {setting: some for setting, some in found.items() if len(some) > 1}


def tests_table(settings: dict[Setting, list[Outcome]]) -> str:
    """Every setting, its seeds, its time, and every measure against the reference."""
    rows = []
    for setting, outcomes in settings.items():
        seconds, prepare = seconds_a_test(outcomes), statistics.median(o.prepare_s for o in outcomes)
        row = [setting.name, str(len(outcomes)), f"{seconds:.1f}", f"{prepare:.1f}"]
        for measure in MEASURES:
            values = [measure.value(o) for o in outcomes]
            digits = 1 if values[0] > 10 else 3
            text = f"{statistics.mean(values):.{digits}f} (sd {statistics.stdev(values):.{digits}f})"
            if setting != REFERENCE:
                text += f", {difference(measure, outcomes, settings[REFERENCE])}"
            row.append(text)
        rows.append(row)
    head = ["setting", "seeds", "shear, s a stress", "packing and consolidation, s", *(m.name for m in MEASURES)]
    return table(head, rows)


def scatter_table(settings: dict[Setting, list[Outcome]]) -> str:
    """How much specimens and pairs differ, and how many pairs it takes to see a difference of the means."""
    kinds = {
        "same specimen, other speed": [(s, REFERENCE) for s in settings if s.stiffness == 1 and is_plain(s)],
        "own packing": [(s, Setting(s.speed)) for s in settings if s.stiffness != 1 or not is_plain(s)],
    }
    rows = []
    for measure in MEASURES:
        groups = [[measure.value(o) for o in outcomes] for outcomes in settings.values()]
        own = pooled([(100 * statistics.stdev(values) / statistics.mean(values), len(values)) for values in groups])
        rows.append([measure.name, f"{own:.0f}"])
        for pairs in kinds.values():
            found = [difference(measure, settings[a], settings[b]) for a, b in pairs if a != b and b in settings]
            scatter = pooled([(d.deviation, d.pairs) for d in found if d.pairs > 1])
            needed = [f"{math.ceil((SIGNIFICANT * scatter / v) ** 2)}" if scatter >= 0 else "–" for v in VISIBLE]
            rows[-1] += [f"{scatter:.0f}" if scatter >= 0 else "–", *needed]
    head = ["measure", "standard deviation of a specimen (%)"]
    for kind in kinds:
        head += [f"of a pair: {kind} (%)", *(f"pairs for {v:g} %" for v in VISIBLE)]
    return table(head, rows)


def is_plain(setting: Setting) -> bool:
    """Whether it has the step and the law of the reference, and so, at its stiffness, the packings."""
    return (setting.dt, setting.law) == (REFERENCE.dt, REFERENCE.law)


def pooled(samples: list[tuple[float, int]]) -> float:
    """Standard deviation from those of several samples and their sizes; NaN from none."""
    freedom = sum(count - 1 for _, count in samples)
    return (
        math.sqrt(sum((count - 1) * deviation**2 for deviation, count in samples) / freedom) if freedom else math.nan
    )


def presets_table(trials: list[Trial]) -> str:
    """Time of a whole shear test (s), and how many times less than stock LAMMPS at the reference."""
    times = {
        (name, engine): [t.seconds * FULL_TEST[0] / t.level for t in trials if (t.part, t.scene, t.engine) == key]
        for name in SPEEDS
        for engine in COLOURS
        if (key := ("presets", name, engine))
    }
    base = times["reference", STOCK]
    rows = []
    for (name, engine), seconds in times.items():
        if seconds:
            less = [a / b for a, b in zip(base, seconds, strict=False)]
            ratio = f"{statistics.median(less):.1f} ({min(less):.1f}–{max(less):.1f})" if less else "–"
            rows.append([name, engine, str(len(seconds)), f"{statistics.median(seconds):.2f}", ratio])
    return table(["setting", "engine", "rounds", "s", "times less than LAMMPS at the reference"], rows)


# figures


def draw_impacts(scenes: dict[str, list[Curve]], file: Path) -> None:
    """A panel an impact."""
    figure, panels = plt.subplots(2, 3, figsize=(9, 5.6), sharex=True, sharey=True)
    for axes, (name, found) in zip(panels.flat, scenes.items(), strict=True):
        for curve in found:
            draw_curve(axes, curve, 1e-6)
        axes.set_title(name, fontsize=9)
    finish(panels, "time an impact (µs)", "error of the velocity (–)")
    panels[0, 0].legend(fontsize=8)
    save(figure, file)


def draw_settling(scenes: dict[str, dict[str, list[Curve]]], file: Path) -> None:
    """A row of panels a bed: kinetic energy, height."""
    figure, panels = plt.subplots(2, 2, figsize=(8, 6), sharey=True)
    for row, (name, kinds) in zip(panels, scenes.items(), strict=True):
        for axes, (kind, found) in zip(row, kinds.items(), strict=True):
            for curve in found:
                draw_curve(axes, curve, 1)
            axes.set_title(f"{name}: {kind}", fontsize=9)
    finish(panels, "time of the run (s)", "error (–)")
    panels[0, 0].legend(fontsize=8)
    save(figure, file)


def draw_curve(axes: Axes, curve: Curve, unit: float) -> None:
    """An engine's line, the numbers of steps a contact beside its ends."""
    seconds = [s / unit for s in curve.seconds]
    style = {"color": COLOURS[curve.engine], "marker": MARKERS.get(curve.engine, "^"), "markersize": 4}
    axes.loglog(seconds, curve.errors, label=curve.engine, linewidth=1.2, **style)
    if curve.engine == CDEM:
        for i in (0, -1):
            axes.annotate(f"{curve.levels[i]:g}", (seconds[i], curve.errors[i]), (-4, -10), textcoords="offset points",
                          fontsize=7, color=COLOURS[CDEM])  # fmt: skip


def finish(panels: Any, x: str, y: str) -> None:
    """Labels at the borders, a grid."""
    for axes in panels.flat:
        axes.grid(alpha=0.3, linewidth=0.5)
        axes.minorticks_off()
    for axes in panels[-1]:
        axes.set_xlabel(x)
    for axes in panels[:, 0]:
        axes.set_ylabel(y)


SPEED_COLOURS: dict[float, str] = {10: "tab:blue", 20: "tab:green", 50: "tab:red", 200: "tab:purple"}
STIFFNESS_MARKERS = {1: "o", 0.1: "s", 0.01: "^"}
LEAST = 0.05  # %, end of the axis


def draw_tests(settings: dict[Setting, list[Outcome]], stock: float | None, file: Path) -> None:
    """A panel a measure: difference from the reference against the time of a shear test."""
    figure, panels = plt.subplots(2, 2, figsize=(9.5, 8), sharex=True, sharey=True)
    figure.set_layout_engine("constrained", rect=(0, 0, 1, 0.9))
    for axes, measure in zip(panels.flat, MEASURES, strict=True):
        values = [measure.value(o) for o in settings[REFERENCE]]
        axes.axhspan(LEAST, 100 * statistics.stdev(values) / statistics.mean(values), color="0.92")
        for setting, outcomes in settings.items():
            if setting == REFERENCE:
                continue
            d = difference(measure, outcomes, settings[REFERENCE])
            if d.pairs < 2:
                continue
            colour, x, y = SPEED_COLOURS[setting.speed], seconds_a_test(outcomes), max(LEAST, abs(d.percent))
            chance = SIGNIFICANT * d.error
            axes.plot([x, x], [max(LEAST, abs(d.percent) - chance), y + chance], color=colour, lw=0.8, alpha=0.6)
            marker = STIFFNESS_MARKERS[setting.stiffness]
            axes.plot(x, y, marker, color=colour, markersize=6, mfc=colour if d.resolved else "white", clip_on=False)
            extra = setting.name.split(", ", 2)[2:]
            if extra:
                below = setting.law != REFERENCE.law  # the two that have the same speed and stiffness
                axes.annotate(extra[0], (x, y), (5, -8 if below else 3), textcoords="offset points", fontsize=7)
        if stock:
            axes.axvline(stock, color=COLOURS[STOCK], linewidth=1)
        axes.axvline(seconds_a_test(settings[REFERENCE]), color="black", linewidth=1)
        axes.set_title(measure.name, fontsize=10)
        axes.set(xscale="log", yscale="log", ylim=(LEAST, 100))
    finish(panels, "shear phase at one stress (s)", "mean difference from the reference (%)")
    add_key(figure, settings, bool(stock))
    save(figure, file)


def add_key(figure: plt.Figure, settings: dict[Setting, list[Outcome]], stock: bool) -> None:
    """Legend of the figure of whole tests, above it: what was measured, and no more."""
    speeds, stiffnesses = {s.speed for s in settings}, {s.stiffness for s in settings}

    def entry(label: str, **style: Any) -> plt.Line2D:
        return plt.Line2D([], [], label=label, **style)

    entries = [entry(f"{v:g} mm/s", color=c, marker="o", ls="") for v, c in SPEED_COLOURS.items() if v in speeds]
    entries += [
        entry(f"stiffness {k:g}", color="black", marker=m, mfc="white", ls="")
        for k, m in STIFFNESS_MARKERS.items()
        if k in stiffnesses and len(stiffnesses) > 1
    ]
    entries.append(entry(f"filled: beyond {SIGNIFICANT} standard errors", color="black", marker="o", ls=""))
    band = f"standard deviation of a specimen ({len(settings[REFERENCE])} seeds)"
    entries.append(plt.Rectangle((0, 0), 1, 1, color="0.92", label=band))
    entries.append(entry("reference, cdem", color="black"))
    if stock:
        entries.append(entry("reference, LAMMPS", color=COLOURS[STOCK]))
    figure.legend(handles=entries, ncols=4, fontsize=8, loc="upper center")


def save(figure: plt.Figure, file: Path) -> None:
    """Writes a figure."""
    figure.savefig(file, metadata={"Date": None})
    plt.close(figure)


def publish(folder: Path) -> str:
    """Writes tables and figures of all that is in a folder; returns the tables."""
    plt.rcParams.update({"figure.constrained_layout.use": True, "svg.fonttype": "none", "axes.axisbelow": True})
    trials = Records(folder / "trials.jsonl", Trial).found
    settings = by_setting(Records(folder / "tests.jsonl", Outcome).found)
    machine = json.loads((folder / "machine.json").read_text())
    parts = ["\n".join(f"- {name}: {value}" for name, value in machine.items())]

    hits = {n: impact_curves(trials, n) for n in impacts.IMPACTS}
    if all(hits.values()):
        draw_impacts(hits, folder / "impacts.svg")
        parts.append("## Impacts\n\n" + needed_table(hits, (0.01, 0.001, 0.0001), 1e-6, "µs an impact"))
        parts += [f"{name}:\n\n{curve_table(found, 1e-6, 'µs an impact')}" for name, found in hits.items()]
    beds = {n: {kind: settling_curves(trials, n, kind) for kind in ("kinetic", "height")} for n in settling.SCENES}
    if all(found for kinds in beds.values() for found in kinds.values()):
        draw_settling(beds, folder / "settling.svg")
        flat = {f"{n}, {kind}": found for n, kinds in beds.items() for kind, found in kinds.items()}
        parts.append("## Beds under gravity\n\n" + windows(trials))
        parts.append(needed_table(flat, (1e-3, 5e-4, 2e-4), 1, "s"))
        parts += [f"{name}:\n\n{curve_table(found, 1, 's')}" for name, found in flat.items()]
    timed = [t for t in trials if t.part == "presets"]
    if timed:
        parts.append("## Time of a shear test\n\n" + presets_table(trials))
    if REFERENCE in settings:
        stock = [t.seconds * FULL_TEST[0] / t.level for t in timed if (t.scene, t.engine) == ("reference", STOCK)]
        draw_tests(settings, statistics.median(stock) if stock else None, folder / "tests.svg")
        parts.append("## Whole tests\n\n" + tests_table(settings))
        parts.append(scatter_table(settings))
    text = "\n\n".join(parts) + "\n"
    (folder / "tables.md").write_text(text)
    return text
