"""Checks of what a caller hands to a kernel. Each returns the value as the kernel needs it, or raises a ValueError.

A value has the shape of one call of the kernel, behind any leading axes of many calls.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

#: How far the products of the columns of a triad, and the length of a tangent, may be from 0 and 1
TRIAD_TOLERANCE = 1e-8


def leading(name: str, value: ArrayLike, shape: tuple[int, ...]) -> Floats:
    """Return `value` as finite numbers of a shape that ends with the given one."""
    result = _numbers(name, value, shape)
    own = len(shape)
    if own and (result.ndim < own or result.shape[result.ndim - own :] != shape):
        raise ValueError(f"{name} must have shape {shape}, not {result.shape}; leading axes are those of many calls")
    return _finite(name, result, own)


def leading_pair(name: str, value: ArrayLike) -> Floats:
    """Return `value` as two finite numbers, barred and unbarred, behind any leading axes; one number serves both."""
    result = _numbers(name, value, (2,))
    if result.ndim and result.shape[-1] not in (1, 2):
        raise ValueError(
            f"{name} must have shape (2,), barred and unbarred, not {result.shape}; leading axes are those of many calls, "
            "and one number for both wires of each has a last axis of 1"
        )
    if result.ndim == 0 or result.shape[-1] == 1:
        result = np.broadcast_to(result, (*result.shape[:-1], 2))
    return _finite(name, result, 1)


def array(name: str, value: ArrayLike, shape: tuple[int, ...]) -> Floats:
    """Return `value` as an array of finite numbers of the given shape."""
    result = _numbers(name, value, shape)
    if result.shape != shape:
        raise ValueError(f"{name} must have shape {shape}, not {result.shape}")
    return _finite(name, result, len(shape))


def _numbers(name: str, value: ArrayLike, shape: tuple[int, ...]) -> Floats:
    try:
        return np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} must be an array of real numbers of shape {shape}: {error}") from error


def _finite(name: str, value: Floats, own_axes: int) -> Floats:
    good = np.isfinite(value)
    if not good.all():
        refuse(name, value, ~good, own_axes, "must be finite, but holds {value}")
    return value


def refuse(name: str, value: NDArray[Any], bad: NDArray[np.bool_], own_axes: int, words: str) -> None:
    """Raise a ValueError where `bad`: the name with its place among many, and the words about the first bad `{value}`.

    `{but}` in the words stands for "not VALUE" of a single number, "but holds VALUE" of an array.
    """
    if not bad.any():
        return
    place = np.unravel_index(int(np.argmax(bad)), bad.shape)
    first = np.asarray(value)[place]
    lead = place[: bad.ndim - own_axes]
    at = f"[{', '.join(str(int(i)) for i in lead)}]" if lead else ""
    but = f"not {first:g}" if own_axes == 0 else f"but holds {first:g}"
    raise ValueError(f"{name}{at} {words.format(value=first, but=but)}")


def number(name: str, value: ArrayLike) -> float:
    """Return `value` as a finite number."""
    return float(array(name, value, ()))


def positive(name: str, value: ArrayLike) -> float:
    """Return `value` as a number greater than zero."""
    result = number(name, value)
    if result <= 0:
        raise ValueError(f"{name} must be greater than 0, not {result:g}")
    return result


def all_positive(name: str, value: ArrayLike) -> Floats:
    """Return `value` as numbers greater than zero, one for each of many calls or one for all."""
    result = leading(name, value, ())
    refuse(name, result, result <= 0, 0, "must be greater than 0, {but}")
    return result


def triads(name: str, value: ArrayLike, count: int) -> Floats:
    """Return `value` as `count` rotation matrices, shape (..., count, 3, 3)."""
    result = leading(name, value, (count, 3, 3))
    error = np.abs(np.swapaxes(result, -1, -2) @ result - np.eye(3)).max(axis=(-1, -2), initial=0.0)
    if (error > TRIAD_TOLERANCE).any():
        place = _place(error > TRIAD_TOLERANCE)
        raise ValueError(
            f"the columns of {name}{_brackets(place)} must be orthonormal, but their products are off by "
            f"{error[place]:.1e} (allowed {TRIAD_TOLERANCE:.0e})"
        )
    mirrored = np.linalg.det(result) < 0
    if mirrored.any():
        raise ValueError(
            f"the columns of {name}{_brackets(_place(mirrored))} must be right-handed: third = first x second"
        )
    return result


def element(name: str, value: ArrayLike) -> Floats:
    """Return `value` as the positions of two nodes, shape (..., 2, 3), that do not coincide."""
    result = leading(name, value, (2, 3))
    coincide = ~(np.linalg.norm(result[..., 1, :] - result[..., 0, :], axis=-1) > 0)
    if coincide.any():
        place = _place(coincide)
        at = _brackets(place) if place else ""
        raise ValueError(f"{name}{at}: the two nodes coincide at {result[place][0]}, so the element has no length")
    return result


def unit_vectors(name: str, value: ArrayLike, shape: tuple[int, int]) -> Floats:
    """Return `value` as rows of unit length."""
    result = leading(name, value, shape)
    length = np.linalg.norm(result, axis=-1)
    bad = np.abs(length - 1) > TRIAD_TOLERANCE
    if bad.any():
        place = _place(bad)
        raise ValueError(
            f"{name}{_brackets(place)} must have unit length, not {length[place]:.10g} "
            f"(allowed is an error of {TRIAD_TOLERANCE:.0e})"
        )
    return result


def _place(bad: NDArray[np.bool_]) -> tuple[int, ...]:
    return tuple(int(i) for i in np.unravel_index(int(np.argmax(bad)), bad.shape))


def _brackets(place: tuple[int, ...]) -> str:
    return f"[{', '.join(map(str, place))}]"


def choice(name: str, value: str, allowed: dict[str, int]) -> int:
    """Return the number that stands for one of the `allowed` names."""
    if not isinstance(value, str) or value not in allowed:
        names = ", ".join(f'"{key}"' for key in allowed)
        raise ValueError(f"{name} must be one of {names}, not {value!r}")
    return allowed[value]
