"""Triangles of tubes with round joints and round ends, and of flat marks that face the viewer."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Two pieces that meet at a sharper angle have a round joint between them [rad]
_KINK = np.radians(20.0)
#: Rings of a half sphere: angles from its rim to its pole [rad]
_CAP = np.radians([18.0, 36.0, 54.0, 70.0, 82.0, 90.0])


@dataclass(frozen=True)
class Mesh:
    """Triangles.

    Attributes
    ----------
    points : ndarray
        Corners, (n, 3) [m].
    normals : ndarray
        Unit outward normals at the corners, (n, 3).
    source : ndarray
        The point of the lines that each corner belongs to, (n).
    triangles : ndarray
        Rows of the corners of each triangle, (m, 3).
    """

    points: np.ndarray
    normals: np.ndarray
    source: np.ndarray
    triangles: np.ndarray


def tubes(points: np.ndarray, starts: np.ndarray, radius: np.ndarray, sides: int, kind: type = float) -> Mesh:
    """Round tubes along lines.

    Parameters
    ----------
    points : ndarray
        Of all lines, one line after the other, (n, 3) [m].
    starts : ndarray
        First point of each line, and n at the end.
    radius : ndarray
        At the points, (n) [m].
    sides : int
        Corners of a ring around a point.
    kind : type
        Of the numbers of corners and normals; large pictures take half the memory with `numpy.float32`.
    """
    source, first = _smooth_lines(points, starts)
    along = tangents(points[source], first)
    across, third = _untwisted(along)
    begin, stop = first, np.append(first[1:], len(source))
    n_cap = len(_CAP)
    rows = np.concatenate([np.r_[[a] * n_cap, a:b, [b - 1] * n_cap] for a, b in zip(begin, stop, strict=True)])
    angle = np.concatenate([np.r_[-_CAP[::-1], np.zeros(b - a), _CAP] for a, b in zip(begin, stop, strict=True)])
    phase = 2 * np.pi * np.arange(sides) / sides
    # side by side, without copies: these are the large arrays of pictures of many wires
    normals: NDArray[Any] = np.empty((len(rows), sides, 3), dtype=kind)
    corners = np.empty_like(normals)
    shrunk, beyond = np.cos(angle)[:, None], np.sin(angle)[:, None] * along[rows]
    size, centres = radius[source[rows]][:, None], points[source[rows]]
    for side, turn in enumerate(phase):
        outward = shrunk * (np.cos(turn) * across[rows] + np.sin(turn) * third[rows]) + beyond
        normals[:, side] = outward
        corners[:, side] = centres + size * outward
    ring_ends = np.cumsum(stop - begin + 2 * n_cap) - 1
    inner = np.ones(len(rows), dtype=bool)
    inner[ring_ends] = False
    return Mesh(corners.reshape(-1, 3), normals.reshape(-1, 3), np.repeat(source[rows], sides),
                _between_rings(np.flatnonzero(inner), sides))  # fmt: skip


def _between_rings(rings: np.ndarray, sides: int) -> np.ndarray:
    """Two triangles at each side between each of some rings and the one behind it."""
    here = np.arange(sides, dtype=np.int32)
    beside = (here + 1) % sides
    pair = np.stack([here, beside, beside + sides, here, beside + sides, here + sides], axis=1).reshape(-1, 3)
    return (sides * rings.astype(np.int32)[:, None, None] + pair).reshape(-1, 3)


def _smooth_lines(points: np.ndarray, starts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points of lines without kinks and without steps of no length: their rows, and the first of each line among these."""
    line = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    step = np.linalg.norm(np.diff(points, axis=0), axis=1)
    kept = np.flatnonzero(np.concatenate([[True], (step > 0) | (np.diff(line) > 0)]))
    line, chords = line[kept], np.diff(points[kept], axis=0)
    chords /= np.maximum(np.linalg.norm(chords, axis=1, keepdims=True), np.finfo(float).tiny)
    inside = np.flatnonzero((line[1:-1] == line[:-2]) & (line[1:-1] == line[2:])) + 1
    kinks = inside[np.sum(chords[inside - 1] * chords[inside], axis=1) < np.cos(_KINK)]
    order = np.sort(np.concatenate([np.arange(len(kept)), kinks]))
    is_first = np.diff(line[order], prepend=-1) > 0
    # the second of the two that a kink has become
    is_first[1:] |= np.diff(order) == 0
    return kept[order], np.flatnonzero(is_first)


def tangents(points: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Unit tangents of lines at their points, (n, 3)."""
    chords = np.diff(points, axis=0)
    between = first[1:] - 1
    chords[between] = 0.0
    along = np.zeros_like(points)
    along[:-1] += chords
    along[1:] += chords
    length = np.linalg.norm(along, axis=1, keepdims=True)
    # a line that is one point only
    along[length[:, 0] == 0] = (1.0, 0.0, 0.0)
    return along / np.where(length > 0, length, 1.0)


def _untwisted(along: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors across unit tangents (n, 3), which follow them from one to the next without turning about them.

    Where the reference directions of two neighbours, taken by themselves, differ by an angle after the smallest rotation of one
    tangent into the other, the sum of the angles so far is turned back.
    """
    reference = np.eye(3)[np.argmin(np.abs(along), axis=1)]
    across = reference - np.sum(reference * along, axis=1, keepdims=True) * along
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    third = np.cross(along, across)
    here, there = along[:-1], along[1:]
    cosine = np.sum(here * there, axis=1, keepdims=True)
    lean = np.sum(across[:-1] * there, axis=1, keepdims=True)
    carried = across[:-1] - lean / np.maximum(1 + cosine, 1e-12) * (here + there)
    angle = np.arctan2(np.sum(carried * third[1:], axis=1), np.sum(carried * across[1:], axis=1))
    total = np.concatenate([[0.0], np.cumsum(angle)])[:, None]
    first = np.cos(total) * across + np.sin(total) * third
    return first, np.cross(along, first)


def discs(centres: np.ndarray, first: np.ndarray, second: np.ndarray, sides: int) -> tuple[np.ndarray, np.ndarray]:
    """Ellipses with the given half axes, each (n, 3): corners (n, sides, 3) and triangles (m, 3)."""
    phase = 2 * np.pi * np.arange(sides) / sides
    corners = np.empty((len(centres), sides, 3), dtype=np.float32)
    for side, turn in enumerate(phase):
        corners[:, side] = centres + np.cos(turn) * first + np.sin(turn) * second
    fan = np.stack([np.zeros(sides - 2), np.arange(1, sides - 1), np.arange(2, sides)], axis=1).astype(np.int32)
    return corners, (sides * np.arange(len(centres), dtype=np.int32)[:, None, None] + fan).reshape(-1, 3)
