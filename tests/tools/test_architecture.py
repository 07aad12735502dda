# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of ARCHITECTURE.md is what its command draws, and what the documents name is there."""

from __future__ import annotations

import re
import subprocess
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path

import pytest
from rooms import ROOMS, TOOLS_ROOMS

ROOT = Path(__file__).resolve().parents[2]
PICTURE = ROOT / "src" / "step.svg"
DOCUMENTS = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"]


def text(document: str) -> str:
    return (ROOT / document).read_text(encoding="utf-8")


def test_the_picture_is_the_one_that_is_drawn(tmp_path: Path) -> None:
    subprocess.run([ROOT / "tools" / "draw_step", tmp_path / "step.svg"], check=True)
    drawn = (tmp_path / "step.svg").read_text(encoding="utf-8")
    assert drawn == PICTURE.read_text(encoding="utf-8"), "tools/draw_step draws it anew"


def test_the_picture_names_files_that_are_there() -> None:
    lines = [e.text or "" for e in ElementTree.parse(PICTURE).iter() if e.get("class") == "file"]
    files = [word for line in lines if line != "LAMMPS" for word in line.split(", ")]
    assert len(files) > 12
    room = ""
    for name in files:
        room = name.split("/")[0] if "/" in name else room  # of several files the first tells it
        path = name if "/" in name else f"{room}/{name}"
        folder = "src" if path.startswith("core/") else "src/lammps"
        for one in braces(f"{folder}/{path}"):
            assert (ROOT / one).is_dir() or (ROOT / f"{one}.h").exists(), one


def braces(name: str) -> Iterator[str]:
    """The names that a name with {a,b} stands for."""
    inner = re.search(r"\{(.*?)\}", name)
    for part in inner[1].split(",") if inner else [""]:
        yield name.replace(inner[0], part) if inner else name


def test_the_tables_have_all_rooms_in_their_order() -> None:
    rooms = re.findall(r"^\| \[(?:src/)?(\w+)\]\(src/", text("ARCHITECTURE.md"), re.MULTILINE)
    assert rooms == ROOMS
    rooms = re.findall(r"^\| \[(\w+)\]\(tools/shearbox_tools/", text("ARCHITECTURE.md"), re.MULTILINE)
    assert rooms == TOOLS_ROOMS


def anchors(document: str) -> set[str]:
    """Where links into the document lead, as GitHub names its headings."""
    headings = re.findall(r"^#+ (.*)$", text(document), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("document", DOCUMENTS)
def test_links_lead_somewhere(document: str) -> None:
    links = [link for link in re.findall(r"\]\(([^)\s]+)\)", text(document)) if not link.startswith("http")]
    assert links
    for link in links:
        path, _, anchor = link.partition("#")
        assert (ROOT / path).exists(), link
        if anchor and (not path or path.endswith(".md")):
            assert anchor in anchors(path or document), link


def test_files_of_the_recipes_are_there() -> None:
    """But for those that its examples would add."""
    own = {"src/core/laws/viscous_rolling.h"} | set(braces("src/lammps/output/compute_cdem_count.{h,cpp}"))
    named = set(re.findall(r"`((?:src|tests|tools|input|examples)/[^`\s]+)`", text("CONTRIBUTING.md")))
    assert len(named) > 20
    for name in named:
        for one in braces(name):
            assert "NAME" in one or one in own or list(ROOT.glob(one)), one
