"""Derivatives by differences, for comparison with the derivatives of the kernels."""

import numpy as np


def derivative(function, x, step):
    """Jacobian of `function` at `x` by central differences of sixth order; new axis last.

    The error is about `step**6` of truncation (in units of the function's seventh derivative / 140) and `2 eps/step` of
    round-off, times the size of the function.
    """
    return derivative_of_batch(lambda states: np.array([function(state) for state in states]), x, step)


def derivative_of_batch(function, x, step):
    """The same of a function of many states at once, (n, ...) to (n, ...): one call of a kernel for all columns."""
    x = np.asarray(x, dtype=float)
    unit = np.eye(x.size).reshape(-1, *x.shape)
    states = np.stack([x + k * (step * unit) for k in (-3, -2, -1, 1, 2, 3)])
    values = function(states.reshape(-1, *x.shape))
    value = values.reshape(6, -1, *values.shape[1:])
    differences = 45 * (value[3] - value[2]) - 9 * (value[4] - value[1]) + (value[5] - value[0])
    return np.moveaxis(differences, 0, -1) / (60 * step)


def derivative_along(function, direction, step):
    """Derivative at zero along a direction, by the same differences, of a function of many states at once."""
    return derivative_of_batch(lambda s: function(s[:, None] * direction), 0.0, step)[..., 0]


def random_direction(rng, free):
    """A unit vector, of random components in the slice `free`, that no entry of a tangent is hidden from."""
    direction = np.zeros(28)
    direction[free] = rng.choice([-1, 1], len(direction[free])) * rng.uniform(0.5, 1.0, len(direction[free]))
    return direction / np.linalg.norm(direction)


def skew(a):
    """Return the matrix of the cross product from the left; of many vectors (..., 3) those of all."""
    a = np.asarray(a, dtype=float)
    result = np.zeros((*a.shape, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        result[..., j, i], result[..., i, j] = a[..., k], -a[..., k]
    return result


def rotation(v):
    """Rotation matrix of a rotation vector, or of many (..., 3), from the power series of the exponential, without the kernels.

    The vector is halved until the series converges to round-off in 20 terms, then the matrix is squared as often.
    """
    halvings = 4
    s = skew(v) / 2**halvings
    term = total = np.broadcast_to(np.eye(3), s.shape)
    for n in range(1, 21):
        term = term @ s / n
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


def turned(t, theta):
    """`exp(theta) t` by Rodrigues' formula; both (..., 3)."""
    angle = np.linalg.norm(theta, axis=-1, keepdims=True)
    axis = theta / np.where(angle > 0, angle, 1)
    along = (axis * t).sum(axis=-1, keepdims=True) * axis
    return along + np.cos(angle) * (t - along) + np.sin(angle) * np.cross(axis, t)
