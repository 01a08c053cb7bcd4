"""Wires as chains of elements, and their smooth axes."""

from .chains import Wire, find_wires, numbered_wires
from .curves import WireArcs, arc_lengths, element_curves, end_tangents, hermite, hermite_slope, rotate, wire_arcs

__all__ = [
    "Wire",
    "WireArcs",
    "arc_lengths",
    "element_curves",
    "end_tangents",
    "find_wires",
    "hermite",
    "hermite_slope",
    "numbered_wires",
    "rotate",
    "wire_arcs",
]
