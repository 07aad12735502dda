# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run, and what is taken from each run: five cases, each with both laws and several time steps.

`lag` is by how much the normal spring's force lags behind the overlap, in metres: overlap - e_n/k_n. It is 0 by
definition with direct accumulation.
"""

from __future__ import annotations

import math
import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
INPUT = ROOT / "input"
sys.path.insert(0, str(ROOT / "tests" / "decks"))
sys.path.insert(0, str(ROOT / "tools"))
import engine  # noqa: E402
from engine import Disc, Frame, run  # noqa: E402
from scenes import circling, oblique_pairs  # noqa: E402
from shearbox_tools.base.presets import LAWS  # noqa: E402
from shearbox_tools.reading.readers import read_shear  # noqa: E402

engine.TIMEOUT = 3600  # s

KN = 1e8  # N/m
D = 4e-3  # m, diameter
STRESS = 200e3  # Pa, of all lids
LOAD = STRESS * D * 0.01  # N, on one disc
LEAN = math.radians(30)  # of the zigzag's contacts against the vertical
Values = dict[str, Any]  # what a run takes or gives: numbers and lists of numbers, to be kept as JSON
SMOOTH: Values = {"phi": 0, "hn": 0, "hs": 0, "skin": 1e-4}  # no friction, no damping
DAMPED: Values = {"skin": 1e-4}  # the paper's friction and damping
AUTO = 6.7e-7  # s, `dt auto` of 4 mm discs with the paper's damping


@dataclass(frozen=True)
class Job:
    """One run of the engine."""

    case: str
    law: str
    dt: float  # s; of the bed and of shear a share of `dt auto`
    options: dict[str, Any] = field(default_factory=dict)
    cost: float = 1  # s, roughly

    @property
    def key(self) -> str:
        words = [self.case, *(f"{k}={v:g}" if isinstance(v, float) else f"{k}={v}" for k, v in self.options.items())]
        return ", ".join([*words, self.law, f"dt={self.dt:g}"])

    def measure(self, work: Path) -> Values:
        """Runs it in a folder of its own."""
        folder = work / "run" / self.case
        shutil.rmtree(folder, ignore_errors=True)
        return CASES[self.case].measure(self, folder)


def deck(name: str, folder: Path = HERE) -> str:
    return (folder / f"{name}.in").read_text()


# --- impacts --------------------------------------------------------------------------------------------------------
SPEED = 0.1  # m/s
OBLIQUITIES = (0.0, 0.3, 0.6, 0.9)  # sine of the angle between approach and normal
PHASES = 16
OMEGA = math.sqrt(KN / (Disc(0, 0, D).mass / 2))  # of a pair (1/s)


def impacts() -> list[Job]:
    return [Job("impacts", law, dt) for law in LAWS for dt in (1.3e-6, 1e-6, 5e-7, 2e-7, 1e-7, 5e-8)]


def impacts_measure(job: Job, folder: Path) -> Values:
    """Of each obliquity the largest force left when the overlap is 0, over the largest force of the impact."""
    discs, box = oblique_pairs(OBLIQUITIES, PHASES, SPEED, job.dt)
    steps = math.ceil(math.pi / OMEGA / job.dt) + 8
    frames = run(
        deck("impacts", engine.DECKS), folder, discs=discs, box=box, law=job.law, dt=job.dt, steps=steps, **SMOOTH
    ).dump("contacts.dump")  # fmt: skip
    last, greatest = np.zeros(len(discs) // 2), np.zeros(len(discs) // 2)
    for frame in frames:
        force, overlap = frame["c_contacts[2]"], frame["c_contacts[3]"]
        pair = (frame["c_contacts[1]"].astype(int) - 1) // 2
        touching = overlap > 0
        last[pair[touching]] = (force - KN * overlap)[touching]
        greatest[pair] = np.maximum(greatest[pair], KN * overlap)
    left = np.abs(last / greatest).reshape(len(OBLIQUITIES), PHASES)
    return {"obliquity": OBLIQUITIES, "left": left.max(axis=1).tolist()}


# --- orbit ----------------------------------------------------------------------------------------------------------
ORBIT_SPEED = 1.0  # m/s


def orbit() -> list[Job]:
    return [Job("orbit", law, dt, cost=0.5e-6 / dt) for law in LAWS for dt in (1.3e-6, 1e-6, 5e-7, 2.5e-7)]


def orbit_measure(job: Job, folder: Path) -> Values:
    """Overlap during one turn."""
    steps = 20 * round(2 * math.pi * D / ORBIT_SPEED / job.dt / 20)
    thermo = run(
        deck("orbit", engine.DECKS), folder, discs=circling(ORBIT_SPEED, LOAD, KN), law=job.law, dt=job.dt, steps=steps,
        every=steps // 20, pull=LOAD, phi=0, skin=1e-4,
    ).thermo  # fmt: skip
    return {"turns": np.linspace(0, 1, 21).tolist(), "overlap": thermo["v_overlap"].tolist()}


# --- column ---------------------------------------------------------------------------------------------------------
GRAINS = 12
STEPS = 10_000_000


def column() -> list[Job]:
    """The contacts stay closed; they open and close, without loss; they do so under a shaken load, with the paper's
    damping and friction; and they stay closed far from the origin."""

    def job(law: str, dt: float, cost: float = 12, **options: Any) -> Job:
        return Job("column", law, dt, options, cost)

    shapes = ("straight", "zigzag")
    closed = [
        job(law, dt, shape=shape, speed=0.005) for shape in shapes for dt in (1.3e-6, 1e-6, 3e-7, 1e-7) for law in LAWS
    ]
    tossed = [job(law, dt, shape=shape, speed=0.1) for shape in shapes for dt in (4e-7, 2e-7, 1e-7) for law in LAWS]
    shaken = [job(law, AUTO, 60, shape="zigzag", speed=0.0, shake=a) for a in (0.1, 1.0) for law in LAWS]
    far = [job(law, 1e-6, shape="straight", speed=0.005, away=a) for a in (1.0, 100.0, 1e4) for law in LAWS]
    return [*closed, *far, *tossed, *shaken]


def column_discs(shape: str, speed: float, away: float) -> list[Disc]:
    """In balance under LOAD; a zigzag leans on a fixed disc beside each of its discs."""
    random = np.random.default_rng(1)
    lean = LEAN if shape == "zigzag" else 0.0
    aside = D * math.sin(lean)
    rise = math.sqrt((D - LOAD / math.cos(lean) / KN) ** 2 - aside**2)
    beside = D - 2 * LOAD * math.tan(lean) / KN
    discs = []
    for i in range(-1, GRAINS + 1):
        side = 1 if i % 2 else -1
        x, y = side * aside / 2, away + i * rise
        if i in (-1, GRAINS):
            discs.append(Disc(x, y, type=2 if i < 0 else 3))
            continue
        vx, vy = random.uniform(-speed, speed, 2)
        discs.append(Disc(x, y, vx=vx if lean else 0, vy=vy))
        if lean:
            discs.append(Disc(x + side * beside, y, type=2))
    return discs


def column_measure(job: Job, folder: Path) -> Values:
    """100 samples of energy, height of the lid (means of an interval), lag and overlap (sums over the contacts)."""
    shake = job.options.get("shake", 0.0)
    away = job.options.get("away", 0.0)
    discs = column_discs(job.options["shape"], job.options["speed"], away)
    height = discs[-1].y - D / 2
    steps = STEPS // 4 if shake else STEPS
    done = run(
        deck("column"), folder, discs=discs, box=(-0.02, 0.02, away - 0.02, away + 0.07), law=job.law, dt=job.dt,
        steps=steps, every=steps // 100, stress=STRESS, width=D, height=height, shake=shake, here=HERE,
        **(DAMPED if shake else SMOOTH),
    )  # fmt: skip
    rows = np.loadtxt(folder / "column.dat")
    step, moving, spring, raised, lid = rows.T
    values = {"time": (step * job.dt).tolist(), "lid": (lid - height).tolist(), "moving": moving.tolist()}
    values |= {"energy": (moving + spring + raised).tolist()}
    frames = done.dump("contacts.dump")
    values["contacts"] = [int(np.sum(f["c_contacts[2]"] > 0)) for f in frames]
    if not shake:  # with damping, contacts tell the springs' forces only when all is stopped
        values["lag"] = [np.abs(f["c_contacts[2]"] - f["c_contacts[1]"] / KN).sum() for f in frames]
        values["overlap"] = [np.clip(f["c_contacts[2]"], 0, None).sum() for f in frames]
    return values | springs(done.dump("springs.dump")[-1])


def springs(frame: Frame) -> Values:
    """Of the springs, when all is stopped: sums of lag and overlap, contacts, and how many of them pull."""
    force, overlap = frame["c_springs[1]"], frame["c_springs[2]"]
    touching = overlap > 0
    force, overlap = force[touching], overlap[touching]
    return {
        "end_lag": float(np.abs(overlap - force / KN).sum()),
        "end_overlap": float(overlap.sum()),
        "end_contacts": len(force),
        "end_pulling": int(np.sum(force < 0)),
    }


# --- ring -----------------------------------------------------------------------------------------------------------


def ring() -> list[Job]:
    return [Job("ring", law, 1e-6, {"speed": speed}, 8) for speed in (0.0, 1.0) for law in LAWS]


def ring_measure(job: Job, folder: Path) -> Values:
    """Sums of lag and of overlap."""
    random = np.random.default_rng(1)
    pitch = D - LOAD / KN
    velocity = random.uniform(-0.005, 0.005, GRAINS)
    velocity += job.options["speed"] - velocity.mean()
    discs = [Disc((i + 0.3) * pitch, 0, vx=v) for i, v in enumerate(velocity)]
    done = run(
        deck("ring"), folder, discs=discs, box=(0, GRAINS * pitch, -0.02, 0.02), law=job.law, dt=job.dt, steps=STEPS,
        every=STEPS // 100, bx="p", **SMOOTH,
    )  # fmt: skip
    frames = done.dump("contacts.dump")
    return {
        "time": [f.step * job.dt for f in frames],
        "lag": [np.abs(f["c_contacts[2]"] - f["c_contacts[1]"] / KN).sum() for f in frames],
        "overlap": [f["c_contacts[2]"].sum() for f in frames],
    }


# --- bed ------------------------------------------------------------------------------------------------------------
SMALL: Values = {"ngrains": 120, "width": 0.06, "half_height": 0.03}
DECKS: Values = {"decks": INPUT, "here": HERE}
LOOKS = 10


def bed() -> list[Job]:
    """Shaken so that few contacts open, for 10^7 steps; weakly, and so that most open; and with a finer step."""
    whole = [Job("bed", law, 1.0, {"shake": 0.3, "seconds": 6.7}, 150) for law in LAWS]
    short = [Job("bed", law, 1.0, {"shake": shake, "seconds": 2.0}, 50) for shake in (0.03, 3.0) for law in LAWS]
    fine = [Job("bed", law, 0.25, {"shake": shake, "seconds": 0.4}, 45) for shake in (0.3, 3.0) for law in LAWS]
    return [*whole, *short, *fine]


def specimen(work: Path, seed: int, **model: Any) -> Path:
    """Folder of a specimen consolidated with the direct law, made if it is not there yet."""
    folder = work / "specimens" / f"{model.get('ngrains', 350)}_{seed}"
    if not (folder / "consolidated.csv").exists():
        stages: dict[str, Values] = {"pack": {"seed": seed}, "consolidate": {"sigma": STRESS / 1000}}
        for stage, given in stages.items():
            run(deck(stage, INPUT), folder, **given, **model, **DECKS)
    return folder


def share_of_auto(folder: Path, share: float, **model: Any) -> Values:
    """The deck's variable dt for a share of `dt auto`."""
    if share == 1:
        return {}
    log = run(deck("look"), folder / "auto", state=folder / "consolidated.restart", **model, **DECKS).log
    auto = next(float(line.split("=")[1]) for line in log.splitlines() if line.startswith("dt ="))
    return {"dt": share * auto}


def bed_measure(job: Job, folder: Path) -> Values:
    """200 samples of height and energy at the end of a period; LOOKS times lag, overlap and contacts."""
    made = specimen(folder.parents[1], 1, **SMALL)
    given: Values = SMALL | DECKS | {"law": job.law}
    done = run(
        deck("bed"), folder, specimen=made / "consolidated.restart", rows=200, often=200 // LOOKS, **job.options,
        **given, **share_of_auto(made, job.dt, **SMALL),
    )  # fmt: skip
    dt = done.printed("dt")
    step, lid, kinetic, spring = np.loadtxt(folder / "bed.dat").T
    looks = [look(folder / f"state.{200 // LOOKS * (k + 1)}.restart", folder / "look", given) for k in range(LOOKS)]
    return {
        "time": (step * dt).tolist(),
        "steps": int(step[-1]),
        "dt": dt,
        "lid": lid.tolist(),
        "kinetic": kinetic.tolist(),
        "spring": spring.tolist(),
        **{name: [one[name] for one in looks] for name in looks[0]},
    }


def look(state: Path, folder: Path, given: Values) -> Values:
    return springs(run(deck("look"), folder, state=state, **given).dump("springs.dump")[-1])


# --- shear ----------------------------------------------------------------------------------------------------------


def shear() -> list[Job]:
    """200 mm/s, several specimens and two steps; and one test at the paper's 2 mm/s."""
    fast = [
        Job("shear", law, share, {"seed": seed, "speed": 200}, 8 / share)
        for seed in (1, 2, 3)
        for share in (1.0, 0.25)
        for law in LAWS
    ]
    return [*fast, *(Job("shear", law, 1.0, {"seed": 1, "speed": 2}, 200) for law in LAWS)]


def shear_measure(job: Job, folder: Path) -> Values:
    """The curves of input/shear.in, and the springs at its end."""
    made = specimen(folder.parents[1], job.options["seed"])
    folder.mkdir(parents=True)
    shutil.copy(made / "consolidated.restart", folder)
    given: Values = DECKS | {"law": job.law}
    dt = share_of_auto(made, job.dt)
    run(deck("shear", INPUT), folder, sigma=STRESS / 1000, speed=job.options["speed"], frames=1, **given, **dt)
    table = read_shear(folder / "shear.dat")
    names = ("displacement_mm", "tau_kPa", "sigma_kPa", "lid_mm", "tau_upper_kPa", "trm", "kinetic_J")
    values = {name: table[name].tolist() for name in names}
    return values | look(folder / "sheared.restart", folder / "look", given)


@dataclass(frozen=True)
class Case:
    jobs: Callable[[], list[Job]]
    measure: Callable[[Job, Path], Values]


CASES = {
    "impacts": Case(impacts, impacts_measure),
    "orbit": Case(orbit, orbit_measure),
    "column": Case(column, column_measure),
    "ring": Case(ring, ring_measure),
    "bed": Case(bed, bed_measure),
    "shear": Case(shear, shear_measure),
}
