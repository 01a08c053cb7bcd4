"""Rigid surfaces and the contacts with them for other programs: series of VTK files, VTKHDF."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from .result_file import ResultFile
from .surface_forces import surface_forces
from .surface_patches import surface_patches

#: VTK's numbers of cell types
_VERTEX, _QUAD = 1, 9


@dataclass
class Frame:
    """What is shown of one increment.

    Attributes
    ----------
    points : ndarray
        Places, (n, 3) [m].
    cells : ndarray
        Rows of `points` of each cell, (m, corners of a cell).
    values : dict of str to ndarray
        Values of each cell, (m) or (m, 3).
    """

    points: NDArray
    cells: NDArray
    values: dict[str, NDArray] = field(default_factory=dict)

    @property
    def kind(self) -> int:
        """VTK's number of the type of the cells."""
        return {1: _VERTEX, 4: _QUAD}[self.cells.shape[1]]


def surface_frames(results: ResultFile) -> Iterator[Frame]:
    """The patches of all surfaces at each increment, with what each surface feels."""
    increments = list(range(len(results.times)))
    patches = surface_patches(results, increments)
    counts = [len(patch.points) for patch in patches]
    first = np.cumsum([0, *counts[:-1]])
    cells = np.concatenate([start + patch.quads for start, patch in zip(first, patches, strict=True)])
    faces = [len(patch.quads) for patch in patches]
    forces = surface_forces(results)
    for k in increments:
        now = forces.where((forces["step"] == results.steps[k]) & (forces["increment"] == results.increments[k]))
        row_of = {name: row for row, name in enumerate(now["surface"])}
        rows = [row_of[patch.surface.name] for patch in patches]
        values = {
            name: np.repeat(np.column_stack([now[f"{name}_{axis}"] for axis in "xyz"])[rows], faces, axis=0)
            for name in ("surface_force", "surface_moment")
        }
        values["surface"] = np.repeat(np.arange(1, len(patches) + 1), faces)
        yield Frame(np.concatenate([patch.moved(results, k) for patch in patches]), cells, values)


def contact_frames(results: ResultFile) -> Iterator[Frame]:
    """The contacts with surfaces at each increment, as points of the axes."""
    names = list(results.rigid_surfaces)
    for k in range(len(results.times)):
        now = results.surface_contacts_at(k)
        values = {
            name: np.column_stack([now[f"{name}_{axis}"] for axis in "xyz"])
            for name in ("normal", "traction", "surface_force", "surface_moment")
        }
        for name in ("element", "length", "gap", "force", "slip_path", "dissipation"):
            values[name] = now[name]
        values["surface"] = np.array([names.index(name) + 1 for name in now["surface"]], dtype=np.int64)
        points = np.column_stack([now[f"point_{axis}"] for axis in "xyz"])
        yield Frame(points, np.arange(now.n_rows)[:, None], values)


def write_vtu(frame: Frame, path: Path) -> None:
    """One increment as a file that ParaView reads."""
    import pyvista as pv

    n, corners = frame.cells.shape
    cells = np.column_stack([np.full(n, corners), frame.cells]).ravel()
    grid = pv.UnstructuredGrid(cells, np.full(n, frame.kind, dtype=np.uint8), frame.points)
    # VTK takes no empty arrays
    for name, values in frame.values.items() if n else ():
        grid.cell_data[name] = values
    grid.save(path)


def write_vtkhdf(frames: list[Frame], times: NDArray, path: Path) -> None:
    """A series over time in one file, which ParaView and pyvista read."""
    counts = {
        "NumberOfPoints": [len(frame.points) for frame in frames],
        "NumberOfCells": [len(frame.cells) for frame in frames],
        "NumberOfConnectivityIds": [frame.cells.size for frame in frames],
    }
    starts = {name: np.concatenate([[0], np.cumsum(values)[:-1]]) for name, values in counts.items()}
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = [2, 0]
        root.attrs["Type"] = np.bytes_("UnstructuredGrid")
        for name, values in counts.items():
            root[name] = values
        root["Points"] = np.concatenate([frame.points for frame in frames])
        root["Connectivity"] = np.concatenate([frame.cells.ravel() for frame in frames]).astype(np.int64)
        root["Offsets"] = np.concatenate([np.arange(len(frame.cells) + 1) * frame.cells.shape[1] for frame in frames])
        root["Types"] = np.concatenate([np.full(len(frame.cells), frame.kind, dtype=np.uint8) for frame in frames])
        steps = root.create_group("Steps")
        steps.attrs["NSteps"] = len(frames)
        steps["Values"] = times
        steps["PartOffsets"] = np.arange(len(frames))
        steps["NumberOfParts"] = np.ones(len(frames), dtype=np.int64)
        steps["PointOffsets"] = starts["NumberOfPoints"]
        steps["CellOffsets"] = starts["NumberOfCells"][:, None]
        steps["ConnectivityIdOffsets"] = starts["NumberOfConnectivityIds"][:, None]
        for name in frames[0].values:
            root[f"CellData/{name}"] = np.concatenate([frame.values[name] for frame in frames])
            steps[f"CellDataOffsets/{name}"] = starts["NumberOfCells"]
