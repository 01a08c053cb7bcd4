"""What describes two wires: properties and places, checked for a kernel."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import checks

Numbers = float | ArrayLike


def geometry(x: ArrayLike, t: ArrayLike, length: ArrayLike) -> tuple[NDArray[np.float64], ...]:
    """Positions and tangents as columns, and lengths, after checking them."""
    positions = checks.array("x", x, (4, 3))
    tangents = checks.unit_vectors("t", t, (4, 3))
    return positions.T, tangents.T, checks.positive_pair("length", checks.array("length", length, (2,)))


def properties(
    radius: Numbers, young: Numbers, poisson: Numbers, resistivity: Numbers
) -> tuple[NDArray[np.float64], ...]:
    """Pairs of properties, after checking them."""
    nu = checks.pair("poisson", poisson)
    if not ((nu > -1) & (nu < 0.5)).all():
        bad = nu[(nu <= -1) | (nu >= 0.5)][0]
        raise ValueError(f"poisson must be between -1 and 0.5, both excluded, but holds {bad:g}")
    return (
        checks.positive_pair("radius", radius),
        checks.positive_pair("young", young),
        nu,
        checks.positive_pair("resistivity", resistivity),
    )
