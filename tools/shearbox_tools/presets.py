# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings of `shearbox run --accuracy`; their error and time are measured by tests/benchmarks/work_precision."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Preset:
    """Shear speed (mm/s), and the factor on the stiffness of all contacts, which sets the time step."""

    speed: float
    stiffness: float


REFERENCE = "reference"
PRESETS = {
    REFERENCE: Preset(speed=2.0, stiffness=1.0),  # the paper's
    "standard": Preset(speed=10.0, stiffness=1.0),
    "fast": Preset(speed=50.0, stiffness=0.1),
}


def describe_presets() -> str:
    """All presets in a line, for the help text."""
    return "; ".join(f"{name}: {p.speed:g} mm/s, stiffness {p.stiffness:g}" for name, p in PRESETS.items())
