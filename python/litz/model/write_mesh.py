"""The mesh of a model as an HDF5 file, which `*MESH, INPUT=` of a deck reads."""

from pathlib import Path

import h5py
import numpy as np

from .loaded_model import LoadedModel


def write_mesh_file(model: LoadedModel, path: Path) -> None:
    """Write nodes, elements and sets: the layout of `*MESH` in the deck reference."""
    groups = model.groups.values()
    nodes = model.connectivity + 1
    elements = np.arange(1, len(nodes) + 1)
    kinds = np.repeat([group.element for group in groups], [len(group.connectivity) for group in groups])
    with h5py.File(path, "w") as file:
        file["nodes/id"] = np.arange(1, len(model.x) + 1)
        file["nodes/position"] = model.x
        for kind in np.unique(kinds):
            file[f"elements/{kind}/id"] = elements[kinds == kind]
            file[f"elements/{kind}/nodes"] = nodes[kinds == kind]
        for group in groups:
            file[f"element_sets/{group.name}"] = np.array(group.elements)
            if group.name not in model.node_sets:
                file[f"node_sets/{group.name}"] = np.array(group.nodes)
        for name, nodes_of_set in model.node_sets.items():
            file[f"node_sets/{name}"] = nodes_of_set
        for name in model.element_sets:
            file[f"element_sets/{name}"] = model.elements_of(name)
