"""The wires and contacts of an increment as a circuit: pieces of wire and contacts are resistances between points."""

from __future__ import annotations

import csv
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.packages import optional
from ..base.quantities import attribute, in_brackets
from ..base.table import Table
from .graphml import write_graphml
from .ledger import rows_of
from .mutual_resistances import mutual_resistances
from .result_file import ResultFile

if TYPE_CHECKING:
    import networkx as nx
    import scipy.sparse as sp

# Places in an element that are nearer to each other than this part of it are one point
_SAME_PLACE = 1e-9
# Currents for which a circuit is solved at once
_AT_ONCE = 16


@dataclass(frozen=True, eq=False, repr=False)
class Circuit:
    """Points on the axes of the wires, and the resistances between them: pieces of wire, and contacts.

    Every place of every contact is a point on each of its two wires; nodes are points, too. Potentials that a deck
    prescribes, currents that it feeds in, and ``*EQUATION`` are no part of the circuit.

    Attributes
    ----------
    node : (n,) array of int
        Number in the deck of the node at each point, 0 between nodes.
    wire : (n,) array of int
        Wire of each point, counted from 0.
    arc : (n,) array
        Where it is along the wire, before deformation [m]; longer than the wire where it has contacts across the upper end of
        a cell.
    position : (n, 3) array
        Where it is in space, after deformation [m].
    points : (m, 2) array of int
        The two points of each resistance.
    resistance : (m,) array
        [ohm]; 0 along a superconducting wire.
    contact : (m,) array of int
        Number of the contact in the ledger, 0 of a piece of wire.
    force, length : (m,) arrays
        Force of a contact [N], and the length for which a place of a line contact stands [m]; of a piece of wire 0,
        and its length.
    coupled : (k, 2) array of int
        Pairs of contacts, as rows of `points`, that press into one wire side by side; and
    mutual : (k,) array
        the resistance by which the current of each raises the voltage of the other, with its sign [ohm].
    unit : dict of str
        Labels of the units of the deck, as `Results.unit_labels`.
    """

    node: np.ndarray
    wire: np.ndarray
    arc: np.ndarray
    position: np.ndarray
    points: np.ndarray
    resistance: np.ndarray
    contact: np.ndarray
    force: np.ndarray
    length: np.ndarray
    coupled: np.ndarray
    mutual: np.ndarray
    unit: dict[str, str]

    def __repr__(self) -> str:
        """Sizes."""
        pieces = int((self.contact == 0).sum())
        return f"<Circuit: {len(self.arc)} points, {pieces} pieces of wire, {len(self.points) - pieces} places of contacts>"

    def table(self) -> Table:
        """The resistances, a row for each; points and wires are counted from 0."""
        place: dict[str, np.ndarray] = {}
        for side in (0, 1):
            end = self.points[:, side]
            place |= {f"wire_{side + 1}": self.wire[end], f"arc_{side + 1}": self.arc[end]}
        middle = self.position[self.points].mean(axis=1)
        columns = {
            "point_1": self.points[:, 0],
            "point_2": self.points[:, 1],
            "contact": self.contact,
            **place,
            **{axis: middle[:, i] for i, axis in enumerate("xyz")},
            "resistance": self.resistance,
            "force": self.force,
            "length": self.length,
        }
        of_length = ("arc_1", "arc_2", "x", "y", "z", "length")
        units = dict.fromkeys(columns, "") | dict.fromkeys(of_length, self.unit["m"])
        return Table(columns, units | {"resistance": self.unit["ohm"], "force": self.unit["N"]})

    def to_csv(self, path: str | PathLike) -> Path:
        """Write the resistances as a table, a row for each, points and wires counted from 1; pieces of wire have contact 0."""
        table, path = self.table(), Path(path)
        counted = ("point_1", "point_2", "wire_1", "wire_2")
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow([f"{name}{in_brackets(unit)}" for name, unit in table.units.items()])
            columns = [(table[name] + (name in counted)).tolist() for name in table]
            writer.writerows(zip(*columns, strict=True))
        return path

    def to_graphml(self, path: str | PathLike) -> Path:
        """Write a GraphML file, which NetworkX, igraph, Gephi and others read; names hold the units.

        Points are nodes `point1`, `point2`, ...; pieces of wire have the contact 0.
        """
        of_points = {"node": self.node, "wire": self.wire + 1, attribute("arc", self.unit["m"]): self.arc}
        of_points |= {attribute(axis, self.unit["m"]): self.position[:, i] for i, axis in enumerate("xyz")}
        of_edges = {
            "contact": self.contact,
            attribute("resistance", self.unit["ohm"]): self.resistance,
            attribute("force", self.unit["N"]): self.force,
            attribute("length", self.unit["m"]): self.length,
        }
        names = [f"point{number + 1}" for number in range(len(self.arc))]
        return write_graphml(path, "circuit", names, of_points, self.points, of_edges)

    def to_networkx(self) -> nx.MultiGraph:
        """The circuit as a graph of NetworkX, which it needs.

        Points are nodes, counted from 0, with `node`, `wire`, `arc` and `position`; resistances are edges with `contact`,
        `resistance`, `force` and `length`.
        """
        graph = optional("networkx").MultiGraph()
        for point in range(len(self.arc)):
            graph.add_node(
                point,
                node=int(self.node[point]),
                wire=int(self.wire[point]),
                arc=float(self.arc[point]),
                position=tuple(self.position[point].tolist()),
            )
        for row, (first, second) in enumerate(self.points.tolist()):
            graph.add_edge(
                first,
                second,
                contact=int(self.contact[row]),
                resistance=float(self.resistance[row]),
                force=float(self.force[row]),
                length=float(self.length[row]),
            )
        return graph

    def solver(self, joined: list[np.ndarray] | None = None) -> CircuitSolver:
        """For resistances between points, some of which may be joined."""
        return CircuitSolver(self, joined or [])


class CircuitSolver:
    """Solves a circuit for currents that enter at some points and leave at others; needs SciPy.

    Parameters
    ----------
    circuit : Circuit
    joined : list of arrays of int
        Points that are at one potential, such as those of a terminal.
    """

    def __init__(self, circuit: Circuit, joined: list[np.ndarray]):
        sparse = optional("scipy.sparse")
        n_points = len(circuit.arc)
        joins = [circuit.points[circuit.resistance == 0]]
        joins += [np.column_stack([some[:-1], some[1:]]) for some in joined]
        _, self._vertex = _components(np.concatenate(joins), n_points)
        ends = self._vertex[circuit.points]
        inside = (ends[:, 0] != ends[:, 1]) & np.isfinite(circuit.resistance)
        # where a contact leads back to the same conductor no current passes it
        between = np.flatnonzero(inside & (circuit.resistance > 0))
        n = int(self._vertex.max(initial=-1)) + 1
        _, part = _components(ends[between], n)
        self._part = part
        grounded = np.zeros(n, dtype=bool)
        grounded[np.unique(part, return_index=True)[1]] = True
        self._row = np.where(grounded, -1, np.cumsum(~grounded) - 1)

        coupled = np.isin(circuit.coupled, between).all(axis=1)
        pairs, mutual = circuit.coupled[coupled], circuit.mutual[coupled]
        branches = np.unique(pairs)
        plain = np.setdiff1d(between, branches)
        conductance = 1 / circuit.resistance[plain]
        first, second = self._row[ends[plain]].T
        rows = np.concatenate([first, second, first, second])
        columns = np.concatenate([first, second, second, first])
        values = np.concatenate([conductance, conductance, -conductance, -conductance])
        # the currents of contacts that raise each other's voltage are unknowns of their own
        n_free = int((~grounded).sum())
        own = n_free + np.arange(len(branches))
        for side, sign in ((0, 1.0), (1, -1.0)):
            at = self._row[ends[branches, side]]
            rows = np.concatenate([rows, at, own])
            columns = np.concatenate([columns, own, at])
            values = np.concatenate([values, np.full(2 * len(branches), sign)])
        a, b = n_free + np.searchsorted(branches, pairs).T
        rows = np.concatenate([rows, own, a, b])
        columns = np.concatenate([columns, own, b, a])
        values = np.concatenate([values, -circuit.resistance[branches], -mutual, -mutual])
        kept = (rows >= 0) & (columns >= 0)
        size = n_free + len(branches)
        matrix = sparse.csc_matrix((values[kept], (rows[kept], columns[kept])), shape=(size, size))
        self._factor: Any = _factor(matrix, symmetric=not len(branches)) if size else None
        self._size = size

    def resistances(self, points: np.ndarray) -> np.ndarray:
        """Resistance between any two points, (n, n) [ohm]; infinite where nothing joins them."""
        vertex = self._vertex[points]
        rows, part = self._row[vertex], self._part[vertex]
        n, free = len(points), rows >= 0
        raised = np.zeros((n, n))
        entries = np.flatnonzero(free)
        # nothing is free in a circuit without a factor
        for first in range(0, len(entries) if self._factor is not None else 0, _AT_ONCE):
            some = entries[first : first + _AT_ONCE]
            right = np.zeros((self._size, len(some)))
            right[rows[some], np.arange(len(some))] = 1.0
            raised[np.ix_(free, some)] = self._factor.solve(right)[rows[free]]
        own = np.diag(raised)
        found = own[:, None] + own[None, :] - raised - raised.T
        found[part[:, None] != part[None, :]] = np.inf
        found[vertex[:, None] == vertex[None, :]] = 0.0
        return found


def build_circuit(
    results: ResultFile,
    increment: int,
    *,
    superconducting: bool | None = None,
    at: tuple[np.ndarray, np.ndarray] | None = None,
) -> tuple[Circuit, np.ndarray]:
    """The circuit of an increment.

    Parameters
    ----------
    results, increment
        The run, and index of the increment.
    superconducting : bool, optional
        Which wires have no resistance along them: None those with superconducting filaments; True all; False none.
    at : tuple of (k,) arrays, optional
        Rows of elements, and places in them from 0 to 1, that are points besides; the points there are returned, -1 in an
        element that does not conduct.
    """
    metal = _metal(results, increment)
    ledger = results.conductor_contacts_at(increment)
    ledger = ledger.where(np.isfinite(ledger["resistance"]))
    rows = [rows_of(results.element_ids, ledger[f"element_{side}"]) for side in (1, 2)]
    conducts = (metal[rows[0]] > 0) & (metal[rows[1]] > 0) if ledger.n_rows else np.zeros(0, dtype=bool)
    ledger, rows = ledger.where(conducts), [row[conducts] for row in rows]
    extra = (np.zeros(0, dtype=int), np.zeros(0)) if at is None else at
    element = np.concatenate([*rows, extra[0]])
    along = np.concatenate([*((1 + ledger[f"xi_{side}"]) / 2 for side in (1, 2)), extra[1]])

    conducting = np.flatnonzero((metal > 0) & _reached(results, rows))
    position = results.positions(increment)
    points = _Points(results.elements, conducting, len(position), element, along)
    n, n_contacts = len(points.element), ledger.n_rows
    arcs = results.conductor_arcs
    arc = arcs.start + (1 - arcs.sign) / 2 * arcs.length
    place = np.empty((n, 3))
    ends = position[results.elements[points.element]]
    place[:] = ends[:, 0] + points.along[:, None] * (ends[:, 1] - ends[:, 0])
    pairs = points.of_place[: 2 * n_contacts].reshape(2, n_contacts).T
    # axes are curves between the nodes
    inner = points.node < 0
    for side in (0, 1):
        mine = inner[pairs[:, side]]
        axis = np.stack([ledger[f"point_{side + 1}_{name}"] for name in "xyz"], axis=1)
        place[pairs[mine, side]] = axis[mine]

    pieces, piece_element, part = points.pieces()
    zero = _superconducting(results, increment, superconducting)
    pieces_resistance = np.where(zero[piece_element], 0.0, metal[piece_element] * part)
    node_id = np.where(inner, 0, results.node_ids[np.where(inner, 0, points.node)])
    none = np.zeros(len(pieces))
    spacing = ledger["spacing"] if "spacing" in ledger else np.zeros(n_contacts)
    side_by_side = mutual_resistances(results, increment, ledger, rows, spacing)
    circuit = Circuit(
        node=node_id,
        wire=arcs.wire[points.element],
        arc=arc[points.element] + arcs.sign[points.element] * points.along * arcs.length[points.element],
        position=place,
        points=np.concatenate([pieces, pairs]),
        resistance=np.concatenate([pieces_resistance, ledger["resistance"]]),
        contact=np.concatenate([np.zeros(len(pieces), dtype=int), ledger["id"]]),
        force=np.concatenate([none, ledger["force"]]),
        length=np.concatenate(
            [part * arcs.length[piece_element], ledger["length"] if "length" in ledger else np.zeros(n_contacts)]
        ),
        coupled=side_by_side[0] + len(pieces),
        mutual=side_by_side[1],
        unit=results.unit_labels,
    )
    if zero.any():
        # filaments at one potential leave no room for currents that spread in the metal
        normal = ~(zero[rows[0]] | zero[rows[1]])
        kept = normal[side_by_side[0]].all(axis=1)
        circuit = replace(circuit, coupled=circuit.coupled[kept], mutual=circuit.mutual[kept])
    return circuit, points.of_place[2 * n_contacts :]


class _Points:
    """Nodes of elements that conduct, and places within these, as points; each has an element that it is in."""

    def __init__(
        self, elements: np.ndarray, conducting: np.ndarray, n_nodes: int, element: np.ndarray, along: np.ndarray
    ):
        at_first, at_second = along <= _SAME_PLACE, along >= 1 - _SAME_PLACE
        inside = ~(at_first | at_second)
        order = np.flatnonzero(inside)[np.lexsort((along[inside], element[inside]))]
        new = np.ones(len(order), dtype=bool)
        new[1:] = (np.diff(element[order]) != 0) | (np.diff(along[order]) > _SAME_PLACE)
        ends = elements[conducting].ravel()
        nodes, first = np.unique(ends, return_index=True)
        point_of_node = np.full(n_nodes, -1)
        point_of_node[nodes] = np.arange(len(nodes))
        starts = order[new]
        self._elements, self._conducting, self._point_of_node = elements, conducting, point_of_node
        self.node = np.concatenate([nodes, np.full(len(starts), -1)])
        self.element = np.concatenate([conducting[first // 2], element[starts]])
        self.along = np.concatenate([(first % 2).astype(float), along[starts]])
        self.of_place = np.full(len(along), -1)
        self.of_place[order] = len(nodes) + np.cumsum(new) - 1
        for mask, side in ((at_first, 0), (at_second, 1)):
            self.of_place[mask] = point_of_node[elements[element[mask], side]]
        lost = ~np.isin(element, conducting)
        self.of_place[lost] = -1

    def pieces(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The points of each piece of wire (k, 2), its element, and which part of that it is (k)."""
        inner = np.flatnonzero((self.node < 0) & np.isin(self.element, self._conducting))
        ends = self._point_of_node[self._elements[self._conducting]]
        point = np.concatenate([inner, ends[:, 0], ends[:, 1]])
        n = len(self._conducting)
        element = np.concatenate([self.element[inner], self._conducting, self._conducting])
        along = np.concatenate([self.along[inner], np.zeros(n), np.ones(n)])
        order = np.lexsort((along, element))
        same = np.flatnonzero(element[order][1:] == element[order][:-1])
        before, after = order[same], order[same + 1]
        return np.column_stack([point[before], point[after]]), element[before], along[after] - along[before]


def _metal(results: ResultFile, increment: int) -> np.ndarray:
    """Resistance of the metal of each element (n_elements) [ohm]; 0: it does not conduct."""
    if "potential" in results.fields and "element_resistance" not in results.fields:
        raise ValueError(f"{results.path} has no resistances of the wires: run the deck with litz 0.2 or later")
    metal = results.field("element_resistance", increment) if "element_resistance" in results.fields else np.zeros(1)
    if not metal.any():
        raise ValueError("no wire conducts: the materials have no *ELECTRICAL CONDUCTIVITY")
    return metal


def _reached(results: ResultFile, rows: list[np.ndarray]) -> np.ndarray:
    """Which elements are pieces of wires, those beyond the upper end of a cell as far as the wire has contacts (n_elements)."""
    reached = ~results.images
    on_images = np.zeros(len(reached), dtype=bool)
    for row in rows:
        on_images[row] = results.conducting_images[row]
    for wire in results.conductors if on_images.any() else ():
        touching = np.flatnonzero(on_images[wire.elements])
        reached[wire.elements[: touching.max(initial=-1) + 1]] = True
    return reached


def _superconducting(results: ResultFile, increment: int, wanted: bool | None) -> np.ndarray:
    """Which elements have no resistance along them (n_elements)."""
    n = len(results.elements)
    if wanted is not None or "critical_current" not in results.fields:
        return np.full(n, bool(wanted))
    return results.field("critical_current", increment) > 0


def _components(pairs: np.ndarray, n: int) -> tuple[int, np.ndarray]:
    """Number of the parts that pairs join, and the part of each of n, counted from 0."""
    sparse, graph = optional("scipy.sparse"), optional("scipy.sparse.csgraph")
    links = sparse.coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    return graph.connected_components(links, directed=False)


def _factor(matrix: sp.csc_matrix, symmetric: bool):  # type: ignore[no-untyped-def]
    linalg = optional("scipy.sparse.linalg")
    if symmetric:
        options = {"SymmetricMode": True}
        return linalg.splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    return linalg.splu(matrix)
