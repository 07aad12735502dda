# SPDX-License-Identifier: GPL-2.0-or-later
"""The decks of input/ with a model of one's own, of grains of five discs, and the tools that read what they write."""

from __future__ import annotations

import math
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from engine import run, start
from input_decks import INPUT, SHEARING, SPECIMEN

from shearbox_tools.analysis.moments import Film, count_lost
from shearbox_tools.asking.grains import area_over_largest
from shearbox_tools.asking.models import read_model
from shearbox_tools.base.files import (
    CELLS_DUMP,
    CONSOLIDATED_RESTART,
    CONSOLIDATED_TABLE,
    CONTACTS_DUMP,
    DISCS_DUMP,
    GRAINS_DUMP,
)
from shearbox_tools.base.files import PACKED_TABLE, SHEAR_TABLE, SHEARED_RESTART
from shearbox_tools.frames.tables import Tables
from shearbox_tools.reading.dumps import Dump
from shearbox_tools.reading.readers import read_row, read_shear

D = 2e-3  # m, of the discs
GRAINS, WIDTH, HALF_HEIGHT = 40, 0.03, 0.012
CROSS = "5 5 1\n6 5 1 # to the right\n4 5 1\n5 6 1\n5 4 1\n"  # its circle has twice the diameter of a disc
MODEL = f"""
variable width       index {WIDTH}
variable half_height index {HALF_HEIGHT}
variable dmin        index {D}
variable dmax        index {D}
variable power       index 0
variable ngrains     index {GRAINS}
variable shape       index "file cross.txt"
"""
LOOSE = """
variable width       index 0.05
variable half_height index 0.025
variable dmin        index 4e-3
variable dmax        index 8e-3
variable power       index -2
variable ngrains     index 70
variable shape       index single
"""
OPTIONS: dict[str, Any] = SPECIMEN | {"model": "crosses"}
SHEAR = (INPUT / "shear.in").read_text()
TEST: dict[str, Any] = OPTIONS | SHEARING


def consolidate(folder: Path, **options: Any) -> None:
    """Packed first."""
    for deck in ("pack", "consolidate"):
        run((INPUT / f"{deck}.in").read_text(), folder, **options)


@pytest.fixture(name="folder", scope="module", params=[1, 2], ids="{}-ranks".format)
def _folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Packed, consolidated and sheared by 1 mm, all in one folder."""
    folder = tmp_path_factory.mktemp("own")
    (folder / "cross.txt").write_text(CROSS)
    (folder / "crosses.in").write_text(MODEL)
    consolidate(folder, **OPTIONS, models=folder, ranks=request.param)
    run(SHEAR, folder, **TEST, models=folder, ranks=request.param)
    return folder


def test_the_tables(folder: Path) -> None:
    """Columns are what their names say: the lower half has moved to the end of its travel, under the load of the lid,
    and work is shear stress times displacement less what lifts the lid."""
    packed, shear = read_row(folder / PACKED_TABLE), read_shear(folder / SHEAR_TABLE)
    assert packed["grains"] == GRAINS
    assert 0.6 < packed["solid_fraction"] < 0.95
    assert len(shear["step"]) == 20
    assert shear["displacement_mm"] == pytest.approx(np.sort(shear["displacement_mm"]))
    assert 0.9 < shear["displacement_mm"][-1] < 1
    assert np.mean(shear["sigma_kPa"]) == pytest.approx(100, rel=0.02)
    s, tau = shear["displacement_mm"], shear["tau_kPa"]
    pushed, lifted = np.sum((tau[1:] + tau[:-1]) / 2 * np.diff(s)), 100 * (shear["lid_mm"][-1] - shear["lid_mm"][0])
    work = 0.01 * WIDTH * (pushed - lifted)  # J, on an area in m^2: kPa mm are J/m^2
    assert work == pytest.approx(shear["work_J"][-1] - shear["work_J"][0], rel=0.1)
    assert np.all(np.abs(shear["residual_J"]) < 0.01 * shear["work_J"][-1])


@pytest.mark.parametrize(
    ("deck", "name", "value"),
    [("consolidate", "ngrains", 41), ("consolidate", "dmin", 1.9e-3), ("shear", "width", 0.031), ("shear", "half_height", 0.0121)],
)  # fmt: skip
def test_a_specimen_of_another_model_is_refused(folder: Path, deck: str, name: str, value: float) -> None:
    """The lid would press by another width, and solid fractions would be those of another box."""
    text = (INPUT / f"{deck}.in").read_text()
    options: dict[str, Any] = TEST | {"models": folder, name: value}
    status, output = start(text, folder, **options)
    assert status != 0 and "ERROR: this is a specimen of another model than crosses" in output
    assert "are 40, 30000, 12000, 4000; those of the model are" in output  # the circle of a cross is 4 mm wide


def test_a_floor_of_one_disc(tmp_path: Path) -> None:
    """From which the width cannot be told: it is not refused, and comes to rest under the stress with all of its grains, which
    keep their area."""
    sizes = {"width": 0.03, "half_height": 0.05, "dmin": 8e-3, "dmax": 9e-3, "ngrains": 36, "wall_disc": 4}
    options: dict[str, Any] = OPTIONS | {"models": tmp_path, "model": "loose"} | sizes
    (tmp_path / "loose.in").write_text(LOOSE)
    run((INPUT / "pack.in").read_text(), tmp_path, **options)
    text = (INPUT / "consolidate.in").read_text() + 'print "discs = $(count(floor))"\n'
    assert run(text, tmp_path, **options).printed("discs") == 1
    packed, at_rest = (read_row(tmp_path / table) for table in (PACKED_TABLE, CONSOLIDATED_TABLE))
    assert packed["grains"] == at_rest["grains"] == 36 and at_rest["sigma_kPa"] == 100
    assert at_rest["unbalanced"] < 1e-4
    area, before = (row["solid_fraction"] * row["height_m"] * 0.03 for row in (at_rest, packed))
    assert 36 * math.pi / 4 * 8e-3**2 < area < 36 * math.pi / 4 * 9e-3**2
    assert area == pytest.approx(before, rel=1e-5)  # solid fractions have six digits


def test_grains_that_pull_have_no_inertial_number(tmp_path: Path) -> None:
    """Sheared fast under a small stress grains lose each other, and dashpots of those that part pull: the mean stress may be a
    tension, of which there is no root."""
    (tmp_path / "loose.in").write_text(LOOSE)
    options: dict[str, Any] = OPTIONS | {"models": tmp_path, "model": "loose", "sigma": 1}
    consolidate(tmp_path, **options)
    options |= {"speed": 200, "travel": 3, "frames": 1}
    run(SHEAR, tmp_path, **options)
    rows = read_shear(tmp_path / SHEAR_TABLE)
    pressure = rows["stress_xx_kPa"] + rows["stress_yy_kPa"]
    assert pressure.min() < 0 and np.all(rows["inertial"][pressure <= 0] == 0)


@pytest.mark.parametrize("asked", [{"travel": 10, "flanges": 2}, {"travel": 0}, {"speed": 0}, {"sigma": -100}], ids=str)
def test_a_test_that_cannot_be_is_refused(folder: Path, asked: dict[str, float]) -> None:
    """The flanges were built to a quarter of the width, whatever shear is told of them, and end within a disc of it."""
    options: dict[str, Any] = TEST | {"models": folder} | asked
    status, output = start(SHEAR, folder, **options)
    assert status != 0 and (found := re.search(r"travel at most ([\d.]+) mm, the length of the flanges", output))
    assert 250 * WIDTH <= float(found[1]) <= 250 * WIDTH + 4


def test_halves_do_not_travel_past_each_other(tmp_path: Path) -> None:
    """However long the flanges are: of the area between the halves nothing would be left. Nor is a test all ramp."""
    (tmp_path / "loose.in").write_text(LOOSE)
    options: dict[str, Any] = OPTIONS | {"models": tmp_path, "model": "loose", "flanges": 1.2, "rest": 0.05}
    consolidate(tmp_path, **options)
    status, output = start(SHEAR, tmp_path, **options, travel=50)
    assert status != 0 and "ERROR: travel 50 mm: must be less than the width of the box, 50 mm" in output
    status, output = start(SHEAR, tmp_path, **options, ramp=0.5)
    assert status != 0 and "ERROR: ramp 0.5 must be from 0 to 0.4" in output


def test_frames_that_would_leave_out_the_end_are_refused(folder: Path) -> None:
    options: dict[str, Any] = TEST | {"models": folder, "frames": 3}
    status, output = start(SHEAR, folder, **options)
    assert status != 0 and "ERROR: frames 3: must divide the number of rows, 20" in output


def test_a_box_much_wider_than_high(tmp_path: Path) -> None:
    """Sixty times as wide as a half is high: cells.dump has one layer."""
    (tmp_path / "loose.in").write_text(LOOSE)
    sizes = {"width": 0.36, "half_height": 0.006, "ngrains": 120}
    options: dict[str, Any] = OPTIONS | {"models": tmp_path, "model": "loose"} | sizes
    consolidate(tmp_path, **options, rest=0.05)
    run(SHEAR, tmp_path, **options, rest=0.05, speed=200, travel=0.2, rows=2, frames=1)
    assert len(Dump(tmp_path / CELLS_DUMP, ("x", "y", "solid")).frame(0)["x"]) == 10


@pytest.mark.parametrize("sigma", [98, 200])
def test_a_specimen_of_another_stress_is_refused(folder: Path, sigma: float) -> None:
    """The lid would sink, or rise, as shear begins."""
    options: dict[str, Any] = TEST | {"models": folder, "sigma": sigma}
    status, output = start(SHEAR, folder, **options)
    assert status != 0 and re.search(rf"bears (99\.\d+|100(\.\d+)?) kPa, not sigma {sigma} kPa", output)


def test_stresses_are_in_balance(folder: Path) -> None:
    """Of the grains as a whole and of those above the plane between the halves, up to inertia: floor bears what comes
    through the plane and what the upper half's flanges press down, less what the lower sides bear; the horizontal forces
    on the upper half are the shear stress on the lower one. Means of the stress inside are those on the walls: normal
    stresses of floor and lid, and of the sides by their heights. Smooth sides bear what leans on their corners alone, and
    flat flanges no shear: all of it goes through the plane.
    """
    rows = read_shear(folder / SHEAR_TABLE)
    c = {name: column[10:].mean() for name, column in rows.items()}
    near = 0.03 * c["sigma_kPa"]  # 40 grains at 20 mm/s are not quite at rest
    floor = c["plane_kPa"] + c["flanges_upper_kPa"] - c["sides_lower_kPa"]
    assert c["floor_kPa"] == pytest.approx(floor, abs=near)
    assert rows["plane_tau_kPa"] == pytest.approx(rows["tau_upper_kPa"], rel=1e-8, abs=1e-6)
    assert c["tau_upper_kPa"] == pytest.approx(c["tau_kPa"], abs=near)
    facing = WIDTH / (WIDTH - 1e-3 * rows["displacement_mm"])
    assert rows["overlap_kPa"] == pytest.approx(rows["plane_kPa"] * facing, rel=1e-6)
    assert rows["overlap_tau_kPa"] == pytest.approx(rows["plane_tau_kPa"] * facing, rel=1e-6)
    assert c["left_lower_kPa"] > c["right_lower_kPa"] >= 0 and c["right_upper_kPa"] > c["left_upper_kPa"] >= 0
    pushed = (c["left_lower_kPa"] - c["right_lower_kPa"]) * HALF_HEIGHT / WIDTH
    assert pushed + c["floor_tau_kPa"] == pytest.approx(c["tau_kPa"], abs=near)
    assert c["stress_yy_kPa"] == pytest.approx((c["floor_kPa"] + c["sigma_kPa"]) / 2, rel=0.15)
    assert 0.6 < c["solid_fraction"] < 0.95 and 2 < c["coordination"] < 8
    assert c["fabric_xx"] + c["fabric_yy"] == pytest.approx(1, abs=1e-5)


def test_cells_make_up_the_specimen(folder: Path) -> None:
    """The area of the grains is all in them, but for what is between the discs of floor and lid; rows begin at the floor."""
    cells = Dump(folder / CELLS_DUMP, ("x", "y", "solid"))
    frame, columns = cells.frame(0), 10
    rows = len(frame["x"]) // columns
    assert rows == round(columns * 2 * HALF_HEIGHT / WIDTH)
    assert frame["x"][:columns] == pytest.approx(WIDTH / columns * (np.arange(columns) + 0.5))
    height = 2 * frame["y"].mean()
    cell = WIDTH / columns * height / rows
    cross = area_over_largest(read_model(folder / "crosses.in").shape) * D**2
    assert 0.95 < frame["solid"].sum() * cell / (GRAINS * cross) < 1.001


def test_five_discs_a_grain_where_they_belong(folder: Path) -> None:
    """Each half as large as the grain, one in the middle and four around it as the grain turns."""
    shear = read_shear(folder / SHEAR_TABLE)
    last = Film(folder, shear["step"], shear["displacement_mm"]).last()
    row = {i: k for k, i in enumerate(last.grains["id"])}
    discs = {name: column[~last.walls] for name, column in last.discs.items()}
    assert len(discs["id"]) == 5 * GRAINS == read_model(folder / "crosses.in").discs * GRAINS
    assert np.count_nonzero(last.grains["wall"] == 0) == GRAINS
    grain = np.array([row[i] for i in discs["id"]])
    assert discs["radius"] == pytest.approx(D / 2) and last.grains["radius"][grain] == pytest.approx(D)
    turn = last.grains["angle"][grain] + np.array([0, 0, np.pi, np.pi / 2, -np.pi / 2])[discs["disc"].astype(int)]
    arm = np.where(discs["disc"] == 0, 0, D / 2)
    assert discs["x"] == pytest.approx(last.grains["x"][grain] + arm * np.cos(turn), abs=1e-9)
    assert discs["y"] == pytest.approx(last.grains["y"][grain] + arm * np.sin(turn), abs=1e-9)


def test_walls_are_as_large_as_a_grain_and_known(folder: Path) -> None:
    grains = Dump(folder / GRAINS_DUMP, ("type", "x", "y", "radius", "wall", "lower", "lid"))
    before, after = (grains.frame(step) for step in (grains.steps[0], grains.steps[-1]))
    assert (before["wall"] == (before["type"] >= 2)).all()
    assert before["radius"][before["type"] == 2] == pytest.approx(D)
    assert before["radius"][before["type"] > 2] == pytest.approx(2 * D)  # pieces of smooth walls: as long, as thick
    lower = before["lower"] == 1
    assert before["y"][lower].max() < HALF_HEIGHT and before["y"][before["lid"] == 1].min() > HALF_HEIGHT
    assert (after["x"] - before["x"])[lower] == pytest.approx(1e-3, rel=1e-6)
    assert count_lost(folder, GRAINS, WIDTH, HALF_HEIGHT) == 0


def test_contacts_are_between_grains_that_touch(folder: Path) -> None:
    """The contact point is on both: within a radius of one of the discs of either grain, or of the line between those at
    the ends of a piece of a smooth wall."""
    shear = read_shear(folder / SHEAR_TABLE)
    last = Film(folder, shear["step"], shear["displacement_mm"]).last()
    discs = Dump(folder / DISCS_DUMP, ("id", "x", "y", "radius")).frame(int(shear["step"][-1]))
    assert len(last.contacts["fn"]) > GRAINS
    for x, y, *pair in zip(*(last.contacts[name] for name in ("x", "y", "id1", "id2"))):
        for grain in pair:
            mine = discs["id"] == grain
            centres = np.column_stack([discs["x"][mine], discs["y"][mine]])
            if len(centres) == 2:
                along = np.clip(np.dot([x, y] - centres[0], centres[1] - centres[0]) / (4 * D**2), 0, 1)
                centres = centres[:1] + along * (centres[1] - centres[0])
            reach = np.hypot(*(centres - [x, y]).T) - discs["radius"][mine][0]
            assert abs(reach.min()) < 0.01 * D


def test_asked_to_end_it_does_so_after_the_next_row(folder: Path, tmp_path: Path) -> None:
    """And goes on to the same bits, on another number of ranks; asked again, too. Of two ranks one gets the signal."""
    shutil.copy(folder / CONSOLIDATED_RESTART, tmp_path)
    asking = SHEAR.replace("\nrun         1\n", '\nshell "kill -USR1 $PPID"\nrun         1\n')
    assert asking != SHEAR
    going_on: dict[str, Any] = TEST | {"from": "c"}
    for row, options in ((1, TEST), (2, going_on)):
        run(asking, tmp_path, **options, models=folder, ranks=2)
        assert int((tmp_path / SHEAR_TABLE).read_text().splitlines()[-1].split()[0]) == row * first_row(folder)
        assert not (tmp_path / SHEARED_RESTART).exists()
    run(SHEAR, tmp_path, **going_on, models=folder)
    for name in (SHEAR_TABLE, GRAINS_DUMP):
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes(), name
    assert not list(tmp_path.glob("shear.restart.*"))


def first_row(folder: Path) -> int:
    """Its step."""
    return int(read_shear(folder / SHEAR_TABLE)["step"][0])


# --- what other programs make of the dumps --------------------------------------------------------


def last(folder: Path, dump: str, *columns: str) -> list[np.ndarray]:
    """Columns of the last frame, as the tools read them."""
    whole = Dump(folder / dump, columns)
    frame = whole.frame(whole.steps[-1])
    return [frame[name] for name in columns]


def test_ase_reads_grains_and_discs(folder: Path) -> None:
    """All frames and places; what ASE does not know by name, it drops, radii too."""
    io = pytest.importorskip("ase.io")
    for dump in (GRAINS_DUMP, DISCS_DUMP):
        frames = io.read(folder / dump, index=":", format="lammps-dump-text")
        ids, *places = last(folder, dump, "id", "x", "y")
        assert len(frames) == 3
        seen = frames[-1].positions  # in order of the ids; discs of one grain in any
        for k, place in enumerate([*places, 0 * ids]):
            np.testing.assert_allclose(np.sort(seen[:, k]), np.sort(place), atol=1e-12)
    x, angle = last(folder, GRAINS_DUMP, "x", "angle")
    atoms = io.read(folder / GRAINS_DUMP, index=-1, format="lammps-dump-text")
    np.testing.assert_allclose(atoms.positions[:, 0], x, atol=1e-12)
    np.testing.assert_allclose(atoms.arrays["v_angle"].ravel(), angle, rtol=1e-12)


@pytest.mark.filterwarnings("ignore")
def test_mdanalysis_reads_grains(folder: Path) -> None:
    """All frames and places, in single precision, from the corner of the box."""
    analysis = pytest.importorskip("MDAnalysis")
    seen = analysis.Universe(str(folder / GRAINS_DUMP), format="LAMMPSDUMP", topology_format="LAMMPSDUMP")
    assert len(seen.trajectory) == 3
    seen.trajectory[-1]
    x, y = last(folder, GRAINS_DUMP, "x", "y")
    bounds = [line.split() for line in (folder / GRAINS_DUMP).read_text().splitlines()[5:8]]
    corner = [float(low) for low, _ in bounds]
    np.testing.assert_allclose(seen.atoms.positions + corner, np.transpose([x, y, 0 * x]), atol=1e-8)


@pytest.mark.parametrize("separator", [" ", r"\s+"])
@pytest.mark.parametrize("dump", [GRAINS_DUMP, DISCS_DUMP, CONTACTS_DUMP, CELLS_DUMP])
def test_pandas_reads_every_dump(folder: Path, dump: str, separator: str) -> None:
    """The first frame, by the names in its head: no column has moved aside."""
    pandas = pytest.importorskip("pandas")
    lines = (folder / dump).read_text().splitlines()
    names = lines[8].split()[2:]
    table = pandas.read_csv(
        folder / dump, sep=separator, skiprows=9, nrows=int(lines[3]), names=names, float_precision="round_trip"
    )
    assert (table.index == range(len(table))).all() and table.notna().all(axis=None)
    columns = tuple(name for name in names if not name.startswith(("v_", "c_")))
    frame = Dump(folder / dump, columns).frame(0)
    for name in columns:
        assert (table[name] == frame[name]).all(), name


def test_the_time_of_a_frame_is_that_of_the_row_of_its_step(folder: Path) -> None:
    """The lower half moves at 20 mm/s, until it stops within the last interval."""
    shear = read_shear(folder / SHEAR_TABLE)
    assert set(Dump(folder / GRAINS_DUMP).steps) <= {0, *shear["step"]}
    moved, passed = (np.diff(shear[name])[2:-1] for name in ("displacement_mm", "time_s"))
    np.testing.assert_allclose(moved, 20 * passed, rtol=1e-6)
    assert shear["time_s"] / shear["step"] == pytest.approx(shear["time_s"][-1] / shear["step"][-1], rel=1e-8)


# --- what is exported -----------------------------------------------------------------------------


def test_forces_times_branches_are_the_load_of_the_walls(folder: Path) -> None:
    """Virial theorem: where the forces on each grain are in balance, the sum of forces times branches over all contacts is
    that of the forces of walls times the points where they act, with its sign turned. Before shear they are in balance to
    about 1e-4 of a force."""
    tables = Tables(folder)
    frame = tables.frame(tables.steps[0])
    contacts = frame["contacts"]
    assert len(frame["discs"]["id"]) == 5 * len(frame["grains"]["id"]) == 5 * GRAINS
    walls = frame["walls"]["id"]
    on_first, on_second = (np.isin(contacts[other], walls) for other in ("id2", "id1"))
    sign: np.ndarray = on_first.astype(float) - on_second  # of the force of a wall on its grain
    for force in ("fx", "fy"):
        for axis in "xy":
            inside = contacts[force] * contacts[f"branch_{axis}"]
            by_walls = -np.sum(sign * contacts[force] * contacts[axis])
            assert np.sum(inside) == pytest.approx(by_walls, abs=1e-3 * np.sum(np.abs(inside)))
