# SPDX-License-Identifier: GPL-2.0-or-later
"""What work_precision measures with: closed forms of impacts, reading and comparing of runs, statistics. No speed is asserted."""

import math
import subprocess
import sys
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

BENCHMARKS = Path(__file__).resolve().parents[1] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))

import engines  # noqa: E402
import impacts  # noqa: E402
import precision_report  # noqa: E402
import settling  # noqa: E402
import whole_tests  # noqa: E402
from precision_report import Curve, Trial  # noqa: E402
from records import Records  # noqa: E402


def test_normal_impacts_rebound_by_the_closed_form() -> None:
    restitution = math.exp(-math.pi * 0.215 / math.sqrt(1 - 0.215**2))
    wall, discs = (impacts.exact(impacts.IMPACTS[f"normal, {name}"], 10)[0] for name in ("disc and wall", "two discs"))
    assert wall == pytest.approx([-restitution, 0, 0], abs=1e-12)
    assert discs == pytest.approx([-restitution / 2, 0, 0], abs=1e-12), "the pair's centre of mass is at rest"


def test_an_impact_that_slides_all_the_time_takes_the_friction_of_its_pressure() -> None:
    """The impulse along the contact is mu (1 + e) m v_n, e = 1 without damping, while the contact point never stops."""
    impact = impacts.IMPACTS["oblique, friction, disc and wall"]
    angle = np.radians(80)
    impulse = math.tan(math.radians(27)) * 2 * math.cos(angle)  # over m v
    found = impacts.exact(replace(impact, angles=(80,)), 1000)[0]
    assert found == pytest.approx([-math.cos(angle), math.sin(angle) - impulse, -2 * impulse], rel=1e-4)


def test_an_impact_never_gains_energy() -> None:
    for impact in impacts.IMPACTS.values():
        after = impacts.exact(impact, 500) / impact.reduced  # of the second disc as of the first
        energy = (after[:, 0] ** 2 + after[:, 1] ** 2 + impact.reduced * after[:, 2] ** 2 / 2).max()
        assert energy <= 1 + 1e-9


@pytest.mark.parametrize("engine", engines.PROGRAMS)
def test_engines_have_the_closed_form_as_their_limit(engine: str, tmp_path: Path) -> None:
    if not engines.installed(engine):
        pytest.skip(engines.PACKAGES[engine])
    impact = impacts.IMPACTS["oblique, friction, two discs"]

    def error(level: int) -> float:
        engines.execute(impact.job(engine, level, tmp_path / "pairs.data"), tmp_path / "run")
        return impacts.error(impacts.rebounds(tmp_path / "run"), impacts.exact(impact, 2000))

    # first order at least: ten times the steps, a fifth of the error; with 26 instead of 27 degrees it would be 5e-3
    assert error(200) < min(error(20) / 5, 1e-3)


def test_time_for_an_error_is_read_off_the_line() -> None:
    curve = Curve("cdem", [1, 2, 4], [1, 2, 4], [0.1, 0.01, 0.001])
    assert curve.time_for(0.01) == pytest.approx(2)
    assert curve.time_for(math.sqrt(0.1 * 0.01)) == pytest.approx(math.sqrt(2))
    assert curve.time_for(0.5) == 1, "the coarsest run is good enough"
    assert curve.time_for(0.0005) is None
    bumpy = replace(curve, errors=[0.005, 0.1, 0.001])
    assert bumpy.time_for(0.01) == pytest.approx(2 * math.sqrt(2)), "not the lucky first"


def test_motion_is_read_from_the_last_rows(tmp_path: Path) -> None:
    rows = [f"{i} {math.sin(i) ** 2:.15g} {1 - 1e-4 * i:.15g}" for i in range(settling.ROWS + 1)]
    motion = settling.read_motion("Setting up\n   Step KinEng Height\n" + "\n".join(rows) + "\nLoop time of 1\n")
    assert len(motion.kinetic) == settling.ROWS
    assert motion.height[0] == pytest.approx(1 - 1e-4)


def test_beds_are_compared_until_the_references_part() -> None:
    base = settling.Motion(np.linspace(0, 2, settling.ROWS), np.linspace(1, 0, settling.ROWS))
    drift = np.where(np.arange(settling.ROWS) < 50, 1e-5, 1e-2)
    other = settling.Motion(base.kinetic + drift, base.height - 2 * drift)
    rows = settling.rows_that_agree(other, base)
    assert rows == 50
    assert settling.errors(other, base, rows) == pytest.approx((5e-6, 2e-5)), "over the greatest energy, the whole way"


def test_a_difference_has_the_errors_of_both_means() -> None:
    found = precision_report.difference([11.0, 13.0], [9.0, 10.0, 11.0])
    assert found.percent == pytest.approx(20)
    assert found.error_percent == pytest.approx(10 * math.sqrt(2 / 2 + 1 / 3))
    assert not found.resolved
    assert precision_report.difference([12.0, 12.2], [9.9, 10.0, 10.1]).resolved


def test_half_a_line_does_not_count(tmp_path: Path) -> None:
    records = Records(tmp_path / "trials", Trial)
    trial = Trial("impacts", "normal", "cdem", 6, 12, 2000, 0.5, {"velocity": 0.01})
    records.add(trial)
    with records.file.open("a") as stream:
        stream.write('{"part": "imp')
    again = Records(records.file, Trial)
    assert again.found == [trial]
    again.add(trial)
    assert Records(records.file, Trial).found == [trial, trial]


def test_report_of_whole_tests(tmp_path: Path) -> None:
    random = np.random.default_rng(1)
    outcomes = Records(tmp_path / "tests.jsonl", whole_tests.Outcome)
    for setting in (whole_tests.REFERENCE, whole_tests.Setting(50, 0.1)):
        for seed in range(1, 6):
            tau = [0.7 * sigma * (1 + 0.01 * random.normal()) for sigma in whole_tests.STRESSES]
            if setting.speed == 50:
                tau = [1.2 * value for value in tau]
            phi = math.degrees(math.atan(tau[-1] / 400))
            outcomes.add(
                whole_tests.Outcome(setting.name, seed, phi, 0.0, tau, tau, [0.3] * 4, [1.0] * 4, [0.7] * 4, 10, 4.0, 1.0)
            )
    (tmp_path / "machine.json").write_text('{"processor": "any"}\n')
    precision_report.publish(tmp_path)
    rows = [line for line in (tmp_path / "tables.md").read_text().splitlines() if line.startswith("| 50 mm/s")]
    assert len(rows) == 1 and "| 5 | 1.0 |" in rows[0]
    ratio = rows[0].split("|")[6]
    assert float(ratio.split(",")[1].split("±")[0]) == pytest.approx(20, abs=2)
    assert ratio.endswith("** "), "20 % are more than chance"
    assert (tmp_path / "tests.svg").exists() and not (tmp_path / "impacts.svg").exists()
    assert asdict(outcomes.found[0])["tau_peak_kPa"] == Records(outcomes.file, whole_tests.Outcome).found[0].tau_peak_kPa


def test_refuses_what_it_does_not_know() -> None:
    done = subprocess.run([BENCHMARKS / "work_precision", "everything"], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "unknown part 'everything'; there are: impacts; settling; presets; tests" in done.stderr
