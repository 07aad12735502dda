# SPDX-License-Identifier: GPL-2.0-or-later
"""`import shearbox`: tests are run and read from a script, as tables."""

import json
import re
import signal
import textwrap
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic
from command import MODEL, TESTS

pandas = pytest.importorskip("pandas", reason="no pandas: tools/setup --ci installs python3-pandas")
import shearbox  # noqa: E402

ENGINE = TESTS / "fake_engine.py"


@pytest.fixture(name="test", scope="module")
def _test(tmp_path_factory: pytest.TempPathFactory) -> shearbox.Test:
    folder = tmp_path_factory.mktemp("python") / "results"
    (test,) = shearbox.run(MODEL, folder, stress=[100, 200], speed=20, set={"phi": 30}, engine=ENGINE)
    return test


@pytest.mark.usefixtures("undrawn")
def test_the_example_of_the_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("shearbox_tools.commands.run.default_program", lambda host: ENGINE)
    assert shearbox.__doc__
    example = re.search(r"::\n\n((?:    .*\n|\n)+)", shearbox.__doc__)
    assert example and "shearbox.run(" in example[1]
    exec(textwrap.dedent(example[1]), {})
    assert shearbox.read("results/first").stresses == [100, 200]


def test_what_was_asked_for(test: shearbox.Test) -> None:
    record = json.loads((test.folder / "run.json").read_text(encoding="utf-8"))
    assert record["stresses"] == [100, 200] == test.stresses
    assert (record["identity"]["speed_mm_s"], record["identity"]["parameters"]["phi"]) == (20, "30")
    assert (test.model, test.seed, test.doubts) == (MODEL, 1, [])


def test_curves_and_peaks_are_those_of_the_files(test: shearbox.Test) -> None:
    """The curve has peaks of 0.5 sigma + 5 kPa: tan(phi) = 0.5."""
    curve, expected = test.curve(200), synthetic.curves(200, 8)
    for name in ("displacement_mm", "tau_kPa", "lid_mm"):
        assert curve[name].to_numpy() == pytest.approx(expected[name], rel=1e-6, abs=1e-9)
    near = curve["tau_fit_kPa"].dropna()
    assert len(near) > 700 and np.abs(near - curve["tau_kPa"][near.index]).mean() < 0.03 * 200
    assert test.peaks()["tau_kPa"].to_dict() == pytest.approx({100: 55, 200: 105}, rel=0.05)
    assert test.phi_deg == pytest.approx(np.degrees(np.arctan(0.5)), abs=3)
    assert test.phi_plane_deg == pytest.approx(test.phi_deg, abs=1), "both stresses are a tenth less there"
    assert test.c_kPa == pytest.approx(5, abs=6)


def test_frames(test: shearbox.Test) -> None:
    frames = test.frames(100)
    assert list(frames.columns) == ["step", "displacement_mm", "time_s"] and len(frames) > 1
    last = test.frame(100, -1)
    assert set(last) == {"grains", "discs", "walls", "contacts", "cells"}
    assert len(last["grains"]) == synthetic.GRAINS and {"x", "y", "radius", "rotation"} <= set(last["grains"].columns)
    with pytest.raises(shearbox.Error, match=f"frame 999: there are {len(frames)} of 100 kPa"):
        test.frame(100, 999)


@pytest.mark.usefixtures("undrawn")
def test_progress_is_told(tmp_path: Path) -> None:
    told: list[tuple[float, str]] = []
    shearbox.run(
        MODEL,
        tmp_path / "a",
        stress=100,
        seeds=2,
        engine=ENGINE,
        progress=lambda share, text: told.append((share, text)),
    )
    shares = [share for share, _ in told]
    assert shares == sorted(shares) and shares[0] == 0 and shares[-1] == pytest.approx(1)
    assert told[-1][1].startswith("seed_") and "shear 100 kPa: done in" in told[-1][1]
    again: list[tuple[float, str]] = []
    tests = shearbox.run(
        MODEL,
        tmp_path / "a",
        stress=100,
        seeds=2,
        engine=ENGINE,
        progress=lambda share, text: again.append((share, text)),
    )
    assert again == [] and [test.seed for test in tests] == [1, 2]
    assert [test.folder.name for test in shearbox.runs(tmp_path)] == ["seed_1", "seed_2"]
    assert tests[0].phi_deg is None, "one stress has no line"


@pytest.mark.usefixtures("undrawn")
def test_numbers_may_come_in_any_row(tmp_path: Path) -> None:
    """Also in a thread, which cannot listen to signals; and after it who listened before does again."""
    heard = signal.getsignal(signal.SIGUSR1)
    options: dict[str, Any] = {"stress": np.array([100, 200]), "seeds": range(3, 5), "law": None, "engine": ENGINE}
    with ThreadPoolExecutor(1) as pool:
        tests = pool.submit(shearbox.run, MODEL, tmp_path / "a", **options).result()
    assert [(test.seed, test.stresses) for test in tests] == [(3, [100, 200]), (4, [100, 200])]
    shearbox.run(MODEL, tmp_path / "a", **options)
    assert signal.getsignal(signal.SIGUSR1) == heard


def test_what_is_refused(test: shearbox.Test, tmp_path: Path) -> None:
    cases: list[tuple[dict[str, Any], str]] = [
        ({"set": {"phi": 95}}, "--set phi 95: 0 to 89 is expected"),
        ({"spede": 3}, "unrecognized arguments: --spede 3"),
        ({"stress": "x"}, "'x' is not a number of kPa"),
        ({"dry-run": True}, "dry-run: this is for the command line alone"),
    ]
    for options, message in cases:
        with pytest.raises(shearbox.Error, match=message):
            shearbox.run(MODEL, tmp_path / "none", engine=ENGINE, **options)
    with pytest.raises(shearbox.Error, match="there is no curve of 300 kPa; there are 100, 200"):
        test.curve(300)
    with pytest.raises(shearbox.Error, match="holds no run"):
        shearbox.read(tmp_path)


@pytest.mark.usefixtures("undrawn")
def test_a_failure_is_raised_and_the_rest_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FAKE_FAIL", "200")
    with pytest.raises(shearbox.Error, match="shear 200 kPa"):
        shearbox.run(MODEL, tmp_path / "a", stress=[100, 200], engine=ENGINE)
    test = shearbox.read(tmp_path / "a")
    assert 100 in test.stresses and test.phi_deg is None and test.doubts
