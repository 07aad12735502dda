# SPDX-License-Identifier: GPL-2.0-or-later
"""The decks of input/ with a model of one's own, of grains of five discs, and the tools that read what they write."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from engine import run

ROOT = Path(__file__).resolve().parents[2]
INPUT = ROOT / "input"
sys.path.insert(0, str(ROOT / "tools"))

from shearbox_tools.dumps import Dump  # noqa: E402
from shearbox_tools.files import CELLS_DUMP, DISCS_DUMP, GRAINS_DUMP, PACKED_TABLE, SHEAR_TABLE  # noqa: E402
from shearbox_tools.grains import area_over_largest  # noqa: E402
from shearbox_tools.models import read_model  # noqa: E402
from shearbox_tools.readers import read_row, read_shear  # noqa: E402
from shearbox_tools.specimen import Film, count_lost  # noqa: E402

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


@pytest.fixture(name="folder", scope="module", params=[1, 2], ids="{}-ranks".format)
def _folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Packed, consolidated and sheared by 1 mm, all in one folder."""
    folder = tmp_path_factory.mktemp("own")
    (folder / "cross.txt").write_text(CROSS)
    (folder / "crosses.in").write_text(MODEL)
    options = {"decks": INPUT, "models": folder, "model": "crosses", "sigma": 100, "seed": 1, "ranks": request.param}
    for deck in ("pack", "consolidate"):
        run((INPUT / f"{deck}.in").read_text(), folder, **options)
    run((INPUT / "shear.in").read_text(), folder, speed=20, travel=1, rows=20, frames=2, **options)
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


def test_stresses_are_in_balance(folder: Path) -> None:
    """Of the grains as a whole and of those above the plane between the halves, up to inertia: floor bears what comes
    through the plane and what the upper half's flanges press down, less what the lower sides bear; the horizontal forces
    on the upper half are the shear stress on the lower one. Means of the stress inside are those on the walls: normal
    stresses of floor and lid, and of the sides by their heights. Smooth sides bear what leans on their corners alone.
    """
    rows = read_shear(folder / SHEAR_TABLE)
    c = {name: column[10:].mean() for name, column in rows.items()}
    near = 0.03 * c["sigma_kPa"]  # 40 grains at 20 mm/s are not quite at rest
    floor = c["plane_kPa"] + c["flanges_upper_kPa"] - c["sides_lower_kPa"]
    assert c["floor_kPa"] == pytest.approx(floor, abs=near)
    corners = c["flanges_upper_kPa"] + c["flanges_lower_kPa"]  # which are round, and so bear some shear
    assert c["plane_tau_kPa"] == pytest.approx(c["tau_kPa"], abs=near + corners)
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
