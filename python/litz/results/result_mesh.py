"""The mesh of a run: nodes, elements, wires, sets, sections and rigid surfaces."""

import contextlib
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np

from ..errors import FileError
from ..wires import BEYOND, Wire, WireArcs, ends_of_images, find_wires, numbered_wires, wire_arcs, without_images
from .outlines import SectionOutline
from .rigid_surfaces import SurfaceShape, read_surfaces


class ResultMesh:
    """What a result file has of the mesh.

    Attributes
    ----------
    path : Path
        The result file of the wires.
    """

    def __init__(self, path: Path):
        self.path = path
        self._kept: h5py.File | None = None

    def _open(self) -> contextlib.AbstractContextManager[h5py.File]:
        if self._kept is not None:
            return contextlib.nullcontext(self._kept)
        try:
            return h5py.File(self.path, "r", locking=False)
        except OSError as error:
            raise FileError(f"cannot read {self.path}: {error}") from None

    @cached_property
    def nodes(self) -> np.ndarray:
        """Reference positions of the nodes, (n_nodes, 3) [m]."""
        return self._static("VTKHDF/PointData/reference_position")

    @cached_property
    def node_ids(self) -> np.ndarray:
        """Numbers of the nodes in the deck, (n_nodes)."""
        return self._static("VTKHDF/PointData/node_id")

    @cached_property
    def elements(self) -> np.ndarray:
        """Rows of `nodes` that each element joins, (n_elements, 2)."""
        return self._static("VTKHDF/Connectivity").reshape(-1, 2)

    @cached_property
    def element_ids(self) -> np.ndarray:
        """Numbers of the elements in the deck, (n_elements)."""
        return self._static("VTKHDF/CellData/element_id")

    @cached_property
    def radius(self) -> np.ndarray:
        """Radius of the wire at each element, (n_elements) [m]."""
        return self._static("VTKHDF/CellData/radius")

    @cached_property
    def wires(self) -> list[Wire]:
        """The wires, without `images`: elements between free ends and branches, in the order of their first elements."""
        return without_images(self._chains, self.images)

    @cached_property
    def conductors(self) -> list[Wire]:
        """The wires, with what goes on from them beyond the upper end of a cell and conducts as a part of them."""
        return without_images(self._chains, self.images & ~self.conducting_images)

    @cached_property
    def _chains(self) -> list[Wire]:
        names = ("wire", "place_in_wire", "direction_in_wire")
        with self._open() as file:
            cells = file["VTKHDF/CellData"]
            if "wire" not in cells:
                # files of litz 0.1
                return find_wires(self.elements)
            return numbered_wires(self.elements, *(cells[name][()] for name in names))

    @cached_property
    def images(self) -> np.ndarray:
        """Which elements are images of others, beyond the periodic ends of a cell, (n_elements)."""
        return np.any([self._members(name) for name in BEYOND], axis=0)

    @cached_property
    def conducting_images(self) -> np.ndarray:
        """Which `images` have contacts that count, those beyond the upper end of a cell, (n_elements)."""
        return self._members(BEYOND[0])

    def _members(self, name: str) -> np.ndarray:
        """Which elements an element set has, if there is one of this name, (n_elements)."""
        return np.isin(np.arange(len(self.elements)), self.element_sets.get(name, ()))

    @cached_property
    def wire_arcs(self) -> WireArcs:
        """Where the elements are along the wires, before deformation."""
        return wire_arcs(self.nodes, self.elements, self.wires)

    @cached_property
    def conductor_arcs(self) -> WireArcs:
        """Where the elements are along the wires, with those beyond the upper end of a cell, whose arcs are longer than these."""
        return wire_arcs(self.nodes, self.elements, self.conductors)

    @cached_property
    def _ends_of_images(self) -> tuple[np.ndarray, np.ndarray]:
        """Rows of the elements from which images go on, and at which end of them, -1 or 1, (n_elements) each."""
        return ends_of_images(self._chains, self.images)

    @cached_property
    def node_sets(self) -> dict[str, np.ndarray]:
        """Rows of `nodes` in each node set."""
        return self._sets("litz/node_sets", self.node_ids)

    @cached_property
    def element_sets(self) -> dict[str, np.ndarray]:
        """Rows of `elements` in each element set."""
        return self._sets("litz/element_sets", self.element_ids)

    @cached_property
    def rigid_surfaces(self) -> dict[str, SurfaceShape]:
        """The rigid surfaces by their names, as they are before any deformation."""
        with self._open() as file:
            return read_surfaces(file)

    @cached_property
    def sections(self) -> np.ndarray:
        """Number of the section of each element, from 1, (n_elements)."""
        return self._static("VTKHDF/CellData/section")

    @cached_property
    def section_outlines(self) -> dict[int, SectionOutline]:
        """Outlines of the sections that are not round and have one, by the numbers of the sections."""
        with self._open() as file:
            return {
                int(name): SectionOutline(corners[()], file["litz/first_axes"][name][0])
                for name, corners in file.get("litz/outlines", {}).items()
            }

    def _static(self, name: str) -> np.ndarray:
        with self._open() as file:
            return file[name][()]

    def _sets(self, name: str, ids: np.ndarray) -> dict[str, np.ndarray]:
        order = np.argsort(ids)
        with self._open() as file:
            return {
                key.replace("|", "/"): order[np.searchsorted(ids, members[()], sorter=order)]
                for key, members in file[name].items()
            }
