# SPDX-License-Identifier: GPL-2.0-or-later
"""Cohesion: discs that touch pull each other with F_c, f_n = k_n overlap - F_c.

Two discs, or a disc and a wall, that touch with the relative speed v are an oscillator about the overlap F_c/k_n:
m x'' + 2 h sqrt(m k_n) x' + k_n x = F_c from x = 0, x' = v, m being their reduced mass. They part when x is 0 again, or
stay together. The same bits, restarts, the audit in motion and momenta: test_same_bits.py and the files named there.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import Disc, Run, run

KN, PULL = 1e6, 2.0  # N/m, N
REST = PULL / KN  # m, overlap of a contact without load
MASS = Disc(0, 0).mass / 2  # of a pair
W0 = math.sqrt(KN / MASS)
PITCH = 0.01


def overlap(t: np.ndarray, v: float, h: float, x0: float = 0.0) -> np.ndarray:
    """Of a contact at rest or in motion, as long as it lasts (m)."""
    damped = W0 * math.sqrt(1 - h * h)
    a = x0 - REST
    b = (v + h * W0 * a) / damped
    return REST + np.exp(-h * W0 * t) * (a * np.cos(damped * t) + b * np.sin(damped * t))


def exit_speed(v: float, h: float) -> float:
    """Of discs that meet with v: 0 if they stay together."""
    t = np.linspace(0, 2 * math.pi / W0 / math.sqrt(1 - h * h), 200001)[1:]
    x = overlap(t, v, h)
    if (x > 0).all():
        return 0.0
    k = int(np.argmin(x > 0))
    return float((x[k - 1] - x[k]) / (t[k] - t[k - 1]))


PAIRS = """
include ${decks}/start.in
fix move grains cdem/integrate dt any
timestep ${dt}
compute c all cdem/contacts id1 overlap fn
compute energy all cdem/energy audit yes
compute pair all pair/local eng
variable inputs string ""
if "$(version) > 20240000" then "variable inputs string 'inputs local'"  # before, compute reduce knew by itself
compute sum all reduce sum c_pair ${inputs}
thermo_style custom step pe c_sum c_energy[*]
thermo_modify format float %.17g
thermo 10
dump c all local 10 contacts.dump c_c[*]
dump_modify c format float %.17g
run ${steps}
include ${decks}/end.in
"""


def pairs(directory: Path, speeds: list[float], steps_per_period: int, periods: float, **options: Any) -> Run:
    """Discs that fly at others, which are at rest, and touch them in the first step, at any fraction of it. A negative
    speed is that of a contact at rest whose discs are to part."""
    dt = 2 * math.pi / W0 / steps_per_period
    discs: list[Disc] = []
    for k, v in enumerate(speeds):
        gap = v * dt * (k + 0.5) / len(speeds) if v > 0 else -REST
        y, d = PITCH * (k + 0.5), Disc(0, 0).diameter
        discs += [Disc(-d - gap, y, vx=v), Disc(0, y)]
    more: dict[str, Any] = {"added": f"cohesion {PULL}", "hs": 0} | options
    return run(
        PAIRS, directory, discs=discs, box=(-0.02, 0.02, 0, PITCH * len(speeds)), dt=dt, kn=KN, ks=KN,
        steps=math.ceil(periods * steps_per_period), **more,
    )  # fmt: skip


def relative_speeds(out: Run) -> np.ndarray:
    vx = out.end["vx"].reshape(-1, 2)
    return vx[:, 1] - vx[:, 0]


ESCAPE = PULL / math.sqrt(KN * MASS)  # m/s


def test_exit_speed_from_a_contact_at_rest(tmp_path: Path, anywhere: dict[str, Any]) -> None:
    """Undamped, sqrt(v^2 - F_c^2/(k_n m)); below the escape speed the discs stay together."""
    speeds = [-ESCAPE * s for s in (0.9, 0.99, 1.01, 1.1, 1.5, 3)]
    out = pairs(tmp_path, speeds, 200, 3, hn=0, **anywhere)
    # relative error of v^2 up to (W dt)^2/4 = 2.5e-4 of its parts: 1 % of it is left of v^2 at 1.01 ESCAPE
    left = [math.sqrt(max(0, v * v - ESCAPE**2)) for v in speeds]
    assert relative_speeds(out)[2:] == pytest.approx(left[2:], rel=2e-2)
    assert relative_speeds(out)[4:] == pytest.approx(left[4:], rel=1e-3)
    together = set(out.dump("contacts.dump")[-1]["c_c[1]"])
    assert together == {1, 3}


def test_undamped_impacts_keep_their_speed_to_second_order(tmp_path: Path, law: str) -> None:
    """Whenever within a step the discs touch and part, their energy is the same before and after: halving the step takes 3/4
    of the largest error. 3 leaves room for the phases that are not met."""
    speeds = [ESCAPE * (0.7 + 0.01 * k) for k in range(60)]
    error = {}
    for n in (100, 200):
        out = pairs(tmp_path / str(n), speeds, n, 1.5, hn=0, law=law)
        assert len(out.dump("contacts.dump")[-1]["c_c[1]"]) == 0
        error[n] = np.abs(relative_speeds(out) / speeds - 1).max()
    assert error[100] < (2 * math.pi / 100) ** 2
    assert error[100] / error[200] > 3


@pytest.mark.parametrize("h", [0.05, 0.215])
def test_damped_impacts_stick_below_a_speed(tmp_path: Path, anywhere: dict[str, Any], h: float) -> None:
    """Discs that are a little too slow to part, a little faster, and much faster."""
    slow, fast = 0.0, 1e3 * ESCAPE
    while fast - slow > 1e-6 * fast:
        middle = (slow + fast) / 2
        slow, fast = (slow, middle) if exit_speed(middle, h) > 0 else (middle, fast)
    speeds = [0.98 * fast, 1.02 * fast, 2 * fast, 10 * fast]
    out = pairs(tmp_path, speeds, 200, 2, hn=h, **anywhere)
    assert set(out.dump("contacts.dump")[-1]["c_c[1]"]) == {1}
    expected = [exit_speed(v, h) for v in speeds[1:]]
    # second order, as the pull sets in and ends within a step: (W dt)^2 = 1e-3 of the speed before
    assert relative_speeds(out)[1:] == pytest.approx(expected, abs=1e-3 * fast, rel=1e-3)


@pytest.mark.parametrize("cut", ["no", "yes"])
def test_contact_at_rest(tmp_path: Path, anywhere: dict[str, Any], cut: str) -> None:
    """Discs that just touch are drawn together, and come to rest at an overlap of F_c/k_n without a force. Energies have
    k_n x^2/2 - F_c x, also eng_vdwl and single(), and the audit closes. The dashpot alone is what limit_damping limits:
    on the first half of the way in it may not push against what is no spring yet."""
    h = 0.3
    out = pairs(tmp_path, [1e-9], 200, 8, hn=h, cut=cut, **anywhere)
    t = 2 * math.pi / W0 / 200 * (out.thermo["Step"] - 0.5)  # since they touched
    frames = out.dump("contacts.dump")[1:]
    x, fn = (np.array([f[f"c_c[{k}]"][0] for f in frames]) for k in (2, 3))
    assert x[-1] == pytest.approx(REST, rel=1e-6)
    assert abs(fn[-1]) < 1e-6 * PULL
    if cut == "no":
        assert x == pytest.approx(overlap(t[1:], 1e-9, h), abs=2e-3 * REST)
    else:
        assert (fn >= -PULL).all()
    stored = KN * x**2 / 2 - PULL * x
    for energy in ("PotEng", "c_sum", "c_energy[3]"):
        assert out.thermo[energy][1:] == pytest.approx(stored, abs=1e-9 * PULL * REST), energy
    assert out.thermo["c_energy[6]"][-1] == pytest.approx(PULL**2 / (2 * KN), rel=2e-3)  # all of it into dashpots
    assert abs(out.thermo["c_energy[10]"][-1]) < 2e-3 * PULL**2 / (2 * KN)


PULLED = """
include ${decks}/start.in
fix move grains cdem/integrate dt any gravity ${g} 0
timestep 1e-6
compute c all cdem/contacts overlap
dump c all local ${steps} contacts.dump c_c[1]
run ${steps}
"""


@pytest.mark.parametrize("share", [0.99, 1.01])
def test_pull_off(tmp_path: Path, anywhere: dict[str, Any], share: float) -> None:
    """A disc on a wall, pulled by a force a little below F_c, has the overlap (F_c - F)/k_n; one a little above goes: from
    that of 0.99 F_c, in some half a period of the oscillator."""
    disc = Disc(0, 0)
    start = 0.01 * REST
    discs = [Disc(disc.diameter - start, 0), Disc(0, 0, type=2)]
    out = run(
        PULLED,
        tmp_path,
        discs=discs,
        kn=KN,
        g=share * PULL / disc.mass,
        added=f"cohesion {PULL}",
        steps=2000,
        **anywhere,
    )
    seen = out.dump("contacts.dump")[-1]["c_c[1]"]
    # coordinates of 4e-3 m have a last bit of 9e-19 m
    assert seen == pytest.approx([start] if share < 1 else [], rel=1e-6)
