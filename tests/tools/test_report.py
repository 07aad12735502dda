# SPDX-License-Identifier: GPL-2.0-or-later
"""The report on folders that are complete, incomplete and damaged."""

import json
import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import synthetic

from shearbox_tools.analysis.moments import Film, count_lost, stress_tilt
from shearbox_tools.analysis.results import read_results
from shearbox_tools.asking.models import find_model
from shearbox_tools.asking.request import Request
from shearbox_tools.base.notes import said_once
from shearbox_tools.commands.cli import main
from shearbox_tools.drawing import curves
from shearbox_tools.drawing.style import PAPER_LOOKS, looks
from shearbox_tools.reports.page import minus, number, signs
from shearbox_tools.reports.run_report import report
from shearbox_tools.reports.summary import summarise

STRESSES = (100.0, 200.0)
STEPS = [0, 2000000, 4000000]


@pytest.fixture(name="folder")
def _folder(tmp_path: Path) -> Path:
    return write_run(tmp_path)


@pytest.fixture(name="reported", scope="module")
def _reported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same with its report; nobody changes what is in it."""
    folder = write_run(tmp_path_factory.mktemp("reported"))
    report(folder)
    return folder


def write_run(folder: Path) -> Path:
    synthetic.write_record(folder, Request(find_model("TypeA_10x5_4-8_1-circle_350"), STRESSES))
    (folder / "packed").mkdir()
    synthetic.write_row(folder / "packed" / "packed.csv", **synthetic.bed())
    for sigma in STRESSES:
        place = folder / f"{sigma:g}"
        place.mkdir()
        synthetic.write_row(place / "consolidated.csv", **synthetic.bed(), sigma_kPa=sigma)
        synthetic.write_shear(place / "shear.dat", synthetic.curves(sigma, 8))
        synthetic.write_frames(place, STEPS, 8)
    return folder


def summary(folder: Path) -> dict:
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def test_the_page_stands_alone_and_is_well_formed(reported: Path) -> None:
    page = (reported / "report.html").read_text(encoding="utf-8")
    links = re.findall(r'(?:src|href)="([^"]{0,60})', page)
    assert [link for link in links if not link.startswith("data:")] == ["https://doi.org/10.15002/00007990"]
    assert len([link for link in links if link.startswith("data:image/svg+xml")]) == 13, "diagrams, scales of colours"
    assert len([link for link in links if link.startswith("data:image/webp")]) == 2 * 3 * (2 + 3), "pictures and maps"
    assert all(re.findall(r'<img [^>]*alt="(.*?)"', page)) and page.count("<img ") == page.count(' alt="')
    told = float(re.findall(r"one file of (\S+) MB", page)[0])
    assert 1e6 * told == pytest.approx(len(page.encode()), abs=5e4)
    assert not re.search(r"<script[^>]* src|<link|@import|fetch\(", page) and "{{" not in page and "{%" not in page
    checker = TagChecker()
    checker.feed(page)
    assert not checker.open_tags


class TagChecker(HTMLParser):
    """Every tag that is opened is closed, in order."""

    VOID = {"meta", "img", "br", "link", "input"}

    def __init__(self) -> None:
        super().__init__()
        self.open_tags: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in self.VOID:
            self.open_tags.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open_tags.pop() == tag, f"</{tag}> at line {self.getpos()[0]}"


def add_plane(folder: Path) -> None:
    """On the plane 20 kPa more than the lid's, and half of tau; and 0.8 of tau, as if grains under flanges bore the rest."""
    for sigma in STRESSES:
        curve = synthetic.curves(sigma, 8)
        curve["plane_kPa"] = sigma + 20 + curve["tau_kPa"] / 2
        curve["plane_tau_kPa"] = 0.8 * curve["tau_kPa"]
        synthetic.write_shear(folder / f"{sigma:g}" / "shear.dat", curve)


def test_both_strengths_stand_side_by_side(folder: Path, reported: Path) -> None:
    """tau = 5 + 0.5 lid is tau = -4 + 0.4 plane where plane = lid + 20 + tau / 2, and 0.8 tau = -3.2 + 0.32 plane."""
    page = (reported / "report.html").read_text(encoding="utf-8")
    assert "on the shear plane" not in page and summary(reported)["phi_plane_deg"] is None
    add_plane(folder)
    page = report(folder).read_text(encoding="utf-8")
    result = summary(folder)
    assert np.tan(np.radians([result["phi_deg"], result["phi_plane_deg"]])) == pytest.approx([0.5, 0.32], abs=0.03)
    assert result["c_plane_kPa"] == pytest.approx(-3.2, abs=4)
    first = result["stresses"][0]
    assert first["plane_at_peak_kPa"] == pytest.approx(120 + first["tau_peak_kPa"] / 2, rel=0.01)
    assert first["plane_tau_peak_kPa"] == pytest.approx(0.8 * first["tau_peak_kPa"], rel=1e-5)
    by_plane = first["plane_tau_peak_kPa"] / first["plane_at_peak_kPa"]
    assert re.search(rf"τ/σ on the shear plane</th><td>{by_plane:.3f}</td>", page)
    assert f"{result['phi_plane_deg']:.1f}" in headline(page)


def test_stress_ratios_have_one_scale(folder: Path) -> None:
    add_plane(folder)
    scales = {f.axes[0].get_ylim() for f in curves.stress_ratios(read_results(folder)).values()}
    assert len(scales) == 1


def test_further_columns_have_diagrams(folder: Path) -> None:
    """If the tables of all stresses have them, and unless they are zero all along; the page says what they are."""
    for sigma in STRESSES:
        curve = synthetic.curves(sigma, 8)
        curve["sides_upper_kPa"] = np.zeros(800)
        curve["coordination"] = np.full(800, 3.0)
        if sigma == 100:
            curve["inertial"] = np.zeros(800)
        synthetic.write_shear(folder / f"{sigma:g}" / "shear.dat", curve)
    assert list(curves.other_columns(read_results(folder))) == ["coordination", "trm", "kinetic_J"]
    page = report(folder).read_text(encoding="utf-8")
    assert (
        "<figcaption>Contacts of a grain, with grains and walls: mean" in page
        and "Column coordination of curve.csv" in page
    )


@pytest.mark.usefixtures("undrawn")
def test_of_one_stress_the_page_says_what_strength_needs(folder: Path) -> None:
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    (folder / "run.json").write_text(json.dumps(record | {"stresses": [STRESSES[0]]}), encoding="utf-8")
    needed = "friction angle φ, cohesion c: two normal stresses or more are needed"
    assert needed in report(folder).read_text(encoding="utf-8")
    (folder / "run.json").write_text(json.dumps(record), encoding="utf-8")
    assert needed not in report(folder).read_text(encoding="utf-8")


def test_a_remark_is_said_once() -> None:
    assert said_once([(100, "slow"), (200, "fast"), (300, "slow")]) == ["100, 300 kPa: slow", "200 kPa: fast"]


def test_numbers_of_the_summary(reported: Path) -> None:
    result = summary(reported)
    first = result["stresses"][0]
    assert result["complete"] and not result["notes"]
    assert first["tau_peak_kPa"] == pytest.approx(55, abs=2)
    assert first["displacement_at_peak_mm"] == pytest.approx(2.5, abs=1.2)
    assert first["felt_stress_error_percent"] == pytest.approx(0, abs=0.05)
    assert first["trm"] == pytest.approx(0.8, abs=0.01)
    assert first["grains_lost"] == 0 and first["dangerous_builds"] == 0
    assert first["energy_error_percent"] == pytest.approx(-0.02)
    assert first["consolidation"]["height_m"] == 0.0987
    assert first["dt_s"] == pytest.approx(0.01 / 2 / synthetic.STEPS_PER_ROW)
    assert result["criteria"]["dilates"]["holds"]
    assert result["criteria"]["proportional"]["holds"] is None, "two stresses cannot show it"


def test_the_table_behind_the_curves(reported: Path) -> None:
    table: np.ndarray = np.genfromtxt(reported / "200" / "curve.csv", delimiter=",", names=True)
    truth = synthetic.curves(200, 8)
    assert table.dtype.names and table.dtype.names[:4] == ("displacement_mm", "tau_kPa", "sigma_kPa", "lid_mm")
    assert table["tau_kPa"] == pytest.approx(truth["tau_kPa"], rel=1e-6)
    assert np.std(table["tau_kPa"] - table["tau_fit_kPa"]) == pytest.approx(4, abs=1)
    half = slice(300, 500)
    slope = np.gradient(table["lid_fit_mm"], table["displacement_mm"])
    assert table["dilatancy_rate"][half] == pytest.approx(slope[half], abs=1e-3)


@pytest.mark.usefixtures("undrawn")
def test_a_test_of_many_steps_that_stands_still_in_half_of_its_rows(folder: Path) -> None:
    """Steps beyond 10^8 have all their digits; rows are means over what the box moves in them."""
    table = synthetic.curves(100, 8)
    table |= {"step": 1234567 * np.arange(1.0, 801), "displacement_mm": np.minimum(2 * table["displacement_mm"], 8)}
    synthetic.write_shear(folder / "100" / "shear.dat", table)
    page = report(folder).read_text(encoding="utf-8")
    assert "averages over\n  0.02 mm" in page
    written: np.ndarray = np.genfromtxt(folder / "100" / "curve.csv", delimiter=",", names=True)
    assert written["step"].tolist() == table["step"].tolist()


def test_the_same_folder_gives_the_same_files(reported: Path) -> None:
    names = ("summary.json", "report.html", "100/curve.csv")
    before = [(reported / name).read_bytes() for name in names]
    report(reported)
    assert [(reported / name).read_bytes() for name in names] == before


@pytest.mark.usefixtures("undrawn")
def test_a_missing_stress_is_said(folder: Path) -> None:
    (folder / "200" / "shear.dat").unlink()
    page = report(folder).read_text(encoding="utf-8")
    assert "200 kPa: not sheared yet" in page
    assert not summary(folder)["complete"]


@pytest.mark.usefixtures("undrawn")
def test_an_unfinished_stress_is_said(folder: Path) -> None:
    synthetic.write_shear(folder / "200" / "shear.dat", synthetic.curves(200, 8), slice(0, 300))
    assert "200 kPa: sheared to 3.00 mm only" in report(folder).read_text(encoding="utf-8")
    assert not summary(folder)["complete"]


def headline(page: str) -> str:
    """What the page says in its largest type, one card a line."""
    return "\n".join(" ".join(re.sub("<[^>]+>", "", big).split()) for big in re.findall(r"<b>(.*?)</b>", page, re.S))


def test_the_headline_of_one_specimen_names_what_is_not_in_it(reported: Path) -> None:
    page = (reported / "report.html").read_text(encoding="utf-8")
    assert re.match(r"(\d+\.\d ± \d+\.\d°)", headline(page))
    assert "± of the fit alone; one specimen: its own scatter is not in it" in page
    assert summary(reported)["interval_holds_scatter_of_specimens"] is False


@pytest.mark.usefixtures("undrawn")
def test_an_unfinished_test_has_no_headline(folder: Path) -> None:
    synthetic.write_shear(folder / "200" / "shear.dat", synthetic.curves(200, 8), slice(0, 13))
    big = headline(report(folder).read_text(encoding="utf-8"))
    assert "°" not in big and "kPa" not in big
    assert big.split("\n").count("open") == 3, "all but whether it is quasi-static"
    result = summary(folder)
    assert result["phi_deg"] is None and result["doubts"] == ["200 kPa: sheared to 0.12 mm only"]
    assert [c["holds"] for name, c in result["criteria"].items() if name != "quasi_static"] == [None] * 3


def test_a_stress_that_is_missing_leaves_no_headline(folder: Path) -> None:
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    (folder / "run.json").write_text(json.dumps({**record, "stresses": [100, 200, 300]}), encoding="utf-8")
    result = summarise(read_results(folder))
    assert result["phi_deg"] is None and result["doubts"] == ["300 kPa: there is no curve"]


def test_negative_stress_is_drawn(folder: Path) -> None:
    """The axis of the stress goes as far down as the data: nothing is cut."""
    curve = synthetic.curves(200, 8)
    curve["tau_kPa"][400:410] = -300
    synthetic.write_shear(folder / "200" / "shear.dat", curve)
    low, high = curves.stress(read_results(folder)).axes[0].get_ylim()
    assert low < -300 and high > 100


def test_spikes_of_start_and_stop_do_not_widen_the_axis(folder: Path) -> None:
    """Nine rows of a ramp and forty after the stop have ten times the stress of the others."""
    curve = synthetic.curves(200, 8)
    curve["tau_kPa"][:9] = 1000
    curve["tau_kPa"][760:] = -1000
    curve["displacement_mm"][:9] = curve["displacement_mm"][9] - 0.001 * np.cumsum(np.arange(9, 0, -1))[::-1]
    curve["displacement_mm"][760:] = curve["displacement_mm"][759] + 0.004
    synthetic.write_shear(folder / "200" / "shear.dat", curve)
    low, high = curves.stress(read_results(folder)).axes[0].get_ylim()
    assert -10 <= low <= 0 and 100 < high < 150


def test_a_fast_test_is_said(folder: Path) -> None:
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    record["identity"]["speed_mm_s"] = 1000.0
    (folder / "run.json").write_text(json.dumps(record), encoding="utf-8")
    result = summarise(read_results(folder))
    assert result["notes"][0] == "100, 200 kPa: not quasi-static; shear more slowly"
    assert "inertial number 14" in result["stresses"][0]["criteria"]["quasi_static"]["reason"]
    assert result["criteria"]["quasi_static"] == {"holds": False, "reason": "not at 100 kPa, 200 kPa"}


def test_the_strength_at_the_end(folder: Path) -> None:
    """Residual 0.3 sigma, reached to 1 % in the last fifth, without noise but for that of the curve."""
    first = summarise(read_results(folder))["stresses"][0]
    assert first["tau_ultimate_kPa"] == pytest.approx(np.mean(synthetic.curves(100, 8)["tau_kPa"][640:]), rel=1e-5)
    assert first["at_end"]["stress_ratio"] == pytest.approx(first["tau_ultimate_kPa"] / 100, rel=1e-5)
    assert first["at_end"]["is_critical"] and not first["at_peak"]["is_critical"]


@pytest.mark.usefixtures("undrawn")
def test_too_few_rows_are_said(folder: Path) -> None:
    synthetic.write_shear(folder / "200" / "shear.dat", synthetic.curves(200, 8), slice(0, 3))
    assert "200 kPa: 3 rows at full speed only" in report(folder).read_text(encoding="utf-8")


@pytest.mark.usefixtures("undrawn")
def test_a_curve_that_still_rises_is_said(folder: Path) -> None:
    curve = synthetic.curves(200, 8)
    curve["tau_kPa"] = 12 * curve["displacement_mm"] + np.random.default_rng(1).normal(size=800)
    synthetic.write_shear(folder / "200" / "shear.dat", curve)
    assert "200 kPa: τ has no peak within the travel" in report(folder).read_text(encoding="utf-8")
    assert summary(folder)["stresses"][1]["peak_at_boundary"]
    assert summary(folder)["complete"]


DAMAGED = [
    ("200/shear.dat", "1 2 3\n", "shear.dat, line 1: a header"),
    ("200/discs.dump", "", "discs.dump: the file is empty"),
    ("200/contacts.dump", "ITEM: ATOMS\n", "contacts.dump, line 1: 'ITEM: TIMESTEP' is expected"),
    ("200/grains.dump", "", "grains.dump: the file is empty"),
    ("200/consolidated.csv", "a,b\n1,?\n", "consolidated.csv, line 2: not a number"),
    ("packed/packed.csv", "", "packed.csv: a header and a row"),
]


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("name, text, message", DAMAGED, ids=[name for name, _, _ in DAMAGED])
def test_damage_is_named_and_the_rest_is_reported(
    folder: Path, capsys: pytest.CaptureFixture[str], name: str, text: str, message: str
) -> None:
    (folder / name).write_text(text, encoding="utf-8")
    assert main(["report", str(folder)]) == 1
    assert message in capsys.readouterr().err
    assert message in (folder / "report.html").read_text(encoding="utf-8").replace("&#39;", "'")
    assert summary(folder)["stresses"][0]["tau_peak_kPa"] == pytest.approx(55, abs=2)


@pytest.mark.usefixtures("undrawn")
def test_text_from_files_is_not_taken_for_tags(folder: Path) -> None:
    (folder / "200" / "shear.dat").write_text("<b>bold</b>\n", encoding="utf-8")
    assert main(["report", str(folder)]) == 1
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "<b>bold" not in page and "&lt;b&gt;bold" in page


def test_missing_dumps_cost_the_pictures_only(folder: Path) -> None:
    for name in ("grains", "discs", "contacts"):
        (folder / "100" / f"{name}.dump").unlink()
    assert main(["report", str(folder)]) == 0
    assert "100 kPa: no grains.dump, discs.dump, contacts.dump and so no picture" in summary(folder)["notes"][0]
    assert summary(folder)["complete"]
    assert summary(folder)["stresses"][0]["grains_lost"] is None


def test_missing_cells_cost_the_maps_only(folder: Path) -> None:
    for sigma in STRESSES:
        (folder / f"{sigma:g}" / "cells.dump").unlink()
    assert main(["report", str(folder)]) == 0
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert page.count("data:image/webp") == 2 * 3 * 2 and "Fields" not in page
    assert summary(folder)["notes"] == []


def test_nothing_to_report_on(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for sigma in STRESSES:
        (folder / f"{sigma:g}" / "shear.dat").unlink()
    assert main(["report", str(folder)]) == 1
    assert "nothing to report on yet" in capsys.readouterr().err
    assert not (folder / "report.html").exists()


@pytest.mark.parametrize("place", ["none", "."])
def test_a_folder_without_a_run(tmp_path: Path, capsys: pytest.CaptureFixture[str], place: str) -> None:
    assert main(["report", str(tmp_path / place)]) == 1
    assert "holds no run: there is no run.json in it" in capsys.readouterr().err


@pytest.mark.usefixtures("undrawn")
def test_a_full_disk_keeps_the_earlier_report(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    report(folder)
    before = (folder / "summary.json").read_bytes()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    assert main(["report", str(folder)]) == 1
    assert "No space left on device" in capsys.readouterr().err
    assert (folder / "summary.json").read_bytes() == before
    assert not list(folder.rglob("*.draft"))


@pytest.mark.usefixtures("undrawn")
def test_without_an_audit_there_is_no_energy_error(folder: Path) -> None:
    curve = synthetic.curves(100, 8)
    curve["work_J"][:] = curve["residual_J"][:] = 0
    synthetic.write_shear(folder / "100" / "shear.dat", curve)
    report(folder)
    first = json.loads((folder / "summary.json").read_text())["stresses"][0]
    assert first["energy_error_percent"] is None


def test_dangerous_builds_are_summed_over_continuations(folder: Path) -> None:
    curve = synthetic.curves(100, 8)
    curve["dangerous"][:] = np.concatenate([np.repeat([0, 2, 3], 100), np.repeat([0, 1], 250)])
    synthetic.write_shear(folder / "100" / "shear.dat", curve)
    assert read_results(folder).shears[0].dangerous_builds == 4


@pytest.mark.parametrize(
    "place, lost",
    [
        ((0.05, 0.05), 0),
        ((-0.01, 0.08), 1),
        ((0.101, 0.02), 0),
        ((0.115, 0.02), 1),
        ((0.05, -0.02), 1),
        ((0.05, 0.12), 1),
    ],
)
def test_a_grain_outside_the_box_is_lost(folder: Path, place: tuple[float, ...], lost: int) -> None:
    path = folder / "100" / "grains.dump"
    lines = path.read_text(encoding="utf-8").splitlines()
    last = max(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
    words = lines[last].split()
    lines[last] = " ".join([*words[:2], *map(str, place), *words[4:]])
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    assert count_lost(folder / "100", 350, 0.1, 0.05) == lost
    del lines[last]
    lines[max(i for i, line in enumerate(lines) if "NUMBER OF" in line) + 1] = str(len(lines) - last)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    assert count_lost(folder / "100", 350, 0.1, 0.05) == 1, "a grain that is gone"


@pytest.mark.parametrize("tilt, told", [(0.6, True), (-0.6, True), (0.4, False)])
def test_a_normal_stress_that_is_not_even_is_told(folder: Path, tilt: float, told: bool) -> None:
    """Two layers of four cells, a straight line along x: 1 - tilt to 1 + tilt times the mean from end to end of the box."""
    rows = [(0.0125 + 0.025 * i, 0.025 + 0.05 * j) for j in range(2) for i in range(4)]
    cells = [f"{x} {y} 0.8 900 {1000 * (1 + tilt * (x - 0.05) / 0.05) + 10 * (y - 0.05)} 0" for x, y in rows]
    head = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n8\nITEM: ENTRIES x y solid stress_xx stress_yy stress_xy\n"
    (folder / "100" / "cells.dump").write_text(head + "\n".join(cells) + "\n", encoding="utf-8")
    assert stress_tilt(folder / "100") == pytest.approx(tilt)
    remarks = " ".join(read_results(folder).shears[0].remarks)
    assert (f"goes from {1 - tilt:.2f} of its mean at the left end of the box to {1 + tilt:.2f}" in remarks) == told


def test_the_lid_of_a_thin_specimen(tmp_path: Path) -> None:
    """It is found by what the deck says, not by its place: here it lies where the halves meet."""
    names = "id x y radius v_angle v_wall v_lower v_lid"
    floor, lid, grain = "1 0.05 -0.002 0.002 0 1 1 0", "2 0.05 0.054 0.002 0 1 0 1", "3 0.05 {} 0.003 0 0 0 0"
    for height, lost in ((0.049, 0), (0.053, 0), (0.058, 1)):
        rows = "\n".join([floor, lid, grain.format(height)])
        head = f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: ATOMS {names}\n"
        (tmp_path / "grains.dump").write_text(f"{head}{rows}\n", encoding="utf-8")
        assert count_lost(tmp_path, 1, 0.1, 0.05) == lost, height


def test_frames_are_found_by_displacement(folder: Path) -> None:
    truth = synthetic.curves(100, 8)
    film = Film(folder / "100", truth["step"], truth["displacement_mm"])
    assert film.first().displacement == pytest.approx(0, abs=0.01)
    assert film.at(4.4).displacement == pytest.approx(4, abs=0.01)
    assert film.last().displacement == pytest.approx(8, abs=0.01)
    branches = film.last().branches()
    lengths = np.hypot(*(branches[:, 0] - branches[:, 2]).T)
    assert len(branches) > 500 and np.ptp(lengths) < 0.1 * lengths.mean()
    assert branches[:, 1] == pytest.approx((branches[:, 0] + branches[:, 2]) / 2, abs=1e-8)
    assert not np.any(film.first().rotation_since(film.first()))
    turned = film.last().rotation_since(film.first())
    assert turned == pytest.approx(film.last().grains["angle"] - film.first().grains["angle"], abs=1e-4)
    assert np.ptp(turned) > 1


def test_looks_of_the_paper_and_others() -> None:
    chosen = looks([50.0, 100.0, 200.0, 300.0, 400.0, 450.5])
    assert [chosen[s] for s in (100.0, 200.0, 300.0, 400.0)] == list(PAPER_LOOKS.values())


def test_any_of_colour_dashes_and_mark_tells_ten_stresses_apart() -> None:
    chosen = looks([100, 200, 300, 400, 10, 20, 30, 40, 50, 60]).values()
    for values in ([x.colour for x in chosen], [str(x.dashes) for x in chosen], [x.mark for x in chosen]):
        assert len(set(values)) == 10


@pytest.mark.parametrize("value, text", [(None, "–"), (0.00008, "8e−5"), (-1.5, "−1.5"), (350, "350"), (2e6, "2e6")])
def test_numbers_as_people_write_them(value: float | None, text: str) -> None:
    assert number(value) == text


@pytest.mark.parametrize("text, shown", [("-0.00", "0.00"), ("+0.00", "0.00"), ("-0.01", "−0.01"), ("+1.5", "+1.5")])
def test_signs(text: str, shown: str) -> None:
    assert minus(text) == shown


@pytest.mark.parametrize(
    "text, shown",
    [
        ("τ = -5 kPa (≤ 1e-3)", "τ = −5 kPa (≤ 1e−3)"),
        ("TypeA_10x5_4-8 in /a-1/seed_1-3, quasi-static", "TypeA_10x5_4-8 in /a-1/seed_1-3, quasi-static"),
    ],
)
def test_signs_of_numbers_are_no_hyphens(text: str, shown: str) -> None:
    assert signs(text) == shown
