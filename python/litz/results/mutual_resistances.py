"""What strips side by side on one wire add to each other's voltage, as runs have it."""

import re
import warnings

import numpy as np

from ..base.table import Table
from .result_file import ResultFile

# As in the program (fortran/contact/strips_of_wires.f90, line_places.f90): nearest strips that are two, in radii; longest
# part of an element, in radii of the thinnest wire; the fewest and the most parts of an element; a multiple stays one; what
# strips of a section add to each other, at most, of what they resist by themselves
_LEAST_DISTANCE, _MOST_OF_OWN = 0.1, 0.7
_LONGEST_PART, _FEWEST, _MOST, _ROUND_OFF = 0.4, 2, 1000, 1e-9
_BETWEEN_SPOTS = re.compile(r"MUTUAL\s*RESISTANCE\s*=\s*YES", re.IGNORECASE)


def mutual_resistances(
    results: ResultFile, increment: int, ledger: Table, rows: list[np.ndarray], spacing: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of rows of the ledger (k, 2), and their mutual resistance with its sign, (k) [ohm].

    A current `i` per length at the angle theta round the wire raises the potential of a strip above the mean of the section by
    `(rho/pi) (1/8 - ln(2 sin(theta/2))) i`. Source: theory section 10, equation (10.13).

    Parameters
    ----------
    results, increment
        The run, and index of the increment.
    ledger : Table
        Contacts that conduct.
    rows : list of two (n,) arrays of int
        Rows of their elements, barred first.
    spacing : (n,) array
        Distance of places along lines [m]; 0: a crossing, which is no strip.
    """
    if _BETWEEN_SPOTS.search(results.deck):
        warnings.warn(
            "MUTUAL RESISTANCE=YES: what spots near each other on one wire add to each other is left out of the circuit",
            stacklevel=2,
        )
    lines = np.flatnonzero(spacing > 0)
    if not len(lines):
        return np.zeros((0, 2), dtype=int), np.zeros(0)
    resistivity = results.field("resistivity", increment)
    strips = [row[lines] for row in rows]
    places = _Places(results, strips, spacing[lines], resistivity)
    normal = np.stack([ledger[f"normal_{axis}"] for axis in "xyz"], axis=1)[lines]
    wire = results.conductor_arcs.wire
    parts = []
    for side in (0, 1):
        at, of_place = places.shares(strips[side], (1 + ledger[f"xi_{side + 1}"][lines]) / 2)
        sign = np.full(len(lines), 2.0 * side - 1)
        parts += [
            (np.arange(len(lines)), sign, wire[strips[1 - side]], one, share)
            for one, share in zip(at, of_place, strict=True)
        ]
    row, sign, other, place, share = (np.concatenate(column) for column in zip(*parts, strict=True))
    order = np.argsort(place, kind="stable")
    order = order[share[order] > 0]
    row, sign, other, place, share = (values[order] for values in (row, sign, other, place, share))
    first, second = _pairs_in_groups(place)
    apart = other[first] != other[second]
    first, second = first[apart], second[apart]
    outward = sign[:, None] * normal[row]
    distance = np.linalg.norm(outward[first] - outward[second], axis=1)
    raised = places.resistivity[place[first]] / np.pi * (1 / 8 - np.log(np.maximum(distance, _LEAST_DISTANCE)))
    value = sign[first] * sign[second] * share[first] * share[second] / places.length[place[first]] * raised
    # either wire has its part of what resists
    both = sum(resistivity[each] for each in strips)
    own = share * places.resistivity[place] * (ledger["resistance"][lines] / both)[row]
    value *= _limits_of_sections(place, first, second, np.abs(value) / np.sqrt(own[first] * own[second]), raised < 0)
    pairs = np.sort(np.column_stack([row[first], row[second]]), axis=1)
    pairs, where = np.unique(pairs, axis=0, return_inverse=True)
    return lines[pairs], np.bincount(where.ravel(), value, len(pairs))


def _limits_of_sections(
    place: np.ndarray, first: np.ndarray, second: np.ndarray, added: np.ndarray, lowers: np.ndarray
) -> np.ndarray:
    """Factor of each pair, so that what the strips of its section add takes away at most a part of what they resist.

    Conductances that are given may be larger than those of any strip. Source: theory section 10, equation (10.13a).

    Parameters
    ----------
    place : (n,) array
        Sorted places of the parts of all strips.
    first, second : (k,) arrays of int
        Parts of each pair.
    added : (k,) array
        What each pair adds, over the root of what both resist by themselves [-].
    lowers : (k,) array of bool
        It lowers the potential.
    """
    n_places = place[-1] + 1
    sums = np.bincount(first, added, len(place)) + np.bincount(second, added, len(place))
    factor = np.ones(n_places)
    # no eigenvalue is larger than the largest sum of a row
    for number in np.unique(place[sums > _MOST_OF_OWN]):
        begin, end = np.searchsorted(place, [number, number + 1])
        here = (first >= begin) & (first < end)
        form = np.zeros((end - begin, end - begin))
        form[first[here] - begin, second[here] - begin] = np.where(lowers[here], -added[here], added[here])
        lowest = np.linalg.eigvalsh(form + form.T)[0]
        factor[number] = _MOST_OF_OWN / max(_MOST_OF_OWN, -lowest)
    return factor[place[first]]


def _pairs_in_groups(group: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All pairs of rows with the same number, each once, given sorted numbers (n)."""
    last = np.searchsorted(group, group, "right")
    count = last - np.arange(len(group)) - 1
    first = np.repeat(np.arange(len(group)), count)
    start = np.cumsum(count) - count
    return first, first + 1 + np.arange(len(first)) - start[first]


class _Places:
    """The places of all wires, one wire after the other: for which length each stands, and the resistivity there."""

    def __init__(self, results: ResultFile, strips: list[np.ndarray], spacing: np.ndarray, resistivity: np.ndarray):
        arcs, radius = results.conductor_arcs, results.radius
        thinnest = min(radius[row].min() for row in strips)
        parts = np.ceil(np.minimum((1 - _ROUND_OFF) * arcs.length / (_LONGEST_PART * thinnest), _MOST))
        parts = np.maximum(parts, _FEWEST).astype(int)
        # of elements with places of their own it is known
        parts[strips[1]] = np.rint(arcs.length[strips[1]] / spacing)
        self._parts, self._sign = parts, arcs.sign
        self._before, self._last = np.zeros(len(parts), dtype=int), np.zeros(len(parts), dtype=int)
        self._first, self._closed = np.zeros(len(parts), dtype=int), arcs.closed[arcs.wire]
        length, metal, n = [], [], 0
        for wire in results.conductors:
            upto = np.cumsum(parts[wire.elements])
            self._first[wire.elements], self._last[wire.elements] = n, n + upto[-1]
            self._before[wire.elements] = n + upto - parts[wire.elements]
            half = np.repeat(arcs.length[wire.elements] / parts[wire.elements], parts[wire.elements]) / 2
            length.append(np.append(half, 0.0) + np.append(0.0, half))
            of_parts = np.repeat(resistivity[wire.elements], parts[wire.elements])
            metal.append(np.append(of_parts[0], of_parts))
            if wire.nodes[0] == wire.nodes[-1]:
                length[-1][0] += length[-1][-1]
            n += upto[-1] + 1
        self.length, self.resistivity = np.concatenate(length), np.concatenate(metal)

    def shares(self, element: np.ndarray, along: np.ndarray) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """The two places next to points in elements (n), and how much of the current of each point belongs to either."""
        parts = self._parts[element]
        along = np.where(self._sign[element] > 0, along, 1 - along)
        u = np.clip(along, 0.0, 1.0) * parts
        whole = np.rint(u)
        u = np.where(np.abs(u - whole) < 1e-9, whole, u)
        k = np.minimum(u.astype(int), parts - 1)
        lower = self._before[element] + k
        upper = lower + 1
        ring = self._closed[element] & (upper == self._last[element])
        return [lower, np.where(ring, self._first[element], upper)], [k + 1 - u, u - k]
