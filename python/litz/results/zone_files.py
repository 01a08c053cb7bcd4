"""Zones of contact along lines as polylines for ParaView: VTKHDF over time, or one VTU file for each increment."""

from pathlib import Path
from typing import TYPE_CHECKING

import h5py
import numpy as np

from .contact_places import contact_places
from .contact_zones import contact_zones, per_length
from .result_file import ResultFile
from .zone_lines import zone_lines

if TYPE_CHECKING:
    import pyvista as pv

#: VTK's numbers of the cell types: a point, a line through several points
_VERTEX, _POLYLINE = 1, 4
#: Columns of the zones that are no values of cells
_ENDS = ("begin_", "end_")


class ZoneGrid:
    """The zones of an increment: a line through the places of each, with values of points and of lines by name."""

    def __init__(self, results: ResultFile, increment: int):
        places = contact_places(results, results.contacts_at(increment))
        lines = zone_lines(places, max_points=None)
        zones = contact_zones(places, results.unit_labels)
        self.points = places.point[lines.rows]
        self.starts = lines.starts
        self.types = np.where(np.diff(lines.starts) > 1, _POLYLINE, _VERTEX).astype(np.uint8)
        self.point_data = {name: values[lines.rows] for name, values in per_length(places).items()}
        # wires are counted from 1, as in the result file of the wires
        self.cell_data = {
            name: values + name.startswith("wire_") for name, values in zones.items() if not name.startswith(_ENDS)
        }
        self.units = zones.units

    def to_pyvista(self) -> "pv.UnstructuredGrid":
        """The lines as a mesh of PyVista."""
        import pyvista as pv

        size = np.diff(self.starts)
        cells = np.insert(np.arange(len(self.points)), self.starts[:-1], size)
        grid = pv.UnstructuredGrid(cells, self.types, self.points) if len(size) else pv.UnstructuredGrid()
        for data, values in ((grid.point_data, self.point_data), (grid.cell_data, self.cell_data)):
            for name, column in values.items():
                data[name] = column
        return grid


def write_zones(results: ResultFile, path: Path) -> Path:
    """The zones of all increments that have contacts in the ledger as a VTKHDF file."""
    has = np.flatnonzero(results.has_contacts())
    times = results.times[has]
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = [2, 0]
        root.attrs.create("Type", np.bytes_("UnstructuredGrid"))
        steps = root.create_group("Steps")
        steps.attrs["NSteps"] = len(times)
        _append(steps, "Values", times)
        _append(steps, "NumberOfParts", np.ones(len(times), dtype=np.int64))
        _append(steps, "PartOffsets", np.arange(len(times)))
        for increment in has.tolist():
            _add_step(root, steps, ZoneGrid(results, increment))
    return path


def _add_step(root: h5py.Group, steps: h5py.Group, grid: ZoneGrid) -> None:
    n_points, n_cells = len(grid.points), len(grid.types)
    before_points, before_cells = (len(root[name]) if name in root else 0 for name in ("Points", "Types"))
    for name, value in (
        ("PointOffsets", before_points), ("CellOffsets", before_cells), ("ConnectivityIdOffsets", before_points),
    ):  # fmt: skip
        _append(steps, name, np.array([value]))
    for name, value in (
        ("NumberOfPoints", n_points),
        ("NumberOfCells", n_cells),
        ("NumberOfConnectivityIds", n_points),
    ):
        _append(root, name, np.array([value]))
    _append(root, "Points", grid.points)
    _append(root, "Connectivity", np.arange(n_points))
    _append(root, "Offsets", grid.starts)
    _append(root, "Types", grid.types)
    for place, data, before in (("Point", grid.point_data, before_points), ("Cell", grid.cell_data, before_cells)):
        for name, values in data.items():
            _append(root.require_group(f"{place}Data"), name, values)
            root[f"{place}Data/{name}"].attrs["unit"] = grid.units[name]
            _append(steps.require_group(f"{place}DataOffsets"), name, np.array([before]))


def _append(group: h5py.Group, name: str, values: np.ndarray) -> None:
    """Add rows to a dataset, which is made when it is not there yet."""
    values = np.asarray(values)
    if name not in group:
        group.create_dataset(name, data=values, maxshape=(None, *values.shape[1:]), chunks=True)
        return
    data = group[name]
    data.resize(len(data) + len(values), axis=0)
    data[len(data) - len(values) :] = values
