"""A rod under tension that is twisted until it winds around itself: the ply of a long plectoneme.

The two strands of the ply are helices of radius r at an angle to its axis. Rod that goes into the ply brings the ends
together by its length, and takes up the writhe sin(2 angle)/(4 pi r) per length. With the bending stiffness B, tension F and
moment M of the tails the potential of the ply is, per length of rod,

    v(angle, r) = B sin^4(angle)/(2 r^2) + F - M sin(2 angle)/(2 r),

which is zero (the ply grows and shrinks freely), stationary in the angle, and has the line force between the strands as its
derivative by r. Solved for F, M and the line force these are the closed forms of N. Clauvelin, B. Audoly, S. Neukirch,
Biophysical Journal 96 (2009) 3716-3723: inextensible, without friction, the ply long.
"""

import math
from typing import NamedTuple

from scipy.optimize import brentq


class Ply(NamedTuple):
    """Angle of the strands to the axis [rad], radius of their helices [m], tension [N] and moment [N m] of the tails, and force
    between the strands per length [N/m].
    """

    angle: float
    radius: float
    force: float
    moment: float
    line_force: float


def at_angle(angle, radius, bending):
    """The ply with this angle, of a rod with the bending stiffness B [N m^2]."""
    sine, twice = math.sin(angle), math.cos(2 * angle)
    return Ply(
        angle,
        radius,
        bending / radius**2 * sine**4 * (1 / 2 + 1 / twice),
        2 * bending / radius * sine**3 * math.cos(angle) / twice,
        bending / radius**3 * sine**4 / twice,
    )


def under_tension(force, rod_radius, bending, stiffness=math.inf):
    """The ply at a tension [N]; `stiffness`: force per length and overlap of the strands [N/m^2]."""

    def with_radius(radius):
        angle = brentq(lambda a: at_angle(a, radius, bending).force - force, 1e-4, 0.25 * math.pi - 1e-6, xtol=1e-14)
        return at_angle(angle, radius, bending)

    if math.isinf(stiffness):
        return with_radius(rod_radius)
    radius = brentq(
        lambda r: with_radius(r).line_force - stiffness * 2 * (rod_radius - r), 0.8 * rod_radius, rod_radius, rtol=1e-13
    )
    return with_radius(radius)
