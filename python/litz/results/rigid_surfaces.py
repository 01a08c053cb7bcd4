"""The rigid surfaces of a run: where they are, and what they feel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import h5py
import numpy as np

from ..base.table import Table
from ..wires.curves import rotate

if TYPE_CHECKING:
    from .result_file import ResultFile


@dataclass(frozen=True)
class SurfaceShape:
    """A rigid surface before any deformation.

    Attributes
    ----------
    name : str
        Name in the deck.
    shape : {"PLANE", "CYLINDER", "BORE"}
        A plane, a cylinder that is touched from outside, or one that is touched from inside.
    point, direction : ndarray
        A point of the plane or of the axis (3) [m]; the unit normal towards the wires, or the direction of the axis (3).
    radius : float
        Radius of a cylinder or bore [m]; 0 for a plane.
    reference_node : int, optional
        Number of the node with which it moves; None: it is fixed in space.
    """

    name: str
    shape: str
    point: np.ndarray
    direction: np.ndarray
    radius: float
    reference_node: int | None

    def moved(self, results: ResultFile, points: np.ndarray, increment: int = -1) -> np.ndarray:
        """Where points (n, 3) of the surface have moved to at an increment, (n, 3) [m]."""
        pose = self._pose(results, increment)
        return points if pose is None else pose.place + rotate(points - pose.start, pose.turns(len(points)))

    def brought_back(self, results: ResultFile, points: np.ndarray, increment: int = -1) -> np.ndarray:
        """The reverse of `moved`: points (n, 3) of an increment as seen from the surface, (n, 3) [m]."""
        pose = self._pose(results, increment)
        return points if pose is None else pose.start + rotate(points - pose.place, -pose.turns(len(points)))

    def _pose(self, results: ResultFile, increment: int) -> _Pose | None:
        if self.reference_node is None:
            return None
        row = int(np.flatnonzero(results.node_ids == self.reference_node)[0])
        start, rotation = results.nodes[row], results.field("rotation", increment)[row]
        return _Pose(start, start + results.field("displacement", increment)[row], rotation)


@dataclass(frozen=True)
class _Pose:
    """Place of a reference node before and now [m], and its rotation vector."""

    start: np.ndarray
    place: np.ndarray
    rotation: np.ndarray

    def turns(self, n: int) -> np.ndarray:
        return np.broadcast_to(self.rotation, (n, 3))


def read_surfaces(file: h5py.File) -> dict[str, SurfaceShape]:
    """The surfaces of a result file by their names; files without any have none."""
    found = {}
    for link, data in file.get("litz/rigid_surfaces", {}).items():
        values, node = data[0], int(data.attrs["reference_node"])
        kind = data.attrs["type"]
        shape = kind.decode() if isinstance(kind, bytes) else str(kind)
        name = link.replace("|", "/")
        found[name] = SurfaceShape(name, shape.strip("\0 "), values[:3], values[3:6], float(values[6]), node or None)
    return found


def surface_forces(results: ResultFile) -> Table:
    """What each surface feels at each increment of the history: a row for each surface and increment."""
    if not results.rigid_surfaces:
        return Table({}, {})
    contacts, history = results.surface_contacts, results.history
    unit = results.unit_labels
    names = np.array(list(results.rigid_surfaces), dtype=str)
    keys = ("step", "increment", "time")
    columns = {key: np.repeat(history[key], len(names)) for key in keys}
    row_of = {key: row for row, key in enumerate(zip(history["step"], history["increment"], strict=True))}
    place_of = {name: place for place, name in enumerate(names)}
    rows = np.array(
        [
            row_of[step, increment] * len(names) + place_of[name]
            for step, increment, name in zip(contacts["step"], contacts["increment"], contacts["surface"], strict=True)
        ],
        dtype=int,
    )
    n = len(columns["time"])
    columns["contacts"] = np.bincount(rows, minlength=n)
    for name in ("length", "force", *_components("surface_force"), *_components("surface_moment"), "dissipation"):
        columns[name] = np.bincount(rows, contacts[name], minlength=n)
    columns["penetration"] = np.zeros(n)
    np.maximum.at(columns["penetration"], rows, -contacts["gap"])
    columns["surface"] = np.tile(names, history.n_rows)
    units = {**contacts.units, "time": unit["s"], "contacts": "", "penetration": unit["m"]}
    return Table(columns, {name: units.get(name, "") for name in columns})


def _components(name: str) -> list[str]:
    return [f"{name}_{axis}" for axis in "xyz"]
