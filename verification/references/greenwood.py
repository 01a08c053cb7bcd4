"""Resistance of several circular spots between two conductors.

Source: J. A. Greenwood, Br. J. Appl. Phys. 17 (1966) 1621-1632: the potential of spot i on one side is rho (I_i/(4
a_i) + sum of I_j/(2 pi s_ij) over the others); spots far apart act on each other like points.
"""

import numpy as np


def one_side(places, radii, currents, rho):
    """Potentials of the spots of one half-space against infinity, for currents that enter through them."""
    places = np.atleast_2d(np.asarray(places, dtype=float))
    distance = np.linalg.norm(places[:, None] - places[None, :], axis=2)
    influence = np.divide(1, 2 * np.pi * distance, out=np.zeros_like(distance), where=distance > 0)
    return rho * (influence + np.diag(1 / (4 * np.asarray(radii, dtype=float)))) @ np.asarray(currents, dtype=float)


def together(places, radii, rho):
    """Resistance between two half-spaces that touch in all spots."""
    unit = np.eye(len(radii))
    influence = np.array([one_side(places, radii, current, rho) for current in unit])
    return 2 / np.linalg.solve(influence, np.ones(len(radii))).sum()
