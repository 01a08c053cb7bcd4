"""Two slender beams side by side that bend together, without friction: where they touch, and how they share a load.

Beams of Euler and Bernoulli whose axes would lie on each other. Where both are bent alike no pressure acts between them unless
a load does: receding contact consists of point forces at the ends of its zones. With a law p = k v of the pressure over the
overlap v, two beams with the same supports, one under a uniform load q, obey the equation of the beam on an elastic
foundation: R v'''' + k v = p0, with 1/R = 1/EI_1 + 1/EI_2 and p0 = q R/EI_1.

Sources: S. Timoshenko, Strength of Materials, part II (1956) (leaf springs: cantilevers in contact at their tips);
L. M. Keer, J. Dundurs, K. C. Tsai, J. Appl. Mech. 39 (1972) 1115-1120 (receding contact); M. Hetényi, Beams on Elastic
Foundation (1946).
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Cantilevers:
    """A cantilever of `length` [m] on a shorter one of `support` [m], clamped side by side; a force [N] at its tip.

    They touch at the tip of the shorter one only.
    """

    length: float
    support: float
    ei: float
    ei_support: float
    force: float

    @property
    def contact_force(self):
        """Force at the tip of the shorter one [N]."""
        arm = (3 * self.length - self.support) / (2 * self.support)
        return self.force * arm * self.ei_support / (self.ei + self.ei_support)

    @property
    def support_deflection(self):
        """Deflection of the tip of the shorter one [m]."""
        return self.contact_force * self.support**3 / (3 * self.ei_support)

    @property
    def deflection(self):
        """Deflection of the loaded tip [m]."""
        lifted = self.contact_force * self.support**2 * (3 * self.length - self.support) / (6 * self.ei)
        return self.force * self.length**3 / (3 * self.ei) - lifted

    def gap(self, x):
        """Distance of the beams at places x (n) from the clamp up to `support` [m]."""
        x = np.asarray(x, dtype=float)
        loaded = self.force * x**2 * (3 * self.length - x) / (6 * self.ei)
        pushed = self.contact_force * x**2 * (3 * self.support - x) / 6
        return pushed * (1 / self.ei + 1 / self.ei_support) - loaded


@dataclass(frozen=True)
class ThreePointBending:
    """A beam on another one of the same span [m], which has supports at its ends; a force [N] on the middle of the upper."""

    span: float
    ei: float
    ei_lower: float
    force: float

    @property
    def middle_force(self):
        """Point force between the beams in the middle [N]; nothing acts from there to the ends."""
        return self.force * self.ei_lower / (self.ei + self.ei_lower)

    @property
    def end_force(self):
        """Point force between the beams at each end [N]."""
        return (self.force - self.middle_force) / 2

    @property
    def deflection(self):
        """Deflection of the middle [m]."""
        return self.force * self.span**3 / (48 * (self.ei + self.ei_lower))


@dataclass(frozen=True)
class SharedLoad:
    """Two beams clamped at both ends over a span [m], one of which carries a uniform load [N/m] and presses on the other.

    stiffness: of the contact, k [N/m^2].
    """

    span: float
    ei: float
    ei_other: float
    load: float
    stiffness: float

    @property
    def relative_ei(self):
        """R [N m^2]."""
        return self.ei * self.ei_other / (self.ei + self.ei_other)

    @property
    def decay_length(self):
        """(4 R/k)^(1/4) [m]."""
        return (4 * self.relative_ei / self.stiffness) ** 0.25

    @property
    def far_pressure(self):
        """Line force far from the ends [N/m]."""
        return self.load * self.relative_ei / self.ei

    def pressure(self, x):
        """Line force at places x (n) from one end [N/m]."""
        end = self.span / self.decay_length
        factors = np.linalg.solve([*_waves(0.0, end), *_waves(end, end)], [1.0, 0.0, 1.0, 0.0])
        values, _ = _waves(np.asarray(x, dtype=float) / self.decay_length, end)
        return self.far_pressure * (1 - np.tensordot(factors, values, axes=1))

    @property
    def reaction(self):
        """Force of the other beam on each of its clamps [N]: half of what presses on it, by Simpson's rule."""
        n = 2 * max(500, round(100 * self.span / self.decay_length))
        weights = np.resize([2.0, 4.0], n + 1)
        weights[[0, -1]] = 1.0
        pressure = self.pressure(np.linspace(0, self.span, n + 1))
        return float(weights @ pressure) * self.span / (3 * n) / 2


def _waves(x, end):
    """The four solutions of the fourth derivative of y being -4 y, which fall from either end of 0 < x < `end`; slopes."""
    falling, rising = np.exp(-x), np.exp(x - end)
    a, b, c, d = falling * np.cos(x), falling * np.sin(x), rising * np.cos(x), rising * np.sin(x)
    return np.array([a, b, c, d]), np.array([-a - b, a - b, c - d, c + d])
