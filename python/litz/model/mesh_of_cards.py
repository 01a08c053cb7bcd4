"""The mesh that the cards of a flat deck describe: places of nodes, members of sets."""

from collections.abc import Iterator
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..deck import Card
from ..deck.keyword_table import squeezed
from ..deck.lines import Value


class MeshOfCards:
    """Nodes, elements and sets of a flat deck of any program.

    Parameters
    ----------
    cards : list of Card
        Of the flat deck.
    """

    def __init__(self, cards: list[Card]):
        self._cards = cards

    @cached_property
    def places(self) -> dict[int, NDArray]:
        """Coordinates (3) of nodes by their number."""
        rows = (row for card in self._cards if card.is_a("NODE") for row in card.data if row)
        return {_whole(row[0]): np.array([float(x or 0) for x in [*row[1:4], 0, 0, 0][:3]]) for row in rows}

    @cached_property
    def connectivity(self) -> dict[int, list[int]]:
        """Nodes of elements by their number."""
        rows = (row for card in self._cards if card.is_a("ELEMENT") for row in card.data if row)
        return {_whole(row[0]): [_whole(node) for node in row[1:]] for row in rows}

    @cached_property
    def nodes_of_elements(self) -> set[int]:
        """Nodes that belong to elements."""
        return {node for nodes in self.connectivity.values() for node in nodes}

    def nodes(self, value: Value) -> list[int]:
        """The node of a number, or those of a set; empty: there are none.

        They are in the order in which Abaqus pairs the nodes of two sets.
        """
        if isinstance(value, int) and value in self.places:
            return [value]
        sets = self._cards_of("NSET", str(value))
        found = [node for card in sets for node in self._nodes_of(card)]
        if any("UNSORTED" in card for card in sets):
            return list(dict.fromkeys(found))
        return sorted(set(found))

    def elements(self, value: Value) -> set[int]:
        """The element of a number, or those of a set; empty: there are none."""
        if isinstance(value, int):
            return {value}
        return {element for card in self._cards_of("ELSET", str(value)) for element in self._elements_of(card)}

    def _cards_of(self, kind: str, name: str) -> list[Card]:
        """Cards that give members to a set: those of their own and those of nodes or elements."""
        makers = (kind, "NODE" if kind == "NSET" else "ELEMENT")
        return [
            card
            for card in self._cards
            if squeezed(str(card.get(kind, ""))) == squeezed(name) and any(card.is_a(one) for one in makers)
        ]

    def _nodes_of(self, card: Card) -> Iterator[int]:
        if card.is_a("NODE"):
            yield from (_whole(row[0]) for row in card.data if row)
        elif "ELSET" in card:
            for element in sorted(self.elements(str(card["ELSET"]))):
                yield from self.connectivity.get(element, ())
        elif "GENERATE" in card:
            yield from (node for node in _ranges(card) if node in self.places)
        else:
            for value in _other_values(card, "NSET"):
                yield from self.nodes(value)

    def _elements_of(self, card: Card) -> Iterator[int]:
        if card.is_a("ELEMENT"):
            yield from (_whole(row[0]) for row in card.data if row)
        elif "GENERATE" in card:
            yield from _ranges(card)
        else:
            for value in _other_values(card, "ELSET"):
                yield from self.elements(value)


def _whole(value: Value) -> int:
    """A number of a node or an element; 0, which none has, where there is something else."""
    return value if isinstance(value, int) else 0


def _ranges(card: Card) -> Iterator[int]:
    for row in card.data:
        first, last, *step = [value for value in row if isinstance(value, int)]
        yield from range(first, last + 1, *step)


def _other_values(card: Card, kind: str) -> Iterator[Value]:
    """Members on the data lines, without the set itself."""
    for row in card.data:
        for value in row:
            if value is not None and squeezed(str(value)) != squeezed(str(card[kind])):
                yield value
