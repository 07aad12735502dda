# SPDX-License-Identifier: GPL-2.0-or-later
"""A small bed of grains in a box with floor and lid, pushed about: no energy comes from nowhere, no grain is lost, and what
is at rest stays there. The box is that of mini_box.in; wall types 2 sides, 3 lid, 4 floor."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from bed import DT, LOAD, STRESS, WIDTH, energy, run_bed
from engine import Disc, Frame, Run, Table, run, same_bits

END = "include ${decks}/end.in\n"


def all_inside(state: Frame) -> bool:
    """Every grain's centre is between the sides, the floor and the lid."""
    grains = state["type"] == 1
    x, y = state["x"][grains], state["y"][grains]
    floor, lid = (state["y"][state["type"] == t][0] for t in (4, 3))
    return bool(np.all(np.abs(x) < WIDTH / 2) and np.all(y > floor) and np.all(y < lid))


def test_lid_dropped_on_the_bed(tmp_path: Path, law: str) -> None:
    """From 8 mm above, it hits the bed with 26 m/s, bounces and comes to rest, in all 15 MPa at its height. The energy is
    that of the fall until then, and only falls after, in every ten steps."""
    up = 0.008
    out = run_bed("thermo 10\nrun 30000\n" + END, tmp_path, lid_up=up, law=law)
    total, v = energy(out.thermo), out.thermo["f_lid[4]"]
    assert v.min() < -20 and v.max() > 0.1  # it fell and bounced
    assert np.diff(total).max() < 1e-6 * LOAD * up
    assert total[-1] < total[0] - 0.9 * LOAD * up
    assert abs(v[-1]) < 0.05 and out.thermo["f_lid[2]"][-500:].mean() == pytest.approx(STRESS, rel=0.02)
    assert all_inside(out.end)


def work(thermo: Table) -> np.ndarray:
    """Done on the grains by the floor since the first line of the output; one line a step, so that it is that of the
    trapezoidal rule, by which the steps are made."""
    force, s = -thermo["f_floor[3]"], thermo["f_floor[1]"]
    return np.concatenate([[0], np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(s))])


def test_shear_to_and_fro(tmp_path: Path, law: str) -> None:
    """The floor goes 1 mm to one side, back, and the same again: what is lost, the work put in less the energy gained,
    only grows, in every hundred steps; and the floor comes back to the last bit."""
    there_and_back = "".join(
        f"unfix floor\nfix floor floor cdem/move speed {speed} stop 1e-3\nrun 6000\n" for speed in (1, -1, 1, -1)
    )
    settle = "thermo 1000\nrun 10000\nwrite_dump floor custom before.dump id x y modify sort id format float %.17g\n"
    out = run_bed(settle + "thermo 1\n" + there_and_back + END, tmp_path, law=law)
    before = out.dump("before.dump")[0]
    floor = out.end["type"] == 4
    assert np.array_equal(before["x"], out.end["x"][floor]) and np.array_equal(before["y"], out.end["y"][floor])
    tables = tables_of(out)[1:]
    assert len(tables) == 4
    for table in tables:
        assert abs(table["f_floor[1]"][-1]) == pytest.approx(1e-3, abs=1e-12)
        lost = work(table) - (energy(table) - energy(table)[0])
        assert np.diff(lost[::100]).min() > -1e-3 * lost[-1]
        assert lost[-1] > 0.1 * 1e-3 * LOAD  # friction of a tenth of the load, all the way
    assert all_inside(out.end)


def tables_of(out: Run) -> list[Table]:
    """The thermo output of every run."""
    parts = re.findall(r"^ *Step .*?^Loop time", out.log, re.DOTALL | re.MULTILINE)
    return [Run(out.directory, part).thermo for part in parts]


def test_a_knock(tmp_path: Path, law: str) -> None:
    """All grains of a bed at rest get random velocities: it shakes, and comes to rest again, with the lid where it was
    within a tenth of a diameter. The energy falls from the knock on."""
    knock = "velocity grains create 3e20 4711 loop all dist gaussian\n"
    out = run_bed("thermo 100\nfix_modify move drag 1e-3\nrun 60000\n" + knock + "fix_modify move drag none\nrun 60000\n" + END,
                  tmp_path, law=law)  # fmt: skip
    before, after = tables_of(out)
    assert before["c_e"][-1] < 1.5 * after["c_e"][-1]  # at rest; the springs of two packings differ by a quarter
    total = energy(after)
    assert np.diff(total).max() < 2e-3 * (total[0] - total[-1])
    assert total[0] - total[-1] > 0.1
    assert abs(after["f_lid[4]"][-1]) < 1e-3 and after["f_lid[2]"][-1] == pytest.approx(STRESS, rel=1e-2)
    assert after["f_lid[3]"][-1] == pytest.approx(before["f_lid[3]"][-1], abs=4e-4)
    assert all_inside(out.end)


def test_a_quiet_bed_stays_where_it_is(tmp_path: Path, law: str) -> None:
    """Brought to rest by drag, then left alone: not a grain drifts. The residual velocities, 1e-11 m/s and less, are those
    whose dashpots hold what the last bit of a coordinate is to a spring, 2e-18 m x 1e8 N/m; a step of theirs is less than
    half of that bit. Only sums that begin at 0 go on, as the angle does. A grain that hardly touches may hop to and fro by
    some thousand bits, and one that hangs between two that turn goes with their rims; drift at such a speed would be 8
    times the tolerance. For 1e7 steps: tests/validation/long."""
    rest = "thermo 20000\nfix_modify move drag 1e-4\nrun 80000\nfix_modify move drag none\nrun 120000\n"
    watch = (
        "dump q all custom 20000 q.dump id x y vx vy f_move[4]\ndump_modify q sort id format float %.17g\nrun 200000\n"
    )
    out = run_bed(rest + watch, tmp_path, law=law)
    before, *_, after = out.dump("q.dump")
    for axis in "xy":
        assert np.abs(after[axis] - before[axis]).max() < 1e-13
        assert np.abs(after[f"v{axis}"]).max() < 2e-11
    assert np.abs(after["f_move[4]"] - before["f_move[4]"]).max() * 2e-3 < 2e-11 * 200000 * DT
    assert out.thermo["f_lid[2]"] == pytest.approx(STRESS, rel=1e-10)
    assert np.ptp(energy(out.thermo)) < 1e-13


CELL = f"""
include ${{decks}}/start.in
group bottom type 2
group top type 3
fix move grains cdem/integrate
fix bottom bottom cdem/move speed 20 ramp 1e-4
fix top top cdem/move speed 0
timestep {DT}
compute e grains cdem/energy
variable along atom mass*vx
compute p grains reduce sum v_along
thermo_style custom step c_e c_p f_bottom[1] f_bottom[3] f_top[3]
thermo_modify format float %.17g
thermo ${{every}}
run ${{steps}}
"""


def shear_cell() -> tuple[list[Disc], tuple[float, float, float, float]]:
    """Five rows of grains between two rows of wall discs, periodic in x."""
    d, n, rows = 4e-3, 8, 5
    random = np.random.default_rng(3)
    pitch = 0.88 * d
    discs = [
        Disc((i + 0.5) * d, y, d, type=t) for i in range(n) for y, t in ((-0.5 * d, 2), ((rows - 0.5) * pitch + d, 3))
    ]
    for j in range(rows):
        for i in range(n - j % 2):
            vx, vy = random.uniform(-1, 1, 2)
            discs.append(Disc((i + 0.5 + 0.5 * (j % 2)) * d, (j + 0.5) * pitch, random.uniform(0.85, 0.99) * d, vx, vy))
    return discs, (0, n * d, -0.01, 0.03)


def test_shear_cell_over_many_periods(tmp_path: Path, law: str) -> None:
    """A floor that runs through a periodic box five times drags the grains along, across its borders. Their momentum is
    the impulse of both walls, by the trapezoidal rule of the steps; energy is never more than the work put in."""
    discs, box = shear_cell()
    options: dict[str, Any] = {"discs": discs, "box": box, "bx": "p", "law": law, "skin": 2e-4}
    long = run(CELL + END, tmp_path / "long", steps=40000, every=1000, **options)
    assert long.thermo["f_bottom[1]"][-1] > 4.9 * box[1]
    assert long.end["vx"][long.end["type"] == 1].mean() > 2
    table = run(CELL, tmp_path / "short", steps=5000, every=1, **options).thermo
    force = -table["f_bottom[3]"] - table["f_top[3]"]
    impulse = DT * np.concatenate([[0], np.cumsum((force[1:] + force[:-1]) / 2)])
    momentum = table["c_p"] - table["c_p"][0]
    assert momentum == pytest.approx(impulse, abs=1e-9 * np.abs(momentum).max())
    bottom = -table["f_bottom[3]"]
    put_in = np.concatenate([[0], np.cumsum((bottom[1:] + bottom[:-1]) / 2 * np.diff(table["f_bottom[1]"]))])
    lost = put_in - (table["c_e"] - table["c_e"][0])
    assert np.diff(lost[::50]).min() > -1e-2 * lost[-1]
    assert lost[-1] > 0.1 * put_in[-1]


@pytest.mark.parametrize(("law", "ranks"), [("direct", 2), ("incremental", 4)])
def test_shear_cell_on_any_number_of_ranks(tmp_path: Path, law: str, ranks: int) -> None:
    """The same bits. A coordinate is rounded when it is taken back into the box, at a rebuild: so these must come at the
    same steps, too."""
    discs, box = shear_cell()
    options: dict[str, Any] = {
        "discs": discs,
        "box": box,
        "bx": "p",
        "law": law,
        "skin": 2e-4,
        "steps": 9000,
        "every": 1000,
    }
    alone, out = run(CELL + END, tmp_path / "1", **options), run(CELL + END, tmp_path / "n", ranks=ranks, **options)
    assert alone.thermo["f_bottom[1]"][-1] > box[1]
    assert same_bits(alone.end, out.end)
