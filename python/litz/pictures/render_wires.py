"""Draws the meshes of pictures with VTK, as a program of its own.

`litz.pictures.drawing_process` starts it by `python render_wires.py`. A line that it reads then names a folder, of whose
job_0.npz it makes drawn_0.npz, and so on: where no OpenGL is installed, VTK ends the whole process, which must not be the
user's.
"""

import gc
import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np

# gives windows and mappers what draws them
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

REFERENCE_COLOUR = (154, 154, 154)
# Each pixel of a picture of at most so many pixels is the mean of 2 x 2 that are drawn
_MAX_FINE = 2_500_000
_LINE_WIDTH = 1.5


def main() -> None:
    """Start OpenGL, read the jobs, draw, write the pictures."""
    window = off_screen_window()
    window.Render()
    folder = sys.stdin.readline().rstrip("\n")
    if not folder:
        return
    for job in sorted(Path(folder).glob("job_*.npz"), key=lambda path: int(path.stem.split("_")[1])):
        picture, n_grey = draw(window, np.load(job))
        _SHARED.clear()
        part = job.with_name("part.npz")
        np.savez(part, picture=picture, n_grey=n_grey)
        # whoever looks for it finds the whole file
        part.replace(job.with_name(job.name.replace("job", "drawn")))
    # someone waits for the end of this process: what is left needs no search for garbage
    gc.freeze()


def off_screen_window() -> vtkRenderWindow:
    """A window for all pictures: each new one would start OpenGL anew."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    # the picture is made of finer pixels anyway
    window.SetMultiSamples(0)
    return window


def draw(window: vtkRenderWindow, job: Mapping[str, np.ndarray]) -> tuple[np.ndarray, int]:
    """The picture of a job, (height, width, 3) of bytes, and how many of its pixels show the undeformed axes."""
    size = job["size"].astype(int)
    samples = 2 if size.prod() <= _MAX_FINE else 1
    renderer = vtkRenderer()
    window.SetSize(*(samples * size).tolist())
    window.AddRenderer(renderer)
    renderer.SetBackground(1.0, 1.0, 1.0)
    add_lights(renderer, job)
    tubes = mesh(job["points"], job["triangles"], colours=job["colours"], normals=job["normals"])
    add(renderer, tubes, ambient=0.25, diffuse=0.8, specular=0.35, outer_sides=bool(job["outer_sides"]))
    marks = mesh(job["mark_points"], job["mark_triangles"], colours=job["mark_colours"])
    add(renderer, marks)
    add(renderer, mesh(job["reference"], job["reference_pieces"]), REFERENCE_COLOUR, line_width=samples * _LINE_WIDTH)
    surface, colour = job["surface_points"], tuple(job["surface_colour"].tolist())
    add(
        renderer,
        mesh(surface, job["surface_quads"]),
        colour,
        ambient=0.5,
        diffuse=0.5,
        opacity=float(job["surface_opacity"]),
    )
    add(renderer, mesh(surface, job["surface_rim"]), colour, line_width=samples * _LINE_WIDTH)
    aim(renderer, job)
    window.Render()
    pixels = vtkUnsignedCharArray()
    width, height = window.GetSize()
    window.GetPixelData(0, 0, width - 1, height - 1, 0, pixels, 0)
    fine = vtk_to_numpy(pixels).reshape(height, width, 3)[::-1]
    window.RemoveRenderer(renderer)
    n_grey = _count(fine, REFERENCE_COLOUR) // samples**2 if len(job["reference_pieces"]) else 0
    return (_halved(fine) if samples == 2 else fine), n_grey


def _count(picture: np.ndarray, colour: tuple[int, int, int]) -> int:
    """Number of pixels of a colour."""
    # few pixels have its red
    like = picture[picture[:, :, 0] == colour[0]]
    return int(np.count_nonzero((like == colour).all(axis=1)))


def _halved(picture: np.ndarray) -> np.ndarray:
    """A picture whose pixels are the means of 2 x 2, in half of the width and height."""
    rows = picture[::2].astype(np.uint16)
    rows += picture[1::2]
    pairs = rows.reshape(len(rows), -1, 2, 3)
    sums = pairs[:, :, 0] + pairs[:, :, 1]
    sums //= 4
    return sums.astype(np.uint8)


#: Arrays whose memory VTK uses
_SHARED: list[np.ndarray] = []


def shared(values: np.ndarray, kind: type) -> vtkDataArray:
    """An array of VTK in the memory of `values`, which stays as long as the picture is drawn."""
    _SHARED.append(np.ascontiguousarray(values, dtype=kind))
    return numpy_to_vtk(_SHARED[-1])


def mesh(
    points: np.ndarray, cells: np.ndarray, colours: np.ndarray | None = None, normals: np.ndarray | None = None
) -> vtkPolyData:
    """Lines (n, 2), triangles (n, 3) or quadrilaterals (n, 4) between points (m, 3), with colours and normals (m, 3) of them."""
    data, places, array = vtkPolyData(), vtkPoints(), vtkCellArray()
    places.SetData(shared(points, np.float32))
    array.SetData(cells.shape[1], shared(cells.ravel(), np.int32))
    data.SetPoints(places)
    if cells.shape[1] == 2:
        data.SetLines(array)
    else:
        data.SetPolys(array)
    if colours is not None:
        data.GetPointData().SetScalars(shared(colours, np.uint8))
    if normals is not None:
        data.GetPointData().SetNormals(shared(normals, np.float32))
    return data


def add(
    renderer: vtkRenderer, data: vtkPolyData, colour: tuple[int, ...] | None = None, *, ambient: float = 1.0,
    diffuse: float = 0.0, specular: float = 0.0, opacity: float = 1.0, line_width: float = 1.0,
    outer_sides: bool = False,
) -> None:  # fmt: skip
    """Show a mesh in a colour of bytes, or in the colours of its points; nothing where it has no cells.

    With `outer_sides` what is seen from within is not drawn.
    """
    if not data.GetNumberOfCells():
        return
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(data)
    mapper.SetScalarVisibility(colour is None)
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetInterpolationToPhong()
    look.SetAmbient(ambient)
    look.SetDiffuse(diffuse)
    look.SetSpecular(specular)
    look.SetSpecularPower(25.0)
    look.SetOpacity(opacity)
    look.SetLineWidth(line_width)
    look.SetBackfaceCulling(outer_sides)
    look.SetLighting(diffuse > 0)
    if colour is not None:
        look.SetColor(*(part / 255 for part in colour))
    renderer.AddActor(actor)


def aim(renderer: vtkRenderer, job: Mapping[str, np.ndarray]) -> None:
    """A parallel projection."""
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*job["centre"])
    camera.SetPosition(*(job["centre"] + job["toward"] * job["distance"]))
    camera.SetViewUp(*job["up"])
    camera.ParallelProjectionOn()
    camera.SetParallelScale(float(job["half_height"]))
    renderer.ResetCameraClippingRange()


def add_lights(renderer: vtkRenderer, job: Mapping[str, np.ndarray]) -> None:
    """A strong light from the upper left of the viewer and a weak one from the right."""
    toward, up = job["toward"], job["up"]
    right = np.cross(up, toward)
    renderer.AutomaticLightCreationOff()
    for direction, intensity in ((toward + 0.7 * up - 0.6 * right, 0.85), (toward - 0.1 * up + 0.9 * right, 0.35)):
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(*(job["centre"] + direction * job["distance"]))
        light.SetFocalPoint(*job["centre"])
        light.SetIntensity(intensity)
        renderer.AddLight(light)


if __name__ == "__main__":
    main()
