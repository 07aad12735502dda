# SPDX-License-Identifier: GPL-2.0-or-later
"""When a phase counts as done, and how far a shear phase has come."""

from dataclasses import replace
from pathlib import Path

import pytest
import synthetic

from shearbox_tools.asking.models import INPUT, find_model, read_model
from shearbox_tools.asking.request import Request
from shearbox_tools.base.errors import InputError
from shearbox_tools.reading.readers import BED, read_row
from shearbox_tools.running.checks import check
from shearbox_tools.running.phases import packing, shearing

HEADER = "# step displacement_mm tau_kPa\n"
TABLE = ",".join(BED) + "\n" + ",".join("1" * len(BED)) + "\n"
GOODBYE = "...\nTotal wall time: 0:00:01\n"


def request(name: str = "TypeA_10x5_4-8_1-circle_350") -> Request:
    return Request(find_model(name), (100.0, 200.0), seed=7)


@pytest.mark.parametrize(
    "table, log, restart, done",
    [
        (TABLE, GOODBYE, True, True),
        (TABLE, "...\n", True, False),
        (TABLE[:-2], GOODBYE, True, False),
        ("", GOODBYE, True, False),
        (None, GOODBYE, True, False),
        (TABLE, None, True, False),
        (TABLE, GOODBYE, False, False),
    ],
)
def test_done_is_a_whole_table_and_an_engine_that_said_goodbye(
    tmp_path: Path, table: str | None, log: str | None, restart: bool, done: bool
) -> None:
    phase = packing(tmp_path, request())
    phase.folder.mkdir()
    for path, text in ((phase.folder / "packed.csv", table), (phase.log, log)):
        if text is not None:
            path.write_text(text, encoding="utf-8")
    if restart:
        synthetic.write_restart(phase.folder / "packed.restart", 7)
    assert phase.done is done


def test_a_table_is_read_again_only_when_it_has_changed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[Path] = []

    def note(path: Path) -> dict[str, float]:
        read.append(path)
        return read_row(path)

    monkeypatch.setattr("shearbox_tools.running.phases.read_row", note)
    phase = packing(tmp_path, request())
    phase.folder.mkdir()
    table = phase.folder / "packed.csv"
    table.write_text(TABLE, encoding="utf-8")
    phase.log.write_text(GOODBYE, encoding="utf-8")
    synthetic.write_restart(phase.folder / "packed.restart", 7)
    phase.seal()
    assert phase.done and phase.done and len(read) == 1
    table.write_text(TABLE + TABLE, encoding="utf-8")
    assert not phase.done and len(read) == 1
    phase.seal()
    assert phase.done and len(read) == 2


def test_variables_of_the_decks(tmp_path: Path) -> None:
    consolidate, shear = shearing(tmp_path, request(), 100)
    common = {
        "model": "TypeA_10x5_4-8_1-circle_350",
        "models": str(INPUT / "models"),
        "seed": "7",
        "law": "direct",
        "dt": "auto",
        "stiffness": "1",
        "sigma": "100",
    }
    assert consolidate.variables == {**common, "packed": "../packed/packed.restart"}
    assert shear.variables == {**common, "speed": "2", "travel": "8"}
    assert consolidate.folder == shear.folder == tmp_path / "100"
    assert consolidate.deck.is_file() and shear.deck.is_file()


@pytest.mark.parametrize(
    "text, reached",
    [
        (HEADER + "5000 0.25 1\n", 0.25),
        (HEADER + "5000 0.25 1\n10000 0.5", 0.25),
        (HEADER + "5000 0.25 1\n" + HEADER, 0.25),
        ("# step tau_kPa displacement_mm\n5000 60 0.25\n", 0.25),
        ("# step tau_kPa\n5000 60\n", 0),
        (HEADER, 0),
        ("", 0),
    ],
)
def test_displacement_of_the_last_whole_line(tmp_path: Path, text: str, reached: float) -> None:
    shear = shearing(tmp_path, request(), 100)[1]
    shear.folder.mkdir()
    assert shear.displacement() == 0
    (shear.folder / "shear.dat").write_text(text, encoding="utf-8")
    assert shear.displacement() == reached


@pytest.mark.parametrize(
    "model, results, seen",
    [
        ("models", "my results", "{tmp}/models"),
        ("my models", "my models/results", "../.."),
        ("my\tmodels", "results", None),
        ("my models/own", "my models/results", "../../own"),
        ("my models", "results", None),
        ("my models/a b", "my models", None),
    ],
)
def test_where_the_decks_find_a_model(tmp_path: Path, model: str, results: str, seen: str | None) -> None:
    """LAMMPS includes nothing with a blank in its name."""
    path = tmp_path / model / "sand.in"
    path.parent.mkdir(parents=True)
    path.write_text((INPUT / "models" / "TypeA_10x5_4-8_1-circle_350.in").read_text(encoding="utf-8"), encoding="utf-8")
    asked = Request(read_model(path), (100.0,))
    if seen is None:
        with pytest.raises(InputError, match="a blank in its name"):
            packing(tmp_path / results, asked)
    else:
        variables = packing(tmp_path / results, asked).variables
        assert (variables["model"], variables["models"]) == ("sand", seen.format(tmp=tmp_path))


def test_a_model_whose_own_name_has_a_blank_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "my sand.in"
    path.write_text((INPUT / "models" / "TypeA_10x5_4-8_1-circle_350.in").read_text(encoding="utf-8"), encoding="utf-8")
    with pytest.raises(InputError, match="my sand.in: LAMMPS cannot include a file with a blank in its name"):
        packing(tmp_path / "results", Request(read_model(path), (100.0,)))


def test_lammps_counts_no_further() -> None:
    """8 mm in steps of some 8.3e-7 s: 2^31 of them at 0.0045 mm/s."""
    check(replace(request(), speed=0.01))
    with pytest.raises(
        InputError, match=r"--speed 0.001: some 9.7e\+09 steps; at most 2.15e\+09 are .* faster than 0.0045"
    ):
        check(replace(request(), speed=0.001))


def test_a_half_travels_as_far_as_its_flanges_are_long() -> None:
    """The decks say how long, or the command line."""
    check(request())
    with pytest.raises(InputError, match="--travel 8: 0.1 to 5 mm, 0.05 of the box's width"):
        check(replace(request(), settings={"flanges": "0.05"}))
