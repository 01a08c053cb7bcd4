"""Layers of helices: how near neighbours come to each other, and the radius of a layer in which they fit."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

#: Turns of a helix are searched for local minima of the distance in steps of this angle [rad]
_STEP = math.radians(0.5)
#: Bisection ends at this relative difference
_EQUAL = 1e-14


@dataclass(frozen=True)
class Lay:
    """How a layer is laid.

    Attributes
    ----------
    length : float, optional
        Length of one turn along the axis [m]; or else
    angle : float, optional
        Angle between the members and the axis [rad].
    hand : int
        +1: right-handed (Z), -1: left-handed (S).
    """

    length: float | None = None
    angle: float | None = None
    hand: int = 1

    def length_at(self, radius: float) -> float:
        """Lay length of a layer of a radius [m], positive."""
        if self.length is not None:
            return self.length
        return 2 * math.pi * radius / math.tan(self.angle or 0.0)

    def angle_at(self, radius: float) -> float:
        """Lay angle of a layer of a radius [rad]."""
        return math.atan(2 * math.pi * radius / self.length_at(radius))


def neighbour_distance(count: int, radius: float, lay_length: float) -> float:
    """Smallest distance of the centre lines of a layer of equal helices, evenly spaced, or of the turns of a single one.

    A point of one helix and one of another, whose phase is ahead by alpha and which lies higher by psi turns of 2 pi, have
    the distance `d^2 = 2 R^2 (1 - cos(alpha - psi)) + (L psi/(2 pi))^2`. The search covers all pairs and turns and ends
    with Newton's method, so that the result is exact to round-off.

    Parameters
    ----------
    count : int
        Number of helices.
    radius, lay_length : float
        Radius of the layer [m], and lay length [m], positive.

    Returns
    -------
    float
        Distance [m]; infinite for a single straight line.
    """
    rise = lay_length / (2 * math.pi)
    smallest = math.inf
    for ahead in 2 * math.pi * np.arange(1, count + 1) / count:
        # at half a turn the distance is even in psi, and psi = 0 is a place where it may be smallest
        turns = [0.0] if ahead == math.pi else []
        psi = np.linspace(0, ahead, math.ceil(ahead / _STEP) + 1)
        falls = rise**2 * psi - radius**2 * np.sin(ahead - psi) < 0
        minima = np.flatnonzero(falls[:-1] & ~falls[1:])
        turns += [_nearest_turn(ahead, (radius / rise) ** 2, psi[i], psi[i + 1]) for i in minima]
        for turn in turns:
            smallest = min(smallest, math.hypot(2 * radius * math.sin((ahead - turn) / 2), rise * turn))
    return smallest


def _nearest_turn(ahead: float, ratio: float, low: float, high: float) -> float:
    """The turn psi in an interval at which the distance is smallest: psi = (R/rise)^2 sin(ahead - psi)."""
    turn = high
    for _ in range(50):
        excess = turn - ratio * math.sin(ahead - turn)
        low, high = (turn, high) if excess < 0 else (low, turn)
        step = turn - excess / (1 + ratio * math.cos(ahead - turn))
        # outside the interval Newton's method gives way to bisection
        before, turn = turn, step if low < step < high else (low + high) / 2
        if abs(turn - before) <= _EQUAL * ahead:
            break
    return turn


def touching_radius(count: int, member: float, lay: Lay, room: float) -> float:
    """Smallest radius of a layer whose members, of the radius `member`, keep the distance `room` from each other [m].

    Raises
    ------
    ValueError
        If they do not at any radius: a turn of the layer is shorter than its members side by side.
    """

    def nearest(radius: float) -> float:
        return neighbour_distance(count, radius, lay.length_at(radius))

    wanted = 2 * member + room
    if lay.length is None:
        return wanted / nearest(1.0)
    low = high = member / 2
    while nearest(high) < wanted:
        low, high = high, 1.25 * high
        if high > 10 * lay.length:
            raise ValueError(
                f"{count} members of the radius {member:g} m do not fit side by side at the lay length {lay.length:g} m: "
                f"it must be greater than {count * wanted:g} m"
            )
    return bisected(lambda radius: nearest(radius) >= wanted, low, high)


def widest_angle(count: int, radius: float, distance: float) -> float | None:
    """Largest lay angle at which the members of a layer of a given radius keep a distance of their centre lines [rad].

    None: they do not at any angle.
    """
    if 2 * radius * math.sin(math.pi / count) < distance:
        return None

    def overlap(angle: float) -> bool:
        return neighbour_distance(count, radius, 2 * math.pi * radius / math.tan(angle)) < distance

    return bisected(overlap, 1e-9, math.pi / 2 - 1e-9)


def bisected(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Place between `low`, where a condition does not hold, and `high`, from which on it does."""
    while high - low > _EQUAL * high:
        middle = (low + high) / 2
        if middle in (low, high):
            break
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high
