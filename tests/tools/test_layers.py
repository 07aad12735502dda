# SPDX-License-Identifier: GPL-2.0-or-later
"""The rooms of the engine's source, in the order of a step, and those of the tools: each knows itself and those before it, and no
two files need each other."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from rooms import ROOMS, TOOLS_ROOMS

SOURCE = Path(__file__).resolve().parents[2] / "src"
TOOLS = SOURCE.parent / "tools" / "shearbox_tools"

Graph = dict[str, set[str]]  # a file without its ending, and the files that it needs


def folder_of(room: str) -> Path:
    return SOURCE / room if room == "core" else SOURCE / "lammps" / room


def read_graph() -> Graph:
    graph: Graph = {}
    for room in ROOMS:
        for path in sorted(folder_of(room).rglob("*.[hc]*")):
            name = f"{room}/{path.relative_to(folder_of(room)).with_suffix('')}"
            included = re.findall(r'^#include "([^"]+)\.h"', path.read_text(encoding="utf-8"), re.MULTILINE)
            ours = {i if "/" in i else f"{room}/{i}" for i in included}
            graph.setdefault(name, set()).update(i for i in ours if i != name and file_of(i).exists())
    return graph


def file_of(name: str) -> Path:
    room, _, rest = name.partition("/")
    return folder_of(room) / f"{rest}.h"


def against_the_flow(graph: Graph, rooms: list[str]) -> list[str]:
    rank = {room: k for k, room in enumerate(rooms)}
    return [
        f"{name} needs {other}"
        for name, included in sorted(graph.items())
        for other in sorted(included)
        if rank[other.split("/")[0]] > rank[name.split("/")[0]]
    ]


def cycle(graph: Graph) -> list[str]:
    """Files of which each includes the next, and the last the first; empty if there are none."""
    done: set[str] = set()

    def search(name: str, path: list[str]) -> list[str]:
        if name in path:
            return [*path[path.index(name) :], name]
        if name in done:
            return []
        for other in sorted(graph.get(name, set())):
            if found := search(other, [*path, name]):
                return found
        done.add(name)
        return []

    return next((found for name in sorted(graph) if (found := search(name, []))), [])


def read_tools() -> Graph:
    """The modules of the tools, and those that they import, wherever in the file."""
    modules = {path: module_of(path) for path in sorted(TOOLS.rglob("*.py")) if path.parent != TOOLS}
    return {name: imported_by(path) & set(modules.values()) - {name} for path, name in modules.items()}


def module_of(path: Path) -> str:
    """room/name; of the __init__.py of a folder the folder."""
    return str(path.relative_to(TOOLS)).removesuffix(".py").removesuffix("/__init__")


def imported_by(path: Path) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            place = path.parents[node.level - 1].joinpath(*(node.module or "").split("."))
            found |= {module_of(place), *(module_of(place / alias.name) for alias in node.names)}
    return found


def test_all_rooms_are_known() -> None:
    folders = {path.name for path in (SOURCE / "lammps").iterdir()} | {"core"}
    assert folders == set(ROOMS)
    assert len(read_graph()) > 40


def test_no_room_looks_into_a_later_one() -> None:
    assert against_the_flow(read_graph(), ROOMS) == []


def test_no_cycle() -> None:
    assert cycle(read_graph()) == []


def test_tools_import_each_other_by_place() -> None:
    """As from ..base.words: what is imported by the name of the whole package is not seen above."""
    for path in sorted(TOOLS.rglob("*.py")):
        assert not re.search(r"^\s*(from|import) shearbox_tools", path.read_text(encoding="utf-8"), re.MULTILINE), path


def test_core_knows_no_engine() -> None:
    text = "".join(path.read_text(encoding="utf-8") for path in folder_of("core").rglob("*.[hc]*"))
    assert "LAMMPS_NS" not in text


@pytest.mark.parametrize("back", ["contacts/pair_cdem", "motion/guard"])
def test_a_back_include_is_found(back: str) -> None:
    graph = read_graph()
    graph["grains/grain_rows"].add(back)
    assert against_the_flow(graph, ROOMS) == [f"grains/grain_rows needs {back}"]


def test_a_cycle_is_found() -> None:
    graph = read_graph()
    graph["motion/guard"].add("motion/fix_cdem_integrate")
    assert cycle(graph)[0] == cycle(graph)[-1]


def test_interfaces_have_no_virtual_destructor() -> None:
    """In newer LAMMPS destructors may throw, and those of its classes' heirs then can't override one that may not. Where
    ours is protected, as nobody deletes a style by its interface, there is nothing to override."""
    for path in sorted((SOURCE / "lammps").rglob("*.h")):
        assert "virtual ~" not in path.read_text(encoding="utf-8"), path


def test_values_say_whether_they_are_extensive() -> None:
    """Newer LAMMPS ends the first run of a style that has a scalar, vector or array and does not say so."""
    for path in sorted((SOURCE / "lammps").rglob("*.cpp")):
        text = path.read_text(encoding="utf-8")
        for kind in re.findall(r"\b(scalar|vector|array)_flag =", text):
            assert re.search(rf"\bext{kind}\b", text), f"{path}: ext{kind}"


def test_all_rooms_of_the_tools_are_known() -> None:
    folders = {path.parent.name for path in TOOLS.glob("*/__init__.py")}
    assert folders == set(TOOLS_ROOMS)
    assert [path.name for path in TOOLS.glob("*.py")] == ["__init__.py"]
    assert len(read_tools()) > 80


def test_no_room_of_the_tools_looks_into_a_later_one() -> None:
    assert against_the_flow(read_tools(), TOOLS_ROOMS) == []


def test_no_cycle_in_the_tools() -> None:
    assert cycle(read_tools()) == []


def test_no_module_has_the_name_of_a_room() -> None:
    assert not {name.split("/")[-1] for name in read_tools() if "/" in name} & set(TOOLS_ROOMS)


@pytest.mark.parametrize("back", ["reports/page", "running/campaign"])
def test_a_back_import_is_found(back: str) -> None:
    graph = read_tools()
    assert back in graph
    graph["asking/models"].add(back)
    assert against_the_flow(graph, TOOLS_ROOMS) == [f"asking/models needs {back}"]


def test_no_test_of_the_tools_needs_another() -> None:
    """What several need is in files of its own (scenes.py, command.py ...): then each can be read, changed and run alone."""
    tests = SOURCE.parent / "tests"
    files = [*tests.glob("**/*.py"), *tests.glob("validation/*/run")]
    assert len(files) > 120
    found = [path for path in files if re.search(r"^\s*(from|import) test_", path.read_text("utf-8"), re.MULTILINE)]
    assert found == []
