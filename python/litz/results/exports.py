"""Results for other programs: CSV, VTU series, XDMF, VTKHDF."""

import csv
import html
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..base.names import unknown_name
from ..base.packages import optional
from ..base.quantities import in_brackets
from ..base.table import Table
from ..errors import FileError
from .contact_places import contact_places
from .contact_zones import contact_zones, wire_pairs
from .result_file import ResultFile
from .surface_exports import Frame, contact_frames, surface_frames, write_vtkhdf, write_vtu
from .zone_files import ZoneGrid, write_zones

#: Fields that do not change, and are columns or cells of their own
_STATIC = frozenset(["reference_position", "node_id", "element_id"])
#: Columns of the ledger that are points of the contacts
_CONTACT_POINT = ("point_1", "point_2")


def export(
    results: ResultFile | str | os.PathLike[str], to: str, directory: str | os.PathLike[str] | None = None
) -> Path:
    """Write results for another program.

    Parameters
    ----------
    results : Results or path
        What `Results` takes.
    to : {"csv", "vtu", "xdmf", "vtkhdf"}
        "csv": STEM_nodes.csv and STEM_elements.csv, a row for each node and increment, each element and increment, units in
        the heads; STEM_zones.csv and STEM_pairs.csv, the zones of line contact and the pairs of wires that touch, wires
        counted from 1. "vtu": STEM.pvd, STEM_contacts.pvd and STEM_zones.pvd, which name a file for each increment. "xdmf":
        STEM.xdmf with STEM.h5; needs meshio. "vtkhdf": the result files as they are, and
        STEM_zones.vtkhdf with the zones of line contact as lines. With rigid surfaces, "vtu" and "vtkhdf" also
        write STEM_rigid, the parts of them that the wires come to lie beside, and STEM_surfaces, the contacts with them
        as points.
    directory : path, optional
        Output directory; default: that of the results.

    Returns
    -------
    Path
        The file to open.
    """
    if to not in _WRITERS:
        raise ValueError(unknown_name("format", to, _WRITERS))
    results = results if isinstance(results, ResultFile) else ResultFile(results)
    target = results.path.parent if directory is None else Path(directory)
    try:
        target.mkdir(parents=True, exist_ok=True)
        return _WRITERS[to](results, target / results.path.stem)
    except OSError as error:
        raise FileError(f"cannot write into {target}: {error.strerror or error}") from None


def _beside(base: Path, ending: str) -> Path:
    return base.with_name(base.name + ending)


def _fields(results: ResultFile, on_points: bool) -> list[str]:
    return [name for name in results.fields if (name in results.point_fields) == on_points and name not in _STATIC]


# CSV


def _to_csv(results: ResultFile, base: Path) -> Path:
    nodes, elements = _beside(base, "_nodes.csv"), _beside(base, "_elements.csv")
    places = {"reference_position": results.nodes}
    _write_table(results, nodes, "node", results.node_ids, places, _fields(results, on_points=True))
    _write_table(results, elements, "element", results.element_ids, {}, _fields(results, on_points=False))
    written = np.flatnonzero(results.has_contacts())
    contacts = [contact_places(results, results.contacts_at(i)) for i in written.tolist()]
    for ending, table in (("_zones.csv", contact_zones), ("_pairs.csv", wire_pairs)):
        _write_rows(results, _beside(base, ending), [table(each, results.unit_labels) for each in contacts], written)
    return nodes


def _write_rows(results: ResultFile, path: Path, tables: list[Table], increments: NDArray) -> None:
    """The rows of a table at each of some increments; wires are counted from 1, as in the result file."""
    units = tables[0].units if tables else {}
    heads = ["step", "increment", f"time{in_brackets(results.unit_labels['s'])}"]
    heads += [f"{name}{in_brackets(unit)}" for name, unit in units.items()]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heads)
        numbers = (each[increments].tolist() for each in (results.steps, results.increments, results.times))
        for *place, table in zip(*numbers, tables, strict=True):
            columns = [(table[name] + name.startswith("wire_")).tolist() for name in units]
            writer.writerows([*place, *row] for row in zip(*columns, strict=True))


def _write_table(
    results: ResultFile, path: Path, what: str, ids: NDArray, first: dict[str, NDArray], names: list[str]
) -> None:
    """A row for each member and increment; vectors take three columns."""
    heads = ["step", "increment", f"time{in_brackets(results.unit_labels['s'])}", what]
    for name in [*first, *names]:
        values = first[name] if name in first else results.field(name)
        unit = "" if results.units[name] == "1" else in_brackets(results.units[name])
        heads += [f"{name}{part}{unit}" for part in (("",) if values.ndim == 1 else ("_x", "_y", "_z"))]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heads)
        for i, (step, increment, time) in enumerate(
            zip(results.steps.tolist(), results.increments.tolist(), results.times.tolist(), strict=True)
        ):
            columns = [first[name] if name in first else results.field(name, i) for name in [*first, *names]]
            numbers = np.column_stack(columns).tolist()
            for member, row in zip(ids.tolist(), numbers, strict=True):
                writer.writerow([step, increment, time, member, *row])


# VTU


def _to_vtu(results: ResultFile, base: Path) -> Path:
    import pyvista as pv

    n = len(results.elements)
    cells = np.column_stack([np.full(n, 2), results.elements]).ravel()
    digits = len(str(len(results.times)))
    wires, spots, zones, has = [], [], [], results.has_contacts()
    for i in range(len(results.times)):
        grid = pv.UnstructuredGrid(cells, np.full(n, pv.CellType.LINE, dtype=np.uint8), results.positions(i))
        for name in _fields(results, on_points=True):
            grid.point_data[name] = results.field(name, i)
        for name in _fields(results, on_points=False):
            grid.cell_data[name] = results.field(name, i)
        grid.point_data["node_id"], grid.cell_data["element_id"] = results.node_ids, results.element_ids
        wires.append(_beside(base, f"_{i:0{digits}}.vtu"))
        grid.save(wires[-1])
        if not has[i]:
            continue
        spots.append(_beside(base, f"_contacts_{i:0{digits}}.vtp"))
        _contact_points(results, i).save(spots[-1])
        zones.append(_beside(base, f"_zones_{i:0{digits}}.vtu"))
        ZoneGrid(results, i).to_pyvista().save(zones[-1])
    _write_pvd(_beside(base, "_contacts.pvd"), results.times[has], spots)
    _write_pvd(_beside(base, "_zones.pvd"), results.times[has], zones)
    for ending, frames in _surface_series(results).items():
        files = [_beside(base, f"{ending}_{i:0{digits}}.vtu") for i in range(len(frames))]
        for frame, file in zip(frames, files, strict=True):
            write_vtu(frame, file)
        _write_pvd(_beside(base, f"{ending}.pvd"), results.times, files)
    pvd = _beside(base, ".pvd")
    _write_pvd(pvd, results.times, wires)
    return pvd


def _surface_series(results: ResultFile) -> dict[str, list[Frame]]:
    """Rigid surfaces and the contacts with them over all increments, by the endings of their files."""
    if not results.rigid_surfaces:
        return {}
    return {"_rigid": list(surface_frames(results)), "_surfaces": list(contact_frames(results))}


def _contact_points(results: ResultFile, increment: int):  # type: ignore[no-untyped-def]
    """The contacts of an increment as points halfway between the axes, with the numbers of the ledger."""
    import pyvista as pv

    ledger = results.contacts_at(increment)
    places = [np.column_stack([ledger[f"{name}_{axis}"] for axis in "xyz"]) for name in _CONTACT_POINT]
    points = pv.PolyData((places[0] + places[1]) / 2 if ledger.n_rows else np.empty((0, 3)))
    for name, values in ledger.items():
        if np.issubdtype(values.dtype, np.number):
            points.point_data[name] = values
    return points


def _write_pvd(path: Path, times: NDArray, files: list[Path]) -> None:
    """ParaView's list of files over time."""
    lines = ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1">', "  <Collection>"]
    for time, file in zip(times.tolist(), files, strict=True):
        lines.append(f'    <DataSet timestep="{time!r}" part="0" file="{html.escape(file.name)}"/>')
    path.write_text("\n".join([*lines, "  </Collection>", "</VTKFile>", ""]), encoding="utf-8")


# XDMF


def _to_xdmf(results: ResultFile, base: Path) -> Path:
    meshio = optional("meshio")
    path = _beside(base, ".xdmf").resolve()
    # fields are read lazily, and the path of the results may be relative to the former directory
    results = ResultFile(results.path.resolve())
    data = path.with_suffix(".h5")
    if data.exists() and not path.exists():
        raise FileError(f"{data} exists already and does not belong to {path.name}: export into another directory")
    before = Path.cwd()
    # meshio puts the data into the current directory
    os.chdir(path.parent)
    try:
        with meshio.xdmf.TimeSeriesWriter(path.name) as writer:
            writer.write_points_cells(results.nodes, [("line", results.elements)])
            for i, time in enumerate(results.times.tolist()):
                points = {name: results.field(name, i) for name in _fields(results, on_points=True)}
                cells = {name: [results.field(name, i)] for name in _fields(results, on_points=False)}
                writer.write_data(time, point_data=points, cell_data=cells)
    finally:
        os.chdir(before)
    return _beside(base, ".xdmf")


# VTKHDF


def _to_vtkhdf(results: ResultFile, base: Path) -> Path:
    for ending in ("_contacts.vtkhdf", ".vtkhdf"):
        source, target = _beside(results.path.with_suffix(""), ending), _beside(base, ending)
        if source.resolve() != target.resolve():
            shutil.copyfile(source, target)
    write_zones(results, _beside(base, "_zones.vtkhdf"))
    for ending, frames in _surface_series(results).items():
        write_vtkhdf(frames, results.times, _beside(base, f"{ending}.vtkhdf"))
    return _beside(base, ".vtkhdf")


_WRITERS: dict[str, Callable[[ResultFile, Path], Path]] = {
    "csv": _to_csv,
    "vtu": _to_vtu,
    "xdmf": _to_xdmf,
    "vtkhdf": _to_vtkhdf,
}
