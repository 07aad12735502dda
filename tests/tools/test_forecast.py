# SPDX-License-Identifier: GPL-2.0-or-later
"""How long a run will take, before it begins."""

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import synthetic

from shearbox_tools.asking.models import find_model
from shearbox_tools.asking.request import Request
from shearbox_tools.commands.run import forecast_text
from shearbox_tools.reading.readers import BED
from shearbox_tools.running.forecast import Forecast, memory_of_all, time_step, total
from shearbox_tools.running.phases import SHEAR, Phase, packing, shearing, steps_between_frames
from shearbox_tools.running.run_folders import Run

GOODBYE = "Total wall time: 0:00:01\n"


def request(name: str = "TypeA_10x5_4-8_1-circle_350") -> Request:
    return Request(find_model(name), (100.0, 200.0), speed=20.0)


def seconds(line: str) -> float:
    found = re.search(r"about (\d+) (s|min)", line)
    assert found
    amount, unit = found.groups()
    return float(amount) * {"s": 1, "min": 60}[unit]


def finish(phase: Phase) -> None:
    """What a phase leaves behind, less its log."""
    if phase.name == SHEAR:
        synthetic.write_shear(phase.folder / phase.product, synthetic.curves(100, 8))
    else:
        synthetic.write_row(phase.folder / phase.product, **dict.fromkeys(BED, 1.0))
    phase.seal()


def test_time_step_without_damping_is_that_of_the_lattice() -> None:
    """2 sqrt(m / (6 k_n + 3 k_s)), of which auto takes 0.9; and never more than dt_max."""
    asked = replace(request(), settings={"hn": "0", "hs": "0", "dt_max": "1e-4"})
    mass = 26.5 * 3.141592653589793 * 0.002**2
    assert time_step(asked) == pytest.approx(0.9 * 2 * (mass / 6.75e8) ** 0.5)
    assert time_step(replace(asked, stiffness=0.25)) == pytest.approx(2 * time_step(asked))
    assert time_step(replace(asked, settings={"dt_max": "1e-8"})) == 1e-8
    assert time_step(replace(asked, dt="5e-7")) == 5e-7


def test_what_is_not_as_usual_is_told(tmp_path: Path) -> None:
    head, *settings = Forecast(tmp_path, request()).head.split("\n")
    assert head.startswith("TypeA_10x5_4-8_1-circle_350: 350 grains") and not settings
    asked = replace(request(), law="incremental", dt="1e-7", stiffness=2.0, settings={"phi": "30"})
    told = ["law = incremental", "dt = 1e-7", "stiffness = 2.0", "phi = 30"]
    assert Forecast(tmp_path, asked).head.split("\n")[1:] == told


def test_each_run_is_told_under_its_own_settings(tmp_path: Path) -> None:
    """Runs of a campaign take turns."""
    asked = [replace(request(), seed=seed, law=law) for seed in (1, 2) for law in ("direct", "incremental")]
    runs = [Run(tmp_path / f"{one.law}_{one.seed}", one, f"{one.law}_{one.seed}") for one in asked]
    text = forecast_text(runs, [Forecast(run.folder, run.request) for run in runs])
    direct, incremental = text.split("law = incremental\n")
    assert [line.split(":")[0] for line in incremental.split("\n")] == ["incremental_1", "incremental_2"]
    assert [line.split(":")[0] for line in direct.split("\n")][1:3] == ["direct_1", "direct_2"]


def test_time_goes_with_grains_and_jobs(tmp_path: Path) -> None:
    small, large = Forecast(tmp_path, request()), Forecast(tmp_path, request("TypeD_30x10_2-4_1-circle_9000"))
    one, two = small.seconds_with(1), small.seconds_with(2)  # to more digits than are printed
    assert two < one < 2 * two < large.seconds_with(2), "nothing runs beside the packing"
    assert seconds(total([small], 1)) == pytest.approx(one, abs=0.5)
    assert seconds(total([small] * 8, 2)) == pytest.approx(4 * one, rel=0.05), "but that of another specimen"


def test_what_runs_at_a_time_is_told_with_the_time(tmp_path: Path) -> None:
    """Two tests at most of one with two stresses; the lines of phases are one after the other, and none is of the report."""
    told = {jobs: total([Forecast(tmp_path, request())], jobs) for jobs in (1, 2, 8)}
    assert "s one phase after the other, without the report; " in told[1]
    assert all("s with 2 phases at a time, without the report; " in told[jobs] for jobs in (2, 8))


def test_memory_goes_with_discs_ranks_and_tests_at_a_time(tmp_path: Path) -> None:
    """While they were sheared, with frames, two ranks of a million discs had 1305 MB each, one of 9000 discs 72 MB."""
    large, middle, small = (
        replace(request(f"TypeD_100x30_2-4_1-circle_{count}"), stresses=(200.0,)) for count in (1_000_000, 9000, 350)
    )
    for asked, ranks, megabytes in (large, 2, 2610), (middle, 1, 72):
        assert Forecast(tmp_path, asked, ranks).memory == pytest.approx(1e6 * megabytes, rel=0.1)
    one = Forecast(tmp_path, large, 2)
    assert memory_of_all([one], 8) == one.memory, "one test can't be shared by jobs"
    assert memory_of_all([one, Forecast(tmp_path, small), one], 2) == 2 * one.memory


def test_ranks_share_the_grains(tmp_path: Path) -> None:
    """Four ranks take a quarter of the time, but for the frames, which one of them writes."""
    asked = replace(request("TypeD_30x10_2-4_1-circle_9000"), settings={"frames": "1"})
    assert Forecast(tmp_path, asked).seconds == pytest.approx(4 * Forecast(tmp_path, asked, 4).seconds, rel=0.01)


@pytest.mark.parametrize("ranks, loop", [(1, 35), (2, 17.5)])
def test_the_speed_of_the_packing_that_is_done_here(tmp_path: Path, ranks: int, loop: float) -> None:
    """A microsecond of a core for a disc and step: 22 times as slow as usual, and so is shear, whatever the ranks of either. What
    is done takes no more time."""
    pack = packing(tmp_path, request())
    pack.folder.mkdir()
    log = f"Loop time of {loop} on {ranks} procs for 100000 steps with 500 atoms\n{GOODBYE}"
    pack.log.write_text(log, encoding="utf-8")
    finish(pack)
    slow = Forecast(tmp_path, request())
    assert "556 ns a disc and step" in total([slow], 2) and "pack: done" in slow.lines
    for phase in (phase for sigma in (100, 200) for phase in shearing(tmp_path, request(), sigma)):
        phase.folder.mkdir(exist_ok=True)
        finish(phase)
    assert total([Forecast(tmp_path, request())], 2).startswith("under 1 s ")


def test_steps_of_packing_are_those_that_were_measured(tmp_path: Path) -> None:
    """Within the factor of 2 that is told, for all models of the paper, and in a box four times as high as any of theirs."""
    table = (Path(__file__).parents[1] / "validation" / "packing" / "measured" / "now.md").read_text(encoding="utf-8")
    measured = {name: int(steps.replace(",", "")) for name, steps in re.findall(r"\| (Type\S+) \| ([\d,]+)", table)}
    assert len(measured) == 14
    measured["TypeD_120x40_2-4_1-circle_144000"] = 133_000
    for name, steps in measured.items():
        found = re.search(r"about ([\d,]+) steps", Forecast(tmp_path, request(name)).lines[0])
        assert found and steps / 2 < int(found[1].replace(",", "")) < 2 * steps, name


@pytest.mark.parametrize(
    "settings, steps",
    [
        ({}, 24_000),
        ({"kn": "1e9", "ks": "2.5e8"}, 72_000),
        ({"kn": "1e11", "ks": "2.5e10"}, 915_000),
        ({"width": "1", "half_height": ".5", "dmin": ".04", "dmax": ".08"}, 95_000),  # held by dt_max
        ({"width": "10", "half_height": "5", "dmin": ".4", "dmax": ".8"}, 800_000),
    ],
)
def test_steps_of_packing_where_the_time_step_is_not_as_usual(
    tmp_path: Path, settings: dict[str, Any], steps: int
) -> None:
    """As the engine took them, within the factor of 2 that is told."""
    of_model = {name: value for name, value in settings.items() if not name.startswith("k")}
    asked = replace(request(), model=find_model(request().model.name, of_model), settings=settings)
    found = re.search(r"about ([\d,]+) steps", Forecast(tmp_path, asked).lines[0])
    assert found and steps / 2 < int(found[1].replace(",", "")) < 2 * steps


@pytest.mark.parametrize(
    "name, settings, megabytes",
    [
        ("TypeA_10x5_4-8_1-circle_350", {}, 14.0),
        ("TypeA_10x5_4-8_1-circle_350", {"sides": "discs", "wall_disc": "0.2", "side_pitch": "0.25"}, 34.3),
        ("TypeB_15x5_2-4_1-circle_2250", {}, 80.4),
    ],
)
def test_disk_is_what_dumps_took(tmp_path: Path, name: str, settings: dict[str, Any], megabytes: float) -> None:
    """Of one test, as it was written by the engine; in the second there are six times as many discs of walls as grains."""
    asked = replace(request(name), stresses=(100.0,), settings=settings)
    assert Forecast(tmp_path, asked).bytes == pytest.approx(1e6 * megabytes, rel=0.15)


def test_disk_of_a_large_box_is_that_of_its_restart_files(tmp_path: Path) -> None:
    """A million discs, two frames: dumps of 0.79 GB, restart files of three phases 1.12 GB, and two of shear meanwhile 0.79 GB. What is
    done needs no more."""
    asked = request("TypeD_330x105_2-4_1-circle_1000000")
    asked = replace(asked, stresses=(200.0,), settings={"frames": "1"})
    forecast = Forecast(tmp_path, asked)
    assert forecast.disk == pytest.approx(2.7e9, rel=0.15)
    for phase in forecast.phases:
        phase.folder.mkdir(exist_ok=True)
        finish(phase)
    assert Forecast(tmp_path, asked).disk == 0


def test_disk_is_needed_for_what_is_left(tmp_path: Path) -> None:
    """One stress is done, the other half: of its 800 rows there is a restart file of row 400. When that is stopped, its frames are
    read in full."""
    whole = Forecast(tmp_path, request())
    assert whole.bytes == whole.bytes_of_frames > 0
    one = whole.bytes / 2
    done, half = (shearing(tmp_path, request(), sigma)[1] for sigma in (100, 200))
    done.folder.mkdir()
    finish(done)
    assert whole.bytes == whole.bytes_of_frames == pytest.approx(one)
    half.folder.mkdir()
    synthetic.write_shear(half.folder / half.product, synthetic.curves(200, 8), slice(0, 400))
    synthetic.write_restart(half.folder / "shear.restart.a", 400 * synthetic.STEPS_PER_ROW)
    assert whole.bytes == pytest.approx(one / 2, rel=0.01) and whole.bytes_of_frames == pytest.approx(one)
    assert Forecast(tmp_path, replace(request(), host="liggghts")).bytes == 0, "it writes no frames"


def test_frames_that_are_asked_for(tmp_path: Path) -> None:
    """Of the disk and the time that frames take, 21 of 101; the interval of frames is a whole number of rows."""
    few, usual = (Forecast(tmp_path, replace(request(), settings=s)) for s in ({"frames": "20"}, {}))
    assert few.bytes == pytest.approx(usual.bytes * 21 / 101, rel=1e-5) and few.seconds < usual.seconds
    assert steps_between_frames(few.phases[-1].variables, 500) == 500 * 40
    assert steps_between_frames(usual.phases[-1].variables, 500) == 500 * 8
