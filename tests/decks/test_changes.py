# SPDX-License-Identifier: GPL-2.0-or-later
"""What happens between two runs. A run goes on with the forces of the last step if the scene is as it was, and gives the
bits of one run; after any change it begins with the forces of the scene as it is. And what a run cannot go on from is
refused."""

from __future__ import annotations

from itertools import cycle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import DECKS, Disc, Run, run, same_bits, start
from scenes import mini_box

# Two grains in contact, over a wall disc that touches the second; the third is free, the fourth touches the first over
# the side of the box, if that is periodic.
DISCS = [
    Disc(0, 0, vx=1, vy=-0.5, omega=40),
    Disc(3.97e-3, 0, vx=-0.5),
    Disc(0.012, 0.004, vy=2),
    Disc(-3.98e-3, 0, vx=0.3),
    Disc(3.97e-3, -3.96e-3, type=2),
]
BOX = (-0.02, 0.02, -0.02, 0.02)
SETTING = """
clear
units        si
dimension    2
boundary     p f p
processors   ${px} ${py} 1
atom_style   sphere
atom_modify  map array
newton       off
comm_modify  vel yes
read_data    FILE
group        grains type 1
group        walls type 2
group        one id 1
neighbor     0.001 bin
run_style    ${style}
pair_style   cdem law direct
pair_coeff   * * 1e8 0 0.215 0 0
pair_coeff   1 2 6e7 0 0.215 0 0
fix          move grains cdem/integrate
fix          push one addforce 100 0 0
fix          floor walls cdem/move speed 0.5 dir y
timestep     5e-8
"""
BETWEEN = f"""
{SETTING.replace("FILE", "discs.data")}
set          group all density/disc 26.5
run          30
GRAINS
write_data   state.data
RULES
run          60
write_dump   all custom went_on.dump id x y vx vy omegaz fx fy modify sort id format float %.17g
{SETTING.replace("FILE", "state.data")}
RULES
run          60
write_dump   all custom anew.dump id x y vx vy omegaz fx fy modify sort id format float %.17g
"""
# What is changed of the grains, which a data file keeps; and of what it does not keep.
CHANGES = {
    "moved": ("displace_atoms one move 0 1e-3 0", ""),
    "deleted": ("group second id 2\ndelete_atoms group second compress no", ""),
    "faster": ("velocity one set 5 0 0", ""),
    "spun": ("set atom 1 omega 0 0 3000", ""),
    "heavier": ("set atom 1 mass 1e-3", ""),
    "denser": ("set group all density/disc 50", ""),
    "larger": ("set atom 1 diameter 0.0042", ""),
    "exchanged": (
        "variable vy atom (id==1)*vy[4]+(id==4)*vy[1]+(id==2)*vy[2]+(id==3)*vy[3]\nvelocity grains set NULL v_vy NULL",
        "",
    ),
    "another type": ("set atom 1 type 2", "group grains clear\ngroup grains type 1\ngroup walls type 2"),
    "another group": ("", "group grains clear\ngroup grains id 1 3 4"),
    "created": (
        "create_atoms 1 single 0 3.97e-3 0\nset atom 6 diameter 4e-3\nset atom 6 density/disc 26.5\ngroup grains type 1",
        "",
    ),
    "coefficients": ("", "pair_coeff * * 5e7 0 0.215 0 0"),
    "law": ("", "pair_style cdem law direct limit_damping yes\npair_coeff * * 1e8 0 0.4 0 0"),
    "gravity": ("", "fix_modify move gravity 0 -1e5"),
    "drag": ("", "fix_modify move drag 1e-5"),
    "integrate": ("", "fix move grains cdem/integrate gravity 0 -1e5 inertia 0.5"),
    "time step": ("", "timestep 2.5e-8"),
    "wall": ("", "unfix floor\nfix floor walls cdem/move speed 3 dir y"),
    "strained": ("change_box all x scale 1.001 remap", ""),
    "wider": ("change_box all x final -0.02 0.0205", ""),
    "reset and moved": ("reset_timestep 0\ndisplace_atoms one move 0 1e-3 0\nrun 0", ""),
}
# What acts beside the contacts: their forces are still those of the last step.
OTHERS = {
    "another force": ("", "unfix push\nfix push one addforce 0 -300 0"),
    "no other force": ("", "unfix push"),
    "lid": ("", "unfix floor\nfix floor walls cdem/lid stress 1e6 width 0.004 thickness 0.01 vmax 1"),
}
ANYHOW = [{"ranks": r, "style": s} for r, s in [(1, "verlet"), (2, "verlet/cdem"), (1, "verlet/cdem"), (4, "verlet")]]


@pytest.mark.parametrize(("change", "how"), zip(CHANGES | OTHERS, cycle(ANYHOW)))
def test_after_a_change_a_run_is_as_one_from_a_data_file(tmp_path: Path, change: str, how: dict[str, Any]) -> None:
    """A data file has no forces, and these smooth contacts remember nothing: it is the same scene to a rounding error,
    which may double with every step of a contact at most. The old force would make a velocity wrong by some 10 %. The
    dashpots' force of the last step is that of a velocity carried forward: the difference goes with the third power of
    the step, of which a contact has some 80 here."""
    grains, rules = (CHANGES | OTHERS)[change]
    tolerance = 1e-5 if change in OTHERS else 1e-10
    discs = DISCS if change != "wider" else [*DISCS, Disc(-0.0199, 0.01), Disc(0.0162, 0.01)]
    done = run(BETWEEN.replace("GRAINS", grains).replace("RULES", rules), tmp_path, discs=discs, box=BOX, **how)
    [went_on], [anew] = done.dump("went_on.dump"), done.dump("anew.dump")
    for column in ("vx", "vy", "omegaz"):
        size = np.max(np.abs(anew[column]))
        assert went_on[column] == pytest.approx(anew[column], abs=tolerance * size), column


def test_what_pair_style_does_not_name_is_the_default_again(tmp_path: Path) -> None:
    """Without limit_damping the dashpot pulls as a contact opens, whatever an earlier pair_style said."""
    deck = "include ${decks}/start.in\nfix move grains cdem/integrate\ntimestep 1e-7\nAGAIN\nrun 300\ninclude ${decks}/end.in\n"
    again = "pair_style cdem law direct\npair_coeff * * 1e8 2.5e7 0.5 0.5 0"
    discs = [Disc(-0.00201, 0, vx=1), Disc(0.00201, 0, vx=-1)]
    speeds = [
        run(deck.replace("AGAIN", change), tmp_path / str(k), discs=discs, hn=0.5, hs=0.5, phi=0, cut=cut).end["vx"][1]
        for k, (cut, change) in enumerate([("no", ""), ("yes", again), ("yes", "")])
    ]
    assert speeds[0] == speeds[1] < speeds[2]


MINI = (DECKS / "mini_box.in").read_text()
COLUMNS = ("id", "x", "y", "vx", "vy", "omegaz", "fx", "fy", "tqz", "f_move[1]", "f_move[2]", "f_move[3]", "f_move[4]")
NOTHING = {
    "run 0": "run 0",
    "another step": "reset_timestep 2400",
    "balance": "balance 1.0 shift xy 20 1.01",
    "files": "write_restart other.restart\nwrite_data other.data\nrun 0",
    "the same": "unfix move\nfix move grains cdem/integrate gravity 0 -1000\npair_coeff * * 1e8 2.5e7 .215 .215 27",
    "a period": "displace_atoms all move 0 0 0\nset group all image 0 0 NULL",
    "the same lid": "unfix lid\nfix lid lid cdem/lid stress 4e5 width 0.032 thickness 0.01 vmax 2",
}


def _mini(folder: Path, plan: str, ranks: int, style: str, **options: Any) -> Any:
    discs, box = mini_box()
    deck = MINI.replace('run ${until}" "run ${rest}', plan).replace('"${plan} == one"', '"${plan} == never"')
    return run(
        deck, folder, discs=discs, box=box, plan="two", ranks=ranks, style=style, until=1000, steps=1400, **options
    )


@pytest.fixture(scope="module")
def uncut(tmp_path_factory: pytest.TempPathFactory) -> Any:
    return _mini(tmp_path_factory.mktemp("uncut"), "run ${steps}", 1, "verlet")


@pytest.mark.parametrize(("what", "how"), zip(NOTHING, cycle(reversed(ANYHOW))))
def test_what_changes_nothing_leaves_the_bits(tmp_path: Path, uncut: Any, what: str, how: dict[str, Any]) -> None:
    commands = '" "'.join(["run 1000", *NOTHING[what].split("\n"), "run 400"])
    assert same_bits(uncut.end, _mini(tmp_path, commands, **how).end, COLUMNS)


LAST = """
compute energy grains cdem/energy audit yes
thermo_style custom step f_lid[1] f_lid[2] f_lid[4] f_floor[1] f_floor[3] f_floor[4] c_energy[8] c_energy[10]
thermo_modify format float %.17g
thermo 1400
run 1400
write_restart middle.restart
run 400
"""


@pytest.mark.parametrize("how", ANYHOW[:2])
def test_a_run_begins_where_the_last_one_ended(tmp_path: Path, how: dict[str, Any]) -> None:
    """The forces on lid and floor, and the work in the audit: in the first row of the next run and of one from a restart
    file, and so at its end too."""
    commands = '" "'.join(LAST.strip().split("\n"))
    out = _mini(tmp_path, commands, **how)
    rows = [line.split() for line in out.log.splitlines() if line.split()[:1] in (["1400"], ["1800"])]
    assert len(rows) >= 3 and abs(float(rows[0][2])) > 0
    assert rows[0] == rows[1]
    again = '" "'.join(line for line in LAST.strip().split("\n") if line != "run 1400")
    deck = MINI.replace('"${plan} == read"', '"${plan} == never"').replace('"${plan} == one"', '"${plan} == read"')
    read = run(deck.replace("run ${steps}", again), tmp_path, plan="read", steps=1800, until=1400, **how)
    first, *_, last = [line.split() for line in read.log.splitlines() if line.split()[:1] in (["1400"], ["1800"])]
    assert rows[1] == first
    assert rows[2][:-1] == last[:-1]
    # the residual is a difference of sums over ranks, of some 0.1 J
    assert float(rows[2][-1]) == pytest.approx(float(last[-1]), abs=1e-15)


OUT_OF_CONTACT = f"""
{SETTING.replace("FILE", "discs.data")}
set group all density/disc 26.5
unfix push
run 30
velocity one set 1.5 -2.5 0
HOW
write_dump all custom end.dump id vx vy modify sort id format float %.17g
"""
HOWS = {
    "run 0": "displace_atoms one move 0 2e-3 0\nrun 0\nrun 3",
    "a restart file": """write_restart between.restart
clear
newton off
processors ${px} ${py} 1
read_restart between.restart
comm_modify vel yes
neighbor 0.001 bin
run_style ${style}
fix move grains cdem/integrate
fix floor walls cdem/move speed 0.5 dir y
set atom 1 y 2e-3
run 3""",
    "run every": """run 1 every 1 "displace_atoms one move 0 2e-3 0" "velocity one set 1.5 -2.5 0"
run 3""",
}


@pytest.mark.parametrize(("how", "where"), zip(HOWS, ANYHOW))
def test_a_grain_that_was_taken_out_of_contact_keeps_its_velocity(
    tmp_path: Path, how: str, where: dict[str, Any]
) -> None:
    end = run(OUT_OF_CONTACT.replace("HOW", HOWS[how]), tmp_path, discs=DISCS, box=BOX, **where).end
    assert (end["vx"][0], end["vy"][0]) == (1.5, -2.5)


def refused(deck: str, folder: Path, **options: Any) -> str:
    status, output = start(deck, folder, **options)
    assert status != 0
    return "\n".join(line for line in output.splitlines() if line.startswith("ERROR"))


# A wall that moves, and clumps.
FIXES = """
fix   shape all cdem/shape type 1 discs 2 -1 0 1 1 0 1 type 2 single density 26.5
fix   move grains cdem/integrate
fix   floor walls cdem/move speed 1 ramp 1e-4
"""
KEPT = f"""
{SETTING.split("fix ")[0].replace("FILE", "discs.data")}
{FIXES}
timestep 1e-8
run   100
write_restart kept.restart
run   100
write_dump all custom end.dump id x y vx vy omegaz fx fy tqz f_move[4] modify sort id format float %.17g
"""
READ = f"""
newton       off
processors   ${{px}} ${{py}} 1
read_restart kept.restart
comm_modify  vel yes
neighbor     0.001 bin
run_style    ${{style}}
timestep     1e-8
{FIXES}
run          100
write_dump   all custom end.dump id x y vx vy omegaz fx fy tqz f_move[4] modify sort id format float %.17g
"""


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return run(KEPT, tmp_path_factory.mktemp("kept"), discs=DISCS, box=BOX, style="verlet")


def _read(deck: str, kept: Run) -> str:
    return deck.replace("kept.restart", str(kept.directory / "kept.restart"))


@pytest.mark.parametrize("how", ANYHOW[1:3])
def test_the_integrator_may_have_another_id(tmp_path: Path, kept: Run, how: dict[str, Any]) -> None:
    """What it needs of the grains does not hang on its name."""
    deck = READ.replace("fix   move", "fix   mover").replace("f_move[4]", "f_mover[4]")
    done = run(_read(deck, kept), tmp_path, **how)
    assert same_bits(kept.end, done.end)
    assert np.array_equal(kept.end["f_move[4]"], done.end["f_mover[4]"])


def test_a_moved_wall_under_another_id_is_refused(tmp_path: Path, kept: Run) -> None:
    """It would start anew. If that is meant, it can be said."""
    deck = _read(READ.replace("fix   floor", "fix   ground"), kept)
    assert "Fix cdem/move ground: the restart file has the motion of a fix cdem/move floor" in refused(
        deck, tmp_path, style="verlet"
    )
    anew = "fix floor walls cdem/move speed 0\nunfix floor\nfix   ground"
    run(deck.replace("fix   ground", anew), tmp_path, style="verlet")
    both = "fix rest grains cdem/move speed 0\nunfix rest\nfix   floor"
    end = run(_read(READ.replace("fix   floor", both), kept), tmp_path, style="verlet").end
    assert same_bits(kept.end, end)


def test_clumps_do_not_become_discs(tmp_path: Path, kept: Run) -> None:
    """Neither from a restart file nor between two runs; but if it is said."""
    without = READ.replace("fix   shape", "#")
    message = "atoms had other shapes than a disc so far, and there is no fix cdem/shape"
    assert message in refused(_read(without, kept), tmp_path, style="verlet")
    assert message in refused(_read(READ, kept) + "unfix shape\nrun 1\n", tmp_path, style="verlet")
    said = READ.replace("type 1 discs 2 -1 0 1 1 0 1", "type 1 single")
    run(_read(said, kept), tmp_path, style="verlet")


@pytest.mark.parametrize("how", ANYHOW[:2])
def test_rerun_is_refused(tmp_path: Path, how: dict[str, Any]) -> None:
    """Its forces on a frame would be those of springs as the last run left them, and of the angles it left."""
    deck = f"""
{SETTING.replace("FILE", "discs.data")}
set group all density/disc 26.5
dump all all custom 10 all.dump id type x y vx vy
run 20
rerun all.dump dump x y vx vy
"""
    run(deck[: deck.index("rerun")], tmp_path, discs=DISCS, box=BOX, **how)
    error = refused(deck, tmp_path, **how)
    assert "rerun: a dump has neither the springs of contacts nor the angles of grains" in error


@pytest.mark.parametrize("how", ANYHOW[:2])
def test_the_mass_of_the_circle_around_a_clump_is_refused(tmp_path: Path, how: dict[str, Any]) -> None:
    """Of two equal discs side by side, each of half the radius, the circle has twice the mass."""
    shape = "fix shape all cdem/shape type 1 discs 2 -1 0 1 1 0 1 type 2 single"
    head = SETTING.split("fix ")[0].replace("FILE", "discs.data")
    rest = "fix move grains cdem/integrate dt auto\nrun 1\n"
    deck = f"{head}\nset group all density/disc 26.5\n{shape}\n{rest}"
    run(deck.replace("2 single", "2 single density 26.5"), tmp_path, discs=DISCS, box=BOX, **how)
    error = refused(deck, tmp_path, **how)
    mass = DISCS[0].mass
    assert f"of type 1 has mass {mass:.6g}, that of the circle around it with 26.5 kg/m^2 as of type 2" in error
    assert f"its discs have {mass / 2:.6g}: give the fix 'density 26.5', or 'density 53' if" in error
    run(deck.replace("2 single", "2 single density 53"), tmp_path, **how)  # it says so itself
    run(deck.replace(shape, f"{shape}\nset type 1 mass 1e-4"), tmp_path, **how)


STOPPED = f"""
{SETTING.replace("FILE", "discs.data")}
set       group all density/disc 26.5
unfix     push
run       30
group     grains clear
group     grains id 2 3 4
CHANGE
run       30
"""


def test_grains_that_became_walls_with_a_velocity_are_told_of(tmp_path: Path) -> None:
    """Contacts would take them for belts. Neither walls that a fix moves are, nor those that were brought to rest."""
    belts = "1 walls that no fix moves have a velocity or spin"
    still = "velocity one set 0 0 0\nset group one omega 0 0 0"
    for change, told in {"": 1, still: 0, "fix hold one cdem/move speed 0": 0, "velocity one set 0 0 0": 1}.items():
        log = run(STOPPED.replace("CHANGE", change), tmp_path, discs=DISCS, box=BOX, style="verlet/cdem").log
        assert log.count(belts) == told, change
