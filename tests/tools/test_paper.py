# SPDX-License-Identifier: GPL-2.0-or-later
"""The study of the paper: findings on specimens with known numbers, and the page of tests that an engine only pretends."""

import csv
import json
import runpy
import subprocess
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic
from matplotlib.figure import Figure
from command import TESTS

from paper_tools import findings
from paper_tools.effects import CONFIRMED, CONTRADICTED, OPEN
from paper_tools.findings import Finding, halves_agree, of_the_laws
from paper_tools.outlook import SWEEPS, Study, study
from paper_tools.record import read_record, write_record
from paper_tools.specimens import CURVES, JUDGED, NUMBERS, PLACES, STRENGTHS, Group, Specimen
from paper_tools.specimens import specimen as measured
from paper_tools.study import CAMPAIGNS, Part, campaign_file, parts_left, report, runs_of
from shearbox_tools.analysis.results import read_results
from shearbox_tools.asking.grains import area_over_largest
from shearbox_tools.asking.models import find_model
from shearbox_tools.asking.request import Request
from shearbox_tools.base.errors import ShearboxError
from shearbox_tools.commands.cli import main
from shearbox_tools.running.phases import shearing

PAPER = TESTS.parents[1] / "tools" / "paper"
PER_BOX = 5  # specimens

# phi of the box, and what sizes and shapes add to it; the paper's claims hold: finer, larger, rounder is weaker, and finer rolls more
PHI = {"A": 34.0, "B": 33.0, "C": 32.0, "D": 31.0}
ADDED = {"4-8": 0.0, "2-4": -2.0, "T-2": -4.0, "2-4_triple": 12.0}
TRM = {"4-8": 0.6, "2-4": 0.65, "T-2": 0.7, "2-4_triple": 0.2}
LATE = {"4-8": -0.05, "2-4": -0.10, "T-2": -0.15, "2-4_triple": 0.2}


def group(name: str, rng: np.random.Generator, **numbers: float) -> Group:
    """Specimens around the numbers, which scatter by a hundredth of a degree or of themselves."""
    specimens = []
    for seed in range(1, PER_BOX + 1):
        near = {key: value * (1 + 0.01 * rng.normal()) for key, value in numbers.items()}
        test = dict.fromkeys(NUMBERS, 1.0) | {key: value for key, value in near.items() if key in NUMBERS}
        phi = numbers["phi"] + 0.1 * rng.normal()
        specimens.append(specimen(seed, {100.0: test, 200.0: test}, phi))
    return Group(name, "", 20, specimens)


def specimen(seed: int, tests: dict[float, dict[str, float]], phi: float = 30.0, **more: Any) -> Specimen:
    """All three features hold in it, and its curves are not known."""
    holds: dict[str, bool | None] = dict.fromkeys(JUDGED, True)
    return replace(Specimen(seed, tests, phi, 0.0, phi - 1, 0.0, {}, holds, 0.5), **more)


def models(change: dict[str, dict[str, float]] | None = None) -> dict[str, Group]:
    rng, made = np.random.default_rng(2), {}
    for kind, added in ADDED.items():
        for box, phi in PHI.items():
            if kind != "T-2" or box in "AB":
                dilation = 30.0 if kind == "2-4_triple" else 20.0
                numbers = {"phi": phi + added, "late_rate": LATE[kind], "trm": TRM[kind], "dilation_deg": dilation,
                           "sharpness": 1.1} | (change or {}).get(kind, {})  # fmt: skip
                strength = np.tan(np.radians(numbers["phi"]))
                ratios = {"peak": strength, "peak_smoothed": strength, "mean": 0.9 * strength, "end": 0.8 * strength}
                made[f"{box}_{kind}"] = group(f"{box}_{kind}", rng, **(ratios | numbers))
    return made


def verdicts(found: list[Finding]) -> dict[str, str]:
    return {one.claim: one.verdict for one in found}


def test_a_world_as_the_paper_describes_it() -> None:
    assert set(verdicts(findings.findings(models())).values()) == {CONFIRMED}


@pytest.mark.parametrize(
    "kind, change, claims",
    [
        ("2-4_triple", {"trm": 0.9}, ["They roll less: TRM at the end"]),
        ("T-2", {"phi": 40.0}, [f"The finer the single discs, the lower {what}" for _, what in findings.STRENGTH]),
        ("4-8", {"peak_smoothed": 0.78}, ["Polynomials find the peak"]),
        ("4-8", {"sharpness": 3.0}, ["Dense specimens have no sharp peak: single discs"]),
    ],
)  # fmt: skip
def test_a_world_in_which_one_thing_is_otherwise(kind: str, change: dict[str, float], claims: list[str]) -> None:
    found = verdicts(findings.findings(models({kind: change})))
    assert [claim for claim, verdict in found.items() if verdict != CONFIRMED] == claims
    assert all(found[claim] in (CONTRADICTED, OPEN) for claim in claims)


def test_a_difference_is_found_in_its_size() -> None:
    (one,) = [one for one in findings.findings(models()) if one.claim == "Grains of three discs raise φ (lid)"]
    assert one.effects[0].value == pytest.approx(ADDED["2-4_triple"], abs=0.2)
    assert [effect.label[-5:] for effect in one.effects[2:6]] == ["box A", "box B", "box C", "box D"]


def without(some: Group, seeds: Iterable[int], **unknown: float) -> Group:
    """The same with numbers of some specimens unknown; without these specimens, if none are named."""
    kept = [one for one in some.specimens if one.seed not in seeds or unknown]
    return replace(some, specimens=[replace(one, **unknown) if one.seed in seeds else one for one in kept])


@pytest.mark.filterwarnings("error")
def test_what_cannot_be_judged_does_not_count() -> None:
    """Findings on a strength are those of the specimens that have one; of the others the rest counts."""
    every = models()
    left_out = {name: range(2, 6) if name == "A_4-8" else range(1, 6) if name[0] in "BC" else [3] for name in every}
    nowhere = {"phi_plane": np.nan, "c_plane": np.nan}
    unknown = {name: without(some, left_out[name], **nowhere) for name, some in every.items()}
    fewer = {name: without(some, left_out[name]) for name, some in every.items()}
    fewer = {name: some for name, some in fewer.items() if some.specimens}
    for whole, found, expected in zip(*map(findings.findings, (every, unknown, fewer))):
        if "plane" not in found.claim:
            assert found == whole
            continue
        effects = {effect.label: effect for effect in found.effects}
        for effect in expected.effects:
            assert vars(effects[effect.label]) == pytest.approx(vars(effect), nan_ok=True)
    nothing = {name: without(some, range(9), **nowhere) for name, some in every.items()}
    by_plane = [one for one in findings.findings(nothing) if "plane" in one.claim]
    assert len(by_plane) == 3 and {one.verdict for one in by_plane} == {OPEN}
    assert all(effect.count == 0 for one in by_plane for effect in one.effects)


def sweep_of(tmp_path: Path, apart: float, alike: int = 0, **more: float) -> Study:
    """Friction angles of 0, 27 and 35 degrees, whose packings have the same seeds and solid fractions that differ by `apart`: phi is that
    of the packing and 0.1 for each degree."""

    def some(value: float, seeds: Iterable[int]) -> Group:
        tests = [
            (k, dict.fromkeys(NUMBERS, 1.0) | {"solid": 0.8 + 0.01 * k + apart * value * (k != alike)}) for k in seeds
        ]
        of_packing = {k: 20 + 3 * k + 0.1 * value for k, _ in tests}
        return Group("", "", 20, [specimen(k, {100.0: t, 200.0: t}, of_packing[k], **more) for k, t in tests])

    (sweep,) = [one for one in SWEEPS if one.name == "friction"]
    groups = {f"single_{value}": some(value, range(1, 5)) for value in (0, 35)}
    found = study(sweep, groups, {"A_4-8": some(27, range(1, 9))}, tmp_path)
    assert found is not None
    return found


@pytest.mark.parametrize("apart", [0, 1e-3])
def test_the_same_packings_are_compared_packing_by_packing(tmp_path: Path, apart: float) -> None:
    """However much they differ from each other. Others are samples of their own."""
    found = sweep_of(tmp_path, apart)
    (trend,) = [effect for name, effect in found.trends if name == "phi"]
    with (tmp_path / "friction.csv").open(encoding="utf-8") as stream:
        rows = {
            row["value"]: {k: float(v) for k, v in row.items() if k.startswith("phi")} for row in csv.DictReader(stream)
        }
    change = rows["35"]
    if apart:
        assert trend.high - trend.low > 0.2 and change["phi_change_specimens"] == 12
        assert change["phi_change_high"] - change["phi_change_low"] > 5
        return
    assert (trend.value, trend.low, trend.high, trend.count) == pytest.approx((0.1, 0.1, 0.1, 4))
    ends = ("", "_low", "_high", "_specimens")
    assert [change[f"phi_change{end}"] for end in ends] == pytest.approx([0.8, 0.8, 0.8, 4])
    assert np.isnan(rows["27"]["phi_change"])


def test_one_packing_that_is_alike_is_chance(tmp_path: Path) -> None:
    """Seed 2 has the same solid fraction at all friction angles, others have not: they are independent."""
    found = sweep_of(tmp_path, 1e-3, alike=2)
    (trend,) = [effect for name, effect in found.trends if name == "phi"]
    assert trend.count > 4


def test_what_is_read_at_peaks_that_polynomials_miss_is_not_known() -> None:
    test = dict.fromkeys(NUMBERS, 1.0)
    every = [specimen(k, {100.0: test, 200.0: test | {"peak_smoothed": missed}}) for k, missed in ((1, 1.0), (2, 1.4))]
    some = Group("", "", 20, every)
    assert [len(some.values(name)) for name in ("phi", "peak", "sharpness", "mean", "trm")] == [1, 1, 1, 2, 2]
    assert (len(some.at(100.0, "peak")), len(some.at(200.0, "peak"))) == (2, 1)


def test_the_findings_kept_are_those_of_the_tables_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What examples/paper says can be made again from its tables, which have five digits."""
    measured_there = PAPER.parents[1] / "examples" / "paper" / "measured"
    monkeypatch.setattr("paper_tools.study.print_page", lambda page: None)
    report(tmp_path, read_record(measured_there))
    made, kept = (json.loads((of / "findings.json").read_text(encoding="utf-8")) for of in (tmp_path, measured_there))
    for walls, found in kept.items():
        for one, other in zip(found, made[walls], strict=True):
            assert (one["claim"], one["verdict"]) == (other["claim"], other["verdict"])
            for effect, again in zip(one["effects"], other["effects"], strict=True):
                assert effect["label"] == again["label"]
                values = [
                    [-1 if e[k] is None else e[k] for k in ("count", "value", "low", "high")] for e in (effect, again)
                ]
                assert values[0] == pytest.approx(values[1], rel=2e-3, abs=2e-3)


def test_a_diagram_with_one_value_is_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[Figure] = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, *_, **__: drawn.append(figure))
    sweep_of(tmp_path, 0, phi_plane=np.nan)
    labels = [axes.get_ylabel() for axes in drawn[0].axes]
    assert labels == ["φ by the lid (°)", "ψ at the peak (°)", "TRM (–)"]


def test_without_specimens_all_is_open() -> None:
    assert set(verdicts(findings.findings({})).values()) == {OPEN}


def test_laws_are_compared_seed_by_seed() -> None:
    """However much packings scatter: seed by seed incremental is rougher by 0.01. All models decide, not the first of them."""
    direct = models()["A_4-8"]
    rough, even = (
        [
            specimen(s.seed, {k: t | {"roughness": t["roughness"] * s.seed + more} for k, t in s.tests.items()})
            for s in direct.specimens
        ]
        for more in (0.01, 0.0)
    )
    groups = [{"A_4-8": Group("A_4-8", "", 20, some)} for some in (even, rough[1:])]
    (found,) = of_the_laws(*groups)
    assert (found.verdict, found.effects[0].count) == (CONFIRMED, PER_BOX - 1)
    assert found.effects[0].value == pytest.approx(0.01)
    first = Group("A_2-4", "", 20, even[:2])
    (found,) = of_the_laws(*({"A_2-4": first} | group for group in groups))
    values = [effect.value for effect in found.effects]
    assert values == pytest.approx([0.01 * (PER_BOX - 1) / (PER_BOX + 1), 0, 0.01])
    assert found.verdict == CONFIRMED


def test_laws_without_a_seed_in_common_are_not_compared() -> None:
    direct, other = models()["A_4-8"], models()["A_4-8"]
    assert of_the_laws({"A_4-8": without(direct, [1, 2, 3])}, {"A_4-8": without(other, [4, 5])}) == []


def test_halves_of_the_same_agree() -> None:
    agree, tried = halves_agree(models(), ["phi", "trm"])
    assert tried == 2 * 14 and agree >= 0.8 * tried


@pytest.mark.parametrize("name", CAMPAIGNS)
def test_a_campaign_can_be_read(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As it is, by the program that will run it; nothing is started."""
    words = ["run", campaign_file(name), "--out", tmp_path, "--dry-run", "--engine", TESTS / "fake_engine.py"]
    assert main([str(word) for word in words]) == 0
    assert "in all about" in capsys.readouterr().out


def test_grains_of_several_discs_are_as_large_as_single_ones() -> None:
    """Of the campaign of shapes: shape alone is varied, not the size of grains against the box."""
    single = find_model("TypeA_10x5_4-8_1-circle_350")
    for run, options in runs_of("shape").items():
        model = find_model(options["model"], {name: str(value) for name, value in options["set"].items()})
        assert (model.discs, model.ngrains) == (int(run[-1]), single.ngrains)
        for size in ("dmin", "dmax"):
            area = area_over_largest(model.shape) * getattr(model, size) ** 2
            assert area == pytest.approx(np.pi / 4 * getattr(single, size) ** 2, rel=1e-3), run


def write_specimen(folder: Path, model: str, seed: int) -> None:
    """A run at two stresses, complete."""
    request = Request(find_model(model), (100.0, 200.0), seed=seed)
    synthetic.write_record(folder, request)
    for sigma in request.stresses:
        for phase in shearing(folder, request, sigma):
            phase.folder.mkdir(parents=True, exist_ok=True)
        synthetic.write_row(phase.folder / "consolidated.csv", **synthetic.bed())
        curves = synthetic.curves(sigma, 8, seed=seed)
        synthetic.write_shear(phase.folder / phase.product, curves | synthetic.inside(curves, sigma))


def test_the_page_of_what_there_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two models, two specimens of one of them; the rest is said to be missing. Printing it takes longer than all else."""
    for seed in (1, 2):
        write_specimen(tmp_path / "smooth" / "A_4-8" / f"seed_{seed}", "TypeA_10x5_4-8_1-circle_350", seed)
    write_specimen(tmp_path / "smooth" / "A_2-4" / "seed_1", "TypeA_10x5_2-4_1-circle_1500", 1)
    monkeypatch.setattr("paper_tools.study.print_page", lambda page: None)
    report(tmp_path, {})
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    for text in (
        "smooth: 3 of 82 specimens",
        "discs: 0 of 50 specimens",
        "Fig. 3 a)",
        "Fig. 7 b)",
        "Fig. 17",
        "Fig. 20",
    ):
        assert text in page
    assert "Fig. 4 a)" not in page and "nan" not in page
    with (tmp_path / "specimens.csv").open(encoding="utf-8") as stream:
        rows: list[dict[str, Any]] = list(csv.DictReader(stream))
    assert sorted((row["entry"], row["seed"], row["sigma_kPa"]) for row in rows) == sorted(
        (entry, seed, sigma)
        for entry, seed in (("A_4-8", "1"), ("A_4-8", "2"), ("A_2-4", "1"))
        for sigma in ("100", "200")
    )
    assert all(float(row["peak"]) == pytest.approx(0.5 + 5 / float(row["sigma_kPa"]), rel=0.05) for row in rows)
    for (
        row
    ) in rows:  # a third of tau inside; where the normal stresses are alike, the sine of the angle is xy over them
        assert float(row["mean_inside"]) == pytest.approx(float(row["mean"]) / 3, rel=0.01)
        assert np.sin(np.radians(float(row["tensor_deg"]))) == pytest.approx(float(row["peak"]) / 3, rel=0.05)
    found = json.loads((tmp_path / "findings.json").read_text(encoding="utf-8"))["smooth"]
    assert {one["verdict"] for one in found if one["claim"].startswith("Grains of three")} == {OPEN}
    lines = (tmp_path / "figures" / "fig03.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("sigma_kPa,specimens,displacement_mm,tau_mean_kPa") and len(lines) == 1 + 2 * len(PLACES)


def test_the_strength_of_peaks_that_cannot_be_judged_is_not_known(tmp_path: Path) -> None:
    """Of a box so wide that 8 mm are less than a hundredth of it; or on the plane alone, where its stress is noise."""
    write_specimen(tmp_path, "TypeA_10x5_4-8_1-circle_350", 1)
    results = read_results(tmp_path)
    judged = measured(results)
    assert np.isfinite([judged.phi, judged.c, judged.phi_plane, judged.c_plane]).all()
    short = measured(replace(results, shears=[replace(shear, width=1000.0) for shear in results.shears]))
    assert np.isnan([short.phi, short.c, short.phi_plane, short.c_plane]).all()
    first, *others = results.shears
    noise = synthetic.correlated_noise(np.random.default_rng(1), len(first.data["step"]), 40, 8)
    uncertain = replace(first, data=first.data | {"plane_tau_kPa": first.data["plane_tau_kPa"] / 10 + noise})
    assert uncertain.plane_doubt and not uncertain.doubt
    by_lid = measured(replace(results, shears=[uncertain, *others]))
    assert (by_lid.phi, by_lid.c) == (judged.phi, judged.c)
    assert np.isnan([by_lid.phi_plane, by_lid.c_plane]).all()


def known(campaign: str, entry: str, seeds: Iterable[int], value: float = 1.0) -> dict[str, dict[str, list[Specimen]]]:
    """Specimens with curves, in which every number is `value`."""
    test, curves = dict.fromkeys(NUMBERS, value), {100.0: np.full((len(CURVES), len(PLACES)), value)}
    every = [specimen(seed, {100.0: test, 200.0: test}, curves=curves | {200.0: curves[100.0]}) for seed in seeds]
    return {campaign: {entry: every}}


def test_a_record_is_read_as_it_was_written(tmp_path: Path) -> None:
    judged: dict[str, bool | None] = dict(zip(JUDGED, (True, False, None)))
    written = known("smooth", "A_4-8", [1, 7], np.pi) | known("friction", "single_0", [2])
    written["smooth"]["A_4-8"][1] = replace(written["smooth"]["A_4-8"][1], holds=judged, hours=np.nan)
    write_record(written, tmp_path)
    read = read_record(tmp_path)
    assert {name: list(entries) for name, entries in read.items()} == {"smooth": ["A_4-8"], "friction": ["single_0"]}
    first, other = read["smooth"]["A_4-8"]
    assert (first.seed, other.seed, first.phi, first.phi_plane) == (1, 7, 30, 29)
    assert list(first.tests) == [100, 200]
    for test in first.tests.values():
        assert test == pytest.approx(dict.fromkeys(NUMBERS, np.pi), rel=1e-4)
    assert first.curves[200.0] == pytest.approx(np.full((3, 79), np.pi), rel=1e-3)
    assert other.holds == judged and np.isnan(other.hours) and first.hours == 0.5
    assert not read["friction"]["single_0"][0].curves, "those of sweeps are drawn nowhere"


def test_what_an_earlier_record_lacks_is_not_known(tmp_path: Path) -> None:
    write_record(known("smooth", "A_4-8", [1]), tmp_path)
    (tmp_path / "curves.csv").unlink()
    table = tmp_path / "specimens.csv"
    with table.open(encoding="utf-8", newline="") as stream:
        rows = [
            {k: v for k, v in row.items() if k not in ("plane_load", "hours", *JUDGED)}
            for row in csv.DictReader(stream)
        ]
    with table.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    (one,) = read_record(tmp_path)["smooth"]["A_4-8"]
    assert one.curves == {} and set(one.holds.values()) == {None}
    assert np.isnan(one.hours) and np.isnan(one.mean("plane_load")) and one.mean("peak") == 1


def test_new_specimens_join_those_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Seeds 1 and 2 are new, 2 and 3 kept: three specimens, of which the second is the new one."""
    for seed in (1, 2):
        write_specimen(tmp_path / "smooth" / "A_4-8" / f"seed_{seed}", "TypeA_10x5_4-8_1-circle_350", seed)
    monkeypatch.setattr("paper_tools.study.print_page", lambda page: None)
    report(tmp_path, known("smooth", "A_4-8", [2, 3], 9.0))
    every = read_record(tmp_path)["smooth"]["A_4-8"]
    assert [one.seed for one in every] == [1, 2, 3]
    assert [one.mean("peak") == 9 for one in every] == [False, False, True]
    with (tmp_path / "figures" / "fig03.csv").open(encoding="utf-8") as stream:
        row = [row for row in csv.DictReader(stream) if row["displacement_mm"] == "4"][0]
    tau = [one.curves[100.0][0, list(np.round(PLACES, 1)).index(4.0)] for one in every]
    assert float(row["tau_mean_kPa"]) == pytest.approx(np.mean(tau), rel=1e-3)
    assert float(row["tau_standard_error_kPa"]) == pytest.approx(np.std(tau, ddof=1) / 3**0.5, rel=1e-2)
    assert "smooth: 3 of 82 specimens" in (tmp_path / "page.html").read_text(encoding="utf-8")


@pytest.mark.filterwarnings("error")
def test_a_page_of_specimens_of_which_little_is_known(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No strength of a model and of a value of a sweep, of another that of one specimen alone; no peak; curves of one of two stresses;
    laws without a seed in common."""
    kept = known("smooth", "A_4-8", [1, 2]) | known("incremental", "A_4-8", [7]) | known("friction", "single_0", [1, 2])
    kept["smooth"] |= known("smooth", "A_2-4", [1, 2])["smooth"]
    for some in (kept["smooth"]["A_4-8"], kept["friction"]["single_0"]):
        some[:] = [replace(one, **dict.fromkeys(STRENGTHS, np.nan)) for one in some]
    first, other = kept["smooth"]["A_2-4"]
    nowhere = dict.fromkeys(("peak", "peak_mm", "peak_plane", "plane_load", "mean_plane"), np.nan)
    first = replace(first, phi=np.nan, tests=first.tests | {100.0: first.tests[100.0] | nowhere})
    other = replace(other, tests=other.tests | {100.0: other.tests[100.0] | nowhere})
    kept["smooth"]["A_2-4"] = [replace(one, curves={200.0: one.curves[200.0]}) for one in (first, other)]
    monkeypatch.setattr("paper_tools.study.print_page", lambda page: None)
    report(tmp_path, kept)
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "nan" not in page and "n = 1</span>" in page and "n = 0</span>" in page
    figures = tmp_path / "figures"
    assert {line.split(",")[0] for line in (figures / "fig07.csv").read_text().splitlines()[1:]} == {"200"}
    with (figures / "friction.csv").open(encoding="utf-8") as stream:
        (row,) = [row for row in csv.DictReader(stream) if row["value"] == "0"]
    assert (row["specimens"], row["phi_specimens"], row["trm_specimens"]) == ("2", "0", "2")


def test_what_is_damaged_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for seed in (1, 2, 3):
        write_specimen(tmp_path / "smooth" / "A_4-8" / f"seed_{seed}", "TypeA_10x5_4-8_1-circle_350", seed)
    table = tmp_path / "smooth" / "A_4-8" / "seed_2" / "100" / "shear.dat"
    table.write_text(table.read_text(encoding="utf-8").replace("0", "x", 1), encoding="utf-8")
    (tmp_path / "smooth" / "A_4-8" / "seed_3" / "run.json").write_text("{", encoding="utf-8")
    monkeypatch.setattr("paper_tools.study.print_page", lambda page: None)
    report(tmp_path, {})
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "smooth: 1 of 82 specimens" in page and "Left out" in page
    assert page.count(f"<li>{tmp_path}/smooth/A_4-8/seed_2") == 1
    assert page.count(f"<li>{tmp_path}/smooth/A_4-8/seed_3") == 1


def test_the_legend_of_one_box_is_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept: dict[str, dict[str, list[Specimen]]] = {"smooth": {}}
    for run in ("A_4-8", "A_2-4", "A_2-4_triple"):
        kept["smooth"] |= known("smooth", run, [1, 2])["smooth"]
    drawn: list[Figure] = []
    monkeypatch.setattr("paper_tools.study.print_page", lambda page: None)

    def keep(figure: Figure, file: Path, **_: Any) -> None:
        drawn.append(figure)
        file.write_text("<svg/>", encoding="utf-8")

    monkeypatch.setattr(Figure, "savefig", keep)
    report(tmp_path, kept)
    panels = [figure for figure in drawn if figure.legends]
    assert len(panels) == 4
    for figure in panels:
        figure.draw_without_rendering()
        box = figure.legends[0].get_window_extent()
        assert 0 <= box.x0 < box.x1 <= figure.bbox.x1


def test_what_is_kept_is_not_run_again() -> None:
    runs = ["A_4-8", "B_4-8", "C_4-8", "D_4-8", "A_2-4"]  # 8, 8, 4, 2, 8 specimens
    kept = {"A_4-8": range(1, 5), "B_4-8": range(1, 5), "D_4-8": range(1, 3), "A_2-4": [1, 3, 5, 7, 9]}
    specimens = {"smooth": {run: known("smooth", run, seeds)["smooth"][run] for run, seeds in kept.items()}}
    left = parts_left("smooth", runs, specimens)
    assert left == [Part(["C_4-8"]), Part(["A_2-4"], [2, 4, 6, 8]), Part(["A_4-8", "B_4-8"], [5, 6, 7, 8])]
    assert parts_left("smooth", ["D_4-8"], specimens) == []
    assert parts_left("smooth", runs, {}) == [Part(runs)]


def test_the_study_goes_on_from_what_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of four specimens one is left: it alone is asked for."""
    kept, out, asked = tmp_path / "kept", tmp_path / "out", list[list[str]]()
    kept.mkdir()
    write_record(known("smooth", "A_4-8", [1]) | known("friction", "single_0", [1, 2, 4]), kept)
    words = [str(PAPER), "--out", str(out), "--with", str(kept), "--campaign", "friction", "--only", "single_0"]
    monkeypatch.setattr("sys.argv", words)
    monkeypatch.setattr("shearbox_tools.commands.cli.main", asked.append)
    monkeypatch.setattr("paper_tools.study.print_page", lambda page: None)
    with pytest.raises(SystemExit) as end:
        runpy.run_path(str(PAPER), run_name="__main__")
    assert end.value.code == 0
    assert [words[1:] for words in asked] == [
        [
            str(campaign_file("friction")),
            "--out",
            str(out / "friction"),
            "--jobs",
            "2",
            "--only",
            "single_0",
            "--seeds",
            "3-3",
        ]
    ]
    assert [one.seed for one in read_record(out)["friction"]["single_0"]] == [1, 2, 4]


def test_a_campaign_that_was_stopped_or_failed_ends_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the exit status of `shearbox run`, which works in the same process: what ends the one ends the other."""
    asked = list[list[str]]()
    monkeypatch.setattr("sys.argv", [str(PAPER), "--out", str(tmp_path), "--campaign", "friction", "rolling"])

    def stopped(words: list[str]) -> int:
        asked.append(words)
        return 143

    monkeypatch.setattr("shearbox_tools.commands.cli.main", stopped)
    with pytest.raises(SystemExit) as end:
        runpy.run_path(str(PAPER), run_name="__main__")
    assert end.value.code == 143 and len(asked) == 1


def test_a_record_of_another_study_is_refused(tmp_path: Path) -> None:
    kept = known("smooth", "A_4-8", [1]) | known("rate", "single_3", [1])
    with pytest.raises(ShearboxError, match="rate/single_3: specimens of a run that .*rate.toml does not have"):
        report(tmp_path, kept)


def test_no_record_is_said_so(tmp_path: Path) -> None:
    words = [PAPER, "--out", tmp_path, "--with", tmp_path / "nothing", "--report"]
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and f"{tmp_path / 'nothing' / 'specimens.csv'}: No such file" in done.stderr


def test_nothing_to_tell(tmp_path: Path) -> None:
    done = subprocess.run([str(PAPER), "--out", str(tmp_path), "--report"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and "no specimen of the models is complete yet" in done.stderr
    assert "Traceback" not in done.stderr
