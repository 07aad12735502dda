# SPDX-License-Identifier: GPL-2.0-or-later
"""Computes and fixes of LAMMPS beside ours: the right ones against closed forms, the wrong ones with a warning."""

from __future__ import annotations

import functools
import math
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from crowd import CROWD_START, PERIOD, crowd
from engine import PROGRAM, Disc, Run, run, same_bits, start, write_data

D, OVERLAP, KN = 4e-3, 1e-5, 1e8
BOX = (-0.02, 0.02, -0.02, 0.02)
AREA = 0.04**2
# Dumbbells: two discs of diameter D side by side, so their radius is D.
SHAPES = {"disc": "single", "dumbbell": "discs 2 -1 0 1 1 0 1"}


def begin(shape: str) -> str:
    """Each of the two grains is in a group of its own."""
    return f"""
    include ${{decks}}/start.in
    fix shape all cdem/shape type 1 {SHAPES[shape]} type 2 single density ${{density}}
    fix move grains cdem/integrate dt any
    timestep 1e-7
    group a id 1
    group b id 2
    """


ANGLE = math.radians(30)


def pressed(shape: str, omega: float = 0) -> list[Disc]:
    """Two grains with one contact: the right disc of grain 1 touches the left one of grain 2, whose centre lies at 30
    degrees from it."""
    x, y = (D - OVERLAP) * math.cos(ANGLE), (D - OVERLAP) * math.sin(ANGLE)
    if shape == "disc":
        return [Disc(0, 0, D, omega=omega), Disc(x, y, D, omega=omega)]
    return [Disc(0, 0, 2 * D, omega=omega), Disc(x + D, y, 2 * D, omega=omega)]


def warned(log: str) -> list[str]:
    """The computes and fixes of which warnings say that they are wrong, in alphabetical order."""
    return sorted(re.findall(r"WARNING: Pair style cdem: (\w+ [\w/]+) sees", log))


def table(done: Run, name: str) -> list[list[float]]:
    """The rows of the last frame of a dump."""
    return np.transpose(list(done.dump(name)[-1].columns.values())).tolist()


@pytest.mark.parametrize("shape", SHAPES)
def test_computes_of_lammps_that_are_right(tmp_path: Path, shape: str) -> None:
    """Energy kn u^2/2, half to each grain; virial f l, with f = kn u along the normal and l from centre to centre; a
    contact on either grain."""
    discs = pressed(shape)
    deck = (
        begin(shape)
        + """
    compute pe all pe
    compute pair all pair cdem
    compute half all pe/atom
    compute virial all pressure NULL virial
    compute share all stress/atom NULL virial
    thermo_style custom step c_pe c_pair c_virial[1] c_virial[2] c_virial[4]
    thermo_modify format float %.17g
    dump d all custom 1 atoms.dump id c_half c_share[1] c_share[2] c_share[4]
    dump_modify d sort id format float %.17g
    run 0
    """
    )
    done = run(deck, tmp_path, discs=discs, box=BOX)
    energy, force = KN * OVERLAP**2 / 2, KN * OVERLAP
    f = [force * math.cos(ANGLE), force * math.sin(ANGLE)]
    l = [discs[1].x - discs[0].x, discs[1].y - discs[0].y]
    virial = [f[0] * l[0], f[1] * l[1], l[0] * f[1]]
    seen = {name: column[-1] for name, column in done.thermo.items()}
    assert [seen["c_pe"], seen["c_pair"]] == pytest.approx([energy] * 2, rel=1e-9)
    assert [seen[f"c_virial[{k}]"] * AREA for k in (1, 2, 4)] == pytest.approx(virial, rel=1e-9)
    half = [energy / 2, *(-v / 2 for v in virial)]
    assert table(done, "atoms.dump") == [pytest.approx([i, *half], rel=1e-9) for i in (1, 2)]
    assert warned(done.log) == []


NEEDED = """
compute chunks all chunk/atom type
compute ke all ke/atom
compute pe all pe/atom
compute stress all stress/atom NULL virial
"""
ALWAYS = [
    "compute angmom/chunk chunks",
    "compute cluster/atom 0.003",
    "compute coord/atom cutoff 0.003",
    "compute erotate/sphere",
    "compute erotate/sphere/atom",
    "compute fabric radius contact",
    "compute group/group b",
    "compute heat/flux ke pe stress",
    "compute inertia/chunk chunks",
    "compute omega/chunk chunks",
    "compute pair/local fx fy",
    "compute property/local natom1 natom2",
    "compute temp/sphere",
    "compute torque/chunk chunks",
    "fix pair/tracker 1 id1 id2",
]
OF_WALLS = ["compute contact/atom"]  # and of clumps
OF_CLUMPS = ["fix wall/gran hooke/history 1e6 NULL 0 NULL 0 0 xplane -0.02 0.02"]


@functools.cache
def styles() -> set[str]:
    """Of this LAMMPS: newer ones have no fix pair/tracker."""
    done = subprocess.run([PROGRAM, "-help"], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.mark.parametrize(
    ("shape", "wall", "wrong"),
    [
        ("disc", False, ALWAYS),
        ("disc", True, ALWAYS + OF_WALLS),
        ("dumbbell", False, ALWAYS + OF_WALLS + OF_CLUMPS),
    ],
)
def test_what_is_wrong_is_said_once_a_run(tmp_path: Path, shape: str, wall: bool, wrong: list[str]) -> None:
    """Two computes of a style are warned of once; in each run; and not when LAMMPS sets up to write a file."""
    discs = pressed(shape) + [Disc(-0.01, -0.01, D, type=2)] * wall
    deck = begin(shape) + NEEDED
    there = [command for command in [*ALWAYS, *OF_WALLS, *OF_CLUMPS] if command.split()[1] in styles()]
    for k, command in enumerate([*there, "compute erotate/sphere"]):
        kind, style, *words = command.split()
        deck += " ".join([kind, f"id{k}", "a" if style == "group/group" else "all", style, *words]) + "\n"
    deck += "run 1\nwrite_restart there.restart\nrun 1\n"
    done = run(deck, tmp_path, discs=discs, box=BOX, ranks=2 if wall else 1)
    expected = [" ".join(command.split()[:2]) for command in wrong if command in there]
    assert warned(done.log) == sorted(2 * expected)


def test_what_is_said_to_be_wrong_is_wrong_and_ours_is_right(tmp_path: Path) -> None:
    """Two discs that shear as they spin: rotation I omega^2 with I = m r^2/2, of which LAMMPS has 0.8; force of the
    contact with its friction, without which LAMMPS has it; fabric n n."""
    omega = 400.0
    deck = (
        begin("disc")
        + """
    compute sphere all erotate/sphere
    compute energy all cdem/energy
    compute groups a group/group b
    compute fabric all fabric radius contact
    compute ours all cdem/average fabric_xx fabric_yy fabric_xy
    compute c all cdem/contacts fx fy fn nx ny
    thermo_style custom step c_sphere c_energy[2] c_groups[1] c_groups[2] c_fabric[1] c_fabric[2] c_fabric[4] c_ours[*]
    thermo_modify format float %.17g
    thermo 3
    dump c all local 3 c.dump c_c[*]
    dump_modify c format float %.17g
    dump d all custom 3 d.dump id fx fy
    dump_modify d sort id format float %.17g
    run 3
    """
    )
    done = run(deck, tmp_path, discs=pressed("disc", omega), box=BOX)
    first = {name: column[0] for name, column in done.thermo.items()}
    rotation = 2 * Disc(0, 0, D).inertia * omega**2 / 2
    assert first["c_energy[2]"] == pytest.approx(rotation, rel=1e-12)
    assert first["c_sphere"] == pytest.approx(0.8 * rotation, rel=1e-12)
    last = {name: column[-1] for name, column in done.thermo.items()}
    [[fx, fy, fn, nx, ny]] = table(done, "c.dump")
    assert [fx, fy] == pytest.approx(table(done, "d.dump")[0][1:], rel=1e-12)
    assert [last["c_groups[1]"], last["c_groups[2]"]] == pytest.approx([fn * nx, fn * ny], rel=1e-12)
    assert math.hypot(fx - fn * nx, fy - fn * ny) > 0.05 * fn
    ours = [last[f"c_ours[{k}]"] for k in (1, 2, 3)]
    assert ours == pytest.approx([nx * nx, ny * ny, nx * ny], rel=1e-12)
    # In two dimensions its 15/2 would be 4, and 1/3 would be 1/2.
    assert [last[f"c_fabric[{k}]"] for k in (1, 2, 4)] == pytest.approx(
        [7.5 * (nx * nx - 1 / 3), 7.5 * (ny * ny - 1 / 3), 7.5 * nx * ny], rel=1e-12
    )


def test_stress_by_centroid_is_refused_and_another_way_named(tmp_path: Path) -> None:
    write_data(tmp_path / "discs.data", pressed("disc"), BOX)
    deck = (
        begin("disc") + "compute c all centroid/stress/atom NULL virial\ndump d all custom 1 d.dump id c_c[*]\nrun 0\n"
    )
    status, output = start(deck, tmp_path)
    assert status != 0
    assert "take compute stress/atom or cdem/grid" in output


@pytest.mark.parametrize("suffix", ["opt", "omp"])
def test_suffixes_change_nothing(tmp_path: Path, suffix: str) -> None:
    """`suffix opt` is what -sf opt does. There are no such variants of our styles, so the same are taken."""
    deck = CROWD_START + "compute trm all cdem/trm\ncompute e all cdem/energy\nrun 30\ninclude ${decks}/end.in\n"
    ends = []
    for words in ("", f"suffix {suffix}\nsuffix on\n"):
        directory = tmp_path / (suffix if words else "none")
        ends.append(
            run(
                words + deck, directory, discs=crowd("triple"), box=(0, PERIOD, 0, PERIOD), bx="p", by="p",
                shape="triple", kn=1e6, ks=2.5e5, phi=5,
            ).end
        )  # fmt: skip
    assert same_bits(ends[0], ends[1])


@pytest.mark.parametrize("onlooker", ["", "compute contacts all cdem/contacts"])
def test_thermo_needs_no_onlooker(tmp_path: Path, onlooker: str) -> None:
    """Forces of single contacts are kept only if a compute may look at them. Energy and pressure of thermo output are
    those of the closed forms of above without it too."""
    deck = f"""
    {begin("disc")}
    {onlooker}
    thermo_style custom step pe press
    thermo_modify norm no format float %.17g
    run 0
    """
    end = run(deck, tmp_path, discs=pressed("disc"), box=BOX).thermo
    assert end["PotEng"] == pytest.approx(0.5 * KN * OVERLAP**2, rel=1e-9)
    assert end["Press"] == pytest.approx(0.5 * KN * OVERLAP * (D - OVERLAP) / AREA, rel=1e-9)
