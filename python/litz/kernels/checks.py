"""Checks of what a caller hands to a kernel. Each returns the value as the kernel needs it, or raises a ValueError."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: How far the products of the columns of a triad, and the length of a tangent, may be from 0 and 1
TRIAD_TOLERANCE = 1e-8


def array(name: str, value: ArrayLike, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return `value` as an array of finite numbers of the given shape."""
    try:
        result = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} must be an array of real numbers of shape {shape}: {error}") from error
    if result.shape != shape:
        raise ValueError(f"{name} must have shape {shape}, not {result.shape}")
    if not np.isfinite(result).all():
        raise ValueError(f"{name} must be finite, but holds {result[~np.isfinite(result)][0]}")
    return result


def number(name: str, value: ArrayLike) -> float:
    """Return `value` as a finite number."""
    return float(array(name, value, ()))


def positive(name: str, value: float) -> float:
    """Return `value` as a number greater than zero."""
    result = number(name, value)
    if result <= 0:
        raise ValueError(f"{name} must be greater than 0, not {result:g}")
    return result


def triads(name: str, value: ArrayLike, count: int) -> NDArray[np.float64]:
    """Return `value` as `count` rotation matrices, shape (count, 3, 3)."""
    result = array(name, value, (count, 3, 3))
    for i, triad in enumerate(result):
        error = np.abs(triad.T @ triad - np.eye(3)).max()
        if error > TRIAD_TOLERANCE:
            raise ValueError(
                f"the columns of {name}[{i}] must be orthonormal, but their products are off by {error:.1e} "
                f"(allowed {TRIAD_TOLERANCE:.0e})"
            )
        if np.linalg.det(triad) < 0:
            raise ValueError(f"the columns of {name}[{i}] must be right-handed: third = first x second")
    return result


def element(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """Return `value` as the positions of two nodes, shape (2, 3), that do not coincide."""
    result = array(name, value, (2, 3))
    if not np.linalg.norm(result[1] - result[0]) > 0:
        raise ValueError(f"{name}: the two nodes coincide at {result[0]}, so the element has no length")
    return result


def pair(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """Return `value` as two finite numbers, barred and unbarred; one number serves both."""
    return np.full(2, number(name, value)) if np.ndim(value) == 0 else array(name, value, (2,))


def positive_pair(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """Return `value` as two numbers greater than zero; one number serves both."""
    result = pair(name, value)
    if (result <= 0).any():
        raise ValueError(f"{name} must be greater than 0, but holds {result.min():g}")
    return result


def unit_vectors(name: str, value: ArrayLike, shape: tuple[int, int]) -> NDArray[np.float64]:
    """Return `value` as rows of unit length."""
    result = array(name, value, shape)
    for i, length in enumerate(np.linalg.norm(result, axis=1)):
        if abs(length - 1) > TRIAD_TOLERANCE:
            raise ValueError(
                f"{name}[{i}] must have unit length, not {length:.10g} (allowed is an error of {TRIAD_TOLERANCE:.0e})"
            )
    return result


def choice(name: str, value: str, allowed: dict[str, int]) -> int:
    """Return the number that stands for one of the `allowed` names."""
    if not isinstance(value, str) or value not in allowed:
        names = ", ".join(f'"{key}"' for key in allowed)
        raise ValueError(f"{name} must be one of {names}, not {value!r}")
    return allowed[value]
