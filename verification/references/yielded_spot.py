"""Two equal wires of metal that yields, crossed at right angles: the spot over the overlap, and with a spring before it.

A circle: paraboloids of curvature 1/r as a sphere of radius r on a plane. Source: K. L. Johnson, Contact Mechanics (1985),
section 4.2 (Hertz), R. L. Jackson, I. Green, J. Tribol. 127 (2005) 343-354 (onset), and theory section 15 for the
power laws of loading and for the way back, on which flat punches of all radii up to that of the spot are taken off an
elastic half-space. The overlap on the way back comes from their integrals, by quadrature, not from the closed forms.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq


@dataclass(frozen=True)
class YieldedSpot:
    """The law; SI units."""

    radius: float
    young: float
    poisson: float
    yield_stress: float
    hardness: float

    @property
    def modulus(self):
        """E* of two equal wires."""
        return self.young / (2 * (1 - self.poisson**2))

    @property
    def onset_pressure(self):
        """Largest pressure of Hertz where the metal begins to yield."""
        return 1.295 * np.exp(0.736 * self.poisson) * self.yield_stress

    @property
    def onset(self):
        """Overlap, force and area there."""
        a = np.pi * self.radius * self.onset_pressure / (2 * self.modulus)
        area = np.pi * a**2
        return a**2 / self.radius, 2 / 3 * self.onset_pressure * area, area

    def loading(self, overlap):
        """Force and area on the way up."""
        first, unit, area = self.onset
        omega, slope = overlap / first, 2 * self.hardness / self.onset_pressure
        if omega <= 1:
            return unit * omega**1.5, area * omega
        plastic = 1 + 9 / 8 * (slope**4 - 1)
        f = 1 + 9 / 8 * (omega ** (4 / 3) - 1) if omega <= slope**3 else plastic + 1.5 * slope * (omega - slope**3)
        # dA/dF falls from 1/p_Y at the onset to 1/H as a power of the force
        power = np.log(self.hardness / self.onset_pressure) / np.log(plastic)
        grown = quad(
            lambda g: g**-power if g < plastic else self.onset_pressure / self.hardness, 1, f, points=[min(f, plastic)]
        )[0]
        return unit * f, area + unit / self.onset_pressure * grown

    def overlap_of(self, force):
        """Overlap on the way up."""
        return brentq(lambda d: self.loading(d)[0] - force, 0, 0.2 * self.radius, xtol=1e-18, rtol=1e-14)

    def punches(self, largest):
        """On the way back from a force: radius, and force of the punches up to a radius (parts of radius and force)."""
        area = self.loading(self.overlap_of(largest))[1]
        hertz = 2 / 3 * self.onset_pressure
        even = max(0.0, (largest / area - hertz) / (self.hardness - hertz))

        def force_of_rest(part):
            # Hertz: punches of weight b db; an even pressure: of weight b/sqrt(1 - b^2) db, each with the force ~ b
            return (1 - even) * part**3 + even * 4 / np.pi * quad(lambda t: np.sin(t) ** 2, 0, np.arcsin(part))[0]

        return np.sqrt(area / np.pi), force_of_rest

    def back(self, force, largest):
        """Overlap and radius of the spot on the way back from the largest force."""
        radius, force_of_rest = self.punches(largest)
        part = brentq(lambda x: force_of_rest(x) - force / largest, 0, 1, xtol=1e-15)
        # a ring opens with the stiffness of the disc within it, 2 E* a
        way = quad(lambda f: self.opening(f, force_of_rest), force / largest, 1, epsabs=1e-12)[0]
        return self.overlap_of(largest) - largest / (2 * self.modulus * radius) * way, part * radius

    @staticmethod
    def opening(force, force_of_rest):
        """One over the part of the radius that touches at a part of the force."""
        return 1 / max(brentq(lambda x: force_of_rest(x) - force, 0, 1, xtol=1e-15), 1e-300)

    def at(self, force, largest):
        """Overlap and radius of the spot."""
        if force >= largest:
            overlap = self.overlap_of(force)
            return overlap, np.sqrt(self.loading(overlap)[1] / np.pi)
        return self.back(force, largest)

    def dent(self, largest):
        """Overlap at which the wires part."""
        return self.back(0.0, largest)[0]

    def dissipation(self, largest):
        """Work of the way up to a force less that of the way back."""
        force = np.linspace(0, 1, 401) ** 2 * largest
        return np.trapezoid([self.back(f, largest)[0] - self.overlap_of(f) for f in force], force)

    def behind_spring(self, stiffness, position, largest):
        """Force and radius of the spot where a spring before the wires has been pushed to a position (0: they touch)."""
        if position <= (self.dent(largest) if largest > 0 else 0.0):
            return 0.0, 0.0
        force = brentq(lambda f: f / stiffness + self.at(f, largest)[0] - position, 0, stiffness * position, xtol=1e-15)
        return force, self.at(force, largest)[1]
