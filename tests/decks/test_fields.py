# SPDX-License-Identifier: GPL-2.0-or-later
"""Computes cdem/average and cdem/grid: stress, fabric and motion inside the specimen, against closed forms."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from crowd import CROWD_START, PERIOD, SIDE, SPACING, SWELLING, crowd
from engine import Disc, Run, run, start, write_data
from scenes import Box, lattice

FIELDS = (
    "solid grains mass coordination stress_xx stress_yy stress_xy stress_yx kinetic_xx kinetic_yy kinetic_xy velocity_x "
    "velocity_y spin gradient_xx gradient_yy gradient_xy gradient_yx fabric_xx fabric_yy fabric_xy normal_xx normal_yy "
    "normal_xy tangential_xx tangential_yy tangential_xy"
).split()
START = "include ${decks}/start.in\nfix move grains cdem/integrate dt any\ntimestep 2e-7\n"
KN = 1e8


def average(words: str = "") -> str:
    """Makes thermo output of all fields of the grains."""
    return f"""
    compute all grains cdem/average {words}
    thermo_style custom step c_all[*]
    thermo_modify format float %.17g
    """


def values(done: Run) -> dict[str, float]:
    """Fields at the end of the run."""
    return {field: done.thermo[f"c_all[{k}]"][-1] for k, field in enumerate(FIELDS, 1)}


def grid(nx: int, ny: int, words: str = "") -> str:
    return f"""
    compute cells grains cdem/grid {nx} {ny} {words}
    dump cells all local 1000000 cells.dump c_cells[*]
    dump_modify cells format float %.17g
    """


def cells(done: Run) -> dict[str, np.ndarray]:
    frame = done.dump("cells.dump")[-1]
    return dict(zip(["x", "y", *FIELDS], frame.columns.values(), strict=True))


# --- lattices -------------------------------------------------------------------------------------


def square(nx: int, ny: int, overlap_x: float, overlap_y: float) -> tuple[list[Disc], Box]:
    """Square lattice in a periodic box. Disc 1 has its centre in the corner of the box, others on its sides."""
    d = Disc(0, 0).diameter
    a, b = d - overlap_x, d - overlap_y
    return [Disc(i * a, j * b) for j in range(ny) for i in range(nx)], (0, nx * a, 0, ny * b)


def test_square_lattice(tmp_path: Path) -> None:
    """Four contacts a grain; sigma_xx = f_x a/(a b) with f_x = kn overlap_x, and in the same way sigma_yy. Half of the
    normals are along x, and of the normal forces the part f_x/(f_x + f_y). Overlaps are known to 1e-12 of them."""
    ux, uy = 1e-5, 3e-5
    discs, box = square(6, 6, ux, uy)
    out = run(START + average() + "run 0\n", tmp_path, discs=discs, box=box, bx="p", by="p")
    seen = values(out)
    d = discs[0].diameter
    expected = dict.fromkeys(FIELDS, 0.0) | {
        "solid": math.pi * d**2 / 4 / ((d - ux) * (d - uy)),
        "grains": len(discs),
        "mass": discs[0].mass,
        "coordination": 4,
        "stress_xx": KN * ux / (d - uy),
        "stress_yy": KN * uy / (d - ux),
        "fabric_xx": 0.5,
        "fabric_yy": 0.5,
        "normal_xx": ux / (ux + uy),
        "normal_yy": uy / (ux + uy),
    }
    assert seen == pytest.approx(expected, rel=1e-10, abs=1e-10)


def test_hexagonal_lattice_by_cells(tmp_path: Path) -> None:
    """Six contacts a grain; sigma = 3 f b/(2 A) in all directions, A the area of a grain's cell. Cells that are as large
    as the lattice's all have the same, though their borders cut grains and contacts; half as high ones have it in the
    mean."""
    overlap, nx, ny = 1e-5, 6, 6
    discs, box = lattice(nx, ny, overlap)
    deck = START + average() + grid(nx, ny // 2) + "run 0\n"
    out = run(deck, tmp_path, discs=discs, box=box, bx="p", by="p")
    d = discs[0].diameter
    b = d - overlap
    area = b**2 * math.sqrt(3) / 2
    expected = dict.fromkeys(FIELDS, 0.0) | {
        "solid": math.pi * d**2 / 4 / area,
        "grains": len(discs),
        "mass": discs[0].mass,
        "coordination": 6,
        "stress_xx": 1.5 * KN * overlap * b / area,
        "stress_yy": 1.5 * KN * overlap * b / area,
    }
    expected |= dict.fromkeys(["fabric_xx", "fabric_yy", "normal_xx", "normal_yy"], 0.5)
    assert values(out) == pytest.approx(expected, rel=1e-10, abs=1e-10 * KN * overlap)
    seen = cells(out)
    assert np.transpose([seen["x"], seen["y"]]) == pytest.approx(
        np.array([((i + 0.5) * b, (j + 0.5) * b * math.sqrt(3)) for j in range(ny // 2) for i in range(nx)]), rel=1e-12
    )
    expected["grains"] = 2
    for field in FIELDS:
        assert seen[field] == pytest.approx(np.full(18, expected[field]), rel=1e-10, abs=1e-10 * KN * overlap), field


# --- grains of one or three discs in motion -------------------------------------------------------


def walled(shape: str) -> list[Disc]:
    """The crowd of crowd.py with walls on all sides."""
    border = (0, SIDE - 1)
    return [
        replace(d, type=2, vx=0, vy=0, omega=0) if k // SIDE in border or k % SIDE in border else d
        for k, d in enumerate(crowd(shape))
    ]


def run_walled(deck: str, directory: Path, shape: str, boundary: str = "f", **options: Any) -> Run:
    box = (-SPACING, PERIOD + SPACING) * 2 if boundary == "f" else (0, PERIOD) * 2
    discs = walled(shape) if boundary == "f" else crowd(shape)
    return run(
        CROWD_START + deck, directory, discs=discs, box=box, bx=boundary, by=boundary, shape=shape,
        kn=1e6, ks=2.5e5, phi=27, **options,
    )  # fmt: skip


CASES: list[dict[str, Any]] = [
    {"shape": "single", "law": "direct", "ranks": 1, "style": "verlet"},
    {"shape": "triple", "law": "incremental", "ranks": 2, "style": "verlet/cdem"},
]


def contact_table(done: Run) -> dict[str, np.ndarray]:
    names = "id1 id2 x y fx fy".split()
    return dict(zip(names, done.dump("contacts.dump")[-1].columns.values(), strict=True))


DUMPS = """
compute contacts all cdem/contacts id1 id2 x y fx fy
dump contacts all local 60 contacts.dump c_contacts[*]
dump_modify contacts format float %.17g
"""


@pytest.mark.parametrize("case", CASES, ids=lambda case: "-".join(map(str, case.values())))
def test_stress_is_that_of_the_forces_on_the_walls(tmp_path: Path, case: dict[str, Any]) -> None:
    """Love and Weber: area x stress = sum over the contacts with walls of x f, f the force on the wall, + sum over the
    grains of x F, F the sum of the forces on a grain: 0 in statics, and here, where all moves, m a. In every step, to
    round-off."""
    deck = average() + DUMPS + "run 60\ninclude ${decks}/end.in\n"
    done = run_walled(deck, tmp_path, **case)
    c, end = contact_table(done), done.end
    wall = end["type"] == 2
    is_wall = [wall[c[end_of].astype(int) - 1] for end_of in ("id1", "id2")]
    sign = np.where(is_wall[0], 1.0, np.where(is_wall[1], -1.0, 0.0))  # of the force on the wall
    assert np.count_nonzero(sign) > SIDE
    x = [np.concatenate([sign * c[k], end[k][~wall]]) for k in "xy"]
    f = [np.concatenate([c[k], end[k][~wall]]) for k in ("fx", "fy")]
    area = (PERIOD + 2 * SPACING) ** 2
    seen = values(done)
    scale = np.abs(x[0] * f[0]).sum() / area
    for field, i, j in [("stress_xx", 0, 0), ("stress_yy", 1, 1), ("stress_xy", 0, 1), ("stress_yx", 1, 0)]:
        assert seen[field] == pytest.approx(x[i] @ f[j] / area, abs=1e-13 * scale), field
    assert abs(seen["stress_xy"] - seen["stress_yx"]) > 1e-6 * seen["stress_xx"]  # the spins change


@pytest.mark.parametrize("tilt", [0, 0.01, -0.015])
def test_images_are_where_the_box_has_them(tmp_path: Path, tilt: float) -> None:
    """Of one grain in a periodic box, 4 cm wide and high, that may be tilted: a rectangle around an image has the grain,
    one around any other place has nothing."""
    grain, side = Disc(0.013, 0.017), 0.04
    images = [(grain.x + i * side + j * tilt, grain.y + j * side) for i, j in [(1, 0), (-1, 1), (2, -1), (7, -5)]]
    places = [*images, (grain.x + tilt + side / 2, grain.y + side)]
    there = np.array([1, 1, 1, 1, 0])
    deck = START.replace("fix move", f"change_box all triclinic\nchange_box all xy final {tilt} units box\nfix move")
    for k, (x, y) in enumerate(places):
        within = f"{x - 0.003} {x + 0.003} {y - 0.003} {y + 0.003}"
        deck += f"compute c{k} all cdem/average within {within} grains solid\n"
    deck += "thermo_style custom step " + " ".join(f"c_c{k}[*]" for k in range(len(places))) + "\nrun 0\n"
    thermo = run(deck, tmp_path, discs=[grain], bx="p", by="p").thermo
    grains, solid = ([thermo[f"c_c{k}[{field}]"][-1] for k in range(len(places))] for field in (1, 2))
    assert grains == pytest.approx(there, abs=1e-7)
    assert solid == pytest.approx(there * math.pi * grain.radius**2 / 0.006**2, abs=1e-7)


def test_images_move_as_the_box_is_deformed(tmp_path: Path) -> None:
    """Grains on a lattice in affine motion, in a box that fix deform shears with `remap v`: the gradient is that of the box
    though a row of them lies across a side."""
    rate, side, n = 10.0, 0.04, 4
    places = [(i + 0.5, j) for i in range(n) for j in range(n)]  # the lowest row lies on the side
    discs = [Disc(x * side / n, y * side / n, 4e-3, rate * y * side / n) for x, y in places]
    deck = START.replace("fix move", "change_box all triclinic\nfix move") + average()
    deck += f"fix shear all deform 1 xy erate {rate} remap v\nrun 1\n"
    seen = values(run(deck, tmp_path, discs=discs, box=(0, side, 0, side), bx="p", by="p"))
    assert seen["gradient_xy"] == pytest.approx(rate, rel=1e-9)


@pytest.mark.parametrize("case", CASES, ids=lambda case: "-".join(map(str, case.values())))
def test_stress_is_that_of_compute_pressure(tmp_path: Path, case: dict[str, Any]) -> None:
    """In a periodic box without walls, contacts and motion. Compute pressure has the symmetric part of the latter about
    rest, so that of the mean velocity comes on top."""
    deck = (
        "group grains type 2\nunfix move\nfix move all cdem/integrate dt auto 2e-6\n"
        + average()
        + """
    compute virial all pressure NULL virial
    compute motion all pressure thermo_temp ke
    thermo_style custom step c_all[*] c_virial[1] c_virial[2] c_virial[4] c_motion[1] c_motion[2] c_motion[4]
    thermo_modify format float %.17g
    run 60
    """
    )
    done = run_walled(deck, tmp_path, boundary="p", **case)
    seen = values(done)
    virial, motion = ([done.thermo[f"c_{c}[{k}]"][-1] for k in (1, 2, 4)] for c in ("virial", "motion"))
    u, v, density = seen["velocity_x"], seen["velocity_y"], seen["grains"] * seen["mass"] / PERIOD**2
    stress, kinetic = ([seen[f"{what}_{k}"] for k in ("xx", "yy", "xy")] for what in ("stress", "kinetic"))
    assert seen["grains"] == pytest.approx(SIDE**2, rel=1e-12)
    assert stress == pytest.approx(virial, abs=1e-11 * virial[0])
    mean = density * np.array([u * u, v * v, u * v])
    assert np.array(kinetic) + mean == pytest.approx(np.array(motion), abs=1e-12 * motion[0])


@pytest.mark.parametrize("shape", SWELLING)
def test_cells_add_up_to_the_average(tmp_path: Path, shape: str) -> None:
    """Cells smaller than grains, and halves of a box that is periodic: no grain or contact is lost or counted twice."""
    halves = [
        f"within 0 {PERIOD / 2} EDGE EDGE",
        f"within {PERIOD / 2} {PERIOD} EDGE EDGE",
        "within v_mid v_end EDGE EDGE",
    ]
    names = ["left", "right", "same"]
    computes = "".join(f"compute {n} grains cdem/average {w}\n" for n, w in zip(names, halves, strict=True))
    shown = " ".join(f"c_{n}[*]" for n in ["all", *names])
    deck = f"variable mid equal {PERIOD / 2}+0*step\nvariable end equal {PERIOD}\n" + average() + computes
    deck += f"thermo_style custom step {shown}\nthermo_modify format float %.17g\n"
    deck += grid(13, 9) + "run 60\n"
    done = run_walled(deck.replace("1000000", "60"), tmp_path, shape, boundary="p")
    whole = values(done)
    parts = {n: np.array([done.thermo[f"c_{n}[{k}]"][-1] for k in range(1, len(FIELDS) + 1)]) for n in names}
    assert (parts["same"] == parts["right"]).all()
    assert whole["grains"] == pytest.approx(SIDE * (SIDE - 1), rel=1e-12)
    by_cell = cells(done)
    for field in ["solid", "grains", "stress_xx", "stress_yy", "stress_xy", "stress_yx"]:
        k = FIELDS.index(field)
        scale = 1e-12 * np.abs(by_cell[field]).max()
        for part in (np.array([parts["left"][k], parts["right"][k]]), by_cell[field]):
            count = 1 if field == "grains" else len(part)
            assert float(np.sum(part)) / count == pytest.approx(whole[field], abs=scale), field
    for field, weight in [
        ("mass", "grains"),
        ("coordination", "grains"),
        ("spin", "grains"),
        ("velocity_x", "momentum"),
    ]:
        by_cell["momentum"] = by_cell["grains"] * by_cell["mass"]
        mean = np.average(by_cell[field], weights=by_cell[weight])
        assert mean == pytest.approx(whole[field], rel=1e-11), field


@pytest.mark.parametrize(("shape", "boundary"), [("single", "f"), ("triple", "p")])
def test_same_bits_on_any_number_of_ranks(tmp_path: Path, shape: str, boundary: str) -> None:
    written = set()
    for ranks, style in ((1, "verlet"), (2, "verlet/cdem"), (4, "verlet/cdem")):
        deck = average() + grid(5, 7, "within 0 0.04 0.001 0.03").replace("1000000", "60") + "run 60\n"
        done = run_walled(deck, tmp_path / str(ranks), shape, boundary, ranks=ranks, style=style)
        mean = [v.hex() for v in values(done).values()]
        written.add((*mean, (done.directory / "cells.dump").read_text()))
    assert len(written) == 1


@pytest.mark.parametrize("shape", SWELLING)
def test_affine_motion(tmp_path: Path, shape: str) -> None:
    """Velocities v = L x + c and a spin: the gradient is L in every cell with three grains or more, the kinetic stress
    that of the spread of v about its mean by mass."""
    l, spin = np.array([[3.0, -5.0], [2.0, 4.0]]), 7.0
    x = np.random.default_rng(1).uniform(1e-3, 0.039, (100, 2))
    v = x @ l.T + [0.1, -0.2]
    rows = enumerate(np.hstack([x, v]))
    discs = [Disc(x, y, 1e-4 * (1 + k % 3), vx, vy, spin) for k, (x, y, vx, vy) in rows]
    deck = (
        "fix shape all cdem/shape type 1 ${shape} type 2 single density ${density}\n"
        + average()
        + grid(2, 2)
        + "run 0\n"
    )
    done = run(START + deck, tmp_path, discs=discs, box=(0, 0.04, 0, 0.04), shape=shape)
    seen, by_cell = values(done), cells(done)
    gradient = dict(zip(["gradient_xx", "gradient_xy", "gradient_yx", "gradient_yy"], l.ravel(), strict=True))
    for field, value in (gradient | {"spin": spin}).items():
        assert seen[field] == pytest.approx(value, rel=1e-11)
        assert by_cell[field] == pytest.approx(value, rel=1e-11)
    mass = np.array([d.diameter**2 for d in discs])
    mean = np.average(v, axis=0, weights=mass)
    spread = np.cov(v.T, aweights=mass, ddof=0)
    assert [seen["velocity_x"], seen["velocity_y"]] == pytest.approx(list(mean), rel=1e-11)
    per_mass = np.array([seen[f"kinetic_{k}"] for k in ("xx", "yy", "xy")]) * 0.04**2 / (seen["mass"] * 100)
    assert per_mass == pytest.approx(spread[[0, 1, 0], [0, 1, 1]], rel=1e-11)
    assert seen["coordination"] == 0


def test_fabric_and_forces_of_one_contact(tmp_path: Path) -> None:
    """A contact at angle a with forces fn, ft: fabric n n, normal n n, tangential ft/fn (t n + n t)/2; and a cell without
    a grain is all 0."""
    d, overlap, angle = 4e-3, 1e-5, math.radians(30)
    n = np.array([math.cos(angle), math.sin(angle)])
    t = np.array([-n[1], n[0]])
    x, y = n * (d - overlap)
    discs = [Disc(x, y, d, omega=400), Disc(0, 0, d, omega=400)]
    deck = (
        average("within -0.004 0.008 -0.004 0.008")
        + grid(1, 2, "within 0.01 0.012 0 0.01")
        + """
    compute c all cdem/contacts fn ft
    dump c all local 3 c.dump c_c[*]
    dump_modify c format float %.17g
    run 3
    """
    )
    done = run(START + deck.replace("1000000", "3"), tmp_path, discs=discs)
    fn, ft = (column[0] for column in done.dump("c.dump")[-1].columns.values())
    assert abs(ft) > 0.05 * fn > 0
    seen = values(done)
    for name, tensor in [
        ("fabric", np.outer(n, n)),
        ("normal", np.outer(n, n)),
        ("tangential", ft / fn * (np.outer(t, n) + np.outer(n, t)) / 2),
    ]:
        expected = [tensor[0, 0], tensor[1, 1], tensor[0, 1]]
        # The pair turns by less than 1e-4 rad in the run.
        assert [seen[f"{name}_{k}"] for k in ("xx", "yy", "xy")] == pytest.approx(expected, abs=1e-4)
    assert seen["coordination"] == 1
    empty = cells(done)
    assert all((empty[field] == 0).all() for field in FIELDS)


# --- what is refused ------------------------------------------------------------------------------

REFUSED: dict[str, tuple[str, Sequence[str]]] = {
    "field": ("cdem/average solid void", ["Compute cdem/average c: unknown field void; allowed: solid grains"]),
    "place": ("cdem/average x", ["Compute cdem/average c: unknown field x"]),
    "cells": ("cdem/grid 3", ["Compute cdem/grid c: NY has no value"]),
    "no-cells": ("cdem/grid 3 0", ["Compute cdem/grid c: NY 0: must be 1 or more"]),
    "many-cells": ("cdem/grid 1000 101", ["Compute cdem/grid c: 1000 x 101 cells, at most 100000"]),
    "side": (
        "cdem/grid 3 3 within 0 right 0 1",
        ["Compute cdem/grid c: within right: must be a number, EDGE or v_NAME"],
    ),
    "sides": ("cdem/average within 0 1 0", ["Compute cdem/average c: a side of within is missing"]),
    "variable": ("cdem/average within 0 v_none 0 1", ["within v_none: there is no equal-style variable none"]),
    "order": ("cdem/average within 0 -1 0 1", ["within 0 and -1 in x: the first must be below the second"]),
    "period": ("cdem/average within -1 1 0 1", ["within -1 and 1 in x: longer than the period of the box, 0.04"]),
}


@pytest.mark.parametrize(("words", "messages"), REFUSED.values(), ids=REFUSED)
def test_refused(tmp_path: Path, words: str, messages: Sequence[str]) -> None:
    write_data(tmp_path / "discs.data", [Disc(0, 0)], (-0.02, 0.02, -0.02, 0.02))
    show = (
        "thermo_style custom step c_c[1]\n" if "average" in words else "fix f all ave/time 1 1 1 c_c[1] mode vector\n"
    )
    deck = "".join([START, "compute c grains ", words, "\n", show, "run 0\n"])
    status, output = start(deck, tmp_path, bx="p", by="p")
    assert status != 0
    assert [m for m in messages if m not in output] == []
