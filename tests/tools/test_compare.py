# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox compare`: intervals of differences against SciPy's tests, which packings are paired, what is left out."""

import csv
import html
import json
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic
from ensembles import REQUEST, only, specimens, write_run
from scipy import stats

from shearbox_tools.analysis.comparison import (
    ALONE,
    PAIRED,
    PAIRED_TESTS,
    SOME_SHARED,
    WELCH,
    Comparison,
    same_packings,
)
from shearbox_tools.analysis.ensemble_results import Ensemble
from shearbox_tools.analysis.results import Results, read_results
from shearbox_tools.commands.cli import main

STRESSES = (100.0, 200.0, 300.0)
OUTSIDE = 0.05


@pytest.fixture(name="base", scope="module")
def _base(tmp_path_factory: pytest.TempPathFactory) -> Results:
    return read_results(write_run(tmp_path_factory.mktemp("base") / "run", REQUEST))


def found(comparison: Comparison, name: str, sigma: float | None = None) -> Any:
    """A Quantity, of which a test knows what is there and what is None."""
    (quantity,) = [q for q in comparison.quantities if q.name == name and q.sigma == sigma]
    return quantity


def lines(runs: list[Results]) -> tuple[np.ndarray, np.ndarray]:
    """phi (degrees, to first order around that of the mean slope) and c of each; numpy's fit knows nothing of ours."""
    fits = [
        np.polyfit([1 / s.sigma for s in run.shears], [s.peak.value / s.sigma for s in run.shears], 1) for run in runs
    ]
    c, slope = np.transpose(fits)
    middle = slope.mean()
    return np.degrees(np.arctan(middle) + (slope - middle) / (1 + middle**2)), c


def trms(runs: list[Results]) -> np.ndarray:
    return np.array([run.shears[0].data["trm"][-1] for run in runs])


def test_welch(base: Results) -> None:
    """Shifted by an end of the interval, Welch's test finds the other ensemble just as improbable as is outside."""
    one, other = specimens(base, [1, 2, 3, 4, 5]), specimens(base, [11, 12, 13, 14], 0.1)
    comparison = Comparison([Ensemble(one), Ensemble(other)])
    assert comparison.methods == [None, WELCH] and comparison.stresses == list(STRESSES)
    for name, a, b in (
        ("phi_deg", lines(one)[0], lines(other)[0]),
        ("c_kPa", lines(one)[1], lines(other)[1]),
        ("trm", trms(one), trms(other)),
    ):
        told = found(comparison, name).differences[1]
        assert told.value == pytest.approx(b.mean() - a.mean()), name
        assert told.low < told.value < told.high
        for end in (told.low, told.high):
            assert stats.ttest_ind(b - end, a, equal_var=False).pvalue == pytest.approx(OUTSIDE), name
    ratios = [np.array([run.shears[1].peak.value / 200 for run in runs]) for runs in (one, other)]
    told = found(comparison, "ratio_at_peak", 200).differences[1]
    assert stats.ttest_ind(ratios[1] - told.low, ratios[0], equal_var=False).pvalue == pytest.approx(OUTSIDE)


def test_the_means_are_those_of_the_ensembles_report(base: Results) -> None:
    ensemble = Ensemble(specimens(base, [1, 2, 3]))
    comparison = Comparison([ensemble, Ensemble(specimens(base, [4, 5], 0.1))])
    phi, strength = found(comparison, "phi_deg").means[0], ensemble.strength
    assert strength and [phi.value, phi.low, phi.high] == pytest.approx(
        [float(v) for v in (strength.phi_deg.value, strength.phi_deg.low, strength.phi_deg.high)]
    )
    end = found(comparison, "phi_ultimate_deg").means[0]
    ultimate = ensemble.ultimate_angle
    assert ultimate and end.value == pytest.approx(float(ultimate.value))


def test_the_same_packings_are_paired_by_seed(base: Results) -> None:
    """In whatever order; the scatter of packings, which is most of it, is not in the interval."""
    one, other = specimens(base, [1, 2, 3, 4]), specimens(base, [1, 2, 3, 4], 0.1)
    comparison = Comparison([Ensemble(one), Ensemble(other[::-1])])
    assert comparison.methods == [None, PAIRED]
    for name, a, b in (("phi_deg", lines(one)[0], lines(other)[0]), ("trm", trms(one), trms(other))):
        told = found(comparison, name).differences[1]
        wanted = stats.ttest_rel(b, a).confidence_interval(1 - OUTSIDE)
        assert (told.low, told.high) == pytest.approx((wanted.low, wanted.high)), name
    mean = found(comparison, "trm").means[0]
    assert told.high - told.low < 0.6 * (mean.high - mean.low)


def test_which_packings_are_the_same(base: Results) -> None:
    one = specimens(base, [1, 2, 3])
    faster = [replace(run, identity=run.identity | {"speed_mm_s": 10.0}) for run in specimens(base, [1, 2, 3], 0.1)]
    assert same_packings(Ensemble(one), Ensemble(faster))
    assert not same_packings(Ensemble(one), Ensemble(specimens(base, [1, 2, 4])))
    assert not same_packings(Ensemble(one), Ensemble(specimens(base, [1, 2])))
    packed_otherwise = [*one[:2], replace(one[2], packing=(one[2].packing or {}) | {"kinetic_J": 1e-9})]
    assert not same_packings(Ensemble(one), Ensemble(packed_otherwise))
    some = Comparison([Ensemble(one), Ensemble(specimens(base, [2, 3, 4], 0.1))])
    assert some.methods == [None, SOME_SHARED], "not independent"
    unknown = [replace(run, packing=None) for run in one]
    assert not same_packings(Ensemble(unknown), Ensemble(unknown))


def test_one_specimen_has_no_interval(base: Results) -> None:
    alone = specimens(base, [9], 0.1)
    comparison = Comparison([Ensemble(specimens(base, [1, 2, 3])), Ensemble(alone)])
    assert comparison.methods == [None, ALONE]
    for name in ("phi_deg", "c_kPa", "trm"):
        quantity = found(comparison, name)
        assert quantity.means[1].low is None and quantity.differences[1].low is None
        assert quantity.differences[1].value == pytest.approx(quantity.means[1].value - quantity.means[0].value)
    assert found(comparison, "phi_deg").means[1].value == pytest.approx(lines(alone)[0][0])


def test_numbers_are_at_the_stresses_that_all_have(base: Results) -> None:
    whole = specimens(base, [1, 2, 3])
    some = [only(run, 100.0, 300.0) for run in specimens(base, [4, 5], 0.1)]
    comparison = Comparison([Ensemble(whole), Ensemble(some)])
    assert comparison.stresses == [100, 300]
    assert {q.sigma for q in comparison.quantities} == {None, 100, 300}
    at_those = lines([only(run, 100.0, 300.0) for run in whole])[0]
    assert found(comparison, "phi_deg").means[0].value == pytest.approx(at_those.mean())
    other = Comparison([Ensemble([only(run, 100.0) for run in whole]), Ensemble([only(run, 300.0) for run in some])])
    assert other.stresses == [] and other.quantities == []
    of_one = Comparison([Ensemble(whole), Ensemble([only(run, 300.0) for run in some])])
    assert {q.name for q in of_one.quantities if q.sigma is None} == {"phi_ultimate_deg", "dilation_at_peak_deg", "trm"}


def test_packings_of_their_own_for_each_stress(base: Results) -> None:
    """The line of a regression and its errors, as SciPy's linregress has them of tau / sigma over 1 / sigma."""
    both, lots = [], []
    for seeds, shift in (([1, 2, 3, 4, 5, 6], 0.0), ([11, 12, 13, 14, 15], 0.1)):
        runs = [only(run, STRESSES[k % 3]) for k, run in enumerate(specimens(base, seeds, shift))]
        points = np.array([(1 / s.sigma, s.peak.value / s.sigma) for run in runs for s in run.shears])
        both.append(Ensemble(runs))
        lots.append((stats.linregress(*points.T), len(points) - 2))
    told = found(Comparison(both), "c_kPa").differences[1]
    (a, freedom_a), (b, freedom_b) = lots
    assert told.value == pytest.approx(b.slope - a.slope)
    for end in (told.low, told.high):
        shifted = stats.ttest_ind_from_stats(
            b.slope - end, b.stderr * np.sqrt(freedom_b + 1), freedom_b + 1,
            a.slope, a.stderr * np.sqrt(freedom_a + 1), freedom_a + 1, equal_var=False,
        )  # fmt: skip
        assert shifted.pvalue == pytest.approx(OUTSIDE)
    phi = found(Comparison(both), "phi_deg")
    errors = [np.degrees(fit.intercept_stderr / (1 + fit.intercept**2)) for fit, _ in lots]
    assert [mean.error for mean in phi.means] == pytest.approx(errors)


def test_the_same_packings_of_their_own_for_each_stress_are_paired(base: Results) -> None:
    """Test by test, at a stress and over all; lines are compared as of independent packings, since a line is of many of them."""
    one, other = (
        [only(run, STRESSES[k % 3]) for k, run in enumerate(specimens(base, [1, 2, 3, 4, 5, 6], shift))]
        for shift in (0.0, 0.1)
    )
    comparison = Comparison([Ensemble(one), Ensemble(other[::-1])])
    assert comparison.methods == [None, PAIRED_TESTS]
    for some, sigma in ((slice(None), None), (slice(1, None, 3), 200.0)):
        told = found(comparison, "trm", sigma).differences[1]
        wanted = stats.ttest_rel(trms(other)[some], trms(one)[some]).confidence_interval(1 - OUTSIDE)
        assert (told.low, told.high) == pytest.approx((wanted.low, wanted.high))
    apart = Comparison([Ensemble(one), Ensemble([replace(run, packing=None) for run in other])])
    told, welch = (found(of, "phi_deg").differences[1] for of in (comparison, apart))
    assert apart.methods == [None, WELCH] and (told.low, told.high) == pytest.approx((welch.low, welch.high))
    elsewhere = [only(run, STRESSES[(k + 1) % 3]) for k, run in enumerate(specimens(base, [1, 2, 3, 4, 5, 6], 0.1))]
    assert Comparison([Ensemble(one), Ensemble(elsewhere)]).methods == [None, SOME_SHARED]


@pytest.fixture(name="folder", scope="module")
def _folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two packings, each sheared at two speeds, the faster ones half as strong again; and one that was stopped."""
    folder = tmp_path_factory.mktemp("runs")
    for name, speed, strong in (("A", 2.0, 1.0), ("B", 10.0, 1.5)):
        for seed in (1, 2):
            request = replace(REQUEST, stresses=(100.0,), seed=seed, speed=speed)
            run = write_run(folder / name / f"seed_{seed}", request, strong * (0.9 + 0.1 * seed))
            (run / "packed").mkdir()
            synthetic.write_row(run / "packed" / "packed.csv", **synthetic.bed() | {"kinetic_J": 1e-12 * seed})
    write_run(folder / "stopped", replace(REQUEST, stresses=(100.0,), seed=3, speed=10.0), rows=400)
    return folder


def test_a_folder_of_two_ensembles(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "new" / "folder"
    assert main(["compare", str(folder), "--out", str(out)]) == 0
    without = [
        f"no φ and c of {name} ({folder}): stresses that all specimens have: 1; at least 2 are needed" for name in "AB"
    ]
    assert capsys.readouterr().out.splitlines() == [*without, f"compare: {out / 'compare.html'}"]
    summary = json.loads((out / "compare.json").read_text(encoding="utf-8"))
    assert [(e["name"], e["differs"], e["seeds"], e["method"]) for e in summary["ensembles"]] == [
        ("A", "speed 2 mm/s", [1, 2], None),
        ("B", "speed 10 mm/s", [1, 2], PAIRED),
    ]
    assert [one["folder"] for one in summary["left_out"]] == [str(folder / "stopped")]
    with (out / "compare.csv").open(encoding="utf-8") as stream:
        rows = {(row["quantity"], row["sigma_kPa"], row["ensemble"]): row for row in csv.DictReader(stream)}
    peaks = [rows["ratio_at_peak", "100.0", name] for name in "AB"]
    assert float(peaks[1]["mean"]) == pytest.approx(1.5 * float(peaks[0]["mean"]), rel=1e-3)
    assert float(peaks[1]["difference"]) == pytest.approx(0.5 * float(peaks[0]["mean"]), rel=1e-3)
    assert peaks[1]["method"] == PAIRED and not peaks[0]["difference"]
    page = (out / "compare.html").read_text(encoding="utf-8")
    assert "Paired by packing" in page and "Welch" not in page and 'src="http' not in page
    assert not list(folder.glob("**/report.html")), "the runs are only read"


def test_what_reports_say_with_care_is_said_here(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two notes of either, that there are no pictures; of many, how many they are, and where if there is a report."""
    for run in ("A/seed_1", "A/seed_2"):
        shutil.copytree(folder / run, tmp_path / run)
    for seed in (1, 2, 3):
        write_run(tmp_path / "B" / f"seed_{seed}", replace(REQUEST, seed=seed, speed=10.0), factor=0.0)
    words = ["compare", str(tmp_path / "A"), str(tmp_path / "B"), "--out", str(tmp_path / "out dir")]
    assert main(words) == 0
    few, many = json.loads((tmp_path / "out dir" / "compare.json").read_text(encoding="utf-8"))["ensembles"]
    for ensemble, name in ((few, "A"), (many, "B")):
        assert main(["report", str(tmp_path / name)]) == 0
        (own,) = json.loads((tmp_path / name / "summary.json").read_text(encoding="utf-8"))["ensembles"]
        assert ensemble["notes"] == own["notes"] and ensemble["report"] is None
    page = (tmp_path / "out dir" / "compare.html").read_text(encoding="utf-8")
    assert few["notes"][0].startswith("seed_1: 100 kPa: no grains.dump") and few["notes"][0] in html.unescape(page)
    count = len(many["notes"])
    assert count > 4 and f"{count} notes, which <code>shearbox report</code> tells" in page
    assert main(words) == 0
    page = (tmp_path / "out dir" / "compare.html").read_text(encoding="utf-8")
    assert f'<a href="../B/report.html">{count} notes in the report</a>' in page


def test_single_runs_of_one_stress_say_why_they_have_no_line(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of several they have one, without an interval."""
    runs = [str(folder / name / "seed_1") for name in "AB"]
    assert main(["compare", *runs, "--out", str(tmp_path)]) == 0
    told = "stresses that all specimens have: 1; at least 2 are needed"
    assert capsys.readouterr().out.count(told) == 2
    page = (tmp_path / "compare.html").read_text(encoding="utf-8")
    assert all(f"<li>φ and c of {name}: {told}</li>" in page for name in "AB")
    for name, speed in (("A", 2.0), ("B", 10.0)):
        write_run(tmp_path / name, replace(REQUEST, speed=speed))
    assert main(["compare", str(tmp_path / "A"), str(tmp_path / "B"), "--out", str(tmp_path)]) == 0
    assert "no φ and c" not in capsys.readouterr().out
    quantity = json.loads((tmp_path / "compare.json").read_text(encoding="utf-8"))["quantities"][0]
    assert quantity["quantity"] == "phi_deg" and [mean["low"] for mean in quantity["means"]] == [None, None]


def test_what_cannot_be_compared(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def refused(code: int, *names: str) -> str:
        assert main(["compare", *(str(folder / name) for name in names), "--out", str(tmp_path / "out")]) == code
        assert not (tmp_path / "out").exists()
        return capsys.readouterr().err

    said = refused(1, "A/seed_1", "stopped")
    assert "2 to 10 ensembles are compared, there are 1" in said and "stopped: 100 kPa: sheared to" in said
    assert "is named twice" in refused(2, "A", "A")
    (tmp_path / "link").symlink_to(folder / "A")
    for same in (tmp_path / "link", "A/seed_1"):
        assert f"{folder / 'A' / 'seed_1'} is in more than one of the folders" in refused(2, "A", str(same))
    assert "holds no run" in refused(1, "none", "A")
