"""Line elements with sets, from another program."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..deck.keyword_table import keyword
from .materials import Material, Section

#: Elements of Abaqus and CalculiX that litz takes as others; the number of nodes along the beam
FOREIGN_BEAMS = {
    "B31R": ("B31", 2),
    "B31H": ("B31", 2),
    "B33H": ("B33", 2),
    "B32": ("B31", 3),
    "B32R": ("B31", 3),
    "B32H": ("B31", 3),
}


def element_types() -> list[str]:
    """The types of beam elements that litz has itself."""
    parameters = keyword("ELEMENT")["parameters"]
    choices = next(parameter["choices"] for parameter in parameters if parameter["name"] == "TYPE")
    return [choice for choice in choices if choice not in FOREIGN_BEAMS]


@dataclass
class Mesh:
    """Line elements with sets, from another program.

    Attributes
    ----------
    x : ndarray
        Positions of the nodes, (n, 3) [unit of length of the file].
    connectivity : ndarray
        Rows of `x` that each element joins, (m, 2).
    kinds : ndarray of str
        Type of each element, such as "B31"; empty where the file does not say, (m).
    node_sets, element_sets : dict of str to ndarray
        Rows of the members.
    sections : list of tuple
        Element set, section and material, where the file has them.
    path : Path
        Where it comes from.
    """

    x: NDArray[np.float64]
    connectivity: NDArray[np.int64]
    kinds: NDArray[np.str_]
    node_sets: dict[str, NDArray[np.int64]] = field(default_factory=dict)
    element_sets: dict[str, NDArray[np.int64]] = field(default_factory=dict)
    sections: list[tuple[str, Section, Material]] = field(default_factory=list)
    path: Path = Path()

    def __repr__(self) -> str:
        """What it holds."""
        sets = ", ".join([*self.element_sets, *self.node_sets]) or "none"
        return f"<Mesh {self.path}: {len(self.x)} nodes, {len(self.connectivity)} elements, sets: {sets}>"


def unique_rows(rows: Iterable[int]) -> NDArray[np.int64]:
    """Rows in their order, each once."""
    return np.array(list(dict.fromkeys(int(row) for row in rows)), dtype=np.int64)


def without_spare_nodes(mesh: Mesh) -> Mesh:
    """Nodes of no element, such as Abaqus's for orientation, are removed."""
    used = np.unique(mesh.connectivity)
    new = np.full(len(mesh.x), -1, dtype=np.int64)
    new[used] = np.arange(len(used))
    mesh.x = mesh.x[used]
    mesh.connectivity = new[mesh.connectivity]
    sets = {name: new[members][new[members] >= 0] for name, members in mesh.node_sets.items()}
    mesh.node_sets = {name: members for name, members in sets.items() if len(members)}
    mesh.element_sets = {name: members for name, members in mesh.element_sets.items() if len(members)}
    return mesh
