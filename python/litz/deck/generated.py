"""Nodes and elements that cards of Abaqus generate, copy, or give in other coordinates, written out."""

import itertools
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import FileError, InputError
from .card import Card
from .keyword_table import squeezed
from .lines import Value, data_line, is_comment, line_end
from .placement import cosine_and_sine, placed

#: Parameters that each of them may have here; with others the card stays as it is, and the program refuses it
_TAKEN = {
    "NGEN": ("NSET", "LINE"),
    "NFILL": ("NSET",),
    "NCOPY": ("CHANGE NUMBER", "OLD SET", "NEW SET", "SHIFT", "MULTIPLE"),
    "ELGEN": ("ELSET",),
    "ELCOPY": ("ELEMENT SHIFT", "SHIFT NODES", "OLD SET", "NEW SET"),
    "SYSTEM": (),
}
_NUMBERS_ON_A_LINE = 16


def rewrite(card: Card, rows: Sequence[Sequence[Value]]) -> None:
    """Set the data line by line, so that comments among them stay."""
    places = [i for i, line in enumerate(card.body) if not is_comment(line)]
    for i, row in zip(places, rows, strict=True):
        card.body[i] = data_line(row) + line_end(card.head)


def is_generating(card: Card) -> bool:
    """Whether the card makes nodes or elements from others, or has coordinates that are not Cartesian."""
    return any(card.is_a(name) for name in _TAKEN) or (card.is_a("NODE") and "SYSTEM" in card)


def written_out(cards: Iterable[Card], path: Path | None) -> Iterator[Card]:
    """The cards, with `*NODE` and `*ELEMENT` in place of those that generate what they have.

    Parameters
    ----------
    cards : iterable of Card
        Of a deck, parts and instances among them.
    path : Path or None
        The deck, for messages.

    Raises
    ------
    InputError
        If a card refers to nodes or elements that do not exist, or its values are none.
    """
    cards = list(cards)
    if not any(map(is_generating, cards)):
        yield from cards
        return
    # parts, and instances with a mesh of their own, have numbers of their own
    outer = mesh = _Mesh(path)
    for card in cards:
        if card.is_a("PART") or card.is_a("INSTANCE"):
            mesh = _Mesh(path, in_part=True)
        elif card.is_a("END PART") or card.is_a("END INSTANCE"):
            mesh = outer
        yield from mesh.read(card)


def _taken_by(card: Card) -> tuple[str, ...]:
    """Parameters that are known."""
    return next((taken for name, taken in _TAKEN.items() if card.is_a(name)), ("NSET", "SYSTEM=R", "SYSTEM=C"))


class _Mesh:
    """Nodes, elements and sets so far, and what further cards make of them."""

    def __init__(self, path: Path | None, *, in_part: bool = False):
        self.path, self.in_part = path or Path("deck"), in_part
        self.places: dict[int, NDArray] = {}
        #: Type and nodes by number
        self.elements: dict[int, tuple[str, list[int]]] = {}
        #: Members by kind and name
        self.sets: dict[tuple[str, str], list[int]] = defaultdict(list)
        #: Names of sets whose members keep their order
        self.unsorted: set[str] = set()
        #: Origin and axes (columns) of `*SYSTEM`
        self.axes: tuple[NDArray, NDArray] | None = None
        #: Whether some card stays as it is, whose nodes or elements are not known
        self.lacks_some = False
        self.makers: dict[str, Callable[[Card], list[Card]]] = {
            "NGEN": self._between_nodes,
            "NFILL": self._between_sets,
            "NCOPY": self._copied_nodes,
            "ELGEN": self._rows_of_elements,
            "ELCOPY": self._copied_elements,
            "SYSTEM": self._system,
        }

    def read(self, card: Card) -> list[Card]:
        """What is to stand in place of the card."""
        try:
            made = self._read(card)
            if made and made[0] is card and is_generating(card):
                if self.in_part:
                    # a part without these nodes cannot be placed
                    raise ValueError(f"its parameters may be {', '.join(_taken_by(card))}")
                self.lacks_some = True
            return made
        except (ValueError, TypeError, IndexError, KeyError, FileError) as error:
            if self.lacks_some:
                # the program tells of the first one
                return [card]
            reason = f"there is no number {error}" if isinstance(error, KeyError) else error
            raise InputError(f"*{card.name} cannot be read: {reason}\n --> {self.path}:{card.line}") from None

    def _read(self, card: Card) -> list[Card]:
        name = next((one for one in self.makers if card.is_a(one)), None)
        if name is not None:
            known = {squeezed(one) for one in _taken_by(card)}
            if any(squeezed(parameter) not in known for parameter in card.parameters):
                return [card]
            made = self.makers[name](card)
            if made and made[0] is not card:
                made[0].comments = card.comments
                for one in made:
                    one.line, one.is_generated = card.line, True
                    self._note(one)
            return made
        if card.is_a("NODE"):
            if str(card.get("SYSTEM", "R")).upper() not in ("R", "C"):
                return [card]
            self._make_cartesian(card)
        self._note(card)
        return [card]

    def _note(self, card: Card) -> None:
        """Remember what the card defines."""
        rows = [row for row in card.data if row] if any(map(card.is_a, ("NODE", "ELEMENT", "NSET", "ELSET"))) else []
        kind = "NSET" if card.is_a("NODE") or card.is_a("NSET") else "ELSET"
        members: Iterable[int] = (row[0] for row in rows if isinstance(row[0], int))
        if card.is_a("NODE"):
            self.places |= {_whole(row[0]): _numbers(row[1:4], 3) for row in rows}
        elif card.is_a("ELEMENT"):
            kind_of_element = str(card.get("TYPE", ""))
            self.elements |= {_whole(row[0]): (kind_of_element, [_whole(one) for one in row[1:]]) for row in rows}
        elif card.is_a("NSET") and "ELSET" in card:
            elements = self._members("ELSET", card["ELSET"])
            members = [node for element in elements for node in self.elements.get(element, ("", []))[1]]
        elif "GENERATE" in card:
            ranges = ([one for one in row if isinstance(one, int)] for row in rows)
            members = itertools.chain.from_iterable(range(one[0], one[1] + 1, *one[2:]) for one in ranges)
        else:
            members = [one for row in rows for value in row if value is not None for one in self._members(kind, value)]
        if "UNSORTED" in card:
            self.unsorted.add(squeezed(str(card[kind])))
        if kind in card:
            self.sets[kind, squeezed(str(card[kind]))] += members

    def _members(self, kind: str, value: Value) -> list[int]:
        """The number, or those of a set."""
        there = (kind, squeezed(str(value)))
        return list(self.sets[there]) if there in self.sets else [value] if isinstance(value, int) else []

    def _members_of_set(self, kind: str, value: Value) -> list[int]:
        """Members of a set, in the order of their numbers unless it is `UNSORTED`."""
        found = self._members(kind, value)
        if not found:
            raise ValueError(f"there is no set {value} with members before it")
        return list(dict.fromkeys(found)) if squeezed(str(value)) in self.unsorted else sorted(set(found))

    def _make_cartesian(self, card: Card) -> None:
        """Cylindrical coordinates (radius, angle in degrees, z), and those along the axes of `*SYSTEM`, as global ones."""
        is_cylindrical = str(card.get("SYSTEM", "R")).upper() == "C"
        if is_cylindrical or self.axes is not None:
            rows = card.data
            for row in rows:
                place = _numbers(row[1:4], 3)
                if is_cylindrical:
                    cosine, sine = cosine_and_sine(place[1])
                    place = np.array([place[0] * cosine, place[0] * sine, place[2]])
                if self.axes is not None:
                    place = self.axes[0] + self.axes[1] @ place
                row[1:4] = place.tolist()
            rewrite(card, rows)
        if "SYSTEM" in card:
            del card["SYSTEM"]

    def _system(self, card: Card) -> list[Card]:
        """Axes of the nodes that follow: origin, a point on the first axis, one near the second axis.

        Source: Abaqus, `*SYSTEM`; without the third point z stays, and the first axis is the one projected onto x and y.
        """
        values = [_numbers(row, 6 if i == 0 else 3) for i, row in enumerate(card.data)]
        self.axes = None
        if values:
            origin, first = values[0][:3], values[0][3:] - values[0][:3]
            axes = np.eye(3)
            if sum(value is not None for value in card.data[0]) > 3:
                if len(values) == 1:
                    first[2] = 0
                second = values[1] - origin if len(values) > 1 else np.cross([0, 0, 1], first)
                third = np.cross(first, second)
                if not np.linalg.norm(third) > 0:
                    raise ValueError("its points are on a line")
                axes = np.column_stack([one / np.linalg.norm(one) for one in (first, np.cross(third, first), third)])
            self.axes = origin, axes
        return []

    def _between_nodes(self, card: Card) -> list[Card]:
        """`*NGEN`: nodes at equal distances on a line, a parabola or an arc between two nodes."""
        line = str(card.get("LINE", "")).upper()
        if line not in ("", "P", "C"):
            return [card]
        new: dict[int, list[float]] = {}
        ends: list[int] = []
        for row in card.data:
            first, last, step = _whole(row[0]), _whole(row[1]), _whole((*row, None, None)[2], 1)
            if step == 0 or (last - first) % step or (last - first) // step < 1:
                raise ValueError(f"from {first} to {last} there are no whole steps of {step}")
            count = (last - first) // step
            a, b = self.places[first], self.places[last]
            shares = np.arange(1, count) / count
            third = self._third_point(row) if line else None
            if line == "C" and third is not None:
                new_places = _on_arc(a, b, third, row[7:10], shares)
            else:
                s = shares[:, np.newaxis]
                new_places = a + s * (b - a)
                if third is not None:
                    # quadratic shape functions
                    new_places = (1 - s) * (1 - 2 * s) * a + 4 * s * (1 - s) * third + s * (2 * s - 1) * b
            new |= dict(zip(range(first + step, last, step), new_places.tolist(), strict=True))
            ends += [first, last]
        return self._nodes_with_set(new, card.get("NSET"), ends)

    def _third_point(self, row: list[Value]) -> NDArray:
        number = row[3] if len(row) > 3 else None
        if number:
            return self.places[_whole(number)]
        if self.axes is not None:
            raise ValueError("coordinates of a third point along the axes of *SYSTEM: define it by *NODE")
        return _numbers(row[4:7], 3)

    def _between_sets(self, card: Card) -> list[Card]:
        """`*NFILL`: nodes at equal distances between each two of two sets."""
        new: dict[int, list[float]] = {}
        ends: list[int] = []
        for row in card.data:
            pairs = zip(*(self._members_of_set("NSET", value) for value in row[:2]), strict=False)
            count, step = _whole((*row, None)[2], 1), _whole((*row, None, None)[3], 1)
            for first, last in pairs:
                a, b = self.places[first], self.places[last]
                new |= {first + i * step: (a + i / count * (b - a)).tolist() for i in range(1, count)}
                ends += [first, last]
        return self._nodes_with_set(new, card.get("NSET"), ends)

    def _copied_nodes(self, card: Card) -> list[Card]:
        """`*NCOPY, SHIFT`: a set of nodes, moved; `MULTIPLE` times on."""
        if "SHIFT" not in card:
            return [card]
        numbers = self._members_of_set("NSET", card["OLD SET"])
        places = np.array([self.places[number] for number in numbers])
        change = _whole(card["CHANGE NUMBER"])
        new: dict[int, list[float]] = {}
        for i in range(1, _whole(card.get("MULTIPLE", 1)) + 1):
            places = placed(places, card, self.path)
            new |= {number + i * change: place for number, place in zip(numbers, places.tolist(), strict=True)}
        return self._nodes_with_set(new, card.get("NEW SET"), [])

    def _nodes_with_set(self, new: dict[int, list[float]], name: Value, others: list[int]) -> list[Card]:
        """New nodes that are in a set with others."""
        made = Card.make("NODE", {} if name is None else {"NSET": name}, [[n, *x] for n, x in new.items()])
        cards = [made] if new else []
        if name is not None and others:
            cards.append(_set("NSET", name, others))
        return cards

    def _rows_of_elements(self, card: Card) -> list[Card]:
        """`*ELGEN`: elements of which each has numbers higher than the one before, in rows and layers."""
        new: dict[str, dict[int, list[int]]] = defaultdict(dict)
        masters = []
        for row in card.data:
            master = _whole(row[0])
            kind, nodes = self.elements[master]
            counts = [_whole(value, 1) for value in [*row[1:], *[None] * 9][0:9:3]]
            node_steps = [_whole(value, 1) for value in [*row[1:], *[None] * 9][1:9:3]]
            steps = [_whole(value, 1) for value in [*row[1:], *[None] * 9][2:9:3]]
            for at in itertools.product(*map(range, counts)):
                if any(at):
                    shift = int(np.dot(at, node_steps))
                    new[kind][master + int(np.dot(at, steps))] = [node + shift for node in nodes]
            masters.append(master)
        return self._elements_with_set(new, card.get("ELSET"), masters)

    def _copied_elements(self, card: Card) -> list[Card]:
        """`*ELCOPY`: a set of elements once more, on nodes with higher numbers."""
        new: dict[str, dict[int, list[int]]] = defaultdict(dict)
        shift = _whole(card["SHIFT NODES"])
        for number in self._members_of_set("ELSET", card["OLD SET"]):
            kind, nodes = self.elements[number]
            new[kind][number + _whole(card["ELEMENT SHIFT"])] = [node + shift for node in nodes]
        return self._elements_with_set(new, card.get("NEW SET"), [])

    def _elements_with_set(self, new: dict[str, dict[int, list[int]]], name: Value, others: list[int]) -> list[Card]:
        """New elements by their type, that are in a set with others."""
        in_set = {} if name is None else {"ELSET": name}
        cards = [
            Card.make("ELEMENT", {"TYPE": kind, **in_set}, [[number, *nodes] for number, nodes in elements.items()])
            for kind, elements in new.items()
        ]
        if name is not None and others:
            cards.append(_set("ELSET", name, others))
        return cards


def _set(kind: str, name: Value, members: list[int]) -> Card:
    members = list(dict.fromkeys(members))
    rows = [members[i : i + _NUMBERS_ON_A_LINE] for i in range(0, len(members), _NUMBERS_ON_A_LINE)]
    return Card.make(kind, {kind: name}, rows)


def _whole(value: Value, default: int | None = None) -> int:
    """A whole number; the default where the place is empty."""
    if value is None and default is not None:
        return default
    if not isinstance(value, int):
        raise ValueError(f"a whole number is needed, not {'nothing' if value is None else repr(value)}")
    return value


def _numbers(values: Sequence[Value], count: int) -> NDArray:
    """As many numbers; 0 for places that are empty."""
    return np.array([float(value or 0) for value in [*values, *[0] * count][:count]])


def _on_arc(a: NDArray, b: NDArray, centre: NDArray, normal: Sequence[Value], shares: NDArray) -> NDArray:
    """Places on a circle from a to b: the shorter way, or about the normal that is given, up to a full turn."""
    one, other = a - centre, b - centre
    radius = np.linalg.norm(one)
    if not np.isclose(np.linalg.norm(other), radius, rtol=1e-3):
        raise ValueError(
            f"its ends have distances of {radius:g} and {np.linalg.norm(other):g} from the centre of the arc"
        )
    given = _numbers(normal, 3)
    axis = given if given.any() else np.cross(one, other)
    if not np.linalg.norm(axis) > 1e-9 * radius**2 and not given.any():
        raise ValueError("an arc of half a turn or a whole one needs a normal: the last three values")
    axis /= np.linalg.norm(axis)
    angle = np.arctan2(axis @ np.cross(one, other), one @ other)
    if angle <= 1e-9:
        angle += 2 * np.pi
    turned = (shares * angle)[:, np.newaxis]
    return centre + np.cos(turned) * one + np.sin(turned) * np.cross(axis, one)
