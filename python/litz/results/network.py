"""The contact network of a run: wires as nodes, contacts as edges, for numpy and for network tools."""

import csv
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..base.packages import optional
from ..base.quantities import attribute, in_brackets
from ..base.table import Table
from .contact_places import ContactPlaces, contact_places
from .contact_zones import contact_zones, stretch_along
from .graphml import write_graphml
from .ledger import rows_of
from .result_file import ResultFile
from .scalars import known_potential

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd


#: Columns of the ledger that an edge carries, and the unit of each by its symbol in SI
_OF_CONTACT = {
    "force": "N",
    "gap": "m",
    "angle": "rad",
    "resistance": "ohm",
    "current": "A",
    "voltage_gap": "V",
    "joule_heat": "W",
}


@dataclass(frozen=True, repr=False)
class ContactNetwork:
    """Wires and the closed contacts between them at one increment: crossings, and zones of contact along lines.

    Attributes
    ----------
    first_element : (n,) array of int
        Number in the deck of the first element of each wire, which names it.
    wire_length : (n,) array
        Length of each wire before deformation [m].
    wire_potential : (n,) array
        Mean potential of the nodes of each wire, NaN without a conducting path to a prescribed one [V].
    wire_current : (n,) array
        Largest current along each wire [A], positive from its first to its last node.
    wires : (k, 2) array of int
        The wires that each contact joins, counted from 0: of a crossing the barred one first, of a zone in ascending order.
        A zone of line contact (`Results.contact_zones`) is one contact.
    id : (k,) array of int
        Number of each contact in the ledger; of a zone the lowest one in it.
    arc : (k, 2) array
        Where it is along the two wires, before deformation; the middle of a zone [m].
    point : (k, 3) array
        Its place, halfway between the axes; of a zone that in its middle [m].
    length : (k,) array
        Length of a zone, 0 where wires cross [m].
    force, gap, angle, resistance, current, voltage_gap, joule_heat : (k,) arrays
        As in the contact ledger [N, m, rad, ohm, A, V, W]; the resistance is infinite where no current can pass. A zone has
        sums, its places in parallel, the smallest gap, the mean angle, and the voltage that drives its current through
        its resistance.
    wires_at : dict of (m,) array of int
        The wires that have a node in each node set: `wires_at["PLUS"]` are those at this electrode.
    units : dict of str
        What the units are called, as `Results.unit_labels`.

    Notes
    -----
    `np.bincount(network.wires.ravel(), minlength=len(network.wire_length))` is the number of contacts of each wire.
    """

    first_element: np.ndarray
    wire_length: np.ndarray
    wire_potential: np.ndarray
    wire_current: np.ndarray
    wires: np.ndarray
    id: np.ndarray
    arc: np.ndarray
    point: np.ndarray
    length: np.ndarray
    force: np.ndarray
    gap: np.ndarray
    angle: np.ndarray
    resistance: np.ndarray
    current: np.ndarray
    voltage_gap: np.ndarray
    joule_heat: np.ndarray
    wires_at: dict[str, np.ndarray]
    units: dict[str, str]

    def __repr__(self) -> str:
        """Sizes."""
        return f"<ContactNetwork: {len(self.wire_length)} wires, {len(self.id)} contacts>"

    def _units_of_contact(self) -> dict[str, str]:
        return {name: self.units.get(unit, unit) for name, unit in _OF_CONTACT.items()}

    def _named(self, name: str, unit: str) -> str:
        """Name of a GraphML attribute, with its unit: "length", "m" -> "length_m"."""
        return attribute(name, self.units.get(unit, unit))

    def table(self) -> Table:
        """The contacts as a table, a row for each; wires are counted from 0, as in `wires`."""
        places = {"arc_1": self.arc[:, 0], "arc_2": self.arc[:, 1]}
        places |= {axis: self.point[:, i] for i, axis in enumerate("xyz")} | {"length": self.length}
        columns = {"id": self.id, "wire_1": self.wires[:, 0], "wire_2": self.wires[:, 1], **places}
        columns |= {name: getattr(self, name) for name in _OF_CONTACT}
        units = {
            "id": "",
            "wire_1": "",
            "wire_2": "",
            **dict.fromkeys(places, self.units["m"]),
            **self._units_of_contact(),
        }
        return Table(columns, units)

    def to_pandas(self) -> "pd.DataFrame":
        """The contacts as a data frame of pandas, a row for each; `table` without pandas."""
        return self.table().to_pandas()

    def to_networkx(self) -> "nx.MultiGraph":
        """The network as a graph of NetworkX, which it needs.

        Wires are nodes, by their numbers from 0, with `first_element`, `length`, `potential`, `current` and `node_sets`,
        the names of the node sets they reach; contacts are edges, with their ids as keys and their columns in `table`.

        Examples
        --------
        Whether the wires lead from one electrode to the other:

        >>> import networkx as nx                                                       # doctest: +SKIP
        >>> graph = network.to_networkx()                                               # doctest: +SKIP
        >>> plus, minus = set(network.wires_at["PLUS"]), set(network.wires_at["MINUS"])     # doctest: +SKIP
        >>> any(plus & part and minus & part for part in nx.connected_components(graph))    # doctest: +SKIP
        True
        """
        graph = optional("networkx").MultiGraph()
        sets_of: list[list[str]] = [[] for _ in self.wire_length]
        for name, wires in self.wires_at.items():
            for wire in wires:
                sets_of[wire].append(name)
        of_wire = zip(self.first_element, self.wire_length, self.wire_potential, self.wire_current, strict=True)
        for wire, (element, *values) in enumerate(of_wire):
            length, potential, current = map(float, values)
            graph.add_node(
                wire,
                first_element=int(element),
                length=length,
                potential=potential,
                current=current,
                node_sets=sets_of[wire],
            )
        columns = self.table()
        for row, (contact, (first, second)) in enumerate(zip(self.id, self.wires, strict=True)):
            of_contact = {name: float(columns[name][row]) for name in list(columns)[3:]}
            graph.add_edge(int(first), int(second), key=int(contact), **of_contact)
        return graph

    def to_csv(self, path: str | PathLike) -> Path:
        """Write the contacts as a table, a row for each: an edge list with the wires counted from 1."""
        path = Path(path)
        with path.open("w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            names = [f"{name}{in_brackets(unit)}" for name, unit in self._units_of_contact().items()]
            places = [f"{name}{in_brackets(self.units['m'])}" for name in ("arc_1", "arc_2", "x", "y", "z", "length")]
            table.writerow(["id", "wire_1", "wire_2", *places, *names])
            numbers = np.column_stack(
                [self.arc, self.point, self.length, *(getattr(self, name) for name in _OF_CONTACT)]
            )
            for contact, pair, row in zip(self.id, self.wires + 1, numbers, strict=True):
                table.writerow([contact, *pair, *(repr(float(value)) for value in row)])
        return path

    def to_graphml(self, path: str | PathLike) -> Path:
        """Write a GraphML file, which NetworkX, igraph, Gephi and others read; names hold the units.

        Several contacts of the same two wires are parallel edges.
        """
        of_wire = {
            "first_element": self.first_element,
            self._named("length", "m"): self.wire_length,
            self._named("potential", "V"): self.wire_potential,
            self._named("current", "A"): self.wire_current,
        }
        of_contact = {
            self._named("arc_1", "m"): self.arc[:, 0],
            self._named("arc_2", "m"): self.arc[:, 1],
            **{self._named(axis, "m"): self.point[:, i] for i, axis in enumerate("xyz")},
            self._named("length", "m"): self.length,
            **{self._named(name, unit): getattr(self, name) for name, unit in _OF_CONTACT.items()},
        }
        names = [f"wire{wire + 1}" for wire in range(len(self.wire_length))]
        edges = [f"contact{contact}" for contact in self.id]
        return write_graphml(path, "contacts", names, of_wire, self.wires, of_contact, edges)


def contact_network(results: ResultFile, increment: int, *, every_place: bool = False) -> ContactNetwork:
    """The network of a run at an increment; `every_place`: each place of a line contact is a contact of its own."""
    wires = results.wires
    ledger = results.contacts_at(increment)
    carries = (ledger["force"] > 0) | np.isfinite(ledger["resistance"])
    places = contact_places(results, ledger.where(carries))
    if every_place:
        places = replace(places, zone=np.full_like(places.zone, -1))
    # zones come after the crossings, which keep the order of the ledger
    alone, zones = places.zone < 0, contact_zones(places, results.unit_labels)
    edge = np.where(alone, np.cumsum(alone) - 1, alone.sum() + places.zone)
    is_zone = np.arange(alone.sum() + zones.n_rows) >= alone.sum()
    of_edges = _edges(places, edge, is_zone)
    of_edges["length"][is_zone] = zones["length"]
    potential = known_potential(results, increment)
    return ContactNetwork(
        first_element=np.array([results.element_ids[wire.elements[0]] for wire in wires]),
        wire_length=results.wire_arcs.wire_length,
        wire_potential=np.array([_mean_of_known(potential[wire.nodes]) for wire in wires]),
        wire_current=wire_currents(results, increment),
        wires_at=_wires_at(results, wires),
        units=results.unit_labels,
        **of_edges,
    )


def _mean_of_known(values: np.ndarray) -> float:
    known = values[np.isfinite(values)]
    return float(known.mean()) if known.size else np.nan


def _edges(places: ContactPlaces, edge: np.ndarray, is_zone: np.ndarray) -> dict[str, np.ndarray]:
    """Columns of the contacts, given the contact that each row of the ledger is in (k), and which contacts are zones (n)."""
    ledger, n = places.ledger, len(is_zone)
    in_zone = is_zone[edge]
    # the middle one of the rows of each contact stands for its place
    along = places.arc[:, 0].copy()
    along[in_zone] = stretch_along(places.where(in_zone), 0).arc
    order = np.lexsort((along, edge))
    first, last = (np.searchsorted(edge[order], np.arange(n), side) for side in ("left", "right"))
    middle = order[(first + last) // 2]
    barred_first = np.where((places.flipped[middle] & ~is_zone)[:, None], [1, 0], [0, 1])
    point = np.stack([(ledger[f"point_1_{axis}"] + ledger[f"point_2_{axis}"]) / 2 for axis in "xyz"], axis=1)

    current = np.where(places.flipped & in_zone, -ledger["current"], ledger["current"])
    total = {"force": ledger["force"], "current": current, "joule_heat": ledger["joule_heat"]}
    total = {name: np.bincount(edge, values, n) for name, values in total.items()}
    conductance = np.bincount(edge, 1 / ledger["resistance"], n)
    resistance = np.divide(1.0, conductance, out=np.full(n, np.inf), where=conductance > 0)
    driving = np.divide(total["current"], conductance, out=np.zeros(n), where=conductance > 0)
    columns = {name: ledger[name][middle] for name in ("gap", "voltage_gap")}
    np.minimum.at(columns["gap"], edge, ledger["gap"])
    ids = ledger["id"][middle]
    np.minimum.at(ids, edge, ledger["id"])
    return {
        "id": ids,
        "wires": np.take_along_axis(places.wires[middle], barred_first, axis=1),
        "arc": np.take_along_axis(places.arc[middle], barred_first, axis=1),
        "point": point[middle],
        "length": np.zeros(n),
        **total,
        "gap": columns["gap"],
        "angle": np.bincount(edge, ledger["angle"], n) / (last - first),
        "resistance": np.where(is_zone, resistance, ledger["resistance"][middle]),
        "voltage_gap": np.where(is_zone & (conductance > 0), driving, columns["voltage_gap"]),
    }


def _wires_at(results: ResultFile, wires: list) -> dict[str, np.ndarray]:
    """The wires that have a node in each node set."""
    node = np.concatenate([wire.nodes for wire in wires])
    wire_of = np.repeat(np.arange(len(wires)), [len(wire.nodes) for wire in wires])
    return {name: np.unique(wire_of[np.isin(node, members)]) for name, members in results.node_sets.items()}


def wire_currents(results: ResultFile, increment: int) -> np.ndarray:
    """Largest current along each wire, between any two of its contacts, with its sign, (n_wires) [A]."""
    current = _largest_in_elements(results, increment)
    along = [wire.signs * current[wire.elements] for wire in results.wires]
    return np.array([values[np.argmax(np.abs(values))] for values in along])


def _largest_in_elements(results: ResultFile, increment: int) -> np.ndarray:
    """Largest current in each element from its first to its second node, (n_elements) [A].

    The field `element_current` is the mean over the element; each contact makes a step in the current.
    """
    largest = results.field("element_current", increment).copy()
    ledger = results.contacts_at(increment)
    ledger = ledger.where(ledger["current"] != 0)
    row = np.concatenate([rows_of(results.element_ids, ledger[name]) for name in ("element_1", "element_2")])
    xi = np.concatenate([ledger["xi_1"], ledger["xi_2"]])
    entering = np.concatenate([-ledger["current"], ledger["current"]])
    order = np.lexsort((xi, row))
    if not order.size:
        return largest
    row, entering, xi = row[order], entering[order], xi[order]
    begin = np.flatnonzero(np.diff(row, prepend=row[0] - 1))
    count = np.diff(begin, append=len(row))
    # the current before the first contact of each element, and behind each of its contacts
    first = largest[row[begin]] - np.add.reduceat(entering * (1 - xi), begin) / 2
    passed = np.cumsum(entering)
    between = np.repeat(first - passed[begin] + entering[begin], count) + passed
    size = np.maximum.reduceat(np.abs(between), begin)
    place = np.where(np.abs(between) == np.repeat(size, count), np.arange(len(row)), len(row))
    largest[row[begin]] = np.where(size > np.abs(first), between[np.minimum.reduceat(place, begin)], first)
    return largest


def conductance(results: ResultFile, plus: str, minus: str, increment: int) -> float:
    """Current over voltage between two node sets [S]."""
    entering = results.field("reaction_current", increment) + results.field("applied_current", increment)
    potential = results.field("potential", increment)
    rows = [results.node_sets[name] for name in (plus, minus)]
    voltage = potential[rows[0]].mean() - potential[rows[1]].mean()
    if voltage == 0:
        raise ValueError(f"there is no voltage between {plus} and {minus}, so there is no conductance")
    return float(entering[rows[0]].sum() / voltage)
