# SPDX-License-Identifier: GPL-2.0-or-later
"""Whole direct shear tests at several settings and seeds, and what each of them says about the sand.

A run is `tools/shearbox run` at all stresses, with a packing of its own: a softer contact also packs otherwise.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from cases import FULL_TEST, Shear
from engines import CDEM, PROGRAMS, ROOT, TO_MEASURE, EngineError

sys.path.insert(0, str(ROOT / "tools"))
from shearbox_tools.base.presets import SPEEDS  # noqa: E402

MODEL = "TypeA_10x5_4-8_1-circle_350"
STRESSES = (100, 200, 300, 400)  # kPa
LOOP = r"^Loop time of (\S+) on \d+ procs for (\d+) steps.*?([\d.]+)% CPU use"
TIMED_SHARE = 0.02  # of the travel at 1 mm/s
REFERENCE_SPEED = 2  # mm/s
HALF_STEP = "4.4e-07"  # s: half of what dt auto takes for this model at stiffness 1


@dataclass(frozen=True)
class Setting:
    """What is varied: shear speed (mm/s), factor on the stiffness of all contacts, time step (s or auto), law."""

    speed: float
    stiffness: float = 1
    dt: str = "auto"
    law: str = "direct"

    @property
    def name(self) -> str:
        """How the setting is called in tables and figures."""
        more = ["half the step"] * (self.dt != "auto") + [self.law] * (self.law != "direct")
        return ", ".join([f"{self.speed:g} mm/s, stiffness {self.stiffness:g}", *more])

    @property
    def options(self) -> list[str]:
        """The options of `shearbox run`."""
        return [f"--speed={self.speed:g}", f"--stiffness={self.stiffness:g}", f"--dt={self.dt}", f"--law={self.law}"]

    @property
    def guess(self) -> float:
        """Seconds that a run takes, roughly: its steps grow with the duration of the test over that of a contact."""
        step = 1 if self.dt == "auto" else 0.5
        return 20 + 280 * REFERENCE_SPEED / self.speed * self.stiffness**0.5 / step


REFERENCE = Setting(REFERENCE_SPEED)  # the paper's
SETTINGS = [
    REFERENCE,
    *(Setting(speed) for speed in (10, 50, 200)),
    *(Setting(10, stiffness) for stiffness in (0.1, 0.01)),
    Setting(10, dt=HALF_STEP),
    Setting(10, law="incremental"),
    Setting(20, 0.1),
    *(Setting(speed, stiffness) for speed in (50, 200) for stiffness in (0.1, 0.01)),
]


def timed_scenes() -> dict[str, Shear]:
    """Shear tests at the settings of the presets, cut short where the whole takes long."""
    return {name: Shear(FULL_TEST[0] * min(1, TIMED_SHARE * speed), speed) for name, speed in SPEEDS.items()}


@dataclass(frozen=True)
class Outcome:
    """What one specimen says at one setting; lists are by stress. Times are of the processor, in the engine's loops."""

    setting: str
    seed: int
    phi_deg: float
    c_kPa: float
    tau_peak_kPa: list[float]
    tau_mean_kPa: list[float]  # over the whole travel
    steepest: list[float]  # dilatancy, mm/mm
    lid_end_mm: list[float]
    trm: list[float]
    steps: int  # of the shear phases
    shear_s: float
    prepare_s: float  # packing and consolidation


def measure(setting: Setting, seed: int, work: Path, keep: Callable[[subprocess.Popen[str]], None]) -> Outcome:
    """Runs a setting with a seed, or goes on with it, and removes its folder in the end; `keep` gets the process."""
    folder = work / f"{setting.speed:g}-{setting.stiffness:g}-{setting.dt}-{setting.law}-{seed}"
    program = [ROOT / "tools" / "shearbox", "run", MODEL, f"--out={folder}", f"--engine={PROGRAMS[CDEM]}", "--jobs=1"]
    words = [*map(str, program), f"--seed={seed}", *setting.options, "--stress", *map(str, STRESSES)]
    process = subprocess.Popen(
        words, env=TO_MEASURE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    keep(process)
    _, message = process.communicate()
    if process.returncode:
        raise EngineError(f"{' '.join(words)} ended with status {process.returncode}:\n{message}")
    outcome = read(folder, setting, seed)
    shutil.rmtree(folder)
    return outcome


def read(folder: Path, setting: Setting, seed: int) -> Outcome:
    """The outcome of a complete run."""
    summary = json.loads((folder / "summary.json").read_text())
    stresses: list[dict[str, Any]] = summary["stresses"]
    shear = [loops(folder / str(sigma) / "shear.log") for sigma in STRESSES]
    prepare = [loops(folder / "packed" / "pack.log")]
    prepare += [loops(folder / str(sigma) / "consolidate.log") for sigma in STRESSES]
    return Outcome(
        setting.name,
        seed,
        phi_deg=summary["phi_deg"],
        c_kPa=summary["c_kPa"],
        tau_peak_kPa=[s["tau_peak_kPa"] for s in stresses],
        tau_mean_kPa=[round(mean_stress(folder / str(sigma) / "curve.csv"), 3) for sigma in STRESSES],
        steepest=[s["steepest_dilatancy_mm_per_mm"] for s in stresses],
        lid_end_mm=[s["lid_end_mm"] for s in stresses],
        trm=[s["trm"] for s in stresses],
        steps=sum(steps for steps, _ in shear),
        shear_s=round(sum(seconds for _, seconds in shear), 3),
        prepare_s=round(sum(seconds for _, seconds in prepare), 3),
    )


def mean_stress(curve: Path) -> float:
    """Mean shear stress (kPa) over the travel."""
    data: np.ndarray = np.genfromtxt(curve, delimiter=",", names=True)
    return float(np.mean(data["tau_kPa"]))


def loops(log: Path) -> tuple[int, float]:
    """Steps, and seconds of the processor, of all runs in the logs of a phase, with those of earlier attempts."""
    steps, seconds = 0, 0.0
    for path in log.parent.glob(log.name + "*"):
        found = re.findall(LOOP, path.read_text(), re.M | re.S)
        steps += sum(int(number) for _, number, _ in found)
        seconds += sum(float(loop) * float(share) / 100 for loop, _, share in found)
    return steps, seconds
