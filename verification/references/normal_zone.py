"""Velocity with which a normal zone travels along a superconducting wire, from the equation of a front of fixed shape.

Source: W. H. Whetstone, C. E. Roos, J. Appl. Phys. 36 (1965) 783-791 (without cooling); W. H. Cherry, J. I. Gittleman,
Solid-State Electron. 1 (1960) 287-305 (with cooling); M. N. Wilson, Superconducting Magnets (1983), chapter 9. In the frame
of the front, with the heat capacity C, the conductivity k, the heat Q(T) of the current and the cooling H per volume,

   (k T')' + v C T' + Q(T) - H (T - T0) = 0 .

Where Q jumps from 0 to q at one temperature, the exponentials on either side meet with one slope, which gives v in closed
form. For any other Q the flux P = -k T' over T, dP/dT = v C - k (Q - H (T - T0))/P, is integrated from the cold and from
the hot end to a temperature in between, where they must be equal.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


@dataclass(frozen=True)
class Wire:
    """A wire and the heat of its current, per volume."""

    #: Of the wire far ahead, and that above which all current is in the metal [K]
    cold: float
    normal: float
    #: Heat of the current as a function of the temperature, and that in the normal state [W/m^3]
    heat: Callable[[float], float]
    full: float
    #: k [W/(m K)] and C [J/(m^3 K)] over the temperature
    conductivity: Callable[[float], float]
    capacity: Callable[[float], float]
    #: H [W/(m^3 K)]
    cooling: float = 0.0


def velocity_of_step(rise, full, conductivity, capacity, cooling=0.0):
    """v of a heat that sets in at a rise of the temperature: negative where the zone recovers [m/s]."""
    y = rise * cooling / full
    return np.sqrt(full * conductivity / rise) / capacity * (1 - 2 * y) / np.sqrt(1 - y)


def velocity(wire, bracket):
    """v of any heat, a root within a bracket [m/s]."""
    return brentq(lambda v: _ahead(wire, v) - _behind(wire, v), *bracket, xtol=1e-12, rtol=1e-10)


def _ahead(wire, v):
    """P where all is normal, from the cold end."""
    k, slope = wire.conductivity(wire.cold), v * wire.capacity(wire.cold)
    decay = (slope + np.sqrt(slope**2 + 4 * wire.cooling * k)) / 2
    first = 1e-6 * (wire.normal - wire.cold)
    return _flux(wire, v, wire.cold + first, decay * first, wire.normal)


def _behind(wire, v):
    """P where all is normal, from the hot end: a balance of heat with a film, otherwise an even rise far behind."""
    if not wire.cooling:
        far = wire.cold + 20 * (wire.normal - wire.cold)
        return _flux(wire, v, far, wire.full * wire.conductivity(far) / (v * wire.capacity(far)), wire.normal)
    hot = wire.cold + wire.full / wire.cooling
    k, slope = wire.conductivity(hot), v * wire.capacity(hot)
    decay = (np.sqrt(slope**2 + 4 * wire.cooling * k) - slope) / 2
    last = 1e-6 * (hot - wire.normal)
    return _flux(wire, v, hot - last, decay * last, wire.normal)


def _flux(wire, v, begin, flux, end):
    """P at another temperature [W/m^2]."""

    def slope(t, p):
        source = wire.heat(t) - wire.cooling * (t - wire.cold)
        return [v * wire.capacity(t) - wire.conductivity(t) * source / p[0]]

    return solve_ivp(slope, (begin, end), [flux], method="Radau", rtol=1e-9, atol=1e-9 * flux).y[0, -1]
