# SPDX-License-Identifier: GPL-2.0-or-later
"""What is done again when files are gone or damaged, and where a stopped shear phase goes on: tests/robustness in short,
without an engine."""

import json
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
import synthetic
from shearbox_tools.analysis.results import read_results
from shearbox_tools.asking.models import INPUT, find_model
from shearbox_tools.asking.request import Request, check_folder, open_folder, read_record, recorded
from shearbox_tools.base import seals
from shearbox_tools.base.errors import InputError, ShearboxError
from shearbox_tools.base.files import DUMPS, write_text
from shearbox_tools.base.lock import locked
from shearbox_tools.base.restarts import is_whole, step_of
from shearbox_tools.base.seals import Seal, look_at, refuse_altered, seal
from shearbox_tools.reading.readers import BED, read_shear
from shearbox_tools.running import campaign
from shearbox_tools.running.engine import Engine
from shearbox_tools.running.forecast import Forecast
from shearbox_tools.running.phases import Phase, all_phases, left_to_do, rows_of_shear, steps_between_frames
from shearbox_tools.running.repair import make_ready
from shearbox_tools.running.run_folders import Run

ROWS = rows_of_shear()
EVERY = synthetic.STEPS_PER_ROW
FRAME = steps_between_frames({}, EVERY)
MODEL = find_model("TypeA_10x5_4-8_1-circle_350")
REQUEST = Request(MODEL, (100.0,))
PACK, CONSOLIDATE, SHEAR = "pack", "consolidate", "shear"


def write_frames(folder: Path, last: int) -> None:
    """Frames of one row each, up to that step."""
    for name in DUMPS:
        head = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id\n1\n"
        (folder / name).write_text("".join(head.format(step) for step in range(0, last + 1, FRAME)), encoding="utf-8")


def write_rows(folder: Path, rows: int) -> None:
    synthetic.write_shear(folder / "shear.dat", synthetic.curves(100, 8), slice(0, rows))


@pytest.fixture(name="finished", scope="module")
def _finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("finished")
    open_folder(folder, REQUEST)
    for phase in all_phases(folder, REQUEST):
        phase.folder.mkdir(exist_ok=True)
        if phase.name == SHEAR:
            write_rows(phase.folder, ROWS)
            write_frames(phase.folder, ROWS * EVERY)
        else:
            synthetic.write_row(phase.folder / phase.product, **{name: 1.0 for name in BED})
        synthetic.write_restart(phase.folder / phase.restart, ROWS * EVERY)
        phase.log.write_text("...\nTotal wall time: 0:00:01\n", encoding="utf-8")
        phase.seal()
    return folder


@pytest.fixture(name="folder")
def _folder(finished: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(finished, tmp_path / "results"))


def left(folder: Path) -> list[str]:
    pack, chains = left_to_do(folder, REQUEST)
    return [phase.name for phase in [*pack, *(phase for chain in chains for phase in chain)]]


def altered(path: Path) -> None:
    """Another digit somewhere in the second half."""
    data = bytearray(path.read_bytes())
    at = next(i for i in range(len(data) // 2, len(data)) if chr(data[i]).isalnum())
    data[at] ^= 1
    path.write_bytes(data)


def cut_out(path: Path) -> None:
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 3] + data[len(data) // 2 :])


def removed(path: Path) -> None:
    path.unlink()


def emptied(path: Path) -> None:
    os.truncate(path, 0)


EVERY_DAMAGE = (altered, cut_out, removed, emptied)


@pytest.mark.parametrize("damage", EVERY_DAMAGE)
@pytest.mark.parametrize(
    "name, again",
    [
        ("packed/packed.csv", [PACK]),
        ("packed/packed.restart", []),
        ("packed/pack.log", []),
        ("packed/SHA256SUMS", []),
        ("100/consolidated.csv", [CONSOLIDATE]),
        ("100/consolidated.restart", []),
        ("100/shear.dat", [SHEAR]),
        ("100/sheared.restart", []),
    ],
)
def test_what_is_lost_is_made_again_and_nothing_else(
    folder: Path, name: str, damage: Callable[[Path], None], again: list[str]
) -> None:
    assert not left(folder)
    damage(folder / name)
    if name.endswith("SUMS") and damage is altered:  # of a file that is there no more as it was, for all we know
        assert left(folder) in ([], [PACK])
    else:
        assert left(folder) == again


@pytest.mark.parametrize("damage", EVERY_DAMAGE)
def test_a_restart_file_is_made_again_where_it_is_needed(folder: Path, damage: Callable[[Path], None]) -> None:
    damage(folder / "packed" / "packed.restart")
    (folder / "100" / "consolidated.csv").unlink()
    assert left(folder) == [PACK, CONSOLIDATE]
    (folder / "100" / "shear.dat").unlink()
    damage(folder / "100" / "consolidated.restart")
    assert left(folder) == [PACK, CONSOLIDATE, SHEAR]


def test_frames_may_be_removed_but_not_altered(folder: Path) -> None:
    for name in DUMPS:
        (folder / "100" / name).unlink()
    assert not left(folder)


@pytest.mark.parametrize("name", DUMPS)
def test_altered_frames_are_made_again(folder: Path, name: str) -> None:
    altered(folder / "100" / name)
    assert not Forecast(folder, REQUEST).phases[-1].done
    assert left(folder) == [SHEAR]


@pytest.mark.parametrize("sealed", ["now", "by an earlier version"])
def test_what_is_done_is_told_without_reading_frames_and_made_sure_of_before_work(
    folder: Path, sealed: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A byte that is no longer the same, on a disk that grows old, is not seen by size and time. Without these all is read."""
    if sealed != "now":
        sums = folder / "100" / "SHA256SUMS"
        sums.write_text("".join(re.findall("^[^#].*\n", sums.read_text(encoding="utf-8"), re.M)), encoding="utf-8")
    read: list[str] = []
    digest = seals._digest

    def told(path: Path, *state: int) -> str:
        read.append(path.name)
        return digest(path, *state)

    monkeypatch.setattr(seals, "_digest", told)
    shear = Forecast(folder, REQUEST).phases[-1]
    assert shear.done and (not set(DUMPS) & set(read)) == (sealed == "now")
    dump = folder / "100" / "discs.dump"
    written = dump.stat().st_mtime_ns
    altered(dump)
    os.utime(dump, ns=(written, written))
    assert shear.done == (sealed == "now") and left(folder) == [SHEAR]


def test_what_was_finished_without_the_tools_or_after_they_were_killed_is_done(folder: Path) -> None:
    for place in ("packed", "100"):
        (folder / place / "SHA256SUMS").unlink()
    assert not left(folder)
    cut_out(folder / "100" / "shear.dat")
    assert left(folder) == [SHEAR]


def test_an_altered_table_is_not_reported_on(folder: Path) -> None:
    altered(folder / "100" / "shear.dat")
    results = read_results(folder)
    assert not results.shears
    assert "shear.dat has changed since it was written" in results.problems[0]


@pytest.fixture(name="stopped")
def _stopped(folder: Path) -> Phase:
    """In row 107, after restart files of rows 80 (b) and 96 (a)."""
    shear = all_phases(folder, REQUEST)[-1]
    (shear.folder / shear.restart).unlink()
    write_rows(shear.folder, 107)
    write_frames(shear.folder, 107 * EVERY)
    for k, name in ((96, "a"), (80, "b")):
        synthetic.write_restart(shear.folder / f"shear.restart.{name}", k * EVERY)
    shear.seal()
    return shear


def state(shear: Phase) -> tuple[str | None, int | None]:
    """The restart file that is gone on from, and the rows that are kept."""
    ready, _ = make_ready(shear)
    table = shear.folder / shear.product
    return ready.variables.get("from"), len(read_shear(table)["step"]) if table.exists() else None


def test_a_stopped_phase_goes_on_from_its_last_restart_file(stopped: Phase) -> None:
    """And nothing is written twice: frames of later steps are cut off, too."""
    turn_times_round(stopped)
    assert state(stopped) == ("a", 96)
    for name in DUMPS:
        text = (stopped.folder / name).read_text(encoding="utf-8")
        assert text.count("TIMESTEP") == 1 + 96 * EVERY // FRAME
    assert state(stopped) == ("a", 96), "killed before its engine wrote anything, it can go on once more"


def turn_times_round(shear: Phase) -> None:
    """As a copy or a clock that was set back does."""
    os.utime(shear.folder / "shear.restart.a", (1, 1))
    os.utime(shear.folder / "shear.restart.b", (2, 2))


@pytest.mark.parametrize("damage", EVERY_DAMAGE)
@pytest.mark.parametrize(
    "names, taken",
    [
        (["shear.restart.a"], ("b", 80)),
        (["shear.restart.b"], ("a", 96)),
        (["shear.restart.a", "shear.restart.b"], (None, None)),
        (["shear.dat"], (None, None)),
        (["grains.dump"], (None, None)),
    ],
)
def test_damage_to_what_a_stopped_phase_left(
    stopped: Phase, names: list[str], damage: Callable[[Path], None], taken: tuple[str | None, int | None]
) -> None:
    for name in names:
        damage(stopped.folder / name)
    assert state(stopped) == taken
    assert not any((stopped.folder / name).exists() for name in names if name[-1] in "ab" and name[-1] != taken[0])


@pytest.mark.parametrize("name", DUMPS)
def test_a_stopped_phase_whose_frames_were_removed_is_neither_gone_on_with_nor_thrown_away(
    stopped: Phase, name: str
) -> None:
    (stopped.folder / name).unlink()
    kept = {path.name for path in stopped.folder.iterdir()}
    with pytest.raises(
        ShearboxError, match=rf"{name} of a test that is not finished.*remove shear.restart.a, shear.restart.b$"
    ):
        begin_again(stopped)
    assert {path.name for path in stopped.folder.iterdir()} == kept
    for letter in "ab":
        (stopped.folder / f"shear.restart.{letter}").unlink()
    begin_again(stopped)
    assert state(stopped) == (None, None)


def begin_again(shear: Phase) -> None:
    """As the command does it, before an engine is started."""
    campaign._left_to_do(Run(shear.folder.parent, REQUEST))


@pytest.mark.parametrize("which, names", enumerate((["packed.restart.draft"], ["consolidated.restart.draft"],
                                                    ["shear.restart.draft", "shear.whole"])))  # fmt: skip
def test_half_written_files_of_an_engine_that_was_killed_go(folder: Path, which: int, names: list[str]) -> None:
    """The decks write these, to rename them when they are whole."""
    phase = all_phases(folder, REQUEST)[which]
    for name in names:
        (phase.folder / name).write_bytes(b"half")
    make_ready(phase)
    assert not any((phase.folder / name).exists() for name in names)
    decks = [INPUT / "shear.in"] if phase.name == SHEAR else [INPUT / "stage.in", INPUT / "rest.in"]
    text = "".join(deck.read_text(encoding="utf-8") for deck in decks).replace(
        "${product}", phase.restart.split(".")[0]
    )
    assert all(name in text for name in names)


@pytest.mark.parametrize("rows, taken", [(107, ("a", 96)), (96, ("a", 96)), (95, ("b", 80)), (79, (None, None))])
def test_rows_lost_in_a_power_cut_are_missed(stopped: Phase, rows: int, taken: tuple[str | None, int | None]) -> None:
    """Nothing was sealed at the end."""
    stopped.unseal()
    write_rows(stopped.folder, rows)
    ready, notes = make_ready(stopped)
    assert ready.variables.get("from") == taken[0]
    assert bool(notes) == (rows < 96)
    if notes:
        assert f"shear.restart.a, of step {96 * EVERY}, is of no use" in notes[0]
        assert "shear.dat has no row of that step" in notes[0]


@pytest.mark.parametrize("tail", [b"\0" * 500, b"1", b"no number"])
def test_a_torn_row_is_cut_off(stopped: Phase, tail: bytes) -> None:
    """What the engine writes next begins a line of its own."""
    stopped.unseal()
    write_rows(stopped.folder, 96)
    table = stopped.folder / stopped.product
    whole = table.read_bytes()
    table.write_bytes(whole + tail)
    assert state(stopped) == ("a", 96)
    assert table.read_bytes() == whole


def test_frames_lost_in_a_power_cut_are_missed(stopped: Phase) -> None:
    stopped.unseal()
    write_frames(stopped.folder, 95 * EVERY)
    assert state(stopped) == ("b", 80)


@pytest.mark.parametrize("which", [0, 1], ids=["packing", "consolidation"])
def test_what_comes_before_shear_goes_on_as_well(folder: Path, which: int) -> None:
    """Of its restart files the latest that is whole counts; its table is written at the end alone."""
    phase = all_phases(folder, REQUEST)[which]
    for name in (phase.restart, phase.product):
        (phase.folder / name).unlink()
    for k, letter in ((20000, "a"), (60000, "b"), (40000, "c")):
        synthetic.write_restart(phase.folder / f"{phase.restart}.{letter}", k)
    phase.seal()
    assert not phase.done and not phase.leads_on
    assert make_ready(phase)[0].variables["from"] == "b"
    (phase.folder / f"{phase.restart}.b").write_bytes(b"half of it")
    assert make_ready(phase)[0].variables["from"] == "c"
    assert {name[-1] for name in phase.checkpoints if (phase.folder / name).exists()} == {"a", "c"}


def test_a_packing_that_has_begun_is_partly_done(folder: Path) -> None:
    packing = all_phases(folder, REQUEST)[0]
    for name in (packing.restart, packing.product):
        (packing.folder / name).unlink()
    shares = []
    for step in (None, 1000, 10000, 30000, 60000, 100000, 10**9):
        if step is not None:
            synthetic.write_restart(packing.folder / f"{packing.restart}.a", step)
        shares.append(Forecast(folder, REQUEST).share_done(packing))
    assert shares[0] == 0 and shares == sorted(set(shares)) and shares[-1] < 1, "a job that goes on has done something"
    assert shares[2] == pytest.approx(10 * shares[1])


def test_shear_is_done_as_far_as_it_can_be_gone_on_from(stopped: Phase) -> None:
    """Row 96 of 800: those behind it are written again, and so are all where there is no restart file."""
    folder = stopped.folder.parent
    assert Forecast(folder, REQUEST).share_done(stopped) == pytest.approx(96 / ROWS, abs=1 / ROWS)
    for name in stopped.checkpoints:
        (stopped.folder / name).unlink(missing_ok=True)
    assert Forecast(folder, REQUEST).share_done(stopped) == 0


def test_of_liggghts_nothing_is_done_before_all_is(stopped: Phase) -> None:
    """Its phases begin anew: jobs that go by what is done would do so for ever."""
    forecast = Forecast(stopped.folder.parent, replace(REQUEST, host="liggghts"))
    shear = forecast.phases[-1]
    assert shear.displacement() > 1 and forecast.share_done(shear) == 0
    assert forecast.left(shear) == forecast.work(shear)


def test_a_restart_file_is_known_by_its_ends(tmp_path: Path) -> None:
    path = tmp_path / "x.restart"
    assert step_of(path) is None
    synthetic.write_restart(path, 123456789012)
    assert step_of(path) == 123456789012
    whole = path.read_bytes()
    for k in range(len(whole)):
        path.write_bytes(whole[:k])
        assert step_of(path) is None
    path.write_bytes(whole[:16] + bytes(4096) + whole[-16:])
    assert step_of(path) is None and not is_whole(path)
    path.write_bytes(whole)
    assert is_whole(path)


def test_one_of_liggghts_is_known_by_its_beginning(tmp_path: Path) -> None:
    path = tmp_path / "x.restart"
    path.write_bytes(
        struct.pack("=ii", 0, 90) + b"Version LIGGGHTS-PUBLIC 3.8.0, compiled 2022".ljust(90, b"\0") + bytes(64)
    )
    assert is_whole(path) and step_of(path) is None
    path.write_bytes(path.read_bytes()[:12])
    assert not is_whole(path)


def test_seals_are_those_of_sha256sum(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).write_text(name, encoding="utf-8")
    seal(tmp_path, ["a", "b", "none"])
    assert subprocess.run(["sha256sum", "-c", "SHA256SUMS"], cwd=tmp_path, check=False).returncode == 0
    (tmp_path / "a").write_text("c", encoding="utf-8")
    assert [look_at(tmp_path / name) for name in "abn"] == [Seal.ALTERED, Seal.INTACT, Seal.MISSING]
    with pytest.raises(ShearboxError, match="a has changed since it was written"):
        refuse_altered(tmp_path / "a")


def test_a_draft_that_is_a_link_is_not_followed(tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.write_text("of somebody else", encoding="utf-8")
    (tmp_path / "file.draft").symlink_to(other)
    write_text(tmp_path / "file", "ours")
    assert (tmp_path / "file").read_text(encoding="utf-8") == "ours"
    assert other.read_text(encoding="utf-8") == "of somebody else"


def test_a_record_that_is_lost_or_damaged_says_what_to_do(folder: Path) -> None:
    path = folder / "run.json"
    text = path.read_bytes()
    chance = random.Random(1)
    for _ in range(300):
        data = bytearray(text)
        data[chance.randrange(len(data))] = chance.randrange(256)
        path.write_bytes(data)
        try:
            read_record(folder)
        except ShearboxError as error:
            assert "run.json" in str(error) and "Put back a copy of it" in str(error)
    path.unlink()
    with pytest.raises(InputError, match="run.json is lost.* Put back a copy of it"):
        check_folder(folder, REQUEST)


def test_a_run_goes_on_where_shearbox_has_moved(folder: Path) -> None:
    """And the model is that of the record, whatever the decks say now: here they have another width."""
    path = folder / "run.json"
    record = json.loads(path.read_text(encoding="utf-8"))
    record["model_file"] = f"/gone/input/models/{MODEL.path.name}"
    record["identity"]["model width"] = 0.11
    path.write_text(json.dumps(record), encoding="utf-8")
    model = recorded(folder).model
    assert (model.path, model.width, model.half_height) == (MODEL.path, 0.11, MODEL.half_height)
    record["identity"]["model"], record["model_file"] = "own", "/gone/own.in"
    path.write_text(json.dumps(record), encoding="utf-8")
    with pytest.raises(InputError, match="the model of this run cannot be read: /gone/own.in: No such file"):
        recorded(folder)


@pytest.mark.parametrize("lost", ["identity", "stresses", "model width", "parameters"])
def test_a_record_that_lacks_something_is_refused(folder: Path, lost: str) -> None:
    path = folder / "run.json"
    record = json.loads(path.read_text(encoding="utf-8"))
    record.pop(lost, None)
    record.get("identity", {}).pop(lost, None)
    path.write_text(json.dumps(record), encoding="utf-8")
    with pytest.raises(ShearboxError, match="this is not the record of a run"):
        read_record(folder)


HOLD = "import sys, time; from pathlib import Path; from shearbox_tools.base.lock import locked\n"


@pytest.fixture(name="holder")
def _holder(folder: Path) -> Iterator[subprocess.Popen[bytes]]:
    code = f"{HOLD}with locked(Path({str(folder)!r})): print('held', flush=True); time.sleep(60)"
    tools = Path(__file__).resolve().parents[2] / "tools"
    with subprocess.Popen(
        ["/usr/bin/python3", "-c", code], stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(tools)}
    ) as process:
        assert process.stdout and process.stdout.readline() == b"held\n"
        yield process
        process.kill()


@pytest.mark.parametrize("lock_is_removed", [False, True])
def test_who_holds_the_lock_is_named(folder: Path, holder: subprocess.Popen[bytes], lock_is_removed: bool) -> None:
    if lock_is_removed:
        (folder / ".lock").unlink()
    with pytest.raises(ShearboxError, match=rf"process {holder.pid} \(python3\).*kill {holder.pid}"):
        with locked(folder):
            pass
    holder.kill()
    holder.wait()
    with locked(folder):
        pass


def test_a_file_system_without_locks_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: int) -> None:
        raise OSError(38, "Function not implemented")

    monkeypatch.setattr("fcntl.flock", refuse)
    with pytest.raises(ShearboxError, match="no file can be locked there .Function not implemented.*--out"):
        with locked(tmp_path):
            pass


@pytest.mark.parametrize("sign", [signal.SIGKILL, signal.SIGUSR1, signal.SIGQUIT])
def test_an_engine_ends_with_the_program_that_started_it(folder: Path, tmp_path: Path, sign: signal.Signals) -> None:
    engine = tmp_path / "engine"
    engine.write_text("#!/bin/sh\nexec sleep 60\n", encoding="utf-8")
    engine.chmod(0o755)
    started = os.fork()
    if not started:
        process = Engine(engine).start(all_phases(folder, REQUEST)[0], 0)
        (tmp_path / "id").write_text(str(process.pid), encoding="utf-8")
        os.kill(os.getpid(), sign)
    os.waitpid(started, 0)
    number = (tmp_path / "id").read_text(encoding="utf-8")
    end = time.monotonic() + 10
    while Path(f"/proc/{number}/stat").exists() and " Z " not in Path(f"/proc/{number}/stat").read_text():
        assert time.monotonic() < end, "it is still there"
        time.sleep(0.02)
