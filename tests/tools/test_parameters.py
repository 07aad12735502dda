# SPDX-License-Identifier: GPL-2.0-or-later
"""Variables that a run may set: what parameters.in says of them, and what becomes of a value."""

import json
import subprocess
from pathlib import Path

import pytest
from command import MODEL, SHEARBOX, UNDRAWN, command, shearbox
from rich.console import Console

from shearbox_tools.asking.models import INPUT, PARAMETERS, all_models, find_model, read_variables
from shearbox_tools.asking.parameters import parameters, read_settings
from shearbox_tools.asking.request import OWN_OPTION, Request, recorded
from shearbox_tools.base.errors import InputError, ShearboxError
from shearbox_tools.commands.listing import print_parameters
from shearbox_tools.running.checks import check
from shearbox_tools.running.phases import packing


def test_all_variables_of_the_decks_have_a_range() -> None:
    """But for what follows from others; and their own values are within."""
    known = parameters()
    follows = {name for name in read_variables(PARAMETERS) if name not in known}
    assert follows == {"areal", "wall_types"}
    assert [p.name for p in known.values() if p.value is not None and p.problem(p.value)] == []
    assert {name for model in all_models() for name in model.variables} <= set(known)
    for model in all_models():
        check(Request(model, (100.0,)))


def test_the_list_says_unit_and_range(capsys: pytest.CaptureFixture[str]) -> None:
    print_parameters()
    rows = {line.split()[0]: line for line in capsys.readouterr().out.splitlines() if line.strip()}
    assert set(parameters()) <= set(rows)
    assert all(word in rows["phi"] for word in ("27", "0 to 89", "(degrees)"))
    assert "--dt" in rows["dt"]


def test_all_that_the_list_says_can_be_read_on_a_terminal_of_80_columns(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("shearbox_tools.commands.listing._console", lambda: Console(width=80))
    print_parameters()
    said = capsys.readouterr().out
    assert max(map(len, said.splitlines())) <= 80
    words = [
        word for p in parameters().values() for word in f"{p.name} {p.value or ''} {p.allowed} {p.meaning}".split()
    ]
    assert [word for word in words if word not in said] == []


def test_variables_of_the_same_kind_have_texts_of_their_own() -> None:
    meanings = [p.meaning for p in parameters().values()]
    assert len(set(meanings)) == len(meanings)


def test_the_same_for_scripts(capsys: pytest.CaptureFixture[str]) -> None:
    print_parameters(as_json=True)
    told = {one["name"]: one for one in json.loads(capsys.readouterr().out)}
    assert set(told) == set(parameters())
    assert told["phi"] == {
        "name": "phi",
        "value": "27",
        "allowed": "0 to 89",
        "meaning": "friction angle between grains (degrees)",
    }
    assert told["width"]["value"] is None


@pytest.mark.parametrize(
    "setting, message",
    [
        ("phi=95", "--set phi 95: 0 to 89 is expected: friction angle between grains (degrees)"),
        ("phi=-1", "--set phi -1: 0 to 89"),
        ("phi=nan", "--set phi nan: 0 to 89"),
        ("phi=2_7", "--set phi 2_7: 0 to 89"),
        ("phi=27°", "--set phi 27°: 0 to 89"),
        ("phi", "--set phi: NAME=VALUE is expected, such as phi=30"),
        ("phi=", "--set phi=: NAME=VALUE"),
        ("fi=30", "there is no parameter fi; 'shearbox parameters' lists them"),
        ("areal=20", "there is no parameter areal; 'shearbox parameters' lists them"),
        (
            "friction=30",
            "there is no parameter friction, did you mean phi, phi_packing, phi_wall; 'shearbox parameters'",
        ),
        ("phi_pack=30", "there is no parameter phi_pack, did you mean phi_packing;"),
        ("step=1e-7", "there is no parameter step, did you mean --dt, dt_max"),
        ("rows=400", "rows is a variable of input/shear.in alone: run that deck by hand with -var rows 400"),
        ("model=mine", "there is no parameter model"),
        ("phi_wall=30", "--set phi_wall=30: it changes nothing as long as ks_wall is 0"),
        ("ks_wall=1e7", "--set ks_wall=10000000: it changes nothing as long as phi_wall is 0"),
        ("side_pitch=0.5", "--set side_pitch=0.5: it changes nothing as long as sides is smooth"),
        ("check=1.5", "--set check 1.5: 1 to 1000000, whole is expected"),
        ("shape=quadruple", "--set shape quadruple: single or triple or file ... or discs ... is expected"),
        ("shape=single file", "--set shape single file: single or"),
        ("dt=1e-7", "the option for this is --dt"),
    ],
)
def test_a_setting_that_cannot_be_is_refused(setting: str, message: str) -> None:
    with pytest.raises(InputError) as error:
        read_settings([setting], OWN_OPTION)
    assert message in str(error.value)


def test_a_setting_twice_and_all_at_once() -> None:
    with pytest.raises(InputError) as error:
        read_settings(["phi=30", "phi=31", "kn=1"], OWN_OPTION)
    assert "phi is set twice" in str(error.value) and "--set kn 1: 1e3 to 1e12" in str(error.value)


def settings(*texts: str) -> Request:
    known = read_settings(list(texts), OWN_OPTION)
    of_model = {name: value for name, value in known.items() if name in ("ngrains", "width", "shape", "dmin", "loose")}
    return Request(find_model(MODEL, of_model), (100.0,), settings=known)


def test_settings_reach_the_decks(tmp_path: Path) -> None:
    variables = packing(tmp_path, settings("phi=30.0", "kn=5e7", "width=0.11")).variables
    assert {name: variables[name] for name in ("phi", "kn", "width")} == {
        "phi": "30",
        "kn": "50000000",
        "width": "0.11",
    }


@pytest.mark.parametrize(
    "setting, message",
    [
        ("ngrains=40", "ngrains 40: about 212 to 424 are expected; 40 of these grains would be 0.23 times as high"),
        ("ngrains=900", "ngrains 900: about 212 to 424"),
        ("dmin=0.009", "dmin 0.009 is more than dmax 0.008"),
        ("width=5", "ngrains 350: about"),
    ],
)
def test_grains_that_do_not_fill_the_box_are_refused(setting: str, message: str) -> None:
    """n(d) ~ d^-3 from 4 to 8 mm has the mean square 2 ln 2 / (1/16 - 1/64) = 29.6 mm^2, so a grain in a width of 100 mm,
    with a solid fraction of 0.82, adds 0.283 mm of height: 212 are 1.2 times, 424 2.4 times 50 mm high."""
    with pytest.raises(InputError) as error:
        check(settings(setting))
    assert message in str(error.value)


def test_of_too_many_grains_in_a_name_their_number_is_told_and_nothing_that_follows_from_it() -> None:
    """The height of the column that they would be packed in is no variable that the user has written."""
    with pytest.raises(InputError) as error:
        check(Request(find_model("TypeA_10x5_4-8_1-circle_35000"), (100.0,)))
    assert str(error.value).startswith(
        "model TypeA_10x5_4-8_1-circle_35000: ngrains 35000: about 212 to 424 are expected; 35000 of these grains"
    )
    assert "loose" not in str(error.value)


@pytest.mark.parametrize(
    "line, message",
    [
        ("variable phi index 30", "phi is no variable of a model; these are width, half_height"),
        ("variable lose index 2", "lose is no variable of a model"),
        ("variable loose index 0.5", "loose 0.5: 1 to 20 is expected"),
    ],
)
def test_a_model_has_no_variables_of_no_effect(tmp_path: Path, line: str, message: str) -> None:
    """The decks read parameters.in first, so its values would count."""
    path = tmp_path / "own.in"
    path.write_text((INPUT / "models" / f"{MODEL}.in").read_text(encoding="utf-8") + line + "\n", encoding="utf-8")
    with pytest.raises(InputError, match=message):
        check(Request(find_model(str(path)), (100.0,)))


def test_a_folder_goes_on_as_it_was_asked_for(tmp_path: Path) -> None:
    """Though the model's file and a template have been changed since; --set is part of what a run is."""
    folder, path = tmp_path / "results", tmp_path / "own.in"
    text = (
        (INPUT / "models" / f"{MODEL}.in").read_text(encoding="utf-8").replace("index single", 'index "file two.txt"')
    )
    path.write_text(text.replace("index 350", "index 260"), encoding="utf-8")
    (tmp_path / "two.txt").write_text("0 0 1\n1 0 1\n", encoding="utf-8")
    asked = ("--stress", "100", "--accuracy", "fast", "--set", "phi=30", "kn=5e7", "--set", "ngrains=250")
    assert shearbox(folder, *asked, model=str(path)).returncode == 0
    assert json.loads((folder / "run.json").read_text(encoding="utf-8"))["identity"]["parameters"]["phi"] == "30"
    refused = shearbox(folder, *asked[:-1], "ngrains=251", model=str(path))
    assert refused.returncode == 2
    assert "model ngrains: 250 there, 251 asked for" in refused.stderr and f"shearbox run {folder}" in refused.stderr

    (tmp_path / "two.txt").write_text("0 0 1\n1 0 .5\n", encoding="utf-8")
    request = recorded(folder)
    assert (request.speed, request.model.ngrains, request.model.shape) == (200, 250, "discs 2 0 0 1 1 0 1")
    assert request.settings == {
        "phi": "30", "kn": "50000000", "ngrains": "250", "shape": "discs 2 0 0 1 1 0 1"
    }  # fmt: skip
    engine = str(SHEARBOX.parents[1] / "tests" / "tools" / "fake_engine.py")
    words = [str(UNDRAWN), "run", str(folder), "--engine", engine]
    more = subprocess.run([*words, "--stress", "200"], capture_output=True, text=True, timeout=120)
    assert more.returncode == 0, more.stderr
    assert "pack: started" not in more.stdout and "shear 200 kPa: done" in more.stdout
    other = subprocess.run([*words, "--speed", "3"], capture_output=True, text=True, timeout=120)
    assert other.returncode == 2 and "speed_mm_s: 200.0 there, 3.0 asked for" in other.stderr


def test_a_dry_run_says_what_and_leaves_nothing(tmp_path: Path) -> None:
    folder = tmp_path / "results"
    said = shearbox(folder, "--dry-run", "--set", "phi=30", "--stress", "100", "--stress", "200")
    assert said.returncode == 0, said.stderr
    for words in ("350 grains of 1 disc,", "phi = 30", "pack: about", "shear 200 kPa: about", "in all about", " MB"):
        assert words in said.stdout
    assert not folder.exists()


def test_the_folder_is_needed(tmp_path: Path) -> None:
    words = [word for word in command(tmp_path) if word not in ("--out", str(tmp_path))]
    refused = subprocess.run(words, capture_output=True, text=True, timeout=60)
    assert refused.returncode == 2 and "--out is needed" in refused.stderr


def test_a_bad_file_among_the_models_costs_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from shearbox_tools.asking import models
    from shearbox_tools.commands import listing

    for name in (f"{MODEL}.in", "TypeB_15x5_4-8_1-circle_550.in"):
        (tmp_path / name).write_bytes((INPUT / "models" / name).read_bytes())
    (tmp_path / "bad.in").write_text("variable width index 10 cm\n", encoding="utf-8")
    monkeypatch.setattr(listing, "model_files", lambda: models.model_files(tmp_path))
    listing.print_models()
    said = capsys.readouterr().out
    assert MODEL in said and "TypeB_15x5" in said
    assert "bad.in: 'variable NAME index VALUE' is expected, not 'variable width index 10 cm'" in said.replace("\n", "")
    monkeypatch.setattr(models.model_files, "__defaults__", (tmp_path,))
    assert find_model(MODEL).ngrains == 350


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("index 27 ", "index 95 ", "parameters.in: phi 95: 0 to 89 is expected: friction angle between"),
        ("index 0.25 ", "index wide ", "parameters.in: flanges wide: 0.01 to 0.9 is expected"),
        ("variable kn ", "variable kN ", "parameters.in: there is no variable kn with what it may be in [ ]"),
        ("[1e3 to 1e12]", "[1e3 to many]", "parameters.in: kn 1.0e8: 1e3 to many is expected"),
    ],
)
def test_what_is_wrong_in_the_deck_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, old: str, new: str, message: str
) -> None:
    path = tmp_path / "parameters.in"
    path.write_text(PARAMETERS.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    monkeypatch.setattr("shearbox_tools.running.checks.PARAMETERS", path)
    monkeypatch.setattr("shearbox_tools.running.checks.parameters", lambda: parameters(path))
    with pytest.raises(ShearboxError) as error:
        check(Request(find_model(MODEL), (100.0,)))
    assert message in str(error.value)


def test_what_acts_together_may_be_set_together() -> None:
    """And a value that is the default's may be written down."""
    both = ["phi_wall=30", "ks_wall=1e7"]
    assert read_settings(both, OWN_OPTION) == {"phi_wall": "30", "ks_wall": "10000000"}
    assert read_settings(["side_pitch=0.5", "sides=discs"], OWN_OPTION) == {"side_pitch": "0.5", "sides": "discs"}
    assert read_settings(["ks_wall=0", "phi_wall=0.0"], OWN_OPTION) == {"ks_wall": "0", "phi_wall": "0"}
