"""The picture of the wires: smooth tubes coloured by a field, contact spots, a scale; drawn into matplotlib axes."""

import os
import subprocess
import sys
import tempfile
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.image import imread

from .quantities import engineering, label
from .wires import element_curves, find_wires, hermite

if TYPE_CHECKING:
    from .results import Results

COLOURS = "viridis"
SPOT_COLOUR = "#e8502a"
_MOST_POINTS = 150_000
_LONGEST_RENDERING = 300.0
# Radii that are still seen, as parts of half the width of the picture: of a wire, and of the largest contact spot
_LEAST_RADIUS = 0.0015
_LEAST_SPOT = 0.007


@dataclass
class Scene:
    """Everything that is seen, in metres, before the camera comes in.

    Attributes
    ----------
    points, radius, value : ndarray
        Along all wires: positions (n, 3), radius (n), colour value (n).
    starts : ndarray
        First point of each wire, and n at the end.
    reference, reference_starts : ndarray
        The axes before any deformation; empty when they are not wanted.
    spots, spot_radius : ndarray
        Centres (m, 3) and drawn radii (m) of the contact spots.
    title, spot_text : str
        What the colours and the spots mean, with units.
    limits : tuple of float
        Range of the colours.
    """

    points: np.ndarray
    radius: np.ndarray
    value: np.ndarray
    starts: np.ndarray
    reference: np.ndarray
    reference_starts: np.ndarray
    spots: np.ndarray
    spot_radius: np.ndarray
    title: str
    spot_text: str
    limits: tuple[float, float]


@dataclass
class Camera:
    """A parallel projection: unit vectors of the picture, its centre, and half its width and height [m]."""

    right: np.ndarray
    up: np.ndarray
    toward: np.ndarray
    centre: np.ndarray
    half_width: float
    half_height: float

    def project(self, points: np.ndarray) -> np.ndarray:
        """Picture coordinates and depth, (n, 3), zero at the centre."""
        return (points - self.centre) @ np.stack([self.right, self.up, self.toward], axis=1)


def make_scene(
    results: "Results", increment: int, field: str | None, scale: float, spots: str | None, reference: bool
) -> Scene:
    """Collect what is to be seen of one increment."""
    elements = results.elements
    wires = find_wires(elements)
    displacement = scale * results.field("displacement", increment)
    rotation = results.field("rotation", increment)
    field = field or _default_field(results, increment)
    ends, name = _end_values(results, field, increment)
    factor, unit = engineering(ends, results.units[field])

    n = int(np.clip(_MOST_POINTS // len(elements), 2, 24))
    curves = element_curves(results.nodes, displacement, rotation, wires, len(elements))
    points, starts = _sample(*curves, wires, n)
    still = np.zeros_like(displacement)
    shown_reference = reference and np.abs(displacement).max() > 0.2 * results.radius.min()
    rest = element_curves(results.nodes, still, still, wires, len(elements)) if shown_reference else None
    value = _along(ends * factor, wires, n)
    low, high = float(value.min()), float(value.max())
    centres, sizes, spot_text = _spots(results, increment, spots, curves)
    return Scene(
        points=points,
        starts=starts,
        radius=_along(np.repeat(results.radius[:, None], 2, axis=1), wires, n),
        value=value,
        reference=_sample(*rest, wires, n)[0] if shown_reference else np.zeros((0, 3)),
        reference_starts=starts if shown_reference else np.zeros(0, dtype=int),
        spots=centres,
        spot_radius=sizes,
        title=label(name, unit),
        spot_text=spot_text,
        limits=(low, high) if high > low else (low - 0.5, high + 0.5),
    )


def _default_field(results: "Results", increment: int) -> str:
    """The potential where there is one, else the displacement."""
    return "potential" if np.ptp(results.field("potential", increment)) > 0 else "displacement"


def _end_values(results: "Results", field: str, increment: int) -> tuple[np.ndarray, str]:
    """Values at the two ends of each element (n_elements, 2), the length of vectors; and what to call them."""
    values = results.field(field, increment)
    name = field
    if values.ndim == 2:
        values, name = np.linalg.norm(values, axis=1), f"{field}, magnitude"
    if len(values) == len(results.nodes) and field in results.point_fields:
        return values[results.elements], name
    return np.repeat(values[:, None], 2, axis=1), name


def _sample(positions: np.ndarray, slopes: np.ndarray, wires: list, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Points along all wires, n per element and one at the end, and the first of each wire."""
    xi = np.linspace(-1, 1, n + 1)
    points, starts = [], [0]
    for wire in wires:
        inner = [
            _element_points(positions, slopes, *element, xi[:-1])
            for element in zip(wire.elements, wire.signs, strict=True)
        ]
        last = _element_points(positions, slopes, wire.elements[-1], wire.signs[-1], xi[-1:])
        points += [*inner, last]
        starts.append(starts[-1] + n * len(wire.elements) + 1)
    return np.concatenate(points), np.array(starts)


def _element_points(positions: np.ndarray, slopes: np.ndarray, element: int, sign: int, xi: np.ndarray) -> np.ndarray:
    m = len(xi)
    return hermite(np.repeat(positions[[element]], m, axis=0), np.repeat(slopes[[element]], m, axis=0), sign * xi)


def _along(ends: np.ndarray, wires: list, n: int) -> np.ndarray:
    """Values at the points of `_sample`, linear between the two ends (n_elements, 2) of each element."""
    fraction = np.arange(n) / n
    values = []
    for wire in wires:
        pairs = np.where(wire.signs[:, None] < 0, ends[wire.elements][:, ::-1], ends[wire.elements])
        values += [(pairs[:, :1] * (1 - fraction) + pairs[:, 1:] * fraction).ravel(), pairs[-1:, 1]]
    return np.concatenate(values)


def _spots(results: "Results", increment: int, by: str | None, curves) -> tuple[np.ndarray, np.ndarray, str]:
    """Centres, drawn radii and legend of the contact spots; the drawn area is proportional to current or force."""
    contacts = results.contacts_at(increment)
    if not contacts.n_rows or by == "none":
        return np.zeros((0, 3)), np.zeros(0), ""
    if by is None:
        by = "current" if np.any(contacts["current"]) else "force"
    row = {int(element_id): i for i, element_id in enumerate(results.element_ids)}
    barred = np.array([row[i] for i in contacts["element_bar"]])
    unbarred = np.array([row[i] for i in contacts["element"]])
    positions, slopes = curves
    point_bar = hermite(positions[barred], slopes[barred], contacts["xi_bar"])
    point = hermite(positions[unbarred], slopes[unbarred], contacts["xi"])
    share = results.radius[unbarred] / (results.radius[barred] + results.radius[unbarred])
    size = np.abs(contacts[by])
    largest = max(size.max(), np.finfo(float).tiny)
    thinner = np.minimum(results.radius[barred], results.radius[unbarred])
    drawn = thinner * np.clip(0.85 * np.sqrt(size / largest), 0.15, None)
    factor, unit = engineering(size, contacts.units[by])
    plural = "s" if contacts.n_rows > 1 else ""
    text = f"{contacts.n_rows} contact{plural}: area of a disc by its {by},\nlargest {largest * factor:.3g} {unit}"
    return point + share[:, None] * (point_bar - point), drawn, text


def aim(scene: Scene, aspect: float, view: np.ndarray | None) -> Camera:
    """A camera that fills a picture of the given width over height.

    Without a `view` (the direction towards the viewer) the longest axis of the model lies across, the shortest points
    to the viewer, and the picture is tilted a little.
    """
    shown = np.concatenate([scene.points, scene.reference])
    if view is None:
        extent = np.ptp(shown, axis=0)
        order = np.argsort(-extent, kind="stable")
        if extent[order[0]] < 1.5 * extent[order[1]]:
            order[:2] = np.sort(order[:2])
        across, along, _ = np.eye(3)[order]
        towards = np.cross(across, along)
        toward = towards - 0.55 * along + 0.3 * across
        up = along
    else:
        toward = np.asarray(view, dtype=float)
        up = (
            np.array([0.0, 0.0, 1.0])
            if np.hypot(*toward[:2]) > 1e-3 * np.linalg.norm(toward)
            else np.array([0.0, 1.0, 0.0])
        )
    toward = toward / np.linalg.norm(toward)
    right = np.cross(up, toward)
    right /= np.linalg.norm(right)
    up = np.cross(toward, right)
    flat = shown @ np.stack([right, up, toward], axis=1)
    margin = scene.radius.max()
    low, high = flat.min(axis=0) - margin, flat.max(axis=0) + margin
    half_width, half_height = 1.04 * (high - low)[:2] / 2
    half_height = max(half_height, half_width / aspect)
    centre = (low + high) / 2 @ np.stack([right, up, toward])
    return Camera(right, up, toward, centre, half_height * aspect, half_height)


def draw_wires(axes: Axes, scene: Scene, view: np.ndarray | None = None) -> Camera:
    """The scene in axes that keep their place; by OpenGL, or else by matplotlib alone."""
    figure = axes.figure
    box = axes.get_position()
    width, height = box.width * figure.get_figwidth(), box.height * figure.get_figheight()
    camera = aim(scene, width / height, view)
    axes.set_xlim(-camera.half_width, camera.half_width)
    axes.set_ylim(-camera.half_height, camera.half_height)
    axes.set_axis_off()
    pixels = np.array([width, height]) * figure.dpi
    try:
        picture = _render(scene, camera, pixels)
    except RenderingError as error:
        warnings.warn(f"{error}; the picture is drawn by matplotlib alone, without OpenGL", stacklevel=2)
        _draw_flat(axes, scene, camera, points_per_metre=72 * width / (2 * camera.half_width))
    else:
        axes.imshow(
            picture, extent=(-camera.half_width, camera.half_width, -camera.half_height, camera.half_height),
            aspect="auto", interpolation="antialiased",
        )  # fmt: skip
    _draw_spots(axes, scene, camera)
    return camera


class RenderingError(RuntimeError):
    """VTK has not made a picture."""


def _render(scene: Scene, camera: Camera, pixels: np.ndarray) -> np.ndarray:
    """The picture as an array, made by `render_wires.py` in a process of its own."""
    distance = 10 * (np.ptp(scene.points, axis=0).max() + scene.radius.max())
    with tempfile.TemporaryDirectory() as folder:
        job, picture = Path(folder, "job.npz"), Path(folder, "picture.png")
        np.savez(
            job, points=scene.points, starts=scene.starts, value=scene.value,
            radius=np.maximum(scene.radius, _LEAST_RADIUS * camera.half_width),
            reference=scene.reference, reference_starts=scene.reference_starts,
            colours=COLOURS, limits=scene.limits, size=np.round(pixels), sides=24 if len(scene.points) < 50_000 else 12,
            centre=camera.centre, toward=camera.toward, up=camera.up, half_height=camera.half_height, distance=distance,
        )  # fmt: skip
        command = [sys.executable, str(Path(__file__).with_name("render_wires.py")), str(job), str(picture)]
        # where there are no X11 libraries VTK may crash instead of taking OSMesa by itself
        for environment in (None, {**os.environ, "VTK_DEFAULT_OPENGL_WINDOW": "vtkOSOpenGLRenderWindow"}):
            try:
                done = subprocess.run(
                    command, capture_output=True, text=True, timeout=_LONGEST_RENDERING, check=False, env=environment
                )
            except subprocess.TimeoutExpired:
                raise RenderingError(f"VTK has made no picture within {_LONGEST_RENDERING:g} s") from None
            if done.returncode == 0:
                break
        if done.returncode < 0:
            raise RenderingError(
                f"VTK ended by signal {-done.returncode} (is OpenGL missing? apt-get install libosmesa6)"
            )
        if done.returncode or not picture.is_file():
            last = (done.stderr.strip().splitlines() or ["no message"])[-1]
            raise RenderingError(f"VTK has made no picture: {last}")
        return imread(picture)


def _draw_flat(axes: Axes, scene: Scene, camera: Camera, points_per_metre: float) -> None:
    """Short straight strokes from back to front, each with a dark rim and a bright core so that wires look round."""
    flat = camera.project(scene.points)
    inside = np.ones(len(flat) - 1, dtype=bool)
    inside[scene.starts[1:-1] - 1] = False
    first = np.flatnonzero(inside)
    segments = np.stack([flat[first, :2], flat[first + 1, :2]], axis=1)
    depth = (flat[first, 2] + flat[first + 1, 2]) / 2
    norm = mpl.colors.Normalize(*scene.limits)
    colour = mpl.colormaps[COLOURS](norm((scene.value[first] + scene.value[first + 1]) / 2))[:, :3]
    width = 2 * np.maximum(scene.radius[first], _LEAST_RADIUS * camera.half_width) * points_per_metre

    layers = [(1.0, 0.55), (0.8, 0.8), (0.55, 1.0), (0.25, 1.25)]
    order = np.repeat(np.argsort(depth), len(layers))
    shade = np.tile([brightness for _, brightness in layers], len(depth))
    thickness = np.tile([fraction for fraction, _ in layers], len(depth))
    shaded = np.clip(colour[order] * shade[:, None], 0, 1)
    axes.add_collection(
        LineCollection(
            segments[order],
            colors=shaded,
            linewidths=np.maximum(width[order] * thickness, 0.4),
            zorder=2,
            capstyle="butt",
        )
    )
    for start, stop in zip(scene.reference_starts[:-1], scene.reference_starts[1:], strict=True):
        line = camera.project(scene.reference[start:stop])
        axes.plot(line[:, 0], line[:, 1], color="#9a9a9a", linewidth=0.6, zorder=1)


def _draw_spots(axes: Axes, scene: Scene, camera: Camera) -> None:
    """Discs on top of everything: a spot lies between two wires, where nothing would be seen of it."""
    if not len(scene.spots):
        return
    order = np.argsort(-scene.spot_radius)
    enlarged = max(1.0, _LEAST_SPOT * camera.half_width / scene.spot_radius.max())
    size = 2 * enlarged * scene.spot_radius[order]
    axes.add_collection(
        EllipseCollection(
            size,
            size,
            np.zeros_like(size),
            units="xy",
            offsets=camera.project(scene.spots)[order, :2],
            offset_transform=axes.transData,
            facecolors=SPOT_COLOUR,
            edgecolors="white",
            linewidths=0.5,
            alpha=0.8,
            zorder=4,
        )
    )


def draw_frame(axes: Axes, camera: Camera) -> None:
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
    factor, unit = engineering(np.array([bar]), "m")
    right, bottom = 0.8 * camera.half_width, -0.35 * half_height
    axes.plot([right - bar, right], [bottom, bottom], color="#404040", linewidth=2.5, solid_capstyle="butt")
    axes.text(right - bar / 2, bottom + 0.12 * half_height, f"{bar * factor:g} {unit}",
              ha="center", va="bottom", color="#404040", fontsize="small")  # fmt: skip
