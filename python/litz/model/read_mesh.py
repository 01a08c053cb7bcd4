"""Meshes of other programs: gmsh and all that meshio reads, and beam decks of Abaqus."""

import os
from pathlib import Path

from ..errors import FileError
from .abaqus_mesh import read_deck
from .mesh import Mesh, without_spare_nodes
from .meshio_mesh import read_by_meshio

_DECK_ENDINGS = (".inp",)


def read_mesh(path: str | os.PathLike[str], *, dialect: str | None = None) -> Mesh:
    """Read line elements, node sets and element sets.

    Parameters
    ----------
    path : path
        A deck of Abaqus (.inp) with beams B31, B32, B33, such as BeamMe writes, or with trusses T3D2, T3D3 alone, as which
        gmsh writes lines; instances of parts stand at their places, and their sets are named "instance.set". Or a file that
        meshio reads, such as one of gmsh (.msh): its lines are elements, its physical groups and cell sets are sets. Needs
        meshio.
    dialect : {"abaqus", "ccx"}, optional
        Whose deck it is, where it has a `*BEAM SECTION, SECTION=CIRC`: its value is the radius in Abaqus and in litz, but the
        diameter in CalculiX, where two are those of an ellipse.

    Returns
    -------
    Mesh
        Nodes without elements, and elements that are not lines, are ignored.
    """
    path = Path(path)
    if not path.is_file():
        raise FileError(f"there is no file {path}")
    mesh = read_deck(path, dialect) if path.suffix.lower() in _DECK_ENDINGS else read_by_meshio(path)
    if not len(mesh.connectivity):
        raise FileError(f"{path} has no line elements")
    return without_spare_nodes(mesh)
