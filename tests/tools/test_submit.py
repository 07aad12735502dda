# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox submit` without a cluster: what is in the scripts of jobs, and what is refused."""

import os
import shlex
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from shearbox_tools.asking.models import find_model
from shearbox_tools.asking.request import Request
from shearbox_tools.base.errors import InputError
from shearbox_tools.commands.cli import main
from shearbox_tools.jobs.cluster import Cluster, read_cluster
from shearbox_tools.jobs.layout import Layout
from shearbox_tools.jobs.schedulers import Job, find_scheduler
from shearbox_tools.jobs.submitted import name_of
from shearbox_tools.running.run_folders import Run, planned

ROOT = Path(__file__).resolve().parents[2]
SHEARBOX = ROOT / "tools" / "shearbox"
MODEL = "TypeA_10x5_4-8_1-circle_350"
REQUEST = Request(find_model(MODEL), (100.0, 200.0, 300.0, 400.0))
AWKWARD = "a b 'c' \"d\" $HOME `date` ;é"
SLURM = find_scheduler("slurm")


def submit(folder: Path, *options: str, **environment: str) -> subprocess.CompletedProcess[str]:
    command = [str(SHEARBOX), "submit", MODEL, "--out", str(folder), "--engine", "/bin/true", *options]
    return subprocess.run(command, env={**os.environ, **environment}, capture_output=True, text=True)


def specimens(count: int) -> list[Run]:
    return planned(Path("results"), REQUEST, range(1, count + 1), False)


def options(script: str) -> set[str]:
    return {line.removeprefix("#SBATCH ") for line in script.splitlines() if line.startswith("#SBATCH ")}


JOB = Job(
    "name", ["shearbox", "element", "results"], "jobs/tests", minutes=1502, elements=8, cores=96, nodes=2, notice=90
)


def test_the_script_of_an_array() -> None:
    cluster = Cluster(partition="p", account="a", options=("--mem=1G",), commands=("module load x",))
    assert SLURM.script(JOB, cluster).splitlines() == [
        "#!/bin/bash",
        "#SBATCH --job-name=name",
        "#SBATCH --array=1-8",
        "#SBATCH --output=jobs/tests_%a.log",
        "#SBATCH --open-mode=append",
        "#SBATCH --nodes=2",
        "#SBATCH --ntasks=96",
        "#SBATCH --time=1-01:02",
        "#SBATCH --signal=B:USR1@90",
        "#SBATCH --requeue",
        "#SBATCH --partition=p",
        "#SBATCH --account=a",
        "#SBATCH --mem=1G",
        "module load x",
        'exec shearbox element results "$SLURM_ARRAY_TASK_ID"',
    ]
    once = SLURM.script(replace(JOB, elements=0, notice=0), Cluster())
    assert not [
        line for line in once.splitlines() if "array" in line.lower() or "signal" in line or "partition" in line
    ]
    assert "#SBATCH --output=jobs/tests.log" in once and once.endswith("exec shearbox element results\n")


def test_words_reach_the_command_as_they_are(tmp_path: Path) -> None:
    """A shell runs the script; its command is one that says what it is given."""
    words = [AWKWARD, "", "-n", "*", "\\", "%a", "line\nline"]
    job = replace(JOB, command=["/usr/bin/python3", "-c", "import sys; print(sys.argv[1:])", *words])
    script = tmp_path / "tests.sh"
    script.write_text(SLURM.script(job, Cluster()), encoding="utf-8")
    done = subprocess.run(
        ["bash", script], env={"SLURM_ARRAY_TASK_ID": "3"}, capture_output=True, text=True, check=True
    )
    assert done.stdout == f"{[*words, '3']}\n"


def test_a_dry_run_prints_the_scripts_and_writes_nothing(tmp_path: Path) -> None:
    folder = tmp_path / AWKWARD
    done = submit(folder, "--seeds", "8", "--dry-run", PATH="/usr/bin")
    assert done.returncode == 0, done.stderr
    first = done.stdout.splitlines()[0]
    assert first.startswith("8 jobs of 1 specimen, 4 tests at a time on 4 cores: about ")
    commands = [shlex.split(line) for line in done.stdout.splitlines() if line.startswith("exec ")]
    assert [command[3:5] for command in commands] == [["element", str(folder)], ["report", str(folder)]]
    assert not folder.exists()


def test_without_a_batch_system_nothing_is_begun(tmp_path: Path) -> None:
    """And nothing is left that stands in the way of the next command."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "squeue").symlink_to("/bin/true")
    failed = submit(tmp_path / "results", PATH=str(tmp_path / "bin"))
    assert failed.returncode == 1
    assert "shearbox: sbatch: No such file or directory; is this a machine of the cluster?" in failed.stderr
    failed = submit(tmp_path / "other", PATH=str(tmp_path))
    assert "shearbox: squeue: No such file" in failed.stderr and not (tmp_path / "other").exists()


@pytest.fixture(name="idle")
def _idle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A batch system that takes every job, and knows of none: the commands it was given."""
    programs, said = tmp_path / "programs", tmp_path / "said"
    programs.mkdir()
    for name in ("sbatch", "squeue", "scancel"):
        answer = "echo 7" if name == "sbatch" else "true"
        (programs / name).write_text(f'#!/bin/sh\necho "{name} $*" >> "{said}"\n{answer}\n', encoding="utf-8")
        (programs / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}:{os.environ['PATH']}")
    return said


def test_two_that_submit_at_the_same_time_submit_once(tmp_path: Path, idle: Path) -> None:
    """The batch system takes its time, and knows of the jobs of the first one when that has been told their number. The second is told
    who is in its way, or which jobs."""
    begun = tmp_path / "begun"
    (tmp_path / "programs" / "squeue").write_text(f"#!/bin/sh\nif [ -e {begun} ]; then echo 1 RUNNING None; fi\n")
    (tmp_path / "programs" / "sbatch").write_text(
        f'#!/bin/sh\necho sbatch >> "{idle}"\nsleep 1\ntouch {begun}\necho 7\n'
    )
    with ThreadPoolExecutor(2) as pool:
        both = [done.result() for done in [pool.submit(submit, tmp_path / "results") for _ in range(2)]]
    (failed,) = [done for done in both if done.returncode]
    assert "is in use by another run" in failed.stderr or "its jobs have not ended: running" in failed.stderr
    assert idle.read_text(encoding="utf-8").split() == 2 * ["sbatch"], "the tests, and their report"


def test_a_copy_of_what_was_submitted_has_no_jobs(tmp_path: Path, idle: Path, capsys: pytest.CaptureFixture) -> None:
    """Those of the first one are neither told nor ended by it."""
    first, copy = tmp_path / "first", tmp_path / "copy"
    assert submit(first).returncode == 0
    shutil.copytree(first, copy)
    for command in ("status", "cancel"):
        assert main([command, str(copy)]) == 2
        assert f"its record of jobs is of the folder that it was copied or moved from: jobs {name_of(first)}" in (
            capsys.readouterr().err
        )
    assert "scancel" not in idle.read_text(encoding="utf-8")
    assert submit(copy).returncode == 0
    assert main(["status", str(copy)]) == 0


def test_the_environment_neither_hides_nor_renames_jobs(
    tmp_path: Path, idle: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What else a user has set for Slurm is kept."""
    for name in ("sbatch", "squeue", "scancel"):
        (tmp_path / "programs" / name).write_text(f'#!/bin/sh\nenv >> "{idle}"\necho 7\n', encoding="utf-8")
    hidden = "SQUEUE_STATES", "SBATCH_JOB_NAME", "SBATCH_NO_REQUEUE"
    for name in (*hidden, "SBATCH_ACCOUNT", "LOGNAME"):
        monkeypatch.setenv(name, "sand")
    SLURM.submit(tmp_path / "jobs" / "tests.sh")
    SLURM.cancel("name")
    said = idle.read_text(encoding="utf-8")
    assert "SBATCH_ACCOUNT=sand" in said
    assert not {f"{name}=sand" for name in hidden} & set(said.splitlines())


def test_jobs_are_those_of_a_folder_however_its_path_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "results"
    folder.mkdir()
    (tmp_path / "link").symlink_to(folder)
    monkeypatch.chdir(tmp_path)
    others = [tmp_path / "link", Path("results"), folder / ".." / "results"]
    assert {name_of(other) for other in others} == {name_of(folder)}
    assert name_of(tmp_path) != name_of(folder)


def test_a_run_that_is_gone_hides_no_other(tmp_path: Path, idle: Path, capsys: pytest.CaptureFixture) -> None:
    folder = tmp_path / "results"
    assert submit(folder, "--seeds", "2").returncode == 0
    shutil.rmtree(folder / "seed_1")
    assert main(["status", str(folder)]) == 0
    gone, there = capsys.readouterr().out.splitlines()
    assert gone.startswith("seed_1: ") and "seed_1" in gone.partition(":")[2] and "phases" not in gone
    assert there.startswith("seed_2: ended before it was done") and there.endswith("0 of 9 phases done")


def test_what_is_submitted_again_is_told_with_what_was_done_and_by_its_own_words(
    tmp_path: Path, idle: Path, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Element 1 is seed_1 at first and seed_2 then; what it said of seed_1 is kept, and not taken for a word on seed_2."""
    folder = tmp_path / "results"
    assert submit(folder, "--seeds", "2").returncode == 0
    log = folder / "jobs" / "tests_1.log"
    with log.open("a", encoding="utf-8") as stream:
        stream.write("seed_1 shear 100 kPa: done in 4 s\n")
    monkeypatch.setattr(
        "shearbox_tools.commands.submit.all_phases", lambda place, request: Done(place.name == "seed_1").phases
    )
    given = [MODEL, "--out", str(folder), "--engine", "/bin/true", "--seeds", "2"]
    assert main(["submit", *given]) == 0
    monkeypatch.setattr("shearbox_tools.commands.status.Forecast", lambda place, request: Done(place.name == "seed_1"))
    capsys.readouterr()
    assert main(["status", str(folder)]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "seed_1: done; 1 of 1 phases done",
        f"seed_2: ended before it was done, see {log}: nothing; 0 of 1 phases done",
    ]
    assert "seed_1 shear 100 kPa: done in 4 s" in log.read_text(encoding="utf-8")


class Done:
    """A forecast of one phase."""

    def __init__(self, done: bool) -> None:
        self.phases = [SimpleNamespace(name="pack", done=done)]


def test_runs_whose_names_differ_by_a_dot_are_told_apart(
    tmp_path: Path, idle: Path, capsys: pytest.CaptureFixture
) -> None:
    campaign = tmp_path / "campaign.toml"
    campaign.write_text(f'[all]\nmodel = "{MODEL}"\n[runs.a]\n[runs.".a"]\n', encoding="utf-8")
    command = [str(SHEARBOX), "submit", str(campaign), "--out", str(tmp_path / "results"), "--engine", "/bin/true"]
    subprocess.run(command, check=True)
    assert main(["status", str(tmp_path / "results")]) == 0
    assert [line.partition(":")[0] for line in capsys.readouterr().out.splitlines()] == ["a", ".a"]


@pytest.mark.parametrize("name", ["50%", "a\\b"])
def test_a_path_in_which_slurm_sees_patterns_is_refused(tmp_path: Path, idle: Path, name: str) -> None:
    refused = submit(tmp_path / name, "--dry-run")
    assert refused.returncode == 2
    assert f"{tmp_path / name}: Slurm reads % and \\ in the path of a log as patterns" in refused.stderr
    assert not (tmp_path / name).exists()


@pytest.mark.parametrize(
    "runs, cores, asked, ranks, elements, at_a_time, nodes",
    [
        (8, 0, None, 1, [1] * 8, 4, 1),  # one specimen a job, a core for each stress
        (8, 48, None, 1, [8], 32, 1),  # all fit on a node
        (13, 48, None, 1, [7, 6], 28, 1),  # of 12 that would fit, shared evenly
        (8, 2, None, 1, [1] * 8, 2, 1),
        (8, 0, 8, 1, [2] * 4, 8, 1),
        (8, 48, None, 12, [1] * 8, 4, 1),
        (8, 48, None, 96, [1] * 8, 1, 2),  # large: one test after the other, on two nodes
        (8, 48, 1, 96, [1] * 8, 1, 2),
        (1, 48, None, 1, [1], 4, 1),
    ],
)
def test_what_shares_a_job(
    runs: int, cores: int, asked: int | None, ranks: int, elements: list[int], at_a_time: int, nodes: int
) -> None:
    layout = Layout(specimens(runs), Cluster(cores=cores), asked, ranks)
    assert [len(element) for element in layout.elements] == elements
    assert (layout.at_a_time, layout.cores, layout.nodes) == (at_a_time, at_a_time * ranks, nodes)


def test_a_limit_is_twice_the_estimate_and_ten_minutes_but_none_is_longer_than_allowed() -> None:
    """A specimen of 350 discs: 150,000 steps of packing, and 4 s of test for each stress, all at 25 ns a disc and step."""
    layout = Layout(specimens(1), Cluster(), None, 1)
    assert layout.seconds == pytest.approx(layout.forecasts[0][0].seconds_with(4))
    assert 60 * layout.minutes == pytest.approx(2 * layout.seconds + 600 + layout.notice, abs=600)
    assert 60 * layout.minutes > 2 * layout.seconds + 600 + layout.notice and layout.minutes % 10 == 0
    assert Layout(specimens(1), Cluster(hours=0.1), None, 1).minutes == 6
    with pytest.raises(
        InputError, match="^short.toml: hours = 0.01: a job needs 6. s to end, and must last 3 times as long"
    ):
        Layout(specimens(1), Cluster(hours=0.01, file=Path("short.toml")), None, 1)


def test_the_notice_is_enough_for_the_phase_that_listens_least_often() -> None:
    """A million discs, sheared fast, end sooner after a row of shear than after 1000 steps of packing, at 45 ns a disc and step."""
    asked = replace(
        REQUEST,
        model=find_model("TypeD_330x105_2-4_1-circle_1000000"),
        speed=200.0,
        travel=1.0,
        settings={"frames": "1"},
    )
    layout = Layout(planned(Path("results"), asked, range(1, 2), False), Cluster(), None, 1)
    assert layout.notice > 60 + 2 * 2 * 1000 * 45e-9 * 1e6


def test_a_report_of_large_tests_has_time() -> None:
    """Of a million discs at one stress it took 3.8 minutes; of 32 such tests two hours, in a job that has twice that and half an hour."""
    asked = replace(REQUEST, model=find_model("TypeD_330x105_2-4_1-circle_1000000"), settings={"frames": "1"})
    layout = Layout(planned(Path("results"), asked, range(1, 9), False), Cluster(), None, 1)
    assert 30 + 2 * 32 * 3.8 < layout.report_minutes < 400


def test_what_does_not_fit_on_a_node_is_refused() -> None:
    with pytest.raises(InputError, match="--jobs 8: 6 of 8 ranks fit on the 48 cores of a node"):
        Layout(specimens(8), Cluster(cores=48), 8, 8)


def test_the_example_of_a_cluster() -> None:
    cluster = read_cluster(ROOT / "examples" / "cluster" / "cluster.toml")
    assert all(getattr(cluster, name) for name in vars(cluster)), "it shows all there is"
    assert SLURM.script(JOB, cluster).count("#SBATCH --mem-per-cpu=1G") == 1


@pytest.mark.parametrize(
    "text, message",
    [
        ("cores = 0", "cores = 0: a positive number that is whole is expected"),
        ("cores = 1.5", "cores = 1.5: a positive number that is whole is expected"),
        ("cores = true", "cores = True: a positive number that is whole is expected"),
        ("hours = inf", "hours = inf: a positive number is expected"),
        ("hours = '24:00'", "hours = '24:00': a positive number is expected"),
        ("partition = 'a b'", "partition = 'a b': a name without blanks and quotes is expected"),
        ("options = '--mem=1G'", "options = '--mem=1G': a list of lines is expected"),
        ('commands = ["a\\nb"]', "a list of lines is expected"),
        ("queue = 'x'", "queue: scheduler, partition, account, cores, hours, options, commands are expected"),
        ("cores", "Expected '=' after a key"),
        ("scheduler = 'pbs'", "scheduler pbs: slurm is expected"),
    ],
)
def test_what_a_file_of_a_cluster_may_not_say(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "cluster.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as refused:
        find_scheduler(read_cluster(path).scheduler)
    assert message in str(refused.value)


@pytest.mark.parametrize("option", ["--array=1-8%2", "-J mine", "--output=log", "--no-requeue", "--requeue"])
def test_options_that_are_not_the_users(option: str) -> None:
    with pytest.raises(InputError, match=f"^my.toml: options = '{option}': 'shearbox submit' sets it itself"):
        SLURM.script(JOB, Cluster(options=("--mem=1G", option), file=Path("my.toml")))


@pytest.mark.parametrize("option", ["#SBATCH --mem=1G", "mem=1G", ""])
def test_an_option_that_sbatch_would_take_for_a_comment(option: str) -> None:
    with pytest.raises(InputError, match=f"options = '{option}': an option of sbatch is expected, such as --mem=1G"):
        SLURM.script(JOB, Cluster(options=(option,)))


def test_a_file_of_a_cluster_that_is_not_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    assert read_cluster(None) == Cluster()
    with pytest.raises(InputError, match="none.toml: No such file"):
        read_cluster(tmp_path / "none.toml")
    (tmp_path / ".config" / "shearbox").mkdir(parents=True)
    (tmp_path / ".config" / "shearbox" / "cluster.toml").write_text("cores = 3", encoding="utf-8")
    assert read_cluster(None).cores == 3


def test_a_folder_of_which_nothing_was_submitted(tmp_path: Path) -> None:
    for command in (["status"], ["cancel"], ["element"]):
        done = subprocess.run(
            [SHEARBOX, *command, tmp_path, *["1"][: command == ["element"]]], capture_output=True, text=True
        )
        assert done.returncode == 2
        assert "nothing was submitted of it, there is no jobs/jobs.json" in done.stderr
