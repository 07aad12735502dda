# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages that are made of the sources, so that there is one text: styles of their headers, parameters and columns of the decks,
commands of the command line, cases of their READMEs."""

import argparse
import re
from pathlib import Path

from shearbox_tools.asking.models import INPUT
from shearbox_tools.asking.parameters import parameters
from shearbox_tools.asking.request import OWN_OPTION
from shearbox_tools.commands.cli import make_parser

ROOT = Path(__file__).resolve().parents[1]
_SPECIAL = re.compile(r"([\\`*_{}\[\]<>#$|~])")
WIDTH = 100  # of the texts of --help
OF_SOURCES = {  # pages by what links of the manual's Markdown name, which is read in the repository as well
    "../README.md#use": "styles",
    "../input/parameters.in": "parameters",
    "../input/shear.in": "columns",
    "../examples": "cases",
}
CASES = ("pour", "hopper", "pile", "biaxial", "simple_shear")  # of examples/, other tests than direct shear


class _Formatter(argparse.HelpFormatter):
    """The same lines on any terminal."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, width=WIDTH)


def write_all(folder: Path) -> None:
    """All of them, into the folder; files that would be the same are left, so that Sphinx does not read them again."""
    folder.mkdir(exist_ok=True)
    headers = style_headers()
    pages = {style_name(h): style_page(h) for h in headers}
    pages |= {f"case_{name}": case_page(name) for name in CASES}
    pages |= {
        "cases": cases_page(),
        "styles": styles_page(headers),
        "parameters": parameters_page(),
        "columns": columns_page(),
        "commands": commands_page(),
    }
    for name, text in pages.items():
        file = folder / f"{name}.md"
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")
    for file in folder.glob("*.md"):
        if file.stem not in pages:
            file.unlink()


def linked(text: str) -> str:
    """A page of the manual, whose links to sources lead to the pages that are made of them."""
    made = OF_SOURCES | {f"../{header.relative_to(ROOT)}": style_name(header) for header in style_headers()}
    return re.sub(
        r"\]\((\.\./[^)]+)\)", lambda link: f"](generated/{made[link[1]]})" if link[1] in made else link[0], text
    )


def style_headers() -> list[Path]:
    """Headers that README lists as styles, in its order."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    found = re.findall(r"\]\((src/(?:lammps|liggghts)/[\w/]+\.h)\)", readme)
    return [ROOT / name for name in dict.fromkeys(found) if _is_style(ROOT / name)]


def _is_style(header: Path) -> bool:
    return bool(re.match(r"(pair_style|fix ID|compute ID|dump ID|run_style|cdem/create)", "\n".join(comment(header))))


def comment(header: Path) -> list[str]:
    """Lines of the comment at the top, without the licence."""
    lines = []
    for line in header.read_text(encoding="utf-8").splitlines()[1:]:
        if not line.startswith("//"):
            break
        lines.append(line[2:].removeprefix(" ").rstrip())
    return lines


def style_name(header: Path) -> str:
    """Of its page: such as fix_cdem_lid, or liggghts_fix_cdem_lid."""
    host = "liggghts_" if "liggghts" in header.parts else ""
    return host + header.stem


def title(header: Path) -> str:
    """As a deck calls the style."""
    words = comment(header)[0].split()
    kind = words[0]
    if kind in ("fix", "compute", "dump"):
        name = f"{kind} {next(word for word in words if '/' in word)}"
    elif kind == "pair_style":
        name = "pair_style cdem" if "cdem" in words else "pair_style gran model"
    else:
        name = " ".join(words[:2]) if kind == "run_style" else kind
    return f"{name} (LIGGGHTS)" if "liggghts" in header.parts else name


def style_page(header: Path) -> str:
    """The comment: its first block is the syntax, blocks with indented lines are as they are, others are prose."""
    blocks = "\n".join(comment(header)).strip("\n").split("\n\n")
    parts = [f"# {title(header)}", _code(blocks[0])]
    parts += [_code(block) if _is_table(block) else _prose(block) for block in blocks[1:]]
    source = header.relative_to(ROOT)
    return "\n\n".join([*parts, f"Source: `{source}`"]) + "\n"


def styles_page(headers: list[Path]) -> str:
    """The list of them."""
    names = "\n".join(style_name(header) for header in headers)
    return (
        f"# Styles\n\nThe same texts as at the top of their headers.\n\n```{{toctree}}\n:maxdepth: 1\n\n{names}\n```\n"
    )


def case_page(name: str) -> str:
    """Its README, without the licence, and its deck."""
    folder = ROOT / "examples" / name
    text = (folder / "README.md").read_text(encoding="utf-8").split("\n", 1)[1]
    text = re.sub(r"\]\((\w+\.png)\)", rf"](../../examples/{name}/\1)", text)
    deck = (folder / f"{name}.in").read_text(encoding="utf-8").strip()
    return f"{text.strip()}\n\n## The deck\n\n{_code(deck)}\n"


def cases_page() -> str:
    """The list of them."""
    names = "\n".join(f"case_{name}" for name in CASES)
    return (
        "# Other tests\n\nShort decks of tests other than direct shear, each with a check. They are in `examples/` of the source.\n\n"
        f"```{{toctree}}\n:maxdepth: 1\n\n{names}\n```\n"
    )


def parameters_page() -> str:
    """A table of what --set can set."""
    rows = ["| name | value | may be | meaning |", "|---|---|---|---|"]
    for one in parameters().values():
        value = "of the model" if one.value is None else f"`{one.value}`"
        meaning = _plain(one.meaning.strip()) + f"; by `{OWN_OPTION.get(one.name)}`" * (one.name in OWN_OPTION)
        rows.append(f"| `{one.name}` | {value} | {_plain(one.allowed)} | {meaning} |")
    return "# Parameters\n\nVariables of the decks and of models, in SI units.\n\n" + "\n".join(rows) + "\n"


def columns_page() -> str:
    """What shear.in says that it writes: its comment up to the first variable."""
    lines = (INPUT / "shear.in").read_text(encoding="utf-8").split("\nvariable")[0].splitlines()[1:]
    text = "\n".join(line.removeprefix("#").removeprefix(" ") for line in lines).strip()
    return f"# Files and columns of the shear phase\n\nThe comment of `input/shear.in`.\n\n{_code(text)}\n"


def commands_page() -> str:
    """--help of all commands."""
    parser = make_parser()
    (commands,) = [a.choices for a in parser._actions if isinstance(a.choices, dict)]
    parts = ["# Commands"]
    for name, command in commands.items():
        command.formatter_class = _Formatter
        parts += [f"## shearbox {name}", _code(command.format_help().strip())]
    return "\n\n".join(parts) + "\n"


def _is_table(block: str) -> bool:
    return any(line.startswith("  ") for line in block.splitlines())


def _code(block: str) -> str:
    return f"```text\n{block}\n```"


def _prose(block: str) -> str:
    return _plain(" ".join(block.splitlines()))


def _plain(text: str) -> str:
    return _SPECIAL.sub(r"\\\1", text)
