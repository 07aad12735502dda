# SPDX-License-Identifier: GPL-2.0-or-later
"""Campaign files: which options count, in which order runs are carried out, and what is refused."""

import json
import subprocess
from pathlib import Path

import pytest
from command import MODEL, events, finish, go_on, start, wait_for

TWO = f"""
[all]
stress = [100]
seeds = 2
set = {{ phi = 30, kn = 5e7 }}

[runs.coarse]
model = "{MODEL}"

[runs.rough]
model = "{MODEL}"
accuracy = "fast"
set = {{ phi = 35, sides = "discs" }}
"""


def campaign(folder: Path, text: str, *options: str, **environment: str) -> subprocess.Popen[str]:
    """shearbox run of a file of that text, into the folder `results` beside it."""
    file = folder / "study.toml"
    file.write_text(text, encoding="utf-8")
    return start(str(file), "--out", str(folder / "results"), *options, **environment)


def identity(folder: Path) -> dict:
    return json.loads((folder / "run.json").read_text(encoding="utf-8"))["identity"]


def test_what_is_asked_for_and_in_which_order(tmp_path: Path) -> None:
    """An option of a run before that of all; the first packings of all runs before the second of any."""
    diary = tmp_path / "diary"
    done = finish(campaign(tmp_path, TWO, "--jobs", "1", FAKE_DIARY=str(diary)))
    assert done.returncode == 0, done.stderr
    begun = [line.split()[0] for line in done.stdout.splitlines() if line.endswith("pack: started")]
    assert begun == ["coarse/seed_1", "rough/seed_1", "coarse/seed_2", "rough/seed_2"]
    coarse, rough = (identity(tmp_path / "results" / name / "seed_2") for name in ("coarse", "rough"))
    assert [coarse["parameters"][name] for name in ("phi", "kn", "sides")] == ["30", "50000000", "smooth"]
    assert [rough["parameters"][name] for name in ("phi", "kn", "sides")] == ["35", "50000000", "discs"]
    assert (coarse["speed_mm_s"], rough["speed_mm_s"]) == (2.0, 200.0)
    assert {path.name for path in (tmp_path / "results" / "rough" / "seed_1").iterdir()} >= {"100", "packed"}

    before = len(events(diary))
    assert go_on(tmp_path / "results", FAKE_DIARY=str(diary)).returncode == 0
    assert finish(campaign(tmp_path, TWO, FAKE_DIARY=str(diary))).returncode == 0
    assert len(events(diary)) == before, "nothing is left to do"


def test_the_command_line_counts_before_the_file(tmp_path: Path) -> None:
    options = ("--only", "rough", "--seeds", "1", "--speed", "40", "--set", "phi=20", "--stress", "200")
    assert finish(campaign(tmp_path, TWO, *options)).returncode == 0
    assert [path.name for path in (tmp_path / "results").iterdir() if path.is_dir()] == ["rough"]
    rough = identity(tmp_path / "results" / "rough" / "seed_1")
    assert [rough["parameters"][name] for name in ("phi", "sides")] == ["20", "discs"]
    assert rough["speed_mm_s"] == 40
    assert not (tmp_path / "results" / "rough" / "seed_2").exists()
    assert (tmp_path / "results" / "rough" / "seed_1" / "200").is_dir()


def test_false_undoes_what_is_true_for_all(tmp_path: Path) -> None:
    """And one seed in a list is that seed."""
    text = TWO.replace("seeds = 2", "seeds = [7]\nindependent = true") + "independent = false\n"
    assert finish(campaign(tmp_path, text)).returncode == 0
    found = sorted(str(path.parent.relative_to(tmp_path / "results")) for path in tmp_path.rglob("run.json"))
    assert found == ["coarse/seed_7_100kPa", "rough/seed_7"]


def test_stopped_and_taken_up_again(tmp_path: Path) -> None:
    run = campaign(tmp_path, TWO, "--only", "coarse", FAKE_SECONDS="20")
    wait_for(lambda: (tmp_path / "results" / "coarse" / "seed_1" / "100" / "shear.restart.a").exists())
    run.terminate()
    told = finish(run)
    assert told.returncode == 128 + 15 and "To go on" in told.stderr
    diary = tmp_path / "diary"
    assert finish(campaign(tmp_path, TWO, "--only", "coarse", FAKE_DIARY=str(diary))).returncode == 0
    assert any(
        "shear.restart" not in line and line[:2] == ["start", "shear"] and len(line) > 3 for line in events(diary)
    )


def test_a_model_file_lies_beside_the_campaign(tmp_path: Path) -> None:
    text = (Path(__file__).resolve().parents[2] / "input" / "models" / f"{MODEL}.in").read_text(encoding="utf-8")
    (tmp_path / "mine.in").write_text(text, encoding="utf-8")
    done = finish(campaign(tmp_path, '[runs.a]\nmodel = "mine.in"\nseed = 3\nstress = 100\n', "--dry-run"))
    assert done.returncode == 0 and "mine: 350 grains" in done.stdout, done.stderr
    assert not (tmp_path / "results").exists()


@pytest.mark.parametrize(
    "text, message",
    [
        ("[runs.a\n", "study.toml: this is no TOML: "),
        ("[run.a]\n", "study.toml: [all] and [runs.NAME] are expected, not run"),
        ("", "study.toml: [all] and [runs.NAME] are expected"),
        ("runs = 3", "study.toml: [all] and [runs.NAME] are expected"),
        ("[runs]\na = 3", "study.toml: a = 3: a table is expected"),
        ('[runs."../a"]\n', "study.toml: [runs.../a]: letters, digits, _ . + - are expected"),
        ("[runs.a]\nseeds = 2", "study.toml: [runs.a]: there is no model"),
        (
            f'[runs.a]\nmodel = "{MODEL}"\nspede = 2',
            "study.toml: [runs.a]: there is no option spede of a run; did you mean speed",
        ),
        (
            f'[runs.a]\nmodel = "{MODEL}"\nout = "b"',
            "study.toml: [runs.a]: there is no option out of a run; there are model, stress, accuracy, ",
        ),
        (
            f'[runs.a]\nmodel = "{MODEL}"\njobs = 2',
            "study.toml: [runs.a]: there is no option jobs of a run; there are model, stress",
        ),
        (
            f'[all]\nseeds = "x"\n[runs.a]\nmodel = "{MODEL}"',
            "study.toml: [all]: argument --seeds: 'x': a number, or a range such as 4-8, is expected",
        ),
        (f'[runs.a]\nmodel = "{MODEL}"\n[runs.b]\nmodel = "none"', "study.toml: [runs.b]: unknown model 'none'"),
        (f'[runs.a]\nmodel = "{MODEL}"\nset = {{ phi = 95 }}', "[runs.a]: --set phi 95: 0 to 89 is expected"),
        (f'[runs.a]\nmodel = "{MODEL}"\nstress = -100', "study.toml: [runs.a]: --stress -100: a stress above 0 kPa"),
        (
            f'[runs.a]\nmodel = "{MODEL}"\nstres = 100',
            "study.toml: [runs.a]: there is no option stres of a run; did you mean stress",
        ),
        (
            f'[runs."report.html"]\nmodel = "{MODEL}"',
            "[runs.report.html]: files and folders of reports and jobs have such",
        ),
        (f'[runs.jobs]\nmodel = "{MODEL}"', "[runs.jobs]: files and folders of reports and jobs have such names"),
        (
            f'[all]\nmodel = "{MODEL}"\nset = {{ sides = "discs" }}\n[runs.a]\n[runs.b]\nhost = "liggghts"',
            "--host: lammps and liggghts are asked for, one for all runs is expected",
        ),
        (f'[runs.a]\nmodel = "{MODEL}"\nseed = 2\nseeds = 3', "--seeds: --seed is given, too"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, message: str) -> None:
    refused = finish(campaign(tmp_path, text))
    assert refused.returncode == 2 and message in refused.stderr
    assert not (tmp_path / "results").exists()


@pytest.mark.parametrize("below", ["", "100", "100/deeper"])
def test_a_campaign_within_a_run_would_never_be_seen(tmp_path: Path, below: str) -> None:
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / "run.json").write_text("{}", encoding="utf-8")
    file = tmp_path / "study.toml"
    file.write_text(TWO, encoding="utf-8")
    refused = finish(start(str(file), "--out", str(tmp_path / "results" / below)))
    assert refused.returncode == 2 and f"{tmp_path / 'results'} holds a run" in refused.stderr


def test_options_that_are_not_of_a_campaign(tmp_path: Path) -> None:
    assert "--only c: " in finish(campaign(tmp_path, TWO, "--only", "c")).stderr
    refused = finish(start(MODEL, "--out", str(tmp_path / "results"), "--only", "coarse"))
    assert f"--only: it is for campaign files, {MODEL} is none" in refused.stderr
    assert f"{tmp_path / 'none.toml'}: No such file" in finish(start(str(tmp_path / "none.toml"), "--out", "x")).stderr
    assert "--out is needed" in finish(start(str(tmp_path / "study.toml"))).stderr
