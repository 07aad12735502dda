# SPDX-License-Identifier: GPL-2.0-or-later
"""Ordinary commands and fixes of LAMMPS that would make results wrong in silence: they are refused, warned of, or right."""

from __future__ import annotations

from pathlib import Path

import pytest
from engine import Disc, run, start
from scenes import cloud

HEAD = "include ${decks}/start.in\nfix move grains cdem/integrate dt any\ntimestep 2e-7\n"
PAIR = [Disc(-0.0019, 0), Disc(0.0019, 0), Disc(0, -0.01, type=2), Disc(0.004, -0.01, type=2)]
LID = "fix lid walls cdem/lid stress 1e5 width 0.01 thickness 0.01 vmax 1\n"

ERROR, WARNING = "ERROR", "WARNING"
STYLES = ("verlet", "verlet/cdem")


def told(deck: str, folder: Path, kind: str, discs: list[Disc] | None = None, ranks: int = 1) -> str:
    """Errors or warnings of a deck, which ends with an error only if these are asked for."""
    good = "include ${decks}/start.in\nfix move grains cdem/integrate dt any\nrun 0\n"
    run(good, folder, discs=discs or PAIR)
    status, output = start(deck, folder, ranks=ranks)
    assert (status != 0) == (kind == ERROR), output[-2000:]
    return "\n".join(line for line in output.splitlines() if line.startswith(kind))


KEPT = f"{HEAD}run 400\nwrite_restart kept.restart\n"
READ = """clear
newton off
processors ${px} ${py} 1
read_restart kept.restart
comm_modify vel yes
neighbor 0.001 bin
timestep 2e-7
"""
INTEGRATE = "fix move grains cdem/integrate dt any\n"


@pytest.mark.parametrize("compress", ["yes", "no"])
@pytest.mark.parametrize("order", ["delete, fix", "fix, delete"])
def test_atoms_deleted_before_fixes_have_their_state(tmp_path: Path, ranks: int, compress: str, order: str) -> None:
    """LAMMPS would give what the restart file has of an atom to another one. With a run before it all is right."""
    delete = f"group gone id 2 7\ndelete_atoms group gone compress {compress}\n"
    steps = {"delete": delete, "fix": INTEGRATE}
    commands = "".join(steps[name] for name in order.split(", "))
    error = told(KEPT + READ + commands + "run 10\n", tmp_path / "at once", ERROR, cloud(4, 2.0), ranks)
    assert (
        "from the restart file: atoms were deleted, or numbered anew, since read_restart: put 'run 0' before" in error
    )
    before = KEPT.replace("write_restart", f"{delete}run 0\nwrite_restart") + READ + INTEGRATE
    after = KEPT + READ + INTEGRATE + f"run 0\n{delete}"
    ends = [
        run(deck + "run 10\ninclude ${decks}/end.in\n", tmp_path / name, discs=cloud(4, 2.0), ranks=ranks).end
        for name, deck in (("before", before), ("after", after))
    ]
    for column in ("x", "vy", "omegaz", "fx"):
        assert (ends[0][column] == ends[1][column]).all()


def test_atoms_created_before_fixes_have_their_state(tmp_path: Path, ranks: int) -> None:
    create = "cdem/create 1 row 0.01 0.015 0.01 0.015 1 diameter 0.004 density 26.5\n"
    error = told(KEPT + READ + create + INTEGRATE + "run 1\n", tmp_path, ERROR, ranks=ranks)
    assert "cdem/create: after read_restart a run must come first ('run 0')" in error


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize(
    "limit", ["neigh_modify include grains", "comm_modify group grains"], ids=["neighbours", "ghosts"]
)
def test_walls_without_neighbours_are_refused(tmp_path: Path, limit: str, ranks: int) -> None:
    deck = HEAD.replace("/start.in\n", f"/start.in\natom_modify first grains\n{limit}\n")
    error = told(deck + "run 1\n", tmp_path, ERROR, ranks=ranks)
    assert (
        "neigh_modify include and comm_modify group must be all: atoms outside the group would touch nothing" in error
    )


@pytest.mark.parametrize(
    ("move", "warns"),
    [
        ("read_dump first.dump 0 x y vx vy\n", True),
        ("set atom 1 x -0.00185\n", True),
        ("displace_atoms grains move 0.001 0 0\n", False),
        ("displace_atoms walls move 0.001 0 0\n", False),
    ],
)
def test_grains_moved_relative_to_each_other_keep_their_springs(tmp_path: Path, move: str, warns: bool) -> None:
    """Which is said. Together they may go anywhere."""
    dump = "run 0\nwrite_dump all custom first.dump id type x y vx vy\nvelocity grains set 0 1 0\nrun 20\n"
    warnings = told(HEAD + dump + move + "run 1\n", tmp_path, WARNING)
    assert ("grains were moved relative to each other since the last step" in warnings) == warns


def test_half_a_period_is_one_move(tmp_path: Path) -> None:
    """Of grains that go one way around the box or the other."""
    discs = [Disc(-0.015 + 0.01 * k, 0.001 * k) for k in range(4)]
    deck = (
        HEAD.replace("include", "variable bx index p\ninclude") + "run 5\ndisplace_atoms grains move 0.02 0 0\nrun 1\n"
    )
    assert "relative to each other" not in told(deck, tmp_path, WARNING, discs)


@pytest.mark.parametrize("template", ["line 1 0", "discs 2 -1 0 1 1 0 1"], ids=["line", "clump"])
@pytest.mark.parametrize("omega", ["fix turn walls move rotate 0 -0.01 0 0 0 1 0.1", "set group walls omega 0 0 5"])
def test_walls_of_several_discs_do_not_turn(tmp_path: Path, template: str, omega: str) -> None:
    """They would stand as before while they go round. Those of single discs turn."""
    shape = f"fix shape all cdem/shape type 1 single type 2 {template} density 26.5\n"
    smooth = "pair_coeff * 2 1e8 0 .215 .215 0\n" if template.startswith("line") else ""
    error = told(HEAD + smooth + shape + omega + "\nrun 3\n", tmp_path, ERROR)
    assert "of type 2 is a wall of several discs, or a piece of a smooth wall, and has a spin of" in error
    run(HEAD + omega + "\nrun 3\n", tmp_path / "discs", discs=PAIR)


def test_radii_of_a_hybrid_style_cannot_change_either(tmp_path: Path) -> None:
    start_in = (
        (Path(__file__).parent / "start.in")
        .read_text()
        .replace("atom_style    sphere", "atom_style hybrid sphere 1 charge")
    )
    start_in = start_in.replace(
        "read_data     discs.data",
        "region box block -0.02 0.02 -0.02 0.02 -0.5 0.5\ncreate_box 2 box\ncreate_atoms 1 single 0 0 0",
    )
    error = told(start_in + INTEGRATE + "run 0\n", tmp_path, ERROR)
    assert "atom_style sphere 1 must be sphere or sphere 0: radii cannot change in a run" in error


@pytest.mark.parametrize("diameter", [1e-3, 1e-7])
def test_a_lid_of_small_discs_has_their_mass(tmp_path: Path, ranks: int, diameter: float) -> None:
    """Free, it falls by F/M: the digits of a mass of 1e-18 kg are as many as those of a gram."""
    disc = Disc(0, 0.5 * diameter, diameter, type=2)
    below = Disc(0, -9 * diameter, diameter)
    thickness, steps, dt = diameter, 1000, 1e-12
    force = 1.0 * diameter * thickness
    deck = f"""include ${{decks}}/start.in
fix move grains cdem/integrate dt any
fix lid walls cdem/lid stress 1 width {diameter:.17g} thickness {thickness:.17g} vmax 1
timestep {dt}
run {steps}
include ${{decks}}/end.in
"""
    half = 10 * diameter
    box = (-half, half, -half, half)
    mass = 2650 * thickness * disc.mass / 26.5
    end = run(deck, tmp_path, discs=[below, disc], box=box, ranks=ranks, density=2650 * thickness, skin=diameter).end
    assert end["vy"][1] == pytest.approx(-force / mass * steps * dt, rel=1e-12)


def test_a_lid_of_small_discs_feels_small_forces(tmp_path: Path, ranks: int) -> None:
    """At rest on a disc of 0.1 um, under 1e-14 N: what it feels is the force of the contact."""
    d = 1e-7
    stress = 1 / d**2 * 1e-14
    kn = 1.0
    deck = f"""include ${{decks}}/start.in
fix move grains cdem/integrate dt any
fix lid top cdem/lid stress {stress:.17g} width {d:.17g} thickness {d:.17g} vmax 1
variable fy atom fy
compute felt top reduce sum v_fy
timestep 1e-13
thermo_style custom step f_lid[2] c_felt
thermo 1
thermo_modify format float %.17g
run 1
"""
    discs = [Disc(0, -d, d, type=2), Disc(0, 0, d), Disc(0, d - 3e-14, d, type=3)]
    half = 10 * d
    table = run(deck.replace("fix move", "group top type 3\nfix move"), tmp_path, discs=discs, box=(-half, half, -half, half),
                ranks=ranks, density=2650 * d, skin=d, kn=kn, ks=kn / 4).thermo  # fmt: skip
    assert table["c_felt"][0] > 1e-15
    assert table["f_lid[2]"] * d * d == pytest.approx(table["c_felt"], rel=1e-9)


@pytest.mark.parametrize("other", ["move linear 0 0 0", "nve/noforce"])
def test_a_lid_that_another_fix_moves_is_refused(tmp_path: Path, other: str) -> None:
    error = told(f"{HEAD}{LID}fix other walls {other}\nrun 1\n", tmp_path, ERROR)
    assert f"Fix cdem/lid lid: 2 atoms of group walls are also moved by fix {other.split()[0]} other" in error


@pytest.mark.parametrize("other", ["setforce 0 0 0", "freeze"])
def test_a_lid_whose_forces_another_fix_sets_is_warned_of(tmp_path: Path, other: str) -> None:
    warnings = told(f"{HEAD}{LID}fix other walls {other}\nrun 1\n", tmp_path, WARNING)
    assert f"fix other of style {other.split()[0]} sets forces on 2 of its atoms" in warnings


@pytest.mark.parametrize("rest", ["", " pre no"], ids=["set up", "goes on"])
def test_both_run_styles_see_an_atom_that_was_moved(tmp_path: Path, ranks: int, rest: str) -> None:
    """Also before a run without a setup: into a contact that no list knew."""
    discs = [Disc(-0.006, 0.0005), Disc(0.0015, 0), Disc(0.012, 0)]
    deck = f"{HEAD}run 5\nset atom 1 x -0.0023\nrun 40{rest}\ninclude ${{decks}}/end.in\n"
    ends = [run(deck, tmp_path / s, discs=discs, ranks=ranks, style=s).end for s in STYLES]
    assert abs(ends[0]["vx"][1]) > 0.1
    for column in ("x", "y", "vx", "vy", "omegaz", "fx"):
        assert (ends[0][column] == ends[1][column]).all()


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize(
    "change",
    [
        "group grains clear\ngroup grains id 1",
        "set atom 1 type 2",
        "set atom 1 mass 0.001",
        "delete_atoms group walls",
        "create_atoms 2 random 4000 1 NULL",
    ],
)
@pytest.mark.parametrize("steps", [0, 5])
def test_other_grains_need_a_setup(tmp_path: Path, style: str, change: str, steps: int) -> None:
    """What follows from group, type and mass is prepared with it."""
    deck = f"{HEAD}run_style {style}\nrun {steps}\n{change}\nrun 5"
    assert "the next one must not be 'pre no'" in told(f"{deck} pre no\n", tmp_path / "no", ERROR)
    if "create" not in change:  # these lie upon each other
        told(f"{deck}\n", tmp_path / "yes", WARNING)


@pytest.mark.parametrize("style", STYLES)
def test_the_same_grains_need_none(tmp_path: Path, ranks: int, style: str) -> None:
    discs = cloud(4, 2.0)
    ends = [
        run(f"{HEAD}{runs}\ninclude ${{decks}}/end.in\n", tmp_path / str(k), discs=discs, ranks=ranks, style=style).end
        for k, runs in enumerate(("run 500", "run 250\nrun 250 pre no"))
    ]
    for column in ("x", "y", "vx", "vy", "omegaz", "fx"):
        assert (ends[0][column] == ends[1][column]).all()
