"""Two parallel wires of metal that yields: strip, approach and conductance per length on the way up and back.

Below the onset they are those of references/parallel_wires.py. Source: R. L. Jackson, I. Green, J. Tribol. 127 (2005)
343-354 with the factor of theory (15.1) for a slender ellipse (onset), theory (15.11) and (15.12) for the loading. On the
way back flat punches of all widths up to that of the strip are taken off: each opens with the compliance of an elastic
contact as wide as it is (K. L. Johnson, Contact Mechanics (1985), section 2.8), so that the approach is an integral over
the force, by quadrature, not from the closed forms.
"""

import math
from dataclasses import dataclass

from scipy.integrate import quad
from scipy.optimize import brentq

from verification.references.parallel_wires import ParallelWires


@dataclass(frozen=True)
class YieldedLine:
    """The law; SI units."""

    wires: ParallelWires
    yield_stress: float

    @property
    def radius(self):
        """r1 r2/(r1 + r2)."""
        return 1 / (1 / self.wires.first.radius + 1 / self.wires.second.radius)

    @property
    def onset(self):
        """Pressure in the middle, half width and force per length where the metal begins to yield."""
        poisson = min(self.wires.first.poisson, self.wires.second.poisson)
        pressure = 1.295 * math.exp(0.736 * poisson) * 1.11 * self.yield_stress
        half_width = 2 * self.radius * pressure / self.wires.modulus
        return pressure, half_width, math.pi / 2 * half_width * pressure

    def elastic_force(self, half_width):
        """Force per length of elastic wires with a strip as wide."""
        return math.pi * self.wires.modulus * half_width**2 / (4 * self.radius)

    def half_width(self, force):
        """On the way up: straight on from the onset."""
        pressure, first, onset = self.onset
        return self.wires.half_width(force) if force <= onset else first + (force - onset) / (math.pi * pressure)

    def approach(self, force):
        """Of the axes on the way up: under a strip as wide as it is, and what is flattened beyond the elastic strip."""
        if force <= 0:
            return 0.0
        b, hertz = self.half_width(force), self.wires.half_width(force)
        narrower = 2 * force / (math.pi * self.wires.modulus) * math.log(b / hertz)
        return self.wires.approach(force) - narrower + (b**2 - hertz**2) / (2 * self.radius)

    def force_at(self, approach):
        """On the way up."""
        return brentq(lambda f: self.approach(f) - approach, 0, 1e6 * self.onset[2], xtol=1e-12, rtol=1e-14)

    def evenness(self, largest):
        """How much of the pressure is even: 0 at the onset, 1 where the mean pressure is twice that of the onset."""
        mean, first = largest / (2 * self.half_width(largest)), math.pi / 4 * self.onset[0]
        return max(0.0, mean / first - 1)

    def punches(self, largest, angle):
        """Force per length and radian of the flat punches of half width b sin(angle) in the pressure of a force."""
        even = self.evenness(largest)
        # Hertz: punches of weight c dc; an even pressure: of weight c/sqrt(b^2 - c^2) dc
        return largest * (2 * (1 - even) * math.sin(angle) * math.cos(angle) + even * math.sin(angle))

    def compliance(self, half_width):
        """dapproach/dforce of a strip that stays as wide."""
        return sum(
            (1 - wire.poisson**2) / (math.pi * wire.young)
            * (2 * math.log(2 * wire.radius / half_width) - 1 / (4 * (1 - wire.poisson)) - 1)
            for wire in (self.wires.first, self.wires.second)
        )  # fmt: skip

    def back(self, angle, largest):
        """Force and approach on the way back, where the punches up to b sin(angle) are left."""
        b = self.half_width(largest)
        force = quad(lambda t: self.punches(largest, t), 0, angle)[0]
        gone = quad(
            lambda t: self.punches(largest, t) * self.compliance(b * math.sin(t)),
            angle,
            math.pi / 2,
            epsabs=0,
            epsrel=1e-10,
        )[0]
        return force, self.approach(largest) - gone

    def dent(self, largest):
        """Approach at which the wires part."""
        return self.back(0.0, largest)[1]

    def at(self, approach, largest):
        """Force and conductance per length at an approach, with the largest force so far; both 0 over a dent."""
        if largest <= self.onset[2] or approach >= self.approach(largest):
            force = self.force_at(approach)
            return force, self.conductance(self.half_width(force))
        if approach <= self.dent(largest):
            return 0.0, 0.0
        angle = brentq(lambda t: self.back(t, largest)[1] - approach, 1e-6, math.pi / 2, xtol=1e-13)
        return self.back(angle, largest)[0], self.conductance(self.half_width(largest) * math.sin(angle))

    def conductance(self, half_width):
        """Per length, of a strip as wide."""
        return self.wires.conductance(self.elastic_force(half_width))

    def history(self, approaches):
        """Force and conductance per length at one approach after the other."""
        found, largest = [], 0.0
        for approach in approaches:
            found.append(self.at(approach, largest))
            largest = max(largest, found[-1][0])
        return found
