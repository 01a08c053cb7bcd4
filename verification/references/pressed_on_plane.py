"""Beams on rigid planes and in bores: point forces where the theory of thin beams has no pressure.

A beam with the stress-free curvature K touches a plane with the middle of its convex side. Two forces F at the distance l from
the middle flatten it over a length 2 c: there the moment is B K everywhere, the shear force is 0, and no pressure is needed. At
the ends of the flat part the shear force jumps to F: the plane takes a point force F. The moment goes on without
a jump, F (l - c) = B K, so that

    c = l - B K/F     for F > B K/l, below which the beam touches in one point.

The same from equilibrium alone: where the middle is flat the moment there is B K, so that the forces of the plane on one
half have the moment F l - B K about it and their centre at the distance c, however stiff the contact is.

A straight beam of length 2 l with hinged ends in a bore with the clearance e buckles under P > P_E = pi^2 B/(4 l^2), and leans
on the bore in its middle with a force Q. From B w'' + P w = Q x/2 of one half, w(0) = 0, w(l) = e, w'(l) = 0, with k^2 = P/B,

    Q = 2 P e/(l - tan(k l)/k)     up to 4 P_E.

A ring of radius R is shortened by two opposite forces F by F R^3/B (pi/4 - 2/pi).

A round wire between two planes that approach each other by 2 d from touch is pressed by f per length on either side, with the
law of a long contact, d = 2 f/(pi E*) (ln(2 r/b) - 1/(8 (1 - nu))), b^2 = 4 f r/(pi E*), E* = E/(1 - nu^2).

Source: S. Timoshenko, Strength of Materials I and II (beams, thin rings); S. Timoshenko, J. M. Gere, Theory of Elastic
Stability (1961), chapter 2 (bent columns); K. L. Johnson, Contact Mechanics (1985), sections 4.2 and 5.6 (width of the strip, and
why the approach of a line contact depends on the section), docs/theory.md sections 10 and 12 (its constant).
"""

import math

from scipy.optimize import brentq


def flat_half(force, half_length, bending, curvature):
    """Distance of the point force from the middle of a curved beam that is pressed onto a plane [m]; 0: one point."""
    return max(0.0, half_length - bending * curvature / force)


def force_in_bore(load, half_length, bending, clearance):
    """Force on the wall of a bore in the middle of a hinged beam [N]."""
    critical = math.pi**2 * bending / (4 * half_length**2)
    if not critical < load < 4 * critical:
        raise ValueError(
            f"the beam touches in one point between {critical:g} and {4 * critical:g} N, not at {load:g} N"
        )
    k = math.sqrt(load / bending)
    return 2 * load * clearance / (half_length - math.tan(k * half_length) / k)


def ring_stiffness(radius, bending):
    """Force over shortening of a thin ring between two plates [N/m]."""
    return bending / radius**3 / (math.pi / 4 - 2 / math.pi)


def line_force(approach, radius, young, poisson):
    """Force per length of a wire on a rigid plane [N/m]."""
    modulus = young / (1 - poisson**2)

    def misses(force):
        width = math.sqrt(4 * force * radius / (math.pi * modulus))
        section = math.log(2 * radius / width) - 1 / (8 * (1 - poisson))
        return 2 * force / (math.pi * modulus) * section - approach

    return brentq(misses, 1e-12 * modulus * approach, modulus * approach, xtol=1e-300, rtol=1e-14)
