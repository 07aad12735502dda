# SPDX-License-Identifier: GPL-2.0-or-later
"""`cpack -G DEB`: the package asks for what its files need. tests/fresh/run installs it and uses it."""

import ast
import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NEEDED = ("dpkg-shlibdeps", "file", "cpack")
pytestmark = pytest.mark.skipif(not all(map(shutil.which, NEEDED)), reason="needs Debian's dpkg-dev and file")


def said(*command: str | Path) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=300).stdout


def owner(file: str | Path) -> str:
    return said("dpkg-query", "--search", Path(file).resolve()).split(":")[0]


@pytest.fixture(scope="module", name="asked_for")
def _asked_for(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("package")
    said("cpack", "-G", "DEB", "--config", ROOT / "build" / "CPackConfig.cmake", "-B", folder)
    (deb,) = folder.glob("shearbox_*.deb")
    return said("dpkg-deb", "--field", deb, "Depends", "Recommends", "Suggests")


def test_the_lammps_that_it_was_built_against(asked_for: str) -> None:
    """And no other, since its C++ interface changes without a change of its name."""
    found = re.search(r"liblammps\S+ => (\S+)", said("ldd", ROOT / "build" / "lmp_cdem"))
    assert found
    package = owner(found[1])
    version = said("dpkg-query", "--show", "--showformat", "${Version}", package)
    assert f"{package} (= {version})" in asked_for


def test_modules(asked_for: str) -> None:
    """All that the tools import, wherever in a file, of what is installed here."""
    files = [*(ROOT / "tools" / "shearbox_tools").rglob("*.py"), ROOT / "tools" / "shearbox.py"]
    nodes = [node for file in files for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))]
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.module and not node.level}
    modules = {name.split(".")[0] for name in names} - sys.stdlib_module_names - {"shearbox", "shearbox_tools"}
    origins = [spec.origin for name in modules if (spec := importlib.util.find_spec(name)) and spec.origin]
    assert len(origins) >= 5
    assert {owner(origin) for origin in origins} <= set(re.findall(r"\bpython3-[\w-]+", asked_for))
