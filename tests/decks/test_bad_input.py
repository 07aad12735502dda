# SPDX-License-Identifier: GPL-2.0-or-later
"""One wrong thing at a time in a good deck: a message with the offending value, and an end with a status other than 0.

On two ranks, so that a rank which waits for another shows as a time-out.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from engine import start

# Newer versions do not let a number pass that is too large for double.
OR_LAMMPS_ITSELF = "|number 1e999 .* is out of range"

GOOD = """
units         si
dimension     2
boundary      f f p
atom_style    sphere
atom_modify   map array
newton        off
comm_modify   vel yes
region        box block -0.02 0.02 -0.02 0.02 -0.5 0.5
create_box    3 box
cdem/create   2 row -0.01 -0.01 0.01 -0.01 6 diameter 0.004 density 26.5
cdem/create   1 fill 8 region -0.01 0.01 -0.007 0.01 diameter 0.002 0.004 power -3 density 26.5 seed 7
cdem/create   3 row -0.01 0.015 0.01 0.015 6 diameter 0.004 density 26.5
group         grains type 1
group         floor type 2
group         lid type 3
pair_style    cdem law direct limit_damping no
pair_coeff    * * 1e8 2.5e7 0.215 0.215 27
neighbor      0.001 bin
fix           move grains cdem/integrate dt check
fix           floor floor cdem/move speed 0.002 dir x ramp 1e-4 stop 0.008
fix           lid lid cdem/lid stress 1e5 width 0.02 thickness 0.01 vmax auto
timestep      2e-7
run           20
write_restart good.restart
write_data    good.data
"""

# name: what is replaced in the good deck, by what, and what the message says (a regular expression)
CASES: dict[str, tuple[str, str, str]] = {
    # pair style
    "no law": ("law direct limit", "limit", r"Pair style cdem.*law"),
    "unknown law": ("law direct", "law hertz", r"Pair style cdem: law hertz"),
    "law without a value": ("law direct limit_damping no", "law", r"Pair style cdem: law nothing"),
    "unknown keyword of the pair style": ("limit_damping no", "damping no", r"Pair style cdem: unknown keyword damping"),
    "instructions of no machine": ("limit_damping no", "instructions sse9", r"instructions sse9: this machine has .*baseline"),
    "limit_damping neither yes nor no": ("limit_damping no", "limit_damping 1", r"Pair style cdem: limit_damping 1"),
    "too few coefficients": ("0.215 0.215 27", "0.215 27", r"Pair coeff cdem has 6 arguments"),
    "too many coefficients": ("0.215 27", "0.215 27 1", r"Pair coeff cdem: 1 after kn ks hn hs phi: must be rolling or cohesion"),
    "rolling without values": ("0.215 27", "0.215 27 rolling", r"Pair coeff cdem: rolling: mu_r \(1\) is missing"),
    "rolling without a damping ratio": ("0.215 27", "0.215 27 rolling 0.3", r"Pair coeff cdem: rolling: h_r \(1\) is missing"),
    "rolling with another addition for a value": ("0.215 27", "0.215 27 rolling 0.3 cohesion 1", r"'cohesion'"),
    "rolling negative": ("0.215 27", "0.215 27 rolling -0.3 0.1", r"Pair coeff cdem: mu_r = -0.3 must be a number, not negative"),
    "rolling with a negative damping ratio": ("0.215 27", "0.215 27 rolling 0.3 -0.1", r"Pair coeff cdem: h_r = -0.1"),
    "rolling infinite": ("0.215 27", "0.215 27 rolling 1e999 0.1", r"Pair coeff cdem: mu_r = 1e999" + OR_LAMMPS_ITSELF),
    "rolling twice": ("0.215 27", "0.215 27 rolling 0.3 0.1 cohesion 1 rolling 0.2 0.1", r"Pair coeff cdem: rolling is given twice"),
    "cohesion without a value": ("0.215 27", "0.215 27 cohesion", r"Pair coeff cdem: cohesion: F_c \(N\) is missing"),
    "cohesion negative": ("0.215 27", "0.215 27 cohesion -1", r"Pair coeff cdem: F_c = -1"),
    "cohesion with two values": ("0.215 27", "0.215 27 cohesion 1 2", r"Pair coeff cdem: 2 after kn ks hn hs phi: must be rolling or cohesion"),
    "an addition that there is not": ("0.215 27", "0.215 27 capillary 1", r"Pair coeff cdem: capillary after kn ks hn hs phi"),
    "kn zero": ("* * 1e8", "* * 0", r"Pair coeff cdem: kn = 0"),
    "kn negative": ("* * 1e8", "* * -1e8", r"Pair coeff cdem: kn = -1e8"),
    "kn infinite": ("* * 1e8", "* * 1e999", r"Pair coeff cdem: kn = 1e999" + OR_LAMMPS_ITSELF),
    "kn not a number": ("* * 1e8", "* * nan", r"'nan'"),
    "kn a word": ("* * 1e8", "* * stiff", r"'stiff'"),
    "ks negative": ("2.5e7", "-2.5e7", r"Pair coeff cdem: ks = -2.5e7"),
    "hn negative": ("0.215 0.215", "-0.1 0.215", r"Pair coeff cdem: hn = -0.1"),
    "hs negative": ("0.215 27", "-0.2 27", r"Pair coeff cdem: hs = -0.2"),
    "phi negative": ("0.215 27", "0.215 -27", r"Pair coeff cdem: phi = -27"),
    "phi 90": ("0.215 27", "0.215 90", r"Pair coeff cdem: phi = 90"),
    "a type that is not there": ("pair_coeff    * *", "pair_coeff    1 7", r"7"),
    "a pair of types without coefficients": ("pair_coeff    * *", "pair_coeff    1 *", r"Pair style cdem: no pair_coeff for types 2 and 2|All pair coeffs are not set"),
    # what the pair style needs
    "three dimensions": ("dimension     2", "dimension     3", r"dimension is 3, must be 2"),
    "newton on": ("newton        off", "newton        on", r"Pair style cdem: newton is on"),
    "ghosts without velocities": ("comm_modify   vel yes", "", r"Pair style cdem needs 'comm_modify vel yes'"),
    "atom style atomic": ("atom_style    sphere", "atom_style    atomic", r"needs atom_style sphere"),
    "units without F = m a": ("units         si", "units         metal", r"units metal: force must be mass times acceleration"),
    "an atom out of the plane": ("timestep", "set atom 1 z 0.001\ntimestep", r"atom 1 is at z = 0.001, must be 0"),
    "radii that change": ("atom_style    sphere", "atom_style    sphere 1", r"atom_style sphere 1 must be sphere or sphere 0"),
    "a neighbour list without a skin": ("0.001 bin", "0 bin", r"the skin of the neighbour list is 0, must be positive"),
    "pair_write": ("run           20", "pair_write 1 1 10 r 1e-3 5e-3 table.txt force", r"pair_write: forces are not a function of the distance"),
    "minimize": ("run           20", "minimize 0 1e-6 10 100", r"minimize makes no time steps"),
    "a period that two grains fill": ("timestep", "change_box all boundary p f p\nset atom 1 diameter 0.021\ntimestep", r"the box is periodic over 0.04 m in x, must be 0.042 m"),
    "two grains in one place": ("timestep", "set group grains x 0.001\nset group grains y 0\ntimestep", r"discs of atoms \d+ and \d+ have the same centre \(0.001, 0\)"),
    "no integrator": ("fix           move grains cdem/integrate dt check", "", r"Pair style cdem needs a fix cdem/integrate"),
    "two integrators": ("cdem/integrate dt check", "cdem/integrate\nfix again lid cdem/integrate", r"Fix cdem/integrate again: there is one already, move"),
    "another integrator beside it": ("fix           floor", "fix nve grains nve/sphere\nfix floor", r"Fix cdem/integrate move: fix nve of style nve/sphere"),
    "pair style hybrid": ("pair_style    cdem law direct limit_damping no\npair_coeff    * *", "pair_style hybrid cdem law direct\npair_coeff * * cdem", r"cdem.*hybrid|needs pair_style cdem"),
    "no pair style": ("pair_style    cdem law direct limit_damping no\npair_coeff    * * 1e8 2.5e7 0.215 0.215 27", "", r"needs pair_style cdem"),
    # integrator
    "unknown keyword of the integrator": ("dt check", "step check", r"Fix cdem/integrate: unknown keyword step"),
    "unknown rule for dt": ("dt check", "dt max", r"Fix cdem/integrate: dt max"),
    "dt without a value": ("dt check", "dt", r"Fix cdem/integrate: dt nothing"),
    "largest automatic dt negative": ("dt check", "dt auto -1e-6", r"Fix cdem/integrate: dt auto -1e-06"),
    "largest dt of the contacts zero": ("dt check", "dt contacts 0", r"Fix cdem/integrate: dt contacts 0: the maximum"),
    "inertia without a value": ("dt check", "inertia", r"Fix cdem/integrate: inertia has no value|inertia.*missing"),
    "inertia zero": ("dt check", "inertia 0", r"Fix cdem/integrate: inertia 0"),
    "inertia negative": ("dt check", "inertia -2", r"Fix cdem/integrate: inertia -2"),
    "inertia infinite": ("dt check", "inertia 1e999", r"Fix cdem/integrate: inertia inf" + OR_LAMMPS_ITSELF),
    "time step beyond the limit": ("timestep      2e-7", "timestep      2e-6", r"time step 2e-06 is beyond the stability limit [1-9]\.\d+e-07"),
    "time step zero": ("timestep      2e-7", "timestep      0", r"Fix cdem/integrate: the time step 0 must be positive"),
    "time step negative": ("timestep      2e-7", "timestep      -2e-7", r"Fix cdem/integrate: the time step -2e-07 must be positive"),
    "automatic dt without grains": ("grains cdem/integrate dt check", "nobody cdem/integrate dt auto", r"Fix cdem/integrate.*no grain"),
    "rescue without a file": ("dt check", "dt check rescue", r"Fix cdem/integrate: rescue: a file or none is missing"),
    "no part": ("timestep", "compute load all cdem/force\ntimestep", r"Compute cdem/force load: names of groups are missing"),
    "a part that is gone": ("run           20", "group part type 2\ncompute load all cdem/force part\ngroup part delete\nrun 20", r"Compute cdem/force load: there is no group part"),
    "an unknown part": ("timestep", "compute load all cdem/force roof\ntimestep", r"Compute cdem/force load: there is no group roof"),
    "an argument of the limit": ("timestep", "compute limit all cdem/limit fast\ntimestep", r"Compute cdem/limit: unknown argument fast"),
    "an argument of the signal": ("timestep", "compute asked all cdem/signal USR2\ntimestep", r"Compute cdem/signal: unknown argument USR2"),
    "the signal of a group": ("timestep", "compute asked grains cdem/signal\ntimestep", r"Compute cdem/signal asked: the group must be all"),
    "the limit of a group": ("timestep", "compute limit grains cdem/limit\ntimestep", r"Compute cdem/limit limit: the group must be all"),
    "a group that is not there": ("move grains", "move sand", r"sand"),
    # lid
    "lid without grains": ("group         lid type 3", "group lid id 999", r"Fix cdem/lid lid: group lid has no atoms"),
    "lid without stress": ("stress 1e5", "", r"Fix cdem/lid lid: stress .*missing"),
    "lid with negative stress": ("stress 1e5", "stress -1e5", r"Fix cdem/lid lid: stress -100000"),
    "lid with infinite stress": ("stress 1e5", "stress 1e999", r"Fix cdem/lid lid: stress inf" + OR_LAMMPS_ITSELF),
    "lid with infinite width": ("width 0.02", "width 1e999", r"Fix cdem/lid lid: width inf" + OR_LAMMPS_ITSELF),
    "lid with width zero": ("width 0.02", "width 0", r"Fix cdem/lid lid: width 0"),
    "lid without width": ("width 0.02", "", r"Fix cdem/lid lid: width"),
    "lid with negative thickness": ("thickness 0.01", "thickness -0.01", r"Fix cdem/lid lid: thickness -0.01"),
    "lid with vmax zero": ("vmax auto", "vmax 0", r"Fix cdem/lid lid: vmax 0"),
    "lid with an unknown keyword": ("vmax auto", "gain 3", r"Fix cdem/lid lid: unknown keyword gain"),
    "lid with a value missing": ("width 0.02 thickness 0.01 vmax auto", "thickness 0.01 width", r"Fix cdem/lid lid: width has no value"),
    "lid of grains": ("lid lid", "lid grains", r"Fix cdem/lid lid: 8 atoms of group grains are also in group grains"),
    "lid with a variable that is not there": ("stress 1e5", "stress v_sigma", r"Fix cdem/lid lid: there is no variable sigma"),
    "lid with a variable of another style": ("stress 1e5", "stress v_sigma", r"Fix cdem/lid lid: variable sigma is not of style equal"),
    "lid with a variable that turns negative": ("stress 1e5", "stress v_sigma", r"Fix cdem/lid lid: variable sigma is -1\b.* at step 11"),
    # prescribed motion
    "wall without speed": ("speed 0.002", "", r"Fix cdem/move floor: speed .*missing"),
    "wall with an infinite speed": ("speed 0.002", "speed 1e999", r"Fix cdem/move floor: speed inf" + OR_LAMMPS_ITSELF),
    "wall with an unknown direction": ("dir x", "dir z", r"Fix cdem/move floor: dir z"),
    "wall with a negative ramp": ("ramp 1e-4", "ramp -1e-4", r"Fix cdem/move floor: ramp -0.0001"),
    "wall with an infinite ramp": ("ramp 1e-4", "ramp 1e999", r"Fix cdem/move floor: ramp inf" + OR_LAMMPS_ITSELF),
    "wall with stop zero": ("stop 0.008", "stop 0", r"Fix cdem/move floor: stop 0"),
    "wall with an unknown keyword": ("dir x", "along x", r"Fix cdem/move floor: unknown keyword along"),
    "wall with a speed that is a word": ("speed 0.002", "speed fast", r"speed is fast, must be a number"),
    "two fixes on one wall": ("floor floor", "floor lid", r"atoms of group lid are also moved by fix cdem/(lid lid|move floor)"),
    # cdem/create
    "unknown shape to create": ("fill 8", "heap 8", r"cdem/create: heap"),
    "unknown type to create": ("cdem/create   1", "cdem/create   4", r"cdem/create: type 4: the box has 3"),
    "no grains to create": ("fill 8", "fill 0", r"cdem/create.* 0\b"),
    "grains that do not fit": ("fill 8", "fill 800", r"cdem/create: 800 grains .*the region has 0.017"),
    "a disc outside of the box": ("row -0.01 -0.01", "row -0.03 -0.01", r"cdem/create: disc centre x = -0.03 is outside"),
    "diameter zero": ("6 diameter 0.004", "6 diameter 0", r"cdem/create: .* 0: must be positive"),
    "diameters the wrong way round": ("0.002 0.004 power", "0.004 0.002 power", r"cdem/create: diameter 0.004 0.002"),
    "grains wider than the region": ("0.002 0.004 power", "0.002 0.4 power", r"grains of diameter 0.4 do not fit in the width 0.02"),
    "density negative": ("0.004 density 26.5\ncdem/create   1", "0.004 density -26.5\ncdem/create   1", r"cdem/create: .*-26.5"),
    "region turned inside out": ("-0.01 0.01 -0.007 0.01", "0.01 -0.01 -0.007 0.01", r"cdem/create: region 0.01 -0.01"),
    "seed zero": ("seed 7", "seed 0", r"cdem/create: seed 0"),
    "a word missing": (" seed 7", "", r"cdem/create: seed is missing"),
    "a word too many": ("seed 7", "seed 7 8", r"cdem/create: unexpected 8"),
    "grains before the box": ("create_box    3 box", "", r"box"),
    # discs by other ways
    "diameter of an atom zero": ("timestep", "set atom 8 diameter 0\ntimestep", r"Pair style cdem: atom 8 has (radius|mass) 0"),
    "mass of an atom zero": ("timestep", "set atom 8 density/disc 0\ntimestep", r"density/disc 0"),
    "a grain that is too fast": ("timestep", "velocity grains set 1e4 0 0\ntimestep", r"step 0 atom \d+ moves by 0.002 m in one step"),
    "a grain beyond the box": ("run           20", "velocity grains set 400 0 0\nrun 500", r"step \d+ atom \d+ has left the box, to 0.\d+"),
    "a position that is no number": ("timestep", "variable bad atom 0/0\nset group grains x v_bad\ntimestep", r"[Dd]ivide by 0|nan|[Nn]on-numeric"),
}  # fmt: skip

# What a case needs before the fixes.
BEFORE = {
    "automatic dt without grains": "group nobody empty\n",
    "lid with a variable of another style": "variable sigma atom x\n",
    "lid with a variable that turns negative": 'variable sigma equal "10-step"\n',
}

# Found on one rank, or by counting over all: another rank must not wait for it. (mpirun takes 2 s to end after an error.)
ON_TWO_RANKS = {
    "three dimensions",
    "no integrator",
    "time step beyond the limit",
    "lid without grains",
    "lid of grains",
    "lid with a variable that turns negative",
    "two fixes on one wall",
    "grains that do not fit",
    "a disc outside of the box",
    "diameter of an atom zero",
    "a grain that is too fast",
}


def check(deck: str, directory: Path, message: str, ranks: int) -> None:
    """LAMMPS names the value in the ERROR line or, for its own commands, by the command itself."""
    status, output = start(deck, directory, ranks=ranks)
    errors = "\n".join(
        line for line in output.splitlines() if "ERROR" in line or re.match("Last (command|input line)", line)
    )
    assert status != 0, f"no failure\n{output[-2000:]}"
    assert re.search(message, errors), f"'{message}' is not in\n{errors or output[-2000:]}"


def test_the_good_deck_is_good(tmp_path: Path, ranks: int) -> None:
    status, output = start(GOOD, tmp_path, ranks=ranks)
    assert status == 0, output


NO_IDS = """
units si
dimension 2
atom_style sphere
atom_modify id no
newton off
comm_modify vel yes
region box block -0.02 0.02 -0.02 0.02 -0.5 0.5
create_box 1 box
create_atoms 1 single 0 0 0
set group all diameter 0.004
pair_style cdem law direct
pair_coeff * * 1e8 2.5e7 0.215 0.215 27
fix move all cdem/integrate
run 0
"""


def test_atoms_without_ids(tmp_path: Path, ranks: int) -> None:
    check(NO_IDS, tmp_path, r"Pair style cdem: atom_modify id no must be yes", ranks)


@pytest.mark.parametrize(("name", "ranks"), [(n, 1) for n in CASES] + [(n, 2) for n in CASES if n in ON_TWO_RANKS])
def test_bad_deck(tmp_path: Path, name: str, ranks: int) -> None:
    old, new, message = CASES[name]
    assert old in GOOD
    check(GOOD.replace(old, new, 1).replace("fix ", BEFORE.get(name, "") + "fix ", 1), tmp_path, message, ranks)


# --- files ----------------------------------------------------------------------------------------------------------

READ_RESTART = """
newton        off
read_restart  good.restart
comm_modify   vel yes
neighbor      0.001 bin
fix           move grains cdem/integrate
fix           floor floor cdem/move speed 0.002 dir x ramp 1e-4 stop 0.008
fix           lid lid cdem/lid stress 1e5 width 0.02 thickness 0.01
run           20
"""
READ_DATA = """
units         si
dimension     2
boundary      f f p
atom_style    sphere
newton        off
comm_modify   vel yes
read_data     good.data
group         grains type 1
pair_style    cdem law direct
pair_coeff    * * 1e8 2.5e7 0.215 0.215 27
fix           move grains cdem/integrate
timestep      2e-7
run           20
"""


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the restart and the data file of the good deck."""
    folder = tmp_path_factory.mktemp("good")
    status, output = start(GOOD, folder)
    assert status == 0, output
    return folder


RESTARTS: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda data: b"",
    "cut in its header": lambda data: data[:100],
    "cut in the middle": lambda data: data[: len(data) // 2],
    "its last bytes missing": lambda data: data[:-40],
    "text": lambda data: b"This is no restart file.\n" * 100,
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("damage", RESTARTS)
def test_damaged_restart(tmp_path: Path, good: Path, damage: str, ranks: int) -> None:
    (tmp_path / "good.restart").write_bytes(RESTARTS[damage]((good / "good.restart").read_bytes()))
    check(READ_RESTART, tmp_path, "good.restart", ranks)


def test_restart_without_newton_off(tmp_path: Path, good: Path) -> None:
    (tmp_path / "good.restart").write_bytes((good / "good.restart").read_bytes())
    check(READ_RESTART.replace("newton        off", ""), tmp_path, "newton is on, must be off", 1)


DATA: dict[str, tuple[Callable[[str], str], str]] = {
    "empty": (lambda text: "", r"data file"),
    "cut in the middle": (lambda text: text[: len(text) // 2], r"data file|Did not assign|atoms"),
    "an atom missing": (lambda text: re.sub(r"\n\n(\d+ \d [^\n]+)\n", "\n\n", text, count=1), r"data file|atoms"),
    "a word for a number": (lambda text: re.sub(r"(\n\n\d+ \d) [^ ]+", r"\1 large", text, count=1), r"'large'"),
    "a type that is not there": (lambda text: re.sub(r"(\n\n\d+) \d", r"\1 9", text, count=1), r"type"),
    "a negative diameter": (lambda text: re.sub(r"(\n\n\d+ \d) ", r"\1 -", text, count=1), r"[Rr]adius|diameter"),
    "a position far outside": (
        lambda text: re.sub(r"(\n\n\d+ \d [^ ]+ [^ ]+) [^ ]+", r"\1 99", text, count=1),
        r"atoms",
    ),
}


@pytest.mark.parametrize("damage", DATA)
def test_damaged_data_file(tmp_path: Path, good: Path, damage: str) -> None:
    change, message = DATA[damage]
    (tmp_path / "good.data").write_text(change((good / "good.data").read_text()))
    check(READ_DATA, tmp_path, message, 1)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize(
    ("command", "message"),
    [
        ("include nothing.in", "nothing.in"),
        ("read_restart nothing.restart", "nothing.restart"),
        ("read_data nothing.data", "nothing.data"),
    ],
)
def test_missing_file(tmp_path: Path, command: str, message: str, ranks: int) -> None:
    check(f"units si\nnewton off\ndimension 2\natom_style sphere\n{command}\n", tmp_path, message, ranks)


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("write_restart /dev/full", "cannot write /dev/full: No space left on device"),
        ("dump d all custom 1 /dev/full id x y", "cannot write /dev/full: No space left on device"),
        ("fix out all ave/time 1 1 1 f_lid[2] file /dev/full", "cannot write /dev/full: No space left on device"),
        ("restart 10 nowhere/a nowhere/b", "nowhere/a"),
        (
            "unfix move\nfix move grains cdem/integrate dt check rescue nowhere/r.restart",
            "rescue nowhere/r.restart: there is no folder nowhere that can be written",
        ),
        ("dump d all custom 1 nowhere/d.dump id x y", "Cannot open dump file"),
        ("fix out all ave/time 1 1 1 f_lid file nowhere/f.dat", "nowhere/f.dat"),
        ("log nowhere/log.lammps", "nowhere/log.lammps"),
    ],
)
def test_no_place_for_output(tmp_path: Path, output: str, message: str) -> None:
    """A full disk (/dev/full stands for it), a folder that is not there."""
    check(GOOD.replace("run           20", f"{output}\nrun 20"), tmp_path, message, 1)
