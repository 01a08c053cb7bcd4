"""Meshes in files that meshio reads."""

import contextlib
import io
import re
import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..base.packages import optional
from ..errors import FileError
from .mesh import Mesh, unique_rows


def read_by_meshio(path: Path) -> Mesh:
    """The lines and sets of a file."""
    meshio = optional("meshio")
    try:
        # it prints a blank line for a file of gmsh, and its message where it ends the program
        with contextlib.redirect_stdout(io.StringIO()):
            read = meshio.read(path)
    except (Exception, SystemExit) as error:  # its readers let any exception pass that a file leads to
        raise FileError(f"meshio cannot read {path}: {error or 'unknown form'}{_advice(path)}") from None
    points = np.asarray(read.points, dtype=float)
    points = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])
    pairs: list[NDArray] = []
    rows_of_block: list[NDArray | None] = []
    n_elements, n_others = 0, 0
    for block in read.cells:
        chain = _chain(block.type, np.asarray(block.data))
        if chain is None:
            n_others += len(block.data) * (block.type != "vertex")
            rows_of_block.append(None)
            continue
        per_cell = chain.shape[1] - 1
        pairs.append(np.stack([chain[:, :-1], chain[:, 1:]], axis=2).reshape(-1, 2))
        rows_of_block.append(n_elements + np.arange(len(chain) * per_cell).reshape(len(chain), per_cell))
        n_elements += len(chain) * per_cell
    if n_others and n_elements:
        warnings.warn(f"{path}: {n_others} elements that are not lines are ignored", stacklevel=4)
    connectivity = np.concatenate(pairs) if pairs else np.empty((0, 2))
    mesh = Mesh(points, connectivity.astype(np.int64), np.full(n_elements, ""), path=path)
    for name, members in read.point_sets.items():
        mesh.node_sets[_name(name)] = unique_rows(np.asarray(members).ravel())
    for name, cells in _named_cells(read).items():
        lines = [rows[one] for rows, one in zip(rows_of_block, cells, strict=True) if rows is not None and len(one)]
        corners = [
            np.asarray(block.data)[one].ravel()
            for block, one in zip(read.cells, cells, strict=True)
            if block.type == "vertex" and len(one)
        ]
        if lines:
            mesh.element_sets[_name(name)] = unique_rows(np.concatenate([one.ravel() for one in lines]))
        if corners:
            mesh.node_sets[_name(name)] = unique_rows(np.concatenate(corners))
    return mesh


def _advice(path: Path) -> str:
    """What to do about a file that meshio cannot read."""
    if path.suffix.lower() != ".msh":
        return ""
    head = path.read_bytes()[:64].split()
    version = head[1].decode(errors="replace") if head[:1] == [b"$MeshFormat"] and len(head) > 1 else "unknown"
    return f"; this is version {version} of gmsh's format: save it as version 4.1 or 2.2 (gmsh -save -format msh41)"


def _chain(kind: str, data: NDArray) -> NDArray | None:
    """Nodes of line elements from end to end: meshio has the ends first, then what is between them."""
    if kind == "line":
        return data
    if re.fullmatch(r"line\d+", kind):
        return np.column_stack([data[:, 0], data[:, 2:], data[:, 1]])
    return None


def _named_cells(read) -> dict[str, list[NDArray]]:  # type: ignore[no-untyped-def]
    """Rows of the cells of each set, block by block: cell sets, and gmsh's physical groups."""
    named = {}
    for name, cells in read.cell_sets.items():
        if not name.startswith("gmsh:"):
            named[name] = [np.asarray([] if one is None else one, dtype=np.int64) for one in cells]
    tags = read.cell_data.get("gmsh:physical")
    if tags is None:
        return named
    names = {(int(tag), int(dimension)): name for name, (tag, dimension) in read.field_data.items()}
    for number, (block, of_cells) in enumerate(zip(read.cells, tags, strict=True)):
        dimension = 0 if block.type == "vertex" else 1
        for tag in np.unique(of_cells):
            # gmsh has the tag 0 for what is in no group
            name = names.get((int(tag), dimension), f"PHYSICAL_{tag}" if tag and dimension <= 1 else "")
            if not name or name in read.cell_sets:
                continue
            rows = named.setdefault(name, [np.empty(0, dtype=np.int64) for _ in read.cells])
            rows[number] = np.flatnonzero(of_cells == tag)
    return named


def _name(name: str) -> str:
    """A name that a deck can hold."""
    word = re.sub(r"[\s,=\"*|]+", "_", str(name).strip())
    return f"SET_{word}" if not word or word.isdecimal() else word
