"""What describes two wires: properties and places, checked for a kernel."""

from __future__ import annotations

from numpy.typing import ArrayLike

from . import checks
from .batch import Batch, Floats

Numbers = float | ArrayLike


def take_geometry(of: Batch, x: ArrayLike, t: ArrayLike, length: ArrayLike) -> None:
    """Take positions, tangents and lengths of two elements, after checking them."""
    of.array("x", x, (4, 3))
    of.take("t", checks.unit_vectors("t", t, (4, 3)), 2)
    of.positive("length", length, (2,))


def take_properties(
    of: Batch, radius: Numbers, young: Numbers, poisson: Numbers, resistivity: Numbers | None = None
) -> Floats:
    """Take pairs of properties, after checking them; the radii are returned."""
    radii = of.positive_pair("radius", radius)
    of.positive_pair("young", young)
    nu = of.pair("poisson", poisson)
    checks.refuse(
        "poisson", nu, (nu <= -1) | (nu >= 0.5), 1, "must be between -1 and 0.5, both excluded, but holds {value:g}"
    )
    if resistivity is not None:
        of.positive_pair("resistivity", resistivity)
    return radii
