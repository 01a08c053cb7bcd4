"""Elastic contact of two crossed round wires and the constriction resistance of its spot, with 40 digits.

Sources: K. L. Johnson, Contact Mechanics (1985), section 4.2, equations 4.24 to 4.28 (H. Hertz 1882); R. Holm, Electric
Contacts, 4th ed. (1967), sections 3 and 4: resistance of an elliptic spot rho K(m)/(2 pi a) on each side.
"""

from typing import NamedTuple

import mpmath as mp

DIGITS = 40


class Spot(NamedTuple):
    """Contact spot: half axes a >= b, approach of the axes, peak pressure, dF/d(approach), resistance."""

    semi_major: float
    semi_minor: float
    approach: float
    peak_pressure: float
    stiffness: float
    resistance: float


def effective_modulus(young, poisson):
    """E* with 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, for pairs of properties."""
    return 1 / sum((1 - mp.mpf(nu) ** 2) / mp.mpf(e) for e, nu in zip(young, poisson, strict=True))


def axis_ratio(curvature_ratio):
    """b/a from B/A = ((a/b)^2 E(m) - K(m))/(K(m) - E(m)) with m = 1 - (b/a)^2, by bisection in log(b/a)."""
    with mp.workdps(DIGITS):
        target = mp.mpf(curvature_ratio)
        if target < 1 + mp.mpf(10) ** -17:
            return mp.mpf(1)

        def excess(log_ratio):
            ratio = mp.exp(log_ratio)
            m = 1 - ratio**2
            k, e = mp.ellipk(m), mp.ellipe(m)
            return (e / ratio**2 - k) / (k - e) - target

        low, high = mp.mpf(-20), mp.mpf("-1e-18")
        while high - low > mp.mpf(10) ** -22:
            middle = (low + high) / 2
            low, high = (middle, high) if excess(middle) > 0 else (low, middle)
        return mp.exp((low + high) / 2)


def crossed_wires(force, angle, *, radius, modulus, resistivity):
    """The spot of two wires that cross at `angle` [rad] under `force`.

    `radius` and `resistivity` are pairs, `modulus` is E*.
    """
    with mp.workdps(DIGITS):
        r1, r2 = (mp.mpf(r) for r in radius)
        total = (1 / r1 + 1 / r2) / 2
        difference = mp.sqrt(1 / r1**2 + 1 / r2**2 + 2 * mp.cos(2 * mp.mpf(angle)) / (r1 * r2)) / 2
        return _spot(force, total, difference, modulus, resistivity)


def bent_wires(force, angle, *, radius, curvature, modulus, resistivity):
    """The spot of two tori whose axes are bent away from each other with the curvatures of a pair [1/m].

    At the contact a torus has the principal curvatures 1/r and c = k/(1 + k r): their sum, and their difference as a
    vector at twice the angle.
    """
    with mp.workdps(DIGITS):
        across = [1 / mp.mpf(r) for r in radius]
        along = [mp.mpf(k) / (1 + mp.mpf(k) * mp.mpf(r)) for k, r in zip(curvature, radius, strict=True)]
        total = (sum(across) + sum(along)) / 2
        d1, d2 = (a - c for a, c in zip(across, along, strict=True))
        difference = mp.sqrt(d1**2 + d2**2 + 2 * d1 * d2 * mp.cos(2 * mp.mpf(angle))) / 2
        return _spot(force, total, difference, modulus, resistivity)


def end_on_wire(force, *, radius, modulus, resistivity):
    """The spot of a hemisphere, the end of the first wire, on the side of the second wire under `force`."""
    with mp.workdps(DIGITS):
        r1, r2 = (mp.mpf(r) for r in radius)
        return _spot(force, (2 / r1 + 1 / r2) / 2, 1 / r2 / 2, modulus, resistivity)


def end_on_end(force, *, radius, modulus, resistivity):
    """The spot of two hemispheres, the ends of both wires, under `force`."""
    with mp.workdps(DIGITS):
        return _spot(force, sum(1 / mp.mpf(r) for r in radius), mp.mpf(0), modulus, resistivity)


def _spot(force, total, difference, modulus, resistivity):
    """By the sum A + B and the difference B - A of the principal curvatures."""
    with mp.workdps(DIGITS):
        force, modulus = mp.mpf(force), mp.mpf(modulus)
        ratio = axis_ratio((total + difference) / (total - difference))
        m = 1 - ratio**2
        k, e = mp.ellipk(m), mp.ellipe(m)
        a = mp.cbrt(3 * force * e / (2 * mp.pi * ratio**2 * total * modulus))
        approach = 3 * force * k / (2 * mp.pi * a * modulus)
        rho1, rho2 = (mp.mpf(rho) for rho in resistivity)
        values = (
            a,
            ratio * a,
            approach,
            3 * force / (2 * mp.pi * ratio * a**2),
            3 * force / (2 * approach),
            (rho1 + rho2) * k / (2 * mp.pi * a),
        )
        return Spot(*map(float, values))


def force_of_approach(approach, angle, *, radius, modulus):
    """Force that brings the axes together by `approach`: F is proportional to approach^(3/2)."""
    unit = crossed_wires(1, angle, radius=radius, modulus=modulus, resistivity=(1, 1)).approach
    return float((mp.mpf(approach) / unit) ** mp.mpf("1.5"))


def shape_factor(axes_ratio):
    """Resistance of an elliptic spot over that of a circle of the same area, for a/b >= 1."""
    with mp.workdps(DIGITS):
        m = 1 - 1 / mp.mpf(axes_ratio) ** 2
        return float(2 / mp.pi * mp.ellipk(m) / mp.sqrt(axes_ratio))
