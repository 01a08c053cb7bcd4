"""Draws scenes of wires into matplotlib axes: tubes by VTK, or else by matplotlib; contact spots, directions, a scale."""

import os
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.image import imread

from ..base.quantities import engineering
from .scene import Camera, Scene

SPOT_COLOUR = "#e8502a"
SURFACE_COLOUR, SURFACE_OPACITY = "#8296aa", 0.35
_MAX_RENDERING_TIME = 300.0
# Smallest visible radii, relative to half the width of the picture: of a wire, and of the largest contact spot
_MIN_RADIUS = 0.0015
_MIN_SPOT = 0.007
# Layers of a stroke, from rim to core: width, brightness, and how far it reaches into the next stroke (part of its length),
# the brighter ones farther, so that no seams are seen
_LAYERS = ((1.0, 0.55, 0.02), (0.8, 0.8, 0.06), (0.55, 1.0, 0.10), (0.25, 1.25, 0.14))
# Thickness over diameter of a spot that is seen from its edge
_MIN_THICKNESS = 0.18
#: Note on pictures that were drawn without OpenGL
WITHOUT_OPENGL = "drawn without OpenGL: depth is approximate"


class RenderingError(RuntimeError):
    """VTK has not made a picture."""


def render(scenes: list[Scene], camera: Camera, pixels: np.ndarray) -> Sequence[np.ndarray | None]:
    """Pictures of the tubes of scenes, each (height, width, 4); None and a warning where VTK cannot draw.

    Parameters
    ----------
    scenes : list of Scene
    camera : Camera
    pixels : ndarray
        Width and height, (2).
    """
    try:
        return list(_render(scenes, camera, pixels))
    except RenderingError as error:
        warnings.warn(f"{error}; the picture is drawn with matplotlib only, without OpenGL", stacklevel=2)
        return [None] * len(scenes)


def draw_wires(axes: Axes, scene: Scene, camera: Camera, tubes: np.ndarray | None) -> None:
    """The scene in axes that keep their place; `tubes` is what `render` has made of it."""
    axes.set_xlim(-camera.half_width, camera.half_width)
    axes.set_ylim(-camera.half_height, camera.half_height)
    axes.set_axis_off()
    if tubes is None:
        width = axes.get_position().width * axes.figure.get_figwidth()
        _draw_flat(axes, scene, camera, points_per_metre=72 * width / (2 * camera.half_width))
    else:
        axes.imshow(
            tubes, extent=(-camera.half_width, camera.half_width, -camera.half_height, camera.half_height),
            aspect="auto", interpolation="antialiased",
        )  # fmt: skip
    _draw_spots(axes, scene, camera)


def _render(scenes: list[Scene], camera: Camera, pixels: np.ndarray) -> list[np.ndarray]:
    """The pictures, made by `render_wires.py` in a process of its own."""
    distance = 10 * max(np.ptp(scene.outline, axis=0).max() + scene.radius.max() for scene in scenes)
    with tempfile.TemporaryDirectory() as folder:
        for number, scene in enumerate(scenes):
            np.savez(
                Path(folder, f"{number}.npz"),
                points=scene.points, starts=scene.starts, value=scene.value,
                radius=np.maximum(scene.radius, _MIN_RADIUS * camera.half_width),
                reference=scene.reference, reference_starts=scene.reference_starts,
                surface_points=scene.surface_points, surface_quads=scene.surface_quads, surface_rim=scene.surface_rim,
                surface_colour=SURFACE_COLOUR, surface_opacity=SURFACE_OPACITY,
                colours=scene.colours, limits=scene.limits, size=np.round(pixels),
                sides=24 if len(scene.points) < 50_000 else 12, centre=camera.centre, toward=camera.toward,
                up=camera.up, half_height=camera.half_height, distance=distance,
            )  # fmt: skip
        _run_vtk(folder, len(scenes))
        return [imread(Path(folder, f"{number}.png")) for number in range(len(scenes))]


def _run_vtk(folder: str, n_pictures: int) -> None:
    command = [sys.executable, str(Path(__file__).with_name("render_wires.py")), folder]
    longest = _MAX_RENDERING_TIME + 10 * n_pictures
    # where there are no X11 libraries VTK may crash instead of taking OSMesa by itself
    for environment in (None, {**os.environ, "VTK_DEFAULT_OPENGL_WINDOW": "vtkOSOpenGLRenderWindow"}):
        try:
            done = subprocess.run(
                command, capture_output=True, text=True, timeout=longest, check=False, env=environment
            )
        except subprocess.TimeoutExpired:
            raise RenderingError(f"VTK produced no picture within {longest:g} s") from None
        if done.returncode == 0:
            break
    if done.returncode < 0:
        raise RenderingError(f"VTK ended by signal {-done.returncode} (is OpenGL missing? apt-get install libosmesa6)")
    if done.returncode or not Path(folder, f"{n_pictures - 1}.png").is_file():
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise RenderingError(f"VTK produced no picture: {last}")


def _draw_flat(axes: Axes, scene: Scene, camera: Camera, points_per_metre: float) -> None:
    """Short straight strokes from back to front, each with a dark rim and a bright core so that wires look round."""
    flat = camera.project(scene.points)
    inside = np.ones(len(flat) - 1, dtype=bool)
    inside[scene.starts[1:-1] - 1] = False
    first = np.flatnonzero(inside)
    segments = np.stack([flat[first, :2], flat[first + 1, :2]], axis=1)
    depth = (flat[first, 2] + flat[first + 1, 2]) / 2
    norm = mpl.colors.Normalize(*scene.limits)
    colour = mpl.colormaps[scene.colours](norm((scene.value[first] + scene.value[first + 1]) / 2))[:, :3]
    width = 2 * np.maximum(scene.radius[first], _MIN_RADIUS * camera.half_width) * points_per_metre

    order = np.repeat(np.argsort(depth), len(_LAYERS))
    thickness, shade, reach = np.tile(np.array(_LAYERS), (len(depth), 1)).T
    strokes = segments[order] + reach[:, None, None] * (segments - segments[:, ::-1])[order]
    shaded = np.clip(colour[order] * shade[:, None], 0, 1)
    axes.add_collection(
        LineCollection(
            strokes,
            colors=shaded,
            linewidths=np.maximum(width[order] * thickness, 0.4),
            zorder=2,
            capstyle="butt",
        )
    )
    _draw_surfaces(axes, scene, camera)
    for start, stop in zip(scene.reference_starts[:-1], scene.reference_starts[1:], strict=True):
        line = camera.project(scene.reference[start:stop])
        axes.plot(line[:, 0], line[:, 1], color="#9a9a9a", linewidth=0.6, zorder=1)


def _draw_surfaces(axes: Axes, scene: Scene, camera: Camera) -> None:
    """Rigid surfaces above or below the wires, as their faces lie nearer to the viewer than the middle of the wires or not."""
    if not len(scene.surface_points):
        return
    flat = camera.project(scene.surface_points)
    middle = camera.project(scene.points)[:, 2].mean()
    is_near = flat[scene.surface_quads, 2].mean(axis=1) > middle
    for faces, layer in ((scene.surface_quads[~is_near], 1.5), (scene.surface_quads[is_near], 3)):
        axes.add_collection(
            PolyCollection(
                flat[faces][:, :, :2], facecolors=SURFACE_COLOUR, alpha=SURFACE_OPACITY, linewidths=0, zorder=layer
            )
        )
    axes.add_collection(
        LineCollection(flat[scene.surface_rim][:, :, :2], colors=SURFACE_COLOUR, linewidths=0.8, zorder=3)
    )


def _draw_spots(axes: Axes, scene: Scene, camera: Camera) -> None:
    """Discs in the plane of contact, on top of everything: between two wires nothing would be seen of them."""
    if not len(scene.spots):
        return
    order = np.argsort(-scene.spot_radius)
    width, height, angle = (values[order] for values in discs(scene, camera))
    axes.add_collection(
        EllipseCollection(
            width,
            height,
            angle,
            units="xy",
            offsets=camera.project(scene.spots[order])[:, :2],
            offset_transform=axes.transData,
            facecolors=SPOT_COLOUR,
            edgecolors="white",
            linewidths=0.5,
            alpha=0.85,
            zorder=4,
        )
    )


def discs(scene: Scene, camera: Camera) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The ellipses as which the discs are seen: longer and shorter diameter [m], angle of the longer one [degrees].

    Very small discs are drawn larger, all by the same factor, and those seen from their edge keep some thickness.
    """
    diameter = 2 * max(1.0, _MIN_SPOT * camera.half_width / scene.spot_radius.max()) * scene.spot_radius
    normal = camera.turn(scene.spot_normal)
    thickness = np.clip(np.abs(normal[:, 2]), _MIN_THICKNESS, 1.0)
    return diameter, diameter * thickness, np.degrees(np.arctan2(normal[:, 1], normal[:, 0])) + 90


def draw_frame(axes: Axes, camera: Camera, length_unit: str) -> None:
    """Coordinate directions and a bar of a round length, at the right end of a strip as wide as the picture."""
    width, height = axes.get_window_extent().size
    half_height = camera.half_width * height / width
    axes.set_xlim(-camera.half_width, camera.half_width)
    axes.set_ylim(-half_height, half_height)
    axes.set_axis_off()

    origin = np.array([0.91 * camera.half_width, -0.35 * half_height])
    for axis, name in enumerate("xyz"):
        arrow = np.array([camera.right[axis], camera.up[axis]]) * 0.75 * half_height
        length = np.linalg.norm(arrow)
        if length < 0.1 * half_height:
            continue
        style = {"arrowstyle": "-|>", "color": "#404040", "linewidth": 1.1, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", origin + arrow, origin, arrowprops=style)
        place = origin + arrow * (1 + 0.25 * half_height / length)
        axes.text(*place, name, ha="center", va="center", color="#404040", fontsize="small")

    wanted = 0.25 * camera.half_width
    decade = 10.0 ** np.floor(np.log10(wanted))
    bar = decade * max(step for step in (1, 2, 5) if step * decade <= wanted)
    factor, unit = engineering(np.array([bar]), length_unit)
    right, bottom = 0.8 * camera.half_width, -0.35 * half_height
    axes.plot([right - bar, right], [bottom, bottom], color="#404040", linewidth=2.5, solid_capstyle="butt")
    axes.text(right - bar / 2, bottom + 0.12 * half_height, f"{bar * factor:g} {unit}",
              ha="center", va="bottom", color="#404040", fontsize="small")  # fmt: skip
