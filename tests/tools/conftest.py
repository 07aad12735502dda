# SPDX-License-Identifier: GPL-2.0-or-later
"""Make the package under tools/ importable as `tools/shearbox` does."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
sys.path.insert(0, str(Path(__file__).resolve().parent))
