"""Nodes, wires and materials of a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..base.names import nearest_name, unknown_name
from ..deck.keyword_table import squeezed
from .curves import along_curve, along_polyline, along_spline, check_elements, check_points, straight
from .materials import Circular, General, Material, Section
from .mesh import Mesh, element_types
from .names import Names, span_name
from .wires import Nodes, Wire, WireGroup


class WireModel(Names):
    """Nodes and wires, numbered from 1 in the order in which they are added, and what they are made of."""

    def __init__(self) -> None:
        super().__init__()
        self._materials: dict[str, Material] = {}
        #: Nodes (name or None, first, last) and groups in the order in which they were added
        self.blocks: list[tuple[str | None, int, int] | WireGroup] = []

    def nodes(self, points: ArrayLike, name: str | None = None) -> Nodes:
        """Add nodes.

        Parameters
        ----------
        points : (n, 3) array
            Positions [m].
        name : str, optional
            Node set that holds them.

        Returns
        -------
        Nodes
            Their numbers.
        """
        array = np.array(points, dtype=float).reshape(-1, np.shape(points)[-1] if np.ndim(points) else 1)
        if array.shape[1] != 3 or not np.isfinite(array).all():
            raise ValueError(f"points must be finite positions, an array of shape (n, 3), not {np.shape(points)}")
        if name is not None:
            self._claim(name)
            self.node_sets[name] = []
        numbers = self._add_nodes(array, None)
        if name is not None:
            self.node_sets[name] = list(numbers)
        return Nodes(name or span_name(numbers), numbers)

    def elements(
        self,
        name: str,
        connectivity: ArrayLike,
        *,
        radius: float | None = None,
        section: Section | None = None,
        material: Material | str,
        element: str = "B33",
    ) -> WireGroup:
        """Add elements between nodes that are there.

        Parameters
        ----------
        name : str
            Name of the group.
        connectivity : (m, 2) array of int
            Numbers of the two nodes of each element.
        radius, section, material, element
            As those of `wire`.
        """
        given = np.asarray(connectivity)
        if given.ndim != 2 or given.shape[1] != 2 or not len(given) or not np.issubdtype(given.dtype, np.integer):
            raise ValueError(f"connectivity must be node numbers, an array of shape (m, 2), not {given.shape}")
        if given.min() < 1 or given.max() > len(self._points):
            raise ValueError(f"there are nodes 1 to {len(self._points)}; found {given.min()} to {given.max()}")
        if (given[:, 0] == given[:, 1]).any():
            raise ValueError(f"element {int(np.argmax(given[:, 0] == given[:, 1])) + 1} joins a node with itself")
        section, material = self._properties(radius, section, material, element)
        self._claim(name)
        group = self._add_group(name, section, material, element, given.astype(np.int64))
        self.node_sets[name] = list(group.nodes)
        return group

    def wire(
        self,
        name: str,
        start: ArrayLike | Nodes | None = None,
        end: ArrayLike | Nodes | None = None,
        *,
        points: ArrayLike | None = None,
        spline: bool = False,
        curve: Callable[[float], ArrayLike] | None = None,
        span: tuple[float, float] = (0.0, 1.0),
        closed: bool = False,
        elements: int | None = None,
        radius: float | None = None,
        section: Section | None = None,
        material: Material | str,
        element: str = "B33",
    ) -> WireGroup:
        """Add a wire: straight from `start` to `end`, along `points`, or along a `curve`.

        Parameters
        ----------
        name : str
            Name of the wire, of its node set and of its element set.
        start, end : (3) array or Nodes
            Ends of a straight wire [m]. A node, such as `other.end`, is shared: the wires are joined there.
        points : (n, 3) array
            A polygon [m]. Without `elements` its corners are the nodes.
        spline : bool
            A smooth curve through the points in place of the polygon; needs `elements`.
        curve : callable
            Position (x, y, z) [m] over a parameter that goes through `span`.
        span : tuple of 2 float
            First and last value of the parameter.
        closed : bool
            The last node is the first one: a ring.
        elements : int
            Number of elements, at equal distances along the wire; a polygon has a node at each corner.
        radius : float
            Radius of a solid round wire [m]; or else
        section : Circular or General
            Cross-section.
        material : Material or str
            What it is made of.
        element : {"B33", "B31"}
            Type of the elements.

        Returns
        -------
        WireGroup
            The wire; its `start`, `end`, `ends`, `middle` and `nearest(point)` are nodes to hold and to load.

        Examples
        --------
        >>> import litz
        >>> model = litz.Model("a ring on a post")
        >>> steel = model.material("STEEL", young=200e9, poisson=0.3)
        >>> post = model.wire("POST", (0, 0, 0), (0, 0, 1), elements=4, radius=0.01, material=steel)
        >>> around = lambda t: (np.cos(t), np.sin(t), 2.0)
        >>> ring = model.wire("RING", curve=around, span=(0, 2 * np.pi), closed=True, elements=24, radius=0.01,
        ...                   material=steel)
        >>> strut = model.wire("STRUT", post.end, ring.start, elements=3, radius=0.01, material=steel)
        >>> len(model.x), strut.nodes
        (31, <Nodes STRUT: 5, 30, 31, 6>)
        """
        section, material = self._properties(radius, section, material, element)
        ways = {"start and end": start is not None and end is not None, "points": points is not None, "curve": curve}
        if sum(map(bool, ways.values())) != 1 or (start is None) != (end is None):
            raise ValueError("a wire goes from start to end, along points, or along a curve: give one of these")
        n_elements = 0 if elements is None else check_elements(elements)
        if n_elements == 0 and (points is None or spline):
            raise ValueError("elements is needed: the number of elements of the wire")
        shared: list[int | None] = [None, None]
        if points is not None:
            axis = self._along_points(points, spline, closed, n_elements)
        elif curve is not None:
            axis = along_curve(curve, n_elements, span)
        else:
            shared = [self._shared(start), self._shared(end)]
            axis = straight(self._place(start, "start"), self._place(end, "end"), n_elements)
        axis = check_points(axis)
        if closed:
            gap = float(np.linalg.norm(axis[-1] - axis[0]))
            if gap > 1e-6 * float(np.ptp(axis, axis=0).max()):
                raise ValueError(f"a closed wire must end where it begins; its ends are {gap:g} m apart")
        self._claim(name)
        return self._add_wire(name, axis, shared, closed, (section, material, element))

    @staticmethod
    def _along_points(points: ArrayLike, spline: bool, closed: bool, elements: int) -> NDArray[np.float64]:
        corners = check_points(points)
        if closed and not np.array_equal(corners[0], corners[-1]):
            corners = np.vstack([corners, corners[:1]])
        if spline:
            return along_spline(corners, elements, closed=closed)
        return along_polyline(corners, elements) if elements else corners

    def _shared(self, end: ArrayLike | Nodes | None) -> int | None:
        """The node that an end of a wire is, if it is one."""
        if isinstance(end, Nodes):
            if len(end) != 1:
                raise ValueError(f"an end of a wire is one node, {end!r} has {len(end)}")
            return end[0]
        return int(end) if isinstance(end, Integral) else None

    def _place(self, end: ArrayLike | Nodes | None, what: str) -> NDArray[np.float64]:
        node = self._shared(end)
        if node is not None:
            self._check_node(node)
            return self.x[node - 1]
        place = np.asarray(end, dtype=float)
        if place.shape != (3,) or not np.isfinite(place).all():
            raise ValueError(f"{what} must be a position (x, y, z) or a node, not {end!r}")
        return place

    def _add_wire(
        self, name: str, axis: NDArray, shared: list[int | None], closed: bool, properties: tuple
    ) -> WireGroup:
        own = axis[shared[0] is not None : len(axis) - (shared[1] is not None or closed)]
        plain = not closed and shared == [None, None]
        numbers = list(self._add_nodes(own, name if plain else None)) if len(own) else []
        if shared[0] is not None:
            numbers.insert(0, shared[0])
        if closed:
            numbers.append(numbers[0])
        elif shared[1] is not None:
            numbers.append(shared[1])
        connectivity = np.array([numbers[:-1], numbers[1:]], dtype=np.int64).T
        section, material, element = properties
        group = self._add_group(name, section, material, element, connectivity)
        group.wires = [Wire(tuple(numbers), group.elements)]
        if not plain:
            self.node_sets[name] = list(group.nodes)
        return group

    def wires(
        self,
        name: str,
        axes: Sequence[ArrayLike],
        *,
        radius: float | None = None,
        section: Section | None = None,
        material: Material | str,
        element: str = "B33",
    ) -> WireGroup:
        """Add many wires as one group.

        Parameters
        ----------
        name : str
            Name of the group, of its node set and of its element set.
        axes : sequence of (n, 3) arrays
            Positions of the nodes along each wire [m], n > 1.
        radius, section, material, element
            As those of `wire`.
        """
        section, material = self._properties(radius, section, material, element)
        points = [check_points(axis) for axis in axes]
        if not points:
            raise ValueError("a group needs at least one wire")
        self._claim(name)
        first = len(self._points) + 1
        self._add_nodes(np.concatenate(points), name)
        chains, pairs = [], []
        element_number = self._n_elements + 1
        for axis in points:
            numbers = range(first, first + len(axis))
            chains.append(Wire(numbers, range(element_number, element_number + len(axis) - 1)))
            pairs.append(np.array([numbers[:-1], numbers[1:]]).T)
            first += len(axis)
            element_number += len(axis) - 1
        group = self._add_group(name, section, material, element, np.concatenate(pairs).astype(np.int64))
        group.wires = chains
        return group

    def mesh(
        self,
        mesh: Mesh,
        *,
        radius: float | Mapping[str, float] | None = None,
        material: Material | str | None = None,
        element: str = "B33",
        name: str = "WIRES",
    ) -> list[WireGroup]:
        """Add the elements and sets of a mesh that `litz.read_mesh` has read.

        Parameters
        ----------
        mesh : Mesh
            The mesh.
        radius : float or mapping of str to float, optional
            Radius of all wires [m], or of the wires of each element set. Left out: the sections of the file.
        material : Material or str, optional
            What they are made of; needed with `radius`.
        element : {"B33", "B31"}
            Type of the elements where the file does not say.
        name : str
            Name of the group of all elements where one radius is given.

        Returns
        -------
        list of WireGroup
            A group for each element set that has a section, or one for all.
        """
        sections: list[tuple[str, NDArray[np.int64], Section, Material | str]] = []
        if radius is None:
            if not mesh.sections:
                raise ValueError(f"{mesh.path} has no sections of round wires: radius and material are needed")
            for of_set, section, of_material in mesh.sections:
                if of_set not in mesh.element_sets:
                    raise ValueError(f"{mesh.path} has a section of {of_set}, but no elements of this set")
                sections.append((of_set, mesh.element_sets[of_set], section, of_material))
        elif material is None:
            raise ValueError("material is required with radius")
        elif isinstance(radius, Mapping):
            for of_set, value in radius.items():
                if of_set not in mesh.element_sets:
                    raise ValueError(unknown_name("element set", of_set, mesh.element_sets))
                sections.append((of_set, mesh.element_sets[of_set], Circular(value), material))
        else:
            sections.append((name, np.arange(len(mesh.connectivity)), Circular(radius), material))
        times = np.zeros(len(mesh.connectivity), dtype=int)
        for _, rows, _, _ in sections:
            times[rows] += 1
        if (times != 1).any():
            what = "several sections" if (times > 1).any() else "no section"
            raise ValueError(f"{int((times != 1).sum())} elements of {mesh.path} have {what}; each needs one")
        return self._add_mesh(mesh, sections, element)

    def _add_mesh(self, mesh: Mesh, sections: list, element: str) -> list[WireGroup]:
        nodes = np.array(self._add_nodes(mesh.x, None))
        kinds = np.where(mesh.kinds == "", element, mesh.kinds)
        number = np.zeros(len(mesh.connectivity), dtype=np.int64)
        groups = []
        for name, rows, section, material in sections:
            for kind in np.unique(kinds[rows]):
                of_kind = rows[kinds[rows] == kind]
                group_name = name if len(of_kind) == len(rows) else f"{name}_{kind}"
                group = self.elements(
                    group_name, nodes[mesh.connectivity[of_kind]], section=section, material=material, element=str(kind)
                )
                number[of_kind] = group.elements
                groups.append(group)
        for name, rows in mesh.element_sets.items():
            if name not in self.groups:
                self.element_set(name, number[rows].tolist())
        for name, rows in mesh.node_sets.items():
            taken = squeezed(name) in map(squeezed, [*self.groups, *self.node_sets, *self.element_sets])
            self.node_set(f"{name}_NODES" if taken else name, nodes[rows])
        return groups

    def _add_nodes(self, points: NDArray, name: str | None) -> range:
        numbers = range(len(self._points) + 1, len(self._points) + len(points) + 1)
        self._points.add(points)
        self.blocks.append((name, numbers[0], numbers[-1]))
        return numbers

    def _add_group(
        self, name: str, section: Section, material: Material, element: str, connectivity: NDArray
    ) -> WireGroup:
        group = WireGroup(name, section, material, element, self._n_elements + 1, connectivity, self._points)
        self._n_elements += len(connectivity)
        self._materials.setdefault(material.name, material)
        self.blocks.append(group)
        self.groups[name] = group
        return group

    def _properties(
        self, radius: float | None, section: Section | None, material: Material | str, element: str
    ) -> tuple[Section, Material]:
        if (radius is None) == (section is None):
            raise ValueError("a wire needs either a radius or a section")
        if radius is not None:
            section = Circular(radius)
        if not isinstance(section, Circular | General):
            raise ValueError(f"section must be Circular(radius) or General(area, i11, i22, j), not {section!r}")
        if squeezed(element) not in element_types():
            raise ValueError(f"TYPE of *ELEMENT must be {' or '.join(element_types())}, not {element!r}")
        if isinstance(material, str):
            if material not in self._materials:
                hint = nearest_name(material, self._materials)
                there = ", ".join(self._materials) or "none yet; give a Material, such as litz.COPPER"
                raise ValueError(f"there is no material {material!r}{hint}; there are: {there}")
            material = self._materials[material]
        if not isinstance(material, Material):
            raise ValueError(f"material must be a Material or the name of one, not {material!r}")
        if self._materials.get(material.name, material) != material:
            raise ValueError(f"there is another material of the name {material.name}")
        return section, material

    def material(
        self, name: str, *, young: float, poisson: float, conductivity: float | None = None, **properties: Any
    ) -> Material:
        """Define a material.

        Parameters
        ----------
        name : str
            Name in the deck.
        young : float
            Young's modulus [Pa].
        poisson : float
            Poisson's ratio [-].
        conductivity : float, optional
            Electrical conductivity [S/m]; without it the wires are insulators.
        **properties
            More of those of `Material`, such as `density`.
        """
        material = Material(name, young, poisson, conductivity, **properties)
        if self._materials.setdefault(name, material) != material:
            raise ValueError(f"there is another material of the name {name}")
        return material

    @property
    def materials(self) -> list[Material]:
        """The materials in the order of their first use."""
        return list(dict.fromkeys(group.material for group in self.groups.values()))

    @property
    def connectivity(self) -> NDArray[np.int64]:
        """Rows of `x` that each element joins, (m, 2)."""
        pairs = [group.connectivity - 1 for group in self.groups.values()]
        return np.concatenate(pairs) if pairs else np.empty((0, 2), dtype=np.int64)

    @property
    def radius(self) -> NDArray[np.float64]:
        """Radius of the wire at each element, (m) [m]."""
        groups = self.groups.values()
        return np.repeat([group.radius for group in groups], [len(group.connectivity) for group in groups])

    @property
    def wire_of_element(self) -> NDArray[np.int64]:
        """Number of the wire of each element, counted from 0 over all groups, (m)."""
        lengths = [len(wire.elements) for group in self.groups.values() for wire in group.wires]
        return np.repeat(np.arange(len(lengths)), lengths)
