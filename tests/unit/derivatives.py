"""Derivatives by differences, for comparison with the derivatives of the kernels."""

import numpy as np


def derivative(function, x, step):
    """Jacobian of `function` at `x` by central differences of sixth order; new axis last.

    The error is about `step**6` of truncation (in units of the function's seventh derivative / 140) and `2 eps/step` of
    round-off, times the size of the function.
    """
    x = np.asarray(x, dtype=float)
    columns = []
    for i in np.ndindex(x.shape):
        e = np.zeros_like(x)
        e[i] = step
        columns.append(
            (
                45 * (function(x + e) - function(x - e))
                - 9 * (function(x + 2 * e) - function(x - 2 * e))
                + (function(x + 3 * e) - function(x - 3 * e))
            )
            / (60 * step)
        )
    return np.stack(columns, axis=-1)


def derivative_along(function, direction, step):
    """Derivative of `function` at zero along a direction, by the same differences."""
    return derivative(lambda s: function(s * direction), 0.0, step)[..., 0]


def random_direction(rng, free):
    """A unit vector, of random components in the slice `free`, that no entry of a tangent is hidden from."""
    direction = np.zeros(28)
    direction[free] = rng.choice([-1, 1], len(direction[free])) * rng.uniform(0.5, 1.0, len(direction[free]))
    return direction / np.linalg.norm(direction)


def skew(a):
    """Return the matrix of the cross product from the left."""
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def rotation(v):
    """Rotation matrix of a rotation vector from the power series of the exponential, without the kernels.

    The vector is halved until the series converges to round-off in 20 terms, then the matrix is squared as often.
    """
    halvings = 4
    s = skew(np.asarray(v, dtype=float)) / 2**halvings
    term, total = np.eye(3), np.eye(3)
    for n in range(1, 21):
        term = term @ s / n
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total
