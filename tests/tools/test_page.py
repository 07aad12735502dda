# SPDX-License-Identifier: GPL-2.0-or-later
"""The report in a browser: on a phone, a tablet, a desk, and on paper, nothing is cut off and nothing overlaps."""

import html
import re
import subprocess
from collections import Counter
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest
import synthetic
from browser import chromium, needs_browser, told
from ensembles import REQUEST, specimens, write_run

from shearbox_tools.analysis.ensemble_results import Ensemble
from shearbox_tools.analysis.grouping import LeftOut
from shearbox_tools.analysis.results import read_results
from shearbox_tools.asking.models import find_model
from shearbox_tools.asking.request import Request
from shearbox_tools.reports.comparing import Member, write_comparison
from shearbox_tools.reports.report_on import report_on
from shearbox_tools.reports.run_report import report

pytestmark = needs_browser

LAYOUT = Path(__file__).with_name("layout.js")
STRESSES = (100.0, 200.0, 300.0, 400.0)
WIDTHS = (390, 900, 1400)  # px
A4 = (595.3, 841.9)  # points
TITLE_HEIGHT = 18.6  # of a box of letters of 16 points

SHEET = re.compile(r'<page width="(.*?)" height="(.*?)">')
WORD = re.compile(r'<word .*? yMin="(.*?)" .*? yMax="(.*?)">(.*?)</word>')


@pytest.fixture(name="page", scope="module")
def _page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report of four stresses with all columns that it knows, and pictures of one of them."""
    folder = tmp_path_factory.mktemp("run")
    synthetic.write_record(folder, Request(find_model("TypeA_10x5_4-8_1-circle_350"), STRESSES))
    (folder / "packed").mkdir()
    synthetic.write_row(folder / "packed" / "packed.csv", **synthetic.bed())
    for sigma in STRESSES:
        place = folder / f"{sigma:g}"
        place.mkdir()
        synthetic.write_row(place / "consolidated.csv", **synthetic.bed())
        curves = synthetic.curves(sigma, 8)
        curves["plane_kPa"] = sigma + 0.3 * curves["tau_kPa"]
        curves["plane_tau_kPa"] = 0.9 * curves["tau_kPa"]
        synthetic.write_shear(place / "shear.dat", curves)
    synthetic.write_frames(folder / "100", [0, 2000000, 4000000], 8)
    return report(folder)


@pytest.fixture(name="ensemble", scope="module")
def _ensemble(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report on two specimens of four stresses."""
    folder = tmp_path_factory.mktemp("ensemble")
    for seed, factor in ((1, 0.9), (2, 1.2)):
        write_run(folder / f"seed_{seed}", replace(REQUEST, stresses=STRESSES, seed=seed), factor)
    return report_on(folder)


@pytest.fixture(name="comparison", scope="module")
def _comparison(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of three ensembles, the last of one specimen."""
    folder = tmp_path_factory.mktemp("comparison")
    base = read_results(write_run(folder / "run", replace(REQUEST, stresses=STRESSES[:2])))
    every = [specimens(base, [1, 2, 3]), specimens(base, [1, 2, 3], 0.1), specimens(base, [4], 0.2)]
    members = [Member(folder / name, Ensemble(runs)) for name, runs in zip(("dense", "fast", "loose"), every)]
    return write_comparison(members, [LeftOut(folder / "stopped", "sheared to 4.00 mm only")], folder)[0]


def faults(pages: list[tuple[str, int]], folder: Path) -> list[list[str]]:
    """What layout.js finds wrong with each of the pages, shown in a frame of so many px."""
    frames = "".join(
        f'<iframe style="width: {width}px; height: 800px; border: 0" srcdoc="{html.escape(page)}"></iframe>'
        for page, width in pages
    )
    look = "[...document.querySelectorAll('iframe')].map(f => faults(f.contentDocument))"
    tell = f"onload = () => {{ const found = JSON.stringify({look}); document.body.textContent = found; }}"
    harness = folder / "harness.html"
    script = LAYOUT.read_text(encoding="utf-8")
    harness.write_text(
        f'<!DOCTYPE html><meta charset="utf-8"><body>{frames}<script>{script}\n{tell}</script>', encoding="utf-8"
    )
    found: list[list[str]] = told(folder, harness)
    return found


def test_on_screens(page: Path, ensemble: Path, comparison: Path, tmp_path: Path) -> None:
    shown = [(path, width) for path in (page, ensemble, comparison) for width in WIDTHS]
    found = faults([(path.read_text(encoding="utf-8"), width) for path, width in shown], tmp_path)
    assert dict(zip(shown, found)) == {each: [] for each in shown}


def test_diagrams_stand_in_columns(page: Path, tmp_path: Path) -> None:
    """One on a phone, two on a tablet of 800 px, three on a desk."""
    text = page.read_text(encoding="utf-8")
    tell = "getComputedStyle(document.querySelector('.figures')).gridTemplateColumns.split(' ').length"
    probe = tmp_path / "probe.html"
    probe.write_text(
        text.replace("</body>", f"<script>document.body.textContent = {tell}</script></body>"), encoding="utf-8"
    )
    columns = {width: told(tmp_path, probe, f"--window-size={width},900") for width in (500, 800, 1400)}
    assert columns == {500: 1, 800: 2, 1400: 3}


BROKEN = {
    "beyond the page: <p": '<p style="width: 500px">too wide</p>',
    "cut off: <p": '<p style="width: 90px; overflow: hidden; white-space: nowrap">longer than its paragraph is</p>',
    "cut off: <div": '<div style="height: 9px; overflow: hidden">lower than a line</div>',
    "text on text: 'one' and 'other'": '<p style="margin: 0">one</p><p style="margin: -18px 0">other</p>',
    "no picture: nothing": '<img alt="nothing" src="data:image/png;base64,AAAA">',
}


def test_faults_are_found(tmp_path: Path) -> None:
    """Each by itself: it, and no other, is named."""
    start = '<!DOCTYPE html><meta charset="utf-8"><body style="margin: 0; font: 15px/20px sans-serif">'
    found = faults([(start + text, 390) for text in BROKEN.values()], tmp_path)
    for wanted, names in zip(BROKEN, found):
        assert [name[: len(wanted)] for name in names] == [wanted]


class Body(HTMLParser):
    """What is written in the body of a page that is for paper, too: not in sections of class screen."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.text = ""
        self._inside: list[bool] = []  # of the open sections: whether they are for screens alone
        self.feed(page.split("<body>")[1])

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "section":
            self._inside.append(("class", "screen") in attrs)

    def handle_endtag(self, tag: str) -> None:
        if tag == "section":
            self._inside.pop()

    def handle_data(self, data: str) -> None:
        if not any(self._inside):
            self.text += data


def letters(text: str) -> Counter[str]:
    return Counter("".join(text.split()))


def faults_on_paper(page: Path, folder: Path) -> list[str]:
    """What is wrong with the page on A4: letters that are gone, as those beyond the margins are; pictures cut in two;
    and all of it made smaller, which is what chromium does where something is too wide."""
    paper = folder / "page.pdf"
    chromium(folder, f"--print-to-pdf={paper}", "--no-pdf-header-footer", page.as_uri())
    text = output("pdftotext", "-bbox", paper, "-")
    words = WORD.findall(text)
    lost = letters(Body(page.read_text(encoding="utf-8")).text) - letters(html.unescape("".join(w for *_, w in words)))
    pictures = Counter(row.split()[10] for row in output("pdfimages", "-list", paper).splitlines()[2:])
    top, bottom, _ = words[0]
    return [
        *(f"{count} of {letter!r} are gone" for letter, count in lost.items()),
        *(f"cut in two: picture {number}" for number, count in pictures.items() if count > 1),
        *(["made smaller"] if float(bottom) - float(top) < 0.97 * TITLE_HEIGHT else []),
        *(f"page of {size}" for size in SHEET.findall(text) if tuple(map(float, size)) != pytest.approx(A4, abs=1)),
    ]


def output(*command: str | Path) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def test_on_paper(page: Path, ensemble: Path, comparison: Path, tmp_path: Path) -> None:
    for path in (page, ensemble, comparison):
        assert faults_on_paper(path, tmp_path) == [], path


PAPER = (
    "<!DOCTYPE html><style>@page { size: A4; margin: 14mm 13mm } body { margin: 0 } h1 { font-size: 16pt }</style>"
    "<body><h1>Title</h1>"
)
DOT = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAFklEQVR4nGP8z8DAwMDAxMDAwMDAAAANHQEDasKb6QAAAABJRU5ErkJggg=="


WIDE = '<p style="width: 300mm">wide</p>'
NARROW = '<p style="width: 9mm; overflow: hidden; white-space: nowrap">no longer just here</p>'
OUTSIDE = '<p style="margin-left: -9mm">quit</p>'
TALL = f'<img style="width: 10mm; height: 400mm" src="{DOT}">'


@pytest.mark.parametrize(
    "body, wanted",
    [(WIDE, ["made smaller"]), (NARROW + OUTSIDE + TALL, ["1 of 'j' are gone", "1 of 'q' are gone", "cut in two"])],
    ids=["wide", "cut"],
)
def test_faults_on_paper_are_found(tmp_path: Path, body: str, wanted: list[str]) -> None:
    page = tmp_path / "broken.html"
    page.write_text(PAPER + body, encoding="utf-8")
    found = faults_on_paper(page, tmp_path)
    assert [one for one in wanted if not any(name.startswith(one) for name in found)] == [], found
