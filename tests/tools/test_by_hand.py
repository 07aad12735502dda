# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests run by hand: what a log tells, what is asked for, and which of them are one specimen. With logs of the real engine:
tests/decks/test_two_specimens.py."""

import json
from pathlib import Path

import pytest
import synthetic
from shearbox_tools.analysis.by_hand import read_by_hand
from shearbox_tools.analysis.grouping import put_together
from shearbox_tools.base.errors import ShearboxError
from shearbox_tools.commands import cli
from shearbox_tools.reading.readers import BED, read_shear
from shearbox_tools.reports.report_on import report_on

MODEL = "TypeA_10x5_4-8_1-circle_350"
LOG = """LAMMPS (29 Sep 2021)
include  ${{models}}/${{model}}.in
include  /decks/models/${{model}}.in
include  /decks/models/{model}.in
pair_style   cdem law ${{law}}
pair_style   cdem law incremental
pair_coeff   1 1 1e8 2.5e7 0.215 0.215 ${{friction}}
pair_coeff   1 1 1e8 2.5e7 0.215 0.215 31
fix         lower lower cdem/move speed $(v_speed/1000) ramp ${{climb}} stop $(v_travel/1000)
fix         lower lower cdem/move speed 0.0050000000000000001 ramp 4e-05 stop 0.0080000000000000002
fix         lid   lid   cdem/lid stress {sigma} width 0.1 thickness 0.01 vmax 10
"""


def write_test(folder: Path, sigma: float, log: str | None = "shear.log", packing: float | None = 1.0) -> Path:
    """shear.dat, a log by that name, and packed.csv of a packing that took so many steps."""
    folder.mkdir(parents=True)
    synthetic.write_shear(folder / "shear.dat", synthetic.curves(sigma, 8))
    if log:
        model = Path(__file__).resolve().parents[2] / "input" / "models" / MODEL
        text = LOG.format(model=MODEL, sigma=1000 * sigma).replace(f"/decks/models/{MODEL}", str(model))
        (folder / log).write_text(text, encoding="utf-8")
    if packing is not None:
        synthetic.write_row(folder / "packed.csv", **dict.fromkeys(BED, 1.0) | {"steps": packing})
    return folder


@pytest.mark.parametrize("log", ["shear.log", "log.lammps", "log.liggghts"])
def test_a_command_counts_once_all_its_values_are_there(tmp_path: Path, log: str) -> None:
    (run,), left_out = read_by_hand([write_test(tmp_path / "a", 150, log)], None, None)
    assert not left_out and run.complete
    identity = run.identity
    assert (identity["model"], identity["law"], identity["speed_mm_s"], identity["travel_mm"]) == (
        MODEL, "incremental", 5, 8,
    )  # fmt: skip
    assert identity["parameters"]["phi"] == "31" and run.stresses == [150]
    assert log in run.notes[0]


def test_stresses_of_a_packing_are_one_specimen(tmp_path: Path) -> None:
    """Packings are told apart by their tables; where there is none they are taken for one, which is said."""
    folders = [write_test(tmp_path / name, s, packing=p) for name, s, p in
               (("a", 100, 1), ("b", 200, 1), ("c", 100, 2), ("d", 300, None), ("e", 400, None))]  # fmt: skip
    runs, _ = read_by_hand(folders, None, None)
    assert [run.stresses for run in runs] == [[100, 200], [100], [300, 400]]
    assert len({run.identity["seed"] for run in runs}) == 3
    assert "no packed.csv tells of which packing it is: taken for one" in runs[2].notes
    assert runs[0].folder == tmp_path


def test_a_box_that_is_narrow_for_its_grains_is_told(tmp_path: Path) -> None:
    """As in the report of a run: the lid of the log is 5 cm wide, 6.25 grains of 8 mm."""
    log = write_test(tmp_path / "a", 100) / "shear.log"
    assert not any("grains wide" in note for note in read_by_hand([tmp_path / "a"], None, None)[0][0].notes)
    log.write_text(log.read_text(encoding="utf-8").replace("width 0.1 ", "width 0.05 "), encoding="utf-8")
    (run,), _ = read_by_hand([tmp_path / "a"], None, None)
    assert any("the box is 6.25 of its largest grains wide" in note for note in run.notes)


def test_tests_of_other_contacts_are_no_specimen_together(tmp_path: Path) -> None:
    """Rolling resistance, cohesion, walls, inertia and the friction of packing are told by commands of the logs; where they differ
    tests of a packing are no stresses of one specimen, and packings no ensemble."""
    ends = ["", "  cohesion 5", " rolling 0.1 0.215 "]
    for number, end in enumerate(ends):
        log = write_test(tmp_path / f"contacts_{number}", 100 + number) / "shear.log"
        log.write_text(log.read_text(encoding="utf-8").replace("0.215 31", "0.215 31" + end), encoding="utf-8")
    for number, command in enumerate(
        ("pair_coeff   1 2 1e8 2e7 0.215 0.215 15", "fix motion grains cdem/integrate dt check inertia 10")
    ):
        log = write_test(tmp_path / f"others_{number}", 200 + number) / "shear.log"
        log.write_text(f"{log.read_text(encoding='utf-8')}{command}\n", encoding="utf-8")
    loose = write_test(tmp_path / "loose", 300)
    pack = "pair_coeff   1 1 1e8 2.5e7 0.215 0.215 45\nwrite_restart packed.restart\n"
    (loose / "pack.log").write_text(pack, encoding="utf-8")
    runs, left_out = read_by_hand([*sorted(tmp_path.iterdir())], None, None)
    assert not left_out and [run.stresses for run in runs] == [[100], [101], [102], [300], [200], [201]]
    told = [run.identity["parameters"] for run in runs]
    assert [(one["rolling"], one["cohesion"]) for one in told[:3]] == [("0", "0"), ("0", "5"), ("0.1", "0")]
    assert told[3]["phi_packing"] == "45" and "phi_packing" not in told[0]
    assert (told[4]["ks_wall"], told[4]["phi_wall"], told[5]["inertia"]) == ("20000000", "15", "10")


PACK = """variable loose    index 1.8000000000000000444
cdem/create 2 row 0.002 -0.002 0.098 -0.002 ${{nwidth}} ${{disc}}
cdem/create 2 row 0.002 -0.002 0.098 -0.002 25 diameter {disc} density 26.5
cdem/create {kind} row -0.002  0.048 -0.002  0 {count} diameter 0.004 density 26.5
cdem/create 1 fill 350 region 0 0.1 0 {column} diameter 0.004 0.008 power -3               density 26.5 seed ${{seed}}
cdem/create 1 fill 350 region 0 0.1 0 {column} diameter 0.004 0.008 power -3               density 26.5 seed {seed}
write_restart packed.restart
"""


def test_boxes_with_other_walls_are_no_ensemble(tmp_path: Path) -> None:
    """Sides of 0.048 m in discs of 4 mm: 13 touch, 25 lie at half their diameter. A column of 0.18 m is 1.8 boxes high."""
    usual: dict[str, float] = {"kind": 3, "count": 13, "disc": 0.004, "column": 0.18, "seed": 1}
    others: list[dict[str, float]] = [
        {},
        {"seed": 2},
        {"kind": 2},
        {"kind": 2, "count": 25},
        {"disc": 0.002},
        {"column": 0.2},
    ]
    for number, other in enumerate(others):
        place = write_test(tmp_path / str(number), 100, packing=number)
        (place / "pack.log").write_text(PACK.format(**usual | other), encoding="utf-8")
    runs, _ = read_by_hand([*sorted(tmp_path.iterdir()), write_test(tmp_path / "x", 100)], None, None)
    assert [run.identity["seed"] for run in runs] == [1, 2, 1, 1, 1, 1, "unknown (2)"]
    told = [[run.identity["parameters"].get(name) for name in ("sides", "wall_disc", "side_pitch")] for run in runs]
    assert told[1:5] == [
        ["smooth", "1", None], ["discs", "1", "1"], ["discs", "1", "0.5"], ["smooth", "0.5", None]
    ]  # fmt: skip
    assert [run.identity.get("model loose") for run in runs] == [None] * 5 + ["2", None]
    ensembles, left_out = put_together(runs)
    assert [ensemble.count for ensemble in ensembles] == [2, 1, 1, 1, 1, 1] and not left_out
    unknown = "no pack.log tells the sides of the box, wall discs and the seed"
    assert [any(unknown in note for note in run.notes) for run in runs] == [False] * 6 + [True]


def test_stress_and_travel_are_as_told_to_six_digits_and_as_measured_to_three(tmp_path: Path) -> None:
    folder = write_test(tmp_path / "a", 125, log=None)
    (measured,), _ = read_by_hand([folder], MODEL, 2)
    assert measured.stresses == [125]
    told = write_test(tmp_path / "b", 33.3)
    log = (told / "shear.log").read_text(encoding="utf-8")
    log = log.replace("stress 33300.0", "stress 33299.999999999996362").replace("stop 0.008000", "stop 0.0080125")
    (told / "shear.log").write_text(log, encoding="utf-8")
    (run,), _ = read_by_hand([told], None, None)
    assert (run.stresses, run.identity["travel_mm"]) == ([33.3], 8.0125)


def test_a_packing_counts_once(tmp_path: Path) -> None:
    for name in ("a", "b"):
        write_test(tmp_path / name, 100)
    report_on(tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert len(summary["ensembles"][0]["specimens"]) == 1
    assert "the same packing as" in summary["left_out"][0]["reason"]


def shearbox(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str]:
    return cli.main(["report", *words]), capsys.readouterr().err


def test_what_no_log_tells_is_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = str(write_test(tmp_path / "a", 100, log=None))
    assert shearbox(capsys, folder) == (
        2, f"shearbox: {folder}: no log in it (shear.log, log.lammps or log.liggghts) tells the model: give --model, a name or a file\n",
    )  # fmt: skip
    status, message = shearbox(capsys, folder, "--model", MODEL)
    assert status == 2 and "tells the speed of the lower half: give --speed, in mm/s" in message
    assert shearbox(capsys, folder, "--model", MODEL, "--speed", "2")[0] == 0
    summary = json.loads((tmp_path / "a" / "summary.json").read_text(encoding="utf-8"))
    assert summary["stresses"][0]["sigma_kPa"] == 100
    assert "σ is the mean of its column" in summary["notes"][0]


def test_a_model_that_has_moved_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = write_test(tmp_path / "a", 100)
    log = folder / "shear.log"
    log.write_text(log.read_text(encoding="utf-8").replace(f"{MODEL}.in", "gone.in"), encoding="utf-8")
    status, message = shearbox(capsys, str(folder))
    assert status == 2 and "gone.in: No such file" in message and "--model tells a name or a file" in message


def test_a_test_that_was_stopped_or_damaged_is_left_out(tmp_path: Path) -> None:
    write_test(tmp_path / "whole", 100)
    synthetic.write_shear(write_test(tmp_path / "stopped", 200) / "shear.dat", synthetic.curves(200, 8), slice(0, 300))
    (write_test(tmp_path / "damaged", 300) / "shear.dat").write_text("# step\n1 2\n", encoding="utf-8")
    with pytest.raises(ShearboxError, match="not all files can be read"):
        report_on(tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert {one["folder"] for one in summary["left_out"]} == {"stopped", "damaged"}
    assert len(summary["ensembles"][0]["stresses"]) == 1


@pytest.mark.parametrize(
    "speed, message", [("0", "0.001 to 1000 mm/s"), ("nan", "0.001 to 1000"), ("x", "not a number")]
)
def test_a_speed_that_cannot_be_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], speed: str, message: str
) -> None:
    with pytest.raises(SystemExit):
        cli.main(["report", str(tmp_path), "--speed", speed])
    assert message in capsys.readouterr().err


def test_options_are_refused_where_the_record_tells(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "run.json").write_text("{}", encoding="utf-8")
    status, message = shearbox(capsys, str(tmp_path), "--speed", "2")
    assert status == 2 and "--speed 2.0: run.json tells it" in message


def test_the_folder_one_is_in_has_a_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    place = write_test(tmp_path / "test 7", 100, packing=None)
    monkeypatch.chdir(place)
    assert cli.main(["report", "."]) == 0
    summary = json.loads((place / "summary.json").read_text(encoding="utf-8"))
    assert summary["notes"][0].startswith("test 7: run by hand")


def test_one_specimen_has_the_report_of_a_run(tmp_path: Path) -> None:
    """With its pictures, also if it was stopped; without them if frames are gone, which is said."""
    place = write_test(tmp_path / "a", 100)
    synthetic.write_shear(place / "shear.dat", synthetic.curves(100, 8), slice(0, 300))
    page = report_on(place).read_text(encoding="utf-8")
    assert "data:image/webp" not in page and "no grains.dump, discs.dump, contacts.dump and so no picture" in page
    steps = [0, *(int(step) for step in read_shear(place / "shear.dat")["step"][99::100])]
    synthetic.write_frames(place, steps, 3)
    page = report_on(place).read_text(encoding="utf-8")
    assert "data:image/webp" in page and "sheared to 3.00 mm only" in page
    assert json.loads((place / "summary.json").read_text(encoding="utf-8"))["stresses"][0]["grains_lost"] is not None
    (place / "discs.dump").write_text("ITEM: nothing\n", encoding="utf-8")
    with pytest.raises(ShearboxError, match="discs.dump"):
        report_on(place)
