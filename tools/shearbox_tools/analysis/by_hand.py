# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests that were run with the decks by hand: what they are of is told by the engine's log, or by an option.

LAMMPS logs each command as it is written, and then with its variables' values; the value of a variable that -var set is
in no line of its own. So everything is taken from commands that act.
"""

import os
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..asking.box_width import narrow_by_record
from ..asking.models import PARAMETERS, Model, find_model, read_variables
from ..base.errors import InputError, ShearboxError
from ..base.files import CONSOLIDATED_TABLE, PACKED_TABLE, SHEAR_TABLE, log_file
from ..base.numerals import numeral
from ..reading.readers import Columns, read_row, read_shear
from ..running.phases import CONSOLIDATE, PACK, SHEAR
from .grouping import LeftOut
from .moments import missing_frames
from .motion import full_speed
from .polynomial import FEWEST_ROWS
from .results import Results, told_by_frames
from .shear import Shear, analyse

UNKNOWN = "unknown"
ANY_DECK = "log.lammps", "log.liggghts"  # where none is named, the log of the last deck
SPEED = "speed_mm_s"
_NUMBER = r"([-+.\de]+)"
_CONTACT = " ".join([_NUMBER] * 5)
_MARKS = {SHEAR: "cdem/move", PACK: "write_restart packed.restart"}  # in the log of that deck and of no other
_COMMANDS = {
    "model": r"include +\$\{models\}/\$\{model\}\.in\n(?:include .*\$.*\n)*include +(\S+)",
    "lower": rf"fix +lower lower cdem/move speed {_NUMBER} ramp {_NUMBER} stop {_NUMBER}",
    "lid": rf"fix +lid +lid +cdem/lid stress {_NUMBER} width {_NUMBER} thickness {_NUMBER}",
    "contact": rf"pair_coeff +1 1 {_CONTACT}(?: +rolling {_NUMBER} {_NUMBER})?(?: +cohesion {_NUMBER})? *$",
    "wall": rf"pair_coeff +1 2 {_CONTACT}",
    "inertia": rf"fix +motion +grains +cdem/integrate .* inertia {_NUMBER}",
    "law": r"pair_style +(?:cdem law|gran model) (direct|incremental)(?:_accumulation)?",
    "seed": r"cdem/create +1 fill .* seed (\d+)",
    "column": rf"cdem/create +1 fill \d+ region +{' +'.join([_NUMBER] * 4)} diameter {_NUMBER} .* seed \d+",
    "floor": rf"cdem/create +2 row +{' +'.join([_NUMBER] * 4)} +\d+ +diameter {_NUMBER} .*",
    "side": rf"cdem/create +([23]) row +{_NUMBER} +{_NUMBER} +\2 +(?!\3 ){_NUMBER} +(\d+) +diameter .*",  # upright
    "loose": rf"variable +loose +index {_NUMBER}",
    "packed": r"read_restart +([^\s$]*packed[^\s$]*)",
}

Said = dict[str, tuple[str, ...]]  # values in commands of a log, by the name of the command


@dataclass(frozen=True)
class Test:
    """One stress, in the folder of its shear.dat."""

    folder: Path
    identity: dict[str, Any]
    model_file: Path
    shear: Shear
    packing: dict[str, float] | None
    bed: dict[str, float] | None  # the table of consolidation
    frame_problems: list[str]
    notes: list[str]


def read_by_hand(
    folders: Iterable[Path], model: str | None, speed: float | None
) -> tuple[list[Results], list[LeftOut]]:
    """The tests in the folders, those of one packing together, and what cannot be read.

    model takes the place of what logs tell, speed (mm/s) is for tests without a log. InputError where they are needed.
    """
    together: list[list[Test]] = []
    left_out = []
    for folder in folders:
        try:
            test = _read(folder, model, speed)
        except InputError:
            raise
        except ShearboxError as error:
            left_out.append(LeftOut(folder, str(error)))
            continue
        for specimen in together:
            if _may_join(specimen, test):
                specimen.append(test)
                break
        else:
            together.append([test])
    packings = [tests[0].packing for tests in together]
    numbers = [packings.index(packing) if packing else number for number, packing in enumerate(packings)]
    return [_results(tests, number) for tests, number in zip(together, numbers)], left_out


def _may_join(tests: Sequence[Test], test: Test) -> bool:
    """Whether it is another stress of the same packing, as far as is known; of an unknown one it is taken to be.

    One that was stopped stays alone: it must not cost the others.
    """
    first = tests[0]
    another = all(other.shear.sigma != test.shear.sigma for other in tests)
    alike = first.identity == test.identity and first.packing == test.packing
    return another and alike and first.shear.complete and test.shear.complete


def _results(tests: Sequence[Test], number: int) -> Results:
    tests = sorted(tests, key=lambda test: test.shear.sigma)
    first = tests[0]
    notes = [f"{test.folder.name}: {note}" for test in tests for note in [*test.notes, *test.shear.remarks]]
    if first.packing is None:
        notes.append(f"no {PACKED_TABLE} tells of which packing it is" + ": taken for one" * (len(tests) > 1))
    notes += narrow_by_record(first.identity)
    return Results(
        folder=Path(os.path.commonpath([test.folder for test in tests])),
        identity={"seed": f"{UNKNOWN} ({number + 1})"} | first.identity,
        model_file=first.model_file,
        stresses=[test.shear.sigma for test in tests],
        packing=first.packing,
        consolidations={test.shear.sigma: test.bed for test in tests if test.bed},
        shears=[test.shear for test in tests],
        problems=(),  # a test whose table is damaged is left out
        frame_problems=tuple(problem for test in tests for problem in test.frame_problems),
        notes=tuple(notes),
    )


def _read(folder: Path, model: str | None, speed: float | None) -> Test:
    data = read_shear(folder / SHEAR_TABLE)
    said = _commands(folder, SHEAR)
    packed = _packed_in(folder)
    packing = _commands(packed, PACK)
    described = _model(folder, said, packing, model)
    pace = speed if "lower" not in said else 1000 * float(said["lower"][0])
    if pace is None:
        raise InputError(f"{folder}: {_no_log(folder)} tells the speed of the lower half: give --speed, in mm/s")
    travel = 1000 * float(said["lower"][2]) if "lower" in said else float(data["displacement_mm"][-1])
    sigma = float(f"{float(said['lid'][0]) / 1000:.6g}" if "lid" in said else f"{np.mean(data['sigma_kPa']):.3g}")
    bed = _row(folder / CONSOLIDATED_TABLE)
    identity = {
        "model": described.name,
        **{f"model {name}": value for name, value in described.variables.items()},
        SPEED: float(f"{pace:.6g}"),
        "travel_mm": float(f"{travel:.6g}"),
        "law": said.get("law", (UNKNOWN,))[0],
        "parameters": _parameters(said, packing) | _walls(packing),
        **({"seed": int(packing["seed"][0])} if "seed" in packing else {}),
    }
    rows = full_speed(data)
    if rows.stop - rows.start < FEWEST_ROWS:
        raise ShearboxError(f"{folder}: {rows.stop - rows.start} rows at full speed are too few to fit a curve")
    frame_problems: list[str] = []
    frames = told_by_frames(folder, identity, frame_problems)
    shear = analyse(sigma, folder, data, rows, _is_complete(data, travel), identity, bed or {}, *frames)
    notes = _sources(folder, said, packing)
    return Test(folder, identity, described.path, shear, _row(packed / PACKED_TABLE), bed, frame_problems, notes)


def _model(folder: Path, said: Said, packing: Said, model: str | None) -> Model:
    """As its file says now; width as the test had it, and the loose column where the packing had not that of its file or deck."""
    if model is None and "model" not in said:
        raise InputError(f"{folder}: {_no_log(folder)} tells the model: give --model, a name or a file")
    try:
        described = find_model(model or str(folder / said["model"][0]))
    except InputError as error:
        raise InputError(f"{folder}: the model: {error}; --model tells a name or a file") from error
    if "lid" in said:
        described = replace(described, width=float(said["lid"][1]))
    if not {"column", "loose"} <= packing.keys():
        return described
    loose = _rounded(float(packing["column"][3]) / (2 * described.half_height))
    usual = loose == _rounded(float(packing["loose"][0]))
    return described if usual else replace(described, further=described.further | {"loose": loose})


def _parameters(said: Said, packing: Said) -> dict[str, str]:
    """Of contacts, inertia and thickness as they were, and of friction while packing, where logs tell it; density as parameters.in
    says, and thickness where it is not told."""
    assumed = read_variables(PARAMETERS)
    told = {
        **dict(zip(("kn", "ks", "hn", "hs", "phi", "rolling", "", "cohesion"), said.get("contact", ()))),
        **dict(zip(("kn_wall", "ks_wall", "", "", "phi_wall"), said.get("wall", ()))),
        **dict(zip(("inertia",), said.get("inertia", ()))),
        **dict(zip(("phi_packing",), packing.get("contact", ())[4:])),
        "thickness": said["lid"][2] if "lid" in said else assumed["thickness"],
    }
    of_log = {name: numeral(float(value or 0)) for name, value in told.items() if name}
    return {"density": assumed["density"], **of_log}


def _walls(packing: Said) -> dict[str, str]:
    """The sides of the box and the wall discs, where the log of the packing tells them."""
    if not {"floor", "side", "column"} <= packing.keys():
        return {}
    disc = float(packing["floor"][-1])
    kind, _, first, last, count = packing["side"]
    told = {"sides": "smooth" if kind == "3" else "discs", "wall_disc": _rounded(disc / float(packing["column"][-1]))}
    pitch = abs(float(first) - float(last)) / (int(count) - 1)
    return told if kind == "3" else told | {"side_pitch": _rounded(pitch / disc)}


def _rounded(value: float) -> str:
    return f"{value:.6g}"


def _is_complete(data: Columns, travel: float) -> bool:
    """Whether the last row, a mean over its interval, is within two intervals of the end."""
    return bool(data["displacement_mm"][-1] >= travel * (1 - 2 / len(data["step"])))


def _packed_in(folder: Path) -> Path:
    """Where the restart file was that was consolidated, and table and log of the packing beside it; else the folder itself."""
    said = _commands(folder, CONSOLIDATE)
    return (folder / said["packed"][0]).parent if "packed" in said else folder


def _row(path: Path) -> dict[str, float] | None:
    return read_row(path) if path.exists() else None


def _sources(folder: Path, said: Said, packing: Said) -> list[str]:
    """Where the numbers come from, what is not known, and why there is no picture."""
    if said:
        log = _log(folder, SHEAR).name
        contacts = ", travel and contacts" if "contact" in said else " and travel"
        told = f"run by hand: model, σ, speed{contacts} are those of {log}; density is that of {PARAMETERS.name}"
    else:
        told = f"{_no_log(folder)} tells of the test: σ is the mean of its column, travel that of the last row"
    unknown = [] if "side" in packing else [f"no {PACK}.log tells the sides of the box, wall discs and the seed"]
    missing = missing_frames(folder)
    return [told, *unknown] + [f"no {', '.join(missing)} and so no picture"] * bool(missing)


def _log(folder: Path, deck: str) -> Path:
    own = log_file(folder, deck)
    return next((log for log in (own, *(folder / name for name in ANY_DECK)) if log.exists()), own)


def _no_log(folder: Path) -> str:
    return f"no log in it ({SHEAR}.log, {' or '.join(ANY_DECK)})"


def _commands(folder: Path, deck: str) -> Said:
    """The values in each command that has them all, of a log of that deck."""
    try:
        text = _log(folder, deck).read_text(encoding="utf-8", errors="replace")
    except OSError:
        return {}
    if _MARKS.get(deck, "") not in text:
        return {}
    found = {name: re.search(rf"^{pattern}(?=\s|$)", text, re.MULTILINE) for name, pattern in _COMMANDS.items()}
    return {name: match.groups() for name, match in found.items() if match}
