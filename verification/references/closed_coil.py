"""A coil whose turns touch their neighbours: a helical rod that stays a uniform helix while its turns press on each other.

A rod of unit reference length has the energy u(r, h, w) of a uniform helix (helical_rods.py). Between the axis of a coil and
its next turn there is the least distance D(r, h, w), the same everywhere along it, since a screw motion carries a uniform helix
into itself. Turns that overlap by 2 a - D press on each other with the force p = k (2 a - D) per reference length, the
derivative of the energy k (2 a - D)^2/2, which belongs to each unit of length once. The radius makes the sum of both energies
stationary, and its derivatives by h and w are the axial force and the axial moment that the coil carries: exact for uniform
helices.
"""

import math
from dataclasses import dataclass

from scipy.optimize import brentq, minimize_scalar

from verification.references.helical_rods import Helix, Rod, State, energy, loads


def next_turn(helix):
    """Least distance of the axis from its next turn [m], and the angle from a place to the nearest one there [rad]."""
    r, h, w = helix

    def square(angle):
        return 2 * r**2 * (1 - math.cos(angle)) + (h * angle / w) ** 2

    def slope(angle):
        return r**2 * math.sin(angle) + (h / w) ** 2 * angle

    # the nearest place is not straight above, but nearer along the coil by less than a right angle
    near = minimize_scalar(square, bounds=(1.5 * math.pi, 2 * math.pi), method="bounded").x
    angle = brentq(slope, near - 0.1, near + 0.1, xtol=1e-15, rtol=1e-15)
    return math.sqrt(square(angle)), angle


@dataclass(frozen=True)
class ClosedCoil:
    """A coil: rod, helix without stress, and force per length and overlap of its turns [N/m^2]."""

    rod: Rod
    free: Helix
    stiffness: float

    def line_force(self, helix):
        """Force between two turns per reference length [N/m]; 0: they are apart."""
        return self.stiffness * max(0.0, 2 * self.rod.radius - next_turn(helix)[0])

    def energy(self, helix):
        """Of the rod and of its contact, per reference length [N]."""
        return energy(self.rod, helix, self.free) + self.line_force(helix) ** 2 / (2 * self.stiffness)

    def loads(self, helix):
        """Derivatives of `energy` by radius, height and turn; the nearest place does not matter to first order."""
        r, h, w = helix
        distance, angle = next_turn(helix)
        pressed = self.line_force(helix) / distance
        of_rod = loads(self.rod, helix, self.free)
        return (
            of_rod.line_force - pressed * 2 * r * (1 - math.cos(angle)),
            of_rod.force - pressed * h * (angle / w) ** 2,
            of_rod.moment + pressed * (h * angle) ** 2 / w**3,
        )

    def state(self, height, turn=None):
        """The coil at an axial height per reference length, and at a turn [rad/m] (None: that without stress)."""
        turn = self.free.turn if turn is None else turn

        def helix(radius):
            return Helix(radius, height, turn)

        free = self.free.radius
        radius = brentq(lambda r: self.loads(helix(r))[0], 0.9 * free, 1.1 * free, xtol=1e-18, rtol=1e-15)
        _, force, moment = self.loads(helix(radius))
        return State(helix(radius), self.line_force(helix(radius)), force, moment)
