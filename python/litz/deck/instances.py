"""Instances of parts: what they place, as a flat deck has it."""

import re
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from ..base.names import unknown_name
from ..base.rearranged import REARRANGED, included_files
from ..errors import InputError
from .blank_axis import write_blank_axis
from .card import Card
from .deck import Deck
from .generated import rewrite, written_out
from .included import with_included
from .lines import Value
from .placement import placed, rotated

#: Cards whose data lines begin with a node or an element, or the name of a set
_ON_NODES = ("BOUNDARY", "CLOAD", "CECURRENT", "CFLUX", "TEMPERATURE", "INITIAL CONDITIONS", "KINEMATIC COUPLING")
_ON_ELEMENTS = ("DLOAD", "LORENTZ", "DFLUX", "FILM", "RADIATE", "SURFACE")
#: Cards that have no meaning where the instances are placed
_STRUCTURE = ("ASSEMBLY", "END ASSEMBLY")
#: Of new numbers in a comment
_MOST_RANGES = 8


def deck_cards(deck: Deck) -> Iterator[Card]:
    """The cards of a deck and of those that it includes, nodes and elements that are generated written out."""
    return written_out(with_included(deck), deck.path)


def flat_cards(path: Path) -> list[Card]:
    """All cards of a deck, those of parts once for each instance at its place.

    Numbers of nodes and elements are those of the deck, unless several instances have the same.
    """
    cards = list(deck_cards(Deck.read(path)))
    if any(card.is_a("PART") for card in cards):
        cards = list(_Instances(path, cards).flat())
    return cards


def is_rearranged(path: Path) -> bool:
    """Whether a deck, or what it includes, has parts or generates nodes; long ones are not taken to pieces for that."""
    return any(REARRANGED.search(one.read_bytes()) for one in included_files(path))


@contextmanager
def flat_deck(path: Path) -> Iterator[Path]:
    """A deck that the program reads: the same, or a temporary one of its name with parts placed and nodes written out."""
    if not is_rearranged(path):
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="litz-") as directory:
        flat = Path(directory) / path.name
        flat.write_bytes(flat_text(path).encode("utf-8", errors="surrogateescape"))
        yield flat


def flat_text(path: Path) -> str:
    """The flat deck. Its comments tell the program which file and lines messages are to name."""
    lines = [f"**litz deck {path}"]
    for card in flat_cards(path):
        lines += [*_stripped(card.comments), f"**litz line {card.line}", *_stripped(card.head)]
        # sets, and what is generated, are written anew
        is_new = card.is_generated or card.is_included or card.is_a("NSET") or card.is_a("ELSET")
        data_line = card.line + (0 if card.is_included else len(card.head))
        for line in _stripped(card.body):
            lines += [f"**litz line {data_line}"] * is_new + [line]
    return "\n".join([*lines, ""])


def _stripped(lines: Iterable[str]) -> list[str]:
    return [line.rstrip("\r\n") for line in lines]


def _ranges(numbers: Sequence[int]) -> str:
    """Numbers in their order, those that follow each other as a range; the first and the last where there are many."""
    breaks = [0, *(i for i in range(1, len(numbers)) if numbers[i] != numbers[i - 1] + 1), len(numbers)]
    parts = [numbers[first:last] for first, last in pairwise(breaks)]
    if len(parts) > _MOST_RANGES:
        return f"{numbers[0]}, {numbers[1]} ... {numbers[-1]} ({len(numbers)})"
    return ", ".join(f"{part[0]}-{part[-1]}" if len(part) > 1 else f"{part[0]}" for part in parts)


class _Instances:
    """Places the instances of parts: their nodes, elements, sets and sections as a flat deck has them."""

    def __init__(self, path: Path, cards: list[Card]):
        self.path, self.cards = path, cards
        self.parts: dict[str, list[Card]] = {}
        #: New numbers of nodes and elements, by instance in capitals and number
        self.nodes: dict[tuple[str, int], int] = {}
        self.elements: dict[tuple[str, int], int] = {}
        self.sets: set[str] = set()

    def flat(self) -> Iterator[Card]:
        """All cards, those of parts once for each instance."""
        part: list[Card] | None = None
        instance: Card | None = None
        placed: dict[str, str] = {}
        for card in self.cards:
            if (card.is_a("PART") or card.is_a("INSTANCE")) and "NAME" not in card:
                raise self._error(card, f"*{card.name} needs NAME=name")
            if card.is_a("PART"):
                part = self.parts.setdefault(str(card["NAME"]).upper(), [])
            elif card.is_a("END PART"):
                part = None
            elif part is not None:
                part.append(card)
            elif card.is_a("INSTANCE"):
                instance = card
                placed[str(card.get("NAME", "")).upper()] = str(card.get("NAME", ""))
                for one in self._part_of(card):
                    yield self._read(self._placed, one, card)
            elif card.is_a("END INSTANCE"):
                instance = None
            elif instance is not None:
                yield self._read(self._placed, card, instance)
            elif not any(card.is_a(one) for one in _STRUCTURE):
                name = str(card.get("INSTANCE", ""))
                if name and name.upper() not in placed:
                    raise self._error(card, f"*{card.name}: {unknown_name('instance', name, placed.values())}")
                yield self._read(self._renumbered, card, name, "")

    def _read(self, change: Callable[..., Card], card: Card, *arguments: Any) -> Card:
        """The changed card; values that are none are errors with the place of the card."""
        try:
            return change(card, *arguments)
        except KeyError as error:
            raise self._error(card, error.args[0]) from None
        except (ValueError, TypeError, IndexError) as error:
            raise self._error(card, f"the data of *{card.name} cannot be read: {error}") from None

    def _error(self, card: Card, message: str) -> InputError:
        return InputError(f"{message}\n --> {self.path}:{card.line}")

    def _part_of(self, instance: Card) -> list[Card]:
        part = self.parts.get(str(instance.get("PART", "")).upper())
        if part is None:
            there = ", ".join(self.parts) or "none"
            raise self._error(
                instance,
                f"*INSTANCE refers to the part {instance.get('PART')}, which does not exist; there is: {there}",
            )
        return part

    def _placed(self, card: Card, instance: Card) -> Card:
        """A card of a part, or of an instance with a mesh of its own, at the place of the instance."""
        name = str(instance["NAME"])
        copy = Card(
            list(card.comments), list(card.head), list(card.body), card.line, card.is_generated, card.is_included
        )
        if copy.is_a("NODE"):
            rows = copy.data
            places = np.array([[float(value or 0) for value in [*row[1:4], 0, 0, 0][:3]] for row in rows])
            new = placed(places, instance, self.path).tolist()
            rewrite(copy, [[row[0], *place, *row[4:]] for row, place in zip(rows, new, strict=True)])
        elif (copy.is_a("BEAM SECTION") or copy.is_a("BEAM GENERAL SECTION")) and len(instance.data) > 1:
            self._turn_axis(copy, instance)
        elif copy.is_a("TRANSFORM"):
            self._place_axes(copy, instance)
        elif copy.is_a("RIGID SURFACE"):
            raise self._error(card, "a *RIGID SURFACE has its place by itself: write it outside of parts and instances")
        return self._renumbered(copy, name, f"{name}.")

    @staticmethod
    def _turn_axis(section: Card, instance: Card) -> None:
        """Turn the first axis of a section with its instance; a round wire needs none."""
        write_blank_axis(section)
        rows = section.data
        is_round = str(section.get("SECTION", "")).upper() == "CIRC" and len(rows[0]) == 1
        if is_round and len(rows) == 1 and not any(one in section for one in ("OFFSET1", "OFFSET2")):
            return
        numbers = [float(value or 0) for value in instance.data[1]]
        a, b, angle = np.array(numbers[:3]), np.array(numbers[3:6]), numbers[6]
        n1 = np.array([[float(value or 0) for value in (rows[1] if len(rows) > 1 else [0, 0, -1])]])
        turned = rotated(n1, np.zeros(3), b - a, angle)
        if len(rows) > 1:
            rewrite(section, [rows[0], turned[0].tolist(), *rows[2:]])
        else:
            section.data = [rows[0], turned[0].tolist()]

    def _place_axes(self, transform: Card, instance: Card) -> None:
        """Axes of nodes turn with their instance; those of a cylinder or a sphere are where its points are."""
        points = np.array([float(value or 0) for value in [*transform.data[0], 0, 0, 0, 0, 0][:6]]).reshape(2, 3)
        new = placed(points, instance, self.path)
        if str(transform.get("TYPE", "R")).upper() == "R":
            new -= placed(np.zeros((1, 3)), instance, self.path)
        rewrite(transform, [new.ravel().tolist()])

    def _renumbered(self, card: Card, instance: str, prefix: str) -> Card:
        """Numbers and names as the flat deck has them."""
        if card.is_a("NODE") or card.is_a("ELEMENT"):
            self._define(card, instance)
        elif card.is_a("NSET") or card.is_a("ELSET"):
            self._collect(card, instance, prefix)
        elif any(card.is_a(one) for one in (*_ON_NODES, *_ON_ELEMENTS)):
            is_of_nodes = any(card.is_a(one) for one in _ON_NODES) or str(card.get("TYPE", "")).upper() == "NODE"
            numbers = self.nodes if is_of_nodes else self.elements
            for i, row in enumerate(card.data):
                if row and row[0] is not None:
                    new = self._item_or_set(row[0], numbers, instance if prefix else "", prefix)
                    if new != row[0]:
                        card[i, 0] = new
        elif card.is_a("EQUATION") or card.is_a("MPC"):
            (self._renumber_terms if card.is_a("EQUATION") else self._renumber_joints)(card, instance, prefix)
        if card.is_a("SURFACE") and prefix:
            card["NAME"] = f"{prefix}{card['NAME']}"
        if "REF NODE" in card:
            card["REF NODE"] = self._item_or_set(card["REF NODE"], self.nodes, instance, prefix)
        for parameter in ("NSET", "ELSET", "TIE NSET", "PIN NSET"):
            if prefix and parameter in card and not str(card[parameter]).startswith(prefix):
                name = prefix + str(card[parameter])
                self.sets.add(name.upper())
                card[parameter] = name
        if "INSTANCE" in card:
            del card["INSTANCE"]
        return card

    def _renumber_terms(self, card: Card, instance: str, prefix: str) -> None:
        """Nodes of the terms of equations: each third value, but for the numbers of terms."""
        n_left = 0
        rows = card.data
        for row in rows:
            if n_left == 0:
                n_left = int(row[0] or 0)
                continue
            for i in range(0, len(row), 3):
                row[i] = self._item_or_set(row[i], self.nodes, instance, prefix)
                n_left -= 1
        rewrite(card, rows)

    def _renumber_joints(self, card: Card, instance: str, prefix: str) -> None:
        """Nodes of multi-point constraints, behind the word that says what joins them."""
        for i, row in enumerate(card.data):
            for j, value in enumerate(row[1:], start=1):
                if value is not None:
                    card[i, j] = self._item_or_set(value, self.nodes, instance if prefix else "", prefix)

    def _item_or_set(self, value: Value, numbers: dict[tuple[str, int], int], instance: str, prefix: str) -> Value:
        """A number as the flat deck has it, or a set of the instance."""
        if isinstance(value, str) and f"{prefix}{value}".upper() in self.sets:
            return f"{prefix}{value}"
        return self._item(value, numbers, instance)

    def _define(self, card: Card, instance: str) -> None:
        """New numbers: those of the deck where they are free, and otherwise above all so far."""
        numbers = self.nodes if card.is_a("NODE") else self.elements
        taken = set(numbers.values())
        highest = max(taken, default=0)
        rows = card.data
        clash = any(row[0] in taken for row in rows)
        new_rows = []
        for row in rows:
            if not isinstance(row[0], int):
                raise ValueError(f"a line begins with a whole number, not with {row[0]!r}")
            highest += 1
            new = highest if clash else row[0]
            numbers[instance.upper(), row[0]] = new
            others = [self._item(node, self.nodes, instance) for node in row[1:]] if card.is_a("ELEMENT") else row[1:]
            new_rows.append([new, *others])
        if clash and instance:
            kind = "nodes" if card.is_a("NODE") else "elements"
            old = [row[0] for row in rows if isinstance(row[0], int)]
            new_numbers = range(highest - len(old) + 1, highest + 1)
            card.comments.append(f"** {kind} of {instance}: {_ranges(old)} are {_ranges(new_numbers)} here\n")
        rewrite(card, new_rows)

    def _collect(self, card: Card, instance: str, prefix: str) -> None:
        """Members of a set; ranges are written out, as numbers may have changed."""
        numbers = self.nodes if card.is_a("NSET") else self.elements
        members: list = []
        for row in card.data:
            if "GENERATE" in card:
                members += self._in_range(row, numbers, instance)
            else:
                for value in row:
                    # a set of the instance, or of the assembly
                    names = [f"{instance}.{value}"] * bool(instance) + [f"{prefix}{value}"]
                    known = [name for name in names if isinstance(value, str) and name.upper() in self.sets]
                    if known:
                        members.append(known[0])
                    elif value is not None:
                        members.append(self._item(value, numbers, instance))
        elements = card.get("ELSET") if card.is_a("NSET") else None
        if instance and elements is not None and f"{instance}.{elements}".upper() in self.sets:
            card["ELSET"] = f"{instance}.{elements}"
        if "GENERATE" in card:
            del card["GENERATE"]
        card.data = [members[i : i + 16] for i in range(0, len(members), 16)]
        if not prefix:
            self.sets.add(str(card.get("NSET", card.get("ELSET", ""))).upper())

    @staticmethod
    def _in_range(row: Sequence[Value], numbers: dict[tuple[str, int], int], instance: str) -> list[int]:
        """Those of the instance that are in a range; as in flat decks, numbers that do not exist are skipped."""
        values = [int(value) for value in row if value is not None]
        if len(values) < 2:
            raise ValueError("a range has a first and a last number")
        first, last, *step = values
        in_range = range(first, last + 1, *step)
        # a range may be much longer than the mesh
        wanted = in_range if len(in_range) <= len(numbers) else sorted(one for _, one in numbers if one in in_range)
        found = [numbers[instance.upper(), one] for one in wanted if (instance.upper(), one) in numbers]
        if not found:
            raise ValueError(f"the instance {instance} has no number from {first} to {last}")
        return found

    @staticmethod
    def _item(value: Value, numbers: dict[tuple[str, int], int], instance: str) -> Value:
        """A number as the flat deck has it: of the instance, or `instance.number`; or a name as it is."""
        key: tuple[str, int] = (instance.upper(), value) if isinstance(value, int) else ("", 0)
        named = re.fullmatch(r"(.+)\.(\d+)", str(value)) if isinstance(value, str) else None
        if named:
            key = (named[1].upper(), int(named[2]))
        if key in numbers or not isinstance(value, int):
            return numbers.get(key, value)
        # of a part, or of several: another one must not be taken for it
        raise ValueError(
            f"there is no number {value} in the instance {instance}"
            if instance
            else f"the number {value} is that of no node or element of the assembly; one of an instance is INSTANCE.{value}"
        )
