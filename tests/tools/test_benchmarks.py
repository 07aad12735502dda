# SPDX-License-Identifier: GPL-2.0-or-later
"""The benchmarks' small form: engines agree in physics; the program measures and reports. No speed is asserted."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).resolve().parents[1] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))

import check  # noqa: E402
import engines  # noqa: E402
import report  # noqa: E402

missing = [engine for engine in engines.PROGRAMS if not engines.installed(engine)]


@pytest.fixture(scope="module")
def beds(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("beds")


@pytest.mark.parametrize("scene", check.CHECKS)
def test_engines_agree_in_physics(scene: str, beds: Path, tmp_path: Path) -> None:
    if engines.STOCK in missing:
        pytest.skip(f"no peer to compare with: {engines.PACKAGES[engines.STOCK]}")
    found = check.compare(scene, beds, tmp_path)
    assert found
    assert [c for c in found if not c.agrees] == []
    if engines.LIGGGHTS in missing and not scene.startswith("clumps"):
        pytest.skip(f"LAMMPS agrees; LIGGGHTS is not there: {engines.PACKAGES[engines.LIGGGHTS]}")


def test_measures_and_goes_on(tmp_path: Path) -> None:
    def rounds(repeats: int) -> dict[str, int]:
        program: list[str | Path] = [
            sys.executable,
            BENCHMARKS / "run",
            "shear test",
            "--share",
            "0.002",
            "--out",
            tmp_path,
        ]
        done = subprocess.run([*program, "--repeats", str(repeats)], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        assert "| shear test |" in done.stdout
        scene = json.loads((tmp_path / "samples.json").read_text())["scenes"]["shear test"]
        return {engine: len(samples) for engine, samples in scene.items()}

    there = [engine for engine in engines.PROGRAMS if engine not in missing]
    assert rounds(1) == dict.fromkeys(there, 1)
    assert rounds(2) == dict.fromkeys(there, 2)
    assert (tmp_path / "tables.md").exists()
    assert (tmp_path / "ratios.svg").exists()
    other = subprocess.run(
        [sys.executable, BENCHMARKS / "run", "shear test", "--share", "0.003", "--out", tmp_path],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert other.returncode != 0
    assert "share of the steps" in other.stderr, "results of another request are not mixed in"


LAMMPS_OUTPUT = """
Loop time of 2 on 1 procs for 1000 steps with 350 atoms
Section |  min time  |  avg time  |  max time  |%varavg| %total
Pair    | 1.2        | 1.25       | 1.3        |   0.0 | 62.50
Neigh   | 0.25       | 0.25       | 0.25       |   0.0 | 12.50
Other   |            | 0.5        |            |       | 25.00
Neighbor list builds = 7
Dangerous builds = 1
"""
LIGGGHTS_OUTPUT = """
Loop time of 2 on 1 procs for 1000 steps with 350 atoms, finish time Mon Jan 1 00:00:00 2024
Pair  time (%) = 1.25 (62.5)
Neigh time (%) = 0.25 (12.5)
Outpt time (%) = 0 (0)
Other time (%) = 0.5 (25)
Neighbor list builds = 7
Dangerous builds = 1
"""


@pytest.mark.parametrize("text", [LAMMPS_OUTPUT, LIGGGHTS_OUTPUT], ids=["LAMMPS", "LIGGGHTS"])
def test_reads_what_engines_print(text: str) -> None:
    sample = engines.read("Loop time of 9 on 1 procs for 0 steps with 1 atoms\n" + text, job(), engines.Usage(1, 1))
    assert (sample.seconds, sample.steps, sample.builds, sample.dangerous) == (2, 1000, 7, 1)
    assert sample.phases == {"pair": 1.25, "neigh": 0.25, "comm": 0, "output": 0, "modify": 0, "other": 0.5}
    assert sample.ns == pytest.approx(2e9 / 1000 / 100)


def test_ratio_is_taken_round_by_round() -> None:
    def sample(seconds: float) -> engines.Sample:
        return engines.Sample(seconds, 1, 1, 0, 0, 0)

    scene = {engines.CDEM: [sample(1), sample(2)], engines.STOCK: [sample(8), sample(10)]}
    assert report.ratios(scene, engines.STOCK) == [8, 5]
    assert report.ratio_text([8, 5, 6]) == "6.00 (5.00–8.00)"


def test_says_what_an_engine_complained_about(tmp_path: Path) -> None:
    deck = tmp_path / "wrong.in"
    deck.write_text("no_such_command\n")
    with pytest.raises(engines.EngineError, match="Unknown command: no_such_command"):
        engines.start(engines.Job(engines.CDEM, deck, {}), tmp_path / "work")


def job() -> engines.Job:
    return engines.Job(engines.CDEM, Path("deck.in"), {}, discs=100)


def test_help_names_all_scenes() -> None:
    done = subprocess.run([sys.executable, BENCHMARKS / "run", "--help"], capture_output=True, text=True, check=True)
    assert "shear test" in done.stdout and "--check" in done.stdout
    assert shutil.which(str(BENCHMARKS / "run"))
