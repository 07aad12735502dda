# SPDX-License-Identifier: GPL-2.0-or-later
"""What the scripts of the cases here share: they run a deck, read its tables, and draw grains to scale."""

from __future__ import annotations

import argparse
import io
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from PIL import Image

matplotlib.use("Agg")
ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))
from shearbox_tools.reading.dumps import DISCS, Dump  # noqa: E402

Columns = dict[str, np.ndarray]
GRAIN, WALL = "#9db7d5", "#8c8c8c"


def folder_of(script: str, description: str | None) -> Path:
    """The folder of results that the command line names; default: results/gallery/CASE."""
    case = Path(script).stem
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "gallery" / case, help="folder of the results")
    folder: Path = parser.parse_args().out
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def run(deck: Path, folder: Path, **variables: float | str) -> str:
    """Run a deck in a folder; what it printed. Variables are those at its top."""
    command = [str(ROOT / "build" / "lmp_cdem"), "-in", str(deck), "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    folder.mkdir(parents=True, exist_ok=True)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{deck.name}: {next((s for s in done.stdout.splitlines() if 'ERROR' in s), done.stderr)}")
    return done.stdout


def table(path: Path) -> Columns:
    """Columns of a table whose first line, after #, has their names."""
    names = path.open().readline().lstrip("# ").split()
    return dict(zip(names, np.loadtxt(path, ndmin=2).T, strict=True))


def discs(path: Path, frame: int = -1) -> Columns:
    """Discs of a frame of a dump of compute cdem/discs, in m: x, y, radius, type."""
    dump = Dump(path, (*DISCS, "type"))
    return dump.frame(dump.steps[frame])


def draw(axes: Axes, of: Columns, straight: Sequence[int] = ()) -> None:
    """Grains (type 1) and walls to scale, in cm. Pieces of straight walls, which lie along x or y, are squares."""
    is_straight = np.isin(of["type"], straight)
    for these, fill in ((of["type"] == 1, GRAIN), ((of["type"] != 1) & ~is_straight, WALL)):
        x, y, size = (100 * of[name][these] for name in ("x", "y", "radius"))
        axes.add_collection(
            EllipseCollection(
                2 * size,
                2 * size,
                np.zeros_like(size),
                units="xy",
                offsets=np.column_stack([x, y]),
                transOffset=axes.transData,
                facecolors=fill,
                edgecolors="#40404080",
                linewidths=0.3,
            )
        )
    pieces = 100 * np.column_stack([of["x"], of["y"], of["radius"]])[is_straight]
    axes.add_collection(PatchCollection([Rectangle((x - r, y - r), 2 * r, 2 * r) for x, y, r in pieces], color=WALL))
    axes.set(aspect="equal", xlabel="x (cm)", ylabel="y (cm)")


def save(figure: Figure, path: Path) -> None:
    """Write a PNG with 64 colours, a third of the size: these pictures are kept."""
    whole = io.BytesIO()
    figure.savefig(whole, dpi=130)
    Image.open(whole).convert("RGB").quantize(64).save(path, optimize=True)
