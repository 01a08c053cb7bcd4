"""Resistances between strands: what a measurement between the ends of two strands of a cable would give."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..base.names import unknown_name
from ..base.packages import optional
from ..base.table import Table
from .circuit import Circuit, build_circuit
from .result_file import ResultFile

#: A point is within its wire up to this part of its length
_WITHIN = 1 + 1e-9
#: Element sets that `litz.build.cable` makes of the members of each stage
_BUNDLE = re.compile(r"BUNDLE\d+(_\d+)*")


@dataclass(frozen=True, eq=False, repr=False)
class InterstrandResistance:
    """Resistances between strands at one increment.

    Attributes
    ----------
    matrix : (n, n) array
        Resistance between any two wires, in the order of `results.wires` [ohm]; infinite where nothing joins them.
    stage : (n, n) array of int
        Stage of the cable that lays the two wires together: 1 in the same bundle of the first stage, 2 in different
        bundles of the first stage but the same one of the second, and so on.
    length : float
        Mean length of the wires before deformation [m].
    terminal : (n,) array of int
        Where the current enters each wire, as point of `circuit`; -1 of a wire that does not conduct.
    bundles : dict of (k,) arrays of int
        Wires of each bundle, counted from 0.
    circuit : Circuit
        Pieces of wire and contacts as resistances.
    """

    matrix: np.ndarray
    stage: np.ndarray
    length: float
    terminal: np.ndarray
    bundles: dict[str, np.ndarray]
    circuit: Circuit

    def __repr__(self) -> str:
        """Sizes and means."""
        stages = self.stages()
        means = ", ".join(
            f"{mean:.3g}" + (f" ({apart} pairs not joined)" if apart else "")
            for mean, apart in zip(stages["mean"], stages["not_joined"], strict=True)
        )
        return (
            f"<InterstrandResistance: {len(self.matrix)} wires; mean of each stage: {means} {self.circuit.unit['ohm']}>"
        )

    def table(self) -> Table:
        """A row for each two wires, counted from 0: stage, resistance, and resistance times length."""
        first, second = np.triu_indices(len(self.matrix), 1)
        resistance = self.matrix[first, second]
        columns = {
            "wire_1": first,
            "wire_2": second,
            "stage": self.stage[first, second],
            "resistance": resistance,
            "times_length": resistance * self.length,
        }
        return Table(columns, dict.fromkeys(columns, "") | self._units("resistance"))

    def stages(self) -> Table:
        """A row for each stage: pairs of wires, how many of them nothing joins, and resistances of the others.

        `mean`, `median`, `smallest`, `largest` and `times_length`, the mean times the length, are those of the pairs that are
        joined; infinite where none is.
        """
        table = self.table()
        stage, pairs = np.unique(table["stage"], return_counts=True)
        joined = [
            values[np.isfinite(values)]
            for values in (table["resistance"][table["stage"] == number] for number in stage)
        ]
        functions: dict[str, Any] = {"mean": np.mean, "median": np.median, "smallest": np.min, "largest": np.max}
        columns = {
            "stage": stage,
            "pairs": pairs,
            "not_joined": pairs - np.array([len(values) for values in joined], dtype=int),
            **{
                name: np.array([function(values) if len(values) else np.inf for values in joined], dtype=float)
                for name, function in functions.items()
            },
        }
        columns["times_length"] = columns["mean"] * self.length
        return Table(columns, dict.fromkeys(columns, "") | self._units(*functions))

    def between(self, first: str | int | Sequence[int], second: str | int | Sequence[int]) -> float:
        """Resistance between two groups of wires, those of each soldered together where the current enters [ohm].

        Parameters
        ----------
        first, second : str, int or sequence of int
            A bundle by its name, a wire, or wires counted from 0.
        """
        groups = [self._wires(group) for group in (first, second)]
        if set(groups[0].tolist()) & set(groups[1].tolist()):
            raise ValueError("there is no resistance between groups that share a wire")
        points = [self.terminal[group] for group in groups]
        if any((some < 0).any() for some in points):
            raise ValueError("a wire of these groups does not conduct")
        solver = self.circuit.solver(points)
        return float(solver.resistances(np.array([some[0] for some in points]))[0, 1])

    def _wires(self, group: str | int | Sequence[int]) -> np.ndarray:
        if isinstance(group, str):
            if group not in self.bundles:
                raise KeyError(unknown_name("bundle", group, self.bundles))
            return self.bundles[group]
        wires = np.atleast_1d(np.asarray(group, dtype=int))
        if not wires.size or wires.min() < 0 or wires.max() >= len(self.matrix):
            raise IndexError(f"wires are counted from 0 to {len(self.matrix) - 1}, not {group}")
        return wires

    def _units(self, *names: str) -> dict[str, str]:
        ohm, m = self.circuit.unit["ohm"], self.circuit.unit["m"]
        return {**dict.fromkeys(names, ohm), "times_length": f"{ohm} {m}".strip()}


def interstrand_resistance(
    results: ResultFile,
    increment: int,
    *,
    at: float = 0.0,
    superconducting: bool | None = None,
    bundles: Sequence[str] | Mapping[str, Sequence[int]] | None = None,
) -> InterstrandResistance:
    """Resistances between any two wires; see `Results.interstrand_resistance`."""
    if not 0 <= at <= 1:
        raise ValueError(f"at is a place along the wires from 0 to 1, not {at:g}")
    wires = results.wires
    element, along = _places_along(results, at)
    circuit, terminal = build_circuit(results, increment, superconducting=superconducting, at=(element, along))
    there = np.flatnonzero(terminal >= 0)
    matrix = np.full((len(wires), len(wires)), np.inf)
    np.fill_diagonal(matrix, 0.0)
    matrix[np.ix_(there, there)] = circuit.solver().resistances(terminal[there])
    named = _bundles(results, bundles)
    return InterstrandResistance(
        matrix, _stages(len(wires), named), float(results.wire_arcs.wire_length.mean()), terminal, named, circuit
    )


def redistribution_lengths(results: ResultFile, increment: int, *, superconducting: bool | None = None) -> np.ndarray:
    """Lengths over which currents spread evenly among the wires; see `Results.redistribution_lengths`."""
    conductance = wire_conductances(results, increment)
    arcs = results.wire_arcs
    length = arcs.wire_length.mean()
    circuit, _ = build_circuit(results, increment, superconducting=superconducting)
    beyond = circuit.arc > _WITHIN * arcs.wire_length[circuit.wire]
    pieces = (circuit.contact == 0) & ~beyond[circuit.points].any(axis=1)
    along = (
        np.bincount(circuit.wire[circuit.points[pieces, 0]], circuit.resistance[pieces], len(results.wires))
        / arcs.wire_length
    )
    root = np.sqrt(along)
    # V' = -r I and I' = -g V: the currents I go with exp(-x/l), 1/l^2 the eigenvalues of r g
    rates = np.linalg.eigvalsh(root[:, None] * (conductance / length) * root[None, :])[1:]
    scale = max(along.max() * np.abs(conductance).max() / length, np.finfo(float).tiny)
    lengths = np.full(len(rates), np.inf)
    grows = rates > 1e-12 * scale
    lengths[grows] = 1 / np.sqrt(rates[grows])
    return lengths


def wire_conductances(results: ResultFile, increment: int) -> np.ndarray:
    """Currents that leave the wires for potentials of 1 V along each, (n, n) [S]: minus the conductances between them.

    The strips on one wire add to each other's voltage.
    """
    circuit, _ = build_circuit(results, increment, superconducting=False)
    n = len(results.wires)
    contacts = np.flatnonzero(circuit.contact > 0)
    if not len(contacts):
        return np.zeros((n, n))
    sparse, linalg = optional("scipy.sparse"), optional("scipy.sparse.linalg")
    k = len(contacts)
    wire = circuit.wire[circuit.points[contacts]]
    rows = np.concatenate([np.arange(k), np.arange(k)])
    incidence = sparse.csc_matrix((np.repeat([1.0, -1.0], k), (rows, wire.T.ravel())), shape=(k, n))
    a, b = (circuit.coupled - contacts[0]).T
    values = np.concatenate([circuit.resistance[contacts], circuit.mutual, circuit.mutual])
    voltages = sparse.csc_matrix(
        (values, (np.concatenate([np.arange(k), a, b]), np.concatenate([np.arange(k), b, a]))), shape=(k, k)
    )
    return incidence.T @ linalg.splu(voltages).solve(incidence.toarray())


def _places_along(results: ResultFile, at: float) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the elements at a part of the length of each wire, and where it is in them from 0 to 1."""
    arcs = results.wire_arcs
    element, along = [], []
    for number, wire in enumerate(results.wires):
        start, length = arcs.start[wire.elements], arcs.length[wire.elements]
        arc = at * arcs.wire_length[number]
        k = min(int(np.searchsorted(start, arc, "right")) - 1, len(start) - 1)
        part = min((arc - start[k]) / length[k], 1.0)
        element.append(wire.elements[k])
        along.append(part if wire.signs[k] > 0 else 1 - part)
    return np.array(element), np.array(along)


def _bundles(results: ResultFile, wanted: Sequence[str] | Mapping[str, Sequence[int]] | None) -> dict[str, np.ndarray]:
    """Wires of the bundles."""
    if isinstance(wanted, Mapping):
        return {name: np.unique(np.asarray(wires, dtype=int)) for name, wires in wanted.items()}
    sets = results.element_sets
    names = [name for name in sets if _BUNDLE.fullmatch(name)] if wanted is None else list(wanted)
    found = {}
    for name in names:
        if name not in sets:
            raise KeyError(unknown_name("element set", name, sets))
        wires, count = np.unique(results.wire_arcs.wire[sets[name]], return_counts=True)
        if any(count[i] != len(results.wires[wire].elements) for i, wire in enumerate(wires)):
            raise ValueError(f"the element set {name} has parts of wires: bundles are made of whole wires")
        found[name] = wires
    return found


def _stages(n: int, bundles: dict[str, np.ndarray]) -> np.ndarray:
    """Stage that lays each two wires together, (n, n)."""
    members = sorted({frozenset(wires.tolist()) for wires in bundles.values()} - {frozenset(range(n))}, key=len)
    height: dict[frozenset, int] = {}
    for one in members:
        height[one] = 1 + max((height[other] for other in height if other < one), default=0)
    stage = np.full((n, n), 1 + max(height.values(), default=0))
    for one in reversed(members):
        wires = sorted(one)
        stage[np.ix_(wires, wires)] = height[one]
    np.fill_diagonal(stage, 0)
    return stage
