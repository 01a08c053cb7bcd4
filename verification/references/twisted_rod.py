"""A straight rod under an axial torque, hinged at both ends, that a small force in its middle bends: closed form.

With the deflection u = v + i w and the torque M about an axis that is fixed in space, E I u'' - i M u' = q, where q is the
bending moment of the supported beam, -P/2 times the distance from the nearer end. u = 0 at both ends. The deflection
grows without bound at Greenhill's torque 2 pi E I/L. Source: A. G. Greenhill, Proc. Inst. Mech. Eng. 34 (1883) 182-225.
"""

import numpy as np


def deflection(torque):
    """Deflection of the middle, v + i w, by a unit force along y; E I = L = 1."""
    k = 1j * torque
    slope = 1 / (2 * k)
    half, whole = np.exp(k / 2), np.exp(k)
    # u' = c1 exp(k x) + slope (x + 1/k) before the middle, c2 exp(k x) + slope (1 - x - 1/k) beyond it:
    # u' is the same on both sides of the middle; both parts of u end at the same deflection
    continuous = [half, -half]
    closed = [(half - 1) / k, (whole - half) / k]
    right = [-2 * slope / k, -slope / 4]
    before, _ = np.linalg.solve([continuous, closed], right)
    return before * (half - 1) / k + slope * (1 / 8 + 1 / (2 * k))
