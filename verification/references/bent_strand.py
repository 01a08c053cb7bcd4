"""A straight strand of a core and helical wires, pulled and then bent to an even curvature, with friction on the core.

Two descriptions of the same strand, both linear in the curvature and for wires that touch the core only:

`Papailiou` has plane sections. A wire at the angle p from the neutral axis has the strain k r cos^2 b sin p, until the force that
this needs exceeds the friction of a rope on a drum, T (exp(mu sin b p) - 1). Between two places of largest strain it slides in
one direction, from the neutral axis outwards; unloading is loading to twice as much (Masing).

`Rods` has thin rods that bend, twist, and roll on the core as well, with friction at their surface. All fields of a wire go with
the sine or cosine of p; in the frame of tangent t, normal N (to the core) and binormal b of its helix, with curvature K and
torsion H, what it moves and turns beyond a plane section is u t + v b and (q, n, u K - v H), and

    strain           u' + k r c^2 sin p
    n                -v' - k r c s sin p
    surface slips    u (1 - a K) + a H v   along t,     v + a q   along b

of which friction holds both (sticking), and slides along t with the wire rolling along b (slipping). What the curvature of the
strand and the tension do to each other is left out.

Sources: K. O. Papailiou, IEEE Trans. Power Delivery 12 (1997) 1576-1588; F. Foti, L. Martinelli, Int. J. Solids Struct. 91 (2016)
1-17 (plane sections, friction); A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, 4th ed. (1927), article 254
(thin rods); G. A. Costello, Theory of Wire Rope, 2nd ed. (1997), chapter 5 (a helical wire that slides freely).
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from verification.references.helical_rods import Strand

QUARTER = math.pi / 2


@dataclass(frozen=True)
class Papailiou:
    """Plane sections; tension: of a wire [N]."""

    strand: Strand
    friction: float
    tension: float

    @property
    def slipping(self):
        """Stiffness of wires that slide freely [N m^2]."""
        strand = self.strand
        return strand.core.ei + strand.count * strand.wire.ei * math.cos(strand.free.angle)

    @property
    def _levers(self):
        """Force of a wire over curvature and the sine of its place, and moment of all over force and sine."""
        radius, cosine = self.strand.free.radius, math.cos(self.strand.free.angle)
        return self.strand.wire.ea * radius * cosine**2, self.strand.count * radius * cosine

    @property
    def sticking(self):
        """Stiffness of a strand whose wires stick [N m^2]."""
        force, moment = self._levers
        return self.slipping + force * moment / 2

    @property
    def first_slip(self):
        """Curvature at which wires slip at the neutral axis [1/m]."""
        return self.tension * self.friction * math.sin(self.strand.free.angle) / self._levers[0]

    def friction_moment(self, curvature):
        """Moment of the forces along the wires on first loading [N m]."""
        stiffness, lever = self._levers
        rate, force = self.friction * math.sin(self.strand.free.angle), stiffness * curvature

        def limit(angle):
            return self.tension * math.expm1(rate * angle)

        end = 0.0
        if curvature > self.first_slip:
            end = QUARTER
            if force > limit(QUARTER):
                return lever * 2 / math.pi * quad(lambda p: limit(p) * math.sin(p), 0, QUARTER)[0]
            # at the neutral axis itself both are zero
            end = brentq(lambda p: force * math.sin(p) - limit(p), 1e-9, QUARTER) if limit(QUARTER) > force else QUARTER
        slides = quad(lambda p: limit(p) * math.sin(p), 0, end)[0]
        sticks = force * quad(lambda p: math.sin(p) ** 2, end, QUARTER)[0]
        return lever * 2 / math.pi * (slides + sticks)

    def moment(self, curvature):
        """Moment on first loading [N m]."""
        return self.slipping * curvature + self.friction_moment(curvature)

    def unloading(self, curvature, largest):
        """Moment on the way back from the largest curvature [N m]."""
        back = 2 * self.friction_moment((largest - curvature) / 2)
        return self.slipping * curvature + self.friction_moment(largest) - back

    def loop(self, largest):
        """Work of friction per length in a cycle between opposite curvatures [N]."""
        area = quad(self.friction_moment, 0, largest, points=[self.first_slip], limit=200)[0]
        return 8 * area - 4 * largest * self.friction_moment(largest)


@dataclass(frozen=True)
class Rods:
    """Thin rods that roll; tension: of a wire [N]."""

    strand: Strand
    friction: float
    tension: float

    def _strains(self):
        """Rows of amplitudes for a curvature of one, and for u, v, q of one: strain, and curvatures about t, N, b.

        u, v, q go with cos p, as does the curvature about N; the others go with sin p.
        """
        helix, radius = self.strand.free, self.strand.free.radius
        s, c = math.sin(helix.angle), math.cos(helix.angle)
        turn, bend, twist = s / radius, s * s / radius, s * c / radius
        plane, u, v, q = np.eye(4)
        n = turn * v - radius * c * s * plane
        about_b = bend * u - twist * v
        return np.array([
            -turn * u + radius * c * c * plane,
            -turn * q - bend * n - s * c * plane,
            turn * n + bend * q - twist * about_b - c * plane,
            -turn * about_b + twist * n + c * c * plane,
        ])  # fmt: skip

    def _slips(self):
        """Rows of amplitudes of both slips of the surface, as for `_strains`."""
        helix, wire = self.strand.free, self.strand.wire.radius
        s, c, radius = math.sin(helix.angle), math.cos(helix.angle), helix.radius
        return np.array([[0, 1 - wire * s * s / radius, wire * s * c / radius, 0], [0, 0, 1, wire]])

    def _matrix(self):
        """Moment of the wires, and forces per length along u, v, q, over amplitudes."""
        wire, strains = self.strand.wire, self._strains()
        stiffness = np.diag([wire.ea, wire.gj, wire.ei, wire.ei])
        # mean squares are one half; a length of the strand has longer wires
        return self.strand.count / 2 / math.cos(self.strand.free.angle) * strains.T @ stiffness @ strains

    def _state(self, held):
        """Stiffness, amplitudes and friction per length of all wires, over the curvature; `held`: rows of slips that are zero."""
        matrix, slips = self._matrix(), self._slips()[held]
        size = len(slips)
        system = np.block([[matrix[1:, 1:], slips[:, 1:].T], [slips[:, 1:], np.zeros((size, size))]])
        found = np.linalg.solve(system, np.concatenate([-matrix[1:, 0], np.zeros(size)]))
        amplitudes = np.concatenate([[1.0], found[:3]])
        return matrix[0] @ amplitudes, amplitudes, found[3:]

    @property
    def sticking(self):
        """Stiffness of a strand whose wires stick, but for rolling [N m^2]."""
        return self.strand.core.ei + self._state([0, 1])[0]

    @property
    def slipping(self):
        """Stiffness of wires that slide along the core and roll on it [N m^2]."""
        return self.strand.core.ei + self._state([1])[0]

    @property
    def free(self):
        """Stiffness of smooth wires [N m^2]."""
        return self.strand.core.ei + self._state([])[0]

    @property
    def _pressed(self):
        """Force of a wire on the core per length."""
        return self.tension * math.sin(self.strand.free.angle) ** 2 / self.strand.free.radius

    @property
    def first_slip(self):
        """Curvature at which wires slip at the neutral axis [1/m]."""
        forces = self._state([0, 1])[2]
        share = 2 * math.cos(self.strand.free.angle) / self.strand.count
        return self.friction * self._pressed / (share * math.hypot(*forces))

    @property
    def friction_moment(self):
        """Moment of friction on wires that slip everywhere [N m]: its work by the slips that a curvature makes."""
        amplitudes = self._state([1])[1]
        slip = abs(self._slips()[0] @ amplitudes)
        wires = self.strand.count / math.cos(self.strand.free.angle)
        return wires * self.friction * self._pressed * slip * 2 / math.pi
