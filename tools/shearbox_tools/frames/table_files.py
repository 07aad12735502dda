# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of a frame as CSV, as Parquet, and as files that OVITO reads."""

from pathlib import Path

import numpy as np

from ..base.files import drafted
from ..reading.readers import Columns
from .tables import Instant


def write_csv(path: Path, table: Columns) -> None:
    """A header and a row each; nine digits, as the dumps have."""
    with drafted(path) as draft:
        np.savetxt(draft, _rows(table), fmt="%.9g", delimiter=",", header=",".join(table), comments="")


def write_parquet(path: Path, table: Columns) -> None:
    """Columns that count are whole numbers, all others doubles."""
    import pandas

    whole = {name: np.int64 for name in ("id", "id1", "id2", "disc", "disc1", "disc2", "type") if name in table}
    with drafted(path) as draft:
        pandas.DataFrame(table).astype(whole).to_parquet(draft, index=False)


def write_ovito(path: Path, table: Columns, instant: Instant) -> None:
    """A dump of one frame in LAMMPS's format, in which every row is a particle with an id of its own.

    Grains and discs have the same id in all frames; discs keep that of their grain as `grain`. Contacts are particles at the
    contact point, numbered anew in each frame; OVITO takes fx and fy for the vector Force.
    """
    count = len(table["x"])
    columns = {"grain" if name == "id" else name: column for name, column in table.items()}
    columns = {"id": _ids(table), "type": np.ones(count)} | columns | {"z": np.zeros(count)}
    (x0, x1), (y0, y1) = ((table[a].min(initial=0), table[a].max(initial=0)) for a in "xy")
    head = (
        f"ITEM: TIMESTEP\n{instant.step}\nITEM: NUMBER OF ATOMS\n{count}\nITEM: BOX BOUNDS ff ff pp\n"
        f"{x0:.9g} {x1:.9g}\n{y0:.9g} {y1:.9g}\n-0.01 0.01\nITEM: ATOMS {' '.join(columns)}"
    )
    with drafted(path) as draft:
        np.savetxt(draft, _rows(columns), fmt="%.9g", header=head, comments="")


def _ids(table: Columns) -> np.ndarray:
    """A grain's own; its discs follow each other."""
    if "id" not in table:
        return np.arange(1, len(table["x"]) + 1)
    if "disc" not in table:
        return table["id"]
    return (table["id"] - 1) * (1 + table["disc"].max(initial=0)) + table["disc"] + 1


def _rows(table: Columns) -> np.ndarray:
    return np.column_stack(list(table.values()))
