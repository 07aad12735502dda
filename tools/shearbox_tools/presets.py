# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings of `shearbox run --accuracy`; their error and time are measured by tests/benchmarks/work_precision."""

REFERENCE = "reference"
SPEEDS = {REFERENCE: 2.0, "standard": 10.0, "fast": 200.0}  # mm/s; the reference is the paper's
