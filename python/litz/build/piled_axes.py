"""Smooth axes of wires over straight lines in a plane: each in the upright plane through its line, as the program has it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..wires.curves import MAX_BEND

#: Elements for which there is room at first, and wires
_ROOM = 1024


class Axes:
    """Hermite axes of wires, each of elements that are equally long seen from above.

    Places are numbers of elements along a wire: 2.5 is the middle of the third one.
    """

    def __init__(self) -> None:
        # of each element: way and height of both ends, and their derivatives there by half the number of elements
        self._elements, self._n_elements = np.empty((8, _ROOM)), 0
        # of each wire: its first element, and how many it has
        self._wires, self._n_wires = np.empty((2, _ROOM), dtype=int), 0

    def __len__(self) -> int:
        return self._n_wires

    def counts(self, wires: NDArray) -> NDArray[np.int64]:
        """Number of elements of wires."""
        return self._wires[1, wires]

    def add(self, length: float, heights: NDArray) -> None:
        """One more wire, of a length seen from above [m], with these heights of its nodes [m]."""
        n = len(heights) - 1
        while self._n_elements + n > self._elements.shape[1]:
            self._elements = np.concatenate([self._elements, np.empty_like(self._elements)], axis=1)
        if self._n_wires == self._wires.shape[1]:
            self._wires = np.concatenate([self._wires, np.empty_like(self._wires)], axis=1)
        self._elements[:, self._n_elements : self._n_elements + n] = curve(length, heights)
        self._wires[:, self._n_wires] = self._n_elements, n
        self._n_elements += n
        self._n_wires += 1

    def at(self, wires: NDArray, element: NDArray, places: NDArray) -> NDArray[np.float64]:
        """Ways, heights, and the derivatives of both by the place, (4, n) [m], in elements of wires."""
        return along(self._elements[:, self._wires[0, wires] + element], places - element)

    def heights(self, wires: NDArray, parts: NDArray) -> NDArray[np.float64]:
        """Heights alone at parts of the lengths, (n) [m]."""
        first, n = self._wires[:, wires]
        places = n * parts
        element = np.minimum(places.astype(int), n - 1)
        return _value(self._elements[4:, first + element], 2 * (places - element) - 1)


def curve(length: float, heights: NDArray) -> NDArray[np.float64]:
    """What the axis of a wire needs, (8, elements): both ends of each, the way and the height, with their derivatives by xi.

    The tangents are those of `wires.curves.end_tangents`: of parabolas in the upright plane, and of the chords where the
    wire has a kink.
    """
    n = len(heights) - 1
    step = length / n
    chord = np.sqrt(step**2 + np.diff(heights) ** 2)
    # along the wire and upwards
    unit = np.array([step / chord, np.diff(heights) / chord])
    tangents = np.stack([unit, unit])
    if n > 1:
        before, after = unit[:, :-1], unit[:, 1:]
        mean = before * chord[1:] + after * chord[:-1]
        mean /= np.sqrt((mean**2).sum(axis=0))
        smooth = (before * after).sum(axis=0) >= np.cos(MAX_BEND)
        tangents[1, :, :-1] = np.where(smooth, mean, before)
        tangents[0, :, 1:] = np.where(smooth, mean, after)
    # the circle through the end continues the curve
    for element, end in ((0, 0), (n - 1, 1)):
        inner = tangents[1 - end, :, element]
        tangents[end, :, element] = 2 * (unit[:, element] @ inner) * unit[:, element] - inner
    slopes = tangents * (chord / 2)
    ways = step * np.arange(n + 1)
    return np.array(
        [ways[:-1], ways[1:], slopes[0, 0], slopes[1, 0], heights[:-1], heights[1:], slopes[0, 1], slopes[1, 1]]
    )


def along(ends: NDArray, part: NDArray) -> NDArray[np.float64]:
    """Ways, heights, and the derivatives of both by the part of an element, (4, n) [m], from its columns of `curve`, (8, n)."""
    xi = 2 * part - 1
    return np.array([_value(ends[:4], xi), _value(ends[4:], xi), _slope(ends[:4], xi), _slope(ends[4:], xi)])


def _value(ends: NDArray, xi: NDArray) -> NDArray[np.float64]:
    """Hermite's cubic of the values and slopes at both ends, (4, n)."""
    first, last, slope_first, slope_last = ends
    inner = 1 - xi * xi
    middle = (first + last) / 2 + (slope_first - slope_last) * inner / 4
    return middle + (last - first) * xi * (3 - xi * xi) / 4 - (slope_first + slope_last) * xi * inner / 4


def _slope(ends: NDArray, xi: NDArray) -> NDArray[np.float64]:
    """Its derivative by the place, which grows by one where xi grows by two."""
    first, last, slope_first, slope_last = ends
    rise = 1.5 * (last - first) * (1 - xi * xi)
    return rise - (slope_first - slope_last) * xi - (slope_first + slope_last) * (1 - 3 * xi * xi) / 2
