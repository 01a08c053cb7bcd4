"""Currents, forces and heat along a cable: what its wires share at each place of its axis."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np

from ..base.quantities import in_brackets, per, unit_of_conductance
from ..base.table import Table
from .ledger import rows_of
from .result_file import ResultFile
from .scalars import scalar_values, scalars
from .surface_forces import joule_heat_on_surfaces

# Wires whose ends are this near to each other, as part of their length, lead nowhere
_NO_DIRECTION = 1e-3
# Cosine of the largest angle between the axis and a line from one end of a wire to the other
_ALONG = 0.8
# Part of the axis that wires of the same length have in common, at least: clamps let them move by little
_COMMON = 0.9
# A total current that is this part of those of the wires is round-off
_ROUND_OFF = 1e-9


@dataclass(frozen=True, eq=False)
class CableAxis:
    """The straight line along which wires run, from one end to the other, at an increment.

    Attributes
    ----------
    origin, direction : (3) arrays
        Where it begins [m], and its unit vector.
    length : float
        [m]
    along : list of (n) arrays
        Place along it of each node of each wire, ascending [m].
    turned : (n_wires,) array of bool
        The wire runs against it: its nodes are in reverse in `along`.
    """

    origin: np.ndarray
    direction: np.ndarray
    length: float
    along: list[np.ndarray]
    turned: np.ndarray

    @property
    def common(self) -> tuple[float, float]:
        """Stretch of it that all wires reach, or all of it where some wires are shorter by far [m]."""
        first, last = max(one[0] for one in self.along), min(one[-1] for one in self.along)
        return (first, last) if last - first > _COMMON * self.length else (0.0, self.length)

    def place(self, points: np.ndarray) -> np.ndarray:
        """Place along the axis of points (n, 3) [m]."""
        return (points - self.origin) @ self.direction


@dataclass(frozen=True, eq=False, repr=False)
class CurrentShares:
    """Currents of all wires along a cable.

    Attributes
    ----------
    place : (m,) array
        Places along the axis of the cable, from its lower end [m]; where all wires reach.
    current : (n_wires, m) array
        Current of each wire there, positive along the axis [A]; 0 where a wire does not reach.
    unit : dict of str
        Labels of the units of the deck, as `Results.unit_labels`.
    """

    place: np.ndarray
    current: np.ndarray
    unit: dict[str, str]

    def __repr__(self) -> str:
        """Sizes."""
        n, m = self.current.shape
        return f"<CurrentShares: {n} wires at {m} places over {self.place[-1]:g} {self.unit['m']}>"

    @property
    def total(self) -> np.ndarray:
        """Sum of the currents at each place, (m) [A]."""
        return self.current.sum(axis=0)

    @property
    def share(self) -> np.ndarray:
        """Current of each wire over the sum of all, (n_wires, m); nan where that is zero."""
        total = self.total
        none = np.abs(total) <= _ROUND_OFF * np.abs(self.current).sum(axis=0).max()
        return self.current / np.where(none, np.nan, total)

    def to_csv(self, path: str | PathLike) -> Path:
        """Write a row for each place: the currents of the wires, which are counted from 1, and their sum."""
        path = Path(path)
        ampere = in_brackets(self.unit["A"])
        heads = [f"place{in_brackets(self.unit['m'])}"]
        heads += [f"wire {number + 1}{ampere}" for number in range(len(self.current))]
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow([*heads, f"total{ampere}"])
            writer.writerows(np.column_stack([self.place, self.current.T, self.total]).tolist())
        return path


def cable_axis(results: ResultFile, increment: int) -> CableAxis:
    """The axis of a cable; an error where wires do not run along one."""
    position = results.positions(increment)
    first = np.array([position[wire.nodes[0]] for wire in results.wires])
    last = np.array([position[wire.nodes[-1]] for wire in results.wires])
    chords = last - first
    chords *= np.where(chords @ chords[0] < 0, -1.0, 1.0)[:, None]
    mean = chords.mean(axis=0)
    if not np.linalg.norm(mean) > _NO_DIRECTION * results.wire_arcs.wire_length.mean():
        raise ValueError("the wires run in all directions, not along a cable")
    direction = mean / np.linalg.norm(mean)
    # of wires along a coordinate it is in its sense
    if direction[np.argmax(np.abs(direction))] < 0:
        direction = -direction
    slanted = chords @ direction < _ALONG * np.linalg.norm(chords, axis=1)
    if slanted.any():
        raise ValueError(f"wire {np.argmax(slanted) + 1} does not run along the others, as in a cable")
    along = [position[wire.nodes] @ direction for wire in results.wires]
    turned = np.array([one[-1] < one[0] for one in along])
    along = [one[::-1] if back else one for one, back in zip(along, turned, strict=True)]
    for number, one in enumerate(along):
        if not (np.diff(one) > 0).all():
            raise ValueError(
                f"wire {number + 1} turns back along the cable, so that it has no place in its cross-sections"
            )
    start, end = min(one[0] for one in along), max(one[-1] for one in along)
    ends = np.concatenate([first, last])
    across = ends.mean(axis=0)
    origin = across + (start - across @ direction) * direction
    return CableAxis(origin, direction, float(end - start), [one - start for one in along], turned)


def current_shares(results: ResultFile, increment: int, count: int) -> CurrentShares:
    """Currents of all wires along a cable; see `Results.current_shares`."""
    if count < 2:
        raise ValueError(f"count must be 2 or more places, not {count}")
    axis = cable_axis(results, increment)
    place = np.linspace(*axis.common, count)
    contacts = _spread_of_contacts(results, increment, axis)
    rows, entering = _entering(results, increment)
    n, number = len(results.wires), results.wire_arcs.wire
    current = np.array([np.bincount(number[rows], entering * np.tile(part, 2), n) for part in contacts.before(place)]).T
    # what flows where a wire begins, and what enters its nodes
    first, last = _at_ends(results, increment, rows, entering)
    for k, (wire, along) in enumerate(zip(results.wires, axis.along, strict=True)):
        begins = np.where(wire.signs > 0, first[wire.elements], -last[wire.elements])
        ends = np.where(wire.signs > 0, last[wire.elements], -first[wire.elements])
        sources = np.concatenate([begins[:1], begins[1:] - ends[:-1], -ends[-1:]])
        if axis.turned[k]:
            sources = sources[::-1]
        # the ends of a wire that is as long as the cable are there but for round-off
        reached = along[:, None] <= place + _ROUND_OFF * axis.length
        reached[-1] = along[-1] < place - _ROUND_OFF * axis.length
        current[k] += sources @ reached
    return CurrentShares(place, current, results.unit_labels)


def _entering(results: ResultFile, increment: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the elements of all contacts, of the barred ones first, and the currents that enter them there (2 k) [A]."""
    ledger = results.contacts_at(increment)
    rows = np.concatenate([rows_of(results.element_ids, ledger[f"element_{side}"]) for side in (1, 2)])
    return rows, np.concatenate([-ledger["current"], ledger["current"]])


def _at_ends(
    results: ResultFile, increment: int, rows: np.ndarray, entering: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Current of each element at its first and at its second node, from the first to the second one, (n_elements) [A]."""
    ledger, mean = results.contacts_at(increment), results.field("element_current", increment)
    xi = np.concatenate([ledger["xi_1"], ledger["xi_2"]])
    # the mean over an element is its current at the first node and what enters, each from its place on
    first = mean - np.bincount(rows, entering * (1 - xi) / 2, len(mean))
    return first, first + np.bincount(rows, entering, len(mean))


class _Spread:
    """Contacts along an axis: each is spread evenly about its place."""

    def __init__(self, axis: CableAxis, place: np.ndarray, half: np.ndarray):
        self._begin = np.clip(place - half, 0.0, axis.length)
        self._end = np.clip(place + half, 0.0, axis.length)
        self._length = axis.length

    def before(self, places: np.ndarray) -> Iterator[np.ndarray]:
        """Which part of each contact lies before each place along the axis, (k) for each."""
        wide = self._end > self._begin
        width = np.where(wide, self._end - self._begin, 1.0)
        for place in places:
            if place >= self._length:
                yield np.ones(len(width))
            else:
                yield np.clip(np.where(wide, (place - self._begin) / width, place > self._begin), 0.0, 1.0)


def _spread_of_contacts(results: ResultFile, increment: int, axis: CableAxis) -> _Spread:
    """Places of lines stand for what is next to them, crossings are where they are."""
    ledger = results.contacts_at(increment)
    points = [np.stack([ledger[f"point_{side}_{name}"] for name in "xyz"], axis=1) for side in (1, 2)]
    slope = _slope(results, increment, axis, ledger["element_2"])
    half = slope * ledger["spacing"] / 2 if "spacing" in ledger else np.zeros(ledger.n_rows)
    return _Spread(axis, axis.place((points[0] + points[1]) / 2), half)


def _spread_on_surfaces(results: ResultFile, increment: int, axis: CableAxis) -> _Spread:
    """Contacts with rigid surfaces over the lengths that touch."""
    contacts = results.surface_contacts_at(increment)
    points = np.stack([contacts[f"point_{name}"] for name in "xyz"], axis=1)
    slope = _slope(results, increment, axis, contacts["element"])
    return _Spread(axis, axis.place(points), slope * contacts["length"] / 2)


def _slope(results: ResultFile, increment: int, axis: CableAxis, elements: np.ndarray) -> np.ndarray:
    """How far elements lead along an axis, over their length."""
    own = rows_of(results.element_ids, elements)
    ends = results.positions(increment)[results.elements[own]]
    return np.abs((ends[:, 1] - ends[:, 0]) @ axis.direction) / results.wire_arcs.length[own]


def along_cable(results: ResultFile, increment: int, count: int) -> Table:
    """Contact forces, conductances and heat along a cable, in slices; see `Results.along_cable`."""
    if count < 1:
        raise ValueError(f"count must be 1 or more slices, not {count}")
    axis = cable_axis(results, increment)
    edges = np.linspace(0.0, axis.length, count + 1)
    ledger = results.contacts_at(increment)
    with np.errstate(divide="ignore"):
        of_contacts = {
            "force": ledger["force"],
            "conductance": 1 / ledger["resistance"],
            "contact_heat": ledger["joule_heat"],
        }
    width = axis.length / count
    columns = {"place": (edges[:-1] + edges[1:]) / 2}
    values = np.array(list(of_contacts.values()))
    before = np.array([values @ part for part in _spread_of_contacts(results, increment, axis).before(edges)])
    for name, upto in zip(of_contacts, before.T, strict=True):
        columns[f"{name}_per_length"] = np.diff(upto) / width
    heat = joule_heat_on_surfaces(results.surface_contacts_at(increment))
    if heat.any():
        upto = np.array([heat @ part for part in _spread_on_surfaces(results, increment, axis).before(edges)])
        columns["heat_on_surfaces_per_length"] = np.diff(upto) / width
    heat = results.field("joule_heat", increment)
    upto = np.zeros(count + 1)
    for number, (wire, along) in enumerate(zip(results.wires, axis.along, strict=True)):
        of_elements = heat[wire.elements[::-1] if axis.turned[number] else wire.elements]
        upto += np.interp(edges, along, np.append(0.0, np.cumsum(of_elements)))
    columns["wire_heat_per_length"] = np.diff(upto) / width
    unit = results.unit_labels
    units = {"place": unit["m"], "force_per_length": per(unit["N"], unit["m"])}
    units |= {"conductance_per_length": per(unit_of_conductance(unit["ohm"]), unit["m"])}
    return Table(
        columns, units | dict.fromkeys([name for name in columns if "heat" in name], per(unit["W"], unit["m"]))
    )


def wire_heat(results: ResultFile, increment: int) -> Table:
    """Heat of each wire and of its contacts; see `Results.wire_heat`."""
    arcs, n = results.wire_arcs, len(results.wires)
    ledger = results.contacts_at(increment)
    in_wires = np.bincount(results.conductor_arcs.wire, results.field("joule_heat", increment), n).astype(float)
    # what is raised in either half of a contact is not known apart where metals differ: half of it belongs to each wire
    in_contacts = np.zeros(n)
    for side in (1, 2):
        wire = arcs.wire[rows_of(results.element_ids, ledger[f"element_{side}"])]
        in_contacts += np.bincount(wire, ledger["joule_heat"] / 2, n)
    on_surfaces = results.surface_contacts_at(increment)
    if on_surfaces.n_rows:
        wire = arcs.wire[rows_of(results.element_ids, on_surfaces["element"])]
        in_contacts += np.bincount(wire, joule_heat_on_surfaces(on_surfaces) / 2, n)
    columns = {
        "wire": np.arange(n),
        "length": arcs.wire_length,
        "along": in_wires,
        "contacts": in_contacts,
        "total": in_wires + in_contacts,
        "per_length": (in_wires + in_contacts) / arcs.wire_length,
    }
    watt, m = results.unit_labels["W"], results.unit_labels["m"]
    units = {"wire": "", "length": m, "along": watt, "contacts": watt, "total": watt, "per_length": per(watt, m)}
    return Table(columns, units)


def along_wires(results: ResultFile, increment: int) -> Table:
    """All scalars of the elements along the wires; see `Results.along_wires`."""
    arcs = results.wire_arcs
    rows = np.concatenate([wire.elements for wire in results.wires])
    signs = np.concatenate([wire.signs for wire in results.wires])
    middle = results.positions(increment)[results.elements[rows]].mean(axis=1)
    columns = {
        "wire": arcs.wire[rows],
        "element": results.element_ids[rows],
        "arc": arcs.start[rows] + arcs.length[rows] / 2,
        **{axis: middle[:, i] for i, axis in enumerate("xyz")},
    }
    units = {"wire": "", "element": ""} | dict.fromkeys(("arc", "x", "y", "z"), results.unit_labels["m"])
    for name, scalar in scalars(results).items():
        if scalar.at_nodes or "." in name or scalar.is_length:
            continue
        values = scalar_values(results, scalar, increment)[rows]
        columns[name] = values * signs if name in _DIRECTED else values
        units[name] = scalar.unit
    return Table(columns, units)


#: Fields that count from the first to the second node of an element
_DIRECTED = ("element_current", "current_density", "electric_field", "heat_flux")
