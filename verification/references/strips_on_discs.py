"""A conducting disc of a unit thickness with several arcs of its rim as electrodes.

From arc to opposite arc: tan(theta/2) maps the rim on the border of a half-plane, where the electrodes are |x| < t and
|x| > 1/t, t = tan(beta/2) with the half angle beta of the arcs. A half-plane has rho K'(k)/(2 K(k)) between them, k = t^2
(F. Bowman, Introduction to Elliptic Functions (1953), chapter 5).

From n even arcs to the mean of the disc, where the current is taken off evenly: their capacity is sin(n beta/2)^(1/n) (T.
Ransford, Potential Theory in the Complex Plane (1995), table 5.1), and the mean of the disc is 1/8 below that of a point
in its middle, in units of rho times the current over pi.
"""

import math

from scipy.special import ellipk, ellipkm1


def from_arc_to_arc(resistivity, half_angle):
    """Resistance between two opposite arcs times the thickness [ohm m]."""
    k = math.tan(half_angle / 2) ** 2
    return resistivity * ellipkm1(k**2) / (2 * ellipk(k**2))


def from_each_of(n, resistivity, half_angle):
    """Voltage from each of n even arcs to the mean of the disc, over the current of each, times the thickness [ohm m]."""
    return n * resistivity / math.pi * (-math.log(math.sin(n * half_angle / 2)) / n + 1 / 8)
