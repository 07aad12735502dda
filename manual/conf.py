# SPDX-License-Identifier: GPL-2.0-or-later
"""Sphinx settings of the manual; `tools/manual` builds it."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tools")]

import mathml  # noqa: E402
from generate import linked, write_all  # noqa: E402
from sphinx.application import Sphinx  # noqa: E402

from shearbox_tools import __version__  # noqa: E402

project, release = "Shearbox", __version__
copyright = "the developers of Shearbox, GPL-2.0-or-later"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
autodoc_mock_imports = ["pandas"]  # the manual can be built without
nitpick_ignore_regex = [("py:.*", ".*")]  # types of other libraries have no pages here
source_suffix = {".md": "markdown"}
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
man_pages = [("generated/commands", "shearbox", "the 2D direct shear test of sand by DEM", "", 1)]
html_theme = "furo"
html_title = f"Shearbox {release}"
html_math_renderer = "mathml"
html_show_sphinx = False
html_static_path, html_css_files = ["static"], ["width.css"]
nitpicky = True
smartquotes = False  # words of decks stay as they are


def _link(_: Sphinx, page: str, source: list[str]) -> None:
    """Sphinx takes what it reads of a page from the first of the list."""
    if not page.startswith("generated/"):
        source[0] = linked(source[0])


def setup(app: Sphinx) -> None:
    """Math as MathML, and the pages that are made of the sources."""
    mathml.add_to(app)
    app.connect("builder-inited", lambda _: write_all(HERE / "generated"))
    app.connect("source-read", _link)
