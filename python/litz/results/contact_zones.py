"""Contact along lines as zones, and what passes between two wires in all."""

from dataclasses import dataclass

import numpy as np

from ..base.quantities import per, unit_of_conductance
from ..base.table import Table
from .contact_places import ContactPlaces

_SUMS = ("force", "current", "joule_heat")
_PER_LENGTH = ("force_per_length", "current_per_length", "heat_per_length")
# A zone that covers a ring but for round-off has no ends
_WHOLE = 1 - 1e-9


@dataclass(frozen=True, eq=False)
class Stretch:
    """The zones along the first or the second of their wires: arcs of the rows (k), and of both ends (n_zones) [m].

    In a ring an arc may lie beyond its length, so that all arcs of a zone follow each other.
    """

    arc: np.ndarray
    begin: np.ndarray
    end: np.ndarray

    @property
    def extent(self) -> np.ndarray:
        """Length of each zone (n_zones) [m]."""
        return self.end - self.begin


def contact_zones(places: ContactPlaces, units: dict[str, str]) -> Table:
    """The zones of line contact, a row for each, in the order of the wires; `units` are those of `unit_labels`."""
    inside = places.where(places.zone >= 0)
    zone, n = inside.zone, int(inside.zone.max(initial=-1)) + 1
    on_line = inside.spacing > 0
    stretches = [stretch_along(inside, side) for side in (0, 1)]
    order = np.lexsort((stretches[0].arc, zone))
    first = order[np.searchsorted(zone[order], np.arange(n))]
    last = order[np.searchsorted(zone[order], np.arange(n), "right") - 1]
    length = _length(inside, n, stretches)
    # along the second wire from the same end as along the first one
    forward = _run_alike(zone, n, stretches)[:, None]
    second = np.stack([stretches[1].begin, stretches[1].end], axis=1)
    second = np.where(forward, second, second[:, ::-1])
    ids, gap = np.full(n, np.iinfo(np.int64).max), np.full(n, np.inf)
    np.minimum.at(ids, zone, inside.ledger["id"])
    np.minimum.at(gap, zone, inside.ledger["gap"])
    columns = {
        "id": ids,
        "wire_1": inside.wires[first, 0],
        "wire_2": inside.wires[first, 1],
        "arc_1_begin": stretches[0].begin,
        "arc_1_end": stretches[0].end,
        "arc_2_begin": second[:, 0],
        "arc_2_end": second[:, 1],
        **{f"begin_{axis}": inside.point[first, i] for i, axis in enumerate("xyz")},
        **{f"end_{axis}": inside.point[last, i] for i, axis in enumerate("xyz")},
        "length": length,
        "gap": gap,
        "places": np.bincount(zone[on_line], minlength=n),
        "crossings": np.bincount(zone[~on_line], minlength=n),
        **_totals(inside, zone, n),
    }
    in_units = dict.fromkeys(columns, units["m"]) | dict.fromkeys(("id", "wire_1", "wire_2", "places", "crossings"), "")
    in_units |= _units_of_totals(units)
    of_rows = per_length(inside)
    for name, total in zip(_PER_LENGTH, _SUMS, strict=True):
        columns[name] = columns[total] / length
        columns[f"max_{name}"] = np.zeros(n)
        np.maximum.at(columns[f"max_{name}"], zone, np.abs(of_rows[name]))
        in_units |= dict.fromkeys((name, f"max_{name}"), per(in_units[total], units["m"]))
    return Table(columns, in_units)


def wire_pairs(places: ContactPlaces, units: dict[str, str]) -> Table:
    """What passes between two wires in all their contacts, a row for each pair that touches."""
    pairs, pair = np.unique(places.wires, axis=0, return_inverse=True)
    pair, n = pair.ravel(), len(pairs)
    zones = contact_zones(places, units)
    pair_of_zone = np.zeros(zones.n_rows, dtype=int)
    in_zone = places.zone >= 0
    pair_of_zone[places.zone[in_zone]] = pair[in_zone]
    columns = {
        "wire_1": pairs[:, 0],
        "wire_2": pairs[:, 1],
        "zones": np.bincount(pair_of_zone, minlength=n),
        "crossings": np.bincount(pair[places.spacing == 0], minlength=n),
        "length": np.bincount(pair_of_zone, zones["length"], n).astype(float),
        **_totals(places, pair, n),
    }
    in_units = {**dict.fromkeys(columns, ""), "length": units["m"], **_units_of_totals(units)}
    return Table(columns, in_units)


def per_length(places: ContactPlaces) -> dict[str, np.ndarray]:
    """Force, current and heat per length at each row, without those of round ends, by name (k); 0 where wires cross.

    Where both wires have places each stands for half of the contact, with half of the length.
    """
    values, of_ends, length = _signed(places), _of_round_ends(places.ledger), places.length
    return {
        name: np.divide((1 - of_ends[total]) * values[total], length, out=np.zeros(len(length)), where=length > 0)
        for name, total in zip(_PER_LENGTH, _SUMS, strict=True)
    }


def _of_round_ends(ledger: Table) -> dict[str, np.ndarray]:
    """Which part of force, current and heat of each row is that of a round end, (k)."""
    if "end_force" not in ledger:
        return dict.fromkeys(_SUMS, np.zeros(ledger.n_rows))
    force, current = (_part(ledger[f"end_{name}"], ledger[name]) for name in ("force", "current"))
    # strip and round end have the same voltage
    return {"force": force, "current": current, "joule_heat": current}


def _part(part: np.ndarray, whole: np.ndarray) -> np.ndarray:
    return np.divide(part, whole, out=np.zeros(len(whole)), where=whole != 0)


def _signed(places: ContactPlaces) -> dict[str, np.ndarray]:
    """Force, current and heat of each row; the current flows from the first to the second wire of the pair."""
    values = {name: places.ledger[name] for name in _SUMS}
    return values | {"current": np.where(places.flipped, -values["current"], values["current"])}


def _totals(places: ContactPlaces, group: np.ndarray, n: int) -> dict[str, np.ndarray]:
    """Sums over groups of rows, (n)."""
    of_rows = _signed(places) | {"conductance": 1 / places.ledger["resistance"]}
    # without rows numpy would count in whole numbers
    return {name: np.bincount(group, values, n).astype(float) for name, values in of_rows.items()}


def _units_of_totals(units: dict[str, str]) -> dict[str, str]:
    conductance = unit_of_conductance(units["ohm"])
    return {"force": units["N"], "current": units["A"], "joule_heat": units["W"], "conductance": conductance}


def stretch_along(inside: ContactPlaces, side: int) -> Stretch:
    """The zones along their first (0) or second (1) wire, given rows that are in zones.

    A place reaches halfway to the next one, a foot only to itself. Places without a force, which conduct because a part
    of the wire touches for which they stand, lie beyond the ends.
    """
    zone, wire, arc = inside.zone, inside.wires[:, side], inside.arc[:, side]
    n = int(zone.max(initial=-1)) + 1
    ring = np.where(inside.closed, inside.wire_length, np.inf)[wire]
    order = np.lexsort((arc, zone))
    following = np.roll(order, -1)
    last = np.append(np.diff(zone[order]) > 0, True)[: len(order)]
    following[last] = order[np.searchsorted(zone[order], np.arange(n))]
    gap = arc[following] - arc[order] + np.where(last, ring[order], 0.0)
    # a zone begins after the largest gap between its rows: in other wires than rings at the lowest arc
    widest = np.lexsort((gap, zone[order]))[np.searchsorted(zone[order], np.arange(n), "right") - 1]
    start = arc[following[widest]]
    arc = arc + np.where(arc < start[zone], ring, 0.0)

    half = np.where(inside.own == side, inside.spacing / 2, 0.0)
    pressed = inside.ledger["force"] > 0
    within = pressed | (np.bincount(zone, pressed, n) == 0)[zone]
    begin, end = np.full(n, np.inf), np.full(n, -np.inf)
    lowest = np.maximum(arc - half, np.where(np.isinf(ring), 0.0, -np.inf))
    highest = np.minimum(arc + half, np.where(np.isinf(ring), inside.wire_length[wire], np.inf))
    np.minimum.at(begin, zone[within], lowest[within])
    np.maximum.at(end, zone[within], highest[within])
    ring_of_zone = np.full(n, np.inf)
    ring_of_zone[zone] = ring
    whole = end - begin >= _WHOLE * ring_of_zone
    return Stretch(arc, np.where(whole, 0.0, begin), np.where(whole, ring_of_zone, end))


def _length(inside: ContactPlaces, n: int, stretches: list[Stretch]) -> np.ndarray:
    """Lengths of the zones [m]: on either wire, as far as its places carry the contact."""
    carried = [np.bincount(inside.zone, np.where(inside.own == side, inside.length, 0.0), n) for side in (0, 1)]
    of_both = sum(share * stretch.extent for share, stretch in zip(carried, stretches, strict=True))
    return of_both / (carried[0] + carried[1])


def _run_alike(zone: np.ndarray, n: int, stretches: list[Stretch]) -> np.ndarray:
    """Whether the two wires of each zone run in the same direction, (n)."""
    count = np.bincount(zone, minlength=n)
    first, second = (one.arc - (np.bincount(zone, one.arc, n) / count)[zone] for one in stretches)
    return np.bincount(zone, first * second, n) >= 0
