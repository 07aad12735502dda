# SPDX-License-Identifier: GPL-2.0-or-later
"""The decks of input/ as tests run them, and the tools that read what they write."""

from __future__ import annotations

import sys
from typing import Any

from engine import DECKS

ROOT = DECKS.parents[1]
INPUT = ROOT / "input"
sys.path.insert(0, str(ROOT / "tools"))

SPECIMEN: dict[str, Any] = {"decks": INPUT, "sigma": 100, "seed": 1}
SHEARING: dict[str, Any] = {"speed": 20, "travel": 1, "rows": 20, "frames": 2}
