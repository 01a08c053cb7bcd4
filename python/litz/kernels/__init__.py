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
)
from litz.kernels.search import contact_search

__all__ = [
    "Beam",
    "BeamStrains",
    "Conductor",
    "beam_b31",
    "beam_b31_strains",
    "beam_b33",
    "beam_b33_strains",
    "conductor",
    "contact_search",
]
