"""A cantilever that a rigid line pushes aside without friction: large deflections in a plane, by shooting.

Between clamp and contact the rod is a planar rod that bends, stretches and shears; the contact force is normal to its
axis at the contact, and beyond it the rod is straight. Equilibrium: force constant, M' = -(r' x force), theta' = M/EI,
r' = (1 + N/EA) t + (Q/GA) n. Source: E. Reissner, J. Appl. Math. Phys. (ZAMP) 23 (1972) 795-804.

All in the frame of the clamped end: the rod leaves the origin along x; the line stands at `line`, on the side of
positive y, and pushes towards negative y.
"""

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root


class Contact(NamedTuple):
    """State of the pushed rod."""

    #: Contact force, gap between the surfaces (negative: overlap), arc length from the clamp to the contact
    force: float
    gap: float
    arc: float
    #: Direction of the axis at the contact [rad], position of the contact and of the tip
    angle: float
    position: np.ndarray
    tip: np.ndarray


def solve(line, length, clearance, penalty, *, ei, ea, ga=np.inf, support_compliance=0.0, start=None):
    """Equilibrium with a line at `line` (x, y).

    Parameters
    ----------
    line : (x, y)
        Position of the line before the support of the line yields.
    length : float
        Length of the rod.
    clearance : float
        Sum of the two radii.
    penalty : float
        Contact force over overlap.
    ei, ea, ga : float
        Stiffnesses of the rod.
    support_compliance : float
        The line yields by this times the contact force, against it.
    start : Contact, optional
        A neighbouring solution.
    """
    line = np.asarray(line, dtype=float)
    scale = ei / length**2

    def end_of(force, arc, angle):
        """Position and direction at the contact, integrated from the clamp; and the moment left there."""
        # the rod is pushed along -n, n the left normal of the axis at the contact
        pull = force * np.array([np.sin(angle), -np.cos(angle)])

        def derivative(_, y):
            t = np.array([np.cos(y[2]), np.sin(y[2])])
            n = np.array([-t[1], t[0]])
            dr = (1 + pull @ t / ea) * t + (pull @ n / ga) * n
            return [dr[0], dr[1], y[3] / ei, -(dr[0] * pull[1] - dr[1] * pull[0])]

        def shot(root_moment):
            return solve_ivp(
                derivative, (0.0, arc), [0.0, 0.0, 0.0, root_moment], method="DOP853", rtol=1e-12, atol=1e-14 * length
            ).y[:, -1]

        return shot

    def excess(unknown):
        force, arc, angle, moment = unknown[0] * scale, unknown[1] * length, unknown[2], unknown[3] * scale * length
        x, y, theta, end_moment = end_of(force, arc, angle)(moment)
        normal = np.array([-np.sin(angle), np.cos(angle)])
        distance = line + support_compliance * force * normal - [x, y]
        overlap = clearance - distance @ normal
        return [
            theta - angle,
            end_moment / (scale * length),
            (distance @ [np.cos(angle), np.sin(angle)]) / length,
            (penalty * overlap - force) / scale,
        ]

    if start is None:
        guess = [1e-3, line[0] / length, -1e-3, -1e-3]
    else:
        guess = [start.force / scale, start.arc / length, start.angle, -start.force * start.arc / (scale * length)]
    found = root(excess, guess, tol=1e-13)
    if np.abs(found.fun).max() > 1e-9:
        raise ArithmeticError(f"the pushed rod was not found: {found.message}")
    force, arc, angle = found.x[0] * scale, found.x[1] * length, found.x[2]
    position = end_of(force, arc, angle)(found.x[3] * scale * length)[:2]
    tip = position + (length - arc) * np.array([np.cos(angle), np.sin(angle)])
    return Contact(force, -force / penalty, arc, angle, position, tip)
