# SPDX-License-Identifier: GPL-2.0-or-later
"""The tests that are run: model, seed, walls; and what is taken from each."""

from __future__ import annotations

import os
import shutil
import subprocess
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = Path(os.environ.get("SHEARBOX_LMP", ROOT / "build" / "lmp_cdem"))
INPUT = ROOT / "input"
SIGMA, SPEED = 200, 20  # kPa, mm/s
STUDIED = ("TypeA_10x5_4-8_1-circle_350", "TypeA_10x5_2-4_1-circle_1500", "TypeA_10x5_2-4_3-circle_350",
           "TypeB_15x5_2-4_3-circle_550")  # fmt: skip
WINDOW = 0.4  # mm of displacement over which curves are averaged before their greatest value is taken


@dataclass(frozen=True)
class Case:
    """A shear test; wall_disc and side_pitch as in input/parameters.in."""

    model: str
    seed: int
    sides: str
    wall_disc: float = 1
    side_pitch: float = 1

    @property
    def key(self) -> str:
        walls = f"{self.sides}_{self.wall_disc:g}_{self.side_pitch:g}"
        return f"{self.model}/{walls}/{self.seed}"

    @property
    def cost(self) -> float:
        """Grows with the number of discs; in no unit."""
        count, discs = int(self.model.split("_")[-1]), 3 if "_3-circle_" in self.model else 1
        return count * discs + 300

    def measure(self, work: Path) -> dict[str, float]:
        """Runs the test in a folder that is deleted afterwards."""
        folder = work / self.key.replace("/", "-")
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for deck in ("pack", "consolidate", "shear"):
            self._run(deck, folder)
        values = read(folder / "shear.dat")
        shutil.rmtree(folder)
        return values

    def _run(self, deck: str, folder: Path) -> None:
        variables = {**asdict(self), "sigma": SIGMA, "speed": SPEED, "frames": 1, "audit": "no"}
        command = [str(PROGRAM), "-in", str(INPUT / f"{deck}.in"), "-log", f"{deck}.log", "-screen", "none", "-nocite"]
        for name, value in variables.items():
            command += ["-var", name, str(value)]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, start_new_session=True)
        if done.returncode:
            raise RuntimeError(f"{self.key}: {deck} failed, see {folder}\n{(done.stdout + done.stderr)[-500:]}")


def read(table: Path) -> dict[str, float]:
    """Stresses in kPa, over the lid's; the peak is that of the mean over WINDOW."""
    with table.open() as stream:
        names = stream.readline().lstrip("#").split()
    rows = dict(zip(names, np.loadtxt(table).T, strict=True))
    s, tau, lid = (rows[n] for n in ("displacement_mm", "tau_kPa", "sigma_kPa"))
    width = max(1, round(WINDOW / np.mean(np.diff(s))))

    def smooth(name: str) -> np.ndarray:
        return np.convolve(rows[name], np.ones(width) / width, "valid")

    peak = int(np.argmax(smooth("tau_kPa")))
    sides, flanges = rows["sides_upper_kPa"] / np.mean(lid), rows["flanges_upper_kPa"] / np.mean(lid)
    rate = np.diff(smooth("lid_mm")[::width]) / np.diff(smooth("displacement_mm")[::width])
    return {
        "sides_at_rest": float(sides[0]),
        "sides_at_peak": float(smooth("sides_upper_kPa")[peak] / np.mean(lid)),
        "sides_mean": float(np.mean(sides)),
        "flanges_at_peak": float(smooth("flanges_upper_kPa")[peak] / np.mean(lid)),
        "flanges_mean": float(np.mean(flanges)),
        "peak_lid": float(np.max(smooth("tau_kPa")) / np.mean(lid)),
        "peak_plane": float(np.max(smooth("plane_tau_kPa") / smooth("plane_kPa"))),
        "mean_lid": float(np.mean(tau) / np.mean(lid)),
        "mean_plane": float(np.mean(rows["plane_tau_kPa"]) / np.mean(rows["plane_kPa"])),
        "at_mm": float(smooth("displacement_mm")[peak]),
        "dilatancy": float(np.max(rate)),
        "rise_mm": float(rows["lid_mm"][-1]),
        "trm": float(rows["trm"][-1]),
    }


def all_models() -> list[str]:
    return sorted(path.stem for path in (INPUT / "models").glob("*.in"))


def cases(seeds: int) -> list[Case]:
    """All models with both kinds of sides; four models with other discs and pitches. The cheap ones first."""
    found = [
        Case(m, seed, sides) for seed in range(1, seeds + 1) for m in all_models() for sides in ("smooth", "discs")
    ]
    found += [
        Case(m, seed, "discs", 1, pitch)
        for seed in range(1, seeds + 1)
        for m in STUDIED
        for pitch in (0.5, 0.25, 0.125)
    ]
    found += [Case(m, seed, sides, disc) for seed in range(1, seeds + 1) for m in STUDIED for disc in (0.5, 2)
              for sides in ("smooth", "discs")]  # fmt: skip
    return sorted(found, key=lambda case: (case.cost * case.seed**2, case.key))
