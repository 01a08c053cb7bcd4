"""Straight wires in a plane, seen from above: how they are drawn at random, where they cross, how near their ends come."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..kernels import contact_search

#: Pieces by which near wires are found are this many mean distances of crossings along a wire
_PIECE = 4.0
#: Rounds in which ends are moved away from other wires
_ROUNDS = 4


@dataclass(frozen=True)
class Crossings:
    """Pairs of wires that cross, or whose ends come near to the other wire.

    Attributes
    ----------
    wires : (k, 2) array of int
        Both wires, the one that was dropped first in front.
    at : (k, 2) array
        Where they cross, or come nearest to each other, as a part of the length of each.
    sine, cosine : (k) arrays
        Of the angle between their directions.
    crosses : (k) array of bool
        They cross.
    end_distance : (k) array
        Smallest distance of an end of one from the other [m].
    """

    wires: NDArray[np.int64]
    at: NDArray[np.float64]
    sine: NDArray[np.float64]
    cosine: NDArray[np.float64]
    crosses: NDArray[np.bool_]
    end_distance: NDArray[np.float64]

    def where(self, mask: NDArray | slice) -> Crossings:
        """The pairs for which a mask (k) is true, or those it names."""
        return Crossings(*(getattr(self, name)[mask] for name in self.__dataclass_fields__))


def spread(
    found: Crossings, lengths: NDArray, which: NDArray[np.bool_], width: float, step: float
) -> tuple[Crossings, NDArray]:
    """Pairs of which some stand for more than one place: all along the stretch in which the wires are near, seen from above.

    Parameters
    ----------
    found : Crossings
        Pairs of wires.
    lengths : (n) array
        Lengths of the wires [m].
    which : (k) array of bool
        The pairs that are spread.
    width, step : float
        Distance in which wires are near, and largest distance of the places along the later wire [m].

    Returns
    -------
    Crossings, ndarray
        The pairs, those that are spread several times; and the row of `found` of each.
    """
    stretch = width / np.maximum(np.abs(found.sine), width / lengths[found.wires[:, 1]])
    n_steps = np.where(which, np.ceil(stretch / step).astype(int), 0)
    row = np.repeat(np.arange(len(n_steps)), 2 * n_steps + 1)
    first = np.cumsum(2 * n_steps + 1) - (2 * n_steps + 1)
    place = (np.arange(len(row)) - first[row]) - n_steps[row]
    offset = place * stretch[row] / np.maximum(n_steps[row], 1)
    many = found.where(row)
    shift = np.stack([offset * many.cosine, offset], axis=1) / lengths[many.wires]
    return replace(many, at=np.clip(many.at + shift, 0, 1)), row


def draw(rng: np.random.Generator, count: int, size: NDArray, length: float) -> NDArray[np.float64]:
    """Ends (count, 2, 2) of wires whose middles and directions are uniform, cut off at the edges of a rectangle."""
    numbers = rng.uniform(size=(count, 3))
    middle, angle = numbers[:, :2] * size, math.pi * numbers[:, 2]
    half = length / 2 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    with np.errstate(divide="ignore"):
        walls = np.sort([-middle / half, (size - middle) / half], axis=0)
    first, last = np.maximum(-1.0, walls[0].max(axis=1)), np.minimum(1.0, walls[1].min(axis=1))
    return np.clip([middle + first[:, None] * half, middle + last[:, None] * half], 0, size).transpose(1, 0, 2)


def find_crossings(ends: NDArray, near: float, first_new: int = 0) -> Crossings:
    """Pairs of wires that come nearer than `near` to each other, sorted by the later wire; the later one is a new one.

    Parameters
    ----------
    ends : (n, 2, 2) array
        Ends of the wires [m], in the order in which they were dropped.
    near : float
        Distance [m].
    first_new : int
        The wires before this one are not compared with each other.
    """
    pairs = _near_pairs(ends, near)
    pairs = pairs[pairs[:, 1] >= first_new]
    pairs = pairs[np.lexsort((pairs[:, 0], pairs[:, 1]))]
    (a, b), (c, d) = (ends[pairs[:, side]].transpose(1, 0, 2) for side in (0, 1))
    u, v = b - a, d - c
    turn, along = cross(u, v), np.sum(u * v, axis=1)
    lengths = np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1)
    safe = np.where(turn == 0, 1.0, turn)
    at = np.stack([cross(c - a, v) / safe, cross(c - a, u) / safe], axis=1)
    crosses = (turn != 0) & ((at > 0) & (at < 1)).all(axis=1)
    # of each end its foot on the other wire, and its distance
    feet = [_foot(point, *wire) for point, wire in ((a, (c, d)), (b, (c, d)), (c, (a, b)), (d, (a, b)))]
    distance = np.stack([one[1] for one in feet], axis=1)
    nearest = distance.argmin(axis=1)
    zero, one = np.zeros(len(pairs)), np.ones(len(pairs))
    places = np.stack([[zero, feet[0][0]], [one, feet[1][0]], [feet[2][0], zero], [feet[3][0], one]])
    at = np.where(crosses[:, None], at, places[nearest, :, np.arange(len(pairs))])
    found = Crossings(pairs, at, turn / lengths, along / lengths, crosses, distance.min(axis=1))
    return found.where(crosses | (found.end_distance < near))


def move_ends(
    ends: NDArray, held: NDArray[np.bool_], size: NDArray, *,
    margin: float, reach: float, shortest: float, n_others: int | None = None,
) -> NDArray[np.float64]:  # fmt: skip
    """Wires that are a little shorter or longer, so that no end is nearer than a margin to another wire, where possible.

    An end stays on its line and takes the nearest free place, so that what a wire crosses hardly changes.

    Parameters
    ----------
    ends : (n, 2, 2) array
        Ends of the wires [m].
    held : (n, 2) array of bool
        Ends that stay where they are.
    size : (2,) array
        Sides of the rectangle that no end leaves [m].
    margin : float
        Smallest distance of an end from the other wires [m].
    reach : float
        Largest distance by which an end is moved [m].
    shortest : float
        Length that a wire keeps at least [m].
    n_others : int, optional
        Ends are moved away from the first so many wires only; from all when left out.
    """
    ends = ends.copy()
    for _ in range(_ROUNDS):
        pairs = _near_pairs(ends, margin + reach)
        both = np.concatenate([pairs, pairs[:, ::-1]])
        both = both if n_others is None else both[both[:, 1] < n_others]
        moved = False
        for which in (0, 1):
            outward = ends[:, which] - ends[:, 1 - which]
            length = np.linalg.norm(outward, axis=1)
            outward /= length[:, None]
            room = _room(ends[:, which], outward, size)
            free = ~held[both[:, 0], which]
            wire, other = both[free].T
            low, high = _forbidden(ends[wire, which], outward[wire], ends[other, 0], ends[other, 1], margin)
            shift = _shifts(wire, low, high, np.stack([shortest - length, room]), reach)
            ends[:, which] += shift[:, None] * outward
            moved |= bool(shift.any())
        if not moved:
            break
    return ends


def _shifts(wire: NDArray, low: NDArray, high: NDArray, limits: NDArray, reach: float) -> NDArray[np.float64]:
    """How far one end of each wire has to be moved, (n) [m]; 0 where it is free, or no place is.

    Parameters
    ----------
    wire, low, high : (k) arrays
        Wires, and the begin and end of a part of the line of each that is not free, from the end of the wire [m].
    limits : (2, n) array
        Between which values the shift of each wire has to be [m].
    reach : float
        Largest size of a shift [m].
    """
    there = (low < reach) & (high > -reach)
    wire, low, high = wire[there], low[there], high[there]
    blocked = np.unique(wire[(low < 0) & (high > 0)])
    order = np.lexsort((low, wire))
    wire, low, high = wire[order], low[order], high[order]
    begins, stops = np.searchsorted(wire, blocked), np.searchsorted(wire, blocked, side="right")
    shifts = np.zeros(limits.shape[1])
    for one, begin, stop in zip(blocked.tolist(), begins.tolist(), stops.tolist(), strict=True):
        shortest, room = limits[:, one]
        bounds = max(shortest, -reach), min(room, reach)
        shifts[one] = _nearest_free(low[begin:stop].tolist(), high[begin:stop].tolist(), bounds)
    return shifts


def _room(point: NDArray, along: NDArray, size: NDArray) -> NDArray[np.float64]:
    """Distance from points to the edge of the rectangle in given directions, (n) [m]."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ways = np.where(along > 0, (size - point) / along, np.where(along < 0, -point / along, np.inf))
    return ways.min(axis=1)


def _forbidden(point: NDArray, along: NDArray, start: NDArray, end: NDArray, margin: float) -> tuple[NDArray, NDArray]:
    """Begin and end of the part of each line `point + t along` that is nearer than a margin to a segment; inf, -inf: none."""
    length = np.linalg.norm(end - start, axis=1)
    axis, gap = (end - start) / length[:, None], point - start
    with np.errstate(divide="ignore", invalid="ignore"):
        strip = np.sort((np.array([[-margin], [margin]]) - cross(axis, gap)) / cross(axis, along), axis=0)
        slab = np.sort(
            ([np.zeros(len(length)), length] - np.sum(axis * gap, axis=1)) / np.sum(axis * along, axis=1), axis=0
        )
        low, high = np.fmax(strip[0], slab[0]), np.fmin(strip[1], slab[1])
        parts = [np.where(low < high, [low, high], [[np.inf], [-np.inf]])]
        for corner in (start, end):
            apart = point - corner
            half = np.sqrt(margin**2 - cross(along, apart) ** 2)
            middle = -np.sum(along * apart, axis=1)
            parts.append(np.where(half > 0, [middle - half, middle + half], [[np.inf], [-np.inf]]))
    return np.min([part[0] for part in parts], axis=0), np.max([part[1] for part in parts], axis=0)


def _nearest_free(low: list[float], high: list[float], bounds: tuple[float, float]) -> float:
    """The place nearest to 0, within bounds, outside of intervals that are sorted by their begins; 0 if there is none."""
    candidates, top = [low[0]], -math.inf
    for begin, end in zip(low, high, strict=True):
        if begin > top > -math.inf:
            candidates += [top, begin]
        top = max(top, end)
    candidates.append(top)
    # a hair beyond the edge of an interval, so that round-off does not bring it back
    hair = 1e-9 * (bounds[1] - bounds[0])
    allowed = [place for place in candidates if bounds[0] + hair < place < bounds[1] - hair]
    nearest = min(allowed, key=abs, default=0.0)
    return nearest + math.copysign(hair, nearest) if allowed else 0.0


def _near_pairs(ends: NDArray, near: float) -> NDArray[np.int64]:
    """Pairs of wires nearer than a distance, each once, the smaller number first; wires are divided into pieces for it."""
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    area = np.prod(np.ptp(ends.reshape(-1, 2), axis=0))
    piece = _PIECE * max(math.pi * area / (2 * max(lengths.sum(), np.finfo(float).tiny)), near)
    n_pieces = np.maximum(1, np.ceil(lengths / piece)).astype(int)
    wire = np.repeat(np.arange(len(ends)), n_pieces)
    first = np.arange(len(wire)) - np.repeat(np.cumsum(n_pieces) - n_pieces, n_pieces)
    parts = np.stack([first, first + 1], axis=1)[..., None] / n_pieces[wire][:, None, None]
    points = np.zeros((2 * len(wire), 3))
    points[:, :2] = (ends[wire, None, 0] + parts * (ends[wire, None, 1] - ends[wire, None, 0])).reshape(-1, 2)
    rows = np.arange(2 * len(wire)).reshape(-1, 2)
    found = wire[contact_search(points, rows, np.full(len(wire), near / 2))]
    found = np.sort(found[found[:, 0] != found[:, 1]], axis=1)
    keys = np.unique(found[:, 0] * len(ends) + found[:, 1])
    return np.stack(np.divmod(keys, len(ends)), axis=1)


def _foot(point: NDArray, start: NDArray, end: NDArray) -> tuple[NDArray, NDArray]:
    """The nearest place of segments to points, as a part of their lengths, and its distance."""
    along = end - start
    part = np.clip(np.sum((point - start) * along, axis=1) / np.sum(along * along, axis=1), 0, 1)
    return part, np.linalg.norm(point - start - part[:, None] * along, axis=1)


def cross(u: NDArray, v: NDArray) -> NDArray[np.float64]:
    """Component of the cross products of vectors (n, 2) normal to the plane."""
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
