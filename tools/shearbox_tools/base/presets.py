# SPDX-License-Identifier: GPL-2.0-or-later
"""What commands may be asked for beside the variables of the decks: names, laws, stresses, formats, and the settings of
--accuracy and --density.

Error and time of --accuracy are measured by tests/benchmarks/work_precision, what --density makes by tests/validation/packing.
"""

HOSTS = LAMMPS, LIGGGHTS = "lammps", "liggghts"
LAWS = ("direct", "incremental")  # of pair style cdem

REFERENCE = "reference"
SPEEDS = {REFERENCE: 2.0, "standard": 10.0, "fast": 200.0}  # mm/s; the reference is the paper's
STRESSES = (1, 5000)  # kPa: normal stresses from and to

FORMATS = ("vtk", "ovito", "csv", "parquet")  # of shearbox export
FILMS = ("mp4", "webm", "gif")  # formats of shearbox film
COLOURINGS = ("rotation", "speed", "stress", "chains")  # what its films show
PACKING_FRICTION = "phi_packing"  # the variable that --density chooses
DENSITIES = {"dense": 0.0, "medium": 10.0, "loose": 45.0}  # degrees

# Names of which models are made, by named.py
FORM = (
    "TypeX_WIDTHxHALF-HEIGHT_SIZES_DISCS-circle_COUNT, such as TypeD_120x40_2-4_1-circle_144000: X from A to D; inner width "
    "of the box and height of one half in cm; SIZES of discs in mm, least-greatest, or T-2 where all have 2 mm; DISCS of a "
    "grain, 1 or 3; COUNT of grains, or auto for as many as fill the box"
)
