# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls of several discs; mass, angle and virial of such grains."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from clumps import END, R, SQRT3, TRIPLE, UNEVEN, Clump, begin, dump
from engine import DENSITY, Disc, run
from scenes import both_laws


# --- walls ------------------------------------------------------------------------------------------


def test_a_wall_of_several_discs(tmp_path: Path, law: str) -> None:
    """Acts like the same discs as walls of their own: dashpots don't know how many there are, and nothing moves it."""
    ground = Clump(*[(2 * R * k, 0, R) for k in range(8)])
    grains = [TRIPLE.at(-7e-3, 7e-3, 0.3, -1, 200), TRIPLE.at(3e-3, 6e-3, -0.5, -1, -100)]
    deck = begin(TRIPLE) + "fix weight grains gravity 2000 vector 0 -1 0\ntimestep 2e-7\nrun 8000\n" + END
    whole = deck.replace("type 2 single", f"type 2 {ground.template}")
    parts = [Disc(x, y, 2 * r, type=2) for (x, y), r in zip(ground.offsets, ground.radii, strict=True)]
    a = run(whole, tmp_path / "whole", discs=[*grains, ground.at(0, 0, type=2)], law=law, phi=27).end
    b = run(deck, tmp_path / "parts", discs=[*grains, *parts], law=law, phi=27).end
    assert (np.abs(a["omegaz"][:2] - [200, -100]) > 10).all()
    for column in ("x", "y", "vx", "vy", "omegaz"):
        assert a[column][:2] == pytest.approx(b[column][:2], rel=1e-6)
    assert [a["x"][2], a["y"][2], a["vx"][2], a["vy"][2], a["omegaz"][2]] == [0, 0, 0, 0, 0]


@pytest.mark.parametrize("side", ["top", "bottom", "left", "right"])
def test_the_face_of_a_lid_of_clumps(tmp_path: Path, side: str) -> None:
    """It is where the innermost point of its discs is, not that of the circles around the clumps, which are turned."""
    deck = f"""
    include ${{decks}}/start.in
    fix shape all cdem/shape type 1 single type 2 triple density 26.5 orient 7
    fix move grains cdem/integrate
    fix lid walls cdem/lid stress 1e4 width 0.01 thickness 0.01 vmax 1 from {side}
    compute discs walls cdem/discs x y radius
    dump discs walls cdem/local 1 discs.dump c_discs[*]
    dump_modify discs format float %.17g
    thermo_style custom step f_lid[3]
    thermo_modify format float %.17g
    run 0
    """
    walls = [Disc(0, 0, 6e-3, type=2), Disc(6e-3, 1e-4, 6e-3, type=2)]
    out = run(deck, tmp_path, discs=[*walls, Disc(0, -0.01)])
    discs = out.dump("discs.dump")[-1]
    outward = {"top": discs["y"], "bottom": -discs["y"], "right": discs["x"], "left": -discs["x"]}[side]
    sign = 1 if side in ("top", "right") else -1
    assert out.thermo["f_lid[3]"][-1] == pytest.approx(sign * np.min(outward - discs["radius"]), abs=1e-12)


# --- mass, angle, pressure --------------------------------------------------------------------------


def test_density_and_sizes(tmp_path: Path, ranks: int) -> None:
    """`density` sets the mass of the group's grains, from the area of the union: here two discs of radius 1 that are 1
    apart, in all of 2 (pi - acos(1/2) + sqrt(3)/4), in a grain of radius 1.5. Others keep theirs."""
    scene = [Disc(6e-3 * (k - 2), 1e-3 * k, diameter, type=t) for k, (diameter, t) in enumerate(
        [(3e-3, 1), (4e-3, 1), (5e-3, 3), (2e-3, 2), (4e-3, 3)]
    )]  # fmt: skip
    deck = "include ${decks}/start.in\ngroup grains type 3\n"
    deck += "fix shape grains cdem/shape density 10 type 3 triple type 2 single type 1 discs 2 4 4 1 4 5 1\n"
    deck += "fix move grains cdem/integrate dt auto\nrun 0\n" + END
    end = run(deck, tmp_path, discs=scene, ranks=ranks).end
    pair = 2 * (math.pi - math.acos(0.5) + SQRT3 / 4) / 1.5**2
    triple = 3 * math.pi / (1 + 2 / SQRT3) ** 2
    shares = np.array([10 * pair, 10 * pair, 10 * triple, DENSITY * math.pi, 10 * triple])
    assert end["mass"] == pytest.approx(shares * [d.radius**2 for d in scene], rel=1e-14)
    assert end["radius"].tolist() == [d.radius for d in scene]


def test_density_of_grains_made_later(tmp_path: Path) -> None:
    deck = """
    units si
    dimension 2
    boundary f f p
    atom_style sphere
    newton off
    comm_modify vel yes
    region box block 0 0.1 0 0.1 -0.005 0.005
    create_box 1 box
    fix shape all cdem/shape type 1 triple density 30
    create_atoms 1 single 0.05 0.05 0
    set group all diameter 0.006
    pair_style cdem law direct
    pair_coeff * * 1e8 2.5e7 0.215 0.215 27
    fix move all cdem/integrate dt auto
    run 0
    """
    end = run(deck + END, tmp_path).end
    assert end["mass"] == pytest.approx([30 * 3 * math.pi * (0.003 / (1 + 2 / SQRT3)) ** 2], rel=1e-14)


def test_mass_of_created_grains(tmp_path: Path, ranks: int) -> None:
    """cdem/create takes diameters as the circumscribed ones, and the area from the template."""
    deck = """
    units si
    dimension 2
    boundary f f p
    processors ${px} ${py} 1
    atom_style sphere
    newton off
    region box block 0 0.1 0 0.2 -0.005 0.005
    create_box 2 box
    fix shape all cdem/shape type 1 triple type 2 single
    cdem/create 1 fill 60 region 0 0.1 0 0.2 diameter 0.004 0.008 power 0 density 26.5 seed 3
    cdem/create 2 row 0.002 0.19 0.098 0.19 10 diameter 0.004 density 26.5
    run 0
    """
    end = run(deck.replace("run 0\n", END), tmp_path, ranks=ranks).end
    shares = np.where(end["type"] == 1, 3 * math.pi / (1 + 2 / SQRT3) ** 2, math.pi)
    assert end["mass"] == pytest.approx(DENSITY * shares * end["radius"] ** 2, rel=1e-14)
    assert end["radius"][:60].min() == pytest.approx(0.002, rel=0.01)
    assert end["radius"][:60].max() == pytest.approx(0.004, rel=0.01)


def angles(directory: Path, seed: int, ranks: int, more: str = "") -> np.ndarray:
    scene = [TRIPLE.at(0.01 * (k % 20 + 0.5), 0.01 * (k // 20 + 0.5)) for k in range(400)]
    scene[7] = Disc(scene[7].x, scene[7].y, type=2)
    deck = begin(TRIPLE, step="dt auto", more=f"orient {seed}") + dump(1) + "run 0\n" + more
    frames = run(deck, directory, discs=scene, box=(0, 0.2, 0, 0.2), ranks=ranks).dump("grains.dump")
    return frames[-1]["f_move[4]"]


def test_orient(tmp_path: Path, ranks: int) -> None:
    """Angles spread evenly over a turn (Kolmogorov's test at 1 %), by seed and id alone; only once; not for walls."""
    turned = angles(tmp_path / "turned", 4, ranks, more="run 0\n")
    assert turned[7] == 0
    grains = np.delete(turned, 7)
    n = len(grains)
    share = np.sort(grains) / (2 * math.pi)
    assert share[0] >= 0 and share[-1] < 1
    assert np.abs(share - (np.arange(n) + 0.5) / n).max() < 1.63 / math.sqrt(n)
    assert abs(np.corrcoef(grains[:-1], grains[1:])[0, 1]) < 0.15  # ids that follow each other aren't alike
    if ranks > 1:
        assert turned.tolist() == angles(tmp_path / "alone", 4, 1).tolist()
    else:
        other = angles(tmp_path / "other", 5, 1)
        assert abs(np.corrcoef(np.delete(other, 7), grains)[0, 1]) < 0.15


@both_laws
@pytest.mark.parametrize(("x", "y"), [(-0.004, 0.001), (0.017, -0.0195)], ids=["between-ranks", "periodic"])
def test_virial(tmp_path: Path, law: str, ranks: int, x: float, y: float) -> None:
    """P = force x vector between the centres of mass / area, for the contact of two grains beside their centres; the
    force is kn overlap n."""
    kn, overlap = 1e7, 2e-5
    # The right disc of the upright triple against the big one of the other.
    direction = np.array([math.cos(0.3), math.sin(0.3)])
    branch = TRIPLE.offsets[1] + (2 * R - overlap) * direction - UNEVEN.offsets[0]
    wrap = lambda c: math.remainder(c, 0.04)
    scene = [TRIPLE.at(x, y), UNEVEN.at(wrap(x + branch[0]), wrap(y + branch[1]), type=3)]
    deck = (
        begin(TRIPLE, UNEVEN, step="dt auto")
        + """
    compute p all pressure NULL virial
    thermo_style custom step c_p[1] c_p[2] c_p[4] pe
    thermo_modify format float %.17g
    run 0
    """
    )
    seen = run(deck, tmp_path, discs=scene, law=law, ranks=ranks, kn=kn, bx="p", by="p").thermo
    force = kn * overlap * direction
    expected = [branch[0] * force[0], branch[1] * force[1], branch[0] * force[1]]
    assert [seen[f"c_p[{k}]"][0] * 0.04**2 for k in (1, 2, 4)] == pytest.approx(expected, rel=1e-9)
    assert seen["PotEng"][0] == pytest.approx(kn * overlap**2 / 2, rel=1e-9)
    assert abs(force[0] * branch[1] / (force[1] * branch[0]) - 1) > 0.1  # the force is not central
