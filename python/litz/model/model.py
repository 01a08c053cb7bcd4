"""A model of wires in contact, built in Python."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from numbers import Integral
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..deck import CardSpec
from ..keyword_table import check_card, check_name, keyword, squeezed
from ..run import run
from ..tables import nearest_name, unknown_name
from .curves import along_curve, along_polyline, along_spline, check_elements, check_points, straight
from .laws import ContactPair, Friction, Hertz, Interaction, Linear, _Spot
from .loading import Amplitude, Direction, Prescribed, Target, ranges_of
from .materials import Circular, General, Material, Section
from .steps import Step
from .wires import Nodes, Wire, WireGroup

if TYPE_CHECKING:
    from ..meshes import Mesh
    from ..results import Results
    from .steps import AnyNodes

#: Most groups and steps that the text of a model lists
_MOST_LISTED = 12


class Model:
    """Everything a deck says: wires, materials, contacts, supports and steps.

    Nodes and elements are numbered from 1 in the order in which they are added. Mistakes are told at once, as ValueError
    with what is allowed; the checks are those of the keyword table (`litz keywords`).

    Parameters
    ----------
    title : str
        Heading of the deck.
    comments : list of str
        Lines that stand as `**` comments at the head of the deck.
    units : "SI" or mapping
        Labels of the units that the numbers are in, by the parameters of `*UNITS`, such as
        `{"length": "mm", "force": "mN"}`. Labels only: nothing is converted.

    Attributes
    ----------
    groups : dict of str to WireGroup
        The wires.
    node_sets : dict of str to list
        Node numbers of each node set besides those of the groups.
    element_sets : dict of str to list
        Names of groups, and numbers of elements, of each element set.
    amplitudes : dict of str to Amplitude
        Factors over time.
    contacts : list of ContactPair
        What may touch what.
    supports : list of Prescribed
        Degrees of freedom that are zero from the start.
    guides : dict
        Share of the displacement of a pressing that each node or node set follows: 0 stays, 1 goes along (`press`).
    height : float, optional
        Displacement of a pressing that brings top and bottom to one level [m], which is more than any pressing can be
        meant to be; None where a model has no such limit.
    steps : list of Step
        The loading.

    Examples
    --------
    >>> import litz
    >>> model = litz.Model("two crossed wires")
    >>> copper = model.material("COPPER", young=120e9, poisson=0.34, conductivity=58.8e6)
    >>> lower = model.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), radius=1e-3, material=copper, elements=9)
    >>> upper = model.wire("UPPER", (0, -0.05, 2e-3), (0, 0.05, 2e-3), radius=1e-3, material=copper, elements=9)
    >>> pair = model.contact(lower, upper, conductance=litz.HertzSpot(), friction=0.3)
    >>> model.fix(lower.ends)
    >>> model.fix(upper.ends, "x", "y", "rotations")
    >>> step = model.step(increment=0.1)
    >>> step.move(upper.ends, "z", -1e-4)
    >>> step.potential(lower.start, 1e-3)
    >>> step.potential(upper.start, 0)
    >>> step.electrode_print(lower.start, upper.start)
    >>> model
    <Model 'two crossed wires': 20 nodes, 18 elements
      <wire LOWER: 9 B33 elements, radius 0.001, COPPER>
      <wire UPPER: 9 B33 elements, radius 0.001, COPPER>
      contact LOWER with UPPER: TOUCH
      <Step STEP1: 1 s, first increment 0.1 s; 3 prescribed; ELECTRODE PRINT>>
    >>> results = model.run("results/crossed")   # doctest: +SKIP
    """

    def __init__(self, title: str, comments: Iterable[str] = (), *, units: str | Mapping[str, str] = "SI"):
        self.title = title
        self.comments = list(comments)
        self.groups: dict[str, WireGroup] = {}
        self.node_sets: dict[str, list[int]] = {}
        self.element_sets: dict[str, list[str | int]] = {}
        self.amplitudes: dict[str, Amplitude] = {}
        self.contacts: list[ContactPair] = []
        self.supports: list[Prescribed] = []
        self.guides: dict[Target, float] = {}
        self.height: float | None = None
        self.steps: list[Step] = []
        self.cards: list[CardSpec] = []
        self._materials: dict[str, Material] = {}
        self._points: list[NDArray[np.float64]] = []
        #: Nodes (name or None, first, last) and groups in the order in which they were added
        self.blocks: list[tuple[str | None, int, int] | WireGroup] = []
        self._n_nodes = 0
        self._n_elements = 0
        self.units = _unit_labels(units)

    def __repr__(self) -> str:
        """One line."""
        lines = [f"<Model {self.title!r}: {self._n_nodes} nodes, {self._n_elements} elements"]
        lines += _shortened([repr(group) for group in self.groups.values()])
        for pair in self.contacts[:_MOST_LISTED]:
            among = f"contact {pair.first} with {pair.second}" if pair.second else f"contact among {pair.first}"
            lines.append(f"{among}: {pair.interaction.name}")
        lines += _shortened([repr(step) for step in self.steps])
        return "\n  ".join(lines) + ">"

    # Nodes and wires

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
        return Nodes(name or _span_name(numbers), numbers)

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
        if given.min() < 1 or given.max() > self._n_nodes:
            raise ValueError(f"there are nodes 1 to {self._n_nodes}; found {given.min()} to {given.max()}")
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
        >>> model = Model("a ring on a post")
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
            raise ValueError("a group needs one wire or more")
        self._claim(name)
        first = self._n_nodes + 1
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
                raise ValueError(f"{mesh.path} has no sections: radius and material are needed")
            for of_set, section, of_material in mesh.sections:
                if of_set not in mesh.element_sets:
                    raise ValueError(f"{mesh.path} has a section of {of_set}, but no elements of this set")
                sections.append((of_set, mesh.element_sets[of_set], section, of_material))
        elif material is None:
            raise ValueError("with radius, material is needed")
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
        numbers = range(self._n_nodes + 1, self._n_nodes + len(points) + 1)
        self._points.append(points)
        self._n_nodes += len(points)
        self.blocks.append((name, numbers[0], numbers[-1]))
        return numbers

    def _add_group(
        self, name: str, section: Section, material: Material, element: str, connectivity: NDArray
    ) -> WireGroup:
        group = WireGroup(name, section, material, element, self._n_elements + 1, connectivity, self)
        self._n_elements += len(connectivity)
        self._materials.setdefault(material.name, material)
        self.blocks.append(group)
        self.groups[name] = group
        return group

    def _properties(
        self, radius: float | None, section: Section | None, material: Material | str, element: str
    ) -> tuple[Section, Material]:
        if (radius is None) == (section is None):
            raise ValueError("a wire needs radius, or section: one of them")
        if radius is not None:
            section = Circular(radius)
        if not isinstance(section, Circular | General):
            raise ValueError(f"section must be Circular(radius) or General(area, i11, i22, j), not {section!r}")
        check_card("ELEMENT", {"TYPE": element}, [[1, 1, 2]])
        if isinstance(material, str):
            if material not in self._materials:
                hint = nearest_name(material, self._materials)
                there = ", ".join(self._materials) or "none"
                raise ValueError(f"there is no material {material!r}{hint}; there are: {there}")
            material = self._materials[material]
        if not isinstance(material, Material):
            raise ValueError(f"material must be a Material or the name of one, not {material!r}")
        if self._materials.get(material.name, material) != material:
            raise ValueError(f"there is another material of the name {material.name}")
        return section, material

    # Sets

    def _claim(self, name: str) -> None:
        """Refuse a name that a group or set has."""
        check_name(name)
        known = [*self.groups, *self.node_sets, *self.element_sets]
        if squeezed(name) in map(squeezed, known):
            raise ValueError(f"there is a group or set {name} already")

    def node_set(self, name: str, nodes: Any) -> Nodes:
        """Name nodes.

        Parameters
        ----------
        name : str
            Name of the set.
        nodes : int, Nodes, WireGroup, str, or a sequence of them
            Its members.
        """
        members = list(dict.fromkeys(self._members(nodes)))
        if not members:
            raise ValueError(f"the node set {name} has no members")
        self._claim(name)
        self.node_sets[name] = members
        return Nodes(name, members)

    def element_set(self, name: str, elements: Any) -> str:
        """Name elements: the groups, element sets and element numbers of a sequence. Returns the name."""
        items = [elements] if isinstance(elements, str | WireGroup | Integral) else list(elements)
        members: list[str | int] = []
        for item in items:
            if isinstance(item, Integral):
                if not 1 <= int(item) <= self._n_elements:
                    raise ValueError(f"there are elements 1 to {self._n_elements}, not {item}")
                members.append(int(item))
            else:
                members.append(self.element_set_of(item))
        if not members:
            raise ValueError(f"the element set {name} has no members")
        self._claim(name)
        self.element_sets[name] = members
        return name

    def _members(self, nodes: Any) -> Iterable[int]:
        if isinstance(nodes, str):
            return self.nodes_of(self._known_node_set(nodes))
        if isinstance(nodes, WireGroup):
            return nodes.nodes
        if isinstance(nodes, Integral):
            return [self._check_node(int(nodes))]
        if isinstance(nodes, np.ndarray):
            nodes = nodes.ravel().tolist()
        return [member for one in nodes for member in self._members(one)]

    def _check_node(self, node: int) -> int:
        if isinstance(node, bool) or not 1 <= node <= self._n_nodes:
            raise ValueError(f"there are nodes 1 to {self._n_nodes}, not {node}")
        return int(node)

    def _known_node_set(self, name: str) -> str:
        known = [*self.groups, *self.node_sets]
        for one in known:
            if squeezed(one) == squeezed(name):
                return one
        there = ", ".join(known[:40]) or "none"
        raise ValueError(f"there is no node set {name!r}{nearest_name(name, known)}; there are: {there}")

    def target(self, nodes: AnyNodes) -> Target:
        """What stands for nodes on a data line: a number, or the name of a node set, which is made if need be."""
        if isinstance(nodes, Integral):
            return self._check_node(int(nodes))
        if not isinstance(nodes, str | WireGroup | Nodes):
            members = list(dict.fromkeys(self._members(nodes)))
            if len(members) == 1:
                return members[0]
            nodes = Nodes(_span_name(members), members)
        return self.node_set_of(nodes)

    def node_set_of(self, nodes: AnyNodes) -> str:
        """Name of the node set of some nodes, which is made if need be."""
        if isinstance(nodes, str):
            return self._known_node_set(nodes)
        if isinstance(nodes, WireGroup):
            return self._own(nodes).name
        if not isinstance(nodes, Nodes):
            members = list(dict.fromkeys(self._members(nodes)))
            nodes = Nodes(_span_name(members), members)
        if not nodes:
            raise ValueError(f"{nodes!r} is empty")
        for node in nodes:
            self._check_node(node)
        if nodes.name in self.groups or nodes.name in self.node_sets:
            if set(self.nodes_of(nodes.name)) != set(nodes):
                raise ValueError(f"there is another node set {nodes.name}, with other members")
            return nodes.name
        return self.node_set(nodes.name, nodes).name

    def element_set_of(self, elements: str | WireGroup) -> str:
        """Name of an element set or group."""
        if isinstance(elements, WireGroup):
            return self._own(elements).name
        known = [*self.groups, *self.element_sets]
        for one in known:
            if isinstance(elements, str) and squeezed(one) == squeezed(elements):
                return one
        there = ", ".join(known[:40]) or "none"
        raise ValueError(f"there is no element set {elements!r}{nearest_name(elements, known)}; there are: {there}")

    def _own(self, group: WireGroup) -> WireGroup:
        if self.groups.get(group.name) is not group:
            raise ValueError(f"{group!r} belongs to another model")
        return group

    # Materials, contacts, supports, amplitudes, steps

    def material(self, name: str, *, young: float, poisson: float, conductivity: float | None = None) -> Material:
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
        """
        material = Material(name, young, poisson, conductivity)
        if self._materials.setdefault(name, material) != material:
            raise ValueError(f"there is another material of the name {name}")
        return material

    def contact(
        self,
        first: WireGroup | str | Sequence[WireGroup | str],
        second: WireGroup | str | Sequence[WireGroup | str] | None = None,
        *,
        behaviour: Hertz | Linear | None = None,
        conductance: _Spot | None = None,
        friction: Friction | float | None = None,
        axis: str = "HERMITE",
        name: str | None = None,
        interaction: Interaction | None = None,
        interference_fit: bool = False,
    ) -> ContactPair:
        """Let wires touch: those of `first` and those of `second`, or those of `first` among each other.

        Parameters
        ----------
        first, second : WireGroup, str, or sequence of them
            Groups or element sets; of several an element set is made.
        behaviour : Hertz or Linear, optional
            Contact force over penetration; Hertz when left out.
        conductance : HertzSpot, PaperSpot, PlasticSpot, FilmSpot, ConstantSpot or TableSpot, optional
            Resistance of the spots; without it no current crosses.
        friction : Friction or float, optional
            Friction, or its coefficient [-]; without it the wires slide freely.
        axis : {"HERMITE", "LINEAR"}
            Interpolation of the axes that touch.
        name : str, optional
            Name of the interaction.
        interaction : Interaction, optional
            All the laws at once, in place of the arguments above.
        interference_fit : bool
            Wires that overlap at the start are meant to.
        """
        laws = {"behaviour": behaviour, "conductance": conductance, "friction": friction}
        given = [law for law, value in laws.items() if value is not None]
        if interaction is not None and (given or name is not None):
            raise ValueError(f"contact takes interaction, or {' and '.join(given or ['name'])}, not both")
        if interaction is None:
            behaviour = Hertz() if behaviour is None else behaviour
            interaction = self._named(Interaction("TOUCH", behaviour, conductance, friction, axis), name)
        elif any(known.name == interaction.name and known != interaction for known in self.interactions):
            raise ValueError(f"there is another interaction of the name {interaction.name}")
        sets = [self._joined(elements) for elements in (first, second) if elements is not None]
        if any({known.first, known.second or known.first} == set(sets) for known in self.contacts):
            raise ValueError(f"there is a contact of {' with '.join(sets)} already")
        pair = ContactPair(interaction, sets[0], sets[1] if len(sets) > 1 else None, interference_fit)
        self.contacts.append(pair)
        return pair

    def _named(self, laws: Interaction, name: str | None) -> Interaction:
        """The laws under a name that no other laws have; equal laws share one."""
        known = {one.name: one for one in self.interactions}

        def of_name(word: str) -> Interaction:
            return Interaction(word, laws.behaviour, laws.conductance, laws.friction, laws.axis)

        if name is not None:
            if known.get(name, of_name(name)) != of_name(name):
                raise ValueError(f"there is another interaction of the name {name}")
            return of_name(name)
        words = ["TOUCH", *(f"TOUCH{number}" for number in range(2, len(known) + 3))]
        return next(of_name(word) for word in words if known.get(word, of_name(word)) == of_name(word))

    def _joined(self, elements: WireGroup | str | Sequence[WireGroup | str]) -> str:
        """One element set for groups and sets."""
        if isinstance(elements, str | WireGroup):
            return self.element_set_of(elements)
        names = [self.element_set_of(one) for one in elements]
        if len(names) == 1:
            return names[0]
        for known, members in self.element_sets.items():
            if members == names:
                return known
        name = "_".join(names) if len(names) <= 3 else f"{names[0]}_TO_{names[-1]}"
        return self.element_set(name, names)

    def fix(self, nodes: AnyNodes, *directions: Direction) -> None:
        """Hold degrees of freedom at zero from the start, before the first step.

        Parameters
        ----------
        nodes : int, str, Nodes, WireGroup or sequence
            Where.
        *directions : str or int
            "x", "y", "z", "rx", "ry", "rz", "potential" or their numbers 1-6, 9; "pinned" (1-3), "rotations" (4-6),
            "encastre" (1-6), which is meant without any.
        """
        target = self.target(nodes)
        self.supports += [Prescribed(target, first, last) for first, last in ranges_of(directions)]

    def amplitude(self, name: str, t: Sequence[float], a: Sequence[float], time: str = "STEP TIME") -> Amplitude:
        """Define a factor `a` [-] over the times `t` [s] of the step, or with `time="TOTAL TIME"` of all steps."""
        if name in self.amplitudes:
            raise ValueError(f"there is an amplitude {name} already")
        amplitude = Amplitude(name, tuple(t), tuple(a), time)
        self.amplitudes[name] = amplitude
        return amplitude

    def step(self, name: str | None = None, **options: Any) -> Step:
        """Add a step.

        Parameters
        ----------
        name : str, optional
            Name of the step.
        total : float
            Time of the step [s]; 1 when left out.
        increment : float
            First and largest increment [s]; the whole step when left out.
        first, smallest, largest : float
            The increments one by one [s], in place of `increment` where they are given.
        inc : int
            Most increments; 100, or ten times as many as the largest increment needs.
        direct : bool
            Increments of the fixed size `first`.
        boundary_op, cload_op, cecurrent_op : {"MOD", "NEW"}
            NEW removes what earlier steps have prescribed or loaded.
        """
        name = f"STEP{len(self.steps) + 1}" if name is None else name
        if any(squeezed(step.name) == squeezed(name) for step in self.steps):
            raise ValueError(f"there is a step {name} already")
        allowed = list(Step.__init__.__kwdefaults__ or ())
        unknown = set(options) - set(allowed)
        if unknown:
            word = sorted(unknown)[0]
            raise ValueError(f"a step has no {word}{nearest_name(word, allowed)}; there are: {', '.join(allowed)}")
        step = Step(self, name, **options)
        self.steps.append(step)
        return step

    def press(self, displacement: float, *, voltage: float | None = None, name: str = "PRESS", **options: Any) -> Step:
        """Add a step that moves the guided nodes of a generated model down, along -z.

        Parameters
        ----------
        displacement : float
            How far the nodes of share 1 are below their first place at the end of the step [m]; at most `height`.
        voltage : float, optional
            Between the node sets PLUS and MINUS, with MINUS at 0 V [V]; None: the step prescribes no potential.
        name : str
            Name of the step.
        **options
            As those of `step`; `increment` is a tenth of the step when left out.

        Notes
        -----
        Where wires rub or snap, damping helps a run to its end: `model.press(...).controls("STABILIZE")`; the summary of
        the run says how much energy that took.
        """
        if not self.guides:
            raise ValueError("this model has no guides that a pressing could move; give them by model.guides")
        if self.height is not None and 0 < self.height < displacement:
            raise ValueError(
                f"pressed by {displacement:g} m, this model of {self.height:g} m height would be turned upside down: "
                "press by less than its height"
            )
        options.setdefault("increment", 0.1 * options.get("total", 1.0))
        step = self.step(name, **options)
        for target, share in self.guides.items():
            step.move(target, "z", -displacement * share)
        if voltage is not None:
            step.potential("PLUS", voltage)
            step.potential("MINUS", 0.0)
            step.electrode_print("PLUS", "MINUS")
        return step

    def card(self, name: str, parameters: dict[str, Any] | None = None, rows: list | None = None) -> None:
        """Add any card that the table of keywords has in the model part; it stands before the first step."""
        spec = (name.removeprefix("*").upper(), parameters or {}, rows or [])
        if keyword(name)["place"] in ("step", "begins step"):
            raise ValueError(f"*{spec[0]} stands in a step: Step.card adds it")
        check_card(*spec)
        self.cards.append(spec)

    # What is there

    @property
    def materials(self) -> list[Material]:
        """The materials in the order of their first use."""
        return list(dict.fromkeys(group.material for group in self.groups.values()))

    @property
    def interactions(self) -> list[Interaction]:
        """The interactions in the order of their first use."""
        return list(dict.fromkeys(pair.interaction for pair in self.contacts))

    @property
    def x(self) -> NDArray[np.float64]:
        """Positions of the nodes, (n, 3) [m]; node i is in row i - 1."""
        if len(self._points) > 1:
            self._points = [np.concatenate(self._points)]
        return self._points[0] if self._points else np.empty((0, 3))

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

    def nodes_of(self, target: Target) -> list[int]:
        """Node numbers of a node, a group or a node set."""
        if isinstance(target, int):
            return [target]
        return list(self.groups[target].nodes) if target in self.groups else self.node_sets[target]

    # Writing and running

    def to_deck(self) -> str:
        """The deck as text."""
        from .writer import deck_text

        return deck_text(self)

    def write(self, path: str | PathLike, *, mesh_file: bool = False) -> Path:
        """Write the deck; numbers are the shortest decimals that read back exactly.

        Parameters
        ----------
        path : path
            Where to; files that are there are replaced, directories that are missing are made.
        mesh_file : bool
            Nodes, elements and sets go into an HDF5 file of the same name with the ending `.h5` beside the deck, which
            litz reads faster than text.
        """
        from .mesh_file import write_mesh_file
        from .writer import deck_text

        path = Path(path)
        mesh = path.with_suffix(".h5")
        text = deck_text(self, mesh.name if mesh_file else None)
        path.parent.mkdir(parents=True, exist_ok=True)
        if mesh_file:
            write_mesh_file(self, mesh)
        path.write_text(text, encoding="utf-8")
        return path

    def run(self, output_directory: str | PathLike, **options: Any) -> Results:
        """Write the deck into a directory and run it there; both have the directory's name.

        Parameters
        ----------
        output_directory : path
            Where the deck and the results go; made when it is not there.
        **options
            As those of `litz.run`: `solver`, `threads`, `restart`, `quiet`, `progress`.
        """
        if not self.steps:
            raise ValueError("the model has no step: model.step() adds one")
        directory = Path(output_directory)
        deck = self.write(directory / f"{directory.resolve().name}.inp")
        return run(deck, output_directory=directory, **options)


def _unit_labels(units: str | Mapping[str, str]) -> dict[str, str]:
    """Parameters of *UNITS; none for SI."""
    if isinstance(units, str):
        if units.upper() != "SI":
            raise ValueError(f'units must be "SI" or labels such as {{"length": "mm", "force": "mN"}}, not {units!r}')
        return {}
    labels = {name.upper(): label for name, label in units.items()}
    check_card("UNITS", labels)
    return labels


def _span_name(members: Sequence[int]) -> str:
    """Name of a set of nodes that has none."""
    if not members:
        raise ValueError("no nodes are given")
    return f"NODES_{members[0]}_TO_{members[-1]}_{len(members)}"


def _shortened(lines: list[str]) -> list[str]:
    if len(lines) <= _MOST_LISTED:
        return lines
    return [*lines[:_MOST_LISTED], f"... {len(lines) - _MOST_LISTED} more"]
