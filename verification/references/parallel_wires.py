"""Parallel round wires that are pressed together: force, approach and conductance per length, in closed form.

The strip of contact has the half width b = sqrt(4 f R/(pi E*)), R = r_1 r_2/(r_1 + r_2), under the force f per length. The
section of each wire is a disc, loaded on its rim by the strip and held by shear all over: its middle approaches the strip
by f (1 - nu^2)/(pi E) (2 ln(2 r/b) - 1/(4 (1 - nu))), but for a relative error of the order b/r. Current enters at the
strip and leaves all over the section, into the wire: from the strip to the mean of the section the resistance of a unit
length is (rho/pi) (ln(1/sin(b/(2 r))) + 1/8), exact for a strip that is an arc of the rim at one potential.

Sources: K. L. Johnson, Contact Mechanics (1985), section 4.2(c) and 5.6 (strip and approach of cylinders); N. I. Muskhelishvili,
Some Basic Problems of the Mathematical Theory of Elasticity (1953) (disc loaded on its rim); the logarithmic capacity of
an arc, sin(b/(2 r)), T. Ransford, Potential Theory in the Complex Plane (1995), table 5.1.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq


@dataclass(frozen=True)
class PressedWire:
    """A wire: radius [m], Young's modulus [Pa], Poisson's ratio, resistivity [ohm m]."""

    radius: float
    young: float
    poisson: float
    resistivity: float = 0.0


@dataclass(frozen=True)
class ParallelWires:
    """Two wires; `film`: resistance times area of a film between them [ohm m^2]."""

    first: PressedWire
    second: PressedWire
    film: float = 0.0

    @property
    def modulus(self):
        """E* [Pa]."""
        return 1 / sum((1 - wire.poisson**2) / wire.young for wire in (self.first, self.second))

    def half_width(self, force):
        """Half width of the strip [m] under a force per length [N/m]."""
        r1, r2 = self.first.radius, self.second.radius
        return math.sqrt(4 * force * r1 * r2 / (r1 + r2) / (math.pi * self.modulus))

    def approach(self, force):
        """Approach of the axes [m]."""
        if force <= 0:
            return 0.0
        b = self.half_width(force)
        return sum(
            force * (1 - wire.poisson**2) / (math.pi * wire.young)
            * (2 * math.log(2 * wire.radius / b) - 1 / (4 * (1 - wire.poisson)))
            for wire in (self.first, self.second)
        )  # fmt: skip

    def force(self, approach):
        """Force per length [N/m] at an approach of the axes [m]."""
        smallest = min(self.first.radius, self.second.radius)
        widest = (smallest / 4 / self.half_width(1.0)) ** 2
        return brentq(lambda force: self.approach(force) / approach - 1, 1e-12 * widest, widest, rtol=1e-14)

    def conductance(self, force):
        """Conductance per length [S/m]."""
        b = self.half_width(force)
        discs = sum(
            wire.resistivity / math.pi * (math.log(2 * wire.radius / b) + 1 / 8) for wire in (self.first, self.second)
        )
        return 1 / (discs + self.film / (2 * b))

    def resistance_of_arc(self, force):
        """Resistance of a unit length without a film [ohm m], for strips that are arcs."""
        b = self.half_width(force)
        return sum(
            wire.resistivity / math.pi * (math.log(1 / math.sin(b / (2 * wire.radius))) + 1 / 8)
            for wire in (self.first, self.second)
        )

    def nearly_parallel(self, force, angle, length):
        """Overlap [m] and conductance [S] of straight wires of a `length` that cross in their middle under a force [N].

        The angle [rad] is so small that they overlap over many radii: each section is one of parallel wires.
        """
        sine, distance = math.sin(angle), self.first.radius + self.second.radius
        points, weights = np.polynomial.legendre.leggauss(40)
        # places s = half sin(t): the overlap ends with the square root of a length, a smooth function of t
        t = math.pi / 4 * (points + 1)
        weights = weights * math.pi / 4 * np.cos(t)

        def sections(overlap):
            half = min(length / 2, math.sqrt(2 * distance * overlap) / sine) if sine > 0 else length / 2
            overlaps = overlap - (half * np.sin(t) * sine) ** 2 / (2 * distance)
            return half, [self.force(each) for each in overlaps]

        def excess(overlap):
            half, forces = sections(overlap)
            return 2 * half * float(weights @ forces) / force - 1

        widest = (min(self.first.radius, self.second.radius) / 4 / self.half_width(1.0)) ** 2
        overlap = brentq(excess, 1e-6 * distance, 0.999 * self.approach(widest), rtol=1e-12)
        half, forces = sections(overlap)
        return overlap, 2 * half * float(weights @ [self.conductance(each) for each in forces])
