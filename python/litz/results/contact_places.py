"""Where the contacts of an increment are along the wires, and which of them belong together along a line."""

from dataclasses import dataclass, replace

import numpy as np

from ..base.table import Table
from ..wires import Wire, WireArcs
from .ledger import rows_of
from .result_file import ResultFile

# A foot moves along its wire by at most four times as much as its place (theory, 10.3)
_REACH = 4.0
# Round-off of a place within its element
_ROUND_OFF = 1e-6
# Parts of an element without a point of a line contact: any number that keeps its ends apart
_PARTS = 2


@dataclass(frozen=True, eq=False)
class ContactPlaces:
    """Rows of the ledger at one increment with their wires.

    The wires of a row are those of its pair in ascending order; contacts of a wire with itself have the lower arc first.

    Attributes
    ----------
    ledger : Table
        The rows, (k).
    wires : (k, 2) array of int
        The two wires, counted from 0.
    arc : (k, 2) array
        Where the row is along them, before deformation [m].
    flipped : (k,) array of bool
        The first wire is that of the second element of the row.
    point : (k, 3) array
        Halfway between the surfaces [m].
    wire_length : (n_wires,) array
        [m]
    closed : (n_wires,) array of bool
        The wire is a ring.
    length : (k,) array
        What the row stands for along a line [m]; 0: a crossing.
    spacing : (k,) array
        Distance of places along the wire with the place [m]; 0: a crossing.
    zone : (k,) array of int
        Rows with the same number touch along one line; -1: a crossing by itself.
    """

    ledger: Table
    wires: np.ndarray
    arc: np.ndarray
    flipped: np.ndarray
    length: np.ndarray
    spacing: np.ndarray
    point: np.ndarray
    wire_length: np.ndarray
    closed: np.ndarray
    zone: np.ndarray

    @property
    def own(self) -> np.ndarray:
        """Wire of the pair, 0 or 1, on which the place of a row lies; the other one has its foot, (k)."""
        return np.where(self.flipped, 0, 1)

    def where(self, mask: np.ndarray) -> "ContactPlaces":
        """The rows for which `mask` (k) is true."""
        names = ("wires", "arc", "flipped", "length", "spacing", "point", "zone")
        return replace(self, ledger=self.ledger.where(mask), **{name: getattr(self, name)[mask] for name in names})


def contact_places(results: ResultFile, ledger: Table) -> ContactPlaces:
    """The rows of a ledger at one increment along their wires."""
    arcs = results.wire_arcs
    rows = np.stack([rows_of(results.element_ids, ledger[name]) for name in ("element_1", "element_2")], axis=1)
    along = (1 + arcs.sign[rows] * np.stack([ledger["xi_1"], ledger["xi_2"]], axis=1)) / 2
    pair, arc = arcs.wire[rows], arcs.start[rows] + along * arcs.length[rows]
    flipped = np.where(pair[:, 0] == pair[:, 1], arc[:, 0] > arc[:, 1], pair[:, 0] > pair[:, 1])
    turned = np.where(flipped, [[1], [0]], [[0], [1]]).T
    pair, arc = np.take_along_axis(pair, turned, axis=1), np.take_along_axis(arc, turned, axis=1)

    # ledgers of litz 0.1 have crossings only
    length, spacing = (ledger[name] if name in ledger else np.zeros(ledger.n_rows) for name in ("length", "spacing"))
    zone = np.full(ledger.n_rows, -1)
    if spacing.any():
        before, parts, total = _numbering(arcs, results.wires, rows[:, 1], spacing)
        ordinal = np.take_along_axis(before[rows] + along * parts[rows], turned, axis=1)
        ends = np.where(arcs.closed, arcs.wire_length, np.inf), np.where(arcs.closed, total, np.iinfo(np.int64).max)
        zone, mirrored = _Lines(pair, arc, ordinal, np.where(flipped, 0, 1), spacing, ends).zones()
        arc[mirrored] = arc[mirrored, ::-1]
        flipped ^= mirrored
    return ContactPlaces(
        ledger, pair, arc, flipped, length, spacing, _points(results, ledger, rows), arcs.wire_length, arcs.closed, zone
    )


def _numbering(
    arcs: WireArcs, wires: list[Wire], element: np.ndarray, spacing: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places before each element along its wire and parts of each element (n_elements), and places of each wire."""
    parts = np.full(len(arcs.length), _PARTS)
    on_line = spacing > 0
    parts[element[on_line]] = np.rint(arcs.length[element[on_line]] / spacing[on_line])
    before, total = np.zeros(len(parts), dtype=int), np.zeros(len(wires), dtype=int)
    for number, wire in enumerate(wires):
        upto = np.cumsum(parts[wire.elements])
        before[wire.elements], total[number] = upto - parts[wire.elements], upto[-1]
    return before, parts, total


def _points(results: ResultFile, ledger: Table, rows: np.ndarray) -> np.ndarray:
    """Halfway between the surfaces, (k, 3) [m]."""
    first, second, normal = (
        np.stack([ledger[f"{name}_{axis}"] for axis in "xyz"], axis=1) for name in ("point_1", "point_2", "normal")
    )
    radius = results.radius[rows]
    return (first + second + (radius[:, 1] - radius[:, 0])[:, None] * normal) / 2


class _Lines:
    """Finds the rows that touch along one line: every row is joined to the places next to it on either wire.

    A row of a wire with itself stands for two, one the mirror image of the other: which of its two ends comes first is a
    matter of where the wire begins.

    Parameters
    ----------
    wires, arc, ordinal : (k, 2) arrays
        Wires of each row, and where it is along them, as arc length [m] and counted in places.
    own : (k,) array of int
        On which of the two the place of a row lies.
    spacing : (k,) array
        Distance of places [m]; 0: a crossing.
    ends : tuple of (n_wires,) arrays
        Length [m] and number of places of each ring; of other wires numbers beyond all places.
    """

    def __init__(
        self, wires: np.ndarray, arc: np.ndarray, ordinal: np.ndarray, own: np.ndarray, spacing: np.ndarray,
        ends: tuple[np.ndarray, np.ndarray],
    ):  # fmt: skip
        self._n = len(spacing)
        self._itself = np.flatnonzero(wires[:, 0] == wires[:, 1])
        self._wires, self._arc, self._ordinal = (
            np.concatenate([values, values[self._itself, ::-1]]) for values in (wires, arc, ordinal)
        )
        self._own = np.concatenate([own, 1 - own[self._itself]])
        self._spacing = np.concatenate([spacing, spacing[self._itself]])
        self._length, self._total = ends
        _, self._pair = np.unique(self._wires @ [int(wires.max()) + 1, 1], return_inverse=True)
        whole = np.rint(self._ordinal)
        self._ordinal = np.where(np.abs(self._ordinal - whole) < _ROUND_OFF, whole, self._ordinal)

    def zones(self) -> tuple[np.ndarray, np.ndarray]:
        """Number of the zone of each row, -1 where there is no line, and whether its mirror image is in the zone, (k).

        Zones are in the order of wires, then of arcs.
        """
        links = [self._links(side, further) for side in (0, 1) for further in (0, 1)]
        label = _components(len(self._own), *np.concatenate(links, axis=1))
        image = label[: self._n].copy()
        image[self._itself] = label[self._n :]
        mirrored = image < label[: self._n]
        lowest = np.minimum(image, label[: self._n])
        on_line = np.isin(lowest, lowest[self._spacing[: self._n] > 0])
        zone = np.full(self._n, -1)
        first, zone[on_line] = np.unique(lowest[on_line], return_inverse=True)
        begin = np.full(len(first), np.inf)
        np.minimum.at(begin, zone[on_line], self._arc[np.arange(self._n), mirrored.astype(int)][on_line])
        rank = np.argsort(np.lexsort((begin, self._pair[first])))
        return np.where(on_line, rank[zone], -1), mirrored

    def _links(self, side: int, further: int) -> np.ndarray:
        """Rows and the place before (0) or after (1) them on one wire of their pair, if its foot is near, (2, m)."""
        other = self._wires[:, 1 - side]
        places = np.flatnonzero((self._spacing > 0) & (self._own == side))
        numbers = np.floor(self._ordinal[:, side]).astype(int)
        key = self._key(numbers, side)[places]
        order = np.argsort(key, kind="stable")
        places, key = places[order], key[order]
        wanted = self._key(numbers + further, side)
        first, last = np.searchsorted(key, wanted, "left"), np.searchsorted(key, wanted, "right")
        count = last - first
        row = np.repeat(np.arange(len(count)), count)
        found = places[np.arange(len(row)) + np.repeat(first - np.cumsum(count) + count, count)]
        apart = np.abs(self._arc[row, 1 - side] - self._arc[found, 1 - side])
        apart = np.minimum(apart, np.abs(self._length[other[row]] - apart))
        near = apart <= _REACH * self._spacing[found]
        return np.stack([row[near], found[near]])

    def _key(self, number: np.ndarray, side: int) -> np.ndarray:
        """A number for each place of each pair of wires."""
        number = number % self._total[self._wires[:, side]]
        return self._pair * (int(self._ordinal.max()) + 3) + number


def _components(n: int, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """The lowest of the numbers that links join to each of the numbers from 0 to n - 1."""
    label = np.arange(n)
    while True:
        lower = np.minimum(label[first], label[second])
        joined = label.copy()
        # the lowest number of a group stands for all of it, so that groups join as a whole
        np.minimum.at(joined, label[first], lower)
        np.minimum.at(joined, label[second], lower)
        while not np.array_equal(joined, joined[joined]):
            joined = joined[joined]
        if np.array_equal(joined, label):
            return label
        label = joined
