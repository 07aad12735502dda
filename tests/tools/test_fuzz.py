# SPDX-License-Identifier: GPL-2.0-or-later
"""Files altered at random: each is read as it should be, or refused with a message; never a traceback, never nonsense.

An altered number that is still one in its range cannot be told from the right one; all else must be noticed. A short form
of tests/fuzz, which makes more of the same: FUZZ_EXAMPLES is the number of alterations of each file.
"""

import json
import math
import os
import shlex
import tempfile
from collections.abc import Callable
from datetime import timedelta
from pathlib import Path

import numpy as np
import pytest
import synthetic
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from shearbox_tools.asking.grains import discs_of
from shearbox_tools.asking.models import INPUT, PARAMETERS, read_model
from shearbox_tools.asking.parameters import parameters, read_settings
from shearbox_tools.asking.request import OWN_OPTION, Request, read_record, recorded
from shearbox_tools.base.errors import InputError, ShearboxError
from shearbox_tools.base.logs import read_log
from shearbox_tools.base.timings import read_timings
from shearbox_tools.reading.dumps import CONTACTS, DISCS, GRAINS, Dump
from shearbox_tools.reading.readers import last_value, read_row, read_shear
from shearbox_tools.running.checks import check

EXAMPLES = int(os.environ.get("FUZZ_EXAMPLES", "25"))
MODEL = INPUT / "models" / "TypeA_10x5_4-8_1-circle_350.in"
WORDS = [
    b"nan", b"inf", b"-", b"0", b"-1", b"0.5", b"1e308", b"1e999", b"9" * 25, b"9" * 5000, b"1_0", b"0x10", b"#", b"&\n",
    b'"', b"'", b"${x}", b" ", b"\t", b"\r", b"\n", b"\v", b"\0", b"\xff", b"\xc2\xa0", b"\xef\xbc\x95", b"\xe2\x80\xa8",
    b",", b"[", b"{}", b"null", b"true", b"[" * 3000, b"ITEM: TIMESTEP\n", b"ITEM: ATOMS id\n",
]  # fmt: skip


@st.composite
def altered(draw: st.DrawFn, text: bytes) -> bytes:
    """One to three alterations: a piece is cut out, written twice, or replaced by a word; or the end is missing."""
    for _ in range(draw(st.integers(1, 3))):
        begin = draw(st.integers(0, len(text)))
        end = min(len(text), begin + draw(st.sampled_from([0, 0, 1, 1, 2, 5, 20, 80])))
        piece = text[begin:end]
        other = draw(
            st.one_of(st.just(b""), st.just(2 * piece), st.sampled_from(WORDS), st.binary(max_size=3), st.just(None))
        )
        text = text[:begin] if other is None else text[:begin] + other + text[end:]
    return text


def fuzz(text: bytes) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Calls a test with alterations of a text."""
    return lambda test: settings(
        max_examples=EXAMPLES, derandomize="FUZZ_EXAMPLES" not in os.environ, deadline=timedelta(seconds=20), database=None,
        suppress_health_check=list(HealthCheck),
    )(given(data=altered(text))(test))  # fmt: skip


def written(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path


@pytest.fixture(name="folder", scope="module")
def _folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("fuzz")


def made(write: Callable[[Path], Path]) -> bytes:
    """The text of the file that `write` makes in a folder."""
    with tempfile.TemporaryDirectory() as name:
        return write(Path(name)).read_bytes()


def shear_table(folder: Path) -> Path:
    synthetic.write_shear(folder / "shear.dat", synthetic.curves(100, 8, rows=6))
    return folder / "shear.dat"


def frames(name: str) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        synthetic.write_frames(folder, [0, 5000], 8)
        few = []
        for frame in (folder / name).read_text(encoding="utf-8").split("ITEM: TIMESTEP\n")[1:]:
            step, number, _, *rest = frame.splitlines()
            few += ["ITEM: TIMESTEP", step, number, "6", *rest[: 5 + 6]]
        (folder / name).write_text("\n".join(few) + "\n", encoding="utf-8")
        return folder / name

    return write


def as_lammps_reads(data: bytes) -> dict[str, str]:
    """Variables of a deck of nothing else: & joins lines, # ends one, of two definitions the first counts."""
    variables: dict[str, str] = {}
    for line in data.replace(b"&\n", b"").split(b"\n"):
        words = shlex.split(line.decode(errors="replace"), comments=True)
        assert not words or (words[0], words[2]) == ("variable", "index") and len(words) == 4
        if words:
            variables.setdefault(words[1], words[3])
    return variables


@fuzz(MODEL.read_bytes() + b"variable loose index 2\n")
def test_model(folder: Path, data: bytes) -> None:
    path = written(folder / "own.in", data)
    try:
        model = read_model(path)
        check(Request(model, (100.0,)))
    except ShearboxError as error:
        assert "own.in" in str(error) or "--travel" in str(error)
        return
    seen = as_lammps_reads(data)
    assert {name: str(value) for name, value in model.variables.items()}.keys() == seen.keys()
    assert all(float(seen[name]) == value for name, value in model.variables.items() if isinstance(value, float))


@fuzz(b"# a bean: x y r\n 0.0   0.0   1.0\n 0.9   0.25  0.8\n-0.9   0.2   0.75\n 1.55  0.8   0.5\n-1.5   0.75  0.55\n")
def test_template(folder: Path, data: bytes) -> None:
    written(folder / "grain.txt", data)
    text = MODEL.read_text(encoding="utf-8").replace("index single", 'index "file grain.txt"')
    path = written(folder / "clumps.in", text.encode())
    try:
        model = read_model(path)
    except ShearboxError as error:
        assert "grain.txt" in str(error)
        return
    discs = discs_of(model.shape)
    assert np.isfinite(discs).all() and (discs[:, 2] > 0).all() and math.isfinite(model.half_heights)


@fuzz(b"phi=30")
def test_setting(data: bytes) -> None:
    try:
        known = read_settings([data.decode(errors="surrogateescape")], OWN_OPTION)
    except InputError as error:
        assert "--set" in str(error)
        return
    for name, value in known.items():
        if name != "shape":
            assert parameters()[name].low <= float(value) <= parameters()[name].high


@fuzz(PARAMETERS.read_bytes())
def test_parameters(folder: Path, data: bytes) -> None:
    try:
        assert all(p.words or p.low < math.inf for p in parameters(written(folder / "parameters.in", data)).values())
    except ShearboxError as error:
        assert "parameters.in" in str(error)


IDENTITY = Request(read_model(MODEL), (100.0,), settings={"phi": "30"}).identity({"phi": "27", "kn": "1.0e8"})
RECORD = {"identity": IDENTITY, "stresses": [100.0, 200], "model_file": str(MODEL)}


@fuzz(json.dumps(RECORD, indent=2).encode())
def test_record(folder: Path, data: bytes) -> None:
    written(folder / "run.json", data)
    try:
        read_record(folder)
        request = recorded(folder)
        check(request)
    except ShearboxError as error:
        assert any(word in str(error) for word in ("run.json", "the model of this run", "--", "parameters.in", ".in: "))
        return
    assert all(1 <= s <= 5000 for s in request.stresses) and 0.001 <= request.speed <= 1000


@fuzz(b'{"pack": 3.25, "shear 100 kPa": 17}')
def test_timings(folder: Path, data: bytes) -> None:
    written(folder / "timings.json", data)
    assert all(0 <= seconds < math.inf for seconds in read_timings(folder).values())


@fuzz(b"grains,height_m,solid_fraction,steps\n350,0.0987,0.835,123000\n")
def test_row(folder: Path, data: bytes) -> None:
    try:
        row = read_row(written(folder / "packed.csv", data))
    except ShearboxError as error:
        assert "packed.csv" in str(error)
        return
    assert all(map(math.isfinite, row.values()))
    assert row.get("grains", 1) >= 1 and 0 <= row.get("solid_fraction", 0) <= 1


@fuzz(made(shear_table))
def test_shear(folder: Path, data: bytes) -> None:
    path = written(folder / "shear.dat", data)
    last = last_value(path, "displacement_mm")
    assert last is None or math.isfinite(last)
    try:
        table = read_shear(path)
    except ShearboxError as error:
        assert "shear.dat" in str(error)
        return
    assert all(np.isfinite(column).all() for column in table.values())
    assert (np.diff(table["step"]) > 0).all() and (table["step"] % 1 == 0).all() and (table["step"] >= 0).all()
    assert (table["dangerous"] >= 0).all() and (table["trm"] >= 0).all()


@pytest.mark.parametrize("name, columns", [("grains", GRAINS), ("discs", DISCS), ("contacts", CONTACTS)])
def test_dump(folder: Path, name: str, columns: tuple[str, ...]) -> None:
    @fuzz(made(frames(f"{name}.dump")))
    def look(data: bytes) -> None:
        path = written(folder / f"{name}.dump", data)
        try:
            dump = Dump(path, columns)
            found = [dump.frame(step) for step in dump.steps]
        except ShearboxError as error:
            assert f"{name}.dump" in str(error)
            return
        for frame in found:
            assert len({len(column) for column in frame.values()}) == 1
            assert all(np.isfinite(column).all() for column in frame.values())
            for column in frame.keys() & {"id", "id1", "id2"}:
                assert (frame[column] >= 1).all() and (frame[column] % 1 == 0).all()
            assert "radius" not in frame or (frame["radius"] > 0).all()

    look()


def discs_with_names_beside(folder: Path) -> Path:
    path = frames("discs.dump")(folder)
    synthetic.with_names_beside(folder)
    return path


DISCS_DUMP = made(discs_with_names_beside)


@fuzz(f"{synthetic.DISCS}\n".encode())
def test_names_of_columns(folder: Path, data: bytes) -> None:
    written(folder / "few.columns", data)
    written(folder / "few.dump", DISCS_DUMP)
    try:
        assert set(Dump(folder / "few.dump", DISCS).frame(0)) == set(DISCS)
    except ShearboxError as error:
        assert "few." in str(error)


LOG = b"""LAMMPS (29 Sep 2021)
Shearbox 0.1.0 (fake)
Loop time of 2.5 on 1 procs for 1000 steps with 350 atoms
Pair    | 1.5        | 1.5        | 1.5        |   0.0 | 75.00
Other   |            | 0.5        |            |       | 25.00
Total wall time: 0:00:01
"""


@fuzz(LOG)
def test_log(folder: Path, data: bytes) -> None:
    log = read_log(written(folder / "shear.log", data))
    assert 0 <= log.seconds < math.inf and log.steps >= 0
    assert all(0 <= seconds < math.inf for seconds in log.parts.values()) and log.greatest_parts
