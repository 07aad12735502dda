# SPDX-License-Identifier: GPL-2.0-or-later
"""Computes cdem/trm, contacts, discs and energy: closed forms, on any number of ranks, and that they only look."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from crowd import PERIOD, SIDE, SPACING, SWELLING, run_crowd
from engine import DENSITY, Disc, Frame, Run, run, same_bits, start

START = "include ${decks}/start.in\n"
END = "include ${decks}/end.in\n"


def dump(style: str, name: str, every: int, columns: str) -> str:
    """Writes NAME.dump with all digits; dump custom in order of the ids."""
    order = " sort id" if style == "custom" else ""
    return f"dump {name} all {style} {every} {name}.dump {columns}\ndump_modify {name} format float %.17g{order}\n"


# --- rotation rate of motion ----------------------------------------------------------------------

# One crosses both periodic borders, one spins clockwise as it drifts, one stays where it is. They never meet.
FREE = [
    Disc(-0.01, -0.015, 4e-3, vx=3, vy=4, omega=10),
    Disc(0.015, -0.005, 2e-3, vx=-0.5, omega=-2000),
    Disc(0.0, -0.01, 4e-3),
]
FREE_TRM = [2e-3 * 10 / 5, 1e-3 * 2000 / 0.5, 0]
FREE_MOTION = "fix move grains cdem/integrate dt any\ntimestep 1e-5\n"
TRM = "compute trm all cdem/trm\n"
SHOW_TRM = "thermo_style custom step c_trm\n" + dump("custom", "trm", 500, "id c_trm")


def free(directory: Path, deck: str, ranks: int = 1) -> Run:
    return run(START + FREE_MOTION + deck, directory, discs=FREE, ranks=ranks, bx="p", by="p")


def trm(done: Run) -> np.ndarray:
    return done.dump("trm.dump")[-1]["c_trm"]


def test_trm_of_free_discs(tmp_path: Path, ranks: int) -> None:
    """r |omega|/|v|, also while a disc crosses borders; the mean leaves out the disc that never moved."""
    done = free(tmp_path, TRM + SHOW_TRM + 'run 1000\nprint "mean = $(c_trm:%.17g)"\n', ranks)
    assert trm(done) == pytest.approx(FREE_TRM, rel=1e-12)
    assert done.printed("mean") == pytest.approx((FREE_TRM[0] + FREE_TRM[1]) / 2, rel=1e-12)


def test_trm_sums_what_was_turned_and_travelled(tmp_path: Path) -> None:
    """There and back, turned to and fro: the sums grow all the same. Outside the group there is no TRM."""
    deck = "group first id 1\n" + TRM.replace("all", "first")
    deck += SHOW_TRM + "run 500\nset atom 1 vx -3 vy -4 omega 0 0 -10\nrun 500\n"
    assert trm(free(tmp_path, deck)) == pytest.approx([FREE_TRM[0], 0, 0], rel=1e-12)


@pytest.mark.parametrize("rolls", [True, False], ids=["rolling", "sliding"])
def test_trm_on_a_wall(tmp_path: Path, law: str, rolls: bool) -> None:
    """A disc that rolls without slip on a large wall disc has TRM 1, one that slides without friction 0.

    The point of contact is at rest if v = omega (r - overlap/2): an overlap of 1e-5 r is all that is missing to 1.
    """
    r, floor, speed, force, kn = 2e-3, 0.05, 0.5, 0.02, 1e6
    overlap = force / kn
    discs = [
        Disc(
            -0.004,
            math.sqrt((r + floor - overlap) ** 2 - 0.004**2) - floor,
            2 * r,
            vx=speed,
            omega=-rolls * speed / r,
        ),
        Disc(0, -floor, 2 * floor, type=2),
    ]
    deck = """
    fix      move grains cdem/integrate dt auto
    fix      press grains addforce 0 -${force} 0
    compute  trm grains cdem/trm
    thermo_style custom step c_trm
    run      2500
    print    "trm = $(c_trm)"
    """
    done = run(
        START + deck + END, tmp_path, discs=discs, box=(-0.02, 0.02, -0.06, 0.02), law=law, force=force,
        kn=kn, ks=kn / 4, hs=0, phi=60 if rolls else 0,
    )  # fmt: skip
    assert done.end["x"][0] > 0.003
    assert done.printed("trm") == pytest.approx(1 if rolls else 0, abs=1e-4)


def test_trm_goes_on_after_a_restart(tmp_path: Path, ranks: int) -> None:
    """To the same bits, here on another number of ranks; with another ID it starts afresh."""
    change = "set atom 1 vx 1\nset atom 3 vy 2 omega 0 0 7\n"
    whole = free(tmp_path, TRM + SHOW_TRM + "run 500\n" + change + "write_restart half.restart\nrun 500\n")
    resume = "processors ${px} ${py} 1\nnewton off\nread_restart ../half.restart\n" + FREE_MOTION
    resumed = run(resume + TRM + SHOW_TRM + "run 500\n", tmp_path / "resumed", ranks=ranks)
    assert trm(resumed).tolist() == trm(whole).tolist()
    other = resume + (TRM + SHOW_TRM).replace("compute trm", "compute other").replace("c_trm", "c_other")
    afresh = run(other + "run 500\n", tmp_path / "other").dump("trm.dump")[-1]["c_other"]
    assert afresh == pytest.approx([2e-3 * 10 / math.hypot(1, 4), FREE_TRM[1], 2e-3 * 7 / 2], rel=1e-12)
    assert afresh[0] != pytest.approx(trm(whole)[0])


def test_trm_lasts_as_long_as_its_compute(tmp_path: Path) -> None:
    """Nothing is summed without it; made again it starts afresh; `clear` leaves no trace of it."""
    deck = """
    compute  trm all cdem/trm
    run      100
    info     fixes out log
    uncompute trm
    print    "removed"
    info     fixes out log
    set      atom 1 vx 6 vy 8
    run      500
    """
    done = free(tmp_path, deck + TRM + SHOW_TRM + 'run 500\nclear\nprint "cleared"\n')
    before, after = done.log.split("\nremoved\n")
    assert "style = cdem/trm" in before
    assert "style = cdem/trm" not in after
    assert trm(done) == pytest.approx([FREE_TRM[0] / 2, *FREE_TRM[1:]], rel=1e-12)
    assert "\ncleared\n" in done.log


# --- contacts -------------------------------------------------------------------------------------

FIELDS = "id1 id2 disc1 disc2 x y fn ft fx fy nx ny overlap sliding".split()


def dump_contacts(every: int) -> str:
    return "compute contacts all cdem/contacts\n" + dump("local", "contacts", every, "c_contacts[*]")


def contacts(done: Run) -> list[Frame]:
    """The contacts of every frame, with the fields as columns, in order of the ids."""
    frames = []
    for frame in done.dump("contacts.dump"):
        columns = dict(zip(FIELDS, frame.columns.values(), strict=True))
        order = np.lexsort([columns[name] for name in reversed(FIELDS[:4])])
        frames.append(Frame(frame.step, {name: column[order] for name, column in columns.items()}))
    return frames


@pytest.mark.parametrize(("x", "y"), [(-1e-4, -1e-4), (0.0199, 0.0199)], ids=["between-ranks", "periodic"])
def test_two_pressed_discs(tmp_path: Path, law: str, ranks: int, x: float, y: float) -> None:
    """fn = kn overlap, the point in the middle of the overlap, the normal from disc 2 to disc 1; counted once."""
    kn, overlap, r1, r2 = 1e7, 3e-5, 2e-3, 4e-3
    nx, ny = math.cos(math.radians(30)), math.sin(math.radians(30))
    distance, box = r1 + r2 - overlap, 0.04
    wrap = lambda c: math.remainder(c, box)
    discs = [
        Disc(wrap(x + distance * nx), wrap(y + distance * ny), 2 * r1),
        Disc(x, y, 2 * r2),
        Disc(0.005, -0.012, 2 * r2),
    ]
    deck = START + "fix move grains cdem/integrate dt auto\n" + dump_contacts(1) + "run 0\n"
    [frame] = contacts(run(deck, tmp_path, discs=discs, ranks=ranks, law=law, kn=kn, ks=kn / 4, bx="p", by="p"))
    [seen] = zip(*frame.columns.values(), strict=True)
    contact = dict(zip(FIELDS, seen, strict=True))
    force, arm = kn * overlap, r2 - overlap / 2
    # The point is in the image of disc 1, whose rank counts the contact.
    assert wrap(contact.pop("x") - x - arm * nx) == pytest.approx(0, abs=1e-15)
    assert wrap(contact.pop("y") - y - arm * ny) == pytest.approx(0, abs=1e-15)
    expected = {"id1": 1, "id2": 2, "disc1": 0, "disc2": 0, "fn": force, "ft": 0, "fx": force * nx, "fy": force * ny}
    expected |= {"nx": nx, "ny": ny, "overlap": overlap, "sliding": 0}
    assert contact == pytest.approx(expected, rel=1e-10, abs=1e-9 * force)


def test_sliding_begins_at_the_coulomb_limit(tmp_path: Path, law: str) -> None:
    """Two discs, too heavy to be slowed, shear past each other at 2 u: ft = -2 ks u t up to kn overlap tan(phi)."""
    kn, ks, phi, overlap, r, u, dt = 1e6, 2.5e5, 27.0, 1e-7, 2e-3, 1e-5, 1e-6
    discs = [Disc(r - overlap / 2, 0, 2 * r, vy=u), Disc(-r + overlap / 2, 0, 2 * r, vy=-u)]
    deck = START + "fix move grains cdem/integrate\ntimestep ${dt}\n" + dump_contacts(1000) + "run 20000\n"
    done = run(
        deck, tmp_path, discs=discs, law=law, kn=kn, ks=ks, hn=0, hs=0, phi=phi, density=1e12, dt=dt
    )  # fmt: skip
    frames = contacts(done)
    assert all(frame["id1"].tolist() == [1] for frame in frames)
    column = lambda name: np.array([frame[name][0] for frame in frames])
    limit = kn * overlap * math.tan(math.radians(phi))
    spring = 2 * ks * u * dt * np.array([frame.step for frame in frames])
    assert column("ft") == pytest.approx(-np.minimum(spring, limit), rel=1e-3)
    assert column("fn") == pytest.approx(kn * overlap, rel=1e-3)
    assert column("sliding").tolist() == (spring > limit).tolist()
    assert set(column("sliding")) == {0, 1}


@pytest.mark.parametrize("shape", SWELLING)
def test_contacts_add_up_to_the_forces_on_the_grains(tmp_path: Path, law: str, ranks: int, shape: str) -> None:
    """Each contact once on any number of ranks; all of them are the force and the torque on every grain and wall."""
    deck = dump_contacts(30) + dump("custom", "grains", 30, "id x y fx fy tqz") + "run 90\n"
    done = run_crowd(deck, tmp_path, law, ranks, shape)
    for grains, c in zip(done.dump("grains.dump"), contacts(done), strict=True):
        who = list(zip(*(c[name] for name in FIELDS[:4]), strict=True))
        assert len(who) == len(set(who)) > SIDE**2 / 2
        assert (c["id1"] < c["id2"]).all()
        assert (c["id2"] > SIDE).all(), "walls act on each other"
        force = np.array([c["fx"], c["fy"]])
        total = np.zeros((3, SIDE**2))
        for end, sign in (("id1", 1), ("id2", -1)):
            i = c[end].astype(int) - 1
            arm = np.array([c["x"] - grains["x"][i], c["y"] - grains["y"][i]])
            arm -= PERIOD * np.round(arm / PERIOD)
            np.add.at(total.T, i, sign * np.array([*force, arm[0] * force[1] - arm[1] * force[0]]).T)
        largest = np.abs(force).max()
        for name, seen, unit in zip(("fx", "fy", "tqz"), total, (1, 1, SPACING), strict=True):
            assert seen == pytest.approx(grains[name], rel=0, abs=1e-12 * unit * largest), name
    assert set(c["sliding"]) == {0, 1}
    assert (len(set(zip(c["id1"], c["id2"], strict=True))) < len(who)) == (shape == "triple")
    if ranks > 1:
        alone = contacts(run_crowd(deck, tmp_path / "alone", law, 1, shape))[-1]
        assert same_bits(c, alone, set(FIELDS) - {"x", "y"})  # the point may be in another periodic image


def test_contacts_of_a_group_and_some_fields(tmp_path: Path) -> None:
    """Fields come in the order given; both grains must be in the group; also one column is an array."""
    deck = "".join(
        f"compute {name} {group} cdem/contacts {fields}\n" + dump("local", name, 1, f"c_{name}[*]")
        for name, group, fields in [("all", "all", "id2 fn id1"), ("some", "grains", "id1"), ("none", "walls", "id1")]
    )
    done = run_crowd(deck + "run 0\n", tmp_path, "direct", 2)
    every, some, none = (list(done.dump(f"{name}.dump")[0].columns.values()) for name in ("all", "some", "none"))
    id2, fn, id1 = every
    assert (id2 > id1).all() and (fn != np.round(fn)).any()
    assert sorted(some[0]) == sorted(id1[id1 > SIDE])
    assert 0 < len(some[0]) < len(id1)
    assert len(none) == 1 and len(none[0]) == 0


# --- discs, and dumps to draw ---------------------------------------------------------------------


def test_discs_and_dumps(tmp_path: Path, ranks: int) -> None:
    """A row per disc, with the angle it has turned; and the dumps have the form that OVITO reads."""
    columns = "id type x y z vx vy omegaz radius f_move[4] c_trm"
    deck = "compute discs all cdem/discs\n" + dump("cdem/local", "discs", 1000, "c_discs[*]")
    deck += "dump_modify discs label ATOMS\n" + TRM + dump("custom", "grains", 1000, columns) + "run 1000\n"
    done = free(tmp_path, deck, ranks)
    grains, discs = done.dump("grains.dump")[-1], done.dump("discs.dump")[-1]
    table = np.array(sorted(zip(*discs.columns.values(), strict=True)))
    expected = [grains[name] for name in ("id", "x", "y", "radius", "f_move[4]", "type", "z")]
    assert table[:, [0, 2, 3, 4, 5, 6, 7]].tolist() == np.transpose(expected).tolist()
    assert (table[:, 1] == 0).all()
    assert table[:, 5] == pytest.approx([0.1, -20, 0], rel=1e-12)  # omega t
    for name, what, names in [
        ("grains", "ATOMS", columns),
        ("discs", "ATOMS", "id disc x y radius angle type z"),
    ]:
        head = (tmp_path / f"{name}.dump").read_text().splitlines()[:9]
        assert [head[0], head[2], head[3]] == ["ITEM: TIMESTEP", f"ITEM: NUMBER OF {what}", "3"]
        assert head[4] == "ITEM: BOX BOUNDS pp pp pp"
        assert head[8].split() == ["ITEM:", what, *names.split()]


def test_local_dumps_with_names(tmp_path: Path, ranks: int) -> None:
    """As dump local, in every digit; columns have their fields' names, if only one does, and no blank ends a row."""
    deck = """
    compute   discs all cdem/discs id x radius
    compute   other all cdem/discs y x
    compute   stock all property/local patom1
    """
    for style in ("local", "cdem/local"):
        name = style.replace("/", "_")
        deck += dump(style, name, 10, "c_discs[3] c_discs[*] c_other[*]") + dump(style, f"{name}_stock", 10, "c_stock")
    free(tmp_path, deck + "run 10\nrun 10\n", ranks)
    for kind, names in (("", "c_discs[3] id c_discs[2] c_discs[3] y c_other[2]"), ("_stock", "c_stock")):
        plain, named = ((tmp_path / f"{style}{kind}.dump").read_text() for style in ("local", "cdem_local"))
        heads = [line for line in named.splitlines() if line.startswith("ITEM: ENTRIES")]
        assert heads == [f"ITEM: ENTRIES {names}"] * 3
        rows = [[line for line in text.splitlines() if "ENTRIES" not in line] for text in (plain, named)]
        assert [line.rstrip() for line in rows[0]] == rows[1]


@pytest.mark.parametrize("made", ["cdem/energy", "cdem/average solid", "reduce sum c_rows[2]"])
def test_a_compute_that_is_made_before_a_run_without_setup(tmp_path: Path, made: str) -> None:
    """Two runs of 10 steps, of which the second begins anew: what is seen at its start is what was seen at the end of the first."""
    deck = f"""variable seen equal 0
    thermo_style custom step v_seen
    thermo_modify format float %.17g
    thermo 10
    run 10
    compute rows all cdem/discs id y
    compute made all {made}
    variable seen equal c_made{"[1]" if "average" in made else ""}
    run 10 pre no
    print "end = $(c_made{"[1]" if "average" in made else ""}:%.17g)"
    run 0
    """
    done = free(tmp_path, deck)
    assert done.thermo["v_seen"][-1] == pytest.approx(done.printed("end"), rel=1e-12) != 0


def test_an_audit_may_not_begin_without_setup(tmp_path: Path) -> None:
    deck = "variable seen equal 0\nthermo_style custom step v_seen\nthermo 10\nrun 10\ncompute e all cdem/energy audit yes\n"
    deck += "variable seen equal c_e[10]\nrun 10 pre no\n"
    run(START, tmp_path, discs=FREE, bx="p", by="p")
    status, output = start(START + FREE_MOTION + deck, tmp_path, bx="p", by="p")
    assert status != 0 and "Compute cdem/energy e: the first run with an audit must not be 'pre no'" in output


def test_names_of_columns_are_those_of_the_compute_there_is(tmp_path: Path) -> None:
    """Made anew between two runs, with other fields under the same ID."""
    anew = "run 10\nuncompute discs\ncompute discs all cdem/discs radius y\nrun 10\n"
    free(tmp_path, "compute discs all cdem/discs id x\n" + dump("cdem/local", "discs", 10, "c_discs[*]") + anew)
    heads = [line for line in (tmp_path / "discs.dump").read_text().splitlines() if line.startswith("ITEM: ENTRIES")]
    assert heads == ["ITEM: ENTRIES id x", "ITEM: ENTRIES id x", "ITEM: ENTRIES radius y"]


def test_fields_of_discs_in_the_order_they_are_asked_for(tmp_path: Path) -> None:
    deck = "compute all all cdem/discs\ncompute some all cdem/discs radius type id\n"
    deck += dump("local", "all", 1000, "c_all[*]") + dump("local", "some", 1000, "c_some[*]") + "run 0\n"
    done = free(tmp_path, deck)
    everything, some = (list(done.dump(f"{name}.dump")[-1].columns.values()) for name in ("all", "some"))
    assert np.array(some).tolist() == np.array([everything[k] for k in (4, 6, 0)]).tolist()


def test_a_spinning_clump(tmp_path: Path, ranks: int) -> None:
    """Three touching discs of radius r = R/(1 + 2/sqrt(3)): their places, I = 11/6 m r^2, and R |omega|/|v| for TRM."""
    radius, omega, v, t = 4e-3, 30.0, (0.3, -0.4), 0.01
    r = radius / (1 + 2 / math.sqrt(3))
    mass = 3 * DENSITY * math.pi * r**2
    deck = """
    fix       shape all cdem/shape type 1 triple type 2 single density ${density}
    fix       move grains cdem/integrate dt any
    timestep  1e-5
    compute   trm grains cdem/trm
    compute   energy all cdem/energy
    compute   discs all cdem/discs
    thermo_style custom step c_trm c_energy[*]
    thermo_modify format float %.17g
    """
    deck += dump("local", "discs", 1000, "c_discs[*]") + "run 1000\n"
    done = run(START + deck, tmp_path, discs=[Disc(0, 0, 2 * radius, *v, omega)], ranks=ranks)
    table = np.array(sorted(zip(*done.dump("discs.dump")[-1].columns.values(), strict=True)))
    expected = []
    for k, degrees in enumerate([210, 330, 90]):
        turned = math.radians(degrees) + omega * t
        x, y = (v[0] * t + (radius - r) * math.cos(turned), v[1] * t + (radius - r) * math.sin(turned))
        expected.append([1, k, x, y, r, omega * t, 1, 0])
    assert table == pytest.approx(np.array(expected), rel=1e-11)
    spin = 11 / 6 * mass * r**2 * omega**2 / 2
    seen = {name: column[-1] for name, column in done.thermo.items()}
    assert seen["c_trm"] == pytest.approx(radius * omega / 0.5, rel=1e-11)
    assert [seen[f"c_energy[{k}]"] for k in (1, 2, 3)] == pytest.approx([mass * 0.5**2 / 2, spin, 0], rel=1e-11)


# --- energy ---------------------------------------------------------------------------------------


def test_energy_of_a_lossless_collision(tmp_path: Path, law: str, ranks: int) -> None:
    """Two equal discs meet head on with +-u and equal spins. With ks = kn/3 the tangential spring oscillates as fast as
    the normal one (m/6 against m/2): the shear velocity 2 omega r reverses without sliding, so the spins become
    -omega/3, and halfway omega/3, when the discs only have +-omega r/3 across the line of their centres."""
    r, u, omega, kn, steps = 2e-3, 1e-3, 0.2, 1e6, 1000
    mass = DENSITY * math.pi * r**2
    dt = math.pi * math.sqrt(mass / 2 / kn) / steps  # a contact lasts 1000 steps
    gap = 20 * dt * u
    discs = [Disc(sign * (r + gap / 2), 0, 2 * r, vx=-sign * u, omega=omega) for sign in (1, -1)]
    deck = """
    fix       move grains cdem/integrate
    timestep  ${dt}
    compute   energy all cdem/energy
    thermo_style custom step c_energy c_energy[*]
    thermo_modify format float %.17g
    thermo    10
    run       1100
    """
    table = run(
        START + deck, tmp_path, discs=discs, ranks=ranks, law=law, kn=kn, ks=kn / 3, hn=0, hs=0, phi=80, dt=dt
    ).thermo  # fmt: skip
    total, translation, rotation, springs = (table["c_energy" + k] for k in ("", "[1]", "[2]", "[3]"))
    straight, spin, across = mass * u**2, mass * r**2 * omega**2 / 2, mass * (omega * r) ** 2
    assert [translation[0], rotation[0], springs[0]] == pytest.approx([straight, spin, 0], rel=1e-12)
    assert total == pytest.approx(translation + rotation + springs, rel=1e-14)
    verlet = (
        math.pi / steps
    ) ** 2 / 4  # by as much the energy swings in a contact, relative to that of the oscillation
    assert total == pytest.approx(straight + spin, rel=1.1 * verlet)
    assert springs.max() == pytest.approx(straight + spin - across / 9 - spin / 9, rel=1.1 * verlet)
    after = [straight + across * 4 / 9, spin / 9, 0]
    assert [translation[-1], rotation[-1], springs[-1]] == pytest.approx(after, rel=1e-4)


def test_elastic_energy_of_known_overlaps(tmp_path: Path, law: str, ranks: int) -> None:
    """kn overlap^2/2 for every contact, counted once, also across a border of ranks; walls have none."""
    kn, overlap, r = 1e6, 1e-5, 2e-3
    discs = [Disc((k - 1.5) * (2 * r - overlap), 0, 2 * r, type=t) for k, t in enumerate([1, 1, 2, 2, 1])]
    deck = "fix move grains cdem/integrate dt auto\ncompute energy all cdem/energy\n"
    deck += "thermo_style custom step c_energy[3]\nthermo_modify format float %.17g\nrun 0\n"
    energy = run(START + deck, tmp_path, discs=discs, ranks=ranks, law=law, kn=kn, ks=kn).thermo["c_energy[3]"]
    assert energy == pytest.approx([3 * kn * overlap**2 / 2], rel=1e-9)


# --- they only look -------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", SWELLING)
def test_computes_do_not_change_the_trajectory(tmp_path: Path, law: str, ranks: int, shape: str) -> None:
    """The same bits with all of them at work at odd intervals, and with none."""
    watch = """
    compute trm all cdem/trm
    compute contacts all cdem/contacts
    compute discs all cdem/discs
    compute energy all cdem/energy
    thermo_style custom step c_trm c_energy c_energy[3]
    thermo 7
    dump c all local 11 contacts.dump c_contacts[*]
    dump d all local 13 discs.dump c_discs[*]
    dump t all custom 3 trm.dump id c_trm
    """
    end = "run 250\nrun 250\n" + END
    plain = run_crowd(end, tmp_path / "plain", law, ranks, shape)
    watched = run_crowd(watch + end, tmp_path / "watched", law, ranks, shape)
    assert same_bits(plain.end, watched.end)


# --- what is refused ------------------------------------------------------------------------------

STOCK = """
run_style verlet
unfix move
fix move all nve/sphere disc
pair_style gran/hooke 1e6 NULL 0 NULL 0 0
pair_coeff * *
"""
REFUSED: dict[str, tuple[str, Sequence[str]]] = {
    "unknown-field": ("compute c all cdem/contacts fn force", ["contacts c: unknown field force", "id1 id2 disc1"]),
    "trm-argument": ("compute c all cdem/trm 7", ["Compute cdem/trm c: unknown argument 7"]),
    "unknown-disc-field": ("compute c all cdem/discs x w", ["discs c: unknown field w; allowed: id disc x y radius"]),
    "energy-argument": ("compute c all cdem/energy 7", ["Compute cdem/energy c: unknown argument 7"]),
    "trm-unfixed": ("compute c all cdem/trm\nunfix CDEM_TRM_c\nrun 0", ["trm c: its fix CDEM_TRM_c is gone"]),
    "discs-no-pair": (STOCK + "compute c all cdem/discs\nrun 0", ["discs c needs pair_style cdem"]),
    "energy-no-pair": (STOCK + "compute c all cdem/energy\nrun 0", ["energy c needs pair_style cdem"]),
    "contacts-no-pair": (STOCK + "compute c all cdem/contacts\nrun 0", ["contacts c needs pair_style cdem"]),
}


@pytest.mark.parametrize(("deck", "messages"), REFUSED.values(), ids=REFUSED)
def test_refused(tmp_path: Path, deck: str, messages: Sequence[str]) -> None:
    run(START + FREE_MOTION + "run 0\n", tmp_path, discs=FREE, bx="p", by="p")  # without the mistake it runs
    status, output = start(START + FREE_MOTION + deck, tmp_path, bx="p", by="p")
    assert status != 0
    assert [m for m in messages if m not in output] == []
