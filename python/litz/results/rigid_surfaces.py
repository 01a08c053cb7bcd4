"""The rigid surfaces of a run: what they are, and where they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import h5py
import numpy as np

from ..wires.curves import rotate


class NodalResults(Protocol):
    """What tells where a reference node is, and when."""

    @property
    def times(self) -> np.ndarray:
        """Total time of each increment, (n_increments) [s]."""

    @property
    def nodes(self) -> np.ndarray:
        """Reference positions of the nodes, (n_nodes, 3) [m]."""

    @property
    def node_ids(self) -> np.ndarray:
        """Numbers of the nodes in the deck, (n_nodes)."""

    def field(self, name: str, increment: int | None = -1) -> np.ndarray:
        """A field over nodes at an increment."""


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
        Radius of a cylinder or bore at the start [m]; 0 for a plane.
    reference_node : int, optional
        Number of the node with which it moves; None: it is fixed in space.
    radii : ndarray
        Total times [s], ascending, and radii [m] there, (2, n): at the start, and at the increments of one that changes.
    """

    name: str
    shape: str
    point: np.ndarray
    direction: np.ndarray
    radius: float
    reference_node: int | None
    radii: np.ndarray

    def radius_at(self, results: NodalResults, increment: int = -1) -> float:
        """The radius at an increment [m]."""
        return float(np.interp(results.times[increment], *self.radii))

    def moved(self, results: NodalResults, points: np.ndarray, increment: int = -1) -> np.ndarray:
        """Where points (n, 3) of the surface have moved to at an increment, (n, 3) [m]."""
        points = self._grown(points, self.radius_at(results, increment), self.radius)
        pose = self._pose(results, increment)
        return points if pose is None else pose.place + rotate(points - pose.start, pose.turns(len(points)))

    def brought_back(self, results: NodalResults, points: np.ndarray, increment: int = -1) -> np.ndarray:
        """The reverse of `moved`: points (n, 3) of an increment as seen from the surface, (n, 3) [m]."""
        pose = self._pose(results, increment)
        if pose is not None:
            points = pose.start + rotate(points - pose.place, -pose.turns(len(points)))
        return self._grown(points, self.radius, self.radius_at(results, increment))

    def _grown(self, points: np.ndarray, radius: float, before: float) -> np.ndarray:
        """Points that go with a change of the radius, across the axis."""
        if radius == before:
            return points
        arms = points - self.point
        across = arms - np.outer(arms @ self.direction, self.direction)
        return points + (radius / before - 1) * across

    def _pose(self, results: NodalResults, increment: int) -> _Pose | None:
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
        # files of earlier versions have one radius, and no time
        radii = np.array([data[:, 7], data[:, 6]] if data.shape[1] > 7 else [[0.0], values[6:7]])
        found[name] = SurfaceShape(
            name, shape.strip("\0 "), values[:3], values[3:6], float(radii[1, 0]), node or None, radii
        )
    return found
