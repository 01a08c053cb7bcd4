"""Decks as lists of cards that can be read, changed and written, with every comment and blank where it was."""

import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from ..errors import FileError
from .card import Card, parse_cards
from .keyword_table import squeezed
from .lines import to_text


class Deck:
    r"""A deck of any program with the syntax of Abaqus, as a list of cards.

    Keywords, comments, blanks and order are preserved; what is not changed is written byte by byte as it was read.
    Included files stay separate: `*INCLUDE` is a card like others, and `included` reads what it names.

    Attributes
    ----------
    cards : list of Card
        The cards in their order; insert and remove as in any list, or by `insert` and `remove`.
    tail : list of str
        Comment and blank lines after the last card.
    path : Path or None
        Where the deck was read.

    Examples
    --------
    >>> deck = Deck.parse("*MATERIAL, NAME=COPPER\n*ELASTIC\n 120e9, 0.34\n")
    >>> deck.card("ELASTIC")[0, 0] = 110e9
    >>> deck.insert("*ELECTRICAL CONDUCTIVITY\n 5.8e7", after=deck.card("ELASTIC"))
    >>> print(deck.text, end="")
    *MATERIAL, NAME=COPPER
    *ELASTIC
     1.1e11, 0.34
    *ELECTRICAL CONDUCTIVITY
     5.8e7
    """

    def __init__(self, cards: Iterable[Card] = (), tail: Iterable[str] = (), path: Path | None = None):
        self.cards = list(cards)
        self.tail = list(tail)
        self.path = path

    @classmethod
    def read(cls, path: str | os.PathLike) -> "Deck":
        """The deck of a file."""
        deck = cls.parse(_text_of(Path(path)))
        deck.path = Path(path)
        return deck

    @classmethod
    def parse(cls, text: str) -> "Deck":
        """The deck of a text."""
        return cls(*parse_cards(text))

    @property
    def text(self) -> str:
        """The deck as a text."""
        return "".join([card.text for card in self.cards] + self.tail)

    def __repr__(self) -> str:
        """Short description."""
        n_steps = sum(card.is_a("STEP") for card in self.cards)
        return f"<Deck {self.path or 'not in a file'}: {len(self.cards)} cards, {n_steps} step{'s' * (n_steps != 1)}>"

    def __iter__(self) -> Iterator[Card]:
        """Goes over the cards."""
        return iter(self.cards)

    def __len__(self) -> int:
        """Number of cards."""
        return len(self.cards)

    def find(self, keyword: str, /, *, step: int | None = None, **parameters: Any) -> list[Card]:
        """The cards of a keyword.

        Parameters
        ----------
        keyword : str
            The keyword, however it is written.
        step : int, optional
            The step they stand in, counted from 1; 0 for the model part. Left out: anywhere.
        **parameters
            Parameters that they must have, such as `elset="LOWER"`; blanks and hyphens of their names as underscores.
        """
        found = []
        in_step = 0
        for card in self.cards:
            in_step += card.is_a("STEP")
            if card.is_a(keyword) and step in (None, in_step) and _fits(card, parameters):
                found.append(card)
        return found

    def card(self, keyword: str, /, *, step: int | None = None, **parameters: Any) -> Card:
        """The one card of a keyword; arguments as those of `find`."""
        found = self.find(keyword, step=step, **parameters)
        if len(found) != 1:
            asked = "".join(f", {key.upper()}={value}" for key, value in parameters.items())
            where = "" if step is None else f" in step {step}" if step else " in the model part"
            there = "; ".join(map(repr, found)) or "cards are: " + ", ".join(dict.fromkeys(c.name for c in self.cards))
            raise LookupError(f"there are {len(found)} cards *{keyword}{asked}{where}, not one ({there})")
        return found[0]

    def insert(self, new: "Card | str", *, before: Card | None = None, after: Card | None = None) -> None:
        """Insert a card, or the cards of a text, before or after another; at the end without one of them."""
        if before is not None and after is not None:
            raise ValueError("insert takes before or after, not both")
        cards = [new] if isinstance(new, Card) else self.parse(new if new.endswith("\n") else new + "\n").cards
        place = len(self.cards)
        if before is not None:
            place = self._index(before)
        elif after is not None:
            place = self._index(after) + 1
        if place and self.cards[place - 1].text[-1:] != "\n":
            last = self.cards[place - 1]
            lines = last.body or last.head
            lines[-1] += "\n"
        self.cards[place:place] = cards

    def remove(self, card: Card) -> None:
        """Remove a card with the comments before it."""
        del self.cards[self._index(card)]

    def _index(self, card: Card) -> int:
        for i, one in enumerate(self.cards):
            if one is card:
                return i
        raise ValueError(f"{card!r} is not in this deck")

    def included(self, card: Card) -> "Deck":
        """The deck that an `*INCLUDE` card of this one names.

        Data lines that it begins with go on with the card before the `*INCLUDE`; they are a card without a keyword line.
        """
        if not card.is_a("INCLUDE"):
            raise ValueError(f"{card!r} is not an *INCLUDE card")
        path = (self.path.parent if self.path else Path()) / str(card["INPUT"])
        return Deck(*parse_cards(_text_of(path), goes_on=True), path)

    def write(self, path: str | os.PathLike) -> Path:
        """Write the deck; paths of included files are adapted to the new directory."""
        path = Path(path)
        text = "".join([self._written(card, path.parent) for card in self.cards] + self.tail)
        try:
            path.write_bytes(text.encode("utf-8", errors="surrogateescape"))
        except OSError as error:
            raise FileError(f"cannot write {path}: {error.strerror}") from None
        return path

    def _written(self, card: Card, directory: Path) -> str:
        """A card as written into a directory: relative paths start there."""
        if self.path is None or not (card.is_a("INCLUDE") or card.is_a("MESH")) or "INPUT" not in card:
            return card.text
        home = self.path.parent.resolve()
        if home == directory.resolve() or Path(str(card["INPUT"])).is_absolute():
            return card.text
        moved = Card(card.comments, list(card.head), card.body, card.line)
        moved["INPUT"] = Path(os.path.relpath(home / str(card["INPUT"]), directory.resolve())).as_posix()
        return moved.text


def _text_of(path: Path) -> str:
    if path.exists() and not path.is_file():
        raise FileError(f"cannot read the deck {path}: it is not a regular file")
    try:
        # bytes that are not UTF-8 are preserved on writing
        return path.read_bytes().decode("utf-8", errors="surrogateescape")
    except OSError as error:
        raise FileError(f"cannot read the deck {path}: {error.strerror}") from None


def _fits(card: Card, parameters: dict[str, Any]) -> bool:
    given = {re.sub(r"[\s_-]", "", name).upper(): value for name, value in card.parameters.items()}
    for name, wanted in parameters.items():
        value = given.get(re.sub(r"[\s_-]", "", name).upper())
        if value is None or squeezed(to_text(value)) != squeezed(to_text(wanted)):
            return False
    return True
