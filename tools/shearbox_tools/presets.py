# SPDX-License-Identifier: GPL-2.0-or-later
"""What `shearbox run` may be asked for: the contact laws, and the settings of --accuracy.

Error and time of these settings are measured by tests/benchmarks/work_precision.
"""

LAWS = ("direct", "incremental")  # of pair style cdem

REFERENCE = "reference"
SPEEDS = {REFERENCE: 2.0, "standard": 10.0, "fast": 200.0}  # mm/s; the reference is the paper's
