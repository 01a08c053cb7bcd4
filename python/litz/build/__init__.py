"""Models of many wires, written as decks: mats, grids, fabrics, cables and films.

Every generator returns a `Model`, to which steps are added (`Model.press`, or a `Step`) and which is written as a deck
(`Model.write`), the mesh in the text or, for large models, in an HDF5 file beside it.
"""

from .cables import cable, strand
from .fabrics import wire_grid, woven_fabric
from .fibre_mats import fibre_mat
from .films import nanowire_film
from .geometry import smallest_gap, straight
from .model import (
    COPPER,
    SILVER,
    ContactPair,
    Interaction,
    Load,
    Material,
    Model,
    Prescribed,
    Step,
    Wire,
    WireGroup,
)

__all__ = [
    "COPPER",
    "SILVER",
    "ContactPair",
    "Interaction",
    "Load",
    "Material",
    "Model",
    "Prescribed",
    "Step",
    "Wire",
    "WireGroup",
    "cable",
    "fibre_mat",
    "nanowire_film",
    "smallest_gap",
    "straight",
    "strand",
    "wire_grid",
    "woven_fabric",
]
