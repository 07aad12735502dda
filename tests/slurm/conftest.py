# SPDX-License-Identifier: GPL-2.0-or-later
"""Make the start-up of Slurm importable."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
