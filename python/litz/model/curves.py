"""Nodes of wires along straight lines, polygons, splines and curves given as functions."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Chords on each element when the length of a curve is measured
_CHORDS = 64


def check_points(points: ArrayLike, min_count: int = 2) -> NDArray[np.float64]:
    """Points as an array (n, 3) [m]; those of a plane get z = 0."""
    try:
        array = np.array(points, dtype=float)
    except (TypeError, ValueError):
        raise ValueError("points must be numbers, an array of shape (n, 3)") from None
    if array.ndim == 2 and array.shape[1] == 2:
        array = np.column_stack([array, np.zeros(len(array))])
    if array.ndim != 2 or array.shape[1] != 3 or len(array) < min_count:
        raise ValueError(f"points must be an array of shape (n, 3) with n of {min_count} or more, not {array.shape}")
    if not np.isfinite(array).all():
        raise ValueError("points must be finite numbers")
    if not np.linalg.norm(np.diff(array, axis=0), axis=1).all():
        raise ValueError("two successive points coincide")
    return array


def check_elements(elements: object) -> int:
    """A number of elements."""
    if isinstance(elements, bool) or not isinstance(elements, int | np.integer) or elements < 1:
        raise ValueError(f"elements must be a whole number of 1 or more, not {elements!r}")
    return int(elements)


def straight(start: ArrayLike, end: ArrayLike, n_elements: int) -> NDArray[np.float64]:
    """Nodes of a straight wire at equal distances, (n_elements + 1, 3) [m]."""
    start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    return start + np.linspace(0, 1, n_elements + 1)[:, None] * (end - start)


def along_polyline(points: ArrayLike, n_elements: int) -> NDArray[np.float64]:
    """Nodes along a polygon, with a node at each corner; longer sides get more elements, (n_elements + 1, 3) [m].

    Examples
    --------
    >>> along_polyline([(0, 0, 0), (3, 0, 0), (3, 1, 0)], 4)[:, :2].tolist()
    [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [3.0, 1.0]]
    """
    points = check_points(points)
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    if n_elements < len(lengths):
        raise ValueError(f"a polygon of {len(lengths)} sides needs at least as many elements, not {n_elements}")
    counts = np.ones(len(lengths), dtype=int)
    for _ in range(n_elements - len(lengths)):
        counts[np.argmax(lengths / counts)] += 1
    sides = [straight(a, b, n)[:-1] for a, b, n in zip(points, points[1:], counts, strict=False)]
    return np.vstack([*sides, points[-1]])


def along_spline(points: ArrayLike, n_elements: int, *, closed: bool = False) -> NDArray[np.float64]:
    """Nodes at equal distances along a smooth curve through points, (n_elements + 1, 3) [m].

    The curve is VTK's cubic spline over the lengths of the chords; a closed one ends at its first point.
    """
    from vtkmodules.vtkCommonComputationalGeometry import vtkParametricSpline
    from vtkmodules.vtkCommonCore import vtkPoints

    points = check_points(points)
    if len(points) < 3:
        raise ValueError(f"a spline needs 3 or more points, not {len(points)}")
    if closed and np.array_equal(points[0], points[-1]):
        points = points[:-1]
    handed_over = vtkPoints()
    handed_over.SetDataTypeToDouble()
    for point in points:
        handed_over.InsertNextPoint(point)
    spline = vtkParametricSpline()
    spline.SetPoints(handed_over)
    spline.SetClosed(closed)

    def curve(t: float) -> list[float]:
        place = [0.0, 0.0, 0.0]
        spline.Evaluate([t, 0.0, 0.0], place, [0.0] * 9)
        return place

    return along_curve(curve, n_elements)


def along_curve(
    curve: Callable[[float], ArrayLike], n_elements: int, span: tuple[float, float] = (0.0, 1.0)
) -> NDArray[np.float64]:
    """Nodes at equal distances along a curve, (n_elements + 1, 3) [m].

    Parameters
    ----------
    curve : callable
        Position of a parameter, (3) [m].
    n_elements : int
        Number of elements.
    span : tuple of 2 float
        First and last value of the parameter.

    Examples
    --------
    >>> quarter = along_curve(lambda t: (math.cos(t), math.sin(t), 0), 2, span=(0, math.pi / 2))
    >>> quarter.round(6).tolist()
    [[1.0, 0.0, 0.0], [0.707107, 0.707107, 0.0], [0.0, 1.0, 0.0]]
    """
    first, last = (float(value) for value in span)
    if not (math.isfinite(first) and math.isfinite(last) and first != last):
        raise ValueError(f"span must be the first and the last parameter of the curve, not {span!r}")
    parameters = np.linspace(first, last, _CHORDS * n_elements + 1)
    chords = np.linalg.norm(np.diff(_evaluate(curve, parameters), axis=0), axis=1)
    lengths = np.concatenate([[0.0], np.cumsum(chords)])
    return _evaluate(curve, np.interp(np.linspace(0, lengths[-1], n_elements + 1), lengths, parameters))


def _evaluate(curve: Callable[[float], ArrayLike], parameters: NDArray) -> NDArray[np.float64]:
    values = []
    for parameter in parameters:
        value = np.asarray(curve(float(parameter)), dtype=float)
        if value.shape not in ((2,), (3,)):
            raise ValueError(f"a curve must return the position (x, y, z), not an array of shape {value.shape}")
        values.append(value)
    return check_points(values)
