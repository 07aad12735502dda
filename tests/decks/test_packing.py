# SPDX-License-Identifier: GPL-2.0-or-later
"""pack.in: even from floor to lid, in steps that the height of the box does not count in, to the same bits on any ranks."""

from __future__ import annotations

import re
import shutil
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

import pytest
from engine import DECKS, ENVIRONMENT, PROGRAM, Frame, run, start
from input_decks import INPUT

from shearbox_tools.asking.models import find_model
from shearbox_tools.asking.named import model_text
from shearbox_tools.asking.parameters import parameters
from shearbox_tools.base.files import CONSOLIDATED_TABLE, PACKED_RESTART, PACKED_TABLE, SHEAR_TABLE
from shearbox_tools.base.presets import DENSITIES, PACKING_FRICTION
from shearbox_tools.base.restarts import step_of
from shearbox_tools.reading.readers import read_row

SMALL = "TypeA_4x2_2-4_1-circle_auto"


def deck(folder: Path, name: str, friction: float = 0.0) -> tuple[str, dict[str, Any]]:
    """pack.in and its variables; the file of the model is in the folder."""
    text = model_text(name, friction)
    assert text
    folder.mkdir(exist_ok=True)
    (folder / f"{name}.in").write_text(text, encoding="utf-8")
    options = {"decks": INPUT, "models": ".", "model": name, PACKING_FRICTION: friction}
    return (INPUT / "pack.in").read_text(encoding="utf-8"), options


def pack(folder: Path, name: str, friction: float = 0.0) -> dict[str, float]:
    """The row that it writes of a model of that name."""
    text, options = deck(folder, name, friction)
    run(text, folder, **options)
    return read_row(folder / PACKED_TABLE)


def test_the_same_bits_on_any_ranks(tmp_path: Path) -> None:
    """Up to where grains have collided, walls above the lid are gone, and the lid presses: what comes then is as in a bed."""
    ends = []
    for ranks in (1, 2, 4):
        text, options = deck(tmp_path / str(ranks), "TypeA_2x1_2-4_1-circle_auto")
        compact, _, press = text.partition('if "$(is_defined(group,pressed)) == 0"')
        assert press
        compact += f"run 200\ninclude {DECKS}/end.in\n"
        ends.append(run(compact, tmp_path / str(ranks), ranks=ranks, **options).end)
    assert all(set(ends[0].columns) == set(end.columns) for end in ends)
    assert all((ends[0][name] == end[name]).all() for end in ends for name in end.columns)


def test_ranks_share_the_grains_and_the_bits(tmp_path: Path) -> None:
    """Of four ranks with equal shares of the box, side by side, two would have flanges and no grains."""
    name, written = "TypeA_6x1_2-4_1-circle_auto", []
    pack(tmp_path, name)
    for ranks in (1, 4):
        folder = tmp_path / str(ranks)
        _, options = deck(folder, name)
        for phase in ("consolidate", "shear"):
            text = (INPUT / f"{phase}.in").read_text(encoding="utf-8")
            given: dict[str, Any] = {"packed": tmp_path / PACKED_RESTART, "speed": 200, "travel": 0.1}
            out = run(text, folder, ranks=ranks, **options | given, rows=4, frames=1)
            if ranks == 4:
                found = re.search(r"initial/final imbalance factor += ([\d.]+) ([\d.]+)", out.log)
                assert found and float(found[1]) > 1.8 and float(found[2]) < 1.2
        written.append([(folder / name).read_bytes() for name in (CONSOLIDATED_TABLE, SHEAR_TABLE)])
    assert written[0] == written[1]


def test_a_high_box_is_even_and_takes_few_steps(tmp_path: Path) -> None:
    """A lid that sweeps the column at 2 m/s would take 0.8 x 0.2 m/(2 m/s) = 80 ms, more than 200,000 steps of 4e-7 s at
    most, and the grains below it would not know of it until it comes."""
    row = pack(tmp_path, "TypeA_2x10_2-4_1-circle_auto")
    assert row["steps"] < 100_000
    assert row["solid_fraction_bottom"] == pytest.approx(row["solid_fraction_top"], rel=0.01)


def test_friction_makes_it_loose(tmp_path: Path) -> None:
    """By more than 200 grains scatter; and COUNT auto knows of it: the lid lies at the height of the box."""
    rows = {name: pack(tmp_path, SMALL, friction=angle) for name, angle in DENSITIES.items()}
    solid = {name: row["solid_fraction"] for name, row in rows.items()}
    assert solid["dense"] > solid["medium"] > solid["loose"]
    assert solid["dense"] > 1.02 * solid["loose"]
    for row in rows.values():
        assert row["height_m"] == pytest.approx(0.04, rel=0.02)  # 200 grains scatter by some 0.5 %


@pytest.mark.parametrize("name", ["TypeA_6x3_T-2_1-circle_auto", "TypeA_8x4_2-4_3-circle_auto"])
def test_as_many_as_fill_the_box(tmp_path: Path, name: str) -> None:
    """Equal discs, which crystallise, and grains of three discs."""
    assert pack(tmp_path, name)["height_m"] == pytest.approx(2 * find_model(name).half_height, rel=0.01)


CHECKPOINTS = [f"{PACKED_RESTART}.{letter}" for letter in "abc"]
BETWEEN = 3200  # steps between checkpoints


def go_on(folder: Path) -> dict[str, Any]:
    """The variable that says where to go on: from the latest checkpoint, as `shearbox run` does."""
    steps = {name[-1]: step for name in CHECKPOINTS if (step := step_of(folder / name)) is not None}
    return {"from": max(steps, key=lambda name: steps[name])} if steps else {}


def as_packed(folder: Path) -> tuple[dict[str, float], Frame]:
    """Its row, and the grains and walls of its restart file."""
    text = f"newton off\nread_restart {PACKED_RESTART}\n"
    text += "pair_style cdem law direct\npair_coeff * * 1e8 2.5e7 0.2 0.2 27\nfix motion all cdem/integrate dt any\n"
    return read_row(folder / PACKED_TABLE), run(text + f"include {DECKS}/end.in\n", folder).end


@pytest.mark.parametrize("name", ["TypeA_4x2_2-4_1-circle_auto", "TypeA_4x2_2-4_3-circle_auto"])
def test_stopped_at_every_checkpoint_it_goes_on_to_the_same_bits(tmp_path: Path, name: str) -> None:
    """Decks that end at each checkpoint, so that all stages are stopped; on other ranks each time."""
    pack(tmp_path / "whole", name)
    decks, folder = tmp_path / "decks", tmp_path / "stopped"
    shutil.copytree(INPUT, decks)
    stage = (decks / "stage.in").read_text(encoding="utf-8")
    checkpoint = "write_restart ${product}.restart.${put}\n"
    assert checkpoint in stage
    (decks / "stage.in").write_text(stage.replace(checkpoint, checkpoint + "quit\n"), encoding="utf-8")
    text, options = deck(folder, name)
    starts = 0
    while not (folder / PACKED_TABLE).exists():
        start: dict[str, Any] = options | {"decks": decks, "save": BETWEEN} | go_on(folder)
        run(text, folder, ranks=1 + starts % 2, **start)
        starts += 1
    assert starts > 5 and not any((folder / name).exists() for name in CHECKPOINTS)
    (row, end), (whole_row, whole_end) = as_packed(folder), as_packed(tmp_path / "whole")
    assert row == whole_row
    for column in ("id", "x", "y", "vx", "vy", "omegaz"):
        assert (end[column] == whole_end[column]).all()


def test_asked_to_end_it_leaves_a_checkpoint(tmp_path: Path) -> None:
    """By the signal SIGUSR1; the next start goes on from there."""
    name = "TypeA_6x3_2-4_1-circle_auto"
    text, options = deck(tmp_path, name)
    (tmp_path / "deck.in").write_text(text, encoding="utf-8")
    words = [str(PROGRAM), "-in", "deck.in", *(w for n, value in options.items() for w in ("-var", n, str(value)))]
    process = subprocess.Popen(words, cwd=tmp_path, env=ENVIRONMENT, stdout=subprocess.DEVNULL)
    log = tmp_path / "log.lammps"
    begun = " upto"  # the first part of a stage
    while process.poll() is None and not (log.exists() and begun in log.read_text(encoding="utf-8")):
        time.sleep(0.01)
    process.send_signal(signal.SIGUSR1)
    assert process.wait(60) == 0
    assert "asked to end, it has packed.restart.c of step" in log.read_text(encoding="utf-8")
    assert go_on(tmp_path) == {"from": "c"} and not (tmp_path / PACKED_TABLE).exists()
    another: dict[str, Any] = options | go_on(tmp_path) | {"width": 0.07}
    status, output = start(text, tmp_path, **another)
    assert status != 0 and "ERROR: this is a specimen of another model" in output
    run(text, tmp_path, **options | go_on(tmp_path))
    pack(tmp_path / "whole", name)
    assert read_row(tmp_path / PACKED_TABLE) == read_row(tmp_path / "whole" / PACKED_TABLE)


def test_a_default_that_is_given_changes_nothing(tmp_path: Path) -> None:
    """A deck that had one of its own for a parameter would make another specimen of the value that is listed. The end of packing
    is one that can be set: ten times as coarse, it comes earlier."""
    text, options = deck(tmp_path / "given", SMALL)
    listed: dict[str, Any] = {name: one.value for name, one in parameters().items() if one.value is not None}
    run(text, tmp_path / "given", **listed | options)
    given, plain = read_row(tmp_path / "given" / PACKED_TABLE), pack(tmp_path / "plain", SMALL)
    assert given == plain
    text, options = deck(tmp_path / "coarse", SMALL)
    run(text, tmp_path / "coarse", **options, rest_packing=0.1)
    assert read_row(tmp_path / "coarse" / PACKED_TABLE)["steps"] < plain["steps"]


@pytest.mark.parametrize(
    ("longest", "message"),
    [
        (80, r"the grains do not bear the lid after 80 steps of compaction: it feels 0 of 1000000 Pa"),
        (4000, r"the grains are not at rest after 4000 steps: unbalanced force \S+, allowed 0.05, kinetic"),
        (9000, r"the grains are not at rest after 9000 steps: unbalanced force \S+, allowed 1e-07, kinetic"),
    ],
    ids=["compact", "press", "rest"],
)
def test_a_stage_that_is_too_long_ends_the_run_and_says_how_far_it_is(
    tmp_path: Path, longest: int, message: str
) -> None:
    """None goes on to the next stage."""
    text, options = deck(tmp_path, "TypeA_4x2_2-4_1-circle_auto")
    status, output = start(text, tmp_path, **options, longest=longest, rest_packing=1e-7)
    assert status != 0
    assert len(re.findall("ERROR: " + message, output)) == 1
