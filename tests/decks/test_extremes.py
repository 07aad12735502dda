# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts at the ends of what the parameters allow: overdamped, very fast, very stiff beside very soft, without friction
and with all of it, very unequal, ten times ten at one grain, on the point of a wedge, opened and closed all the time."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import Disc, Run, run, same_bits
from scenes import cloud

START = "include ${decks}/start.in\n"
END = "include ${decks}/end.in\n"
KN = 1e8


# --- damping ------------------------------------------------------------------------------------------------------------


def overdamped(h: float, w: float, t: np.ndarray) -> np.ndarray:
    """x(t)/v of x'' + 2 h w x' + w^2 x = 0 from x = 0 with the velocity v, for h >= 1: it never comes back to 0."""
    if h == 1:
        return t * np.exp(-w * t)
    root = w * math.sqrt(h * h - 1)
    return np.exp(-h * w * t) * np.sinh(root * t) / root


@pytest.mark.parametrize("h", [1.0, 1.5, 4.0])
def test_overdamped_impact(tmp_path: Path, law: str, h: float) -> None:
    """Two discs meet and stay: the overlap is that of a critically damped or overdamped oscillator, and what is left of it
    creeps out. The error falls with the square of the step."""
    v, error = 0.1, {}
    w = math.sqrt(KN / (Disc(0, 0).mass / 2))
    for n in (50, 100):
        dt = 1 / (n * h * w)
        discs = [Disc(-2e-3, 0, vx=v / 2), Disc(2e-3 + 0.3 * v * dt, 0, vx=-v / 2)]
        deck = START + f"fix move grains cdem/integrate dt any\ntimestep {dt:.17g}\n"
        deck += "dump d all custom 1 d.dump id x\ndump_modify d format float %.17g sort id\n" + f"run {5 * n}\n"
        x = run(deck, tmp_path / str(n), discs=discs, law=law, kn=KN, hn=h).series("d.dump", "x")
        overlap = 4e-3 - (x[:, 1] - x[:, 0])
        expected = v * overdamped(h, w, dt * (np.arange(1, 5 * n + 1) - 0.3))
        error[n] = np.abs(overlap[1:] - expected).max() / expected.max()
    assert error[50] < 4e-3
    assert error[50] / error[100] > 3


@pytest.mark.parametrize("h", [0.99, 1.0, 1.5])
def test_overdamped_rebound_if_the_dashpot_may_not_pull(tmp_path: Path, law: str, h: float) -> None:
    """With limit_damping the discs part where the force is 0, x'' = 0, with the velocity of that moment:
    e = exp(-h/s acos(2 h^2 - 1)) with s = sqrt(1 - h^2) below 1, exp(-2) at 1, and exp(-h/s ln((h + s)/(h - s))) with
    s = sqrt(h^2 - 1) above (Schwager & Poeschel 2007, eqs. 20, 21 and their limit)."""
    if h < 1:
        s = math.sqrt(1 - h * h)
        expected = math.exp(-h / s * math.acos(2 * h * h - 1))
    elif h == 1:
        expected = math.exp(-2)
    else:
        s = math.sqrt(h * h - 1)
        expected = math.exp(-h / s * math.log((h + s) / (h - s)))
    v = 0.1
    w = math.sqrt(KN / (Disc(0, 0).mass / 2))
    dt = 1 / (200 * h * w)
    discs = [Disc(-2e-3 - 1e-8, 0, vx=v / 2), Disc(2e-3, 0, vx=-v / 2)]
    deck = START + f"fix move grains cdem/integrate dt any\ntimestep {dt:.17g}\nrun {round(20 / (w * dt))}\n" + END
    end = run(deck, tmp_path, discs=discs, law=law, kn=KN, hn=h, cut="yes").end
    assert (end["vx"][1] - end["vx"][0]) / v == pytest.approx(expected, rel=2e-3)


# --- speed --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("speed", [20.0, 100.0])
@pytest.mark.parametrize("h", [0.0, 0.215])
def test_violent_impact(tmp_path: Path, law: str, speed: float, h: float) -> None:
    """Two discs at tens of m/s: overlaps of 1e-2 of a diameter. The law is linear, so e is that of a soft touch."""
    e = math.exp(-math.pi * h / math.sqrt(1 - h * h))
    w = math.sqrt(KN / (Disc(0, 0).mass / 2))
    dt = math.pi / w / 160
    discs = [Disc(-3e-3, 0, vx=speed / 2), Disc(3e-3, 0, vx=-speed / 2)]
    steps = math.ceil((2e-3 / speed + 1.2 * math.pi / w) / dt)
    deck = START + f"fix move grains cdem/integrate\ntimestep {dt:.17g}\nrun {steps}\n" + END
    end = run(deck, tmp_path, discs=discs, law=law, kn=KN, hn=h).end
    assert (end["vx"][1] - end["vx"][0]) / speed == pytest.approx(e, rel=5e-4)
    assert end["vx"][0] == -end["vx"][1]


SWARM = (
    START
    + """
fix move grains cdem/integrate
timestep ${dt}
compute e all cdem/energy
thermo_style custom step c_e
thermo_modify format float %.17g
thermo 20
dump d all custom ${steps} d.dump id mass radius x y vx vy omegaz
dump_modify d format float %.17g sort id
run ${steps}
"""
    + END
)


def invariants(frame: dict[str, np.ndarray]) -> np.ndarray:
    """Momentum and angular momentum, and beside them the sum of the sizes of their terms."""
    m, r, x, y, vx, vy = (frame[name] for name in ("mass", "radius", "x", "y", "vx", "vy"))
    spin = m * r**2 / 2 * frame["omegaz"]
    sums = [m * vx, m * vy, m * (x * vy - y * vx) + spin]
    sizes = [np.abs(m * vx), np.abs(m * vy), np.abs(m * x * vy) + np.abs(m * y * vx) + np.abs(spin)]
    return np.array([[a.sum(), b.sum()] for a, b in zip(sums, sizes, strict=True)])


def check_swarm(out: Run, falls_by: float) -> None:
    before, after = (invariants(frame.columns) for frame in out.dump("d.dump"))
    assert (np.abs(after - before)[:, 0] / before[:, 1]).max() < 2e-13
    energy = out.thermo["c_e"]
    assert np.diff(energy).max() < 2e-3 * energy[0]  # what a collision can gain by the phase of the step at first touch
    assert energy[-1] < falls_by * energy[0]


def test_swarm_at_tens_of_metres_a_second(tmp_path: Path, law: str) -> None:
    """49 discs fly at each other with up to 60 m/s: momentum and angular momentum to round-off, energy falls."""
    discs = cloud(7, speed=60)
    out = run(SWARM, tmp_path, discs=discs, box=(-0.05, 0.05, -0.05, 0.05), law=law, dt=5e-8, steps=2000, skin=1e-4)
    check_swarm(out, 0.5)


def unequal(seed: int) -> list[Disc]:
    """Three discs of 1 cm in a cloud of 160 that are a tenth as large, 1 % of the mass."""
    random = np.random.default_rng(seed)
    large = [Disc(0.008 * math.cos(a), 0.008 * math.sin(a), 0.01) for a in (0.3, 2.4, 4.5)]
    discs = [Disc(d.x, d.y, d.diameter, -1000 * d.x, -1000 * d.y, 50) for d in large]
    while len(discs) < 163:
        x, y = random.uniform(-0.016, 0.016, 2)
        if all(math.hypot(x - d.x, y - d.y) > d.radius + 0.55e-3 for d in discs):
            discs.append(Disc(x, y, 1e-3, -2000 * x, -2000 * y, random.uniform(-500, 500)))
    return discs


def test_sizes_of_one_to_ten(tmp_path: Path, law: str) -> None:
    """The neighbour list finds small ones at large ones wherever they are; the same bits on any number of ranks."""
    options: dict[str, Any] = {
        "discs": unequal(2),
        "box": (-0.02, 0.02, -0.02, 0.02),
        "law": law,
        "steps": 3000,
        "skin": 2e-4,
    }
    alone = run(SWARM, tmp_path / "alone", dt=5e-8, **options)
    check_swarm(alone, 0.8)
    assert np.count_nonzero(alone.end["tqz"]) > 10
    ranks = {"direct": 4, "incremental": 2}[law]
    assert same_bits(alone.end, run(SWARM, tmp_path / "ranks", dt=5e-8, ranks=ranks, **options).end)


@pytest.mark.parametrize(("law", "ranks"), [("direct", 1), ("incremental", 1), ("direct", 4)])
def test_forty_contacts_of_one_grain(tmp_path: Path, law: str, ranks: int) -> None:
    """A large disc at rest, ringed by 40 small ones that all hit it at once: each is thrown back as from a wall of the
    reduced mass, and the large one stays where it is, since the forces on it cancel."""
    n, large, small, v = 40, 0.02, 1e-3, 1.0
    gap = 1.3e-8
    ring = [(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n)) for k in range(n)]
    place = (large + small) / 2 + gap
    discs = [Disc(0, 0, large)] + [Disc(place * x, place * y, small, -v * x, -v * y) for x, y in ring]
    mass = discs[1].mass
    w = math.sqrt(KN / mass)
    dt = math.pi / w / 160
    deck = START + f"fix move grains cdem/integrate\ntimestep {dt:.17g}\nrun 200\n" + END
    end = run(deck, tmp_path, discs=discs, law=law, ranks=ranks, kn=KN, hn=0.215).end
    # The dashpot takes the reduced mass, but the large disc does not move: damping ratio h sqrt(m_reduced/m).
    h = 0.215 / math.sqrt(1 + mass / discs[0].mass)
    e = math.exp(-math.pi * h / math.sqrt(1 - h * h))
    radial = [end["vx"][k + 1] * x + end["vy"][k + 1] * y for k, (x, y) in enumerate(ring)]
    assert radial == pytest.approx(np.full(n, e * v), rel=5e-4)
    assert math.hypot(end["vx"][0], end["vy"][0]) < 1e-9 * v
    assert math.hypot(end["x"][0], end["y"][0]) < 1e-15


# --- stiffness and friction -----------------------------------------------------------------------------------------------


def test_stiff_beside_soft(tmp_path: Path, law: str) -> None:
    """A column of three materials, kn = 1e9, 1e8 and 1e5 N/m, under a weight: each contact has the overlap of its own
    spring. The soft one sinks by 1e4 as much as the stiff one."""
    kn = {(1, 2): 1e9, (1, 3): 1e8, (3, 4): 1e5}
    g = 1000.0
    d = 4e-3
    discs = [Disc(0, k * d - 8e-3, d, type=t) for k, t in enumerate((2, 1, 3, 4))]
    weight = discs[1].mass * g
    deck = START + "group grains type 1 3 4\n"
    deck += "".join(f"pair_coeff {i} {j} {k} 0 0.4 0 0\n" for (i, j), k in kn.items())
    deck += f"fix move grains cdem/integrate dt auto gravity 0 -{g}\nrun 60000\n" + END
    end = run(deck, tmp_path, discs=discs, law=law, kn=1e6, ks=0).end
    overlaps = d - np.diff(end["y"])
    assert overlaps == pytest.approx([3 * weight / 1e9, 2 * weight / 1e8, weight / 1e5], rel=1e-6)


@pytest.mark.parametrize("phi", [89.9, 89.99999])
def test_sticks_however_oblique(tmp_path: Path, law: str, phi: float) -> None:
    """tan(phi) = 573 and 6e6: a disc that hits another at 80 degrees does not slide. The tangential spring, of frequency
    sqrt(3 ks/kn) that of the normal one, turns the slip v to v cos(sqrt(3 ks/kn) pi) while the contact lasts; equal discs
    take the change as 1/3 in translation and 2/3 in spin (1/m to 2 r^2/I). What is left in the spring when the contact
    opens is lost, at a border of steps: of first order, up to 0.26/n with n steps a contact, where a contact that slides
    at its end, as at ordinary angles, is of second order."""
    u, ratio = 1e-5, 0.25
    v = u * math.tan(math.radians(80))
    w = math.sqrt(KN / (Disc(0, 0).mass / 2))
    dt = math.pi / w / 400
    discs = [Disc(-2e-3, 0, vx=u / 2, vy=v / 2), Disc(2e-3, 0, vx=-u / 2, vy=-v / 2)]
    deck = START + f"fix move grains cdem/integrate\ntimestep {dt:.17g}\nrun 420\n" + END
    end = run(deck, tmp_path, discs=discs, law=law, kn=KN, ks=ratio * KN, hn=0, hs=0, phi=phi).end
    change = v * (math.cos(math.sqrt(3 * ratio) * math.pi) - 1)  # of the slip of disc 1 against disc 2
    assert end["vx"][1] - end["vx"][0] == pytest.approx(u, rel=1e-4)
    assert end["vy"][0] - end["vy"][1] - v == pytest.approx(change / 3, rel=0.3 / 400)
    assert -(end["omegaz"][0] + end["omegaz"][1]) * 2e-3 == pytest.approx(-2 / 3 * change, rel=0.3 / 400)


@pytest.mark.parametrize("slope", [80.0, 88.0])
def test_grain_in_a_wedge(tmp_path: Path, law: str, slope: float) -> None:
    """Between two wall discs that leave it hardly any room to fall through: contacts at `slope` from the vertical, each
    with kn u cos(slope) of a sink u: it comes to rest 33 or 820 times as deep as on a floor. Smooth."""
    g, kn = 10.0, KN
    grain = Disc(0, 0)
    d, angle = grain.diameter, math.radians(slope)
    walls = [Disc(side * d * math.sin(angle), -d * math.cos(angle), type=2) for side in (-1, 1)]
    deck = (
        START + f"fix move grains cdem/integrate dt auto gravity 0 -{g}\nfix_modify move drag 2e-5\nrun 20000\n" + END
    )
    end = run(deck, tmp_path, discs=[grain, *walls], law=law, kn=kn, ks=0, hn=0.5, phi=0).end
    # Of the whole geometry: 2 kn (d - s) (y + d cos)/s = m g with the distance s.
    y = 0.0
    for _ in range(50):
        height = y + d * math.cos(angle)
        s = math.hypot(d * math.sin(angle), height)
        force = 2 * kn * (d - s) * height / s - grain.mass * g
        y += force / (2 * kn * math.cos(angle) ** 2)
    assert abs(force) < 1e-6 * grain.mass * g
    assert end["y"][0] == pytest.approx(y, rel=1e-6)
    assert abs(end["x"][0]) < 1e-12


# --- contacts that come and go --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("fraction", [0.5, 0.9])
def test_chatter(tmp_path: Path, fraction: float) -> None:
    """A grain shakes in a gap of 1e-3 of what it moves in a step: contacts open and close in every few steps, 4 to 8 a
    contact, 1e5 times. Undamped and smooth, velocity Verlet keeps the energy, without drift; damped, it falls."""
    v, steps = 0.01, 400000
    deck = (
        START
        + """
    fix move grains cdem/integrate dt any
    compute e all cdem/energy
    thermo_style custom step c_e
    run 0
    variable dt equal ${fraction}*f_move
    timestep ${dt}
    thermo_modify format float %.17g
    thermo 997
    run ${steps}
    """
    )
    gap = 1e-12
    discs = [Disc(-4e-3 - gap, 0, type=2), Disc(0, 0, vx=v), Disc(4e-3 + gap, 0, type=2)]
    options: dict[str, Any] = {"discs": discs, "fraction": fraction, "steps": steps, "ks": 0, "phi": 0}
    energy = run(deck, tmp_path / "free", hn=0, **options).thermo["c_e"]
    first, last = energy[: len(energy) // 4], energy[-len(energy) // 4 :]
    assert last.mean() == pytest.approx(first.mean(), rel=1e-3)
    assert np.ptp(energy) < 0.5 * energy[0]
    energy = run(deck, tmp_path / "damped", hn=0.02, **options).thermo["c_e"]
    assert np.diff(energy).max() <= 1e-9 * energy[0]
    assert energy[-1] < 1e-12 * energy[0]


@pytest.mark.parametrize(("fraction", "error"), [(0.9, 0.4), (0.225, 0.04)])
def test_gas_without_loss_keeps_its_energy(tmp_path: Path, fraction: float, error: float) -> None:
    """Smooth grains bounce about in a periodic box for 0.03 s, some hundred collisions each. A collision gains or loses by
    the phase of the step at first touch, 2e-3 or less with 6 steps a contact (0.9 of the limit, as `dt auto` takes it);
    these add up like steps of a random walk: measured 0.21 of the energy at 0.9 of the limit, 0.012 at a quarter of
    that step. Rough, the grains lose energy in every collision that slides, and never gain."""
    random = np.random.default_rng(4)
    discs = []
    for k in range(64):
        vx, vy = random.uniform(-5, 5, 2)
        discs.append(Disc(0.005 * (k % 8 + 0.5), 0.005 * (k // 8 + 0.5), random.uniform(2e-3, 4.5e-3), vx, vy))
    deck = (
        START
        + f"""
    fix move grains cdem/integrate dt any
    run 0
    variable dt equal {fraction}*f_move
    timestep ${{dt}}
    compute e all cdem/energy
    thermo_style custom step c_e
    thermo_modify format float %.17g
    thermo {round(900 / fraction)}
    run {round(90000 / fraction)}
    """
    )
    options: dict[str, Any] = {
        "discs": discs,
        "box": (0, 0.04, 0, 0.04),
        "bx": "p",
        "by": "p",
        "hn": 0,
        "hs": 0,
        "skin": 3e-4,
    }
    energy = run(deck, tmp_path / "smooth", phi=0, **options).thermo["c_e"]
    assert np.abs(energy / energy[0] - 1).max() < error
    rough = run(deck, tmp_path / "rough", phi=27, **options).thermo["c_e"]
    assert np.diff(rough).max() < 1e-3 * energy[0]
    assert rough[-1] < 0.1 * rough[0]
