# SPDX-License-Identifier: GPL-2.0-or-later
"""What the styles keep in restart files has a version, a length, and names: a file of another version of Shearbox is
refused with a message, and never read as something else."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path

import pytest
from engine import Run, run, start
from scenes import mini_box

MARK = struct.pack("i", 0x53426F78)
SCENE = """
fix        form all cdem/shape type 1 triple type 2 single type 3 single type 4 single density 26.5
fix        move grains cdem/integrate
fix        lid lid cdem/lid stress 4e5 width 0.032 thickness 0.01 vmax 2
fix        floor floor cdem/move speed 1 ramp 2e-4
compute    trm grains cdem/trm
compute    energy grains cdem/energy audit yes
"""
WRITE = f"""
include    ${{decks}}/start.in
pair_coeff 1 1 1e8 2.5e7 0.215 0.215 27 rolling 0.1 0.2
group      lid type 3
group      floor type 4
{SCENE}
timestep   2e-7
run        2000
write_restart good.restart
"""
READ = f"""
newton     off
read_restart good.restart
comm_modify vel yes
{SCENE}
run        10
"""


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Run:
    discs, box = mini_box()
    return run(WRITE, tmp_path_factory.mktemp("written"), discs=discs, box=box)


def read(written: Run, folder: Path, change: Callable[[bytes], bytes]) -> tuple[int, str]:
    data = change((written.directory / "good.restart").read_bytes())
    (folder / "good.restart").write_bytes(data)
    return start(READ, folder)


def heads(data: bytes) -> list[int]:
    """Where the heads of the blocks are."""
    found, place = [], data.find(MARK)
    while place >= 0:
        found.append(place)
        place = data.find(MARK, place + 1)
    return found


def test_as_it_was_written_it_goes_on(written: Run, tmp_path: Path) -> None:
    status, output = read(written, tmp_path, lambda data: data)
    assert status == 0, output
    data = (written.directory / "good.restart").read_bytes()
    # pair style, and fixes: integrate, grains, lid, move, audit, history
    assert len(heads(data)) == 7


# The text of the pair style, block 0, is as long as its head says.
@pytest.mark.parametrize(
    ("which", "part"),
    [(w, p) for w in range(7) for p in ("mark", "version", "length") if (w, p) != (0, "length")],
)
def test_a_block_of_another_version_is_refused(written: Run, tmp_path: Path, which: int, part: str) -> None:
    def change(data: bytes) -> bytes:
        place = heads(data)[which] + 4 * ["mark", "version", "length"].index(part)
        [number] = struct.unpack_from("i", data, place)
        return data[:place] + struct.pack("i", number + 1) + data[place + 4 :]

    status, output = read(written, tmp_path, change)
    assert status != 0
    [error] = [line for line in output.splitlines() if line.startswith("ERROR")]
    assert "another version of Shearbox" in error
    assert "Fix cdem/" in error or "Pair style cdem" in error


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (b"rolling.mu_r", b"rolling.mu_x", "it has a parameter rolling.mu_x"),
        (b"law direct", b"law divert", "it has law divert"),
        (b"additions rolling", b"additions rowling", "it has an addition rowling"),
    ],
)
def test_what_this_version_does_not_know_is_named(
    written: Run, tmp_path: Path, old: bytes, new: bytes, message: str
) -> None:
    status, output = read(written, tmp_path, lambda data: data.replace(old, new, 1))
    assert status != 0
    assert message in output


def test_fewer_numbers_of_an_atom_are_refused(written: Run, tmp_path: Path) -> None:
    """The state of a grain is a length, an id and nine numbers: a file with eight of them must not be read one number off."""

    def change(data: bytes) -> bytes:
        length, shorter = struct.pack("d", 11), struct.pack("d", 10)
        place = data.find(length, data.find(b"CDEM_GRAINS"))
        assert place > 0
        return data[:place] + shorter + data[place + 8 :]

    status, output = read(written, tmp_path, change)
    assert status != 0
    assert "that this version of Shearbox knows: it was written by another version" in output
