"""A model of wires in contact: nodes, wires, sets, materials, contact pairs, supports and steps."""

from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: A node number or the name of a node set
Target = int | str


@dataclass(frozen=True)
class Material:
    """A linear elastic material, a conductor where it has a conductivity.

    Attributes
    ----------
    name : str
        Name in the deck.
    young : float
        Young's modulus [Pa].
    poisson : float
        Poisson's ratio [-].
    conductivity : float, optional
        Electrical conductivity [S/m]; None for an insulator.
    """

    name: str
    young: float
    poisson: float
    conductivity: float | None = None


#: Pure copper at room temperature
COPPER = Material("COPPER", young=120e9, poisson=0.34, conductivity=58.8e6)
#: Pure silver at room temperature
SILVER = Material("SILVER", young=83e9, poisson=0.37, conductivity=63e6)


@dataclass(frozen=True)
class Interaction:
    """The laws of a contact, as `*SURFACE INTERACTION` has them.

    Attributes
    ----------
    name : str
        Name in the deck.
    penalty : float, optional
        Contact force per penetration [N/m]; None for the elastic approach of Hertz.
    spot_law : str, optional
        `LAW` of `*GAP ELECTRICAL CONDUCTANCE`; None where no current crosses.
    spot_data : tuple of tuples
        Data lines of the law, for example `((R_c,),)` of `CONSTANT`.
    """

    name: str = "TOUCH"
    penalty: float | None = None
    spot_law: str | None = "HERTZ"
    spot_data: tuple[tuple[float, ...], ...] = ()


@dataclass(frozen=True)
class ContactPair:
    """Two element sets that may touch.

    Attributes
    ----------
    interaction : Interaction
        The laws of the contact.
    first, second : str
        Names of groups or element sets; `second` is None for contact within the first.
    interference_fit : bool
        Wires that overlap at the start are meant to.
    """

    interaction: Interaction
    first: str
    second: str | None = None
    interference_fit: bool = False


@dataclass(frozen=True)
class Wire:
    """A chain of elements.

    Attributes
    ----------
    nodes : range
        Numbers of its nodes from one end to the other.
    elements : range
        Numbers of its elements in the same order.
    """

    nodes: range
    elements: range

    @property
    def ends(self) -> tuple[int, int]:
        """Numbers of the first and the last node."""
        return self.nodes[0], self.nodes[-1]


@dataclass
class WireGroup:
    """Wires of one radius, material and element type; its name is that of a node set and of an element set.

    Attributes
    ----------
    name : str
        Name in the deck.
    radius : float
        Radius of the wires [m].
    material : Material
        What they are made of.
    element : str
        `"B33"` or `"B31"`.
    wires : list of Wire
        The chains.
    """

    name: str
    radius: float
    material: Material
    element: str
    wires: list[Wire] = field(default_factory=list)

    @property
    def nodes(self) -> list[int]:
        """Numbers of all nodes."""
        return [node for wire in self.wires for node in wire.nodes]

    @property
    def ends(self) -> list[int]:
        """Numbers of the end nodes of all wires."""
        return [node for wire in self.wires for node in wire.ends]


@dataclass(frozen=True)
class Prescribed:
    """A line of `*BOUNDARY`: `value` [m, rad, V] for the degrees of freedom `first` to `last` of a node or node set."""

    target: Target
    first: int
    last: int
    value: float = 0.0


@dataclass(frozen=True)
class Load:
    """A line of `*CLOAD` (`dof` 1-6) [N, N m] or `*CECURRENT` (`dof` 9) [A]."""

    target: Target
    dof: int
    value: float


@dataclass
class Step:
    """A load step; what it prescribes ramps linearly from its start to its end.

    Attributes
    ----------
    name : str
        Name in the deck.
    increments : tuple of float
        First increment, time of the step, smallest and largest increment [s].
    most_increments : int
        `INC` of `*STEP`.
    boundary : list of Prescribed
        Prescribed displacements, rotations and potentials.
    loads : list of Load
        Forces, moments and currents.
    node_totals : list of (str, str)
        Node set and a quantity of `*NODE PRINT`, whose sum over the set goes into the history file.
    electrodes : list of (str, str)
        Node sets between which voltage, current and resistance go into the history file.
    frequency : int
        Fields of every n-th increment go into the result file.
    """

    name: str
    increments: tuple[float, float, float, float] = (0.1, 1.0, 1e-5, 0.1)
    most_increments: int = 100
    boundary: list[Prescribed] = field(default_factory=list)
    loads: list[Load] = field(default_factory=list)
    node_totals: list[tuple[str, str]] = field(default_factory=list)
    electrodes: list[tuple[str, str]] = field(default_factory=list)
    frequency: int = 1


class Model:
    """Everything a deck says.

    Wires come in groups; numbers of nodes and elements start with 1 and go along the wires in the order of `add_wires`.

    Parameters
    ----------
    title : str
        First line of the heading.
    comments : list of str
        Lines that stand as `**` comments at the head of the deck.

    Attributes
    ----------
    groups : dict of str to WireGroup
        The wires.
    node_sets : dict of str to list
        Node numbers of each node set besides those of the groups.
    element_sets : dict of str to list of str
        Names of the groups that each element set joins.
    contacts : list of ContactPair
        What may touch what.
    supports : list of Prescribed
        Degrees of freedom that are zero from the start.
    guides : dict
        Share of the displacement of a pressing that each node or node set follows: 0 stays, 1 goes along (`press`).
    steps : list of Step
        The loading.

    Examples
    --------
    >>> model = Model("Two crossed wires")
    >>> lower = model.add_wires("LOWER", [straight((-0.05, 0, 0), (0.05, 0, 0), 9)], radius=1e-3, material=COPPER)
    >>> upper = model.add_wires("UPPER", [straight((0, -0.05, 2e-3), (0, 0.05, 2e-3), 9)], radius=1e-3, material=COPPER)
    >>> model.contacts.append(ContactPair(Interaction(), "LOWER", "UPPER"))
    >>> model.write("crossed.inp")
    """

    def __init__(self, title: str, comments: list[str] | None = None):
        self.title = title
        self.comments = list(comments or [])
        self.groups: dict[str, WireGroup] = {}
        self.node_sets: dict[str, list[int]] = {}
        self.element_sets: dict[str, list[str]] = {}
        self.contacts: list[ContactPair] = []
        self.supports: list[Prescribed] = []
        self.guides: dict[Target, float] = {}
        self.steps: list[Step] = []
        self._points: list[NDArray[np.float64]] = []
        self._n_nodes = 0
        self._n_elements = 0

    def add_wires(
        self, name: str, axes: list[ArrayLike], *, radius: float, material: Material, element: str = "B33"
    ) -> WireGroup:
        """Add a group of wires.

        Parameters
        ----------
        name : str
            Name of the group; not that of another group or set.
        axes : list of (n, 3) arrays
            Positions of the nodes along each wire [m], n > 1.
        radius : float
            Radius of the wires [m].
        material : Material
            What they are made of.
        element : {"B33", "B31"}
            Type of the elements.
        """
        if name.upper() in {known.upper() for known in (*self.groups, *self.node_sets, *self.element_sets)}:
            raise ValueError(f"there is a group or set {name} already")
        if element not in ("B31", "B33"):
            raise ValueError(f'element must be "B31" or "B33", not {element!r}')
        if not radius > 0:
            raise ValueError(f"radius must be greater than 0, not {radius:g}")
        if any(known.name == material.name and known != material for known in self.materials):
            raise ValueError(f"there is another material of the name {material.name}")
        points = [np.array(axis, dtype=float) for axis in axes]
        for axis in points:
            if axis.ndim != 2 or axis.shape[1] != 3 or len(axis) < 2 or not np.isfinite(axis).all():
                raise ValueError(
                    f"an axis must hold the positions of 2 or more nodes, not an array of shape {axis.shape}"
                )
            if not np.linalg.norm(np.diff(axis, axis=0), axis=1).all():
                raise ValueError("two successive nodes of an axis coincide")
        group = WireGroup(name, float(radius), material, element)
        for axis in points:
            group.wires.append(
                Wire(
                    range(self._n_nodes + 1, self._n_nodes + len(axis) + 1),
                    range(self._n_elements + 1, self._n_elements + len(axis)),
                )
            )
            self._n_nodes += len(axis)
            self._n_elements += len(axis) - 1
        self._points += points
        self.groups[name] = group
        return group

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
        return np.concatenate(self._points) if self._points else np.empty((0, 3))

    @property
    def connectivity(self) -> NDArray[np.int64]:
        """Rows of `x` that each element joins, (m, 2)."""
        pairs = [(node - 1, node) for group in self.groups.values() for wire in group.wires for node in wire.nodes[:-1]]
        return np.array(pairs, dtype=np.int64).reshape(-1, 2)

    @property
    def radius(self) -> NDArray[np.float64]:
        """Radius of the wire at each element, (m) [m]."""
        return np.array([group.radius for group in self.groups.values() for wire in group.wires for _ in wire.elements])

    @property
    def wire_of_element(self) -> NDArray[np.int64]:
        """Number of the wire of each element, counted from 0 over all groups, (m)."""
        lengths = [len(wire.elements) for group in self.groups.values() for wire in group.wires]
        return np.repeat(np.arange(len(lengths)), lengths)

    def nodes_of(self, target: Target) -> list[int]:
        """Node numbers of a node, a group or a node set."""
        if isinstance(target, int):
            return [target]
        return self.groups[target].nodes if target in self.groups else self.node_sets[target]

    def press(
        self,
        displacement: float,
        *,
        voltage: float | None = None,
        name: str = "PRESS",
        increments: tuple[float, float, float, float] = (0.1, 1.0, 1e-5, 0.1),
        most_increments: int = 100,
    ) -> Step:
        """Add a step that moves the guided nodes down, along -z.

        Parameters
        ----------
        displacement : float
            How far the nodes of share 1 are below their first place at the end of the step [m].
        voltage : float, optional
            Between the node sets PLUS and MINUS, with MINUS at 0 V [V]; None: the step prescribes no potential.
        name : str
            Name of the step.
        increments : tuple of float
            First increment, time of the step, smallest and largest increment [s].
        most_increments : int
            Most increments of the step.

        Returns
        -------
        Step
            The step, to which more may be added.
        """
        step = Step(name, increments, most_increments)
        step.boundary += [Prescribed(target, 3, 3, -displacement * share) for target, share in self.guides.items()]
        if voltage is not None:
            step.boundary += [Prescribed("PLUS", 9, 9, voltage), Prescribed("MINUS", 9, 9)]
            step.electrodes.append(("PLUS", "MINUS"))
        self.steps.append(step)
        return step

    def to_deck(self) -> str:
        """The deck as text."""
        from .deck import deck_text

        return deck_text(self)

    def write(self, path: str | PathLike, *, mesh_file: bool = False) -> Path:
        """Write the deck; numbers are the shortest decimals that read back exactly.

        Parameters
        ----------
        path : path
            Where to; files that are there are replaced.
        mesh_file : bool
            Nodes, elements and sets go into an HDF5 file of the same name with the ending `.h5` beside the deck, which
            litz reads faster than text.
        """
        from .deck import deck_text
        from .mesh_file import write_mesh_file

        path = Path(path)
        mesh = path.with_suffix(".h5")
        if mesh_file:
            write_mesh_file(self, mesh)
        path.write_text(deck_text(self, mesh.name if mesh_file else None), encoding="utf-8")
        return path
