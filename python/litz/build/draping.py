"""Wires that are laid on others and bend over them.

A wire is an elastic beam drawn to the ground by springs (Winkler's foundation): it minimises

    1/2 integral (a^4/4 z''^2 + z^2) ds     with z >= h_j where it crosses wire j below,

where `a = (4 E I/k)^(1/4)`, the reach, is the length over which it comes down from what it lies on. As in models of paper
(Niskanen et al., KCL-PAKKA, 1997), where the slope of a fibre is limited, one number says how closely wires follow
those below them; here it bounds the curvature too, so that the axes are those of beams.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .piled_axes import Axes, along, curve

#: Fewest and most turns in which the heights are fitted to the distances at the crossings, and steps in which these are found
_TURNS, _MAX_TURNS, _CLOSER = 3, 12, 3
#: Exchanges of wrong supports that do not get fewer before they are exchanged one at a time; and of these, for each place
_PATIENCE, _MAX_EXCHANGES = 4, 20
#: Forces and heights below this part of the largest are round-off; supports give way by this part of the heights, so that those
#: that are next to each other can be told apart
_NOTHING, _SOFTNESS = 1e-9, 1e-6


@dataclass(frozen=True)
class Below:
    """What a wire crosses.

    Attributes
    ----------
    wires : (k) array of int
        Wires of the pile.
    there, here : (k) arrays
        Places on them and on the wire itself, as parts of the lengths.
    cosine : (k) array
        Of the angle between the directions.
    lengths : (k) array
        Lengths of the wires below [m].
    """

    wires: NDArray[np.int64]
    there: NDArray[np.float64]
    here: NDArray[np.float64]
    cosine: NDArray[np.float64]
    lengths: NDArray[np.float64]

    def where(self, mask: NDArray) -> Below:
        """The crossings for which a mask (k) is true."""
        return Below(*(getattr(self, name)[mask] for name in self.__dataclass_fields__))


class Pile:
    """Wires one above the other, each of them at rest on those below.

    Parameters
    ----------
    distance : float
        Distance of the axes of two wires that touch [m].
    reach : float, optional
        Length over which a wire bends down [m]; None: wires are level.
    slack : float
        By how much two axes may be nearer than `distance` [m].
    """

    def __init__(self, distance: float, reach: float | None, slack: float = math.inf):
        self._distance, self._reach, self._slack = distance, reach, slack
        self._heights: list[NDArray] = []
        self._axes = Axes()
        #: Crossings of the wires, and those at which they touch
        self.n_crossings, self.n_touching = 0, 0

    @property
    def heights(self) -> list[NDArray[np.float64]]:
        """Heights of the nodes of each wire [m]."""
        return self._heights

    @property
    def n_wires(self) -> int:
        """Number of its wires."""
        return len(self._heights)

    def _at(self, below: Below) -> NDArray[np.float64]:
        """Heights of the smooth axes of the wires below where they are crossed [m]."""
        return self._axes.heights(below.wires, below.there)

    def lay(self, length: float, n_elements: int, below: Below, refuse: NDArray | None = None) -> bool:
        """Lay a wire on top; False, and nothing is changed, where it would rest on a wire on which it must not.

        Parameters
        ----------
        length : float
            Its length [m].
        n_elements : int
            Number of its elements, of equal length.
        below : Below
            What it crosses.
        refuse : (k) array of bool, optional
            Where it must stay two distances above the other wire, or is not laid.
        """
        if self._reach is None:
            levels = np.array([self._heights[wire][0] for wire in below.wires.tolist()])
            top = levels.max(initial=-self._distance) + self._distance
            self._add(length, np.full(n_elements + 1, top), levels > top - 1.5 * self._distance)
            return True
        rests_on = below if refuse is None else below.where(~refuse)
        kept_off = None if refuse is None else below.where(refuse)
        found: list[tuple[NDArray, NDArray, float]] = []
        for turn in self._fitted(self._reach, length, n_elements, rests_on):
            if kept_off is not None and self._comes_near(turn[0], kept_off):
                return False
            found = [turn]
        heights, forces, missing = found[0]
        if refuse is not None and missing > self._slack:
            return False
        self._add(length, heights, forces > 0)
        return True

    def _comes_near(self, heights: NDArray, below: Below) -> bool:
        """A wire comes nearer than two distances to one of those below."""
        if not len(below.wires):
            return False
        room = weights(len(heights) - 1, below.here) @ heights - self._at(below)
        return bool((room < 2 * self._distance).any())

    def _fitted(
        self, reach: float, length: float, n_elements: int, below: Below
    ) -> Iterator[tuple[NDArray, NDArray, float]]:
        """Heights of the nodes of a wire that rests on those below, its forces on them, and what it comes too near [m].

        Better from turn to turn, until it comes not much too near.
        """
        if not len(below.wires):
            yield np.zeros(n_elements + 1), np.zeros(0), 0.0
            return
        base, wanted = self._at(below), np.full(len(below.wires), self._distance)
        here = weights(n_elements, below.here)
        lifted = _compliance(n_elements, round(length / n_elements / reach, 12)) @ here.T
        compliance = here @ lifted
        guess = _tops(below.here * length, base, reach / 2)
        for turn in range(_MAX_TURNS):
            forces = _supports(compliance, base + wanted, guess)
            heights, guess = lifted @ forces, forces > 0
            if turn == 0:
                # whether it may lie there at all is seen before it is measured
                yield heights, forces, math.inf
            near = np.flatnonzero(compliance @ forces < base + 1.5 * wanted)
            missing = self._distance - self._distances(length, heights, below.where(near))
            most = float(missing.max(initial=0.0))
            yield heights, forces, most
            if turn + 1 >= _TURNS and most <= self._slack:
                return
            wanted[near] += np.where(guess[near] | (missing > 0), missing, 0.0)

    def _distances(self, length: float, heights: NDArray, below: Below) -> NDArray[np.float64]:
        """Smallest distance of the axis of a wire from each of those below, near where they cross, by Gauss and Newton.

        In the two elements of each that are nearest to the crossing: the axes may have kinks between them.
        """
        n, many = len(heights) - 1, np.tile(self._axes.counts(below.wires), 4)
        elements, cosine, wires = curve(length, heights), np.tile(below.cosine, 4), np.tile(below.wires, 4)
        here, there = np.tile(below.here * length, 4), np.tile(below.there * below.lengths, 4)
        on, under = np.tile(below.here, 4) * n, np.tile(below.there, 4) * many
        other = np.repeat([[0, 1, 0, 1], [0, 0, 1, 1]], len(below.wires), axis=1)
        first, second = _nearest(on, other[0], n), _nearest(under, other[1], many)
        on, under = np.clip(on, first, first + 1), np.clip(under, second, second + 1)
        for turn in range(_CLOSER + 1):
            way, height, s_rate, p = along(elements[:, first], on - first)
            way_below, height_below, t_rate, q = self._axes.at(wires, second, under)
            s, t, gap = way - here, way_below - there, height - height_below
            if turn == _CLOSER:
                break
            uu, uv, vv = s_rate**2 + p**2, s_rate * t_rate * cosine + p * q, t_rate**2 + q**2
            down, up = s_rate * (s - t * cosine) + p * gap, t_rate * (t - s * cosine) - q * gap
            step = np.clip(on - (vv * down + uv * up) / (uu * vv - uv**2), first, first + 1) - on
            # where one of the elements ends the other follows
            below_step = np.clip(under + (uv * step - up) / vv, second, second + 1) - under
            on = np.clip(on + (uv * below_step - down) / uu, first, first + 1)
            under = under + below_step
        distances = np.copysign(np.sqrt(s**2 + t**2 - 2 * s * t * cosine + gap**2), gap)
        return distances.reshape(4, -1).min(axis=0)

    def _add(self, length: float, heights: NDArray, touches: NDArray) -> None:
        self.n_crossings += len(touches)
        self.n_touching += int(touches.sum())
        self._heights.append(heights)
        self._axes.add(length, heights)


def _nearest(places: NDArray, other: NDArray, n_elements: int | NDArray) -> NDArray[np.int64]:
    """The element of a place, or where `other` is 1 the other one that is nearest to it."""
    element = np.minimum(places.astype(int), n_elements - 1)
    towards = np.where(places - element < 0.5, -1, 1)
    return np.clip(element + other * towards, 0, n_elements - 1)


def weights(n_elements: int, places: NDArray) -> NDArray[np.float64]:
    """Weights (m, n + 1) of the heights of the nodes in that of the smooth axis at parts of the length, (m)."""
    element, xi = _element(n_elements, places)
    return _combined(n_elements, element, *_shapes(xi))


def _combined(n_elements: int, element: NDArray, *shapes: NDArray) -> NDArray[np.float64]:
    """Sums of the values at both nodes of elements and of the slopes there, times shape functions, as weights of the nodes."""
    first, last, slope_first, slope_last = (shape[:, None] for shape in shapes)
    values, slopes = np.eye(n_elements + 1), _node_slopes(n_elements)
    return (
        first * values[element]
        + last * values[element + 1]
        + slope_first * slopes[element]
        + slope_last * slopes[element + 1]
    )


def _element(n_elements: int, places: NDArray) -> tuple[NDArray, NDArray]:
    scaled = n_elements * np.asarray(places, dtype=float)
    element = np.clip(scaled.astype(int), 0, n_elements - 1)
    return element, 2 * (scaled - element) - 1


def _shapes(xi: Any) -> tuple[Any, ...]:
    """Hermite's shape functions of the values and slopes at both ends."""
    return (
        (2 - 3 * xi + xi**3) / 4,
        (2 + 3 * xi - xi**3) / 4,
        (1 - xi - xi**2 + xi**3) / 4,
        (-1 - xi + xi**2 + xi**3) / 4,
    )


@lru_cache(maxsize=1024)
def _node_slopes(n_elements: int) -> NDArray[np.float64]:
    """Slopes of the axis at the nodes by the coordinate xi, as weights of the heights: parabolas, as `wires.curves` has them."""
    slopes = np.zeros((n_elements + 1, n_elements + 1))
    inner = np.arange(1, n_elements)
    slopes[inner, inner + 1], slopes[inner, inner - 1] = 0.25, -0.25
    for end, step in ((0, 1), (n_elements, -1)):
        chord = np.zeros(n_elements + 1)
        chord[[end, end + step]] = -0.5 * step, 0.5 * step
        # the circle through the end continues the curve; a single element is straight
        slopes[end] = 2 * chord - slopes[end + step] if n_elements > 1 else chord
    return slopes


@lru_cache(maxsize=4096)
def _compliance(n_elements: int, element: float) -> NDArray[np.float64]:
    """Inverse of the stiffness of a beam on springs, for elements of a length relative to the reach."""
    bend = np.diff(np.eye(n_elements + 1), 2, axis=0)
    parts = np.full(n_elements + 1, element)
    parts[[0, -1]] /= 2
    return np.linalg.inv(bend.T @ bend / (4 * element**3) + np.diag(parts))


def _tops(places: NDArray, heights: NDArray, reach: float) -> NDArray[np.bool_]:
    """Places that are as high as all others within a reach along the wire: on these it will rest, most likely."""
    near = np.abs(places[:, None] - places) < reach
    return heights >= np.where(near, heights, -np.inf).max(axis=1)


def _supports(compliance: NDArray, heights: NDArray, rests: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Forces >= 0 at the places of support that hold a beam at or above heights: 0 where it is above.

    The linear complementarity problem is solved by exchanging all wrong places at once (Judice and Pires, 1994); where they do
    not get fewer, one by one as Lawson and Hanson (1974) do. `rests` is a guess of the places with forces.
    """
    compliance = compliance + np.diag(_SOFTNESS * np.diag(compliance))
    fewest, patience = len(heights) + 1, _PATIENCE
    smallest = _NOTHING * max(np.abs(heights).max(), np.finfo(float).tiny)
    while patience:
        forces = np.zeros(len(heights))
        forces[rests] = _balanced(compliance, heights, rests)
        wrong = np.where(rests, forces < -_NOTHING * np.abs(forces).max(), compliance @ forces < heights - smallest)
        n_wrong = int(wrong.sum())
        if not n_wrong:
            return np.maximum(forces, 0.0)
        patience = _PATIENCE if n_wrong < fewest else patience - 1
        fewest = min(fewest, n_wrong)
        rests = rests ^ wrong
    return _supports_one_by_one(compliance, heights, smallest)


def _supports_one_by_one(compliance: NDArray, heights: NDArray, smallest: float) -> NDArray[np.float64]:
    """As `_supports`, with one more place at a time, and without those that would have to pull."""
    forces, rests = np.zeros(len(heights)), np.zeros(len(heights), dtype=bool)
    for _ in range(_MAX_EXCHANGES * len(heights)):
        room = np.where(rests, np.inf, compliance @ forces - heights)
        if not room.min() < -smallest:
            return forces
        rests[room.argmin()] = True
        while rests.any():
            wanted = np.zeros(len(heights))
            wanted[rests] = _balanced(compliance, heights, rests)
            pulls = rests & (wanted <= 0)
            if not pulls.any():
                forces = wanted
                break
            ways = forces[pulls] / (forces[pulls] - wanted[pulls])
            forces = forces + ways.min() * (wanted - forces)
            rests[np.flatnonzero(pulls)[ways.argmin()]] = False
            forces[~rests] = 0.0
    raise ValueError("the places on which a wire rests were not found: choose a longer reach")


def _balanced(compliance: NDArray, heights: NDArray, rests: NDArray) -> NDArray[np.float64]:
    """Forces at the places of support that bring the beam to their heights."""
    held = np.flatnonzero(rests)
    return np.linalg.solve(compliance[np.ix_(held, held)], heights[held])


def n_elements_of(length: float, longest: float) -> int:
    """Number of equal elements, two at least, that are not longer than a length [m]."""
    return max(2, math.ceil(length / longest * (1 - 1e-12)))
