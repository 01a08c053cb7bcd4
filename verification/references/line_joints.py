"""Two wires side by side that conduct into each other all along: lap joint and hairpin joint.

Voltage u = v_1 - v_2 between the wires, currents I_1 and I_2 along them, resistances r_1 and r_2 per length [ohm/m],
conductance g of the contact per length [S/m]: u' = r_2 I_2 - r_1 I_1, I_1' = -g u, I_2' = g u. All quantities go with
exp(+-m x), m^2 = (r_1 + r_2) g; 1/m is the transfer length.

Source: the transmission line of W. Thomson, Proc. R. Soc. 7 (1855) 382-399; for joints of two conductors H. H. Berger,
J. Electrochem. Soc. 119 (1972) 507-514.
"""

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class LineJoint:
    """Wires that touch from x = 0 to `length` [m]; resistances per length [ohm/m], conductance per length [S/m]."""

    length: float
    conductance: float
    resistance: float
    resistance_2: float

    @property
    def rate(self):
        """m [1/m]."""
        return math.sqrt((self.resistance + self.resistance_2) * self.conductance)

    def lap(self):
        """Resistance of a lap joint [ohm]: current enters the first wire at x = 0 and leaves the second at `length`."""
        r1, r2, m, length = self.resistance, self.resistance_2, self.rate, self.length
        total = r1 + r2
        end = (r1**2 + r2**2) / math.tanh(m * length) + 2 * r1 * r2 / math.sinh(m * length)
        return r1 * r2 * length / total + m / (total**2 * self.conductance) * end

    def lap_current(self, x):
        """Current in the first wire of a lap joint, over the whole current, at places x (n)."""
        r1, r2, m, length = self.resistance, self.resistance_2, self.rate, self.length
        x = np.asarray(x, dtype=float)
        entering, leaving = np.sinh(m * (length - x)), np.sinh(m * x)
        return (r2 + (r1 * entering - r2 * leaving) / math.sinh(m * length)) / (r1 + r2)

    def hairpin(self):
        """Resistance of a hairpin joint [ohm]: current enters the first wire at x = 0 and leaves the second there too."""
        return self.rate / self.conductance / math.tanh(self.rate * self.length)

    def hairpin_current(self, x):
        """Current in the first wire of a hairpin joint, over the whole current, at places x (n)."""
        return np.sinh(self.rate * (self.length - np.asarray(x, dtype=float))) / math.sinh(self.rate * self.length)
