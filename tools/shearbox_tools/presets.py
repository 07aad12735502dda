# SPDX-License-Identifier: GPL-2.0-or-later
"""What commands may be asked for beside the variables of the decks: laws, stresses, formats, and the settings of --accuracy.

Error and time of these settings are measured by tests/benchmarks/work_precision.
"""

LAWS = ("direct", "incremental")  # of pair style cdem

REFERENCE = "reference"
SPEEDS = {REFERENCE: 2.0, "standard": 10.0, "fast": 200.0}  # mm/s; the reference is the paper's
STRESSES = (1, 5000)  # kPa: normal stresses from and to

FORMATS = ("vtk", "ovito", "csv", "parquet")  # of shearbox export
