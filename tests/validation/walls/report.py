# SPDX-License-Identifier: GPL-2.0-or-later
"""The tables and the figure of the walls, from what the tests gave."""

from __future__ import annotations

import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from cases import SIGMA, SPEED, STUDIED  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import tables  # noqa: E402

Values = dict[str, dict[str, float]]
COLUMNS = {"sides_at_rest": "sides, rest", "sides_at_peak": "sides, peak", "sides_mean": "sides, mean",
           "flanges_at_peak": "flanges, peak", "flanges_mean": "flanges, mean", "peak_lid": "peak τ/σ lid",
           "peak_plane": "peak τ/σ plane", "mean_lid": "mean τ/σ lid", "mean_plane": "mean τ/σ plane",
           "dilatancy": "dilatancy", "rise_mm": "rise, mm", "trm": "TRM"}  # fmt: skip


def publish(values: Values, out: Path) -> Path:
    """Writes tables.md and walls.svg; returns the former."""
    groups: dict[tuple[str, str], list[dict[str, float]]] = defaultdict(list)
    for key, row in values.items():
        model, walls, _ = key.split("/")
        groups[model, walls].append(row)
    models = sorted({model for model, _ in groups})
    text = (
        f"Shear at {SIGMA} kPa and {SPEED} mm/s. Mean over the packings, with half of the range; n is their number. Loads on "
        "sides and flanges of the upper half are over that of the lid: at the first row, at the peak of τ, in the mean over "
        "the test. Plane: stresses through the plane between the halves. Peaks are those of means over 0.4 mm.\n\n"
    )
    text += table(
        "walls", [(m, w, groups[m, w]) for m in models for w in ("discs_1_1", "smooth_1_1") if (m, w) in groups]
    )
    text += f"\nOver all of these specimens:\n\n{ranges(values)}"
    text += (
        f"\nDiscs less smooth, pairs of the same model and seed, without equal discs of 2 mm:\n\n{differences(values)}"
    )
    text += "\nOther discs and distances: kind of sides, size of wall discs over the smallest grain, pitch of side discs.\n\n"
    studied = [(m, w, rows) for (m, w), rows in sorted(groups.items()) if m in STUDIED]
    text += table("walls", studied)
    (out / "tables.md").write_text(text)
    draw(groups, out / "walls.svg")
    return out / "tables.md"


def table(title: str, rows: list[tuple[str, str, list[dict[str, float]]]]) -> str:
    lines = []
    for model, walls, found in rows:
        cells = []
        for name in COLUMNS:
            of_seeds = np.array([row[name] for row in found])
            spread = f" ± {np.ptp(of_seeds) / 2:.2f}" if len(found) > 1 else ""
            cells.append(f"{np.mean(of_seeds):.2f}{spread}")
        lines.append([model, walls.replace("_", " "), f"{len(found)}", *cells])
    return tables.table(["model", title, "n", *COLUMNS.values()], lines) + "\n"


def ranges(values: Values) -> str:
    """Least, greatest and mean of the loads, over those specimens."""
    lines = []
    for name in ("sides_at_rest", "sides_at_peak", "sides_mean", "flanges_mean"):
        found = [[row[name] for key, row in values.items() if f"/{sides}_1_1/" in key] for sides in ("discs", "smooth")]
        cells = [f"{min(v):.3f} to {max(v):.3f}, mean {np.mean(v):.3f} of {len(v)}" for v in found]
        lines.append([COLUMNS[name], *cells])
    return tables.table(["", "discs", "smooth"], lines) + "\n"


def differences(values: Values) -> str:
    """Mean over pairs, with its standard error, and the mean over the models with smooth sides."""
    lines = []
    for name in ("peak_lid", "peak_plane", "dilatancy", "trm"):
        cells = []
        for shape in ("_1-circle", "_3-circle"):
            smooth: dict[str, list[float]] = defaultdict(list)
            pairs = []
            for key, row in values.items():
                other = values.get(key.replace("/discs_1_1/", "/smooth_1_1/"))
                if "/discs_1_1/" in key and shape in key and "T-2" not in key and other:
                    pairs.append(row[name] - other[name])
                    smooth[key.split("/")[0]].append(other[name])
            error = np.std(pairs, ddof=1) / len(pairs) ** 0.5
            usual = np.mean([np.mean(of_model) for of_model in smooth.values()])
            cells.append(f"{np.mean(pairs):.3f} ± {error:.3f} ({len(pairs)}), of {usual:.2f}")
        lines.append([COLUMNS[name], *cells])
    return tables.table(["", "single discs", "grains of three"], lines) + "\n"


def draw(groups: dict[tuple[str, str], list[dict[str, float]]], file: Path) -> None:
    """τ/σ by lid and by plane against the pitch of the side discs; 0 is the smooth wall."""
    figure, panels = plt.subplots(1, len(STUDIED), figsize=(3.2 * len(STUDIED), 3.2), sharey=True, layout="constrained")
    for panel, model in zip(panels, STUDIED, strict=True):
        for name, colour, mark in (("peak_lid", "black", "o"), ("peak_plane", "tab:blue", "s")):
            points = [(0.0, "smooth_1_1")] + [(p, f"discs_1_{p:g}") for p in (0.125, 0.25, 0.5, 1)]
            xy = [(pitch, row[name]) for pitch, walls in points for row in groups.get((model, walls), [])]
            panel.plot(
                *zip(*xy, strict=True) if xy else ([], []), mark, color=colour, mfc="none", label=name.split("_")[1]
            )
        panel.set(title=model, xlabel="pitch of side discs / diameter")
        panel.title.set_fontsize(8)
    panels[0].set_ylabel("greatest τ/σ")
    panels[0].legend(title="σ of")
    figure.savefig(file)
    plt.close(figure)
