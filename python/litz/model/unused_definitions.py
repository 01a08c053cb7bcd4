"""Definitions that nothing uses: Abaqus/CAE writes all that a model has, and litz takes them for misspelt references."""

from collections.abc import Iterator
from typing import NamedTuple

from ..deck import Card, Deck
from ..deck.keyword_table import keywords, squeezed


class _Definition(NamedTuple):
    """A keyword that defines a name, and what refers to it."""

    #: The keyword
    keyword: str
    #: Parameters of other keywords that name it
    references: tuple[str, ...]


_DEFINITIONS = (
    _Definition("AMPLITUDE", ("AMPLITUDE", "FILM AMPLITUDE", "RADIUS AMPLITUDE")),
    _Definition("MATERIAL", ("MATERIAL",)),
    _Definition("SURFACE INTERACTION", ("INTERACTION",)),
)


def unused_definitions(deck: Deck) -> Iterator[tuple[list[Card], str]]:
    """Each definition that no card of a deck refers to, with the cards that belong to it, and what is to be said."""
    for keyword, references in _DEFINITIONS:
        used = {squeezed(str(card[name])) for card in deck for name in references if name in card}
        belonging = [name for name, description in keywords().items() if description["after"] == keyword]
        for i, card in enumerate(deck.cards):
            name = card.get("NAME", "")
            if not card.is_a(keyword) or squeezed(str(name)) in used:
                continue
            last = i + 1
            while last < len(deck) and any(deck.cards[last].is_a(one) for one in belonging):
                last += 1
            yield deck.cards[i:last], f"*{keyword}, NAME={name}: nothing uses it"
