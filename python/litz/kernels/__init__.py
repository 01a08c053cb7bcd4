"""The kernels of litz: plain arrays in, residual and tangent out."""

from litz.kernels.beams import (
    Beam,
    BeamStrains,
    Conductor,
    beam_b31,
    beam_b31_strains,
    beam_b33,
    beam_b33_strains,
    conductor,
    potential_rise,
)
from litz.kernels.contact import (
    ClosestPoints,
    ContactCoupling,
    ContactEM,
    ContactSpot,
    closest_points,
    contact_coupling,
    contact_em,
    contact_spot,
)
from litz.kernels.search import contact_search

__all__ = [
    "Beam",
    "BeamStrains",
    "ClosestPoints",
    "Conductor",
    "ContactCoupling",
    "ContactEM",
    "ContactSpot",
    "beam_b31",
    "beam_b31_strains",
    "beam_b33",
    "beam_b33_strains",
    "closest_points",
    "conductor",
    "contact_coupling",
    "contact_em",
    "contact_search",
    "contact_spot",
    "potential_rise",
]
