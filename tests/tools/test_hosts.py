# SPDX-License-Identifier: GPL-2.0-or-later
"""What LIGGGHTS needs beside its program; whole tests with it are in tests/liggghts."""

from pathlib import Path

import pytest

from shearbox_tools.asking import hosts
from shearbox_tools.base.errors import InputError
from shearbox_tools.base.presets import LAMMPS, LIGGGHTS


def test_a_library_that_is_not_built_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hosts, "LIBRARY", tmp_path / "liggghts_cdem.so")
    with pytest.raises(InputError, match="there is no .*liggghts_cdem.so. tools/setup --liggghts"):
        hosts.check_host(LIGGGHTS)
    hosts.check_host(LAMMPS)


@pytest.mark.parametrize("name", ["a blank", "a:colon"])
def test_a_path_that_the_loader_would_split_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """It would load nothing, and LIGGGHTS would not know the law."""
    library = tmp_path / name / "liggghts_cdem.so"
    library.parent.mkdir()
    library.touch()
    monkeypatch.setattr(hosts, "LIBRARY", library)
    with pytest.raises(InputError, match="LD_PRELOAD takes no path with a blank or a colon"):
        hosts.check_host(LIGGGHTS)
