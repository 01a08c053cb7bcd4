"""Straight wires dropped at random on a plane, one after the other: where they lie, and at which heights."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..model import Interaction, Model, straight
from .draping import Below, Pile, n_elements_of
from .frame import electrodes_at_walls, hold_ends
from .geometry import rounded, smallest_gap
from .planar import Crossings, draw, find_crossings, move_ends, spread

#: Random wires tried for each wire before they count as too many
_TRIES = 400
#: Ends are moved by this part of the length of a wire at most
_LARGEST_MOVE = 0.1
#: Shortest reach [radii], attempts to lay wires without overlap, and pieces per element in which it is looked for
_SHORTEST_REACH, _MAX_LAID, _PARTS = 10.0, 8, 2
#: Longest reach [lengths of wires]: stiffer wires are level but for round-off
_LONGEST_REACH = 1000.0
#: Part of the clearance by which wires that touch may be nearer than it
SLACK = 0.25
#: Elements of level wires
DEFAULT_ELEMENTS = 12
#: Wires are drawn in batches of at least this many
_BATCH = 64


@dataclass(frozen=True)
class Rules:
    """What wires must keep.

    Attributes
    ----------
    size : (2,) array
        Sides of the rectangle [m].
    length, radius : float
        Of the wires [m].
    smallest_angle : float
        Angle at which they cross at least [rad].
    margin : float
        Distance of the ends from other wires, seen from above [m].
    """

    size: NDArray
    length: float
    radius: float
    smallest_angle: float
    margin: float

    @property
    def shortest(self) -> float:
        """What the edges leave of a wire at least [m]: it reaches beyond a crossing at both sides."""
        return 2 * self.margin

    def is_held(self, ends: NDArray) -> NDArray[np.bool_]:
        """Ends (n, 2, 2) at the electrodes, which stay there, (n, 2)."""
        x = ends[..., 0]
        return (x <= 0) | (x >= self.size[0])


@dataclass(frozen=True)
class Layout:
    """Wires in the plane.

    Attributes
    ----------
    ends : (n, 2, 2) array
        Their ends [m], in the order in which they were dropped.
    crossings : Crossings
        Where they cross.
    """

    ends: NDArray[np.float64]
    crossings: Crossings


def drop(rng: np.random.Generator, n_wires: int, rules: Rules) -> Layout:
    """Wires on a plane that keep the rules wherever they cross, seen from above.

    An end near another wire is moved along its own line. A wire that crosses an earlier one at too small an angle, or whose end
    finds
    no free place, is drawn anew.
    """
    ends = np.empty((0, 2, 2))
    n_drawn, share = 0, 1.0
    while len(ends) < n_wires:
        count = min(math.ceil(1.05 * (n_wires - len(ends)) / share) + _BATCH, _TRIES * n_wires - n_drawn)
        if count <= 0:
            raise ValueError(
                f"only {len(ends)} of {n_wires} wires fit into the film with crossings of the smallest angle, away from "
                "their ends"
            )
        n_drawn += count
        together = _keep(np.concatenate([ends, _drawn(rng, count, rules)]), len(ends), rules, with_ends=False)
        together = _with_free_ends(together, rules.is_held(together), rules)
        together = _keep(together, 0, rules, with_ends=True)
        share = max(0.05, (len(together) - len(ends)) / count)
        ends = together[:n_wires]
    crossings = find_crossings(ends, rules.margin)
    return Layout(ends, crossings.where(crossings.crosses))


def _drawn(rng: np.random.Generator, count: int, rules: Rules) -> NDArray[np.float64]:
    """Random wires of which the edges leave enough."""
    ends = draw(rng, count, rules.size, rules.length)
    return ends[np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) >= rules.shortest]


def _with_free_ends(ends: NDArray, held: NDArray, rules: Rules, n_others: int | None = None) -> NDArray[np.float64]:
    """Wires whose ends have been moved away from others, of which the first so many count, but for those that are held."""
    reach = _LARGEST_MOVE * rules.length
    return move_ends(
        ends, held, rules.size, margin=rules.margin, reach=reach, shortest=rules.shortest, n_others=n_others
    )


def _keep(ends: NDArray, first_new: int, rules: Rules, *, with_ends: bool) -> NDArray[np.float64]:
    """The wires without those that break a rule together with an earlier one that is kept."""
    found = find_crossings(ends, rules.margin, first_new)
    wrong = found.crosses & (np.abs(found.sine) < math.sin(rules.smallest_angle))
    if with_ends:
        wrong |= found.end_distance < rules.margin * (1 - 1e-6)
    kept = np.ones(len(ends), dtype=bool)
    for first, second in found.wires[wrong].tolist():
        kept[second] &= not kept[first]
    return ends[kept]


@dataclass(frozen=True)
class Piled:
    """Wires that lie on each other.

    Attributes
    ----------
    axes : list of (m, 3) array
        Nodes of each wire [m].
    n_crossings, n_touching : int
        Number of crossings, and of those at which wires touch.
    """

    axes: list[NDArray[np.float64]]
    n_crossings: int
    n_touching: int


def pile_up(layout: Layout, distance: float, slack: float, reach: float | None, n_elements: int | None) -> Piled:
    """Wires that lie on those dropped before them.

    Parameters
    ----------
    layout : Layout
        The wires in the plane.
    distance, slack : float
        Distance of the axes of wires that touch, and by how much it may be missed [m].
    reach : float, optional
        Length over which a wire bends down [m]; None: wires are level.
    n_elements : int, optional
        Elements of each wire; left out: as many as are not longer than half the reach.
    """
    lengths = np.linalg.norm(layout.ends[:, 1] - layout.ends[:, 0], axis=1)
    number = np.arange(len(lengths))
    first = np.searchsorted(layout.crossings.wires[:, 1], np.arange(len(lengths) + 1))
    pile = Pile(distance, reach, slack)
    for wire, length in enumerate(lengths.tolist()):
        below = _below(layout.crossings.where(slice(first[wire], first[wire + 1])), lengths, number)
        pile.lay(length, _n_elements(length, reach, n_elements), below)
    return _piled(layout.ends, pile)


def deposit(
    rng: np.random.Generator, n_wires: int, rules: Rules, *,
    distance: float, slack: float, reach: float, n_elements: int | None,
) -> Piled:  # fmt: skip
    """Wires that are dropped one after the other and bend over those below; rules hold where wires come near.

    A wire is drawn anew only if it would rest on another one at too small an angle, or on or under an end: what lies deeper is
    of no concern.
    """
    pile, placed = Pile(distance, reach, slack), np.empty((0, 2, 2))
    n_drawn, share = 0, 1.0
    while len(placed) < n_wires:
        # what is drawn together costs as much whether it is needed or not
        wanted = math.ceil((n_wires - len(placed)) / share) + _BATCH
        count = min(wanted, n_wires + _BATCH, _TRIES * n_wires - n_drawn)
        if count <= 0:
            raise ValueError(
                f"only {len(placed)} of {n_wires} fibres come to lie on others at the smallest angle, away from their ends"
            )
        n_drawn += count
        together = np.concatenate([placed, _drawn(rng, count, rules)])
        held = rules.is_held(together)
        held[: len(placed)] = True
        together = _with_free_ends(together, held, rules, n_others=len(placed))
        lengths = np.linalg.norm(together[:, 1] - together[:, 0], axis=1)
        found = find_crossings(together, rules.margin, len(placed))
        wrong = ~found.crosses | (np.abs(found.sine) < math.sin(rules.smallest_angle))
        wrong |= found.end_distance < rules.margin
        found, of = spread(found, lengths, wrong, 2 * distance, reach / 2)
        wrong = wrong[of]
        first = np.searchsorted(found.wires[:, 1], np.arange(len(together) + 1))
        # the number of each wire in the pile, -1 for those that are not laid
        number = np.full(len(together), -1)
        number[: len(placed)] = np.arange(len(placed))
        for wire in range(len(placed), len(together)):
            rows = np.arange(first[wire], first[wire + 1])
            rows = rows[number[found.wires[rows, 0]] >= 0]
            below = _below(found.where(rows), lengths, number)
            n_laid = pile.n_wires
            if pile.lay(lengths[wire], _n_elements(lengths[wire], reach, n_elements), below, wrong[rows]):
                number[wire] = n_laid
            if n_laid + 1 == n_wires and number[wire] >= 0:
                break
        share = max((pile.n_wires - len(placed)) / count, 1 / _TRIES)
        placed = together[number >= 0]
    return _piled(placed, pile)


def _piled(placed: NDArray, pile: Pile) -> Piled:
    axes = [_nodes(ends, heights) for ends, heights in zip(placed, pile.heights, strict=True)]
    return Piled(axes, pile.n_crossings, pile.n_touching)


def _below(found: Crossings, lengths: NDArray, number: NDArray) -> Below:
    """What one wire crosses, with the numbers of the wires in the pile."""
    wires, at = found.wires[:, 0], found.at
    return Below(number[wires], at[:, 0], at[:, 1], found.cosine, lengths[wires])


def _n_elements(length: float, reach: float | None, n_elements: int | None) -> int:
    if n_elements is not None:
        return n_elements
    return DEFAULT_ELEMENTS if reach is None else n_elements_of(length, reach / 2)


def _nodes(ends: NDArray, heights: NDArray) -> NDArray[np.float64]:
    """Nodes of a wire over its line in the plane."""
    nodes = straight([*ends[0], 0.0], [*ends[1], 0.0], len(heights) - 1)
    nodes[:, 2] = heights
    return nodes


def check_reach(reach: float | None, radius: float, length: float) -> None:
    """Refuse a length over which wires would bend too sharply for beams, or not at all."""
    if reach is not None and not _SHORTEST_REACH * radius <= reach <= _LONGEST_REACH * length:
        raise ValueError(
            f"reach must be at least {_SHORTEST_REACH:g} radii, {_SHORTEST_REACH * radius:g} m, and at most"
            f" {_LONGEST_REACH:g} lengths, {_LONGEST_REACH * length:g} m, not {reach:g} m; without it wires are level"
        )


def build(
    title: str, group: str, pile: Callable[[float], Piled], *, clearance: float, length: float, rounding: float,
    interaction: Interaction, **wires: Any,
) -> Model:  # fmt: skip
    """The model of wires that lie on each other, with gaps that are enlarged until none overlap.

    Parameters
    ----------
    title, group : str
        Title of the model and name of its wires.
    pile : callable
        The wires for a gap between those that touch.
    clearance : float
        That gap [m].
    length : float
        Where the wires end at the electrode PLUS [m].
    rounding : float
        Size by which coordinates are rounded [m].
    interaction : Interaction
        The laws of contact.
    **wires
        As those of `Model.wires`.
    """
    gap = clearance
    for _ in range(_MAX_LAID):
        piled = pile(gap)
        model = Model(title)
        model.wires(group, [rounded(axis, rounding) for axis in piled.axes], **wires)
        bent = any(np.ptp(axis[:, 2]) > 0 for axis in piled.axes)
        # level wires have their distances by construction
        found = smallest_gap(model, within=clearance, parts=_PARTS) if bent else clearance
        if found >= clearance / 8:
            break
        gap += clearance - found
    else:
        raise ValueError(
            f"wires that bend so sharply overlap by {-found:.3g} m: choose a longer reach, or straighter crossings"
        )
    model.comments.append(f"{piled.n_touching} of {piled.n_crossings} crossings touch, up to the clearance")
    model.height = float(model.x[:, 2].max())
    hold_ends(model, group, model.height)
    electrodes_at_walls(model, group, length)
    model.contact(group, interaction=interaction)
    return model
