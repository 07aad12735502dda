# SPDX-License-Identifier: GPL-2.0-or-later
"""The table and the figures of what the runs gave."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
from cases import CASES, LAWS, ORBIT_SPEED, ROOT, SPEED, STEPS, D, Job, Values
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests")]
import tables  # noqa: E402
from shearbox_tools.drawing.style import OTHER_LOOKS, RC  # noqa: E402

COLOURS = {"direct": "#111111", "incremental": OTHER_LOOKS[0].colour}
Found = list[tuple[Job, Values]]


def publish(values: dict[str, Values], out: Path) -> str:
    """Writes tables.md and a figure for each case of which there is something; returns the tables."""
    text = ""
    with rc_context(RC):
        for name, case in CASES.items():
            found = [(job, values[job.key]) for job in case.jobs() if job.key in values]
            if not found:
                continue
            text += f"## {name}\n\n{TABLES[name](found)}\n"
            if name in FIGURES:
                figure = FIGURES[name](found)
                figure.savefig(out / f"{name}.png", dpi=120)
    (out / "tables.md").write_text(f"<!-- SPDX-License-Identifier: GPL-2.0-or-later -->\n# Tables\n\n{text}")
    return text


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    return tables.table(head, rows, spaced=True) + "\n"


def side_by_side(found: Found) -> list[tuple[Job, dict[str, Values]]]:
    """Both laws of what is otherwise the same, where both are there."""
    pairs: dict[tuple[object, ...], tuple[Job, dict[str, Values]]] = {}
    for job, value in found:
        pairs.setdefault((job.dt, *job.options.items()), (job, {}))[1][job.law] = value
    return [(job, laws) for job, laws in pairs.values() if len(laws) == len(LAWS)]


def tenth(series: list[float], last: bool) -> float:
    """Mean of the last, or of the first tenth."""
    n = max(1, len(series) // 10)
    return float(np.mean(series[-n:] if last else series[:n]))


def drift(series: list[float]) -> float:
    """From the mean of the first tenth to that of the last."""
    return tenth(series, True) - tenth(series, False)


def both(laws: dict[str, Values], show: Callable[[Values], str]) -> list[str]:
    return [show(laws[law]) for law in LAWS]


# --- impacts --------------------------------------------------------------------------------------------------------
def impacts_table(found: Found) -> str:
    sines = found[0][1]["obliquity"]
    head = ["dt (s)", "direct, all", *(f"incremental, sin = {sine:g}" for sine in sines)]
    rows = [
        [f"{job.dt:g}", f"{max(laws['direct']['left']):.0e}", *(f"{x:.1e}" for x in laws["incremental"]["left"])]
        for job, laws in side_by_side(found)
    ]
    return "Largest force left at zero overlap over the largest force of the impact:\n\n" + table(head, rows)


def impacts_figure(found: Found) -> Figure:
    figure, axes = one_panel()
    pairs = sorted(side_by_side(found), key=lambda pair: pair[0].dt)
    dt = np.array([job.dt for job, _ in pairs])
    for k, sine in enumerate(found[0][1]["obliquity"]):
        left = [laws["incremental"]["left"][k] for _, laws in pairs]
        axes.loglog(dt, left, "^Dso"[k] + "-", ms=4, color=COLOURS["incremental"], label=f"incremental, sin = {sine:g}")
        if sine:
            label = "closed form" if k == 1 else None
            axes.loglog(dt, left_by_turning(dt, sine), ":", color="#4d4d4d", lw=1, label=label)
    left = [max(laws["direct"]["left"]) for _, laws in pairs]
    axes.loglog(dt, left, "o-", ms=4, color=COLOURS["direct"], label="direct")
    axes.set(xlabel="time step (s)", ylabel="force left / largest force", title="Impacts at 0.1 m/s")
    axes.set_ylim(1e-12, 1e-3)
    axes.legend(loc="center", bbox_to_anchor=(0.5, 0.42), ncols=2, fontsize=7)
    return figure


def left_by_turning(dt: np.ndarray, sine: float) -> np.ndarray:
    """k_n u_t^2 dt/(2 D) over the time of the contact, over the largest force."""
    cosine = math.sqrt(1 - sine**2)
    return SPEED * sine**2 / cosine * dt / (2 * D) * math.pi


# --- orbit ----------------------------------------------------------------------------------------------------------
def orbit_table(found: Found) -> str:
    rows = []
    for job, laws in side_by_side(found):
        law = math.pi * ORBIT_SPEED * job.dt
        grown = both(laws, lambda v: f"{1e6 * (v['overlap'][-1] - v['overlap'][0]):.4f}")
        start = laws["direct"]["overlap"][0]
        rows.append([f"{job.dt:g}", f"{1e6 * start:.4f}", *grown, f"{1e6 * law:.4f}"])
    head = ["dt (s)", "overlap at first (µm)", "grown in a turn: direct (µm)", "incremental (µm)", "π v dt (µm)"]
    return table(head, rows)


def orbit_figure(found: Found) -> Figure:
    figure, axes = one_panel()
    for (job, laws), style in zip(side_by_side(found), ("-", "--", "-.", ":"), strict=False):
        for law in LAWS:
            overlap = 1e6 * np.array(laws[law]["overlap"])
            label = f"{law}, dt = {job.dt:g} s" if law == "incremental" else "direct" if style == "-" else None
            axes.plot(laws[law]["turns"], overlap, style, color=COLOURS[law], label=label)
    axes.set(xlabel="turns", ylabel="overlap (µm)", title="A disc circles another at 1 m/s")
    axes.legend()
    return figure


# --- column ---------------------------------------------------------------------------------------------------------
def column_table(found: Found) -> str:
    def what(job: Job) -> str:
        options = job.options
        away = f", at {options['away']:g} m" if "away" in options else ""
        motion = (
            f"load ± {100 * options['shake']:g} %"
            if "shake" in options
            else "closed"
            if options["speed"] < 0.05
            else "tossed"
        )
        return f"{options['shape']}, {motion}{away}"

    rows = []
    for job, laws in side_by_side(found):
        scale = tenth(laws["direct"]["moving"], False)
        rows.append(
            [
                what(job),
                f"{job.dt:g}",
                *both(laws, lambda v: f"{v['end_lag'] / v['end_overlap']:.1e}"),
                *both(laws, lambda v: f"{1e9 * drift(v['lid'][1:]):+.2f}"),
                *both(laws, lambda v: f"{drift(v['energy'][1:]) / scale:+.1e}" if "lag" in v else ""),
                *both(laws, lambda v: f"{min(v['contacts'])}–{max(v['contacts'])}"),
                *both(laws, lambda v: f"{v['end_pulling']}"),
            ]
        )
    head = ["column", "dt (s)", "lag / overlap at the end: direct", "incremental", "lid: direct (nm)", "incremental"]
    head += ["energy / that of motion: direct", "incremental", "contacts: direct", "incremental"]
    head += ["pull: direct", "incremental"]
    return table(head, rows)


def column_figure(found: Found) -> Figure:
    figure = Figure(figsize=(7.2, 3.0), layout="constrained")
    left, right = figure.subplots(1, 2)
    closed = [(j, v) for j, v in found if j.options["speed"] == 0.005 and "away" not in j.options]
    for job, value in closed:
        if job.law == "incremental":
            share = np.array(value["lag"][1:]) / value["overlap"][1:]
            style = "-" if job.options["shape"] == "zigzag" else ":"
            steps = np.linspace(0, STEPS / 1e6, len(value["lag"]))[1:]
            colour = STEP_COLOURS.get(job.dt, "#4d4d4d")
            left.semilogy(steps, share, style, color=colour, label=f"{job.options['shape']}, {job.dt:g} s")
    left.set(xlabel="million steps", ylabel="lag / overlap", title="incremental: contacts stay closed", ylim=(1e-12, 3))
    left.legend(ncols=2, fontsize=6.5)
    for job, value in closed:
        if job.options["shape"] == "zigzag" and job.dt in (1e-6, 1e-7):
            style = "-" if job.dt == 1e-6 else "--"
            lid = 1e6 * np.array(value["lid"][1:])
            right.plot(value["time"][1:], lid, style, color=COLOURS[job.law], label=f"{job.law}, {job.dt:g} s")
    right.set(xlabel="time (s)", ylabel="height of the lid (µm)", title="zigzag: the lid")
    right.legend()
    return figure


STEP_COLOURS = {1.3e-6: "#7b3294", 1e-6: "#e08214", 3e-7: "#17a2b8", 1e-7: "#8c510a"}


# --- ring -----------------------------------------------------------------------------------------------------------
def ring_table(found: Found) -> str:
    rows = []
    for job, laws in side_by_side(found):
        share = both(laws, lambda v: f"{v['lag'][-1] / v['overlap'][-1]:.1e}")
        rows.append([f"{job.options['speed']:g}", f"{job.dt:g}", *share])
    return table(["speed (m/s)", "dt (s)", "lag / overlap at the end: direct", "incremental"], rows)


# --- bed ------------------------------------------------------------------------------------------------------------
def bed_table(found: Found) -> str:
    rows = []
    for job, laws in side_by_side(found):
        rows.append(
            [
                f"{job.options['shake']:g}",
                f"{laws['direct']['dt']:.2e}",
                f"{laws['direct']['steps']:.1e}",
                *both(laws, lambda v: f"{v['end_lag'][-1] / v['end_overlap'][-1]:.1e}"),
                *both(laws, lambda v: f"{1e6 * np.mean(v['end_overlap'][5:]) / np.mean(v['end_contacts'][5:]):.3f}"),
                *both(laws, lambda v: f"{100 * sum(v['end_pulling'][5:]) / sum(v['end_contacts'][5:]):.1f}"),
                *both(laws, lambda v: f"{np.mean(v['end_contacts'][5:]):.0f}"),
                *both(laws, lambda v: f"{1e3 * np.mean(v['lid'][100:]):.4f}"),
                *both(laws, lambda v: f"{1e3 * np.mean(v['spring'][100:]):.3f}"),
                *both(laws, lambda v: f"{1e3 * np.mean(v['kinetic'][100:]):.4f}"),
            ]
        )
    names = ["lag / overlap", "overlap a contact (µm)", "contacts that pull (%)", "contacts", "height (mm)"]
    names += ["springs (mJ)", "motion (mJ)"]
    head = ["shaken by", "dt (s)", "steps", *(word for name in names for word in (name, "incr."))]
    note = "First direct, then incremental. The lag at the end, all else means of the second half of the run.\n\n"
    return note + table(head, rows)


def bed_figure(found: Found) -> Figure:
    figure = Figure(figsize=(7.2, 4.6), layout="constrained")
    panels = figure.subplots(2, 2)
    for shake, (heights, lags) in zip((0.3, 3.0), panels, strict=True):
        mine = [(job, value) for job, value in found if job.options["shake"] == shake]
        start = mine[0][1]["lid"][0]
        for job, value in mine:
            style = "-" if job.dt == 1 else "--"
            label = f"{job.law}, dt = {value['dt']:.2g} s"
            time, lid = np.array(value["time"]), 1e6 * (np.array(value["lid"]) - start)
            if job.dt == 1:
                heights.plot(time, lid, lw=0.8, color=COLOURS[job.law])
            looks = time[-1] * np.linspace(0.1, 1, len(value["end_lag"]))
            share = 100 * np.divide(value["end_lag"], value["end_overlap"])
            lags.plot(looks, share, ("o" if job.dt == 1 else ".") + style, ms=3, color=COLOURS[job.law], label=label)
        heights.set(xlabel="time (s)", ylabel="rise of the lid (µm)")
        heights.set_title(f"force on the grains {shake:g} × the lid's")
        lags.set(xlabel="time (s)", ylabel="lag / overlap (%)", title="sums over all contacts")
    panels[0][1].legend(fontsize=7)
    return figure


# --- shear ----------------------------------------------------------------------------------------------------------
def shear_table(found: Found) -> str:
    rows = []
    for job, laws in side_by_side(found):
        late = slice(len(laws["direct"]["tau_kPa"]) // 4, None)
        rows.append(
            [
                f"{job.options['speed']}",
                f"{job.options['seed']}",
                f"{job.dt:g}",
                *both(laws, lambda v: f"{max(smooth(v['tau_kPa'])):.0f}"),
                *both(laws, lambda v: f"{np.mean(v['tau_kPa'][late]):.1f}"),
                *both(laws, lambda v: f"{v['lid_mm'][-1]:.2f}"),
                *both(laws, lambda v: f"{1e3 * np.mean(v['kinetic_J']):.2f}"),
                *both(laws, lambda v: f"{v['end_lag'] / v['end_overlap']:.1e}"),
                *both(laws, lambda v: f"{v['end_pulling']}/{v['end_contacts']}"),
            ]
        )
    names = ["peak τ (kPa)", "mean τ from 2 mm (kPa)", "lid at 8 mm (mm)", "kinetic energy (mJ)"]
    names += ["lag / overlap", "pull"]
    head = ["mm/s", "seed", "dt / auto", *(word for name in names for word in (name, "incr."))]
    note = "First direct, then incremental; the peak is of means over 0.2 mm. The last two at the end of the test.\n\n"
    return note + table(head, rows)


def smooth(series: list[float], rows: int = 20) -> np.ndarray:
    """Running mean over so many rows, of 0.01 mm each."""
    return np.convolve(series, np.full(rows, 1 / rows), "valid")


def shear_figure(found: Found) -> Figure:
    figure = Figure(figsize=(7.2, 4.6), layout="constrained")
    panels = figure.subplots(2, 2, sharex=True)
    for speed, (stress, height) in zip((200, 2), panels.T, strict=True):
        for job, value in found:
            if job.options["speed"] != speed or job.dt != 1:
                continue
            label = job.law if job.options["seed"] == 1 else None
            place = smooth(value["displacement_mm"])
            stress.plot(place, smooth(value["tau_kPa"]), color=COLOURS[job.law], lw=0.9, label=label)
            height.plot(value["displacement_mm"], value["lid_mm"], color=COLOURS[job.law], lw=0.9)
        stress.set(ylabel="shear stress (kPa)", title=f"{speed} mm/s", ylim=(0, None))
        height.set(xlabel="shear displacement (mm)", ylabel="rise of the lid (mm)")
    panels[0][0].legend()
    return figure


def one_panel() -> tuple[Figure, Axes]:
    figure = Figure(figsize=(4.6, 3.2), layout="constrained")
    return figure, figure.subplots()


TABLES: dict[str, Callable[[Found], str]] = {
    "impacts": impacts_table,
    "orbit": orbit_table,
    "column": column_table,
    "ring": ring_table,
    "bed": bed_table,
    "shear": shear_table,
}
FIGURES: dict[str, Callable[[Found], Figure]] = {
    "impacts": impacts_figure,
    "orbit": orbit_figure,
    "column": column_figure,
    "bed": bed_figure,
    "shear": shear_figure,
}
