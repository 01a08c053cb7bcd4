"""The cards of a deck with those of the files that it includes."""

from pathlib import Path

from ..errors import InputError
from .card import Card
from .deck import Deck
from .lines import line_end

#: Files that include each other; as many as the program takes
_MOST_IN_A_CHAIN = 100


def with_included(deck: Deck) -> list[Card]:
    """The cards of a deck and of those that it includes, as if their lines stood in place of the `*INCLUDE`.

    Cards of other files have the line of the card that includes them. Data lines go on with the card before them, also
    from one file to another.

    Raises
    ------
    InputError
        If a file includes itself, directly or through others, or a card includes nothing.
    """
    cards = _cards(deck, [] if deck.path is None else [deck.path.resolve()])
    if cards and not cards[0].head:
        raise _error(deck, cards[0], "data lines before the first keyword line")
    return cards


def _cards(deck: Deck, chain: list[Path]) -> list[Card]:
    """The cards; the first one has no keyword line if the file begins with data lines. The chain of files ends with this one."""
    found: list[Card] = []
    for card in deck:
        for one in _included(deck, card, chain) if card.is_a("INCLUDE") else [card]:
            if one.head or not found:
                found.append(one)
            else:
                _go_on(found[-1], one)
    return found


def _included(deck: Deck, card: Card, chain: list[Path]) -> list[Card]:
    """What the file has, and the data lines behind the `*INCLUDE`."""
    if "INPUT" not in card:
        raise _error(deck, card, "*INCLUDE needs INPUT=file")
    other = deck.included(card)
    path = other.path or Path()
    if path.resolve() in chain:
        raise _error(deck, card, f"the file {path} includes itself, directly or through others")
    if len(chain) >= _MOST_IN_A_CHAIN:
        raise _error(deck, card, f"included files are nested more than {_MOST_IN_A_CHAIN} deep")
    cards = _cards(other, [*chain, path.resolve()])
    if card.body:
        cards.append(Card(body=card.body))
    for one in cards:
        one.line, one.is_included = card.line, True
    if cards:
        cards[0].comments[:0] = card.comments
    return cards


def _go_on(card: Card, data: Card) -> None:
    """Add data lines of another file."""
    last = card.body or card.head
    if not last[-1].endswith("\n"):
        last[-1] += line_end(card.head)
    card.body += [*data.comments, *data.body]
    card.is_generated = True


def _error(deck: Deck, card: Card, message: str) -> InputError:
    return InputError(f"{message}\n --> {deck.path or 'deck'}:{card.line}")
