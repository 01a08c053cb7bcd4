"""Exact centre lines of helices about straight lines, about helices, and so on.

A curve is evaluated with its derivatives by the height z, as coefficients of Taylor series: arrays whose first axis is the
order, (n_orders, n_points) or, for vectors, (n_orders, n_points, 3).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import ArrayLike, NDArray

Series = NDArray[np.float64]
#: Degree of the polynomial for arc lengths: at least, and for each turn of any stage
_DEGREE, _DEGREE_PER_TURN = 40, 40


@dataclass(frozen=True)
class StraightAxis:
    """The axis of a cable: the line x = y = 0 from z = 0 to `length` [m]."""

    length: float
    #: Turns along the axis, of all stages together
    turns: float = 0.0

    def series(self, z: ArrayLike, orders: int) -> Series:
        """Taylor coefficients of the curve at heights z, (orders, n, 3)."""
        z = np.asarray(z, dtype=float)
        series = np.zeros((orders, len(z), 3))
        series[0, :, 2] = z
        if orders > 1:
            series[1, :, 2] = 1.0
        return series

    def arc(self, z: ArrayLike) -> Series:
        """Arc length from z = 0 [m], (n)."""
        return np.asarray(z, dtype=float)


@dataclass(frozen=True)
class WoundAxis:
    """A helix about another curve, in the planes normal to it.

    The direction from which angles are measured is that of x, made normal to the curve.

    Attributes
    ----------
    core : StraightAxis or WoundAxis
        The curve it is wound around.
    radius : float
        Distance from it [m].
    lay_length : float
        Length of one turn along the core [m]; positive: right-handed, negative: left-handed.
    phase : float
        Angle at z = 0 [rad].
    """

    core: StraightAxis | WoundAxis
    radius: float
    lay_length: float
    phase: float

    @property
    def length(self) -> float:
        """Length of the cable [m]."""
        return self.core.length

    @property
    def turns(self) -> float:
        """Turns along the cable, of all stages together."""
        return self.core.turns + self.length / abs(self.lay_length)

    def series(self, z: ArrayLike, orders: int) -> Series:
        """Taylor coefficients of the curve at heights z, (orders, n, 3)."""
        core = self.core.series(z, orders + 1)
        rate = _derivative(core)
        speed = _root(_dot(rate, rate))
        tangent = _quotient(rate, speed[..., None])
        first = -_product(tangent[..., :1], tangent)
        first[0, :, 0] += 1.0
        first = _quotient(first, _root(_dot(first, first))[..., None])
        second = _cross(tangent, first)
        arc = np.concatenate([self.core.arc(z)[None], speed[:-1] / np.arange(1, orders)[:, None]])
        angle = 2 * math.pi / self.lay_length * arc
        angle[0] += self.phase
        cosine, sine = _cosine_and_sine(angle)
        return core[:-1] + self.radius * (_product(cosine[..., None], first) + _product(sine[..., None], second))

    def arc(self, z: ArrayLike) -> Series:
        """Arc length from z = 0 [m], (n)."""
        return self._arc(np.asarray(z, dtype=float)) - self._arc(0.0)

    @cached_property
    def _arc(self) -> Chebyshev:
        def speed(z: Series) -> Series:
            return np.linalg.norm(self.series(z, 2)[1], axis=1)

        degree = _DEGREE + math.ceil(_DEGREE_PER_TURN * self.turns)
        return Chebyshev.interpolate(speed, degree, domain=[0, self.length]).integ()


def points(axis: StraightAxis | WoundAxis, z: ArrayLike) -> Series:
    """Points of a curve at heights z of the cable's axis, (n, 3) [m]."""
    return axis.series(z, 1)[0]


def tangents(axis: StraightAxis | WoundAxis, z: ArrayLike) -> Series:
    """Unit tangents of a curve at heights z of the cable's axis, (n, 3)."""
    rate = axis.series(z, 2)[1]
    return rate / np.linalg.norm(rate, axis=1, keepdims=True)


def _derivative(a: Series) -> Series:
    return a[1:] * np.arange(1, len(a)).reshape(-1, *[1] * (a.ndim - 1))


def _product(a: Series, b: Series) -> Series:
    return np.stack([sum(a[i] * b[k - i] for i in range(k + 1)) for k in range(len(a))])


def _quotient(a: Series, b: Series) -> Series:
    quotient: list[Series] = []
    for k in range(len(a)):
        quotient.append((a[k] - sum(b[i] * quotient[k - i] for i in range(1, k + 1))) / b[0])
    return np.stack(quotient)


def _root(a: Series) -> Series:
    root = [np.sqrt(a[0])]
    for k in range(1, len(a)):
        root.append((a[k] - sum(root[i] * root[k - i] for i in range(1, k))) / (2 * root[0]))
    return np.stack(root)


def _cosine_and_sine(a: Series) -> tuple[Series, Series]:
    cosine, sine = [np.cos(a[0])], [np.sin(a[0])]
    for k in range(1, len(a)):
        rise = [i / k * a[i] for i in range(1, k + 1)]
        cosine.append(-sum(r * sine[k - i] for i, r in enumerate(rise, start=1)))
        sine.append(sum(r * cosine[k - i] for i, r in enumerate(rise, start=1)))
    return np.stack(cosine), np.stack(sine)


def _dot(a: Series, b: Series) -> Series:
    return _product(a, b).sum(axis=-1)


def _cross(a: Series, b: Series) -> Series:
    forward, backward = [1, 2, 0], [2, 0, 1]
    return _product(a[..., forward], b[..., backward]) - _product(a[..., backward], b[..., forward])
