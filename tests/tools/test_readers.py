# SPDX-License-Identifier: GPL-2.0-or-later
"""Reading tables and dumps: whole, interrupted, damaged."""

from pathlib import Path

import numpy as np
import pytest
import synthetic

from shearbox_tools.base.errors import ShearboxError
from shearbox_tools.base.logs import read_log
from shearbox_tools.reading.dumps import CELLS, CONTACTS, DISCS, GRAINS, Dump
from shearbox_tools.reading.readers import BED, last_value, read_row, read_shear

EVERY = {"grains": GRAINS, "discs": DISCS, "contacts": CONTACTS, "cells": CELLS}


@pytest.fixture(name="shear")
def _shear(tmp_path: Path) -> Path:
    path = tmp_path / "shear.dat"
    synthetic.write_shear(path, synthetic.curves(100, 8, rows=20))
    return path


@pytest.fixture(name="frames")
def _frames(tmp_path: Path) -> Path:
    synthetic.write_frames(tmp_path, [0, 5000, 10000], 8)
    return tmp_path


def edit(path: Path, line: int, text: str) -> None:
    """Replace a line, counted from 1."""
    lines = path.read_text(encoding="utf-8").splitlines()
    lines[line - 1] = text
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def test_all_rows(shear: Path) -> None:
    table = read_shear(shear)
    expected = synthetic.curves(100, 8, rows=20)
    for name, column in expected.items():
        assert table[name] == pytest.approx(column, rel=1e-8), name


def test_the_last_of_repeated_rows_counts(shear: Path) -> None:
    again = synthetic.curves(100, 8, rows=20)
    again["tau_kPa"] = again["tau_kPa"] + 1
    synthetic.write_shear(shear, again, slice(15, 18), "a")
    tau = read_shear(shear)["tau_kPa"] - synthetic.curves(100, 8, rows=20)["tau_kPa"]
    assert tau == pytest.approx([0] * 15 + [1] * 3 + [0] * 2, abs=1e-6)


def test_a_line_without_end_is_left_out(shear: Path) -> None:
    with shear.open("a", encoding="utf-8") as stream:
        stream.write("105000 8.2 4")
    assert len(read_shear(shear)["step"]) == 20


@pytest.mark.parametrize(
    "text, message",
    [
        ("5000 1 2 3", "line 7: 11 values are expected, there are 4: '5000 1 2 3'"),
        ("5000 1 2 3 4 5 6 7 8 9 many", "line 7: not a number in '5000 1 2 3 4 5 6 7 8 9 many'"),
        ("5000 1 2 3 4 5 6 7 8 9 nan", "line 7: a value that is not finite"),
        ("\0\0\0\0", "line 7: 11 values are expected"),
    ],
)
def test_a_damaged_row_is_named(shear: Path, text: str, message: str) -> None:
    edit(shear, 7, text)
    with pytest.raises(ShearboxError) as error:
        read_shear(shear)
    assert f"{shear}, {message}" in str(error.value)


@pytest.mark.parametrize("lines", [0, 1])
def test_no_rows(shear: Path, lines: int) -> None:
    shear.write_text("".join(shear.read_text(encoding="utf-8").splitlines(keepends=True)[:lines]), encoding="utf-8")
    with pytest.raises(ShearboxError, match="no rows of data"):
        read_shear(shear)


def test_columns_in_another_order_and_one_more(shear: Path) -> None:
    expected = synthetic.curves(100, 8, rows=20)
    given = {"pressure_kPa": np.arange(20.0)} | dict(reversed(expected.items()))
    synthetic.write_shear(shear, given)
    table = read_shear(shear)
    for name, column in given.items():
        assert table[name] == pytest.approx(column, rel=1e-8), name
    assert last_value(shear, "displacement_mm") == pytest.approx(expected["displacement_mm"][-1])


def test_columns_that_are_not_there_are_named(shear: Path) -> None:
    columns = synthetic.curves(100, 8, rows=20)
    del columns["tau_kPa"], columns["work_J"]
    synthetic.write_shear(shear, columns)
    with pytest.raises(ShearboxError, match="shear.dat: there is no column tau_kPa, work_J; the columns are step disp"):
        read_shear(shear)


@pytest.mark.parametrize(
    "line, text, message",
    [
        (1, "5000 1 2 3 4 5 6 7 8 9 10", "line 1: a header '# step ...' is expected, not '5000 1"),
        (1, "# " + " ".join(synthetic.curves(100, 8)) + " step", "there are several columns step"),
        (1, "# " + " ".join(synthetic.curves(100, 8)) + " more", "line 2: 12 values are expected, there are 11"),
        (9, "# " + " ".join(reversed(synthetic.curves(100, 8))), "line 9: the header is no longer 'step disp"),
    ],
)
def test_a_header_that_is_not_that_of_the_rows_is_named(shear: Path, line: int, text: str, message: str) -> None:
    edit(shear, line, text)
    with pytest.raises(ShearboxError) as error:
        read_shear(shear)
    assert str(shear) in str(error.value) and message in str(error.value)


def test_a_continued_table_has_its_header_twice(shear: Path) -> None:
    again = shear.read_text(encoding="utf-8")
    shear.write_text(again + again, encoding="utf-8")
    assert len(read_shear(shear)["step"]) == 20


def test_no_file(tmp_path: Path) -> None:
    with pytest.raises(ShearboxError, match="No such file"):
        read_shear(tmp_path / "none.dat")
    with pytest.raises(ShearboxError, match="No such file"):
        Dump(tmp_path / "none.dump", GRAINS)


def test_a_row_of_csv(tmp_path: Path) -> None:
    path = tmp_path / "packed.csv"
    row = (
        {name: k + 1.0 for k, name in enumerate(BED)}
        | {name: 0.8 for name in BED if "solid" in name}
        | {"sigma_kPa": 100.0}
    )
    path.write_text(", ".join(row) + "\n" + ", ".join(map(str, row.values())) + "\n", encoding="utf-8")
    assert read_row(path) == row


@pytest.mark.parametrize(
    "text, message",
    [
        ("", "0 whole lines"),
        ("a,b\n", "1 whole lines"),
        ("a,b\n1\n", "line 2: 2 values"),
        ("a,b\n1,x\n", "line 2: not a"),
        (",".join(BED[1:]) + "\n" + ",".join("1" * (len(BED) - 1)) + "\n", "no column grains"),
    ],
)
def test_a_damaged_csv_is_named(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "packed.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ShearboxError, match=message):
        read_row(path)


@pytest.mark.parametrize("name, columns", [("grains", GRAINS), ("discs", DISCS), ("contacts", CONTACTS)])
def test_frames(frames: Path, name: str, columns: tuple[str, ...]) -> None:
    dump = Dump(frames / f"{name}.dump", columns)
    assert dump.steps == [0, 5000, 10000]
    assert dump.nearest(6000) == 5000
    frame = dump.frame(5000)
    assert tuple(frame) == columns
    assert len({len(column) for column in frame.values()}) == 1


def swapped(row: str, first: int, second: int) -> str:
    words = row.split()
    words[first], words[second] = words[second], words[first]
    return " ".join(words)


@pytest.mark.parametrize("name, columns", [("grains", GRAINS), ("discs", DISCS), ("contacts", CONTACTS)])
def test_columns_that_the_dump_has_in_another_order(frames: Path, name: str, columns: tuple[str, ...]) -> None:
    """As after a swap in the deck's dump command."""
    path = frames / f"{name}.dump"
    before = Dump(path, columns).frame(5000)
    lines = path.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines):
        words = line.split()
        if line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES")):
            lines[number] = swapped(line, 2 + 2, 2 + 3)
        elif not line.startswith("ITEM") and len(words) > 6:
            lines[number] = swapped(line, 2, 3)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    after = Dump(path, columns).frame(5000)
    assert all(np.array_equal(before[column], after[column]) for column in columns)


def test_columns_that_the_compute_has_in_another_order(frames: Path) -> None:
    """As after a swap of the fields that the deck asks for, in dumps of before: the file beside the dump says so."""
    synthetic.with_names_beside(frames)
    before = Dump(frames / "contacts.dump", CONTACTS).frame(0)
    names = frames / "contacts.columns"
    names.write_text("id2 id1 disc1 disc2 y x fn ft fx fy nx ny overlap sliding\n", encoding="utf-8")
    after = Dump(frames / "contacts.dump", CONTACTS).frame(0)
    for one, other in (("id1", "id2"), ("x", "y")):
        assert np.array_equal(before[one], after[other]) and np.array_equal(before[other], after[one])


def test_dumps_of_an_earlier_version(frames: Path) -> None:
    named = {name: Dump(frames / f"{name}.dump", columns).frame(5000) for name, columns in EVERY.items()}
    synthetic.with_names_beside(frames)
    for name, columns in EVERY.items():
        before = Dump(frames / f"{name}.dump", columns).frame(5000)
        assert all(np.array_equal(before[column], named[name][column]) for column in columns)


def test_columns_without_names_are_refused(frames: Path) -> None:
    """As in a folder of a version before names."""
    synthetic.with_names_beside(frames)
    (frames / "discs.columns").unlink()
    with pytest.raises(ShearboxError, match=r"no column id, disc.*; discs.columns could say what c_discs\[1\] is"):
        Dump(frames / "discs.dump", DISCS).frame(0)
    names = "id type x y vx vy omegaz radius f_motion[4] c_trm v_wall v_lower v_lid"
    edit(frames / "grains.dump", 9, f"ITEM: ATOMS {names}")
    with pytest.raises(ShearboxError, match=r"grains.dump: there is no column angle; .* f_motion\[4\]"):
        Dump(frames / "grains.dump", GRAINS).frame(0)


def test_one_column_more(frames: Path) -> None:
    path = frames / "grains.dump"
    before = Dump(path, GRAINS).frame(5000)
    lines = path.read_text(encoding="utf-8").splitlines()
    lines = [line + (" v_heat" if "ATOMS id" in line else " 7" if len(line.split()) == 14 else "") for line in lines]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    after = Dump(path, GRAINS).frame(5000)
    assert all(np.array_equal(before[column], after[column]) for column in GRAINS)


def test_a_frame_without_rows(frames: Path) -> None:
    path = frames / "contacts.dump"
    lines = path.read_text(encoding="utf-8").splitlines()[:9]
    lines[3] = "0"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    assert Dump(path, CONTACTS).frame(0)["fn"].shape == (0,)


def test_a_last_frame_that_is_cut_off_is_left_out(frames: Path) -> None:
    path = frames / "grains.dump"
    whole = path.read_bytes()
    third = whole.rfind(b"ITEM: TIMESTEP")
    for end in (third + 15, third + 20, third + 60, third + 200, len(whole) - 1, len(whole) - 100):
        path.write_bytes(whole[:end])
        assert Dump(path, GRAINS).steps == [0, 5000]


def test_the_last_of_repeated_frames_counts(frames: Path) -> None:
    path = frames / "grains.dump"
    text = path.read_text(encoding="utf-8")
    path.write_text(text + text[text.rfind("ITEM: TIMESTEP") :].replace(" 0.00277 ", " 0.9 "), encoding="utf-8")
    dump = Dump(path, GRAINS)
    assert dump.steps == [0, 5000, 10000]
    assert dump.frame(10000)["radius"][0] == 0.9


@pytest.mark.parametrize(
    "line, text, message",
    [
        (1, "nonsense", "line 1: 'ITEM: TIMESTEP' is expected, not 'nonsense'"),
        (2, "many", "line 2: a whole number is expected, not 'many'"),
        (4, "7", "line 1: a frame of "),
        (9, "ITEM: ATOMS id type x", "no column y, radius, angle, wall, lower, lid; the columns are id type x"),
        (12, "3 1 0.01 0.02 0 0 0 0 0.003 0 0 0 0", "line 12: 14 values are expected, there are 13"),
        (12, "3 1 0.01 0.02 0 0 0 0 0.003 0 0 0 0 wide", "line 12: not a number"),
        (12, "3 1 0.01 0.02 0 0 0 0 0.003 0 0 0 0 inf", "line 12: a value that is not finite"),
    ],
)
def test_a_damaged_dump_is_named(frames: Path, line: int, text: str, message: str) -> None:
    edit(frames / "grains.dump", line, text)
    with pytest.raises(ShearboxError) as error:
        Dump(frames / "grains.dump", GRAINS).frame(0)
    assert message in str(error.value)
    assert str(frames / "grains.dump") in str(error.value)


def test_a_frame_that_lacks_a_row_is_named(frames: Path) -> None:
    path = frames / "grains.dump"
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    rows = int(lines[3])
    path.write_text("".join(lines[:11] + lines[12:]), encoding="utf-8")
    with pytest.raises(ShearboxError, match=f"line 1: a frame of {rows - 1} rows that should have {rows}"):
        Dump(path, GRAINS)


def test_a_dump_without_a_whole_frame_is_named(frames: Path) -> None:
    path = frames / "grains.dump"
    path.write_bytes(path.read_bytes()[:500])
    for use in (lambda: Dump(path, GRAINS).steps, lambda: Dump(path, GRAINS).nearest(0)):
        with pytest.raises(ShearboxError, match="grains.dump: there is no whole frame in it"):
            use()


@pytest.mark.parametrize(
    "column, value",
    [
        ("step", "5000.5"),
        ("trm", "-0.1"),
        ("dangerous", "0.5"),
        ("kinetic_J", "-1e-9"),
        ("step", "-5"),
        ("tau_kPa", "1_0"),
        ("tau_kPa", "٣"),
    ],
)
def test_a_number_that_a_column_cannot_have(shear: Path, column: str, value: str) -> None:
    names, row = (line.split() for line in shear.read_text(encoding="utf-8").splitlines()[:2])
    row[names.index(column) - 1] = value
    edit(shear, 2, " ".join(row))
    with pytest.raises(ShearboxError, match="shear.dat"):
        read_shear(shear)


def test_an_empty_dump_is_named(frames: Path) -> None:
    (frames / "grains.dump").write_text("", encoding="utf-8")
    with pytest.raises(ShearboxError, match="grains.dump: the file is empty"):
        Dump(frames / "grains.dump", GRAINS)


@pytest.mark.parametrize("first, count", [(0, 1), (7, 1), (7, 5)])
def test_rows_that_are_cut_out_are_missed(shear: Path, first: int, count: int) -> None:
    lines = shear.read_text(encoding="utf-8").splitlines(keepends=True)
    del lines[1 + first : 1 + first + count]
    shear.write_text("".join(lines), encoding="utf-8")
    gap = f"the rows between the steps {5000 * first} and {5000 * (first + count + 1)} are missing"
    with pytest.raises(ShearboxError, match=gap):
        read_shear(shear)


@pytest.mark.parametrize("line", ["Loop time of 1.2.3 on 1 procs for 10 steps", "Loop time of nan on 1 procs for x steps",
                                  "Loop time of 1e9999 on 1 procs for 10 steps", "Pair | 1 | .. | 3 |"])  # fmt: skip
def test_a_damaged_log_counts_for_nothing(tmp_path: Path, line: str) -> None:
    path = tmp_path / "shear.log"
    path.write_text(f"{line}\nLoop time of 2 on 1 procs for 10 steps\n", encoding="utf-8")
    assert (read_log(path).seconds, read_log(path).steps) == (2, 10)
