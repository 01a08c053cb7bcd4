"""Geometrically exact rod, clamped at its root, by shooting: no finite elements.

Equilibrium n' = 0, m' = -r' x n; r' = L (e1 + gamma), L' = L skew(kappa0 + kappa), with the material strains gamma =
diag(1/EA, 1/GA, 1/GA) L^T n and kappa = diag(1/GJ, 1/EI2, 1/EI3) L^T m. The unknown root moment is found such that
the moment at the tip is the given one. Source: J. C. Simo, Comput. Methods Appl. Mech. Eng. 49 (1985) 55-70; E.
Reissner, J. Appl. Math. Phys. (ZAMP) 32 (1981) 734-744.
"""

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import root


class Piece(NamedTuple):
    """A part of the rod: its length, its curvature in the free state, and the corner that follows it."""

    length: float
    #: Twist and two curvatures of the free state in the axes of the section [1/m]
    curvature: tuple = (0.0, 0.0, 0.0)
    #: Rotation from the axes at the end of this piece to those at the begin of the next
    corner: np.ndarray = np.eye(3)


def skew(v):
    """The matrix of the cross product v x."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def _march(root_moment, pieces, rigidity, force):
    """Position, axes and moment at the tip, from the root moment."""
    compliance_force = 1.0 / np.array([rigidity.ea, rigidity.ga, rigidity.ga])
    compliance_moment = 1.0 / np.array([rigidity.gj, rigidity.ei2, rigidity.ei3])
    r, axes, m = np.zeros(3), np.eye(3), np.asarray(root_moment, dtype=float)
    for piece in pieces:
        curvature = np.asarray(piece.curvature)

        def derivative(_, y, curvature=curvature):
            axes = y[3:12].reshape(3, 3)
            dr = axes @ (np.array([1.0, 0.0, 0.0]) + compliance_force * (axes.T @ force))
            dm = -np.cross(dr, force)
            return np.concatenate([dr, (axes @ skew(curvature + compliance_moment * (axes.T @ y[12:]))).ravel(), dm])

        start = np.concatenate([r, axes.ravel(), m])
        end = solve_ivp(derivative, (0.0, piece.length), start, method="DOP853", rtol=1e-11, atol=1e-12).y[:, -1]
        r, axes, m = end[:3], end[3:12].reshape(3, 3) @ piece.corner, end[12:]
    return r, axes, m


def free_shape(pieces, n):
    """Points of the free state (m, 3), each piece cut into n equal parts; constant curvature is a helix, exactly."""
    position, axes, points = np.zeros(3), np.eye(3), [np.zeros(3)]
    for piece in pieces:
        generator = np.zeros((4, 4))
        generator[:3, :3], generator[0, 3] = skew(piece.curvature), 1.0
        for s in np.linspace(0.0, piece.length, n + 1)[1:]:
            motion = expm(generator * s)
            points.append(position + axes @ motion[:3, 3])
        position, axes = points[-1], axes @ motion[:3, :3] @ piece.corner
    return np.array(points)


def tip(pieces, rigidity, force, moment=(0.0, 0.0, 0.0), steps=20):
    """Tip position under a dead force and a spatially fixed moment at the tip, the load growing in steps from zero."""
    force, moment = np.asarray(force, dtype=float), np.asarray(moment, dtype=float)
    root_moment = np.zeros(3)
    scale = np.linalg.norm(force) * sum(piece.length for piece in pieces) + np.linalg.norm(moment)
    for factor in np.linspace(0.0, 1.0, steps + 1)[1:]:

        def excess(unknown, factor=factor):
            return (_march(unknown * scale, pieces, rigidity, factor * force)[2] - factor * moment) / scale

        found = root(excess, root_moment / scale, tol=1e-12)
        if np.abs(found.fun).max() > 1e-9:
            raise ArithmeticError(f"the rod was not found at load factor {factor}: {found.message}")
        root_moment = found.x * scale
    return _march(root_moment, pieces, rigidity, force)[0]
