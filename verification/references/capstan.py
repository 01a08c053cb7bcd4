"""A thin rod with bending stiffness that slips over a drum: exact tensions, contact arc and forces at the lift-offs.

The centre line has the curvature 1/R on the drum, where the tension N (the internal force along the rod) grows by friction.
Away from the drum the rod is an elastica that goes over into a straight tail under T. With the moment m B/R at a lift-off,
N = T - m^2 B/(2 R^2) there, with a shear force S = sqrt(T^2 - N^2); the tail has turned by the angle whose cosine is N/T.

Friction on the centre line (thickness 0): dN/d(angle) = mu N, m = 1, and the drum takes S as a point force P, with the
friction mu P.

Friction on the surface of the rod, a = r/R below the centre line, also turns it. With the force f per angle from the drum and the
shear force Q of the rod, the balance of forces and of moments on an arc of given curvature are (R = 1)

    N' + Q = mu f,   Q' - N + f = 0,   Q = a mu f,   so that   N' = mu (1 - a) f,   a mu f' = N - f:

two exponentials, whose exponents solve a mu k^2 + k - mu (1 - a) = 0. At the pulling end a point force P with its friction
mu P turns the rod by the couple a mu P, so that m = 1 - a mu P. At the slack end a point force would bend the rod into the
drum: m = 1, and the force S is distributed by the exponential that falls within a mu R, less than the radius of the rod.

Source: H. Singh, J. Elast. 151 (2022) 321-346, doi 10.1007/s10659-022-09939-8 (rod on a capstan, with friction); first
integral of the elastica, A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, 4th ed. (1927), article 262;
friction on the surface derived above.
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


def capstan(slack, wrap, friction, thickness=0.0):
    """State of a rod that slips towards its pulling end; R = B = 1.

    slack: tension T1; wrap: angle between the tails [rad]; friction: coefficient; thickness: radius of the rod over R where
    friction acts on its surface, 0: on the centre line.
    """
    inside, slack_force, slack_angle = lift_off(slack)
    on_drum = _on_drum(inside, slack_force, friction, thickness)

    def pulling_end(arc):
        """Tension, point force and angle of the tail where the rod leaves the drum after this arc."""
        tension, force = on_drum(arc)
        couple = thickness * friction

        def misses(push):
            inside, bend = tension + friction * push, 1 - couple * push
            return math.hypot(inside, push - couple * force) - inside - bend**2 / 2

        push = brentq(misses, couple * force, 10 * tension, xtol=1e-15, rtol=1e-15)
        inside, bend = tension + friction * push, 1 - couple * push
        pull = inside + bend**2 / 2
        return pull, push, math.acos(inside / pull)

    arc = brentq(lambda arc: arc + slack_angle + pulling_end(arc)[2] - wrap, 0.0, wrap, xtol=1e-15, rtol=1e-15)
    tension, force, _ = pulling_end(arc)
    return Capstan(tension, arc, slack_force, force)


def _on_drum(inside, slack_force, friction, thickness):
    """Tension, and force per angle from the drum, as a function of the angle from the slack lift-off."""
    if friction * thickness == 0:
        first = inside + friction * slack_force
        return lambda angle: (first * math.exp(friction * angle), first * math.exp(friction * angle))
    pull = friction * (1 - thickness)
    root = math.sqrt(1 + 4 * thickness * friction * pull)
    grows, falls = 2 * pull / (1 + root), -(1 + root) / (2 * thickness * friction)
    # the sum of both is the tension, that of their derivatives `pull` times the force per angle, at the lift-off
    slope = pull * slack_force / (thickness * friction)
    fast = (slope - grows * inside) / (falls - grows)
    slow = inside - fast

    def on_drum(angle):
        parts = slow * math.exp(grows * angle), fast * math.exp(falls * angle)
        return sum(parts), (grows * parts[0] + falls * parts[1]) / pull

    return on_drum
