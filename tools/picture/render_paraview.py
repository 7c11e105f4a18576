"""Renders the last frame of a run with ParaView, spheres coloured by axial velocity: make render CASE=...

Usage: pvpython --force-offscreen-rendering render_paraview.py RUN_FOLDER PICTURE.png [TIME]
Also a check that ParaView reads the frames as they are meant: it fails when an array that tools/README.md promises is
missing. The view is that of picture.py: flow from left to right, y up.
"""

import sys
from pathlib import Path

from paraview.simple import (
    ColorBy,
    CreateView,
    GetAnimationScene,
    GetColorTransferFunction,
    GetScalarBar,
    Glyph,
    PVDReader,
    Render,
    SaveScreenshot,
    Show,
)

PROMISED = ("velocity", "angular_velocity", "radius", "contacts", "id")


def main(folder, picture, time=None):
    frames = PVDReader(FileName=str(Path(folder) / "frames.pvd"))
    frames.UpdatePipelineInformation()
    times = list(frames.TimestepValues)
    time = times[-1] if time is None else min(times, key=lambda t: abs(t - float(time)))
    frames.UpdatePipeline(time)
    names = [frames.PointData.GetArray(i).Name for i in range(frames.PointData.GetNumberOfArrays())]
    missing = [name for name in PROMISED if name not in names]
    if missing:
        raise SystemExit(f"{folder}: the frames lack {', '.join(missing)}; they have {', '.join(names)}")

    view = CreateView("RenderView")
    view.ViewSize = [1600, 400]
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    view.ViewTime = time
    GetAnimationScene().AnimationTime = time

    spheres = Glyph(Input=frames, GlyphType="Sphere")
    spheres.GlyphType.Radius = 1.0  # times the array `radius`
    spheres.GlyphType.ThetaResolution = spheres.GlyphType.PhiResolution = 24
    spheres.ScaleArray = ["POINTS", "radius"]
    spheres.ScaleFactor = 1.0
    spheres.GlyphMode = "All Points"
    shown = Show(spheres, view)
    ColorBy(shown, ("POINTS", "velocity", "Z"))
    shown.RescaleTransferFunctionToDataRange(False, True)
    bar = GetScalarBar(GetColorTransferFunction("velocity"), view)
    bar.Title, bar.ComponentTitle = "axial velocity, m/s", ""
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.Orientation, bar.WindowLocation = "Horizontal", "Lower Center"
    shown.SetScalarBarVisibility(view, True)
    Render(view)  # the first one places the camera itself

    bounds = spheres.GetDataInformation().GetBounds()
    middle = [(bounds[2 * k] + bounds[2 * k + 1]) / 2 for k in range(3)]
    view.CameraFocalPoint = middle
    view.CameraPosition = [middle[0] - 1.0, middle[1] + 0.25, middle[2]]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = max(0.5 * (bounds[5] - bounds[4]) * 400 / 1600, 0.5 * (bounds[3] - bounds[2])) * 1.25
    SaveScreenshot(str(picture), view, ImageResolution=[1600, 400])
    print(f"{picture}: {frames.GetDataInformation().GetNumberOfPoints()} particles at {time:g} s, arrays {', '.join(names)}")


main(*sys.argv[1:])
