# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the discs and walls of an export as the report does: all of them, in their sizes, coloured by rotation.

usage: pvpython paraview_specimen.py EXPORT [FRAME]

EXPORT is a folder that 'shearbox export --to vtk' has written, such as results/export/vtk/100; FRAME the number of its
frame, from 0 on (default: the last). Writes specimen.png
here, and specimen.pvsm, which ParaView opens with File > Load State.
"""
import sys
from pathlib import Path

import numpy as np
from paraview.simple import *  # noqa: F403  # as ParaView's own traces do


def draw(folder: Path, name: str):
    """Spheres of the size that `diameter` says. Unasked, ParaView leaves out points, and takes a radius for a diameter."""
    points = PVDReader(registrationName=name, FileName=str(folder / f"{name}.pvd"))
    spheres = Glyph(registrationName=f"spheres of {name}", Input=points, GlyphType="Sphere")
    spheres.GlyphMode = "All Points"
    spheres.OrientationArray = ["POINTS", "No orientation array"]
    spheres.ScaleArray = ["POINTS", "diameter"]
    spheres.ScaleFactor = 1
    spheres.GlyphType.Radius = 0.5
    spheres.GlyphType.ThetaResolution = spheres.GlyphType.PhiResolution = 48
    return points, spheres


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = Path(sys.argv[1]).resolve()
    discs, spheres = draw(folder, "discs")
    _, wall_spheres = draw(folder, "walls")
    times = discs.TimestepValues if hasattr(discs.TimestepValues, "__len__") else [discs.TimestepValues]
    view = CreateRenderView(ViewSize=[1200, 1200], Background=[1, 1, 1], UseColorPaletteForBackground=0)
    view.OrientationAxesVisibility = 0
    view.InteractionMode = "2D"
    view.ViewTime = times[int(sys.argv[2]) if len(sys.argv) == 3 else -1]
    shown = Show(spheres, view, Ambient=0.6, Diffuse=0.5)
    ColorBy(shown, ("POINTS", "rotation"))
    colours = GetColorTransferFunction("rotation")
    colours.ApplyPreset("Cool to Warm", True)
    spheres.UpdatePipeline(view.ViewTime)
    rotation = np.abs(servermanager.Fetch(discs).GetPointData().GetArray("rotation"))
    largest = np.quantile(rotation, 0.98)  # of the rest: a loose grain may spin by itself
    colours.RescaleTransferFunction(-largest, largest)
    shown.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = "rotation (rad)", ""
    bar.Orientation, bar.WindowLocation = "Horizontal", "Lower Center"
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    grey = Show(wall_spheres, view, Ambient=0.6, Diffuse=0.5)
    grey.ColorArrayName = ["POINTS", ""]
    grey.AmbientColor = grey.DiffuseColor = [0.79, 0.81, 0.83]
    ResetCamera(view)
    left, right, bottom, top = spheres.GetDataInformation().GetBounds()[:4]
    view.CameraFocalPoint = [(left + right) / 2, (bottom + top) / 2, 0]
    view.CameraPosition = [(left + right) / 2, (bottom + top) / 2, 1]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.7 * max(right - left, top - bottom)
    SaveScreenshot("specimen.png", view)
    SaveState("specimen.pvsm")
    print(f"{spheres.Input.GetDataInformation().GetNumberOfPoints()} discs")


main()
