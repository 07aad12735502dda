# SPDX-License-Identifier: GPL-2.0-or-later
"""Two specimens of a small model at two stresses, run and reported on by the tools; and the same as tests run by hand."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
SHEARBOX = ROOT / "tools" / "shearbox"
MODEL = """
variable width       index 0.03
variable half_height index 0.012
variable dmin        index 2e-3
variable dmax        index 3e-3
variable power       index 0
variable ngrains     index 120
variable shape       index single
"""


def shearbox(*words: object) -> None:
    done = subprocess.run([SHEARBOX, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def summary(folder: Path) -> dict[str, Any]:
    read: dict[str, Any] = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return read


@pytest.fixture(name="folder", scope="module")
def _folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    model = tmp_path_factory.mktemp("model") / "pebbles.in"
    model.write_text(MODEL, encoding="utf-8")
    folder = model.parent / "results"
    shearbox("run", model, "--out", folder, "--seeds", 2, "--stress", 100, 200, "--speed", 200, "--travel", 1.5)
    return folder


def test_means_are_those_of_two_packings(folder: Path) -> None:
    """What the ensemble says is the mean of what the specimens' own reports say."""
    (ensemble,) = summary(folder)["ensembles"]
    own = [summary(folder / one["folder"]) for one in ensemble["specimens"]]
    assert [one["seed"] for one in own] == [1, 2]
    for k, stress in enumerate(ensemble["stresses"]):
        peaks = [one["stresses"][k]["tau_peak_kPa"] for one in own]
        assert peaks[0] != peaks[1], "two packings"
        assert stress["mean_of_peaks_kPa"]["value"] == pytest.approx(np.mean(peaks), rel=1e-5)
    assert ensemble["phi_deg"]["low"] < ensemble["phi_deg"]["value"] < ensemble["phi_deg"]["high"]


def test_the_logs_of_the_decks_tell_what_run_json_tells(folder: Path, tmp_path: Path) -> None:
    """Without it each stress is a test that was run by hand: both of a packing are one specimen, and its report has the same
    numbers and pictures."""
    without = ("run.json", "timings.json", "SHA256SUMS", "*.html", "summary.json", "*.restart", "seed_2")
    shutil.copytree(folder, tmp_path / "by_hand", ignore=shutil.ignore_patterns(*without))
    shearbox("report", tmp_path / "by_hand")
    told, run = summary(tmp_path / "by_hand"), summary(folder / "seed_1")
    for name in (
        "stresses",
        "criteria",
        "phi_deg",
        "c_kPa",
        "packing",
        "law",
        "speed_mm_s",
        "travel_mm",
        "model",
        "seed",
        "complete",
    ):
        assert told[name] == run[name], name
    assert {name: float(told["parameters"][name]) for name in ("kn", "ks", "phi", "density")} == {
        name: float(run["parameters"][name]) for name in ("kn", "ks", "phi", "density")
    }
    assert {name: told["parameters"][name] for name in ("sides", "wall_disc")} == {"sides": "smooth", "wall_disc": "1"}
    pages = [(place / "report.html").read_text(encoding="utf-8") for place in (tmp_path / "by_hand", folder / "seed_1")]
    assert pages[0].count("data:image/webp") == pages[1].count("data:image/webp") > 5
    assert ("no player" in pages[0]) == ("no player" in pages[1])
