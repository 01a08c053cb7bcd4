"""The arguments of one call of a kernel: checked, and broadcast over the axes that lead their own."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import checks

Floats = NDArray[np.float64]


class Batch:
    """Arguments in the order in which the kernel takes them, each of its own shape behind any leading axes.

    The leading axes of all arguments broadcast against each other, as those of a numpy ufunc with a signature do; without
    any, the call is one of a single element, pair or point.
    """

    def __init__(self) -> None:
        #: What each call of the kernel has of its own: name, value, number of its own axes
        self._each: list[tuple[str, NDArray[Any], int]] = []
        #: What the calls may share: data of laws, tables
        self._shared: list[tuple[str, NDArray[Any], int]] = []
        self._shape: tuple[int, ...] | None = None

    def array(self, name: str, value: ArrayLike, shape: tuple[int, ...] = ()) -> Floats:
        """Take finite numbers; `shape` is that of one call."""
        result = checks.leading(name, value, shape)
        self._each.append((name, result, len(shape)))
        return result

    def positive(self, name: str, value: ArrayLike, shape: tuple[int, ...] = ()) -> Floats:
        """Take numbers greater than zero."""
        result = self.array(name, value, shape)
        checks.refuse(name, result, result <= 0, len(shape), "must be greater than 0, {but}")
        return result

    def not_negative(self, name: str, value: ArrayLike, shape: tuple[int, ...] = ()) -> Floats:
        """Take numbers that are zero or greater."""
        result = self.array(name, value, shape)
        checks.refuse(name, result, result < 0, len(shape), "must not be negative, but is {value:g}")
        return result

    def pair(self, name: str, value: ArrayLike) -> Floats:
        """Take two numbers, barred and unbarred; one serves both."""
        result = checks.leading_pair(name, value)
        self._each.append((name, result, 1))
        return result

    def positive_pair(self, name: str, value: ArrayLike) -> Floats:
        """Take two numbers greater than zero; one serves both."""
        result = self.pair(name, value)
        checks.refuse(name, result, result <= 0, 1, "must be greater than 0, {but}")
        return result

    def take(self, name: str, value: NDArray[Any], own_axes: int) -> None:
        """Take what has been checked; its last `own_axes` are those of one call."""
        self._each.append((name, value, own_axes))

    def share(self, name: str, value: NDArray[Any], own_axes: int) -> None:
        """Take what has been checked, and what all calls may share: it is passed once if it has no leading axes."""
        self._shared.append((name, value, own_axes))

    def taken(self) -> list[tuple[str, NDArray[Any], int]]:
        """Name, value, and number of its own axes, of all that has been taken."""
        return self._each + self._shared

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes of the result; all arguments have been taken."""
        if self._shape is None:
            leading = {
                name: value.shape[: value.ndim - own]
                for name, value, own in (*self._each, *self._shared)
                if value.ndim > own
            }
            try:
                self._shape = np.broadcast_shapes(*leading.values())
            except ValueError:
                shapes = ", ".join(f"{shape} of {name}" for name, shape in leading.items())
                raise ValueError(f"the leading axes of the arguments do not broadcast: {shapes}") from None
        return self._shape

    @property
    def n(self) -> int:
        """Number of calls."""
        return math.prod(self.shape)

    def columns(self) -> list[NDArray[Any]]:
        """What each call has of its own, with axes in the order of Fortran: those of one call reversed, then n."""
        return [self._column(value, own, self.shape) for _, value, own in self._each]

    def shared_columns(self) -> list[NDArray[Any]]:
        """The same of what the calls may share: the last axis is n, or 1."""
        shared = all(value.ndim == own for _, value, own in self._shared)
        return [self._column(value, own, () if shared else self.shape) for _, value, own in self._shared]

    @staticmethod
    def _column(value: NDArray[Any], own: int, leading: tuple[int, ...]) -> NDArray[Any]:
        core = value.shape[value.ndim - own :]
        if value.shape != leading + core:
            value = np.broadcast_to(value, leading + core)
        return value.reshape(math.prod(leading), *core).T

    def call(
        self, shapes: list[tuple[int, ...]], kernel: Callable[..., tuple[NDArray[Any], ...]], *arguments: Any
    ) -> Any:
        """Call a kernel whose results have these shapes before the last axis n; of no calls these are empty."""
        if self.n == 0:
            return tuple(np.empty((*shape, 0)) for shape in shapes)
        return kernel(*arguments)

    def call_for_one(
        self, shape: tuple[int, ...], kernel: Callable[..., NDArray[Any]], *arguments: Any
    ) -> NDArray[Any]:
        """Call a kernel that returns one array."""
        return np.empty((*shape, 0)) if self.n == 0 else kernel(*arguments)

    def room(self, shape: tuple[int, ...], wanted: bool) -> Floats:
        """Room for a large result of all calls, or of one where it is not wanted; it is not filled."""
        return np.empty((*shape, self.n if wanted else 1), order="F")

    def result(self, value: NDArray[Any]) -> Any:
        """What the kernel returned, its last axis n as leading axes; numbers of a single call are plain numbers."""
        if not self.shape:
            return value[..., 0] if value.ndim > 1 else value[0].item()
        return np.moveaxis(value, -1, 0).reshape(self.shape + value.shape[:-1])

    def results(self, values: NDArray[Any]) -> list[Any]:
        """The numbers (m, n) that the kernel returned, one by one."""
        return values[:, 0].tolist() if not self.shape else [each.reshape(self.shape) for each in values]

    def empty(self, *shape: int) -> Floats:
        """What was not asked for: an array without entries."""
        return np.empty((*self.shape, *shape))

    def raise_failures(self, info: NDArray[Any], words: dict[int, str], what: str) -> None:
        """Raise a ValueError with the words for what the kernel could not do, and the place of the first such call."""
        for failure, text in words.items():
            bad = info == failure
            if bad.any():
                raise ValueError(self.named(bad, what) + text)

    def named(self, bad: NDArray[np.bool_], what: str) -> str:
        """The place of the first of n calls that is bad, as in "pair 3: "."""
        if not self.shape:
            return ""
        index = np.unravel_index(int(np.argmax(bad)), self.shape)
        return f"{what} {', '.join(str(int(i)) for i in index)}: "
