"""Round elastic rods that form uniform helices: two straight wires twisted together, and a strand of a core and outer wires.

A rod of unit reference length on the helix (r cos w s, r sin w s, h s) has the stretch g = sqrt((r w)^2 + h^2), the lay angle
b with tan b = r w/h, the bending w sin b and the twist w cos b. Its energy is
u = EA (g - 1)^2/2 + B (w sin b - bending_0)^2/2 + C (w cos b - twist_0)^2/2, and its derivatives by r, h and w are the
force that holds it out, per reference length, the axial force and the axial moment: exact for uniform helices.

Sources: A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, 4th ed. (1927), articles 270-271 (equilibrium
of a helical rod); J. M. T. Thompson, G. H. M. van der Heijden, S. Neukirch, Proc. R. Soc. A 458 (2002) 959-985 (two rods
in contact); G. A. Costello, Theory of Wire Rope, 2nd ed. (1997) (strands).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from scipy.optimize import brentq, minimize_scalar


@dataclass(frozen=True)
class Rod:
    """A round rod: radius [m], Young's modulus [Pa], Poisson's ratio."""

    radius: float
    young: float
    poisson: float

    @property
    def ea(self):
        """Axial stiffness [N]."""
        return self.young * math.pi * self.radius**2

    @property
    def ei(self):
        """Bending stiffness B [N m^2]."""
        return self.young * math.pi * self.radius**4 / 4

    @property
    def gj(self):
        """Torsional stiffness C [N m^2]."""
        return self.ei / (1 + self.poisson)


class Helix(NamedTuple):
    """A uniform helix per reference length of the rod: radius [m], height, turn [rad/m]."""

    radius: float
    height: float
    turn: float

    @property
    def stretch(self):
        """Length over reference length."""
        return math.hypot(self.radius * self.turn, self.height)

    @property
    def angle(self):
        """Lay angle [rad]."""
        return math.atan2(self.radius * self.turn, self.height)

    @property
    def bending(self):
        """Curvature times stretch [1/m]."""
        return self.turn * math.sin(self.angle)

    @property
    def twist(self):
        """Torsion times stretch [1/m]."""
        return self.turn * math.cos(self.angle)


class Loads(NamedTuple):
    """Derivatives of the energy: line force [N/m], axial force [N], axial moment [N m]."""

    line_force: float
    force: float
    moment: float


STRAIGHT = Helix(0.0, 1.0, 0.0)


def energy(rod, helix, free=STRAIGHT):
    """Energy of a rod per reference length [N]; `free` is its shape without stress."""
    strain = helix.stretch - 1
    bending, twist = helix.bending - free.bending, helix.twist - free.twist
    return (rod.ea * strain**2 + rod.ei * bending**2 + rod.gj * twist**2) / 2


def loads(rod, helix, free=STRAIGHT):
    """Derivatives of `energy` by radius, height and turn."""
    r, _, w = helix
    g, sine, cosine = helix.stretch, math.sin(helix.angle), math.cos(helix.angle)
    tension = rod.ea * (g - 1)
    bending = rod.ei * (helix.bending - free.bending)
    twist = rod.gj * (helix.twist - free.twist)
    # how the lay angle follows: db/dr = w cos b/g, db/dh = -sin b/g, db/dw = r cos b/g
    turning = w * (bending * cosine - twist * sine) / g
    return Loads(
        tension * w * sine + turning * w * cosine,
        tension * cosine - turning * sine,
        tension * r * sine + turning * r * cosine + bending * sine + twist * cosine,
    )


class State(NamedTuple):
    """A bundle in equilibrium: helix of a wire, line force [N/m of reference], axial force [N], axial moment [N m]."""

    helix: Helix
    line_force: float
    force: float
    moment: float


@dataclass(frozen=True)
class TwistedPair:
    """Two straight wires of a length [m] side by side, the ends of which are turned against each other and moved apart."""

    rod: Rod
    length: float

    def stretched(self, turns, height, approach: Callable | None = None):
        """State at an axial stretch; `approach` of the axes [m] over the line force [N/m], None: rigid surfaces."""
        turn = 2 * math.pi * turns / self.length
        a = self.rod.radius

        def pressed(radius):
            return loads(self.rod, Helix(radius, height, turn)).line_force

        radius = a
        if approach is not None and pressed(a) > 0:
            radius = brentq(lambda r: approach(pressed(r)) - 2 * (a - r), 0.9 * a, a, xtol=1e-18, rtol=1e-15)
        helix = Helix(radius, height, turn)
        line, force, moment = loads(self.rod, helix)
        return State(helix, line, 2 * force, 2 * moment)

    def pulled(self, turns, force, approach: Callable | None = None):
        """State under an axial force [N]."""
        height = brentq(lambda h: self.stretched(turns, h, approach).force - force, 0.99, 1.01, xtol=1e-16, rtol=1e-15)
        return self.stretched(turns, height, approach)


@dataclass(frozen=True)
class Strand:
    """A straight core and `count` wires laid on it without stress; the wires touch the core only.

    pitch: lay length [m]; contraction: share of Poisson's contraction of core and wires that brings their axes together, 0
    for beams, 1 for Costello's equations.
    """

    core: Rod
    wire: Rod
    count: int
    pitch: float
    contraction: float = 0.0

    @property
    def free(self):
        """The outer wires without stress."""
        radius, turn = self.core.radius + self.wire.radius, 2 * math.pi / self.pitch
        reference = math.hypot(radius * turn, 1.0)
        return Helix(radius, 1 / reference, turn / reference)

    def state(self, strain, turn=0.0, approach: Callable | None = None):
        """State at an axial strain and a turn per length [rad/m]; `approach` as for `TwistedPair`.

        Line force of one wire per reference length of it; force and moment of the whole strand.
        """
        free = self.free
        share = free.height

        def helix(radius):
            return Helix(radius, (1 + strain) * share, free.turn + turn * share)

        def excess(radius):
            found = helix(radius)
            line = loads(self.wire, found, free).line_force
            drawn_in = self.contraction * (
                self.core.poisson * self.core.radius * strain
                + self.wire.poisson * self.wire.radius * (found.stretch - 1)
            )
            pressed = approach(line) if approach is not None and line > 0 else 0.0
            return radius + drawn_in + pressed - free.radius

        radius = brentq(excess, 0.9 * free.radius, 1.1 * free.radius, xtol=1e-18, rtol=1e-15)
        line, force, moment = loads(self.wire, helix(radius), free)
        # of the wires per length of the strand: reference lengths are longer by 1/share, derivatives by strain and turn
        # bring share back
        return State(
            helix(radius),
            line,
            self.core.ea * strain + self.count * force,
            self.core.gj * turn + self.count * moment,
        )

    def pulled_free(self, strain, approach: Callable | None = None):
        """Turn per length and state of a strand whose ends are free to turn."""
        turn = brentq(lambda phi: self.state(strain, phi, approach).moment, -2000 * abs(strain), 2000 * abs(strain))
        return turn, self.state(strain, turn, approach)

    def stiffness(self):
        """dF/d(strain), dF/d(turn), dM/d(turn), and d(line force)/d(strain), at no load and with rigid surfaces."""
        strain, turn = 1e-6, 1e-3
        strained = [self.state(sign * strain) for sign in (1, -1)]
        turned = [self.state(0.0, sign * turn) for sign in (1, -1)]

        def slope(states, name, step):
            return (getattr(states[0], name) - getattr(states[1], name)) / (2 * step)

        return (
            slope(strained, "force", strain),
            slope(turned, "force", turn),
            slope(turned, "moment", turn),
            slope(strained, "line_force", strain),
        )


def neighbour(radius, pitch, count):
    """Distance of neighbours among `count` helices of a pitch [m] on one radius, and its derivatives by radius and pitch."""
    spacing = 2 * math.pi / count

    def squared(turn):
        # from the place at the angle 0 to the one at spacing + turn
        return 2 * radius**2 * (1 - math.cos(spacing + turn)) + (pitch * turn / (2 * math.pi)) ** 2

    turn = minimize_scalar(squared, bounds=(-spacing, 0.5), method="bounded", options={"xatol": 1e-12}).x
    distance = math.sqrt(squared(turn))
    by_radius = 2 * radius * (1 - math.cos(spacing + turn)) / distance
    return distance, by_radius, pitch * (turn / (2 * math.pi)) ** 2 / distance


@dataclass(frozen=True)
class Bundle:
    """`count` wires without a core, laid without stress so that neighbours touch.

    pitch: lay length [m].
    """

    wire: Rod
    count: int
    pitch: float
    core = None

    @property
    def free(self):
        """A wire without stress."""
        a = self.wire.radius
        radius = brentq(lambda r: neighbour(r, self.pitch, self.count)[0] - 2 * a, 0.9 * a, 10 * a, xtol=1e-18)
        reference = math.hypot(2 * math.pi * radius / self.pitch, 1.0)
        return Helix(radius, 1 / reference, 2 * math.pi / self.pitch / reference)

    def state(self, strain, turn, approach: Callable):
        """State at an axial strain and a turn per length [rad/m]; line force of two neighbours per reference length.

        The energy is that of the wires and of what is between neighbours, a line of contact for each wire; its derivative by
        the radius is zero, those by height and turn are the loads.
        """
        free = self.free

        def neighbours(radius):
            helix = Helix(radius, (1 + strain) * free.height, free.turn + turn * free.height)
            return helix, *neighbour(radius, 2 * math.pi * helix.height / helix.turn, self.count)

        def excess(radius):
            helix, distance, by_radius, _ = neighbours(radius)
            line = loads(self.wire, helix, free).line_force / by_radius
            return distance + (approach(line) if line > 0 else 0.0) - 2 * self.wire.radius

        radius = brentq(excess, 0.9 * free.radius, 1.1 * free.radius, xtol=1e-18, rtol=1e-15)
        helix, _, by_radius, by_pitch = neighbours(radius)
        wire = loads(self.wire, helix, free)
        line = wire.line_force / by_radius
        by_height = by_pitch * 2 * math.pi / helix.turn
        by_turn = -by_height * helix.height / helix.turn
        force, moment = wire.force - line * by_height, wire.moment - line * by_turn
        return State(helix, line, self.count * force, self.count * moment)
