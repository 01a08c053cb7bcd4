"""Zones of contact along lines as lines through their places."""

from dataclasses import dataclass

import numpy as np

from .contact_places import ContactPlaces
from .contact_zones import per_length, stretch_along
from .result_file import ResultFile

#: Points that a picture shows
MAX_POINTS = 20_000


@dataclass(frozen=True, eq=False)
class ZoneLines:
    """Lines through the places of the zones of an increment.

    Attributes
    ----------
    rows : (n,) array of int
        Row of the ledger at each point, zone after zone; a ring that touches all around ends where it begins.
    starts : (m + 1,) array of int
        First point of each zone, and n at the end.
    value : (n,) array
        Force per length [N/m].
    has_ends : (m,) array of bool
        The zone has ends: it is not a ring that touches all around.
    """

    rows: np.ndarray
    starts: np.ndarray
    value: np.ndarray
    has_ends: np.ndarray

    @property
    def zone(self) -> np.ndarray:
        """Zone of each point (n)."""
        return np.repeat(np.arange(len(self.has_ends)), np.diff(self.starts))

    @property
    def pieces(self) -> np.ndarray:
        """First and second point of the pieces between the points of the same zone, (p, 2)."""
        first = np.flatnonzero(np.diff(self.zone) == 0)
        return np.stack([first, first + 1], axis=1)

    @property
    def ends(self) -> np.ndarray:
        """First and last point of each zone that has ends, (e, 2)."""
        return np.stack([self.starts[:-1], self.starts[1:] - 1], axis=1)[self.has_ends]


def zone_lines(places: ContactPlaces, max_points: int | None = MAX_POINTS) -> ZoneLines:
    """The lines of an increment; of more places than `max_points` they pass through every second or third one, and so on."""
    on_line = np.flatnonzero((places.zone >= 0) & (places.spacing > 0))
    inside = places.where(on_line)
    n = int(inside.zone.max(initial=-1)) + 1
    # along one of the wires only: places of both would make the line zigzag
    along_second = np.bincount(inside.zone[inside.own == 1], minlength=n) * 2 >= np.bincount(inside.zone, minlength=n)
    stretches = [stretch_along(inside, side) for side in (0, 1)]
    side = along_second.astype(int)
    arc = np.stack([each.arc for each in stretches], axis=1)[np.arange(len(on_line)), side[inside.zone]]
    extent = np.stack([each.extent for each in stretches], axis=1)[np.arange(n), side]
    chosen = np.flatnonzero(inside.own == side[inside.zone])
    order = chosen[np.lexsort((arc[chosen], inside.zone[chosen]))]
    first, last = (np.searchsorted(inside.zone[order], np.arange(n), end) for end in ("left", "right"))
    wire = inside.wires[order[first], side] if n else np.zeros(0, dtype=int)
    has_ends = ~(inside.closed[wire] & (extent == inside.wire_length[wire]))

    every = 1 if max_points is None else max(1, len(order) // max_points)
    kept = (np.arange(len(order)) - first[inside.zone[order]]) % every == 0
    kept[last - 1] = True
    picked = np.concatenate([np.flatnonzero(kept), first[~has_ends]])
    picked = picked[np.argsort(inside.zone[order[picked]], kind="stable")]
    zone = inside.zone[order[picked]]
    value = per_length(inside)["force_per_length"]
    starts = np.append(np.searchsorted(zone, np.arange(n)), len(zone))
    return ZoneLines(on_line[order[picked]], starts, value[order[picked]], has_ends)


def largest_force_per_length(results: ResultFile) -> float:
    """Of all places at all increments [N/m]; 0 where there is no contact along lines."""
    ledger = results.contacts
    if "length" not in ledger:
        return 0.0
    on_line = ledger["length"] > 0
    force = ledger["force"] - ledger.get("end_force", 0.0)
    return float((force[on_line] / ledger["length"][on_line]).max(initial=0.0))
