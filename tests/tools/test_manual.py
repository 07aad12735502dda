# SPDX-License-Identifier: GPL-2.0-or-later
"""The manual: it builds without a warning, holds what the sources say, and can be read on a phone."""

import html
import importlib.util
import re
import subprocess
from pathlib import Path

import pytest
from browser import needs_browser, told

from shearbox_tools.asking.parameters import parameters

ROOT = Path(__file__).resolve().parents[2]
NEEDED = [name for name in ("sphinx", "myst_parser", "furo") if importlib.util.find_spec(name) is None]
pytestmark = pytest.mark.skipif(
    bool(NEEDED),
    reason=f"no {', '.join(NEEDED)}: tools/setup --ci installs python3-sphinx, python3-myst-parser and furo",
)


@pytest.fixture(name="manual", scope="module")
def _manual(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Links that lead nowhere, and formulas that cannot be read, are errors."""
    folder = tmp_path_factory.mktemp("manual")
    built = subprocess.run([ROOT / "tools" / "manual", folder], capture_output=True, text=True, timeout=120)
    assert built.returncode == 0, built.stderr
    return folder


def text(page: Path) -> str:
    """What is to be read on a page."""
    return html.unescape(re.sub(r"<[^>]+>", "", page.read_text(encoding="utf-8")))


def test_every_style_has_its_page(manual: Path) -> None:
    """With the first line of its header, and the last."""
    headers = re.findall(r"^\| \[.*?\]\((src/.*?\.h)\)", (ROOT / "README.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert len(headers) > 15
    for header in headers:
        lines = (ROOT / header).read_text(encoding="utf-8").split("#pragma once")[0].splitlines()
        said = " ".join(text(manual / "generated" / f"{Path(header).stem}.html").split())
        for line in (lines[1], lines[-1]):
            assert " ".join(line.lstrip("/ ").split()) in said, header


def test_every_parameter_and_column_is_told(manual: Path) -> None:
    page, columns = (text(manual / "generated" / f"{name}.html") for name in ("parameters", "columns"))
    for name, parameter in parameters().items():
        assert name in page and parameter.allowed in page
    titles = re.search(r'title "# (.*?)"', (ROOT / "input" / "shear.in").read_text(encoding="utf-8"), re.DOTALL)
    assert titles
    for name in titles[1].replace("&", " ").split():
        assert name in columns or re.match(r"(stress|fabric)_", name), name


def test_formulas_are_formulas(manual: Path) -> None:
    source = (ROOT / "manual" / "numbers.md").read_text(encoding="utf-8")
    wanted = len(re.findall(r"\$\$.*?\$\$|\$[^$]+\$", source, re.DOTALL))
    page = (manual / "numbers.html").read_text(encoding="utf-8")
    assert page.count("<math") == wanted > 10 and "<msqrt>" in page


def measured(folder: Path, pages: list[Path], width: int, what: str) -> list[int]:
    """Of each page in a frame f so wide (px), what an expression of JavaScript says of it."""
    frames = "".join(
        f'<iframe style="width: {width}px; height: 800px; border: 0" src="{page.as_uri()}"></iframe>' for page in pages
    )
    look = f"[...document.querySelectorAll('iframe')].map(f => {what})"
    tell = f"onload = () => {{ const found = JSON.stringify({look}); document.body.textContent = found; }}"
    harness = folder / "harness.html"
    harness.write_text(f'<!DOCTYPE html><meta charset="utf-8"><body>{frames}<script>{tell}</script>', encoding="utf-8")
    found: list[int] = told(folder, harness, "--allow-file-access-from-files")
    return found


@needs_browser
def test_on_a_phone(manual: Path, tmp_path: Path) -> None:
    """No page is wider than the screen; what is wide scrolls by itself."""
    pages = sorted(path for path in manual.rglob("*.html") if "_static" not in path.parts)
    found = measured(tmp_path, pages, 390, "f.contentDocument.documentElement.scrollWidth")
    widths = dict(zip((str(page.relative_to(manual)) for page in pages), found))
    assert len(widths) > 25 and {name: width for name, width in widths.items() if width > 390} == {}


@needs_browser
def test_the_code_of_styles_on_a_desk(manual: Path, tmp_path: Path) -> None:
    """The comments of headers are seen whole at 1280 px."""
    pages = sorted((manual / "generated").glob("*cdem*.html"))
    beyond = "Math.max(0, ...[...f.contentDocument.querySelectorAll('pre')].map(p => p.scrollWidth - p.clientWidth))"
    cut = dict(zip((page.stem for page in pages), measured(tmp_path, pages, 1280, beyond)))
    assert len(cut) > 15 and {name: px for name, px in cut.items() if px} == {}


def test_the_man_page(manual: Path) -> None:
    """It has the commands with their options, as man shows them."""
    page = (manual / "man" / "shearbox.1").read_text(encoding="utf-8")
    assert page.count(".SH") > 8 and page.startswith('.\\"')
    assert "usage: shearbox run" in page.replace("\\", "") and "--accuracy" in page.replace("\\", "")


@pytest.mark.parametrize("case", ["pour", "hopper", "pile", "biaxial", "simple_shear"])
def test_cases_have_their_deck_and_picture(manual: Path, case: str) -> None:
    page = (manual / "generated" / f"case_{case}.html").read_text(encoding="utf-8")
    assert f"{case}.png" in page and (manual / "_images" / f"{case}.png").stat().st_size > 1000
    assert "pair_coeff" in page and "SPDX" not in page.split("The deck")[0]
