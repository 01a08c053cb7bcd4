"""Models of many wires, written as decks: mats, grids, fabrics, cables and films.

Every generator returns a `litz.Model`, to which steps are added (`Model.press`, `Model.step`) and which is written as a deck
(`Model.write`), the mesh in the text or, for large models, in an HDF5 file beside it.
"""

from ..model import COPPER, HERTZ_AND_HOLM, SILVER, STEEL, Interaction, Material, Model, straight
from .cables import cable, strand
from .fabrics import wire_grid, woven_fabric
from .fibre_mats import fibre_mat
from .films import nanowire_film
from .geometry import smallest_gap
from .jackets import compact
from .plates import press_plates
from .rutherford import rutherford
from .wraps import Wrap

__all__ = [
    "COPPER",
    "HERTZ_AND_HOLM",
    "SILVER",
    "STEEL",
    "Interaction",
    "Material",
    "Model",
    "Wrap",
    "cable",
    "compact",
    "fibre_mat",
    "nanowire_film",
    "press_plates",
    "rutherford",
    "smallest_gap",
    "straight",
    "strand",
    "wire_grid",
    "woven_fabric",
]
