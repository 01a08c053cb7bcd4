"""Wires whose sections are not round, as their outlines swept along the axes."""

import itertools
from dataclasses import dataclass

import numpy as np

from ..results import Results
from ..wires.chains import Wire
from ..wires.curves import element_curves, rotate
from .tube_mesh import Mesh, tangents


@dataclass(frozen=True)
class Frames:
    """Section axes of a line along a wire.

    Attributes
    ----------
    outline : ndarray
        Corners along the two section axes, from the axis of the wire, anticlockwise (k, 2) [m].
    first : ndarray
        About the first section axis at the points of the line, (n, 3).
    sign : int
        -1 where the elements run against the line, else 1.
    """

    outline: np.ndarray
    first: np.ndarray
    sign: int

    @property
    def reach(self) -> float:
        """Distance of the farthest corner from the axis [m]."""
        return float(np.linalg.norm(self.outline, axis=1).max())


def reach_of_sections(results: Results) -> float:
    """How far any section reaches from the axis of its wire [m]."""
    corners = [np.linalg.norm(outline.corners, axis=1).max() for outline in results.section_outlines.values()]
    return float(max([results.radius.max(), *corners]))


def lines_of_one_section(results: Results) -> tuple[list[Wire], list[int]]:
    """The wires, divided where their section changes, if any section has an outline; with the section of each, 0: it is round."""
    outlines = results.section_outlines
    if not outlines:
        return results.wires, [0] * len(results.wires)
    number = np.where(np.isin(results.sections, list(outlines)), results.sections, 0)
    lines: list[Wire] = []
    for wire in results.wires:
        kind = np.stack([number[wire.elements], wire.signs * (number[wire.elements] > 0)], axis=1)
        cuts = [0, *(np.flatnonzero(np.any(np.diff(kind, axis=0) != 0, axis=1)) + 1), len(wire.elements)]
        for begin, stop in itertools.pairwise(cuts):
            lines.append(Wire(wire.nodes[begin : stop + 1], wire.elements[begin:stop], wire.signs[begin:stop]))
    return lines, [int(number[line.elements[0]]) for line in lines]


def first_axes(results: Results, rotation: np.ndarray) -> np.ndarray:
    """First section axes at both ends of the elements, which turn with the nodes; zero for round sections, (n_elements, 2, 3)."""
    still = np.zeros_like(results.nodes)
    _, slopes = element_curves(results.nodes, still, still, results.wires, len(results.elements))
    along = slopes / np.linalg.norm(slopes, axis=2, keepdims=True)
    axes = np.zeros_like(slopes)
    for section, outline in results.section_outlines.items():
        axes[results.sections == section] = outline.first_axis
    axes = axes - np.sum(axes * along, axis=2, keepdims=True) * along
    axes /= np.maximum(np.linalg.norm(axes, axis=2, keepdims=True), np.finfo(float).tiny)
    return rotate(axes.reshape(-1, 3), rotation[results.elements.ravel()]).reshape(axes.shape)


def prism(points: np.ndarray, frames: Frames, least: float) -> Mesh:
    """An outline along the points (n, 3) of a line, with flat sides and ends, enlarged so that it reaches `least` [m]."""
    along = tangents(points, np.zeros(1, dtype=int))
    first = frames.first - np.sum(frames.first * along, axis=1, keepdims=True) * along
    # zero where the ends are turned against each other
    first /= np.maximum(np.linalg.norm(first, axis=1, keepdims=True), np.finfo(float).tiny)
    second = frames.sign * np.cross(along, first)

    def across(parts: np.ndarray) -> np.ndarray:
        """Vectors with parts along both axes (m, 2) at each point, (n, m, 3)."""
        return parts[:, 0, None] * first[:, None] + parts[:, 1, None] * second[:, None]

    outline = max(1.0, least / frames.reach) * frames.outline
    edges = np.roll(outline, -1, axis=0) - outline
    outward = np.stack([edges[:, 1], -edges[:, 0]], axis=1) / np.linalg.norm(edges, axis=1, keepdims=True)
    corners = points[:, None] + across(outline)
    n, k = corners.shape[:2]
    # each side has corners of its own, as its normal is
    sides = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(n, 2 * k, 3)
    normals = np.repeat(across(outward), 2, axis=1)
    here = 2 * k * np.arange(n - 1)[:, None] + 2 * np.arange(k)
    ends = np.concatenate([corners[0], corners[-1]])
    of_ends = np.repeat(np.stack([-along[0], along[-1]]), k, axis=0)
    caps = triangles_of(outline)
    return Mesh(
        np.concatenate([sides.reshape(-1, 3), ends]),
        np.concatenate([normals.reshape(-1, 3), of_ends]),
        np.concatenate([np.repeat(np.arange(n), 2 * k), np.repeat([0, n - 1], k)]),
        np.concatenate(
            [
                np.stack([here, here + 1, here + 2 * k + 1], axis=2).reshape(-1, 3),
                np.stack([here, here + 2 * k + 1, here + 2 * k], axis=2).reshape(-1, 3),
                2 * k * n + caps,
                2 * k * n + k + caps,
            ]
        ).astype(np.int32),
    )


def triangles_of(outline: np.ndarray) -> np.ndarray:
    """Rows of the corners of triangles that fill an anticlockwise outline (k, 2): corners are cut off, (k - 2, 3)."""
    rest, found = list(range(len(outline))), []
    while len(rest) > 3:
        for place in range(len(rest)):
            before, here, after = rest[place - 1], rest[place], rest[(place + 1) % len(rest)]
            others = [row for row in rest if row not in (before, here, after)]
            if _is_free(outline[[before, here, after]], outline[others]):
                found.append((before, here, after))
                del rest[place]
                break
        else:
            break
    return np.array([*found, tuple(rest[:3])])


def _is_free(triangle: np.ndarray, others: np.ndarray) -> bool:
    """A triangle runs anticlockwise, and none of other points (n, 2) lies within it or on its edges."""

    def left_of(points: np.ndarray) -> np.ndarray:
        along, aside = np.roll(triangle, -1, axis=0) - triangle, points[:, None] - triangle
        return along[:, 0] * aside[..., 1] - along[:, 1] * aside[..., 0]

    return bool(left_of(triangle[2:])[0, 0] > 0 and not np.all(left_of(others) >= 0, axis=1).any())
