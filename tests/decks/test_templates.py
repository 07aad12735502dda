# SPDX-License-Identifier: GPL-2.0-or-later
"""Templates of fix cdem/shape: how they are given, what they say of themselves, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from clumps import SQRT3
from engine import Disc, run, start, write_data

FILES = {
    "good": b"# x y r\n0 0 1\r\n\n 2 0 1 # the second\n",
    "empty": b"",
    "comment": b"# nothing\n\n",
    "two-columns": b"0 0 1\n2 0\n",
    "four-columns": b"0 0 1 5\n",
    "words": b"x y r\n0 0 1\n",
    "commas": b"0,0,1\n",
    "not-a-number": b"0 0 1\n2 0 nan\n",
    "negative": b"0 0 1\n2 0 -1\n",
    "binary": bytes(range(256)) * 8,
}
BOTH = "type 1 single type 2 single"
REFUSED = {
    "type 1 discs 0 type 2 single": "discs 0: must be a positive number",
    "type 1 discs -3 0 0 1 type 2 single": "discs -3: must be a positive number",
    "type 1 discs 1.5 0 0 1 type 2 single": "discs is 1.5, must be an integer",
    "type 2 single type 1 discs": "discs has no value",
    "type 2 single type 1 discs 1000000000 0 0 1": "discs 1000000000: must be a positive number of discs, each with x y r; 3 values follow",
    "type 2 single type 1 discs 2147483647 0 0 1": "discs 2147483647: must be a positive number of discs",
    "type 2 single type 1 discs 2147483648 0 0 1": "discs is 2147483648, must be an integer",
    "type 2 single type 1 discs 2 0 0 1 2 0": "5 values follow",
    "type 2 single type 1 discs 1 0 0 1 5": "unknown keyword 5",
    "type 1 discs 2 0 0 1 2 0 type 2 single": "r of disc 2 is type, must be a number",
    "type 1 discs 1 0 a 1 type 2 single": "y of disc 1 is a, must be a number",
    "type 1 discs 1 0 0 0 type 2 single": "type 1, discs: disc 1 has radius 0",
    "type 1 discs 2 0 0 1 1 0 -0.5 type 2 single": "disc 2 has radius -0.5",
    "type 1 discs 1 0 0 -1e-9 type 2 single": "disc 1 has radius -1e-09",
    "type 1 discs 1 0 0 nan type 2 single": "r of disc 1 is nan",
    "type 1 discs 3 0 0 1 2 0 1 0 0 1 type 2 single": "disc 1 is a duplicate of, or lies inside, disc 3",
    "type 1 discs 2 0 0 1 0.1 0 0.2 type 2 single": "disc 2 is a duplicate of, or lies inside, disc 1",
    "type 1 discs 2 0 0 1 3 0 1 type 2 single": "disc 2 is disconnected from disc 1",
    "type 1 triple": "atom type 2 has no template",
    "": "atom type 1 has no template",
    "type 3 single " + BOTH: "type 3 must be between 1 and 2",
    "type 0 single " + BOTH: "type 0 must be between 1 and 2",
    "type 1 triple " + BOTH: "type 1 has two templates",
    "type 1 quadruple type 2 single": "type 1: unknown template quadruple; allowed: single, triple, discs, file",
    "type 1": "type 1: unknown template",
    "type x single": "type is x, must be an integer",
    BOTH + " density 0": "density 0: must be positive",
    BOTH + " density -26.5": "density -26.5: must be positive",
    BOTH + " density": "density has no value",
    BOTH + " orient 0": "orient 0: must be 1 or more",
    BOTH + " orient -4": "orient -4: must be 1 or more",
    BOTH + " orient 1.5": "orient is 1.5, must be an integer",
    BOTH + " colour red": "unknown keyword colour; allowed: folder, type, density, orient",
    BOTH + f"\nfix more all cdem/shape {BOTH}": "Fix cdem/shape more: there is one already, shape",
    BOTH + " folder": "folder: its name is missing",
    "folder elsewhere type 1 file good type 2 single": "can't read the template file elsewhere/good: No such file",
    "type 1 file": "type 1: file: its name is missing",
    "type 1 file missing type 2 single": "file missing: No such file",
    "type 1 file empty type 2 single": "file empty: it has no discs",
    "type 1 file comment type 2 single": "file comment: it has no discs",
    "type 1 file two-columns type 2 single": "two-columns line 2 is not 'x y r': 2 0",
    "type 1 file four-columns type 2 single": "four-columns line 1 is not 'x y r': 0 0 1 5",
    "type 1 file words type 2 single": "words line 1 is not 'x y r': x y r",
    "type 1 file commas type 2 single": "commas line 1 is not 'x y r': 0,0,1",
    "type 1 file not-a-number type 2 single": "not-a-number line 2 is not 'x y r': 2 0 nan",
    "type 1 file negative type 2 single": "file negative: disc 2 has radius -1",
    "type 1 file binary type 2 single": "binary line 1 is not text",
    "type 1 file . type 2 single": "template file . is a folder",
}


def offer(arguments: str, directory: Path) -> tuple[int, str]:
    write_data(directory / "discs.data", [Disc(0, 0), Disc(0.01, 0, type=2)], (-0.02, 0.02, -0.02, 0.02))
    for name, content in FILES.items():
        (directory / name).write_bytes(content)
    deck = f"include ${{decks}}/start.in\nfix shape all cdem/shape {arguments}\n"
    return start(deck + 'print "not refused"\nfix move grains cdem/integrate dt auto\nrun 0\n', directory)


def test_good_templates(tmp_path: Path) -> None:
    for template in ("single", "triple", "file good", "discs 1 0 0 1"):
        arguments = f"type 1 {template} type 2 single density 26.5"
        status, output = offer(arguments, tmp_path)
        assert status == 0 and "not refused" in output, arguments


def test_a_template_file_in_another_folder(tmp_path: Path) -> None:
    (tmp_path / "shapes").mkdir()
    (tmp_path / "shapes" / "pair").write_text("0 0 1\n2 0 1\n")
    for folder, name in (("shapes", "pair"), ("nowhere", tmp_path / "shapes" / "pair")):
        status, output = offer(f"folder {folder} type 1 file {name} type 2 single density 26.5", tmp_path)
        assert status == 0 and "not refused" in output, output


LENS = 2 * math.pi / 3 - SQRT3 / 2  # area that two discs of radius 1 share when their centres are 1 apart


@pytest.mark.parametrize(
    ("template", "discs", "size", "fill"),
    [
        ("single", 1, 1, 1),
        ("triple", 3, 1 + 2 / SQRT3, 3 / (1 + 2 / SQRT3) ** 2),
        ("discs 2 0 0 2 3 0 1", 2, 1.7, 5 / 3.4**2),  # their centre is 0.6 from the larger one: 3.4 = 2.4 + 1
        ("discs 2 5 5 1 6 5 1", 2, 1.5, (2 - LENS / math.pi) / 1.5**2),
        ("discs 5 0 0 1 1 0 1 -1 0 1 0 1 1 0 -1 1", 5, 2, (4 + 2 * math.pi) / (4 * math.pi)),  # a square, 4 half discs
    ],
)
def test_what_a_shape_says_of_itself(tmp_path: Path, template: str, discs: int, size: float, fill: float) -> None:
    """Discs of a grain, circumscribed circle over the largest disc, area over that of the circle; per type."""
    deck = f"""
    include ${{decks}}/start.in
    fix shape all cdem/shape type 1 single type 2 {template}
    print "discs = $(f_shape[2][1])"
    print "size = $(f_shape[2][2]:%.17g)"
    print "fill = $(f_shape[2][3]:%.17g)"
    print "first = $(f_shape[1][1]+f_shape[1][2]+f_shape[1][3])"
    """
    out = run(deck, tmp_path, discs=[Disc(0, 0), Disc(0.01, 0, type=2)])
    assert out.printed("first") == 3
    assert out.printed("discs") == discs
    assert out.printed("size") == pytest.approx(size, rel=1e-15)
    assert out.printed("fill") == pytest.approx(fill, rel=1e-13)


@pytest.mark.parametrize(("arguments", "message"), REFUSED.items(), ids=[key.replace("\n", "; ") for key in REFUSED])
def test_refused(tmp_path: Path, arguments: str, message: str) -> None:
    """Before the run, with the value in the message."""
    status, output = offer(arguments, tmp_path)
    assert status != 0
    assert "not refused" not in output
    [error] = [line for line in output.splitlines() if line.startswith("ERROR")]
    assert message in error
