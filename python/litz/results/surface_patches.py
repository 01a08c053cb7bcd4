"""The parts of endless rigid surfaces that pictures show: as large as the wires need them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from .result_file import ResultFile
from .rigid_surfaces import SurfaceShape

#: Increments at most whose wires a patch is made for
_MAX_LOOKS = 20
#: Margin around the wires, over their extent along the surface, and over the largest radius
_MARGIN, _MARGIN_IN_RADII = 0.06, 2.0
#: Smaller over larger side of a patch, at least
_MIN_ASPECT = 0.3
#: Sides of a full cylinder, and of a sector at least
_N_SIDES, _MIN_SIDES = 96, 24
#: A cylinder whose radius is larger than this part of the extent of the wires is shown as a sector
_MAX_FULL_RADIUS = 1.0


@dataclass(frozen=True)
class Patch:
    """A part of a rigid surface.

    Attributes
    ----------
    surface : SurfaceShape
        The surface.
    points : ndarray
        Its corners before any deformation, (n, 3) [m].
    quads : ndarray
        Rows of `points` at the corners of each face, (m, 4).
    rim : ndarray
        Rows of `points` at the ends of each line along the edge, (k, 2).
    """

    surface: SurfaceShape
    points: np.ndarray
    quads: np.ndarray
    rim: np.ndarray

    def moved(self, results: ResultFile, increment: int, scale: float = 1.0) -> np.ndarray:
        """The corners at an increment, with displacements times `scale`, (n, 3) [m]."""
        return self.points + scale * (self.surface.moved(results, self.points, increment) - self.points)


def surface_patches(results: ResultFile, increments: list[int]) -> list[Patch]:
    """Patches of all rigid surfaces, each as large as the wires come to lie beside it at the increments."""
    if not results.rigid_surfaces:
        return []
    rows = np.unique(results.elements)
    looks = increments[:: max(1, len(increments) // _MAX_LOOKS)] + increments[-1:]
    radius = results.radius.max()
    patches = []
    for surface in results.rigid_surfaces.values():
        seen = [surface.brought_back(results, results.positions(k)[rows], k) for k in looks]
        patches.append(patch_around(surface, np.concatenate(seen), radius))
    return patches


def patch_around(surface: SurfaceShape, seen: np.ndarray, radius: float) -> Patch:
    """A patch of a surface beside points (n, 3) of wires of a radius, as seen from the surface [m]."""
    margin = _MARGIN_IN_RADII * radius
    first, second = _perpendicular(surface.direction)
    arms = seen - surface.point
    if surface.shape == "PLANE":
        (u0, u1), (v0, v1) = _widened(arms @ first, margin), _widened(arms @ second, margin)
        (u0, u1), (v0, v1) = _not_thin((u0, u1), v1 - v0), _not_thin((v0, v1), u1 - u0)
        corners = [u * first + v * second for v in (v0, v1) for u in (u0, u1)]
        return _grid(surface, surface.point + np.array(corners), 2, closed=False)
    along = _widened(arms @ surface.direction, margin)
    extent = float(np.linalg.norm(np.ptp(seen, axis=0)))
    along = _not_thin(along, min(2 * surface.radius, extent))
    is_full = surface.radius <= _MAX_FULL_RADIUS * extent
    angles = np.linspace(0, 2 * np.pi, _N_SIDES + 1)[:-1]
    if not is_full:
        angles = _sector(np.arctan2(arms @ second, arms @ first), margin / surface.radius, extent / surface.radius)
    circle = surface.radius * (np.outer(np.cos(angles), first) + np.outer(np.sin(angles), second))
    points = surface.point + np.concatenate([circle + at * surface.direction for at in along])
    return _grid(surface, points, len(angles), closed=is_full)


def _perpendicular(direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors across a direction, the first one near an axis of coordinates."""
    axis = np.eye(3)[np.argmin(np.abs(direction).round(9))]
    first = axis - direction * (direction @ axis)
    first /= np.linalg.norm(first)
    return first, np.cross(direction, first)


def _widened(values: np.ndarray, margin: float) -> tuple[float, float]:
    edge = margin + _MARGIN * float(np.ptp(values))
    return float(values.min()) - edge, float(values.max()) + edge


def _not_thin(span: tuple[float, float], other: float) -> tuple[float, float]:
    """A side that is not much smaller than the other one."""
    middle, half = (span[0] + span[1]) / 2, max(span[1] - span[0], _MIN_ASPECT * other) / 2
    return middle - half, middle + half


def _sector(angles: np.ndarray, margin: float, extent: float) -> np.ndarray:
    """The angles of a sector that has all those given, (n)."""
    middle = np.arctan2(np.sin(angles).mean(), np.cos(angles).mean())
    away = np.abs((angles - middle + np.pi) % (2 * np.pi) - np.pi).max()
    half = min(np.pi, max(1.1 * away + margin, _MIN_ASPECT * extent / 2))
    return middle + np.linspace(-half, half, max(_MIN_SIDES, round(_N_SIDES * half / np.pi)) + 1)


def _grid(surface: SurfaceShape, points: np.ndarray, n: int, *, closed: bool) -> Patch:
    """A band between two rows of n points."""
    turns = [*pairwise(range(n)), *([(n - 1, 0)] if closed else [])]
    quads = [(a, b, b + n, a + n) for a, b in turns]
    rim = [(a + row, b + row) for row in (0, n) for a, b in turns]
    sides = [] if closed else [(0, n), (n - 1, 2 * n - 1)]
    return Patch(surface, points, np.array(quads), np.array(rim + sides))
