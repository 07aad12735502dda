# SPDX-License-Identifier: GPL-2.0-or-later
"""`shearbox export`: the readers of the formats find what is in the dumps."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic

from shearbox_tools.commands.cli import main
from shearbox_tools.frames.table_files import write_ovito
from shearbox_tools.frames.tables import Instant
from shearbox_tools.reading.dumps import CONTACTS, DISCS, GRAINS, Dump

STEPS = [0, 2000000, 4000000]
DT = 1e-6


@pytest.fixture(name="folder", scope="module")
def _folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two tests; the first knows times."""
    folder = tmp_path_factory.mktemp("run")
    for sigma in (100, 200):
        place = folder / f"{sigma}"
        place.mkdir()
        curves = synthetic.curves(sigma, 8)
        times = {"time_s": DT * curves["step"]} if sigma == 100 else {}
        synthetic.write_shear(place / "shear.dat", curves | times)
        synthetic.write_frames(place, STEPS, 8)
    return folder


def exported(folder: Path, out: Path, *words: str) -> Path:
    assert main(["export", str(folder), "--out", str(out), *words]) == 0
    return out


def whole(folder: Path, name: str, columns: tuple[str, ...], step: int) -> dict[str, np.ndarray]:
    return Dump(folder / "100" / f"{name}.dump", columns).frame(step)


def table(path: Path) -> dict[str, np.ndarray]:
    names = path.read_text(encoding="utf-8").split("\n", 1)[0].split(",")
    return dict(zip(names, np.loadtxt(path, delimiter=",", skiprows=1).T))


def test_csv(folder: Path, tmp_path: Path) -> None:
    """Values of the dumps; walls apart; what a hexagonal packing that shears homogeneously has moved."""
    place = exported(folder, tmp_path, "--to", "csv") / "csv" / "100"
    grains, discs, walls, contacts = (table(place / f"{n}_00002.csv") for n in ("grains", "discs", "walls", "contacts"))
    dumped = whole(folder, "grains", GRAINS, STEPS[2])
    first = whole(folder, "grains", GRAINS, 0)
    inside = dumped["wall"] == 0
    for name in ("id", "x", "y", "radius", "angle"):
        assert np.array_equal(grains[name], dumped[name][inside]), name
    assert np.array_equal(
        grains["rotation"], np.array([float(f"{v:.9g}") for v in (dumped["angle"] - first["angle"])[inside]])
    )
    np.testing.assert_allclose(grains["moved_x"], (dumped["x"] - first["x"])[inside], rtol=1e-8, atol=1e-15)
    assert len(discs["id"]) == inside.sum() and len(walls["id"]) == (~inside).sum()
    # all contacts are of two discs: from centre to centre, along the normal
    np.testing.assert_allclose(contacts["branch_x"] * contacts["ny"], contacts["branch_y"] * contacts["nx"], atol=1e-7)
    assert (contacts["branch_x"] * contacts["nx"] + contacts["branch_y"] * contacts["ny"] > 0).all()


def test_the_series(folder: Path, tmp_path: Path) -> None:
    place = exported(folder, tmp_path, "--to", "csv", "--frames", "::2") / "csv"
    times = table(place / "100" / "frames.csv")
    assert list(times["frame"]) == [0, 2] and list(times["step"]) == [0, 4000000]
    np.testing.assert_allclose(times["time_s"], [0, 4000000 * DT])
    np.testing.assert_allclose(times["displacement_mm"], [0, 8], atol=1e-6)
    assert sorted(path.name for path in place.glob("100/grains*")) == ["grains_00000.csv", "grains_00002.csv"]
    assert (place / "200" / "frames.csv").read_text(encoding="utf-8").splitlines()[2].endswith(",")


def read_vtk(path: Path) -> Any:
    io, numpy_support = pytest.importorskip("vtkmodules.vtkIOXML"), pytest.importorskip("vtkmodules.util.numpy_support")
    reader = io.vtkXMLPolyDataReader() if path.suffix == ".vtp" else io.vtkXMLRectilinearGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput(), numpy_support.vtk_to_numpy


def test_vtk(folder: Path, tmp_path: Path) -> None:
    """Places, diameters, vectors, counts, and step and time beside them."""
    place = exported(folder, tmp_path, "--to", "vtk", "--stress", "100") / "vtk" / "100"
    discs, array = read_vtk(place / "discs_00001.vtp")
    dumped = whole(folder, "discs", DISCS, STEPS[1])
    inside = ~np.isin(
        dumped["id"], whole(folder, "grains", GRAINS, 0)["id"][whole(folder, "grains", GRAINS, 0)["wall"] == 1]
    )
    assert discs.GetNumberOfVerts() == inside.sum()
    places = array(discs.GetPoints().GetData())
    assert np.array_equal(places, np.transpose([dumped["x"], dumped["y"], 0 * dumped["x"]])[inside])
    assert np.array_equal(array(discs.GetPointData().GetArray("diameter")), 2 * dumped["radius"][inside])
    assert array(discs.GetFieldData().GetArray("time_s")) == pytest.approx([STEPS[1] * DT])
    contacts, _ = read_vtk(place / "contacts_00001.vtp")
    dumped = Dump(folder / "100" / "contacts.dump", (*CONTACTS, "fx", "fy")).frame(STEPS[1])
    force = array(contacts.GetPointData().GetArray("force"))
    assert np.array_equal(force, np.transpose([dumped["fx"], dumped["fy"], 0 * dumped["fx"]]))
    cells, _ = read_vtk(place / "cells_00001.vtr")
    assert cells.GetBounds() == pytest.approx((0, 0.1, 0, 0.1, 0, 0))
    assert array(cells.GetCellData().GetArray("stress_yy")) == pytest.approx(np.full(100, 1000))


def test_the_series_of_vtk_names_all_files_and_their_times(folder: Path, tmp_path: Path) -> None:
    place = exported(folder, tmp_path, "--to", "vtk") / "vtk" / "100"
    found = re.findall(r'timestep="(.*?)" file="(.*?)"', (place / "discs.pvd").read_text(encoding="utf-8"))
    assert [float(time) for time, _ in found] == pytest.approx([step * DT for step in STEPS])
    assert all((place / file).exists() for _, file in found)
    assert {path.name for path in place.glob("*.pvd")} == {
        f"{n}.pvd" for n in ("grains", "discs", "walls", "contacts", "cells")
    }


@pytest.mark.skipif(not shutil.which("pvpython"), reason="no pvpython: Debian's python3-paraview is not installed")
def test_paraview(folder: Path, tmp_path: Path) -> None:
    """The series with its times, and every disc."""
    place = exported(folder, tmp_path, "--to", "vtk", "--stress", "100") / "vtk" / "100"
    script = tmp_path / "look.py"
    script.write_text(
        f"from paraview.simple import *\nread = PVDReader(FileName={str(place / 'discs.pvd')!r})\nread.UpdatePipeline()\n"
        "print(list(read.TimestepValues), read.GetDataInformation().GetNumberOfPoints(), file=open('seen', 'w'))\n"
    )
    subprocess.run(["pvpython", script], check=True, cwd=tmp_path, env=os.environ | {"QT_QPA_PLATFORM": "offscreen"})
    assert (tmp_path / "seen").read_text().strip() == f"{[step * DT for step in STEPS]} {synthetic.GRAINS}"


def test_parquet(folder: Path, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("pyarrow", reason="pyarrow is not in Debian 12: pip install 'pyarrow<18'")
    place = exported(folder, tmp_path, "--to", "parquet", "--stress", "100", "--frames", "1") / "parquet" / "100"
    dumped = whole(folder, "contacts", CONTACTS, STEPS[1])
    frame = pandas.read_parquet(place / "contacts_00001.parquet")
    assert all((frame[name] == dumped[name]).all() for name in CONTACTS)
    assert frame["id1"].dtype == "int64"


def test_a_disc_keeps_its_id_whatever_the_order_of_rows_in_its_frame(folder: Path, tmp_path: Path) -> None:
    """LAMMPS sorts atoms from time to time; what a disc has moved, by its id, is what a homogeneous shear moves it."""
    place = tmp_path / "run" / "100"
    shutil.copytree(folder / "100", place)
    head, *frames = (place / "discs.dump").read_text().split("ITEM: TIMESTEP\n")
    *lines, columns = frames[2].partition("ITEM: ATOMS")
    names, *rows = columns.rstrip().split("\n")
    frames[2] = "".join([*lines, names, "\n", "\n".join(rows[::-1]), "\n"])
    (place / "discs.dump").write_text("ITEM: TIMESTEP\n".join([head, *frames]))
    for form in ("ovito", "csv"):
        exported(tmp_path / "run", tmp_path, "--to", form, "--frames", "::2")
    dumps = [tmp_path / "ovito" / "100" / f"discs_0000{k}.dump" for k in (0, 2)]
    first, last = (Dump(path, ("id", "grain", "x", "y")).frame(step) for path, step in zip(dumps, (0, STEPS[2])))
    _, before, after = np.intersect1d(first["id"], last["id"], return_indices=True)
    assert np.array_equal(first["grain"][before], last["grain"][after])
    shear = 0.008 * (0.5 - first["y"] / 0.1) + 0.004
    np.testing.assert_allclose(last["x"][after] - first["x"][before], shear[before], atol=1e-8)
    one, other = (table(tmp_path / "csv" / "100" / f"discs_0000{k}.csv")["id"] for k in (0, 2))
    assert np.array_equal(one, other)


def test_discs_of_a_grain_have_ids_of_their_own(tmp_path: Path) -> None:
    """Of three discs each, the second grain lost: those of the third do not change."""
    grains, discs = np.repeat([1.0, 3.0], 3), np.tile([0.0, 1.0, 2.0], 2)
    write_ovito(tmp_path / "a", {"id": grains, "disc": discs, "x": discs, "y": grains}, Instant(0, 0.0, None))
    assert list(Dump(tmp_path / "a", ("id",)).frame(0)["id"]) == [1, 2, 3, 7, 8, 9]


def test_frames_of_an_earlier_export_do_not_stay_among_those_chosen_now(folder: Path, tmp_path: Path) -> None:
    place = exported(folder, tmp_path, "--to", "csv", "--stress", "100") / "csv" / "100"
    (place / "notes.csv").write_text("a user's own\n")
    exported(folder, tmp_path, "--to", "csv", "--stress", "100", "--frames", "1")
    named = {f"{name}_00001.csv" for name in ("grains", "discs", "walls", "contacts", "cells")}
    assert {path.name for path in place.iterdir()} == {"frames.csv", "notes.csv", *named}


@pytest.mark.filterwarnings("ignore")
def test_ovito(folder: Path, tmp_path: Path) -> None:
    """A particle for each disc, with an id of its own, which ASE reads."""
    place = exported(folder, tmp_path, "--to", "ovito", "--stress", "100", "--frames", "-1") / "ovito" / "100"
    path = place / "discs_00002.dump"
    seen = Dump(path, ("id", "grain", "x", "y", "radius")).frame(STEPS[2])
    assert list(seen["id"]) == list(range(1, len(seen["x"]) + 1))
    io = pytest.importorskip("ase.io")
    atoms = io.read(path, format="lammps-dump-text")
    assert np.array_equal(atoms.positions, np.transpose([seen["x"], seen["y"], 0 * seen["x"]]))


def test_ovito_itself(folder: Path, tmp_path: Path) -> None:
    """Sizes, in single precision, and forces as vectors."""
    ovito = pytest.importorskip("ovito.io", reason="OVITO's module is not in Debian: pip install ovito")
    place = exported(folder, tmp_path, "--to", "ovito", "--stress", "100", "--frames", "-1") / "ovito" / "100"
    discs = Dump(place / "discs_00002.dump", ("x", "y", "radius")).frame(STEPS[2])
    particles = ovito.import_file(str(place / "discs_00002.dump")).compute().particles
    assert np.array_equal(particles["Radius"], discs["radius"].astype(np.float32))
    assert np.array_equal(particles.positions[:, :2], np.transpose([discs["x"], discs["y"]]))
    forces = ovito.import_file(str(place / "contacts_00002.dump")).compute().particles["Force"]
    dumped = Dump(folder / "100" / "contacts.dump", ("fx", "fy")).frame(STEPS[2])
    assert np.array_equal(forces[:, :2], np.transpose([dumped["fx"], dumped["fy"]]))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--to", "csv", "--stress", "300"], "--stress 300: the folders of tests in .* are 100 200"),
        (["--to", "csv", "--frames", "3"], "--frames 3: a number, or FROM:TO:EVERY, of 0 to 2 is expected"),
        (["--to", "csv", "--frames", "a:b"], "--frames a:b"),
        (["--to", "csv", "--frames", "2:1"], "--frames 2:1"),
        (["--to", "csv", "--frames", "::0"], "--frames ::0"),
    ],
)
def test_nonsense_is_refused_before_anything_is_written(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str], message: str
) -> None:
    assert main(["export", str(folder), "--out", str(tmp_path / "out"), *words]) == 2
    assert re.search(message, capsys.readouterr().err)
    assert not (tmp_path / "out").exists()


def test_a_missing_library_is_named(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    modules: dict[str, Any] = sys.modules
    monkeypatch.setitem(modules, "vtkmodules", None)
    assert main(["export", str(folder), "--to", "vtk", "--out", str(tmp_path / "out")]) == 2
    [said] = capsys.readouterr().err.splitlines()
    assert said.startswith("shearbox: --to vtk: ") and said.endswith("; apt-get install python3-vtk9")
    assert not (tmp_path / "out").exists()


def test_missing_dumps_are_named(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "100").mkdir()
    (tmp_path / "100" / "shear.dat").write_text((folder / "100" / "shear.dat").read_text(encoding="utf-8"))
    assert main(["export", str(tmp_path), "--to", "csv"]) == 1
    assert "there is no grains.dump, discs.dump, contacts.dump, so there are no frames" in capsys.readouterr().err
