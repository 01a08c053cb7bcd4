"""Straight wires that cross and press each other: small deflections of beams, closed forms and flexibilities.

Sources: W. C. Young, R. G. Budynas, Roark's Formulas for Stress and Strain, 7th ed., table 8.1 (a force on a cantilever,
on a supported beam, on a clamped beam); S. P. Timoshenko, Strength of Materials I, section 39, for the deflection by
shear.
"""

import numpy as np
from scipy.optimize import brentq

from verification.deck_text import Rigidity
from verification.references import rod


def deflection(support, length, at, load_at, *, ei, ga=np.inf):
    """Deflection at `at` by a unit force at `load_at`; "clamped", "supported" or "cantilever" (clamped at 0)."""
    x, a = min(at, load_at), max(at, load_at)
    if support == "supported":
        b = length - a
        return b * x * (length**2 - b**2 - x**2) / (6 * length * ei) + x * b / (length * ga)
    by_force = _cantilever(x, a, ei, ga)
    if support == "cantilever":
        return by_force
    if support != "clamped":
        raise ValueError(f"support {support!r}; allowed are clamped, supported, cantilever")
    # a cantilever whose end is brought back by a force and a moment
    end = np.array(
        [
            [length**3 / (3 * ei) + length / ga, length**2 / (2 * ei)],
            [length**2 / (2 * ei), length / ei],
        ]
    )

    def end_by_unit_force(s):
        return np.array([_cantilever(s, length, ei, ga), s**2 / (2 * ei)])

    return by_force - end_by_unit_force(x) @ np.linalg.solve(end, end_by_unit_force(a))


def _cantilever(x, a, ei, ga):
    return x**2 * (3 * a - x) / (6 * ei) + x / ga


def force(approach, compliance, contact):
    """Force of one crossing: approach = F compliance + contact(F), with the overlap `contact` that a force needs."""
    return brentq(lambda f: f * compliance + contact(f) - approach, 0.0, approach / compliance, xtol=1e-300, rtol=1e-14)


def force_of_large_deflection(approach, length, unit_approach, *, ei, ea):
    """Force of two equal wires that cross at their middles, clamped at ends that may slide, far bent.

    Half a wire has a point of inflection in its middle: each quarter is a cantilever, clamped at the support or at the
    crossing, under half of the force; references/rod.py. `unit_approach`: Hertz's approach of the axes under 1 N.
    """
    rigidity = Rigidity(ea=ea, ga=1e12 * ea, gj=ei, ei2=ei, ei3=ei)

    def excess(f):
        quarter = rod.tip([rod.Piece(length / 4)], rigidity, (0.0, 0.0, f / 2), steps=3)[2]
        return 4 * quarter + unit_approach * f ** (2 / 3) - approach

    stiffness = 192 * ei / length**3
    return brentq(excess, 0.1 * approach * stiffness / 2, 2 * approach * stiffness / 2, rtol=1e-11)


def grid_forces(clearance, flexibility, contact_force, contact_stiffness):
    """Forces of many crossings of linearly elastic wires.

    The overlap of crossing i is -clearance_i - (flexibility F)_i and F_i = contact_force(overlap_i), both positive or
    zero.
    Newton's method in the overlaps, with halved steps where it would not descend.
    """
    overlap = np.maximum(-np.asarray(clearance, dtype=float), 0.0)

    def residual(o):
        return o + clearance + flexibility @ contact_force(np.maximum(o, 0.0))

    r = residual(overlap)
    for _ in range(500):
        slope = np.where(overlap > 0, contact_stiffness(np.maximum(overlap, 0.0)), 0.0)
        step = -np.linalg.solve(np.eye(len(r)) + flexibility * slope, r)
        size = 1.0
        while size > 1e-6 and np.linalg.norm(residual(overlap + size * step)) > np.linalg.norm(r):
            size /= 2
        overlap = overlap + size * step
        r = residual(overlap)
        if np.abs(step).max() <= 1e-14 * np.abs(clearance).max():
            return contact_force(np.maximum(overlap, 0.0))
    raise ArithmeticError("the forces of the grid were not found in 500 iterations")
