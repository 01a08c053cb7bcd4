"""Two equal wires side by side, clamped at one end, that bend in their common plane and slip on each other.

A force at the tip, half on each wire, bends the pair. Until they slip the wires are one beam with D1 = 2 EI + 2 EA a^2. The
shear between them is the same all along, tau = P EA a/D1 per length; when it reaches mu q, q the line load that presses
them together, slip starts everywhere at once. From then on each wire carries, beside its own bending D0 = 2 EI, the
moment a mu q per length of the friction on its surface.

Source: L. E. Goodman, J. H. Klumpp, J. Appl. Mech. 23 (1956) 421-429, for leaf springs; here with the stiffnesses of
round wires of the radius a.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class SlippingPair:
    """Radius and length [m], Young's modulus [Pa], line load q [N/m], coefficient of friction."""

    radius: float
    length: float
    young: float
    pressing: float
    friction: float

    @property
    def ei(self):
        """Bending stiffness of one wire [N m^2]."""
        return self.young * math.pi * self.radius**4 / 4

    @property
    def stuck_stiffness(self):
        """Tip force over deflection of the pair that sticks [N/m]."""
        ea = self.young * math.pi * self.radius**2
        return 3 * (2 * self.ei + 2 * ea * self.radius**2) / self.length**3

    @property
    def slipping_stiffness(self):
        """Tip force over deflection of the pair that slips [N/m]."""
        return 6 * self.ei / self.length**3

    @property
    def slip_force(self):
        """Tip force at which the pair slips first [N]."""
        ea = self.young * math.pi * self.radius**2
        both = 2 * self.ei + 2 * ea * self.radius**2
        return self.friction * self.pressing * both / (ea * self.radius)

    def path(self, forces):
        """Deflections [m] at tip forces [N] that follow each other from rest; between two of them the force goes one way.

        The pair is an elastic spring beside another one with a slider, which holds what the friction can.
        """
        spring = self.stuck_stiffness - self.slipping_stiffness
        limit = spring / self.stuck_stiffness * self.slip_force
        slid, deflections = 0.0, []
        for force in forces:
            deflection = (force + spring * slid) / self.stuck_stiffness
            held = spring * (deflection - slid)
            if abs(held) > limit:
                held = math.copysign(limit, held)
                deflection = (force - held) / self.slipping_stiffness
                slid = deflection - held / spring
            deflections.append(deflection)
        return deflections

    def loss(self, force):
        """Energy lost in a cycle between -force and force [J]."""
        spring = self.stuck_stiffness - self.slipping_stiffness
        limit = spring / self.stuck_stiffness * self.slip_force
        if force <= self.slip_force:
            return 0.0
        reach = (force - limit) / self.slipping_stiffness
        return 4 * limit * (reach - limit / spring)
