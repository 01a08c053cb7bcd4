"""Segments, their distances, and the room between the wires of a model."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..kernels import contact_search
from ..model import Model
from ..wires.chains import find_wires
from ..wires.curves import element_curves, hermite, hermite_slope

#: Significant digits of a coordinate, counted from the size of the model
_DIGITS = 7
#: Turns of the search for the closest points of two curves, each of which leaves a small part of the error
_TURNS = 12


def sides(size: Sequence[float], axes: str, what: str) -> NDArray[np.float64]:
    """The sides of a box along some axes [m]."""
    if np.shape(size) != (len(axes),):
        names = f"{', '.join(axes[:-1])} and {axes[-1]}"
        raise ValueError(
            f"size of {what}: its lengths along {names}, as ({', '.join(['1e-3'] * len(axes))}); found {size!r}"
        )
    return np.array(size, dtype=float)


def rounded(x: ArrayLike, size: float) -> NDArray[np.float64]:
    """Coordinates [m] as decimals of seven digits for the given size [m], so that the deck is readable."""
    return np.round(np.asarray(x, dtype=float), _DIGITS - 1 - math.floor(math.log10(size))) + 0.0


def end_distance(a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> NDArray[np.float64]:
    """Smallest distance of an end of the segments ab and cd from the other one, (n) [m].

    Parameters
    ----------
    a, b, c, d : (n, k) arrays
        End points in k dimensions [m].
    """
    a, b, c, d = (np.atleast_2d(np.asarray(point, dtype=float)) for point in (a, b, c, d))
    return np.minimum.reduce(
        [_point_distance(a, c, d), _point_distance(b, c, d), _point_distance(c, a, b), _point_distance(d, a, b)]
    )


def segment_distance(a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> NDArray[np.float64]:
    """Distance between the segments ab and cd, (n) [m].

    The smallest of the distances of each end from the other segment and, where the common normal of the lines meets
    both segments, its length.

    Parameters
    ----------
    a, b, c, d : (n, k) arrays
        End points in k dimensions [m].
    """
    a, b, c, d = (np.atleast_2d(np.asarray(point, dtype=float)) for point in (a, b, c, d))
    u, v, w = b - a, d - c, a - c
    uu, uv, vv = _dot(u, u), _dot(u, v), _dot(v, v)
    uw, vw = _dot(u, w), _dot(v, w)
    determinant = uu * vv - uv**2
    crossing = determinant > 1e-14 * uu * vv
    safe = np.where(crossing, determinant, 1.0)
    s, t = (uv * vw - vv * uw) / safe, (uu * vw - uv * uw) / safe
    inside = crossing & (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
    between = np.linalg.norm(w + s[:, None] * u - t[:, None] * v, axis=1)
    return np.minimum(end_distance(a, b, c, d), np.where(inside, between, np.inf))


def crossing_angle(u: ArrayLike, v: ArrayLike) -> NDArray[np.float64]:
    """Angle between lines of the directions u and v, 0 to pi/2, (n) [rad]."""
    u, v = np.atleast_2d(np.asarray(u, dtype=float)), np.atleast_2d(np.asarray(v, dtype=float))
    return np.arccos(np.clip(np.abs(_dot(u, v)) / np.linalg.norm(u, axis=1) / np.linalg.norm(v, axis=1), 0, 1))


def clip_line(point: ArrayLike, direction: ArrayLike, size: ArrayLike) -> tuple[NDArray, NDArray]:
    """The part of a line inside the box from the origin to `size`: its two ends.

    Parameters
    ----------
    point, direction, size : (k,) arrays
        A point inside the box [m], the direction of the line, the opposite corner of the box [m].
    """
    point, direction, size = (np.asarray(value, dtype=float) for value in (point, direction, size))
    with np.errstate(divide="ignore", invalid="ignore"):
        to_walls = np.stack([-point / direction, (size - point) / direction])
    to_walls[:, direction == 0] = [[-np.inf], [np.inf]]
    return point + to_walls.min(axis=0).max() * direction, point + to_walls.max(axis=0).min() * direction


def smallest_gap(model: Model, *, within: float | None = None, parts: int = 1) -> float:
    """Smallest distance between the surfaces of two wires of a model; negative where they overlap [m].

    Parameters
    ----------
    model : Model
        Wires, each with its smooth (Hermite) axis.
    within : float, optional
        Distances above this are not looked for [m]; the mean radius when left out.
    parts : int
        Pieces per element by which places that are near are found. With 1 the axes are taken as straight from node to node,
        otherwise as smooth; the distance of two pieces is then that of their curves.

    Returns
    -------
    float
        The distance, or infinity where none is below `within`. Pieces of one wire are not compared.
    """
    radius = np.repeat(model.radius, parts)
    wire = np.repeat(model.wire_of_element, parts)
    nodes = _points_on_axes(model, parts)
    starts, ends = nodes[:, :-1].reshape(-1, 3), nodes[:, 1:].reshape(-1, 3)
    within = float(radius.mean()) if within is None else within
    pieces = np.arange(2 * len(starts)).reshape(2, -1).T
    bulge = _bulge(nodes)
    pairs = contact_search(np.concatenate([starts, ends]), pieces, radius, skin=within + bulge)
    i, j = pairs[wire[pairs[:, 0]] != wire[pairs[:, 1]]].T
    if not len(i):
        return math.inf
    gap = segment_distance(starts[i], ends[i], starts[j], ends[j]) - radius[i] - radius[j]
    if parts > 1:
        near = gap <= gap.min() + 2 * bulge
        i, j = i[near], j[near]
        gap = _curve_distance(model, parts, i, j) - radius[i] - radius[j]
    return float(gap.min())


def _bulge(nodes: NDArray) -> float:
    """What the distances of straight pieces and of their curves differ by at most [m].

    A piece deviates by an eighth of its second difference, in either wire; twice that, for curves of uneven curvature.
    """
    return float(np.linalg.norm(np.diff(nodes, 2, axis=1), axis=-1).max(initial=0.0)) / 2


def _curve_distance(model: Model, parts: int, i: NDArray, j: NDArray) -> NDArray[np.float64]:
    """Distance of the smooth axes of pieces i and j, (n) [m], by the method of Gauss and Newton within the pieces."""
    positions, slopes = _curves(model.x, model.connectivity)
    pieces = np.stack([i, j])
    low = -1 + 2 / parts * (pieces % parts)
    xi = low + 1 / parts
    curves = [(positions[k // parts], slopes[k // parts]) for k in (i, j)]
    for _ in range(_TURNS):
        gap = hermite(*curves[0], xi[0]) - hermite(*curves[1], xi[1])
        u, v = (hermite_slope(*curve, at) for curve, at in zip(curves, xi, strict=True))
        # side by side the closest points may slide along: the small addition holds them
        uu, uv, vv = 1.001 * _dot(u, u), _dot(u, v), 1.001 * _dot(v, v)
        down, up = -_dot(gap, u), _dot(gap, v)
        # where one of the curves ends the other follows, as for straight segments
        step = (vv * down + uv * up) / (uu * vv - uv**2)
        for _ in range(2):
            first = np.clip(xi[0] + step, low[0], low[0] + 2 / parts)
            second = np.clip(xi[1] + (up + uv * (first - xi[0])) / vv, low[1], low[1] + 2 / parts)
            step = (down + uv * (second - xi[1])) / uu
        xi = np.stack([first, second])
    return np.linalg.norm(hermite(*curves[0], xi[0]) - hermite(*curves[1], xi[1]), axis=1)


def _points_on_axes(model: Model, parts: int) -> NDArray[np.float64]:
    """Points of the axis of each element, (m, parts + 1, 3)."""
    return model.x[model.connectivity] if parts == 1 else smooth_axis(model.x, model.connectivity, parts)


def smooth_axis(x: NDArray, connectivity: NDArray, parts: int) -> NDArray[np.float64]:
    """Points of the Hermite axis of each element, which divide it into parts, (m, parts + 1, 3) [m]."""
    curves = _curves(x, connectivity)
    along = np.linspace(-1, 1, parts + 1)
    return np.stack([hermite(*curves, np.full(len(connectivity), xi)) for xi in along], axis=1)


def _curves(x: NDArray, connectivity: NDArray) -> tuple[NDArray, NDArray]:
    """Positions of the ends of each element and slopes of its axis there."""
    still = np.zeros_like(x)
    return element_curves(x, still, still, find_wires(connectivity), len(connectivity))


def _dot(u: NDArray, v: NDArray) -> NDArray:
    return np.sum(u * v, axis=1)


def _point_distance(point: NDArray, start: NDArray, end: NDArray) -> NDArray:
    """Distance of points from segments."""
    along = end - start
    share = np.clip(_dot(point - start, along) / np.maximum(_dot(along, along), np.finfo(float).tiny), 0, 1)
    return np.linalg.norm(point - start - share[:, None] * along, axis=1)
