# SPDX-License-Identifier: GPL-2.0-or-later
"""The study of the paper: findings on specimens with known numbers, and the page of tests that an engine only pretends."""

import csv
import json
import subprocess
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import synthetic
from test_run import TESTS

from paper_tools import findings
from paper_tools.effects import CONFIRMED, CONTRADICTED, OPEN
from paper_tools.findings import Finding, halves_agree, of_the_laws
from paper_tools.specimens import NUMBERS, Group, Specimen
from paper_tools.study import CAMPAIGNS, campaign_file, report
from shearbox_tools.cli import main
from shearbox_tools.models import find_model
from shearbox_tools.phases import shearing
from shearbox_tools.request import Request

PAPER = TESTS.parents[1] / "tools" / "paper"
PER_BOX = 5  # specimens

# phi of the box, and what sizes and shapes add to it; the paper's claims hold: finer, larger, rounder is weaker
PHI = {"A": 34.0, "B": 33.0, "C": 32.0, "D": 31.0}
ADDED = {"4-8": 0.0, "2-4": -2.0, "T-2": -4.0, "2-4_triple": 12.0}
LATE = {"4-8": -0.05, "2-4": -0.10, "T-2": -0.15, "2-4_triple": 0.2}


def group(name: str, rng: np.random.Generator, **numbers: float) -> Group:
    """Specimens around the numbers, which scatter by a hundredth of a degree or of themselves."""
    specimens = []
    for seed in range(1, PER_BOX + 1):
        near = {key: value * (1 + 0.01 * rng.normal()) for key, value in numbers.items()}
        test = dict.fromkeys(NUMBERS, 1.0) | {key: value for key, value in near.items() if key in NUMBERS}
        phi = numbers["phi"] + 0.1 * rng.normal()
        specimens.append(Specimen(seed, {100.0: test, 200.0: test}, phi, 0.0, phi - 1, 0.0))
    return Group(name, SimpleNamespace(specimens=[None] * PER_BOX), specimens)  # type: ignore[arg-type]


def models(change: dict[str, dict[str, float]] | None = None) -> dict[str, Group]:
    rng, made = np.random.default_rng(2), {}
    for kind, added in ADDED.items():
        for box, phi in PHI.items():
            if kind != "T-2" or box in "AB":
                triple = kind == "2-4_triple"
                numbers = {"phi": phi + added, "late_rate": LATE[kind], "trm": 0.2 if triple else 0.6,
                           "dilation_deg": 30.0 if triple else 20.0, "sharpness": 1.1}  # fmt: skip
                made[f"{box}_{kind}"] = group(f"{box}_{kind}", rng, **(numbers | (change or {}).get(kind, {})))
    return made


@pytest.fixture(autouse=True)
def _features(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(findings, "holds_in", lambda run, name: True)


def verdicts(found: list[Finding]) -> dict[str, str]:
    return {one.claim: one.verdict for one in found}


def test_a_world_as_the_paper_describes_it() -> None:
    assert set(verdicts(findings.findings(models())).values()) == {CONFIRMED}


@pytest.mark.parametrize(
    "kind, change, claims",
    [
        ("2-4_triple", {"trm": 0.9}, ["They roll less: TRM at the end"]),
        ("T-2", {"phi": 40.0}, ["The finer the single discs, the lower φ (lid)", "The finer the single discs, the lower φ (shear plane)"]),
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


def test_without_specimens_all_is_open() -> None:
    assert set(verdicts(findings.findings({})).values()) == {OPEN}


def test_laws_are_compared_on_the_same_packings() -> None:
    """However much packings scatter: seed by seed incremental is rougher by 0.01."""
    direct = models()["A_4-8"]
    rough = [Specimen(s.seed, {k: t | {"roughness": t["roughness"] * s.seed + 0.01} for k, t in s.tests.items()}, 0, 0, 0, 0)
             for s in direct.specimens]  # fmt: skip
    even = [Specimen(s.seed, {k: t | {"roughness": t["roughness"] * s.seed} for k, t in s.tests.items()}, 0, 0, 0, 0)
            for s in direct.specimens]  # fmt: skip
    groups = [{"A_4-8": Group("A_4-8", direct.ensemble, some)} for some in (even, rough[1:])]
    (found,) = of_the_laws(*groups)
    assert (found.verdict, found.effects[0].count) == (CONFIRMED, PER_BOX - 1)
    assert found.effects[0].value == pytest.approx(0.01)


def test_halves_of_the_same_agree() -> None:
    agree, tried = halves_agree(models(), ["phi", "trm"])
    assert tried == 2 * 14 and agree >= 0.8 * tried


@pytest.mark.parametrize("name", CAMPAIGNS)
def test_a_campaign_can_be_read(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As it is, by the program that will run it; nothing is started."""
    words = ["run", campaign_file(name), "--out", tmp_path, "--dry-run", "--engine", TESTS / "fake_engine.py"]
    assert main([str(word) for word in words]) == 0
    assert "in all about" in capsys.readouterr().out


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
    report(tmp_path)
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
    found = json.loads((tmp_path / "findings.json").read_text(encoding="utf-8"))["smooth"]
    assert {one["verdict"] for one in found if one["claim"].startswith("Grains of three")} == {OPEN}
    lines = (tmp_path / "figures" / "fig03.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("sigma_kPa,specimens,displacement_mm,tau_mean_kPa") and len(lines) > 200


def test_nothing_to_tell(tmp_path: Path) -> None:
    done = subprocess.run([str(PAPER), "--out", str(tmp_path), "--report"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and "no specimen of the models is complete yet" in done.stderr
    assert "Traceback" not in done.stderr
