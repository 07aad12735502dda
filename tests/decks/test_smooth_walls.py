# SPDX-License-Identifier: GPL-2.0-or-later
"""Straight smooth walls (template line of fix cdem/shape): nothing resists slip, and joints of pieces do not exist.

The wall is a row of six pieces, 4 mm each, along x = 0 from y = -12 to 12 mm, with a radius of 2 mm.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import DENSITY, Run, run, start
from scenes import cloud

WALL = """
units si
dimension 2
boundary f f p
processors ${px} ${py} 1
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
region b block -0.06 0.06 -0.06 0.06 -0.01 0.01
create_box 3 b
variable shape index single
fix shape all cdem/shape type 1 ${shape} type 2 line ${ux} ${uy} type 3 line ${vx} ${vy} density 26.5
cdem/create 2 row $(-0.01*v_ux) $(-0.01*v_uy) $(0.01*v_ux) $(0.01*v_uy) 6 diameter 0.008 density 26.5
group wall type 2
pair_style cdem law ${law}
pair_coeff * * 1e8 2.5e7 ${hn} 0.215 0
variable skin index 5e-4
neighbor ${skin} bin
neigh_modify delay 0 every 1 check yes
variable style index verlet/cdem
run_style ${style}
"""
GRAIN = """
create_atoms 1 single ${x} ${y} 0
set type 1 diameter 0.004
group grains type 1
velocity grains set ${gvx} ${gvy} 0
set type 1 omega 0 0 ${spin}
fix move grains cdem/integrate gravity ${gx} ${gy}
fix wall wall cdem/move speed 0
timestep 2e-7
"""
END = """
dump d all custom ${every} end.dump id type x y vx vy omegaz fx fy
dump_modify d format float %.17g sort id
thermo_style custom step f_wall[3] f_wall[4] pe ke
thermo_modify format float %.17g
thermo ${every}
run ${steps}
"""
MASS = DENSITY * math.pi * 2e-3**2
UPRIGHT: dict[str, Any] = {"ux": 0, "uy": 1, "vx": 1, "vy": 0, "hn": 0.215, "spin": 3}


def grain(out: Run, column: str) -> np.ndarray:
    frames = out.dump("end.dump")
    return np.array([frame[column][frame["type"] == 1][0] for frame in frames])


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_a_disc_slides_without_any_resistance(tmp_path: Path, law: str, ranks: int, style: str) -> None:
    """Pressed with its weight m g, with the overlap m g/kn, a disc slides over three joints: not a bit of its velocity, its
    spin and the wall's force changes."""
    weight, v = 100 * MASS, 2.0
    out = run(WALL + GRAIN + END, tmp_path, law=law, ranks=ranks, style=style, **UPRIGHT, x=-0.004 + weight / 1e8,
              y=-0.0105, gvx=0, gvy=v, gx=100, gy=0, every=1000, steps=30000)  # fmt: skip
    assert np.all(grain(out, "vy") == v) and np.all(grain(out, "omegaz") == 3) and np.all(grain(out, "fy") == 0)
    assert grain(out, "y")[-1] == pytest.approx(-0.0105 + 0.006 * v, abs=1e-12)
    assert out.thermo["f_wall[3]"][1:] == pytest.approx(np.full(30, weight), rel=2e-9)  # bits of x: 4e-19/3e-10
    assert np.all(out.thermo["f_wall[4]"] == 0)


def test_an_inclined_wall(tmp_path: Path, law: str, ranks: int) -> None:
    """On a wall inclined by 30 degrees a disc slides over three joints with g sin 30, without turning."""
    c = math.cos(math.pi / 6)
    distance = 0.004 - 500 * c * MASS / 1e8
    out = run(WALL + GRAIN + END, tmp_path, law=law, ranks=ranks, **UPRIGHT | {"ux": c, "uy": 0.5, "spin": 0}, x=0.0105 * c - 0.5 * distance,
              y=0.0105 * 0.5 + distance * c, gvx=0, gvy=0, gx=0, gy=-500, every=2000, steps=40000)  # fmt: skip
    t = np.arange(21) * 2000 * 2e-7
    assert np.hypot(grain(out, "vx"), grain(out, "vy"))[4:] == pytest.approx(250 * t[4:], rel=1e-6)
    assert np.all(grain(out, "omegaz") == 0)


def test_the_end_of_a_wall_is_round(tmp_path: Path, law: str) -> None:
    """A disc that hits the end obliquely flies on as from a wall disc with the wall's radius: the ends are half circles."""
    hit: dict[str, Any] = UPRIGHT | {"x": -0.0025, "y": 0.016, "gvx": 0.5, "gvy": -1, "gx": 0, "gy": 0, "every": 20000, "steps": 20000}  # fmt: skip
    of_line = run(WALL + GRAIN + END, tmp_path / "line", law=law, **hit)
    disc = WALL.replace("type 2 line ${ux} ${uy}", "type 2 single").replace(
        "row $(-0.01*v_ux) $(-0.01*v_uy) $(0.01*v_ux) $(0.01*v_uy) 6 diameter 0.008",
        "row 0 0.012 0 0.012 1 diameter 0.004")  # fmt: skip
    of_disc = run(disc + GRAIN + END, tmp_path / "disc", law=law, **hit)
    assert grain(of_disc, "vy")[-1] > 0.1  # it was hit
    for column in ("x", "y", "vx", "vy", "omegaz"):
        assert grain(of_line, column)[-1] == pytest.approx(grain(of_disc, column)[-1], rel=1e-9)


CORNER = WALL.replace("group wall type 2", "cdem/create 3 row 0.002 0.012 0.022 0.012 6 diameter 0.008 density 26.5\n"
                      "group wall type 2 3")  # fmt: skip


@pytest.mark.parametrize("ranks", [1, 4])
def test_around_a_corner(tmp_path: Path, ranks: int) -> None:
    """Pulled to the corner of two walls, a disc slides up the first, around the corner, and along the second. Only one of
    them acts at a time: the undamped motion keeps its energy, and the disc does not turn. (Incremental accumulation loses
    overlap as the normal turns.)"""
    pull = GRAIN.replace("gravity ${gx} ${gy}", "") + """
variable r atom sqrt(x^2+(y-0.012)^2)
variable fx atom -3e4*mass*x/v_r
variable fy atom -3e4*mass*(y-0.012)/v_r
variable depth atom 3e4*mass*v_r
fix pull grains addforce v_fx v_fy 0 energy v_depth
fix_modify pull energy yes
"""
    out = run(CORNER + pull + END, tmp_path, law="direct", ranks=ranks, **UPRIGHT | {"hn": 0, "spin": 0}, x=-0.004 + 3e-8, y=0.0085,
              gvx=0, gvy=2, gx=0, gy=0, every=100, steps=8000)  # fmt: skip
    total = out.thermo["PotEng"] + out.thermo["KinEng"]
    x, y = grain(out, "x"), grain(out, "y")
    assert x.max() > 0.0025 and abs(y[x.argmax()] - 0.016) < 1e-6  # it came around
    assert np.ptp(total) < 1e-6 * np.ptp(out.thermo["KinEng"])
    assert np.all(grain(out, "omegaz") == 0)


RAIN = WALL.replace("cdem/create 2 row", "cdem/create 3 row -0.02 -0.02 0.02 -0.02 11 diameter 0.008 density 26.5\n"
                    "cdem/create 2 row").replace("group wall type 2", "group wall type 2 3")  # fmt: skip


def rain(directory: Path, **options: Any) -> Run:
    rows = [f"create_atoms 1 single {d.x - 0.012} {d.y + 0.006} 0" for d in cloud(4, 1)]
    deck = RAIN + "\n".join(rows) + GRAIN.replace("create_atoms 1 single ${x} ${y} 0", "") + END
    return run(deck, directory, **UPRIGHT, gvx=0.7, gvy=-1, gx=500, gy=-1000, every=15000, steps=15000, **options)


@pytest.mark.parametrize("shape", ["single", "triple"])
def test_same_bits(tmp_path: Path, law: str, shape: str) -> None:
    """On any ranks, in both run styles and with any skin, with discs and with clumps; and all walls together bear what
    the grains press on them: the momentum of the grains changes by weight and walls alone."""
    one = rain(tmp_path / "1", law=law, shape=shape)
    assert np.count_nonzero(one.end["fx"][one.end["type"] == 1]) >= 5
    for name, options in {"2": {"ranks": 2}, "4": {"ranks": 4}, "verlet": {"style": "verlet"}, "skin": {"skin": 1e-4}}.items():  # fmt: skip
        other = rain(tmp_path / name, law=law, shape=shape, **options)
        for column in ("x", "y", "vx", "vy", "omegaz", "fx", "fy"):
            assert np.array_equal(one.end[column], other.end[column]), (name, column)
        for column in ("f_wall[3]", "f_wall[4]"):
            assert one.thermo[column][-1] == other.thermo[column][-1]


@pytest.mark.parametrize(("old", "new", "message"), [
    ("${hn} 0.215 0", "${hn} 0.215 5", r"pair_coeff 1 2: atoms of type 2 are pieces of a smooth wall"),
    ("${hn} 0.215 0", "${hn} 0.215 0 rolling 0.1 0.1", r"pair_coeff 1 2: .* phi and rolling must be 0"),
    ("line ${ux} ${uy}", "line 0 0", r"Fix cdem/shape: line 0 0: must be a vector that is not zero"),
    ("line ${ux} ${uy}", "line 1", r"Fix cdem/shape"),
    ("group grains type 1", "group grains type 1 2", r"atom 1 of type 2 is a piece of a wall .* must not be in the group"),
])  # fmt: skip
def test_refused(tmp_path: Path, old: str, new: str, message: str) -> None:
    deck = WALL + GRAIN + END
    assert old in deck
    status, output = start(deck.replace(old, new), tmp_path, **UPRIGHT, law="direct", x=-0.004, y=-0.01, gvx=0, gvy=1,
                           gx=0, gy=0, every=10, steps=10)  # fmt: skip
    assert status != 0 and re.search(message, output), output[-800:]
