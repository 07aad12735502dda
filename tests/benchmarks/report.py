# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables (Markdown) and plots of what was measured."""

from __future__ import annotations

import statistics
import sys
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from engines import CDEM, LIGGGHTS, PHASES, STOCK, Sample
from cases import BY_RANKS, BY_SIZE, BY_WIDTH, SCENES

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import tables  # noqa: E402

table = partial(tables.table, spaced=True)
Samples = dict[str, list[Sample]]  # of a scene, by engine; the n-th of each were measured in turn
PEERS = (STOCK, LIGGGHTS)
COLOURS = {CDEM: "tab:blue", STOCK: "tab:orange", LIGGGHTS: "tab:green"}


def median_ns(samples: Iterable[Sample]) -> float:
    """Median time per disc and step, ns."""
    return statistics.median(sample.ns for sample in samples)


def ratios(scene: Samples, peer: str) -> list[float]:
    """How many times as long a peer took, round by round."""
    return [theirs.ns / ours.ns for ours, theirs in zip(scene[CDEM], scene[peer], strict=True)]


def text(machine: dict[str, str], scenes: dict[str, Samples]) -> str:
    """The whole report, but for the plots."""
    parts = [
        "\n".join(f"- {name}: {value}" for name, value in machine.items()),
        "Time per disc and step of the whole run (ns), medians; how many times as long the peers take, median (range) "
        "of the rounds:\n\n" + speed_table(scenes),
        "Time per disc and step by phase (ns), as the engines say, and neighbour rebuilds:\n\n" + phase_table(scenes),
    ]
    for extra in (shear_text(scenes), memory_text(scenes), rank_text(scenes)):
        if extra:
            parts.append(extra)
    return "\n\n".join(parts) + "\n"


def speed_table(scenes: dict[str, Samples]) -> str:
    """Times and ratios by scene."""
    rows = []
    for name, scene in scenes.items():
        row = [name, str(len(scene[CDEM])), f"{median_ns(scene[CDEM]):.1f}"]
        row += [f"{median_ns(scene[peer]):.1f}" if peer in scene else "–" for peer in PEERS]
        row += [ratio_text(ratios(scene, peer)) if peer in scene else "–" for peer in PEERS]
        rows.append(row)
    return table(["scene", "rounds", CDEM, *PEERS, *(f"× {peer}" for peer in PEERS)], rows)


def ratio_text(values: list[float]) -> str:
    """Median and range."""
    return f"{statistics.median(values):.2f} ({min(values):.2f}–{max(values):.2f})"


def phase_table(scenes: dict[str, Samples]) -> str:
    """Where the time goes, from the median run of each engine."""
    rows = []
    for name, scene in scenes.items():
        for engine, samples in scene.items():
            run = middle(samples)
            spent = [f"{run.scaled(run.phases[phase]):.1f}" for phase in PHASES]
            neigh = run.phases["neigh"]
            # Ours also makes lists of its own between LAMMPS's, and nobody counts them.
            each = f"{neigh / run.builds / run.discs * 1e9:.0f}" if run.builds and engine != CDEM else "–"
            share = f"{100 * neigh / run.seconds:.2f} %"
            rows.append([name, engine, *spent, f"{run.builds} in {run.steps}", each, share, str(run.dangerous)])
    rebuilds = ["rebuilds in steps", "ns a disc and rebuild", "share of the time", "dangerous"]
    return table(["scene", "engine", *PHASES, *rebuilds], rows)


def middle(samples: list[Sample]) -> Sample:
    """The run of median time."""
    return sorted(samples, key=lambda sample: sample.ns)[len(samples) // 2]


def shear_text(scenes: dict[str, Samples]) -> str:
    """How long the whole shear test takes."""
    lines = []
    for name, scene in scenes.items():
        if name.startswith("shear test"):
            spent = ", ".join(f"{engine} {middle(samples).seconds:.1f} s" for engine, samples in scene.items())
            lines.append(f"The {name} of {middle(scene[CDEM]).steps} steps takes: {spent}.")
    return "\n".join(lines)


def memory_text(scenes: dict[str, Samples]) -> str:
    """Peak memory a disc, from what the largest scene needs beyond the second largest."""
    small, large = (scenes.get(name) for name in BY_SIZE[-2:])
    if not small or not large:
        return ""
    rows = []
    for engine in large:
        if engine in small:
            more = peak(large[engine]) - peak(small[engine])
            per_disc = more / (large[engine][0].discs - small[engine][0].discs)
            rows.append([engine, f"{peak(large[engine]) / 1e6:.0f}", f"{per_disc:.0f}"])
    return "Peak memory:\n\n" + table(["engine", f"{BY_SIZE[-1]} (MB)", f"a disc beyond {BY_SIZE[-2]} (bytes)"], rows)


def peak(samples: list[Sample]) -> float:
    """Median peak memory, bytes."""
    return statistics.median(sample.peak_bytes for sample in samples)


def rank_text(scenes: dict[str, Samples]) -> str:
    """Efficiency of several ranks against one."""
    one, *more = BY_RANKS
    lines = []
    for name in more:
        if one in scenes and name in scenes:
            ranks = SCENES[name].ranks
            gain = ", ".join(
                f"{engine} {median_ns(scenes[one][engine]) / ranks / median_ns(samples):.2f}"
                for engine, samples in scenes[name].items()
                if engine in scenes[one]
            )
            lines.append(f"Efficiency of {name}: {gain}.")
    return "\n".join(lines)


def plots(scenes: dict[str, Samples], folder: Path) -> None:
    """All plots for which something was measured."""
    plt.rcParams.update({"figure.figsize": (6, 3.6), "figure.dpi": 100, "axes.grid": True, "axes.axisbelow": True})
    plt.rcParams.update({"grid.alpha": 0.3, "figure.constrained_layout.use": True, "svg.fonttype": "none"})
    for old in folder.glob("*.svg"):
        old.unlink()
    curves(scenes, BY_SIZE, lambda name: SCENES[name].discs, "discs", folder / "by_size.svg")
    curves(scenes, BY_RANKS, lambda name: SCENES[name].ranks, "ranks", folder / "by_ranks.svg")
    ours = {name: {CDEM: scenes[name][CDEM]} for name in BY_WIDTH if name in scenes}
    curves(ours, BY_WIDTH, BY_WIDTH.__getitem__, "doubles in a vector", folder / "by_width.svg")
    compared = {name: scene for name, scene in scenes.items() if len(scene) > 1}
    ratio_bars(compared, folder / "ratios.svg")
    phase_bars(compared, folder / "phases.svg")


def save(figure: plt.Figure, file: Path) -> None:
    """Writes a figure."""
    figure.savefig(file, metadata={"Date": None})
    plt.close(figure)


def curves(
    scenes: dict[str, Samples], names: Iterable[str], along: Callable[[str], int], label: str, file: Path
) -> None:
    """Time per disc and step against size or ranks, with the range of the rounds."""
    names = [name for name in names if name in scenes]
    if len(names) < 2:
        return
    figure, axes = plt.subplots()
    for engine, colour in COLOURS.items():
        there = [name for name in names if engine in scenes[name]]
        times = [[sample.ns for sample in scenes[name][engine]] for name in there]
        if times:
            middles = [statistics.median(values) for values in times]
            below = [m - min(values) for m, values in zip(middles, times, strict=True)]
            above = [max(values) - m for m, values in zip(middles, times, strict=True)]
            x = [along(name) for name in there]
            axes.errorbar(x, middles, [below, above], label=engine, color=colour, marker="o", capsize=3)
    if label == "discs":
        axes.set_xscale("log")
    else:
        axes.set_xticks(sorted({along(name) for name in names}))
    axes.set(xlabel=label, ylabel="time per disc and step (ns)", ylim=(0, None))
    axes.legend()
    save(figure, file)


def ratio_bars(scenes: dict[str, Samples], file: Path) -> None:
    """How many times as long the peers take, with the range of the rounds."""
    figure, axes = plt.subplots(figsize=(6, 1.2 + 0.4 * len(scenes)))
    for offset, peer in zip((-0.2, 0.2), PEERS, strict=True):
        there = [(i, ratios(scene, peer)) for i, scene in enumerate(scenes.values()) if peer in scene]
        if there:
            middles = [statistics.median(values) for _, values in there]
            below = [m - min(values) for m, (_, values) in zip(middles, there, strict=True)]
            above = [max(values) - m for m, (_, values) in zip(middles, there, strict=True)]
            places = [i + offset for i, _ in there]
            axes.barh(places, middles, 0.38, xerr=[below, above], label=peer, color=COLOURS[peer], capsize=2)
    axes.axvline(1, color="black", linewidth=0.8)
    axes.set_yticks(range(len(scenes)), scenes)
    axes.invert_yaxis()
    axes.set_xlabel("time of the peer / time of pair style cdem (–)")
    axes.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1))
    save(figure, file)


def phase_bars(scenes: dict[str, Samples], file: Path) -> None:
    """Time per disc and step by phase."""
    bars = [
        (f"{name}, {engine}", middle(samples)) for name, scene in scenes.items() for engine, samples in scene.items()
    ]
    figure, axes = plt.subplots(figsize=(7, 1.2 + 0.22 * len(bars)))
    left = [0.0] * len(bars)
    for phase in PHASES:
        width = [run.scaled(run.phases[phase]) for _, run in bars]
        axes.barh(range(len(bars)), width, left=left, label=phase)
        left = [a + b for a, b in zip(left, width, strict=True)]
    axes.set_yticks(range(len(bars)), [name for name, _ in bars], fontsize=7)
    axes.invert_yaxis()
    axes.set_xlabel("time per disc and step (ns)")
    axes.legend(fontsize=7, ncols=len(PHASES), loc="lower center", bbox_to_anchor=(0.5, 1))
    save(figure, file)
