"""The mesh of a model as an HDF5 file, which `*MESH, INPUT=` of a deck reads."""

from pathlib import Path

import h5py
import numpy as np

from .model import Model


def write_mesh_file(model: Model, path: Path) -> None:
    """Write nodes, elements and sets: the layout of `*MESH` in the deck reference."""
    elements = np.arange(1, len(model.connectivity) + 1)
    nodes = model.connectivity + 1
    kinds = np.array([group.element for group in model.groups.values() for wire in group.wires for _ in wire.elements])
    with h5py.File(path, "w") as file:
        file["nodes/id"] = np.arange(1, len(model.x) + 1)
        file["nodes/position"] = model.x
        for kind in np.unique(kinds):
            file[f"elements/{kind}/id"] = elements[kinds == kind]
            file[f"elements/{kind}/nodes"] = nodes[kinds == kind]
        for name, group in model.groups.items():
            file[f"node_sets/{name}"] = group.nodes
            file[f"element_sets/{name}"] = [element for wire in group.wires for element in wire.elements]
        for name, members in model.node_sets.items():
            file[f"node_sets/{name}"] = members
        for name, groups in model.element_sets.items():
            file[f"element_sets/{name}"] = [
                element for group in groups for wire in model.groups[group].wires for element in wire.elements
            ]
