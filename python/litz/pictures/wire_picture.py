"""Draws scenes of wires into matplotlib axes: tubes by VTK, or else by matplotlib; contact spots, directions, a scale."""

import os
import subprocess
import tempfile
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from queue import SimpleQueue
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backend_bases import RendererBase
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection

from ..base.quantities import engineering, with_unit
from . import drawing_process
from .colours import line_colours, scalar_colours
from .contact_marks import Spots
from .needed_points import needed_points
from .prisms import prism
from .scene import Camera, Scene
from .tube_mesh import Mesh, tubes
from .tube_mesh import discs as discs_mesh

SPOT_COLOUR = "#e8502a"
SURFACE_COLOUR, SURFACE_OPACITY = "#8296aa", 0.35
_MAX_RENDERING_TIME = 300.0
# Smallest visible radii, relative to half the width of the picture: of a wire, and of the largest contact spot
_MIN_RADIUS = 0.0015
_MIN_SPOT = 0.007
# Layers of a stroke, from rim to core: width, brightness, and how far it reaches into the next stroke (part of its length),
# the brighter ones farther, so that no seams are seen
_LAYERS = ((1.0, 0.55, 0.02), (0.8, 0.8, 0.06), (0.55, 1.0, 0.10), (0.25, 1.25, 0.14))
# Wires up to this width [points] have one layer: more are not seen apart
_THIN, _LAYER_OF_THIN = 1.5, ((1.0, 0.85, 0.1),)
# Thickness over diameter of a spot that is seen from its edge
_MIN_THICKNESS = 0.18
# Width of the lines of contact in radii, and its range in points and in pixels
_LINE_WIDTH, _LINE_WIDTHS, _LINE_PIXELS = 0.5, (1.6, 5.0), (3.0, 10.0)
_DARK = "#3a1510"
# Rim of a mark [pixels], and at most as a part of the radius of a disc
_RIM, _RIM_PART = 1.0, 0.3
# How far before the wires marks lie, relative to these; one above the other, in radii
_CLEARANCE, _LAYER = 1.05, 0.02
# Corners of a disc, of few and of many discs
_DISC_SIDES, _SIDES_OF_MANY, _MANY_DISCS = 24, 8, 5000
# Corners of the rings of a tube
_SIDES = (6, 64)
# The undeformed axes are seen if they have this share of the width of the picture in pixels
_LEAST_GREY = 0.02
#: Note on pictures that were drawn without OpenGL
WITHOUT_OPENGL = "drawn without OpenGL: depth is approximate"

# Corners (n, 3), triangles (m, 3), colours of the corners (n, 3)
_Marks = tuple[np.ndarray, np.ndarray, np.ndarray]


class RenderingError(RuntimeError):
    """VTK has not made a picture."""


@dataclass(frozen=True)
class Drawn:
    """What VTK has drawn: the picture, (height, width, 3) of bytes, and whether the undeformed axes are seen in it."""

    picture: np.ndarray
    shows_reference: bool


def render(scenes: list[Scene], camera: Camera, pixels: np.ndarray) -> Sequence[Drawn | None]:
    """Pictures of the wires of scenes and their contacts; None and a warning where VTK cannot draw.

    Parameters
    ----------
    scenes : list of Scene
    camera : Camera
    pixels : ndarray
        Width and height, (2).
    """
    return list(begin_rendering(scenes, camera, pixels)())


def begin_rendering(scenes: list[Scene], camera: Camera, pixels: np.ndarray) -> Callable[[], Iterator[Drawn | None]]:
    """As `render`, beside what this process does until it asks for the pictures by calling what is returned, one by one."""
    pool = ThreadPoolExecutor(1)
    drawn: SimpleQueue[Drawn | None] = SimpleQueue()
    rendering = pool.submit(_render, scenes, camera, pixels, drawn.put)
    rendering.add_done_callback(lambda _: drawn.put(None))
    pool.shutdown(wait=False)

    def finish() -> Iterator[Drawn | None]:
        for number in range(len(scenes)):
            picture = drawn.get()
            if picture is None:
                try:
                    rendering.result()
                except RenderingError as error:
                    warnings.warn(f"{error}; the picture is drawn with matplotlib only, without OpenGL", stacklevel=3)
                yield from [None] * (len(scenes) - number)
                return
            yield picture

    return finish


class _Pixels(Artist):
    """A picture with the pixels of the box of its axes: what `imshow` resamples is put there as it is."""

    def __init__(self, picture: np.ndarray) -> None:
        super().__init__()
        opaque = np.full((*picture.shape[:2], 1), 255, dtype=np.uint8)
        # from the bottom up, as renderers take it
        self._picture = np.ascontiguousarray(np.concatenate([picture, opaque], axis=2)[::-1])

    def draw(self, renderer: RendererBase) -> None:
        """Place the picture at the lower left corner of the axes."""
        left, bottom = np.rint(self.axes.bbox.min).astype(int)
        context = renderer.new_gc()
        renderer.draw_image(context, left, bottom, self._picture)
        context.restore()


def draw_wires(axes: Axes, scene: Scene, camera: Camera, drawn: Drawn | None) -> None:
    """The scene in axes that keep their place; `drawn` is what `render` has made of it."""
    axes.set_xlim(-camera.half_width, camera.half_width)
    axes.set_ylim(-camera.half_height, camera.half_height)
    axes.set_axis_off()
    if drawn is not None:
        axes.add_artist(_Pixels(drawn.picture))
        return
    points_per_metre = 72 * axes.get_position().width * axes.figure.get_figwidth() / (2 * camera.half_width)
    _draw_flat(axes, scene, camera, points_per_metre)
    _draw_lines(axes, scene, camera, points_per_metre)
    _draw_spots(axes, scene, camera)


def _render(scenes: list[Scene], camera: Camera, pixels: np.ndarray, give: Callable[[Drawn], None]) -> None:
    """Give the pictures one by one, made by `render_wires.py` in a process of its own."""
    distance = 10 * max(np.ptp(scene.outline, axis=0).max() + scene.radius.max() for scene in scenes)
    with tempfile.TemporaryDirectory() as folder:
        seen, flat = None, _NO_MARKS
        for number, scene in enumerate(scenes):
            # scenes of other colours have the same contacts
            if seen is not scene.spots:
                seen, flat = scene.spots, marks(scene, camera, pixels[0])
            job: dict[str, Any] = {
                "size": np.round(pixels), "centre": camera.centre, "toward": camera.toward, "up": camera.up,
                "half_height": camera.half_height, "distance": distance, **_meshes(scene, camera, pixels[0], flat),
            }  # fmt: skip
            np.savez(Path(folder, f"job_{number}.npz"), **job)
            del job
        names = (Path(folder, f"drawn_{number}.npz") for number in range(len(scenes)))
        path = next(names)

        def look() -> None:
            nonlocal path
            while path.is_file():
                file = np.load(path)
                give(Drawn(file["picture"], bool(file["n_grey"] > _LEAST_GREY * pixels[0])))
                path = next(names, Path(folder, "none"))

        _run_vtk(folder, len(scenes), look)
        look()


def _meshes(scene: Scene, camera: Camera, width: float, flat: _Marks) -> dict[str, np.ndarray]:
    """What `render_wires.py` draws, for a picture of a width [pixels], with the marks of its contacts."""
    radius = np.maximum(scene.radius, _MIN_RADIUS * camera.half_width)
    in_pixels = radius.max() * width / (2 * camera.half_width)
    # the polygon of a ring departs from the circle by less than a fifth of a pixel
    sides = int(np.clip(2 * np.ceil(np.pi * np.sqrt(in_pixels / 0.4) / 2), *_SIDES))
    tube = _wires(scene, radius, sides, _MIN_RADIUS * camera.half_width)
    colours = scalar_colours(scene.colours)(mpl.colors.Normalize(*scene.limits)(scene.value), bytes=True)[:, :3]
    points, triangles, mark_colours = flat
    reference, starts = scene.reference, scene.reference_starts
    pieces = np.stack([np.arange(len(reference) - 1), np.arange(1, len(reference))], axis=1) if len(reference) else None
    return {
        "points": tube.points, "normals": tube.normals, "triangles": tube.triangles, "colours": colours[tube.source],
        # the inner sides of round tubes, which have round ends, are never seen
        "outer_sides": np.array(not scene.frames),
        "mark_points": points, "mark_triangles": triangles, "mark_colours": mark_colours,
        "reference": reference,
        "reference_pieces": np.zeros((0, 2)) if pieces is None else np.delete(pieces, starts[1:-1] - 1, axis=0),
        "surface_points": scene.surface_points, "surface_quads": scene.surface_quads, "surface_rim": scene.surface_rim,
        "surface_colour": np.array(_bytes(SURFACE_COLOUR)), "surface_opacity": np.array(SURFACE_OPACITY),
    }  # fmt: skip


def _wires(scene: Scene, radius: np.ndarray, sides: int, least: float) -> Mesh:
    """Tubes with radii (n) at the points, and outlines that reach so far at least [m]."""
    lines = range(len(scene.starts) - 1)
    if not scene.frames:
        kept, starts = needed_points(scene.points, scene.starts, radius, scene.value, scene.limits)
        tube = tubes(scene.points[kept], starts, radius[kept], sides, np.float32)
        return Mesh(tube.points, tube.normals, kept[tube.source], tube.triangles)
    rows = {line: np.arange(scene.starts[line], scene.starts[line + 1]) for line in lines}
    meshes = [(rows[line], prism(scene.points[rows[line]], frames, least)) for line, frames in scene.frames.items()]
    is_round = [rows[line] for line in lines if line not in scene.frames]
    if is_round:
        of_tubes = np.concatenate(is_round)
        starts = np.cumsum([0, *map(len, is_round)])
        meshes.append((of_tubes, tubes(scene.points[of_tubes], starts, radius[of_tubes], sides, np.float32)))
    first = np.cumsum([0, *(len(mesh.points) for _, mesh in meshes)])
    return Mesh(
        np.concatenate([mesh.points for _, mesh in meshes]),
        np.concatenate([mesh.normals for _, mesh in meshes]),
        np.concatenate([places[mesh.source] for places, mesh in meshes]),
        np.concatenate([start + mesh.triangles for start, (_, mesh) in zip(first, meshes, strict=False)]),
    )


def marks(scene: Scene, camera: Camera, width: float) -> _Marks:
    """Discs and lines of the contacts, as triangles that face the viewer: corners, triangles, and colours of the corners.

    They lie before the two bodies that touch, which would hide what is between them, and behind all others.
    """
    pixel = 2 * camera.half_width / width
    return _joined([_line_marks(scene, camera, pixel), _spot_marks(scene, camera, pixel)])


_NO_MARKS: _Marks = (
    np.zeros((0, 3), dtype=np.float32), np.zeros((0, 3), dtype=np.int32), np.zeros((0, 3), dtype=np.uint8)
)  # fmt: skip


def _before_wires(spots: Spots, camera: Camera) -> np.ndarray:
    """Places of contacts moved towards the viewer, just before the wires that touch there, (m, 3) [m]."""
    radii = np.where(spots.radii > 0, np.maximum(spots.radii, _MIN_RADIUS * camera.half_width), 0.0)
    distance = _CLEARANCE * spots.reach(camera.toward, radii)
    return spots.places + distance[:, None] * camera.toward


def _flat(centres: np.ndarray, first: np.ndarray, second: np.ndarray, colours: np.ndarray, sides: int) -> _Marks:
    """Ellipses of colours (m, 3) with half axes (m, 3)."""
    corners, triangles = discs_mesh(centres, first, second, sides)
    return corners.reshape(-1, 3), triangles, np.repeat(colours, sides, axis=0)


def _joined(parts: list[_Marks]) -> _Marks:
    offset = np.cumsum([0, *(len(corners) for corners, _, _ in parts[:-1])], dtype=np.int32)
    corners, triangles, colours = zip(*parts, strict=True)
    rows = [first + one for first, one in zip(offset, triangles, strict=True)]
    return np.concatenate(corners), np.concatenate(rows), np.concatenate(colours)


def _spot_marks(scene: Scene, camera: Camera, pixel: float) -> _Marks:
    """Discs with a white rim; a smaller one lies on a larger one."""
    if not len(scene.spot_radius):
        return _NO_MARKS
    width, height, angle = discs(scene, camera)
    turn = np.radians(angle)
    first = np.cos(turn)[:, None] * camera.right + np.sin(turn)[:, None] * camera.up
    second = np.cos(turn)[:, None] * camera.up - np.sin(turn)[:, None] * camera.right
    rank = np.argsort(np.argsort(-scene.spot_radius, kind="stable"))
    thin = _LAYER * scene.radius.min()
    parts = []
    sides = _DISC_SIDES if len(rank) <= _MANY_DISCS else _SIDES_OF_MANY
    rims = np.minimum(_RIM * pixel, _RIM_PART * width / 2)
    for rim, colour, layer in ((rims, "white", 0.0), (0.0, SPOT_COLOUR, 0.5)):
        centres = _before_wires(scene.spots, camera) + (thin * (rank + layer) / len(rank))[:, None] * camera.toward
        half, other_half = (width / 2 + rim)[:, None] * first, (height / 2 + rim)[:, None] * second
        parts.append(
            _flat(centres, half, other_half, np.tile(np.array(_bytes(colour), dtype=np.uint8), (len(rank), 1)), sides)
        )
    return _joined(parts)


def _line_marks(scene: Scene, camera: Camera, pixel: float) -> _Marks:
    """Ribbons of the colours of the zones between dark rims, and dots at their ends."""
    if not len(scene.line_pieces):
        return _NO_MARKS
    points = _before_wires(scene.lines, camera)
    half = np.clip(0.5 * _LINE_WIDTH * scene.radius.min(), *(0.5 * pixel * np.array(_LINE_PIXELS)))
    colour = line_colours()(scene.line_value / (scene.line_limit or 1.0), bytes=True)[:, :3]
    dark, white = (np.tile(_bytes(one), (len(points), 1)) for one in (_DARK, "white"))
    thin = _LAYER * scene.radius.min() * camera.toward
    right, up = np.tile(camera.right, (len(points), 1)), np.tile(camera.up, (len(points), 1))
    parts = []
    for layer, wide, colours in ((0, half + _RIM * pixel, dark), (1, half, colour)):
        parts.append(_ribbons(points + layer * thin, scene.line_pieces, wide, colours, camera))
    ends = scene.line_ends
    for layer, wide, colours in ((2, half + 2.5 * _RIM * pixel, white), (3, half + 1.5 * _RIM * pixel, dark)):
        parts.append(_flat((points + layer * thin)[ends], wide * right[ends], wide * up[ends], colours[ends], 16))
    return _joined(parts)


def _ribbons(points: np.ndarray, pieces: np.ndarray, half: float, colours: np.ndarray, camera: Camera) -> _Marks:
    """Strips between pairs of points, half of whose width is given."""
    begin, end = pieces.T
    along = points[end] - points[begin]
    across = np.zeros_like(points)
    # two pieces share the edge at the point between them
    for side in (begin, end):
        np.add.at(across, side, np.cross(camera.toward, along))
    across *= half / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), np.finfo(float).tiny)
    left, right = points - across, points + across
    corners = np.stack([left[begin], left[end], right[end], right[begin]], axis=1)
    rows = 4 * np.arange(len(pieces))[:, None, None] + np.array([[0, 1, 2], [0, 2, 3]])
    of_corners = np.stack([colours[pieces[:, k]] for k in (0, 1, 1, 0)], axis=1)
    return corners.reshape(-1, 3), rows.reshape(-1, 3), of_corners.reshape(-1, 3)


def _bytes(colour: str) -> list[int]:
    return [round(255 * part) for part in mpl.colors.to_rgb(colour)]


def _run_vtk(folder: str, n_pictures: int, look: Callable[[], None]) -> None:
    longest = _MAX_RENDERING_TIME + 10 * n_pictures
    # where there are no X11 libraries VTK may crash instead of taking OSMesa by itself
    for environment in (None, {**os.environ, "VTK_DEFAULT_OPENGL_WINDOW": "vtkOSOpenGLRenderWindow"}):
        try:
            code, messages = drawing_process.run(folder, longest, environment, look)
        except subprocess.TimeoutExpired:
            raise RenderingError(f"VTK produced no picture within {longest:g} s") from None
        if code == 0:
            break
    if code < 0:
        raise RenderingError(f"VTK ended by signal {-code} (is OpenGL missing? apt-get install libosmesa6)")
    if code or not Path(folder, f"drawn_{n_pictures - 1}.npz").is_file():
        last = (messages.strip().splitlines() or ["no message"])[-1]
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
    colour = scalar_colours(scene.colours)(norm((scene.value[first] + scene.value[first + 1]) / 2))[:, :3]
    width = 2 * np.maximum(scene.radius[first], _MIN_RADIUS * camera.half_width) * points_per_metre

    layers = _LAYERS if width.max() > _THIN else _LAYER_OF_THIN
    order = np.repeat(np.argsort(depth), len(layers))
    thickness, shade, reach = np.tile(np.array(layers), (len(depth), 1)).T
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


def _draw_lines(axes: Axes, scene: Scene, camera: Camera, points_per_metre: float) -> None:
    """Zones of contact along lines, on top of the wires, with a dark rim and dots at their ends."""
    if not len(scene.line_pieces):
        return
    width = np.clip(_LINE_WIDTH * scene.radius.min() * points_per_metre, *_LINE_WIDTHS)
    flat = camera.project(scene.lines.places)
    pieces = flat[scene.line_pieces]
    order = np.argsort(pieces[:, :, 2].mean(axis=1))
    colour = line_colours()(scene.line_value[scene.line_pieces].mean(axis=1)[order] / (scene.line_limit or 1.0))
    for wider, colours in ((1.2, _DARK), (0.0, colour)):
        axes.add_collection(
            LineCollection(
                pieces[order, :, :2], colors=colours, linewidths=width + wider, capstyle="round", zorder=3
            )
        )  # fmt: skip
    ends = flat[scene.line_ends]
    axes.plot(ends[:, 0], ends[:, 1], "o", markersize=width + 2.0, color=_DARK, markeredgecolor="white",
              markeredgewidth=0.7, zorder=3.5)  # fmt: skip


def _draw_spots(axes: Axes, scene: Scene, camera: Camera) -> None:
    """Discs in the plane of contact, on top of everything: between two wires nothing would be seen of them."""
    if not len(scene.spot_radius):
        return
    order = np.argsort(-scene.spot_radius)
    width, height, angle = (values[order] for values in discs(scene, camera))
    axes.add_collection(
        EllipseCollection(
            width,
            height,
            angle,
            units="xy",
            offsets=camera.project(scene.spots.places[order])[:, :2],
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
    normal = camera.turn(scene.spots.normals)
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
    axes.text(right - bar / 2, bottom + 0.12 * half_height, with_unit(f"{bar * factor:g}", unit),
              ha="center", va="bottom", color="#404040", fontsize="small")  # fmt: skip
