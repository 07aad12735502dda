# SPDX-License-Identifier: GPL-2.0-or-later
"""The lid under constant stress (fix cdem/lid), walls that move as told (fix cdem/move), and the forces on them."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from engine import DECKS, Disc, run, start
from scenes import mini_box

KN = 1e8
WIDTH, THICKNESS = 0.02, 0.01  # m
D = 4e-3


def lid_of(n: int, y: float) -> list[Disc]:
    return [Disc((i - (n - 1) / 2) * D, y, D, type=3) for i in range(n)]


FALL = """
include ${decks}/start.in
group lid type 3
fix move grains cdem/integrate
variable sigma equal ${stress}*(step/${steps})
fix lid lid cdem/lid stress ${sigma_or_variable} width 0.02 thickness 0.01 vmax ${vmax}
timestep 2e-7
thermo_style custom step f_lid[1] f_lid[2] f_lid[3] f_lid[4] f_lid[5]
thermo_modify format float %.17g
thermo 10
run ${steps}
include ${decks}/end.in
"""
GRAIN = Disc(0, -0.015)  # far from the lid


@pytest.mark.parametrize("vmax", [0.05, "auto"])
def test_lid_alone(tmp_path: Path, law: str, ranks: int, vmax: float | str) -> None:
    """v = -F t/M, y = y0 - F t^2/(2 M) with F = stress x width x thickness, until v reaches the cap: then uniform. The cap
    is vmax, or F/sqrt(n kn M). Velocity Verlet is exact in either part; within the step between, M v is off by F dt."""
    n, stress, dt, steps = 5, 1e4, 2e-7, 300
    discs = lid_of(n, 0.01)
    out = run(FALL, tmp_path, discs=[GRAIN, *discs], law=law, ranks=ranks, stress=stress, sigma_or_variable=stress,
              vmax=vmax, steps=steps)  # fmt: skip
    force, mass = stress * WIDTH * THICKNESS, n * discs[0].mass
    cap = force / math.sqrt(n * KN * mass) if isinstance(vmax, str) else vmax
    t, until = out.thermo["Step"] * dt, cap * mass / force
    falls = np.minimum(t, until)
    y = 0.01 - D / 2 - force / mass * falls**2 / 2 - cap * (t - falls)
    assert out.thermo["f_lid[4]"] == pytest.approx(-force / mass * falls, rel=1e-12)
    assert out.thermo["f_lid[3]"] == pytest.approx(y, abs=force / mass * dt**2)
    assert out.thermo["f_lid[3]"][t < until] == pytest.approx(y[t < until], abs=1e-15)
    assert np.all(out.thermo["f_lid[1]"] == stress) and np.all(out.thermo["f_lid[2]"] == 0)
    assert out.thermo["f_lid[5]"][-1] == pytest.approx(steps - until / dt, abs=1)
    lid = out.end["type"] == 3
    assert np.ptp(out.end["y"][lid]) == 0 and np.ptp(out.end["vy"][lid]) == 0
    assert np.array_equal(out.end["x"][lid], [d.x for d in discs])


def test_lid_under_a_stress_that_grows(tmp_path: Path, ranks: int) -> None:
    """Stress from a variable, s t/T: v = -F t^2/(2 T M), with F at T. The trapezoidal rule is exact for it."""
    n, stress, dt, steps = 5, 1e4, 2e-7, 300
    out = run(FALL, tmp_path, discs=[GRAIN, *lid_of(n, 0.01)], ranks=ranks, stress=stress, sigma_or_variable="v_sigma",
              vmax=1, steps=steps)  # fmt: skip
    force, mass = stress * WIDTH * THICKNESS, n * Disc(0, 0, D).mass
    t, whole = out.thermo["Step"] * dt, steps * dt
    assert out.thermo["f_lid[1]"] == pytest.approx(stress * t / whole, rel=1e-12)
    assert out.thermo["f_lid[4]"] == pytest.approx(-force / mass * t**2 / (2 * whole), rel=1e-12)


VIBRATE = """
include ${decks}/start.in
group lid type 3
fix move grains cdem/integrate
fix lid lid cdem/lid stress ${stress} width 0.02 thickness 0.01 vmax 100
timestep ${dt}
thermo_style custom step f_lid[2] f_lid[3] f_lid[4]
thermo_modify format float %.17g
thermo 20
dump d all custom 20 vibration.dump id y
dump_modify d format float %.17g sort id
run ${steps}
"""


def test_lid_on_a_grain_vibrates(tmp_path: Path, law: str, ranks: int) -> None:
    """Floor, grain and lid, undamped, at rest with half of the overlap that the stress needs: two masses on two springs,
    y = y_eq + sum over the modes of a_k cos(w_k t). The grain's own motion tests that the lid's force reaches it.
    Tolerance: the frequency is too high by (w dt)^2/24, 1.3e-5 for the upper mode, over 35 rad."""
    stress, dt, steps = 1e5, 2e-8, 2000
    force = stress * WIDTH * THICKNESS
    overlap = force / KN
    grain = Disc(0, 0, D)
    start = [Disc(0, -D + overlap / 2, D, type=2), grain, Disc(0, D - overlap / 2, D, type=3)]
    out = run(VIBRATE, tmp_path, discs=start, law=law, ranks=ranks, stress=stress, dt=dt, steps=steps, hn=0, hs=0)
    m = grain.mass  # the lid has as much
    squares, modes = np.linalg.eigh(KN / m * np.array([[2, -1], [-1, 1]]))
    equilibrium = np.array([-overlap / 2, D - overlap / 2 - overlap])
    amplitude = modes.T @ (np.array([grain.y, start[2].y]) - equilibrium)
    t = out.thermo["Step"] * dt
    y = equilibrium[:, None] + modes @ (amplitude[:, None] * np.cos(np.sqrt(squares)[:, None] * t))
    measured = out.series("vibration.dump", "y").T[1:]
    assert measured == pytest.approx(y, abs=2e-3 * overlap)
    felt = KN * (D - (y[1] - y[0]))
    assert out.thermo["f_lid[2]"] * WIDTH * THICKNESS == pytest.approx(felt, abs=4e-3 * force)
    assert out.thermo["f_lid[3]"] == pytest.approx(measured[1] - D / 2, abs=1e-17)


SETTLE = """
include ${decks}/start.in
group lid type 3
fix weight grains gravity 1000 vector 0 -1 0
fix move grains cdem/integrate dt auto
fix floor walls cdem/move speed 0
fix lid lid cdem/lid stress ${stress} width 0.02 thickness 0.01
thermo_style custom step f_lid[2] f_lid[4] f_floor[4]
thermo_modify format float %.17g
thermo 10
run 6000
include ${decks}/end.in
"""


def test_column_under_a_lid(tmp_path: Path, law: str, ranks: int) -> None:
    """A lid comes down on a column and rests: the contact above i grains carries F + i m g, the floor F + n m g, and the
    lid feels just its stress. On its way it never feels more than 3 F: F from the impact at the automatic cap, and up to
    2 F from a load that comes at once."""
    n, stress = 2, 1e5
    column = [Disc(0, (i - (n - 1) / 2) * D, D) for i in range(n)]
    floor, lid = Disc(0, column[0].y - D, D, type=2), Disc(0, column[-1].y + D + 1e-7, D, type=3)
    out = run(SETTLE, tmp_path, discs=[*column, floor, lid], law=law, ranks=ranks, stress=stress, hn=0.5, hs=0.5)
    force, weight = stress * WIDTH * THICKNESS, column[0].mass * 1000
    felt = out.thermo["f_lid[2]"]
    assert felt.max() < 3 * stress and felt.min() > -0.1 * stress
    assert felt[-1] == pytest.approx(stress, rel=1e-8)
    assert abs(out.thermo["f_lid[4]"][-1]) < 1e-9  # m/s
    assert -out.thermo["f_floor[4]"][-1] == pytest.approx(force + n * weight, rel=1e-8)
    y = np.concatenate([[floor.y], out.end["y"][:n], [out.end["y"][-1]]])
    assert D - np.diff(y) == pytest.approx((force + weight * np.arange(n, -1, -1)) / KN, rel=1e-8)


MOVE = """
include ${decks}/start.in
fix move grains cdem/integrate dt any
fix wall walls cdem/move speed ${speed} dir ${dir} ramp ${ramp} stop ${stop}
timestep 1e-6
thermo_style custom step f_wall[1] f_wall[2]
thermo_modify format float %.17g
thermo 10
dump d walls custom 10 wall.dump id x y vx vy
dump_modify d format float %.17g sort id
run 600
"""


@pytest.mark.parametrize("direction", ["x", "y"])
@pytest.mark.parametrize(("speed", "ramp"), [(2.0, 0.0), (-2.0, 1e-4)], ids=["at-once", "ramp-backwards"])
def test_prescribed_displacement(tmp_path: Path, ranks: int, direction: str, speed: float, ramp: float) -> None:
    """s = V/2 (t - T/pi sin(pi t/T)) in the ramp T, V (t - T/2) after it, and S for good once it is reached: in multiples
    of 2^-50 m, so that the wall keeps its shape to the last bit of its coordinates."""
    stop = 8e-4
    walls = [Disc(x, y, D, type=2) for x in (-0.008, 0.001, 0.0101) for y in (-0.01, 0.002)]
    out = run(MOVE, tmp_path, discs=[Disc(0.017, 0.017, 1e-3), *walls], ranks=ranks, dir=direction, speed=speed,
              ramp=ramp, stop=stop)  # fmt: skip
    t = out.thermo["Step"] * 1e-6
    if ramp:
        s = np.where(t < ramp, speed / 2 * (t - ramp / math.pi * np.sin(math.pi * t / ramp)), speed * (t - ramp / 2))
        v = np.where(t < ramp, speed / 2 * (1 - np.cos(math.pi * t / ramp)), speed)
    else:
        s, v = speed * t, np.full_like(t, speed)
    stopped = np.abs(s) >= stop
    assert 30 < np.count_nonzero(~stopped) < 50
    s, v = np.where(stopped, math.copysign(stop, speed), s), np.where(stopped, 0, v)
    assert out.thermo["f_wall[1]"] == pytest.approx(s, abs=2**-50)
    assert out.thermo["f_wall[2]"] == pytest.approx(v, rel=1e-12, abs=1e-12)
    across = "y" if direction == "x" else "x"
    start = np.array([getattr(d, direction) for d in walls])
    assert out.series("wall.dump", direction) == pytest.approx(start + s[:, None], abs=2**-50 + 1e-17)
    assert np.all(out.series("wall.dump", across) == [getattr(d, across) for d in walls])
    assert out.series("wall.dump", f"v{direction}")[1:] == pytest.approx(np.tile(v[1:, None], len(walls)), abs=1e-12)
    assert np.all(out.series("wall.dump", f"v{across}") == 0)
    assert abs(out.thermo["f_wall[1]"][-1]) == pytest.approx(stop, abs=2**-51)  # as exactly as the multiples allow


GO_ON = """
newton off
processors ${px} ${py} 1
read_restart moved.restart
comm_modify vel yes
fix move grains cdem/integrate dt any
fix wall walls cdem/move ${motion}
thermo_style custom step f_wall[1]
thermo_modify format float %.17g
run 100
"""
MOVED = MOVE.replace("run 600", "run 200\nwrite_restart moved.restart")  # 200 us, 350 um


@pytest.mark.parametrize(
    ("motion", "end"),
    [
        ("speed 2 ramp 5e-5 stop 8e-4", 5.5e-4),
        ("speed 2 ramp 5e-5 stop 4e-4", 4e-4),
        ("speed 2 ramp 5e-5", 5.5e-4),
        ("speed 0", 0),
    ],
)
def test_a_motion_goes_on_from_a_restart_file(tmp_path: Path, motion: str, end: float) -> None:
    """On its own path; where it stops may be changed as long as it moves. A wall at rest has no motion."""
    discs = [Disc(0.017, 0.017, 1e-3), Disc(0, 0, D, type=2)]
    run(MOVED, tmp_path, discs=discs, speed=2, dir="x", ramp=5e-5, stop=8e-4)
    assert run(GO_ON, tmp_path, motion=motion).thermo["f_wall[1]"][-1] == pytest.approx(end, abs=2**-50)


@pytest.mark.parametrize(
    "motion", ["speed 1 ramp 5e-5", "speed 2", "speed 2 ramp 5e-5 dir y", "speed 2 ramp 5e-5 stop 2e-4"]
)
def test_a_path_on_which_a_wall_is_not_is_refused(tmp_path: Path, motion: str) -> None:
    """It would jump there, or its displacement would."""
    discs = [Disc(0.017, 0.017, 1e-3), Disc(0, 0, D, type=2)]
    run(MOVED, tmp_path, discs=discs, speed=2, dir="x", ramp=5e-5, stop=8e-4)
    status, output = start(GO_ON, tmp_path, motion=motion)
    assert status != 0
    assert re.search(
        r"Fix cdem/move wall: in the restart file the wall has moved by 0.00035\d* m along x in 0.0002 s", output
    )


def test_forces_on_the_walls_sum_to_the_whole(tmp_path: Path, law: str, ranks: int) -> None:
    """Action and reaction: what the contacts do to floor, sides and lid, and to the grains, sums to nothing; and the three
    walls have the sum that compute reduce finds over all wall discs. To round-off of the forces, some 10 N."""
    deck = f"""
    {(DECKS / "mini_box.in").read_text()}
    undump end
    group sides type 2
    group all_walls type 2 3 4
    fix sides sides cdem/move speed 0
    compute f all_walls reduce sum fx fy
    compute grains grains reduce sum fx fy
    variable weight equal mass(grains)*1000
    thermo_style custom step f_lid[6] f_lid[2] f_floor[3] f_floor[4] f_sides[3] f_sides[4] c_f[1] c_f[2] c_grains[1] c_grains[2] v_weight
    thermo_modify format float %.17g
    thermo 20
    run 400
    """
    discs, box = mini_box()
    thermo = run(deck, tmp_path, discs=discs, box=box, law=law, ranks=ranks).thermo
    lid_y = thermo["f_lid[2]"] * 0.032 * 0.01
    x = thermo["f_lid[6]"] + thermo["f_floor[3]"] + thermo["f_sides[3]"]
    y = lid_y + thermo["f_floor[4]"] + thermo["f_sides[4]"]
    assert np.all(np.abs(thermo["f_floor[3]"]) > 1) and np.any(thermo["f_sides[3]"] != 0) and np.all(lid_y > 1)
    assert x == pytest.approx(thermo["c_f[1]"], abs=1e-11)
    assert y == pytest.approx(thermo["c_f[2]"], abs=1e-11)
    assert thermo["c_grains[1]"] == pytest.approx(-x, abs=1e-10)
    assert thermo["c_grains[2]"] + thermo["v_weight"] == pytest.approx(-y, abs=1e-10)


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_forces_on_parts_are_those_of_the_fixes(tmp_path: Path, ranks: int, style: str) -> None:
    """Compute cdem/force of floor, left side, right side and both gives the bits of fixes cdem/move for the same discs;
    the smooth floor and lid hold the weight and the load, and both sides are the sum of either."""
    deck = f"""
    {(DECKS / "mini_box.in").read_text()}
    undump end
    region left block -1 0 EDGE EDGE EDGE EDGE units box
    group left region left
    group sides type 2
    group west intersect left sides
    group east subtract sides west
    fix west west cdem/move speed 0
    fix east east cdem/move speed 0
    compute part all cdem/force floor west east sides
    thermo_style custom step c_part[*] f_floor[3] f_floor[4] f_west[3] f_west[4] f_east[3] f_east[4]
    thermo_modify format float %.17g
    thermo 20
    run 400
    """
    discs, box = mini_box()
    thermo = run(deck, tmp_path, discs=discs, box=box, ranks=ranks, style=style).thermo
    for k, part in enumerate(["floor", "west", "east"]):
        for axis in (1, 2):
            assert np.array_equal(thermo[f"c_part[{2 * k + axis}]"], thermo[f"f_{part}[{axis + 2}]"]), part
    assert np.all(thermo["c_part[3]"] <= 0) and np.any(thermo["c_part[3]"] < 0) and np.any(thermo["c_part[5]"] > 0)
    assert thermo["c_part[7]"] == pytest.approx(thermo["c_part[3]"] + thermo["c_part[5]"], abs=1e-12)


def test_a_part_that_is_another_group_by_now(tmp_path: Path) -> None:
    """A group that was deleted between two runs and made anew: compute cdem/force has the force on its present atoms."""
    deck = """
    include ${decks}/start.in
    fix move grains cdem/integrate
    group part id 2
    compute part all cdem/force part
    thermo_style custom step c_part[*]
    run 0
    group part delete
    group other id 2
    group part id 4
    run 0
    """
    discs = [Disc(0, D - 1e-6), Disc(0, 0, type=2), Disc(0.01, D - 3e-6), Disc(0.01, 0, type=2)]
    thermo = run(deck, tmp_path, discs=discs).thermo
    assert thermo["c_part[2]"][-1] == pytest.approx(-1e8 * 3e-6, rel=1e-9)


SIDES = """
include ${decks}/start.in
group    lid type 3
fix      move grains cdem/integrate
fix      lid lid cdem/lid stress ${stress} width 0.02 thickness 0.01 from ${side} vmax 100
fix      wall walls cdem/move speed 0
timestep 4e-8
thermo_style custom step f_lid[1] f_lid[2] f_lid[3] f_lid[4] f_lid[5] f_lid[6]
thermo_modify format float %.17g
thermo   100
run      1000
"""
# From coordinates of a lid on top to those of another: x outward, y along.
TURNED = {"top": (0, 1), "bottom": (0, -1), "right": (1, 1), "left": (1, -1)}


@pytest.mark.parametrize("side", ["bottom", "left", "right"])
def test_a_lid_from_any_side(tmp_path: Path, ranks: int, side: str) -> None:
    """It does what a lid on top does, turned: the same bits from below, since a change of sign rounds nothing; from a side to
    round-off, since the sum of squares of a distance takes x first. A grain that moves along the lid rubs on it."""

    def on(side: str) -> np.ndarray:
        turned, sign = TURNED[side]
        discs = []
        for along, outward, velocity, kind in [(1e-4, -D + 1e-6, 0, 2), (0, 0, 0.1, 1), (-2e-4, D - 1e-6, 0, 3)]:
            x, y, vx, vy = along, sign * outward, velocity, 0
            discs.append(Disc(y, x, vx=vy, vy=vx, type=kind) if turned else Disc(x, y, vx=vx, vy=vy, type=kind))
        out = run(SIDES, tmp_path / side, discs=discs, ranks=ranks, stress=1e5, side=side)
        values = np.array([out.thermo[f"f_lid[{k}]"] for k in range(1, 7)])
        values[2] *= sign  # the place of the lid
        return values

    top = on("top")
    assert np.any(top[3] < 0) and np.any(top[5] != 0)
    if side == "bottom":
        assert np.array_equal(on(side), top)
    else:
        assert on(side) == pytest.approx(top, rel=1e-7)


SPRING = """
include ${decks}/start.in
group    lid type 3
fix      move grains cdem/integrate
variable spring equal ${stress}+${stiffness}*(f_lid[3]-${face})
fix      lid lid cdem/lid stress v_spring width 0.02 thickness 0.01 vmax 100
timestep ${dt}
thermo_style custom step f_lid[1] f_lid[3]
thermo_modify format float %.17g
thermo   100
run      ${steps}
"""


def test_a_lid_of_constant_stiffness(tmp_path: Path, ranks: int) -> None:
    """Held by a spring, the lid meets nothing and swings: y = y1 - a cos(w t) about the place without stress, y1, with
    w^2 = K W T/M. Its stress is pressure only until it is there, a quarter of the period."""
    stress, stiffness, dt = 1e5, 1e8, 1e-7
    lid = lid_of(5, 0.01)
    face, amplitude = 0.01 - D / 2, stress / stiffness
    omega = math.sqrt(stiffness * WIDTH * THICKNESS / (5 * lid[0].mass))
    steps = int(math.pi / 2 / omega / dt / 100) * 100
    out = run(SPRING, tmp_path, discs=[GRAIN, *lid], ranks=ranks, stress=stress, stiffness=stiffness, face=face, dt=dt,
              steps=steps)  # fmt: skip
    t = out.thermo["Step"] * dt
    assert out.thermo["f_lid[3]"] == pytest.approx(
        face - amplitude + amplitude * np.cos(omega * t), abs=1e-4 * amplitude
    )
    assert out.thermo["f_lid[1]"] == pytest.approx(stress * np.cos(omega * t), abs=1e-4 * stress)


@pytest.mark.parametrize(("side", "normal", "sign"), [("top", (0, 1), 1), ("left", (1, 0), -1)])
def test_the_face_of_a_lid_that_leaves_a_periodic_box(
    tmp_path: Path, ranks: int, side: str, normal: tuple[int, int], sign: int
) -> None:
    """Without a stress a lid keeps its velocity outward, and its face goes on where LAMMPS puts its discs in at the other
    side of the box, one by one if they are not in line."""
    deck = """
    include  ${decks}/start.in
    fix      move grains cdem/integrate dt any
    fix      lid walls cdem/lid stress 0 width 0.01 thickness 0.01 from ${side}
    velocity walls set ${vx} ${vy} 0
    timestep 1e-6
    thermo   300
    thermo_style custom step f_lid[3]
    thermo_modify format float %.17g
    run      1500
    run      1500
    """
    v, r, (nx, ny) = 5.0, 2e-3, normal
    discs = [Disc(nx * sign * d + ny * 5e-3, ny * sign * d + nx * 5e-3, type=2) for d in (0.0185, 0.0192)]
    discs.append(Disc(0, 0))
    done = run(
        deck, tmp_path, discs=discs, ranks=ranks, bx="p", by="p", side=side, vx=sign * v * nx, vy=sign * v * ny
    )  # fmt: skip
    face = sign * (0.0185 - r + v * 1e-6 * done.thermo["Step"])
    assert done.thermo["f_lid[3]"] == pytest.approx(face, rel=1e-9)


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
@pytest.mark.parametrize("how", ["yes", "no"])
def test_a_moved_wall_knows_a_time_step_that_changed(tmp_path: Path, how: str, style: str) -> None:
    """Its displacement is that of the time that has passed, also in a run without a setup."""
    deck = f"""
    include  ${{decks}}/start.in
    fix      move grains cdem/integrate dt any
    fix      wall walls cdem/move speed 2
    timestep 1e-6
    thermo_style custom step f_wall[1]
    run      100
    timestep 2.5e-7
    run      100 pre {how}
    """
    done = run(deck, tmp_path, discs=[Disc(0, 0), Disc(0.01, 0, type=2)], style=style)
    assert done.thermo["f_wall[1]"][-1] == pytest.approx(2 * 1.25e-4, rel=1e-6)


def test_a_wall_moves_on_without_our_integrator(tmp_path: Path) -> None:
    deck = """
include ${decks}/start.in
fix move grains cdem/integrate
fix wall walls cdem/move speed 1
timestep 1e-7
run 10
unfix move
pair_style gran/hooke/history 1e6 NULL 0 NULL 0.5 0
pair_coeff * *
fix move grains nve/sphere disc
run 10
print "way = $(f_wall[1])"
"""
    done = run(deck, tmp_path, discs=[Disc(0.01, 0.01), Disc(0, 0, type=2)], style="verlet")
    assert done.printed("way") == pytest.approx(2e-6, abs=2**-50)
