"""Models of wires: nodes, wires, materials, contacts, supports and steps, written as a deck and run."""

from .curves import along_curve, along_polyline, along_spline, straight
from .interactions import HERTZ_AND_HOLM, ContactPair, Interaction
from .laws import (
    ClusterSpot,
    ConstantSpot,
    FilmSpot,
    Friction,
    GapConductance,
    Hertz,
    HertzSpot,
    Linear,
    NamedBehaviour,
    NamedSpot,
    PaperSpot,
    PlasticSpot,
    SharvinSpot,
    TableSpot,
)
from .loading import Amplitude, Load, Prescribed
from .materials import COPPER, SILVER, STEEL, Circular, General, Material, Superconductor
from .model import Model
from .steps import Step
from .surfaces import RigidSurface
from .wires import Nodes, Wire, WireGroup

__all__ = [
    "COPPER",
    "HERTZ_AND_HOLM",
    "SILVER",
    "STEEL",
    "Amplitude",
    "Circular",
    "ClusterSpot",
    "ConstantSpot",
    "ContactPair",
    "FilmSpot",
    "Friction",
    "GapConductance",
    "General",
    "Hertz",
    "HertzSpot",
    "Interaction",
    "Linear",
    "Load",
    "Material",
    "Model",
    "NamedBehaviour",
    "NamedSpot",
    "Nodes",
    "PaperSpot",
    "PlasticSpot",
    "Prescribed",
    "RigidSurface",
    "SharvinSpot",
    "Step",
    "Superconductor",
    "TableSpot",
    "Wire",
    "WireGroup",
    "along_curve",
    "along_polyline",
    "along_spline",
    "straight",
]
