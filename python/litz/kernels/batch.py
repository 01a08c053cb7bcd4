"""Checks of what a caller hands to a kernel that takes many points at once: arrays with a leading axis, or without."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import checks

Floats = NDArray[np.float64]


def points(name: str, value: ArrayLike, shape: tuple[int, ...], n: int | None) -> Floats:
    """Return `value` with a leading axis: of one point, of n points that have their own, or of n that share it."""
    if n is not None and np.ndim(value) == len(shape) + 1:
        return checks.array(name, value, (n, *shape))
    return np.broadcast_to(checks.array(name, value, shape), (1 if n is None else n, *shape))


def named(bad: NDArray[np.bool_], n: int | None) -> str:
    """Which of many points is meant."""
    return "" if n is None else f"point {int(np.argmax(bad))}: "


def check(good: NDArray[np.bool_], n: int | None, words: str) -> None:
    """Raise a ValueError unless all points are good."""
    if not good.all():
        bad: NDArray[np.bool_] = np.array([not each.all() for each in good])
        raise ValueError(named(bad, n) + words)


def positive(name: str, value: ArrayLike, shape: tuple[int, ...], n: int | None) -> Floats:
    """Return `points` of numbers greater than zero."""
    result = points(name, value, shape, n)
    check(result > 0, n, f"{name} must be greater than 0")
    return result


def not_negative(name: str, value: ArrayLike, n: int | None, shape: tuple[int, ...] = ()) -> Floats:
    """Return `points` of numbers that are not negative."""
    result = points(name, value, shape, n)
    check(result >= 0, n, f"{name} must not be negative")
    return result
