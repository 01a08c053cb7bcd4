"""`*BOUNDARY, TYPE=VELOCITY` of Abaqus as displacements over time: velocities, integrated."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import count, pairwise
from typing import NamedTuple

from ..deck import Card
from ..deck.keyword_table import squeezed
from ..deck.lines import Value
from .loading import PROCEDURES, SUPPORTS
from .mesh_of_cards import MeshOfCards
from .smooth_steps import points_of, write_table

#: Pieces of a parabola, the integral of a line: with these it is off by 1/3200 of what the change of the velocity moves
_PIECES = 20
_ROTATIONS = range(4, 7)

#: Where something is prescribed: node and degree of freedom
_Place = tuple[int, int]
#: Total times and factors
_Table = list[tuple[float, float]]


class _Row(NamedTuple):
    """A line of `*BOUNDARY`."""

    #: Node or set, as the line has it
    target: Value
    #: Its nodes
    nodes: list[int]
    #: Degrees of freedom
    dofs: list[int]
    #: Velocity or displacement
    value: float


class _Moving(NamedTuple):
    """Nodes of a line that move alike along a degree of freedom, from where they are when the step begins."""

    #: Node or set that the new line has
    target: Value
    #: Its nodes
    nodes: list[int]
    #: Degree of freedom
    dof: int
    #: Velocity
    value: float
    #: Displacement when the step begins
    start: float


class _Refused(Exception):
    """A velocity that no displacement can be written for."""


@dataclass
class _Motion:
    """What has been prescribed so far."""

    mesh: MeshOfCards
    begin: float = 0.0
    end: float = 0.0
    is_first: bool = True
    #: Displacement at each place as a function of the total time
    known: dict[_Place, Callable[[float], float]] = field(default_factory=dict)
    #: Axes about which each node has been turned
    turned: dict[int, set[int]] = field(default_factory=dict)

    def at(self, place: _Place) -> float:
        """Displacement where the step begins."""
        if place in self.known:
            return self.known[place](self.begin)
        if self.is_first:
            return 0.0
        raise _Refused(f"how far node {place[0]} has moved along {place[1]} when the step begins is not known")

    def turn(self, row: _Row) -> None:
        """Remember the axes about which a line turns its nodes."""
        for node in row.nodes if row.value else ():
            self.turned.setdefault(node, set()).update(set(row.dofs) & set(_ROTATIONS))


def velocities_as_displacements(cards: list[Card]) -> Iterator[tuple[str, bool]]:
    """Write displacements in place of velocities: what is to be said of each card, and whether it is left as it is.

    Source: Abaqus, *BOUNDARY: in a static step a velocity without an amplitude is there at once. One that is not changed
    goes on in the steps that follow, as it was at the end of the step where its amplitude is over the time of the step.
    """
    if not any(_is_velocity(card) for card in cards):
        return
    tables = {squeezed(str(card.get("NAME", ""))): card for card in cards if card.is_a("AMPLITUDE")}
    motion, whole, durations, new = (
        _Motion(MeshOfCards(cards)),
        sum(_durations(cards)),
        _durations(cards),
        _names(tables),
    )
    amplitudes: list[Card] = []
    in_step = False
    for card in list(cards):
        if card.is_a("STEP"):
            in_step = True
            motion.begin, motion.is_first = motion.end, motion.end == 0
            motion.end += next(durations)
        elif card.is_a("BOUNDARY") and _is_velocity(card) and in_step:
            try:
                of_card, written = _as_displacements(card, motion, tables, whole, new)
            except _Refused as reason:
                yield f"TYPE=VELOCITY of *BOUNDARY: {reason}; write a displacement over time, by *AMPLITUDE", True
                continue
            amplitudes += of_card
            place = next(i for i, one in enumerate(cards) if one is card)
            written[0].comments = card.comments
            cards[place : place + 1] = written
            yield _told(of_card, card), False
        elif card.is_a("BOUNDARY"):
            _follow(card, motion, tables)
    first = next(i for i, card in enumerate(cards) if card.is_a("STEP"))
    cards[first:first] = amplitudes


def _told(amplitudes: list[Card], card: Card) -> str:
    names = ", ".join(str(one["NAME"]) for one in amplitudes)
    text = "TYPE=VELOCITY of *BOUNDARY is a displacement" + (
        f" that follows *AMPLITUDE, NAME={names}" if names else " of 0"
    )
    if "AMPLITUDE" not in card or not names:
        return text
    return f"{text}, with {_PIECES} pieces where the velocity changes; increments end at their ends"


def _is_velocity(card: Card) -> bool:
    return card.is_a("BOUNDARY") and str(card.get("TYPE", "")).upper() == "VELOCITY"


def _names(taken: dict[str, Card]) -> Iterator[str]:
    return (f"VELOCITY_{i}" for i in count(1) if squeezed(f"VELOCITY_{i}") not in taken)


def _durations(cards: list[Card]) -> Iterator[float]:
    """Times of the steps; 0: the procedure is another one."""
    steps = [i for i, card in enumerate(cards) if card.is_a("STEP")]
    for first, stop in pairwise([*steps, len(cards)]):
        procedure = next((card for card in cards[first:stop] if any(map(card.is_a, PROCEDURES))), None)
        values = [] if procedure is None else [*(procedure.data or [[]])[0], None, None]
        yield 0.0 if procedure is None else float(values[1] or 1.0)


def _rows(card: Card, mesh: MeshOfCards) -> Iterator[_Row]:
    """Nodes, degrees of freedom and value of each line."""
    for row in card.data:
        target = row[0]
        first, last, value = [*row[1:4], None, None, None][:3]
        if isinstance(first, str):
            yield _Row(target, mesh.nodes(target), list(SUPPORTS.get(first.upper(), ())), 0.0)
        else:
            dofs = range(int(first or 0), int(last or first or 0) + 1)
            yield _Row(target, mesh.nodes(target), list(dofs), float(value or 0.0))


def _follow(card: Card, motion: _Motion, tables: dict[str, Card]) -> None:
    """Remember displacements that are prescribed."""
    if str(card.get("OP", "")).upper() == "NEW":
        motion.known = {}
    for row in _rows(card, motion.mesh):
        motion.turn(row)
        for place in ((node, dof) for node in row.nodes for dof in row.dofs):
            if "FIXED" in card:
                if place in motion.known or motion.is_first:
                    motion.known[place] = _constant(motion.at(place))
                continue
            try:
                motion.known[place] = _displacement(card, row.value, motion, tables)
            except _Refused:
                motion.known.pop(place, None)


def _constant(value: float) -> Callable[[float], float]:
    return lambda _: value


def _displacement(card: Card, value: float, motion: _Motion, tables: dict[str, Card]) -> Callable[[float], float]:
    """Of a card that prescribes displacements, at the ends of steps."""
    if "AMPLITUDE" not in card:
        return _constant(value)
    table, is_total = _table_of(card, tables)
    begin, end = motion.begin, motion.end
    return lambda time: value * _factor(table, time if is_total else min(time, end) - begin)


def _table_of(card: Card, tables: dict[str, Card]) -> tuple[_Table, bool]:
    """Table of the amplitude of a card, and whether it is over the total time."""
    amplitude = tables.get(squeezed(str(card["AMPLITUDE"])))
    if amplitude is None or any(name in amplitude for name in ("DEFINITION", "SMOOTH", "VALUE")):
        raise _Refused(f"its *AMPLITUDE, NAME={card['AMPLITUDE']} is no table")
    points = points_of(amplitude)
    if not points or any(before >= after for (before, _), (after, _) in pairwise(points)):
        raise _Refused(f"the times of *AMPLITUDE, NAME={card['AMPLITUDE']} do not rise")
    return points, str(amplitude.get("TIME", "")).upper().startswith("TOTAL")


def _factor(table: _Table, time: float) -> float:
    """Linear between the points and constant beyond them."""
    if time <= table[0][0]:
        return table[0][1]
    for (t0, a0), (t1, a1) in pairwise(table):
        if time <= t1:
            return a0 + (a1 - a0) * (time - t0) / (t1 - t0)
    return table[-1][1]


def _as_displacements(
    card: Card, motion: _Motion, tables: dict[str, Card], whole: float, new: Iterator[str]
) -> tuple[list[Card], list[Card]]:
    """Amplitudes, and the cards that follow them."""
    if motion.end <= motion.begin:
        raise _Refused("the step has no time")
    rows = list(_rows(card, motion.mesh))
    _check_rotations(rows, motion)
    path = _integrated(card, motion, tables, whole)
    moving = [one for row in rows if row.value for dof in row.dofs for one in _moving(row, dof, motion)]
    held: list[list[Value]] = [[row.target, row.dofs[0], row.dofs[-1]] for row in rows if not row.value]
    amplitudes, written = [], []
    if any(not one.start for one in moving):
        amplitudes.append(_amplitude(next(new), path))
        data = [[one.target, one.dof, one.dof, one.value] for one in moving if not one.start]
        written.append(Card.make("BOUNDARY", {"AMPLITUDE": amplitudes[0]["NAME"]}, data))
    for one in moving:
        if one.start:
            amplitudes.append(_amplitude(next(new), [(time, one.start + one.value * part) for time, part in path]))
            parameters = {"AMPLITUDE": amplitudes[-1]["NAME"]}
            written.append(Card.make("BOUNDARY", parameters, [[one.target, one.dof, one.dof, 1.0]]))
    if held:
        # what is not to move stays where it is
        written.append(Card.make("BOUNDARY", {} if motion.is_first else {"FIXED": True}, held))
    _follow(Card.make("BOUNDARY", {"FIXED": True}, held), motion, tables)
    if "OP" in card:
        written[0]["OP"] = card["OP"]
        if str(card["OP"]).upper() == "NEW":
            motion.known = {}
    for row in rows:
        motion.turn(row)
    for one in moving:
        motion.known |= {(node, one.dof): _moved(one.start, one.value, path) for node in one.nodes}
    return amplitudes, written


def _moving(row: _Row, dof: int, motion: _Motion) -> Iterator[_Moving]:
    """What a line moves along a degree of freedom: all its nodes, or node by node where these begin at several places."""
    starts = [motion.at((node, dof)) for node in row.nodes]
    if len(set(starts)) == 1:
        yield _Moving(row.target, row.nodes, dof, row.value, starts[0])
        return
    for node, start in zip(row.nodes, starts, strict=True):
        yield _Moving(node, [node], dof, row.value, start)


def _moved(start: float, value: float, path: _Table) -> Callable[[float], float]:
    return lambda time: start + value * _factor(path, time)


def _check_rotations(rows: list[_Row], motion: _Motion) -> None:
    turning: dict[int, set[int]] = {}
    for row in rows:
        if not row.nodes:
            raise _Refused(f"there is no node or node set {row.target}")
        if not row.dofs or not set(row.dofs) <= set(range(1, 7)):
            raise _Refused("velocities are of the degrees of freedom 1 to 6")
        for node in row.nodes if row.value else ():
            turning.setdefault(node, set()).update(set(row.dofs) & set(_ROTATIONS))
    for node, axes in turning.items():
        if axes and len(axes | motion.turned.get(node, set())) > 1:
            raise _Refused(f"node {node} turns about several axes, whose angles do not add up")


def _integrated(card: Card, motion: _Motion, tables: dict[str, Card], whole: float) -> _Table:
    """The integral of the amplitude over the total time, from where the step begins to the end of all steps."""
    begin, end = motion.begin, motion.end
    if "AMPLITUDE" not in card:
        return [(begin, 0.0), (whole, whole - begin)]
    table, is_total = _table_of(card, tables)
    shift, last = (0.0, whole) if is_total else (begin, end)
    times = [begin, *(t + shift for t, _ in table if begin < t + shift < last), last]
    path, moved = [(begin, 0.0)], 0.0
    for t0, t1 in pairwise(times):
        before, after = (_factor(table, t - shift) for t in (t0, t1))
        pieces = 1 if before == after else _PIECES
        for i in range(1, pieces + 1):
            since = (t1 - t0) * i / pieces
            path.append((t0 + since, moved + before * since + (after - before) * since**2 / (2 * (t1 - t0))))
        moved = path[-1][1]
    if last < whole:
        path.append((whole, moved + _factor(table, end - shift) * (whole - last)))
    return path


def _amplitude(name: str, path: _Table) -> Card:
    card = Card.make("AMPLITUDE", {"NAME": name, "TIME": "TOTAL TIME"}, [])
    write_table(card, (float(f"{value:.12g}") for point in path for value in point))
    return card
