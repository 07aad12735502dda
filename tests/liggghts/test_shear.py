# SPDX-License-Identifier: GPL-2.0-or-later
"""The test itself, with the decks of LIGGGHTS."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import engine
import numpy as np
import pytest
from host import HERE, Disc, Frame
from host import run as run_discs
from host import start
from same_grains import INPUT, consolidated, hand_over, run, sheared

SMALL: dict[str, Any] = {"width": 0.03, "half_height": 0.015, "ngrains": 30}
# 6000 steps, in which the lower half reaches its speed, the grains begin to slide and neighbour lists are built again
SHEAR: dict[str, Any] = {"dt": 4e-7, "speed": 4, "travel": 0.008, "ramp": 0.2, "rows": 100, "skin": 2e-4}


@pytest.fixture(scope="module")
def grains(tmp_path_factory: pytest.TempPathFactory) -> Frame:
    return consolidated(tmp_path_factory.mktemp("packed"), **SMALL)


@pytest.mark.parametrize("how", [("direct", 1), ("direct", 2), ("incremental", 1)], ids="{0[0]}-{0[1]}-ranks".format)
def test_both_engines_shear_the_same_grains_alike(tmp_path: Path, grains: Frame, how: tuple[str, int]) -> None:
    """They differ by the order in which forces are summed, which grows as a change of the last bit of a coordinate does:
    to 1e-6 of the kinetic energy in 10000 steps (tests/validation/liggghts). LAMMPS tells energy and TRM to six digits.
    """
    law, ranks = how
    for who in ("lammps", "liggghts"):
        hand_over(grains, who, tmp_path / who)
    one = sheared("lammps", tmp_path / "lammps", **SMALL, **SHEAR, law=law, audit="no")
    other = sheared("liggghts", tmp_path / "liggghts", ranks, **SMALL, **SHEAR, law=law)
    assert one["tau_kPa"].max() > 10 and len(one["step"]) == SHEAR["rows"]
    tolerances = dict.fromkeys(
        ("displacement_mm", "tau_kPa", "tau_upper_kPa", "lid_tau_kPa", "sigma_kPa", "lid_mm"), 1e-7
    )
    for name, tolerance in (tolerances | {"step": 0, "trm": 1e-5, "kinetic_J": 1e-5}).items():
        assert np.abs(one[name] - other[name]).max() <= tolerance * np.abs(one[name]).max(), name


def test_a_travel_beyond_the_flanges_is_refused(tmp_path: Path, grains: Frame) -> None:
    """They were built for a quarter of the width, 7.5 mm, and end within a disc of it."""
    hand_over(grains, "liggghts", tmp_path)
    _, output = start("include ${decks}/shear.in", tmp_path, decks=INPUT / "liggghts", **SMALL, travel=13)
    found = re.search(r"ERROR: .* travel at most ([\d.]+) mm", output)
    assert found and 7.5 <= float(found[1]) <= 12
    assert not (tmp_path / "shear.dat").exists()


@pytest.mark.parametrize(
    ("variables", "error"),
    [
        ({"model": "TypeA_10x5_2-4_3-circle_350"}, "shape triple, phi_packing 0: here grains are single discs"),
        ({"phi_packing": 45}, "shape single, phi_packing 45: here grains are single discs, packed without friction"),
        ({"shape": "discs 2 0 0 1 1 0 1"}, "Illegal variable command"),
    ],
)
def test_what_cannot_be_packed_is_refused(tmp_path: Path, variables: dict[str, Any], error: str) -> None:
    options: dict[str, Any] = {"decks": INPUT / "liggghts"} | variables
    _, output = start("include ${decks}/pack.in", tmp_path, **options)
    assert error in output
    assert not (tmp_path / "packed.csv").exists() and "Created 350 discs" not in output


@pytest.mark.parametrize(
    ("region", "error"),
    [
        ("0 0.02 0 0.02 diameter 0.004 0.002", "diameter 0.004 0.002: must be DMIN <= DMAX"),
        ("0 0.02 0 0.02 diameter 0.002 0.03", "grains of diameter 0.03 do not fit in the width 0.02 of the region"),
        ("0.02 0 0 0.02 diameter 0.002 0.004", "region 0.02 0 0 0.02: must be XLO < XHI, YLO < YHI"),
        ("0 0.02 0 0.002 diameter 0.002 0.004", "fill a height of"),
    ],
)
def test_grains_that_cannot_be_made_are_refused(tmp_path: Path, region: str, error: str) -> None:
    fill = f"cdem/create 1 fill 20 region {region} power 0 density 26.5 seed 1\n"
    run_discs("include ${decks}/start.in\n", tmp_path, [Disc(0, 0)])
    status, output = start("include ${decks}/start.in\n" + fill, tmp_path)
    assert status != 0 and f"cdem/create: {error}" in output.replace("20 grains of diameter 0.002 to 0.004 ", "")


@pytest.mark.parametrize(
    ("motion", "works"), [("0.5", True), ("0.5 stop 1", True), ("0.4", False), ("0.5 dir y", False)]
)
def test_a_wall_goes_on_from_a_restart_file_on_its_path_alone(tmp_path: Path, motion: str, works: bool) -> None:
    begin = (HERE / "start.in").read_text(encoding="utf-8")
    data = "read_data    discs.data\nset          group all density 26.5\n"
    assert data in begin
    fixes = "fix move grains cdem/integrate dt any\nfix floor walls cdem/move speed {}\ntimestep 1e-6\nrun 100\n"
    discs = [Disc(0, 0.01), Disc(0, 0, type=2)]
    run_discs(begin + fixes.format("0.5") + "write_restart moved.restart\n", tmp_path, discs)
    go_on = begin.replace(data, "read_restart moved.restart\n") + fixes.format(motion)
    status, output = start(go_on + 'print "s = $(f_floor[1])"\n', tmp_path)
    if works:
        assert "s = 0.0001\n" in output or "s = 9.99" in output
    else:
        assert status != 0
        assert "Fix cdem/move floor: in the restart file the wall has moved by 5e-05 m along x in 0.0001 s" in output


def test_packing_and_consolidation_end_at_rest(tmp_path: Path) -> None:
    """No grain spins as shear begins, though all did after packing: a loose one would do so through all of it, and its TRM
    is without bounds. In the mean over shear the lid feels the stress that is applied, less its inertia."""
    spun = "fix_modify motion omega 10\nwrite_restart packed.restart"
    run("liggghts", f"pack.in\n{spun}", tmp_path, **SMALL)
    dump = "dump d all custom 1 rest.dump id type x y radius omegaz vx vy\nrun 0"
    run("liggghts", f"consolidate.in\n{dump}", tmp_path, **SMALL)
    end = engine.read_dump(tmp_path / "rest.dump")[-1]
    assert np.abs(end["omegaz"] * end["radius"]).max() < 1e-4  # m/s, of 2e-2 and more after packing
    curve = sheared("liggghts", tmp_path, **SMALL, **SHEAR)
    assert curve["sigma_kPa"].mean() == pytest.approx(100, rel=1e-3)


def test_drag_and_spin_are_changed_between_runs(tmp_path: Path) -> None:
    """dv/dt = -v/T, which the velocity of the half step makes of first order: dt/2T = 3e-4. Without drag nothing changes."""
    deck = """
    include ${decks}/start.in
    fix move grains cdem/integrate
    timestep 5e-7
    fix_modify move drag 1e-3
    dump d grains custom 2000 drag.dump id vx omegaz
    dump_modify d format "%d %.17g %.17g"
    run 2000
    fix_modify move drag none
    fix_modify move omega 3
    run 2000
    """
    out = run_discs(deck, tmp_path, [Disc(0, 0, vx=0.01, omega=7.0)])
    speed, spin = (out.series("drag.dump", name)[:, 0] for name in ("vx", "omegaz"))
    assert speed[1] == pytest.approx(0.01 * np.exp(-1), rel=1e-3)
    assert speed[2] == pytest.approx(speed[1], rel=1e-12)
    assert list(spin) == pytest.approx([7, 7, 3], rel=1e-12)
