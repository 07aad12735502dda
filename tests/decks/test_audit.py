# SPDX-License-Identifier: GPL-2.0-or-later
"""The audit of compute cdem/energy: each of its entries against a closed form, and a residual of second order."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from engine import Disc, EngineError, run
from scenes import cloud, mini_box

PARTS = (
    "translation",
    "rotation",
    "springs",
    "tangential",
    "friction",
    "dashpots",
    "drag",
    "walls",
    "gravity",
    "residual",
)

ADDED = "rolling 0.3 0.2 cohesion 40"

AUDIT = """
compute    energy all cdem/energy audit yes
thermo_style custom step c_energy[*]
thermo_modify format float %.17g lost error
thermo     ${steps}
"""

FREE = (
    "include ${decks}/start.in\nfix move grains cdem/integrate dt any ${body}\ntimestep ${dt}\n"
    + AUDIT
    + "run ${steps}"
)


def books(deck: str, directory: Path, **options: Any) -> dict[str, float]:
    """The last row of the audit, by name (J)."""
    table = run(deck, directory, **options).thermo
    return {name: table[f"c_energy[{k}]"][-1] for k, name in enumerate(PARTS, 1)}


def duration(h: float, kn: float = 1e8) -> float:
    """Of a contact of two discs of 4 mm without a cut-off (s)."""
    return math.pi / math.sqrt(2 * kn / Disc(0, 0).mass * (1 - h * h))


def test_dashpots_of_a_collision(tmp_path: Path, law: str, ranks: int) -> None:
    """Head on, the dashpots take 1 - e^2 of the kinetic energy, e = exp(-pi h/sqrt(1 - h^2))."""
    h, v = 0.215, 0.1
    d = Disc(0, 0)
    dt = duration(h) / 200
    discs = [Disc(sign * (d.radius + 3.4 * v * dt), 0, vx=-sign * v) for sign in (1, -1)]
    got = books(FREE, tmp_path, discs=discs, ranks=ranks, law=law, body="", dt=dt, steps=220)
    loss = d.mass * v**2 * (1 - math.exp(-2 * math.pi * h / math.sqrt(1 - h * h)))
    assert got["dashpots"] == pytest.approx(loss, rel=3e-4)
    assert got["friction"] == pytest.approx(0, abs=1e-15 * loss)
    assert abs(got["residual"]) < 3e-4 * loss


def test_friction_of_a_collision(tmp_path: Path, law: str, ranks: int) -> None:
    """An impact without damping that slides all the way: the normal momentum is 2 m v, friction passes mu times that on,
    and the slip of the rims falls by 6/m (1/m of either disc, r^2/I = 2/m of either spin) times it. The work of friction
    is that momentum times the mean of the slip before and after."""
    mu, v, slip = 0.1, 0.1, 0.3
    d = Disc(0, 0)
    dt = duration(0) / 400
    ks = 1e9  # stiff, so that what the spring stores before it gives way is small
    discs = [Disc(sign * (d.radius + 3.4 * v * dt), 0, vx=-sign * v, vy=sign * slip / 2) for sign in (1, -1)]
    material = {"hn": 0, "hs": 0, "ks": ks, "phi": math.degrees(math.atan(mu))}
    got = books(FREE, tmp_path, discs=discs, ranks=ranks, law=law, body="", dt=dt, steps=420, **material)
    loss = 2 * mu * d.mass * v * (slip - 6 * mu * v)
    assert got["friction"] == pytest.approx(loss, rel=3e-3)
    assert abs(got["residual"]) < 1e-4 * loss


def test_gravity_and_drag(tmp_path: Path, ranks: int) -> None:
    """A disc falls in a medium: v = g T (1 - exp(-t/T)), gravity has done m g times the way, and the rest went into drag."""
    g, relax, dt, steps = 10.0, 1e-3, 1e-6, 2000
    fall = Disc(0, 0.01, omega=3)
    got = books(
        FREE, tmp_path, discs=[fall], ranks=ranks, body=f"gravity 0 -{g} drag {relax}", dt=dt, steps=steps
    )  # fmt: skip
    t = steps * dt
    v = g * relax * (1 - math.exp(-t / relax))
    work = fall.mass * g * (g * relax * t - v * relax)
    assert got["gravity"] == pytest.approx(work, rel=2e-3)
    assert got["drag"] == pytest.approx(work - fall.mass * v * v / 2, rel=2e-3)
    assert abs(got["residual"]) < 1e-3 * work


@pytest.mark.parametrize("rest", ["", " pre no"], ids=["set up", "goes on"])
def test_gravity_that_changes_between_runs(tmp_path: Path, ranks: int, rest: str) -> None:
    """A disc thrown up falls to the right as gravity turns: m g.s of either half, and nothing is missing. A run without
    setup begins with half a step of the old force, as in all of LAMMPS."""
    deck = FREE.replace("run ${steps}", "run $(v_steps/2)\nfix_modify move gravity 7 0\nrun $(v_steps/2)" + rest)
    thrown = Disc(0, 0.01, vy=1)
    dt, g = 1e-6, 10.0
    half, late = 1000 * dt, dt / 2 if rest else 0
    got = books(deck, tmp_path, discs=[thrown], ranks=ranks, body=f"gravity 0 -{g}", dt=dt, steps=2000)
    up, right = half - g * half**2 / 2, 7 * half * (half / 2 - late)
    assert got["gravity"] == pytest.approx(thrown.mass * (7 * right - g * up), rel=1e-9)
    assert abs(got["residual"]) < thrown.mass * (1e-9 + g * late * thrown.vy)


def test_work_of_a_moving_wall(tmp_path: Path, law: str, ranks: int) -> None:
    """A wall disc is pushed slowly into a disc that leans on another: two springs in series, undamped. The work is the
    energy of the springs, kn s^2/4 with both overlaps s/2."""
    d, s = Disc(0, 0), 1e-5
    discs = [Disc(0, 0), Disc(-d.diameter, 0, type=2), Disc(d.diameter, 0, type=3)]
    deck = """
    include ${decks}/start.in
    fix     move grains cdem/integrate dt any
    group   pusher type 3
    fix     push pusher cdem/move speed -0.01 ramp 1e-3 stop 1e-5
    timestep 2e-7
    """ + AUDIT + "run ${steps}"  # fmt: skip
    got = books(deck, tmp_path, discs=discs, ranks=ranks, law=law, hn=0, hs=0, steps=8000)
    assert got["walls"] == pytest.approx(1e8 * s * s / 4, rel=1e-3)
    assert abs(got["residual"]) < 1e-5 * got["walls"]


def mini_books(directory: Path, **options: Any) -> dict[str, float]:
    """A box in motion, with lid, moving floor, gravity, friction and dashpots."""
    discs, box = mini_box()
    deck = (Path(__file__).parent / "mini_box.in").read_text()
    deck = deck.replace("timestep   2e-7", "timestep ${dt}").replace(
        "thermo_style  custom step", "compute energy all cdem/energy audit yes\nthermo_style custom step c_energy[*]"
    )
    return books(deck.split("dump       end")[0], directory, discs=discs, box=box, **options)


@pytest.mark.parametrize(("style", "added"), [("verlet", ""), ("verlet/cdem", ""), ("verlet/cdem", ADDED)])
def test_residual_of_a_box_in_motion(tmp_path: Path, law: str, ranks: int, style: str, added: str) -> None:
    """All that comes in goes somewhere, and what is missing shrinks with the square of the time step. Many impacts add up
    to the residual, so the order is that of their mean."""
    coarse, fine = (
        mini_books(
            tmp_path / str(k),
            ranks=ranks,
            law=law,
            style=style,
            added=added,
            dt=2e-7 / k,
            steps=1500 * k,
            until=700 * k,
        )
        for k in (1, 3)
    )
    assert min(fine[part] for part in ("friction", "dashpots", "walls", "gravity")) > 1e-4
    # (pi/n)^2/8 of an impact of n = 15 steps would be 5e-3; where forces set in within a step is in the books
    for got, k in ((coarse, 1), (fine, 3)):
        assert abs(got["residual"]) < 1.5e-4 / k**2 * (got["friction"] + got["dashpots"])


@pytest.mark.parametrize("added", ["", ADDED])
def test_books_go_on_after_a_restart(tmp_path: Path, law: str, ranks: int, added: str) -> None:
    """As if there had been none, and no set-up, of which there are three. What is summed is added up in another order, to a
    few last bits."""
    options = {"ranks": ranks, "law": law, "added": added, "dt": 2e-7, "steps": 1300, "until": 700}
    whole = mini_books(tmp_path, plan="pass", **options)
    again = mini_books(tmp_path, plan="read", **options)
    assert again == pytest.approx(whole, rel=0, abs=1e-14 * whole["walls"])


def test_an_audit_changes_nothing(tmp_path: Path, law: str) -> None:
    ends = []
    for audit in ("yes", "no"):
        deck = FREE.replace("audit yes", f"audit {audit}") + "\ninclude ${decks}/end.in"
        ends.append(run(deck, tmp_path / audit, discs=cloud(4, 2.0), law=law, body="", dt=2e-7, steps=3000).end)
    for column in ("x", "y", "vx", "vy", "omegaz", "fx", "fy", "tqz"):
        assert (ends[0][column] == ends[1][column]).all()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("audit", "Compute cdem/energy c: audit nothing: must be yes or no"),
        ("audit 1", "Compute cdem/energy c: audit 1: must be yes or no"),
        ("audit yes\ncompute d all cdem/energy audit yes", "Compute cdem/energy d: there is one with an audit already"),
    ],
)
def test_errors(tmp_path: Path, arguments: str, message: str) -> None:
    deck = f"include ${{decks}}/start.in\nfix move grains cdem/integrate\ncompute c all cdem/energy {arguments}\nrun 0"
    with pytest.raises(EngineError, match=message):
        run(deck, tmp_path, discs=[Disc(0, 0)])


@pytest.mark.parametrize("then", ["run 1", "run 1 pre no"])
def test_an_audit_without_its_books_is_refused(tmp_path: Path, then: str) -> None:
    deck = (
        "include ${decks}/start.in\nfix move grains cdem/integrate\ncompute c all cdem/energy audit yes\n"
        f"thermo_style custom step c_c[10]\nrun 1\nunfix CDEM_AUDIT\n{then}"
    )
    with pytest.raises(EngineError, match="c: fix CDEM_AUDIT, which has the books of the audit, was removed"):
        run(deck, tmp_path, discs=[Disc(0, 0)])
