"""A thin rod with bending stiffness that slips over a drum: exact tensions, contact arc and forces at the lift-offs.

The centre line has the curvature 1/R on the drum, where the tension N (the internal force along the rod) grows by friction,
dN/d(angle) = mu N. Away from the drum the rod is an elastica that goes over into a straight tail under T. There the
moment goes from 0 to B/R, so that N = T - B/(2 R^2) at the lift-off, with a shear force P = sqrt(T^2 - N^2) that the drum takes
as a point force, with the friction mu P; the tail has turned by the angle whose cosine is N/T. Friction acts on the
centre line: the rod is much thinner than the drum.

Source: H. Singh, J. Elast. 151 (2022) 321-346, doi 10.1007/s10659-022-09939-8 (rod on a capstan, with friction); first
integral of the elastica, A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, 4th ed. (1927), article 262.
"""

import math
from typing import NamedTuple

from scipy.optimize import brentq


class Capstan(NamedTuple):
    """Pulling tension T2, contact arc [rad], point forces at the slack and at the pulling end."""

    tension: float
    arc: float
    slack_force: float
    pulling_force: float


def lift_off(tension):
    """Tension on the drum, point force and angle of the tail at a lift-off; R = B = 1."""
    inside = tension - 0.5
    if inside < 0:
        raise ValueError(f"a tension of {tension:g} B/R^2 does not bring the rod onto the drum")
    return inside, math.sqrt(tension**2 - inside**2), math.acos(inside / tension)


def capstan(slack, wrap, friction):
    """State of a rod that slips towards its pulling end: slack tension T1, angle between the tails [rad], mu; R = B = 1."""
    inside, slack_force, slack_angle = lift_off(slack)

    def arrives(tension):
        wanted, force, angle = lift_off(tension)
        arc = wrap - slack_angle - angle
        got = (inside + friction * slack_force) * math.exp(friction * arc) + friction * force
        return got - wanted

    # without friction both tensions are the same
    tension = slack
    if friction > 0:
        tension = brentq(arrives, slack, 2 * slack * math.exp(friction * wrap), xtol=1e-15, rtol=1e-15)
    _, force, angle = lift_off(tension)
    return Capstan(tension, wrap - slack_angle - angle, slack_force, force)
