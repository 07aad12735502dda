# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the discs and walls of an export as the report does: in their sizes, coloured by rotation.

usage: python3 ovito_specimen.py EXPORT [FRAME]

EXPORT is a folder that 'shearbox export --to ovito' has written, such as results/export/ovito/100; FRAME the number of its
frame, from 0 on (default: the last). Writes specimen.png here. Needs OVITO's module (pip install ovito).
"""

import sys
from pathlib import Path

import numpy as np
from ovito.io import import_file
from ovito.modifiers import AssignColorModifier, ColorCodingModifier
from ovito.vis import TachyonRenderer, Viewport


def shown(folder: Path, name: str, colours):
    """The particles of a table, which have their radius, with a modifier that colours them; the frame has no box."""
    pipeline = import_file(str(folder / f"{name}_*.dump"))
    pipeline.modifiers.append(colours)
    pipeline.compute().cell.vis.enabled = False
    pipeline.add_to_scene()
    return pipeline


def main() -> None:
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    discs = shown(
        folder, "discs", ColorCodingModifier(property="rotation", gradient=ColorCodingModifier.BlueWhiteRed())
    )
    shown(folder, "walls", AssignColorModifier(color=(0.79, 0.81, 0.83)))
    frame = int(sys.argv[2]) if len(sys.argv) == 3 else discs.source.num_frames - 1
    particles = discs.compute(frame).particles
    largest = np.quantile(np.abs(particles["rotation"]), 0.98)  # of the rest: a loose grain may spin by itself
    discs.modifiers[0].start_value, discs.modifiers[0].end_value = -largest, largest
    low, high = (f(particles.positions, axis=0) for f in (np.min, np.max))
    view = Viewport(type=Viewport.Type.Top, camera_pos=tuple((low + high) / 2), fov=0.6 * np.max(high - low))
    view.render_image(filename="specimen.png", size=(1200, 1200), frame=frame, renderer=TachyonRenderer())
    print(f"{particles.count} discs")


main()
