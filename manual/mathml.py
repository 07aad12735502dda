# SPDX-License-Identifier: GPL-2.0-or-later
"""Formulas as MathML, which browsers render by themselves: pages need neither a network nor a program."""

import re

from typing import Any

from docutils import nodes
from docutils.core import publish_from_doctree
from docutils.utils import new_document


def add_to(app: Any) -> None:
    """As the math renderer `mathml` of HTML pages."""
    app.add_html_math_renderer("mathml", (_write, None), (_write, None))


def mathml(formula: str, block: bool) -> str:
    """An element <math>, made by docutils of LaTeX."""
    document = new_document("formula")
    document += nodes.math_block(formula, formula) if block else nodes.paragraph("", "", nodes.math(formula, formula))
    settings = {"math_output": "MathML", "output_encoding": "unicode"}
    page = publish_from_doctree(document, writer_name="html5", settings_overrides=settings)
    found = re.search("<math.*</math>", page, re.DOTALL)
    if not found:
        raise ValueError(f"no MathML comes of {formula}")
    return found[0]


def _write(writer: Any, node: nodes.Node) -> None:
    block = isinstance(node, nodes.math_block)
    formula = mathml(" ".join(node.astext().split()), block)
    writer.body.append(f'<div style="overflow: auto hidden">{formula}</div>' if block else formula)
    raise nodes.SkipNode
