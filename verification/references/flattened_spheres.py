"""Published fits to finite-element solutions of a sphere of metal that yields, pressed on a rigid plane and let go.

Sources: L. Kogut, I. Etsion, J. Appl. Mech. 69 (2002) 657-662 (force and area for 1 to 110 times the overlap at the onset
of yielding); R. L. Jackson, I. Green, J. Tribol. 127 (2005) 343-354 (force and area at any overlap, with a hardness that
falls as the spot widens); I. Etsion, Y. Kligerman, Y. Kadin, Int. J. Solids Struct. 42 (2005) 3716-3729 (what remains of
the overlap). Overlaps, forces and areas are over those at the onset. Two equal cylinders at right angles are, as
paraboloids are, a sphere of their radius on a plane.
"""

import numpy as np


def onset_pressure(poisson):
    """Largest pressure at the onset over the yield stress, after Jackson and Green."""
    return 1.295 * np.exp(0.736 * poisson)


def kogut_etsion(overlap):
    """Force and area."""
    overlap = np.asarray(overlap, dtype=float)
    force = np.where(overlap <= 6, 1.03 * overlap**1.425, 1.40 * overlap**1.263)
    area = np.where(overlap <= 6, 0.93 * overlap**1.136, 0.94 * overlap**1.146)
    return force, area


def jackson_green(overlap, strain, poisson):
    """Force and area; `strain` is the yield stress over E*."""
    overlap = np.asarray(overlap, dtype=float)
    onset = onset_pressure(poisson)
    exponent = 0.14 * np.exp(23 * strain)
    spread = np.where(overlap < 1.9, 1.0, (overlap / 1.9) ** exponent)
    area = overlap * spread
    radius_ratio = np.pi * onset * strain / 2 * np.sqrt(area)
    hardness = 2.84 * (1 - np.exp(-0.82 * radius_ratio**-0.7))
    plastic = 4 * hardness / onset * (1 - np.exp(-(overlap ** (5 / 9)) / 25)) * overlap
    force = np.exp(-(overlap ** (5 / 12)) / 4) * overlap**1.5 + plastic
    return np.where(overlap < 1.9, overlap**1.5, force), area


def remaining_overlap(overlap):
    """What remains of the largest overlap, over it, after Etsion, Kligerman and Kadin."""
    return (1 - overlap**-0.28) * (1 - overlap**-0.69)
