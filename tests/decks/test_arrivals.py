# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains that come in a run, or between two: their contacts are found, their masses and angles are right."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from engine import Disc, run, start

BOX = """
units       lj
dimension   2
boundary    f f p
processors  ${px} ${py} 1
atom_style  sphere
atom_modify map array
newton      off
comm_modify vel yes cutoff 3
region      box block 0 10 0 10 -0.5 0.5
create_box  2 box
neighbor    0.2 bin
neigh_modify delay 0
"""
PERIODIC = BOX.replace("boundary    f f p", "boundary    p f p")
PAIR = "pair_style cdem law direct\npair_coeff * * 1e4 2.5e3 0 0 0\n"
END = """
dump        end all custom 1 end.dump id type x y vx vy mass radius f_move[4]
dump_modify end sort id format float %.17g
run         0
"""


DEPOSIT = f"""{BOX}
create_atoms 2 single 5 2 0
set         type 2 diameter 0.5
{PAIR}
run_style   ${{style}}
group       wall type 2
group       sand type 1
fix         hold wall cdem/move speed 0
fix         move sand cdem/integrate dt any
region      place block 5 5.000001 8 8.000001 ${{depth}}
fix         rain sand deposit 1 1 1 4711 region place vy -2 -2 units box
timestep    1e-3
run         4000
{END}
"""


@pytest.mark.parametrize("ranks", [1, 2, 4])
@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_what_fix_deposit_brings_touches(tmp_path: Path, style: str, ranks: int) -> None:
    """Into a box whose only disc is a small wall disc: the grain, larger than all before, bounces off it and keeps its
    speed, since nothing damps it."""
    end = run(DEPOSIT, tmp_path, ranks=ranks, style=style, depth="0 0").end
    [vy] = end["vy"][end["type"] == 1]
    # at some 28 steps a contact the spring gives the speed back to a thousandth
    assert vy == pytest.approx(2, rel=1e-2)


def test_what_is_brought_out_of_the_plane_is_refused(tmp_path: Path) -> None:
    """fix deposit takes any z of its region, in two dimensions too."""
    status, output = start(DEPOSIT, tmp_path, style="verlet/cdem", depth="-0.1 0.1")
    assert status != 0
    assert "atom 2 is at z = " in output


def test_a_grain_that_grew_in_a_run_is_refused(tmp_path: Path) -> None:
    deck = """include ${decks}/start.in
neigh_modify every 1 delay 0 check no
fix move grains cdem/integrate
timestep 1e-7
run 40 every 20 "print good"
"""
    run(deck, tmp_path, discs=[Disc(0, 0), Disc(0.01, 0)])
    grown = deck.replace("run 40 every", "run 40 pre no every").replace("print good", "set atom 1 diameter 0.006")
    status, output = start(grown, tmp_path)
    assert status != 0
    assert "types, radii or masses have changed since the last run: the next one must not be 'pre no'" in output


def test_collections_by_size_touch(tmp_path: Path) -> None:
    """neighbor multi with collections takes its cutoffs from the pair style: the same bits as without collections."""
    discs = [Disc(-0.006, 0, vx=1), Disc(0.006, 0, 0.01), Disc(0.006, 0.015, 0.01)]
    deck = """include ${decks}/start.in
neighbor 1e-3 multi
COLLECTIONS
fix move grains cdem/integrate
timestep 1e-7
run 60000
include ${decks}/end.in
"""
    interval = "neigh_modify collection/interval 2 0.005 0.011"
    without = run(deck.replace("COLLECTIONS", ""), tmp_path / "without", discs=discs, kn=1e6, ks=2.5e5).end
    collected = run(deck.replace("COLLECTIONS", interval), tmp_path / "with", discs=discs, kn=1e6, ks=2.5e5).end
    assert collected["vx"][0] < 0.5, "it went through"
    for column in ("x", "y", "vx", "vy"):
        assert np.array_equal(without[column], collected[column])


@pytest.mark.parametrize("ranks", [1, 2])
def test_clumps_of_fix_pour_have_their_mass_and_angle(tmp_path: Path, ranks: int) -> None:
    """From the first step on: the mass is that of three discs of diameter 1/(1 + 2/sqrt(3)), and the angle is random."""
    deck = f"""{BOX}
fix         form all cdem/shape type 1 triple type 2 single density 3 orient 5
create_atoms 2 single 5 1 0
set         type 2 diameter 0.5
{PAIR}
group       sand type 1
fix         move sand cdem/integrate dt any gravity 0 -1
fix         fall sand gravity 1e-9 vector 0 -1 0    # which fix pour wants
region      slab block 1 9 5 9 -0.5 0.5
fix         rain sand pour 12 1 4711 vol 0.5 10 diam one 1.0 region slab
timestep    1e-3
run         1
{END}
"""
    end = run(deck, tmp_path, ranks=ranks).end
    grains = end["type"] == 1
    assert np.sum(grains) > 3
    disc = 0.5 / (1 + 2 / math.sqrt(3))
    assert end["mass"][grains] == pytest.approx(np.full(np.sum(grains), 3 * 3 * math.pi * disc**2))
    angles = end["f_move[4]"][grains]
    assert len(set(angles)) == len(angles)
    assert np.ptp(angles) > 1


ANGLES = """include ${decks}/start.in
fix form all cdem/shape type 1 triple type 2 single orient 7
fix move grains cdem/integrate
timestep 1e-7
run 100
dump first all custom 100 first.dump id f_move[4] x y
dump_modify first sort id format float %.17g
run 0
undump first
CHANGE
dump second all custom 100 second.dump id f_move[4] x y
dump_modify second sort id format float %.17g
run 0
"""


@pytest.mark.parametrize(
    "change",
    [
        "unfix move\nfix move grains cdem/integrate drag 1",
        "fix move grains cdem/integrate drag 1",
        "unfix form\nfix form all cdem/shape type 1 triple type 2 single",
        "unfix form\nfix form all cdem/shape type 1 triple type 2 single orient 8",
    ],
)
def test_grains_keep_their_angles_when_fixes_are_defined_anew(tmp_path: Path, change: str) -> None:
    discs = [Disc(-0.005, 0, 6e-3, omega=30), Disc(0.005, 0, 6e-3, omega=-20)]
    done = run(ANGLES.replace("CHANGE", change), tmp_path, discs=discs)
    [first], [second] = done.dump("first.dump"), done.dump("second.dump")
    assert np.all(first["f_move[4]"] != 0)
    assert np.array_equal(first["f_move[4]"], second["f_move[4]"])


def test_clumps_that_are_made_between_runs_are_turned_too(tmp_path: Path) -> None:
    discs = [Disc(-0.005, 0, 6e-3)]
    change = "create_atoms 1 single 0.005 0 0\nset atom 2 diameter 0.006\nset atom 2 density/disc 26.5"
    done = run(ANGLES.replace("CHANGE", change + "\ngroup grains type 1"), tmp_path, discs=discs)
    [first], [second] = done.dump("first.dump"), done.dump("second.dump")
    assert second["f_move[4]"][0] == first["f_move[4]"][0]
    assert second["f_move[4]"][1] not in (0, second["f_move[4]"][0])


def test_angles_are_not_lost_in_a_data_file(tmp_path: Path) -> None:
    """LAMMPS's data files have no place for them: what is written cannot be read without a word of it."""
    deck = (
        ANGLES.replace("CHANGE", "write_data clumps.data")
        + "clear\n"
        + BOX.split("region")[0]
        + "read_data clumps.data\n"
    )
    (tmp_path / "written").mkdir()
    status, output = start(deck, tmp_path / "written")
    run(ANGLES.replace("CHANGE", ""), tmp_path, discs=[Disc(0, 0, 6e-3)])
    (tmp_path / "written" / "discs.data").write_text((tmp_path / "discs.data").read_text())
    status, output = start(deck, tmp_path / "written")
    assert status != 0
    assert (
        "WARNING: A data file of grains of several discs, or of smooth walls, cannot be read: use write_restart"
        in output
    )
    assert "Angles of grains, which read_data cannot read: use a restart file" in output


@pytest.mark.parametrize("contents", ["check", "auto 1e-2"])
def test_a_step_too_large_for_the_first_grain_is_refused(tmp_path: Path, contents: str) -> None:
    """A run that begins without grains has no limit; it has one as they come."""
    deck = DEPOSIT.replace("dt any", f"dt {contents}").replace("timestep    1e-3", "timestep    1e-2")
    status, output = start(deck, tmp_path, style="verlet/cdem", depth="0 0")
    assert status != 0
    assert re.search("the time step 0.01 is beyond the stability limit 0.00[0-9]* of this scene", output)


@pytest.mark.parametrize("contents", ["check", "auto"])
def test_a_step_too_large_for_a_smaller_grain_that_comes_is_refused(tmp_path: Path, contents: str) -> None:
    """The step is right for the sphere that is there; one of a quarter of its size may have an eighth of it, as sqrt(m)."""
    large = DEPOSIT.replace(
        "group       wall", "create_atoms 1 single 2 5 0\nset type 1 diameter 4 density 1\ngroup       wall"
    )
    deck = (
        large.replace("dt any", f"dt {contents}")
        .replace("timestep    1e-3", "timestep    3e-2")
        .replace("run         4000", "run 100")
    )
    status, output = start(deck, tmp_path, style="verlet/cdem", depth="0 0")
    found = re.search(r"the time step (\S+) is beyond the stability limit (\S+) of this scene", output)
    assert status != 0 and found
    assert float(found[1]) / float(found[2]) == pytest.approx(
        0.9 * 8 if contents == "auto" else 0.03 / 5.57e-3, rel=1e-3
    )
    assert ("by the MAX of dt" in output) == (contents == "auto")


def test_the_limit_of_contacts_of_grains_that_came(tmp_path: Path) -> None:
    """That of a smooth disc on a wall without damping: 2 sqrt(m/kn)."""
    output = "compute limit all cdem/limit\nthermo_style custom step c_limit\nthermo 10\nrun 4000"
    deck = DEPOSIT.replace("run         4000", output).replace("1e4 2.5e3 0 0 0", "1e4 0 0 0 0").split("\ndump ")[0]
    done = run(deck + '\nprint "mass = $(mass[2])"\n', tmp_path, style="verlet/cdem", depth="0 0")
    limits = done.thermo["c_limit"]
    assert np.isinf(limits).any() and np.isfinite(limits).any()
    limit = 2 * math.sqrt(done.printed("mass") / 1e4)
    assert limits[np.isfinite(limits)] == pytest.approx(limit, rel=1e-3)


@pytest.mark.parametrize("style", ["verlet", "verlet/cdem"])
def test_a_grain_that_goes_from_one_rank_alone_hangs_no_audit(tmp_path: Path, style: str) -> None:
    deck = f"""{PERIODIC}
create_atoms 1 single 0.4999 2 0
create_atoms 1 single 9.5001 2 0
create_atoms 1 single 2.5 8 0
set         group all diameter 1 density/disc 1
group       goer id 3
region      whole block INF INF INF INF INF INF
fix         out goer evaporate 10 1 whole 4711
{PAIR}
run_style   {style}
fix         move all cdem/integrate dt any
compute     energy all cdem/energy audit yes
timestep    1e-4
run         20
print       "grains = $(count(all))"
"""
    assert run(deck, tmp_path, ranks=2).printed("grains") == 2


COLLISION = f"""{PERIODIC}
${{shape}}
create_atoms 1 single 0.4999 2 0
create_atoms 1 single 9.5001 2 0
set         group all diameter 1 density/disc 1.2732395447351628
velocity    all set 1 0 0
set         atom 1 vx -1
group       sand type 1
region      place block 1.5 8.5 4 9 0 0
fix         rain sand deposit ${{count}} 1 20 4711 region place near 1.1 units box
{PAIR.replace("1e4 2.5e3 0 0 0", "1e4 0 0.215 0 0")}
fix         move sand cdem/integrate dt any
timestep    1e-4
compute     energy all cdem/energy audit yes
thermo_style custom step atoms c_energy[6]
thermo_modify format float %.17g norm no
run         400
"""


@pytest.mark.parametrize("ranks", [1, 2, 4])
@pytest.mark.parametrize("shape", ["", "fix form all cdem/shape type 1 triple type 2 single"], ids=["disc", "triple"])
def test_dashpots_of_a_collision_as_grains_arrive(tmp_path: Path, shape: str, ranks: int) -> None:
    """Across a border, while fix deposit, which comes first, brings grains far away: they have no rows yet as the books of
    the step are closed, and take the place of ghosts. The losses are those without them."""
    with_them, without = (
        run(COLLISION, tmp_path / str(count), shape=shape, count=count, ranks=ranks).thermo["c_energy[6]"][-1]
        for count in (10, 0)
    )
    assert without > 0.2
    assert with_them == pytest.approx(without, rel=1e-9)
