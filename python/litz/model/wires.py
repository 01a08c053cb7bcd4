"""Wires, and the nodes by which they are held and loaded."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..wires.chains import find_wires
from .materials import Material, Section


class Points:
    """Positions of nodes, which are numbered from 1 in the order in which they are added."""

    def __init__(self) -> None:
        self._blocks: list[NDArray[np.float64]] = []
        self._n = 0

    def __len__(self) -> int:
        """Number of nodes."""
        return self._n

    def add(self, block: NDArray[np.float64]) -> None:
        """Add nodes at positions, (n, 3) [m]."""
        self._blocks.append(block)
        self._n += len(block)

    @property
    def positions(self) -> NDArray[np.float64]:
        """Positions of all nodes, (n, 3) [m]; node i is in row i - 1."""
        if len(self._blocks) > 1:
            self._blocks = [np.concatenate(self._blocks)]
        return self._blocks[0] if self._blocks else np.empty((0, 3))


class Nodes(tuple):
    """Numbers of nodes with a name: a node set, once something in the model refers to it.

    Attributes
    ----------
    name : str
        Name of the set in the deck.
    """

    name: str

    def __new__(cls, name: str, members: Iterable[int]) -> "Nodes":
        """Nodes of a name."""
        nodes = super().__new__(cls, (int(member) for member in members))
        nodes.name = name
        return nodes

    def __repr__(self) -> str:
        """Short description."""
        listed = ", ".join(map(str, self[:8])) + (", ..." if len(self) > 8 else "")
        return f"<Nodes {self.name}: {listed}>"


@dataclass(frozen=True)
class Wire:
    """A chain of elements.

    Attributes
    ----------
    nodes : sequence of int
        Numbers of its nodes from one end to the other; a closed wire ends with the node it begins with.
    elements : sequence of int
        Numbers of its elements in the same order.
    """

    nodes: Sequence[int]
    elements: Sequence[int]

    @property
    def ends(self) -> tuple[int, int]:
        """Numbers of the first and the last node."""
        return self.nodes[0], self.nodes[-1]


@dataclass(eq=False)
class WireGroup:
    """One wire or many of one section, material and element type; its name is that of a node set and of an element set.

    Attributes
    ----------
    name : str
        Name in the deck.
    section : Circular or General
        Cross-section.
    material : Material
        What the wires are made of.
    element : {"B33", "B31"}
        Type of the elements.
    first_element : int
        Number of the first element; the others follow.
    connectivity : ndarray
        Numbers of the nodes that each element joins, (m, 2).
    """

    name: str
    section: Section
    material: Material
    element: str
    first_element: int
    connectivity: NDArray[np.int64]
    _points: Points = field(repr=False)

    def __repr__(self) -> str:
        """Short description."""
        n_wires = len(self.wires)
        what = "wire" if n_wires == 1 else f"{n_wires} wires"
        size = f"radius {self.radius:g}, " if self.radius else ""
        return f"<{what} {self.name}: {len(self.connectivity)} {self.element} elements, {size}{self.material.name}>"

    @property
    def radius(self) -> float:
        """Radius of the round surface [m]."""
        return self.section.surface_radius

    @property
    def elements(self) -> range:
        """Numbers of all elements."""
        return range(self.first_element, self.first_element + len(self.connectivity))

    @cached_property
    def wires(self) -> list[Wire]:
        """The chains of elements between free ends and branches."""
        chains = find_wires(self.connectivity)
        numbers = {id(chain): (chain.elements + self.first_element).tolist() for chain in chains}
        return [Wire(tuple(chain.nodes.tolist()), tuple(numbers[id(chain)])) for chain in chains]

    @cached_property
    def nodes(self) -> Nodes:
        """All nodes, in the order along the wires."""
        return Nodes(self.name, dict.fromkeys(node for wire in self.wires for node in wire.nodes))

    @property
    def start(self) -> Nodes:
        """The first node of each wire."""
        return Nodes(f"{self.name}_START", (wire.nodes[0] for wire in self.wires))

    @property
    def end(self) -> Nodes:
        """The last node of each wire."""
        return Nodes(f"{self.name}_END", (wire.nodes[-1] for wire in self.wires))

    @property
    def ends(self) -> Nodes:
        """Both ends of each wire."""
        return Nodes(f"{self.name}_ENDS", dict.fromkeys(node for wire in self.wires for node in wire.ends))

    @property
    def middle(self) -> Nodes:
        """The node in the middle of each wire, by count."""
        return Nodes(f"{self.name}_MIDDLE", (wire.nodes[len(wire.nodes) // 2] for wire in self.wires))

    def nearest(self, point: Sequence[float]) -> Nodes:
        """The node of the group that is nearest to a point [m]."""
        place = np.asarray(point, dtype=float)
        if place.shape != (3,):
            raise ValueError(f"a point must have the coordinates x, y and z, not {point!r}")
        numbers = np.array(self.nodes)
        distances = np.linalg.norm(self._points.positions[numbers - 1] - place, axis=1)
        number = int(numbers[np.argmin(distances)])
        return Nodes(f"{self.name}_NODE{number}", [number])
