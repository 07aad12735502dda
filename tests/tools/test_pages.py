# SPDX-License-Identifier: GPL-2.0-or-later
"""What is in the source is on the page that says so: laws, what contacts remember, styles."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src"


def text(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def page(header: str) -> str:
    """The comment at the top of a header."""
    lines = text(SOURCE / "lammps" / header).split("#pragma once")[0].splitlines()
    return "\n".join(line.removeprefix("//") for line in lines)


def laws() -> str:
    return "".join(text(path) for path in [SOURCE / "core/contact_law.h", *sorted((SOURCE / "core/laws").glob("*.h"))])


@pytest.mark.parametrize("name", re.findall(r'\bNAME = "(\w+)"', laws()))
def test_every_law_is_on_the_page_of_the_pair_style(name: str) -> None:
    assert re.search(rf"(?<![\w/]){name}(?![\w.])", page("contacts/pair_cdem.h"))  # a name of a file is not enough


def test_every_number_of_a_contact_is_on_the_page_of_its_compute() -> None:
    declared = re.findall(r"\bREMEMBERS\{\{(.*?)\}\};", laws(), re.DOTALL)
    names = [name for one in declared for name in re.findall(r'\{"(\w+)",', one)]
    assert "rolling" in names and "en" in names
    rows = re.findall(r"^   (\w+)  ", page("output/compute_cdem_contacts.h"), re.MULTILINE)
    assert set(names) <= set(rows)


def styles() -> list[tuple[str, str]]:
    found: list[tuple[str, str]] = re.findall(
        r'^ +(\w+)<\w+>\("([\w/]+)"\)', text(SOURCE / "lammps/entry/styles.cpp"), re.M
    )
    return found


def test_every_style_is_in_the_table_of_the_readme() -> None:
    """But for fixes that other styles make, which are not for decks."""
    headers = "".join(text(path) for path in (SOURCE / "lammps").rglob("*.h"))
    made = set(re.findall(r"^// fix ([\w/]+): made by", headers, re.MULTILINE))
    assert len(made) == 4
    kinds = {
        "pair": "pair_style ",
        "fix": "fix ",
        "compute": "compute ",
        "dump": "dump ",
        "run": "run_style ",
        "command": "",
    }
    wanted = {kinds[kind] + name for kind, name in styles() if not (kind == "fix" and name in made)}
    assert len(wanted) >= 12
    assert wanted == set(re.findall(r"^\| \[([\w /]+)\]\(src/lammps/", text(ROOT / "README.md"), re.MULTILINE))
