"""Exact solutions to compare litz with. They do not use the kernels of litz; SI units throughout.

Contact of two round wires   `hertz_contact`, `hertz_force`, `paper_contact`
Wires that press each other  `beam_compliance`, `crossed_beams`, `wire_grid`
Current                      `crossed_wires_network`, `grid_network`
Large bending                `cantilever_elastica`, `roll_up`
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

# ---- Elliptic integrals ----------------------------------------------------------------------------------------------


def complete_elliptic(m: float) -> tuple[float, float, float]:
    """K(m), E(m) and (K(m) - E(m))/m with the parameter m = k^2, 0 <= m < 1.

    Source: arithmetic-geometric mean, Abramowitz and Stegun 17.6; c_(n+1) = c_n^2/(4 a_(n+1)) keeps all digits at m -> 0.
    """
    a, b, c_squared = 1.0, math.sqrt(1.0 - m), 1.0
    # total: the sum of 2^(n-1) c_n^2 / m, whose first term is 1/2
    total, weight = 0.5, 0.5
    for _ in range(12):
        a_next = 0.5 * (a + b)
        b = math.sqrt(a * b)
        c_squared = m * c_squared**2 / (4.0 * a_next) ** 2
        a = a_next
        weight *= 2.0
        total += weight * c_squared
    k = math.pi / (2.0 * a)
    return k, k * (1.0 - m * total), k * total


def incomplete_elliptic(phi: float, m: float) -> tuple[float, float]:
    """F(phi|m) and E(phi|m) for 0 <= phi <= pi/2.

    Source: Carlson's forms, NIST Digital Library of Mathematical Functions 19.25.5 and 19.25.9.
    """
    s, c = math.sin(phi), math.cos(phi)
    q = 1.0 - m * s * s
    f = s * _carlson_rf(c * c, q, 1.0)
    return f, f - m * s**3 / 3.0 * _carlson_rd(c * c, q, 1.0)


def _carlson_rf(x: float, y: float, z: float) -> float:
    # Source: B. C. Carlson, Numerical Algorithms 10 (1995) 13-26, algorithm 1
    while True:
        lam = math.sqrt(x * y) + math.sqrt(y * z) + math.sqrt(z * x)
        x, y, z = (x + lam) / 4.0, (y + lam) / 4.0, (z + lam) / 4.0
        mean = (x + y + z) / 3.0
        if max(abs(x - mean), abs(y - mean), abs(z - mean)) < 1e-4 * mean:
            break
    u, v = 1.0 - x / mean, 1.0 - y / mean
    w = -u - v
    e2, e3 = u * v - w * w, u * v * w
    return (1.0 - e2 / 10.0 + e3 / 14.0 + e2**2 / 24.0 - 3.0 * e2 * e3 / 44.0) / math.sqrt(mean)


def _carlson_rd(x: float, y: float, z: float) -> float:
    # Source: as above, algorithm 4
    total, power = 0.0, 1.0
    while True:
        lam = math.sqrt(x * y) + math.sqrt(y * z) + math.sqrt(z * x)
        total += power / (math.sqrt(z) * (z + lam))
        power /= 4.0
        x, y, z = (x + lam) / 4.0, (y + lam) / 4.0, (z + lam) / 4.0
        mean = (x + y + 3.0 * z) / 5.0
        if max(abs(x - mean), abs(y - mean), abs(z - mean)) < 1e-4 * mean:
            break
    u, v = 1.0 - x / mean, 1.0 - y / mean
    w = -(u + v) / 3.0
    e2, e3 = u * v - 6.0 * w * w, (3.0 * u * v - 8.0 * w * w) * w
    e4, e5 = 3.0 * (u * v - w * w) * w * w, u * v * w**3
    series = 1 - 3 * e2 / 14 + e3 / 6 + 9 * e2**2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52 + 3 * e5 / 26
    return 3.0 * total + power * series / mean**1.5


# ---- The contact spot ------------------------------------------------------------------------------------------------


class Spot(NamedTuple):
    """Contact of two wires under a force."""

    #: Larger half axis of the ellipse [m]
    semi_major: float
    #: Smaller half axis [m]
    semi_minor: float
    #: By how much the two wires approach each other [m]
    approach: float
    #: Pressure at the middle of the spot [Pa]
    peak_pressure: float
    #: Constriction resistance [ohm]
    resistance: float
    #: Derivative of the force by the approach [N/m]
    stiffness: float


def _pair(value: ArrayLike) -> tuple[float, float]:
    first, second = np.broadcast_to(value, 2)
    return float(first), float(second)


def reduced_modulus(young: ArrayLike, poisson: ArrayLike) -> float:
    """E* with 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2."""
    (e1, e2), (nu1, nu2) = _pair(young), _pair(poisson)
    return 1.0 / ((1.0 - nu1**2) / e1 + (1.0 - nu2**2) / e2)


def hertz_contact(
    force: float,
    *,
    radius: ArrayLike,
    young: ArrayLike,
    poisson: ArrayLike,
    resistivity: ArrayLike,
    angle: float = math.pi / 2,
    curvature: ArrayLike = 0.0,
) -> Spot:
    """Elastic contact of two round wires whose axes cross at `angle`; every property is a number or a pair.

    `curvature` [1/m] is that of the axes where they cross, positive as wires bend away from each other: along itself the
    surface of such a wire has the curvature k/(1 + k r).

    Sources: Hertz 1882 in the notation of K. L. Johnson, Contact Mechanics, section 4.2; resistance of an elliptic spot
    after R. Holm, Electric Contacts: R_c = (rho1 + rho2) K(m)/(2 pi a).
    """
    r1, r2 = _pair(radius)
    rho1, rho2 = _pair(resistivity)
    e_star = reduced_modulus(young, poisson)

    along1, along2 = (k / (1.0 + k * r) for k, r in zip(_pair(curvature), (r1, r2), strict=True))
    more1, more2 = 1.0 / r1 - along1, 1.0 / r2 - along2

    curvature_sum = (1.0 / r1 + 1.0 / r2 + along1 + along2) / 2.0
    curvature_difference = math.sqrt(more1**2 + more2**2 + 2.0 * math.cos(2.0 * angle) * more1 * more2) / 2.0
    b_curvature = (curvature_sum + curvature_difference) / 2.0
    # A B = (A + B)^2/4 - (A - B)^2/4, without loss of digits at small angles
    product = (1.0 / r1 + 1.0 / r2) * (along1 + along2) + math.sin(angle) ** 2 * more1 * more2
    a_curvature = product / (4.0 * b_curvature)

    ratio = _axis_ratio(b_curvature / a_curvature)
    k, e, _ = complete_elliptic(1.0 - ratio**2)
    a = (3.0 * force * e / (2.0 * math.pi * ratio**2 * curvature_sum * e_star)) ** (1.0 / 3.0)
    b = ratio * a
    approach = 3.0 * force * k / (2.0 * math.pi * a * e_star)
    return Spot(
        semi_major=a,
        semi_minor=b,
        approach=approach,
        peak_pressure=3.0 * force / (2.0 * math.pi * a * b),
        resistance=(rho1 + rho2) * k / (2.0 * math.pi * a),
        stiffness=1.5 * force / approach,
    )


def _axis_ratio(curvature_ratio: float) -> float:
    """b/a of the contact ellipse from B/A = ((a/b)^2 E - K)/(K - E), by bisection."""

    def excess(ratio: float) -> float:
        m = 1.0 - ratio**2
        k, _, d = complete_elliptic(m)
        # E - (1 - m) K = m (K - D) with D = (K - E)/m
        return (k - d) / (ratio**2 * d) - curvature_ratio

    return _bisect(excess, 1e-8, 1.0) if curvature_ratio > 1.0 + 1e-14 else 1.0


def _bisect(function: Callable[[float], float], low: float, high: float) -> float:
    """The zero of a monotone function whose signs at both ends differ, to the last digit."""
    sign = math.copysign(1.0, function(low))
    for _ in range(200):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        if sign * function(middle) > 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def hertz_force(approach: float, **wires: Any) -> float:
    """Force that brings two wires together by `approach`: F is proportional to approach^(3/2)."""
    return (approach / hertz_contact(1.0, **wires).approach) ** 1.5


def paper_contact(
    force: float, *, radius: ArrayLike, young: ArrayLike, poisson: ArrayLike, resistivity: ArrayLike
) -> tuple[float, float]:
    """Radius and resistance of the circular spot of Boso, Litewka, Schrefler and Wriggers, LAW=PAPER.

    Its mean radius r1 r2/(r1 + r2) is that of two spheres.
    """
    (r1, r2), (rho1, rho2) = _pair(radius), _pair(resistivity)
    a = (3.0 * force * r1 * r2 / (r1 + r2) / (4.0 * reduced_modulus(young, poisson))) ** (1.0 / 3.0)
    return a, (rho1 + rho2) / (4.0 * a)


# ---- Wires that press each other -------------------------------------------------------------------------------------


class Wire(NamedTuple):
    """A straight round wire of one material."""

    #: Radius [m]
    radius: float
    #: Length [m]
    length: float
    #: Young's modulus [Pa]
    young: float
    #: Poisson's ratio [-]
    poisson: float
    #: Resistivity [ohm m]
    resistivity: float

    @property
    def area(self) -> float:
        """Cross-section area [m^2]."""
        return math.pi * self.radius**2

    @property
    def bending_stiffness(self) -> float:
        """E I [N m^2]."""
        return self.young * math.pi * self.radius**4 / 4.0

    def resistance(self, fraction: float = 1.0) -> float:
        """Resistance of a fraction of the wire [ohm]."""
        return self.resistivity * fraction * self.length / self.area


def beam_compliance(
    bending_stiffness: float, length: float, support: str, position: float = 0.5, at: float | None = None
) -> float:
    """Deflection at `at` by a unit force at `position` (fractions of the length), Euler-Bernoulli, small displacements.

    `support`: "clamped" or "supported" (both ends), "cantilever" (clamped at 0). Source: Roark's Formulas for Stress and
    Strain, table of shear, moment, slope and deflection of straight beams under a concentrated load.
    """
    a, x = position, position if at is None else at
    if x > a:
        # Maxwell's reciprocity
        a, x = x, a
    b = 1.0 - a
    if support == "clamped":
        deflection = b**2 * x**2 * (3.0 * a - (3.0 * a + b) * x) / 6.0
    elif support == "supported":
        deflection = b * x * (1.0 - b**2 - x**2) / 6.0
    elif support == "cantilever":
        deflection = x**2 * (3.0 * a - x) / 6.0
    else:
        raise ValueError(f"support {support!r} is not known; it is clamped, supported or cantilever")
    return deflection * length**3 / bending_stiffness


def beam_curvature(bending_stiffness: float, length: float, support: str, position: float = 0.5) -> float:
    """Curvature by a unit force where it acts [1/(N m)]: the moment there over the bending stiffness.

    Arguments and source as of `beam_compliance`.
    """
    a, b = position, 1.0 - position
    moments = {"clamped": 2.0 * a**2 * b**2, "supported": a * b, "cantilever": 0.0}
    if support not in moments:
        raise ValueError(f"support {support!r} is not known; it is clamped, supported or cantilever")
    return moments[support] * length / bending_stiffness


def crossed_beams(
    approach: float,
    compliances: Sequence[float],
    *,
    penalty: float | None = None,
    curvatures: Sequence[float] = (0.0, 0.0),
    **wires: Any,
) -> float:
    """Force between two beams whose supports are moved together by `approach` beyond first touch.

    `approach = F (c1 + c2) + delta(F)`, where delta is F/penalty, or Hertz's approach when the properties of the wires
    are given (as for `hertz_contact`). `curvatures` are those by a unit force (`beam_curvature`), with which the beams
    bend about each other.
    """
    compliance = sum(compliances)
    if penalty is not None:
        return approach / (compliance + 1.0 / penalty)

    def overlap(force: float) -> float:
        unit = hertz_contact(1.0, curvature=[-force * k for k in curvatures], **wires)
        return unit.approach * force ** (2.0 / 3.0)

    return _bisect(lambda f: f * compliance + overlap(f) - approach, 0.0, approach / compliance)


def wire_grid(
    approach: float, positions: Sequence[float], wire: Wire, *, support: str = "clamped", angle: float = math.pi / 2
) -> NDArray[np.float64]:
    """Forces (n, n) at the crossings of n lower and n upper equal wires whose supports are moved together by `approach`.

    `positions`: fractions of the length where the wires cross. Lower wire i and upper wire j touch at (i, j). Each crossing
    has approach = deflection of both wires + overlap, and the force stiffness * overlap^(3/2) of Hertz where they overlap;
    Newton's method in the overlaps, negative ones are gaps.
    """
    n = len(positions)
    flexibility = np.array(
        [[beam_compliance(wire.bending_stiffness, wire.length, support, a, x) for a in positions] for x in positions]
    )
    # forces of one lower wire act on it at the positions of the upper ones, and the other way round
    compliance = np.kron(np.eye(n), flexibility) + np.kron(flexibility, np.eye(n))
    stiffness = hertz_force(
        1.0,
        radius=wire.radius,
        young=wire.young,
        poisson=wire.poisson,
        resistivity=wire.resistivity,
        angle=angle,
    )
    overlap = np.full(n * n, approach)
    for _ in range(200):
        closed = np.maximum(overlap, 0.0)
        residual = compliance @ (stiffness * closed**1.5) + overlap - approach
        tangent = compliance * (1.5 * stiffness * np.sqrt(closed)) + np.eye(n * n)
        change = -np.linalg.solve(tangent, residual)
        overlap += change
        if np.abs(change).max() < 1e-14 * approach:
            return (stiffness * np.maximum(overlap, 0.0) ** 1.5).reshape(n, n)
    raise ArithmeticError("the forces of the grid were not found in 200 iterations")


# ---- Current ---------------------------------------------------------------------------------------------------------


class Crossing(NamedTuple):
    """Potentials of two wires at their crossing, and the current from the first to the second."""

    #: Potentials of the first and the second wire there [V]
    potentials: tuple[float, float]
    #: Current from the first to the second wire [A]
    current: float
    #: Voltage across the contact [V]
    voltage: float


def crossed_wires_network(
    potentials: Sequence[Sequence[float | None]], arms: Sequence[Sequence[float]], contact_resistance: float
) -> Crossing:
    """Two conducting wires that cross.

    `potentials`: ((V1a, V1b), (V2a, V2b)) of the ends, None: insulated. `arms`: ((R1a, R1b), (R2a, R2b)), the resistances
    from the ends to the crossing. Source: Kirchhoff's laws at the crossing.
    """
    g = 1.0 / contact_resistance
    matrix = np.array([[g, -g], [-g, g]])
    right = np.zeros(2)
    for wire in range(2):
        for potential, arm in zip(potentials[wire], arms[wire], strict=True):
            if potential is not None:
                matrix[wire, wire] += 1.0 / arm
                right[wire] += potential / arm
    v = np.linalg.solve(matrix, right)
    return Crossing((float(v[0]), float(v[1])), float(g * (v[0] - v[1])), float(v[0] - v[1]))


def grid_network(
    voltage: float, positions: Sequence[float], wire: Wire, contact_resistance: NDArray[np.float64]
) -> float:
    """Total current through a grid of n lower and n upper wires; lower ends at 0 at `voltage`, upper ends at 0 at zero.

    The other ends are insulated. `contact_resistance` (n, n) as the forces of `wire_grid`. Source: Kirchhoff's laws.
    """
    n = len(positions)
    matrix, right = np.zeros((2 * n * n, 2 * n * n)), np.zeros(2 * n * n)
    lower = np.arange(n * n).reshape(n, n)
    upper = lower.T + n * n

    def connect(a: int, b: int, conductance: float) -> None:
        matrix[[a, b], [a, b]] += conductance
        matrix[[a, b], [b, a]] -= conductance

    for chain, potential in [(row, voltage) for row in lower] + [(row, 0.0) for row in upper]:
        electrode = 1.0 / wire.resistance(positions[0])
        matrix[chain[0], chain[0]] += electrode
        right[chain[0]] += electrode * potential
        for k in range(n - 1):
            connect(chain[k], chain[k + 1], 1.0 / wire.resistance(positions[k + 1] - positions[k]))
    for i in range(n):
        for j in range(n):
            connect(lower[i, j], upper[j, i], 1.0 / contact_resistance[i][j])
    v = np.linalg.solve(matrix, right)
    return float(sum((voltage - v[row[0]]) / wire.resistance(positions[0]) for row in lower))


# ---- Large bending ---------------------------------------------------------------------------------------------------


class Tip(NamedTuple):
    """Tip of a bent cantilever: deflection and shortening over length, angle [rad]."""

    #: Deflection over length [-]
    deflection: float
    #: By how much the tip comes nearer to the clamp, over length [-]
    shortening: float
    #: Angle of the tangent at the tip [rad]
    angle: float


def cantilever_elastica(load: float) -> Tip:
    """Inextensible cantilever under a transverse tip load of fixed direction, load = P L^2/(E I) > 0.

    Source: K(k) - F(phi, k) = sqrt(load), sin(phi) = 1/(k sqrt(2)); Bisshopp and Drucker, Quart. Appl. Math. 3 (1945)
    272-275.
    """

    def amplitude(m: float) -> float:
        return math.asin(min(1.0, 1.0 / math.sqrt(2.0 * m)))

    def excess(m: float) -> float:
        return complete_elliptic(m)[0] - incomplete_elliptic(amplitude(m), m)[0] - math.sqrt(load)

    m = _bisect(excess, 0.5, 1.0 - 1e-15)
    phi = amplitude(m)
    sine = 2.0 * m - 1.0
    return Tip(
        deflection=1.0 - 2.0 / math.sqrt(load) * (complete_elliptic(m)[1] - incomplete_elliptic(phi, m)[1]),
        shortening=1.0 - math.sqrt(2.0 * sine / load),
        angle=math.asin(sine),
    )


def roll_up(angle: float) -> Tip:
    """Cantilever bent to a circular arc by an end moment M = angle E I/L: deflection, shortening over length, angle."""
    return Tip((1.0 - math.cos(angle)) / angle, 1.0 - math.sin(angle) / angle, angle)
