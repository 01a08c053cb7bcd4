"""Wires as chains of elements, and their smooth axes."""

from .chains import BEYOND, Wire, ends_of_images, find_wires, numbered_wires, without_images
from .curves import WireArcs, arc_lengths, element_curves, end_tangents, hermite, hermite_slope, rotate, wire_arcs

__all__ = [
    "BEYOND",
    "Wire",
    "WireArcs",
    "arc_lengths",
    "element_curves",
    "end_tangents",
    "ends_of_images",
    "find_wires",
    "hermite",
    "hermite_slope",
    "numbered_wires",
    "rotate",
    "wire_arcs",
    "without_images",
]
