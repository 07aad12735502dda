# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of the study: findings with their verdicts, the paper's figures, its Table 3 for each model, and its outlook."""

import base64
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from shearbox_tools.base.files import write_json, write_text
from shearbox_tools.reports.page import TEMPLATES, environment
from shearbox_tools.reports.page import number as number_of
from shearbox_tools.reports.summary import plain

from .effects import Effect, mean
from .findings import Finding
from .specimens import ANGLES, Group

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
OF_MODELS = ["phi", "phi_plane", "c", "dilation_deg", "sharpness", "late_rate", "trm", "solid", "inertial"]
OF_STRESSES = ["mean", "mean_plane", "mean_inside", "peak", "tensor_deg"]
OF_WALLS = ["sides_rest", "sides_peak", "flanges_peak", "peak", "peak_plane"]
HALVES = ("phi", "phi_plane", "dilation_deg", "trm", "mean", "peak")


def strengths(group: Group) -> dict[str, Effect]:
    """The numbers of a model's row."""
    return {
        name: mean(group.name, group.values(name), name in ANGLES)
        for name in dict.fromkeys([*OF_MODELS, *OF_WALLS, *OF_STRESSES])
    }


def table_3(group: Group) -> list[dict[str, float]]:
    """At the peak of each stress of which that is known, in the mean over specimens: horizontal displacement (mm), normal and shear
    stress (kPa), and the angle (degrees) of their ratio."""
    rows = []
    for sigma in group.stresses:
        ratios, places = (group.at(sigma, name) for name in ("peak", "peak_mm"))
        if not (len(ratios) and len(places)):
            continue
        ratio, place = float(np.mean(ratios)), float(np.mean(places))
        rows.append({"sigma": sigma, "s": place, "tau": ratio * sigma, "angle": float(np.degrees(np.arctan(ratio)))})
    return rows


def write_findings(findings: Mapping[str, Sequence[Finding]], out: Path) -> None:
    """findings.json."""
    write_json(
        out / "findings.json", plain({walls: [asdict(one) for one in found] for walls, found in findings.items()})
    )


def write_page(out: Path, **content: Any) -> Path:
    """page.html."""
    templates = environment(Path(__file__).parent / "templates", TEMPLATES)
    templates.filters.update(uri=_uri, interval=interval, arctan=lambda ratio: float(np.degrees(np.arctan(ratio))))
    page = out / "page.html"
    write_text(page, templates.get_template("paper.html.j2").render(**content))
    return page


def interval(effect: Effect, digits: int = 3) -> str:
    """A value with its interval."""
    if not np.isfinite(effect.value):
        return "–"
    if not np.isfinite(effect.low):
        return f"{number_of(effect.value, digits)}, no interval"
    return f"{number_of(effect.value, digits)} [{number_of(effect.low, digits)}, {number_of(effect.high, digits)}]"


def print_page(page: Path) -> Path | None:
    """The page as PDF, beside it; None without a browser, or if that takes five minutes."""
    browser = next((path for name in BROWSERS if (path := shutil.which(name))), None)
    if browser is None:
        return None
    target = page.with_suffix(".pdf").absolute()
    command = [
        browser,
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--no-pdf-header-footer",
        f"--print-to-pdf={target}",
    ]
    try:
        done = subprocess.run([*command, page.absolute().as_uri()], capture_output=True, timeout=300)
    except subprocess.TimeoutExpired:
        return None
    return target if done.returncode == 0 and target.exists() else None


def _uri(picture: Path) -> str:
    return f"data:image/svg+xml;base64,{base64.b64encode(picture.read_bytes()).decode()}"
