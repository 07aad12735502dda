# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of a frame as VTK's XML files, for ParaView, VisIt, PyVista and others."""

import errno
import os
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkDataArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataSet, vtkFieldData, vtkPolyData, vtkRectilinearGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLRectilinearGridWriter, vtkXMLWriter

from ..base.files import drafted, write_text
from ..reading.readers import Columns
from .tables import Instant

VECTORS = {  # columns that are a vector together
    "velocity": ("vx", "vy"),
    "moved": ("moved_x", "moved_y"),
    "force": ("fx", "fy"),
    "normal": ("nx", "ny"),
    "branch": ("branch_x", "branch_y"),
    "mean_velocity": ("velocity_x", "velocity_y"),
}


def write_points(path: Path, table: Columns, instant: Instant) -> None:
    """A vertex for each row, and `diameter` where there is a radius: by it ParaView scales glyphs to the right size."""
    _write(vtkXMLPolyDataWriter(), _points(table), path, instant)


def write_grid(path: Path, table: Columns, instant: Instant) -> None:
    """The cells of a grid, whose centres are x and y of the table."""
    _write(vtkXMLRectilinearGridWriter(), _grid(table), path, instant)


def write_series(path: Path, files: list[str], instants: list[Instant]) -> None:
    """The files of a table with their times (s), or displacements (mm) where the times are not known."""
    sets = "".join(
        f'    <DataSet timestep="{i.displacement_mm if i.time_s is None else i.time_s:.9g}" file={quoteattr(file)}/>\n'
        for file, i in zip(files, instants)
    )
    head = (
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n  <Collection>\n'
    )
    write_text(path, f"{head}{sets}  </Collection>\n</VTKFile>\n")


def _write(writer: vtkXMLWriter, data: vtkDataSet, path: Path, instant: Instant) -> None:
    """Step, displacement and time are field data."""
    for key, value in vars(instant).items():
        if value is not None:
            _add(data.GetFieldData(), key, np.array([value]))
    with drafted(path) as draft:
        writer.SetFileName(str(draft))
        writer.SetInputData(data)
        if not writer.Write():
            raise OSError(errno.EIO, os.strerror(errno.EIO))


def _points(table: Columns) -> vtkPolyData:
    data = vtkPolyData()
    points = vtkPoints()
    points.SetData(_array(np.column_stack([table["x"], table["y"], np.zeros(len(table["x"]))])))
    data.SetPoints(points)
    data.SetVerts(_cells(np.arange(len(table["x"]))[:, None]))
    _add_columns(data.GetPointData(), table)
    if "radius" in table:
        _add(data.GetPointData(), "diameter", 2 * table["radius"])
    return data


def _grid(table: Columns) -> vtkRectilinearGrid:
    """Of equal cells from 0 on, along x first, whose centres the table has."""
    grid = vtkRectilinearGrid()
    x, y = (np.unique(table[axis]) for axis in "xy")
    grid.SetDimensions(len(x) + 1, len(y) + 1, 1)
    for centres, put in ((x, grid.SetXCoordinates), (y, grid.SetYCoordinates)):
        put(_array(np.linspace(0, centres[0] + centres[-1], len(centres) + 1)))
    grid.SetZCoordinates(_array(np.zeros(1)))
    _add_columns(grid.GetCellData(), table)
    return grid


def _add_columns(data: vtkFieldData, table: Columns) -> None:
    vectors = {name: pair for name, pair in VECTORS.items() if set(pair) <= set(table)}
    for name, pair in vectors.items():
        x, y = (table[part] for part in pair)
        _add(data, name, np.column_stack([x, y, np.zeros(len(x))]))
    taken = {"x", "y", "z", *(part for pair in vectors.values() for part in pair)}
    for name, column in table.items():
        if name not in taken:
            _add(data, name, column)


def _add(data: vtkFieldData, name: str, values: np.ndarray) -> None:
    array = _array(values)
    array.SetName(name)
    data.AddArray(array)


def _array(values: np.ndarray) -> vtkDataArray:
    return numpy_to_vtk(np.ascontiguousarray(values), deep=True)


def _cells(rows: np.ndarray) -> vtkCellArray:
    """(cells, points of each) numbers of points."""
    cells = vtkCellArray()
    numbered = np.column_stack([np.full(len(rows), rows.shape[1]), rows]).ravel().astype(np.int64)
    cells.SetCells(len(rows), numpy_to_vtkIdTypeArray(numbered, deep=True))
    return cells
