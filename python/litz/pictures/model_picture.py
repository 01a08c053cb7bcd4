"""A model as a notebook shows it: a small picture of its wires before any deformation, with what holds and loads them."""

import base64
import html
import io
import math
from collections.abc import Iterator
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..model.description import COLOUR_MAP, N_COLOURS, length_unit
from ..model.loaded_model import LoadedModel
from ..model.loading import Load, Prescribed
from ..results.rigid_surfaces import SurfaceShape
from ..results.surface_patches import patch_around
from ..wires.chains import find_wires
from ..wires.curves import element_curves
from .contact_marks import Spots
from .plots import STYLE
from .scene import Scene, aim, along_wires, sample_wires
from .wire_picture import draw_frame, draw_wires

#: Width and height [inches], and pixels per inch
_SIZE, _DPI = (5.0, 3.6), 160
#: Part of the height that is of the wires; legend, directions and scale are below
_WIRES_HEIGHT, _FRAME_HEIGHT = 0.8, 0.14
#: Space for the marks, as a part of the extent of the model
_MARGIN = 0.03
#: Points of the wires, and marks of each kind, at most
_MAX_POINTS, _MAX_MARKS = 8_000, 2_000
#: Up to this number of marks these have their full size; more are smaller, down to a part of it
_FULL_SIZE, _SMALLEST = 40, 0.2
#: Degrees of freedom of each kind
_MECHANICAL, _ELECTRICAL = range(1, 7), 9
# The larger marks come first, so that those of a node with several are all seen
_MARKS: dict[str, dict[str, Any]] = {
    "potential or current": {
        "marker": "o",
        "markersize": 9,
        "markerfacecolor": "#f2c12e",
        "markeredgecolor": "#6b5208",
    },
    "temperature or heat": {"marker": "D", "markersize": 7, "markerfacecolor": "#e8502a", "markeredgecolor": "#6b2008"},
    "moved or loaded": {"marker": "^", "markersize": 6, "markerfacecolor": "white", "markeredgecolor": "black"},
    "held": {"marker": "s", "markersize": 3, "markerfacecolor": "black", "markeredgecolor": "black"},
}


def frame(model: LoadedModel) -> str | None:
    """The picture as an element of HTML, which needs no other file; None for a model without elements."""
    if not model.groups:
        return None
    with mpl.rc_context(STYLE):
        data = base64.b64encode(_drawn(model)).decode()
    return (
        f'<img src="data:image/png;base64,{data}" alt="wires of {html.escape(model.title, quote=True)}" '
        f'width="{round(100 * _SIZE[0])}">'
    )


def _drawn(model: LoadedModel) -> bytes:
    """The picture as PNG of 256 colours."""
    scene = model_scene(model)
    figure = Figure(figsize=_SIZE, dpi=_DPI)
    axes = figure.add_axes((0, 1 - _WIRES_HEIGHT, 1, _WIRES_HEIGHT))
    marks = {kind: list(nodes)[:: 1 + len(nodes) // _MAX_MARKS] for kind, nodes in marked_nodes(model).items()}
    shown = [scene.outline, *(model.x[np.array(nodes) - 1] for nodes in marks.values())]
    outline = np.concatenate(shown)
    margin = scene.radius.max() + _MARGIN * float(np.ptp(outline, axis=0).max())
    camera = aim(outline, margin, _SIZE[0] / (_WIRES_HEIGHT * _SIZE[1]))
    draw_wires(axes, scene, camera, None)
    size = float(np.clip(math.sqrt(_FULL_SIZE / max(1, sum(map(len, marks.values())))), _SMALLEST, 1.0))
    for kind, nodes in marks.items():
        places = camera.project(model.x[np.array(nodes) - 1])
        style = {**_MARKS[kind], "markersize": size * _MARKS[kind]["markersize"], "markeredgewidth": size}
        axes.plot(places[:, 0], places[:, 1], linestyle="", zorder=5, **style)
    # to the left, as the letter at an arrow would be cut off
    draw_frame(figure.add_axes((-0.05, 0.04, 1, _FRAME_HEIGHT)), camera, scene.length_unit)
    if marks:
        figure.legend(
            handles=[Line2D([], [], linestyle="", label=kind, **_MARKS[kind]) for kind in marks],
            loc="lower left",
            bbox_to_anchor=(0.01, 0.0),
            ncols=2,
            handletextpad=0.3,
            columnspacing=1.0,
        )
    with io.BytesIO() as whole, io.BytesIO() as small:
        figure.savefig(whole, format="png", dpi="figure")
        from PIL import Image

        Image.open(whole).convert("RGB").quantize(256, dither=Image.Dither.NONE).save(small, "PNG", optimize=True)
        return small.getvalue()


def model_scene(model: LoadedModel) -> Scene:
    """The wires of a model before any deformation, each group in its colour, and its rigid surfaces."""
    groups = list(model.groups.values())
    elements = model.connectivity
    wires = find_wires(elements)
    still = np.zeros_like(model.x)
    positions, slopes = element_curves(model.x, still, still, wires, len(elements))
    per_element = int(np.clip(_MAX_POINTS // len(elements), 1, 24))
    counts = [len(group.connectivity) for group in groups]
    radius = np.repeat([group.radius for group in groups], counts)
    colour = np.repeat(np.arange(len(groups)) % N_COLOURS, counts) + 0.5
    points, starts = sample_wires(positions, slopes, wires, per_element)
    kept, starts = _thinned(starts)
    points = points[kept]

    def at_points(values: np.ndarray) -> np.ndarray:
        return along_wires(np.repeat(values[:, None], 2, axis=1), wires, per_element)[kept]

    corners, quads, rim = _surfaces(model, points, float(radius.max()))
    nothing = np.zeros(0, dtype=int)
    return Scene(
        points=points, radius=at_points(radius), value=at_points(colour), starts=starts,
        reference=np.zeros((0, 3)), reference_starts=nothing,
        surface_points=corners, surface_quads=quads, surface_rim=rim,
        spots=Spots.none(), spot_radius=np.zeros(0),
        lines=Spots.none(), line_pieces=np.zeros((0, 2), dtype=int), line_value=np.zeros(0), line_ends=nothing,
        line_title="", line_limit=0.0, title="", spot_text="", shape_text="",
        limits=(0.0, float(N_COLOURS)), colours=COLOUR_MAP, length_unit=length_unit(model),
    )  # fmt: skip


def _thinned(starts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the points that are drawn, those at the ends of wires among them, and the first one of each wire."""
    within = np.arange(starts[-1]) - np.repeat(starts[:-1], np.diff(starts))
    is_kept = within % math.ceil(starts[-1] / (2 * _MAX_POINTS)) == 0
    is_kept[starts[1:] - 1] = True
    kept = np.flatnonzero(is_kept)
    return kept, np.searchsorted(kept, starts)


def _surfaces(model: LoadedModel, points: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Corners, faces and edges of the parts of rigid surfaces that are beside the wires."""
    corners, quads, rims = [np.zeros((0, 3))], [np.zeros((0, 4), dtype=int)], [np.zeros((0, 2), dtype=int)]
    for one in model.surfaces.values():
        direction = np.array(one.direction) / np.linalg.norm(one.direction)
        shape = SurfaceShape(
            one.name, one.shape, np.array(one.point), direction, one.radius or 0.0, one.node, np.zeros((2, 1))
        )
        patch = patch_around(shape, points, radius)
        first = sum(map(len, corners))
        corners.append(patch.points)
        quads.append(first + patch.quads)
        rims.append(first + patch.rim)
    return np.concatenate(corners), np.concatenate(quads), np.concatenate(rims)


def marked_nodes(model: LoadedModel) -> dict[str, list[int]]:
    """Nodes that are held, moved, loaded, or have a potential or temperature, in any step; in the order of `_MARKS`."""
    found: dict[str, dict[int, None]] = {kind: {} for kind in _MARKS}
    for kind, item in _conditions(model):
        found[kind] |= dict.fromkeys(model.nodes_of(item.target))
    return {kind: list(nodes) for kind, nodes in found.items() if nodes}


def _conditions(model: LoadedModel) -> Iterator[tuple[str, Prescribed | Load]]:
    """What is prescribed or applied at nodes, and which mark it has."""
    for item in [*model.supports, *(one for step in model.steps for one in step.prescribed)]:
        for dof in range(item.first, item.last + 1):
            yield _kind(dof, "moved or loaded" if item.value else "held"), item
    for step in model.steps:
        for load in step.loads:
            yield _kind(load.dof, "moved or loaded"), load


def _kind(dof: int, mechanical: str) -> str:
    if dof in _MECHANICAL:
        return mechanical
    return "potential or current" if dof == _ELECTRICAL else "temperature or heat"
