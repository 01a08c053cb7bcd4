"""Decks as lists of cards that can be read, changed and written, with every comment and blank where it was."""

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from numbers import Integral, Real
from pathlib import Path
from typing import Any

import numpy as np

from .errors import FileError
from .keyword_table import squeezed

#: What a data value may be; None stands for a place that is left empty
Value = int | float | str | None
#: Keyword, parameters, data lines
CardSpec = tuple[str, dict[str, Any], Sequence[Sequence[Value]]]
_BYTE_ORDER_MARK = "\ufeff"


def number(value: float) -> str:
    """The shortest decimal that reads back as the same number.

    Examples
    --------
    >>> number(1e-4), number(120e9), number(0.25), number(3)
    ('1e-4', '1.2e11', '0.25', '3')
    """
    if isinstance(value, Integral):
        return str(int(value))
    plain = np.format_float_positional(value, trim="-")
    scientific = np.format_float_scientific(value, trim="-", exp_digits=1).replace("e+", "e")
    return min(plain, scientific, key=len)


def to_text(value: Value) -> str:
    """A value as it stands on a data line."""
    if value is None:
        return ""
    return number(value) if isinstance(value, Real) and not isinstance(value, bool) else str(value)


def from_text(text: str) -> Value:
    """What stands on a data line: a number where it is one, None where nothing stands."""
    text = text.strip()
    if not text:
        return None
    if re.fullmatch(r"[+-]?\d+", text):
        return int(text)
    # the exponent may be Fortran's D
    if re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?", text):
        return float(text.upper().replace("D", "E"))
    return text


def card_lines(name: str, parameters: dict[str, Any], rows: Iterable[Sequence[Value]] = ()) -> Iterator[str]:
    """The lines of a card, without their ends."""
    yield _head(name, parameters)
    for row in rows:
        yield data_line(row)


def data_line(row: Sequence[Value]) -> str:
    """A data line; places at its end that are empty are left out."""
    texts = [to_text(value) for value in row]
    while len(texts) > 1 and not texts[-1]:
        texts.pop()
    return " " + ", ".join(texts)


@dataclass(eq=False)
class Card:
    r"""A keyword line with its data lines, and the comments that stand before it.

    `card["INC"]` is a parameter (True for a flag), `card[0, 1]` the second value of the first data line; both can be set,
    and `del card["INC"]` removes a parameter. Only what is set changes its text.

    Attributes
    ----------
    comments : list of str
        Comment and blank lines before the keyword line.
    head : list of str
        The keyword line and those that continue it.
    body : list of str
        What follows: data lines, with comments and blank lines among them.

    Examples
    --------
    >>> card = Card.parse("*STATIC\n 0.1, 1.")
    >>> card[0, 0] = 0.05
    >>> card["DIRECT"] = True
    >>> print(card.text, end="")
    *STATIC, DIRECT
     0.05, 1.
    """

    comments: list[str] = field(default_factory=list)
    head: list[str] = field(default_factory=list)
    body: list[str] = field(default_factory=list)

    @classmethod
    def make(cls, name: str, parameters: dict[str, Any] | None = None, rows: Iterable[Sequence[Value]] = ()) -> "Card":
        """A card from a keyword, its parameters and its data."""
        card = cls(head=[_head(name, parameters or {}) + "\n"])
        card.data = rows
        return card

    @classmethod
    def parse(cls, text: str) -> "Card":
        """The one card that a text has."""
        cards = Deck.parse(text).cards
        if len(cards) != 1:
            raise ValueError(f"one card is wanted, the text has {len(cards)}")
        return cards[0]

    @property
    def text(self) -> str:
        """The card as it stands in the deck."""
        return "".join([*self.comments, *self.head, *self.body])

    def __repr__(self) -> str:
        """One line."""
        head = " ".join(line.strip() for line in self.head)
        n_rows = len(self._data_lines())
        return f"<Card {head}: {n_rows} data line{'s' * (n_rows != 1)}>"

    @property
    def name(self) -> str:
        """The keyword in capitals, such as "BEAM SECTION"."""
        return " ".join(self._fields()[0].lstrip(_BYTE_ORDER_MARK + " \t")[1:].split()).upper()

    def is_a(self, name: str) -> bool:
        """Whether the keyword is this one, however it is written."""
        return squeezed(self.name) == squeezed(name.removeprefix("*"))

    # Parameters

    @property
    def parameters(self) -> dict[str, Any]:
        """Texts or numbers of the parameters by their names in capitals; True for a flag."""
        return dict(self._parameters())

    def get(self, name: str, default: Any = None) -> Any:
        """A parameter, or the default where it does not stand."""
        for known, value in self.parameters.items():
            if squeezed(known) == squeezed(name):
                return value
        return default

    def __contains__(self, name: str) -> bool:
        """Whether a parameter stands on the card."""
        return self.get(name) is not None

    def __getitem__(self, key: str | tuple[int, int]) -> Any:
        """A parameter, or a data value by row and column."""
        if isinstance(key, tuple):
            row, column = key
            return self.data[row][column]
        value = self.get(key)
        if value is None:
            there = ", ".join(self.parameters) or "none"
            raise KeyError(f"*{self.name} has no parameter {key}; there is: {there}")
        return value

    def __setitem__(self, key: str | tuple[int, int], value: Any) -> None:
        """Sets a parameter, or a data value by row and column."""
        if isinstance(key, tuple):
            self._set_value(*key, value)
        else:
            self._set_parameter(key, value)

    def __delitem__(self, key: str) -> None:
        """Removes a parameter."""
        self[key]
        fields = self._fields()
        kept = [one for one in fields[1:] if one.strip() and squeezed(one.split("=")[0]) != squeezed(key)]
        self._write_head([fields[0], *kept])

    def _fields(self) -> list[str]:
        """The keyword and the parameters as they are written, without the ends of lines."""
        return _split("".join(line.strip("\r\n") for line in self.head if not _is_comment(line)))

    def _parameters(self) -> Iterator[tuple[str, Any]]:
        for one in self._fields()[1:]:
            if one.strip():
                name, equals, value = one.partition("=")
                yield " ".join(name.split()).upper(), _parameter_value(value) if equals else True

    def _set_parameter(self, key: str, value: Any) -> None:
        if value is None or value is False:
            raise ValueError(f"a parameter has a text, a number or True; del card[{key!r}] removes it")
        text = key if value is True else f"{key}={_quoted(to_text(value))}"
        fields = self._fields()
        for i, one in enumerate(fields[1:], start=1):
            if one.strip() and squeezed(one.split("=")[0]) == squeezed(key):
                blanks = one[: len(one) - len(one.lstrip())]
                name = one.split("=")[0].strip()
                fields[i] = blanks + (name if value is True else f"{name}={_quoted(to_text(value))}")
                break
        else:
            fields = [one for one in fields if one.strip()] + [f" {text}"]
        self._write_head(fields)

    def _write_head(self, fields: list[str]) -> None:
        self.head = [",".join(fields) + _line_end(self.head)]

    # Data

    @property
    def data(self) -> list[list[Value]]:
        """The values of the data lines: numbers, texts, None for places left empty.

        A copy: set `data`, or `card[row, column]`, to change them.
        """
        return [[from_text(one) for one in _split(line)] for line in self._data_lines()]

    @data.setter
    def data(self, rows: Iterable[Sequence[Value]]) -> None:
        rows = [[row] if isinstance(row, str | Real) else list(row) for row in rows]
        end = _line_end(self.head)
        if self.head and not self.head[-1].endswith("\n"):
            self.head[-1] += end
        self.body = [data_line(row) + end for row in rows]

    def _data_lines(self) -> list[str]:
        return [line.strip() for line in self.body if not _is_comment(line)]

    def _set_value(self, row: int, column: int, value: Value) -> None:
        places = [i for i, line in enumerate(self.body) if not _is_comment(line)]
        if not -len(places) <= row < len(places):
            raise IndexError(f"*{self.name} has {len(places)} data lines, none of the index {row}")
        line = self.body[places[row]]
        end = line[len(line.rstrip()) :]
        fields = _split(line.rstrip())
        if column < 0:
            column += len(fields)
        if column < 0:
            raise IndexError(f"a data line of *{self.name} has {len(fields)} values")
        fields += [" "] * (column + 1 - len(fields))
        old = fields[column]
        blanks = old[: len(old) - len(old.lstrip())] or (" " if column or line[:1] in " \t" else "")
        fields[column] = blanks + to_text(value)
        self.body[places[row]] = ",".join(fields) + end


class Deck:
    r"""A deck of any program that writes them as Abaqus does, as a list of cards.

    Keywords, comments, blanks and order stay as they were; what is not changed is written byte by byte as it was read.
    Included files stay apart: `*INCLUDE` is a card like others, and `included` reads what it names.

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
        path = Path(path)
        if path.exists() and not path.is_file():
            raise FileError(f"cannot read the deck {path}: it is not a regular file")
        try:
            # bytes that are no UTF-8 come back as they were when they are written
            text = path.read_bytes().decode("utf-8", errors="surrogateescape")
        except OSError as error:
            raise FileError(f"cannot read the deck {path}: {error.strerror}") from None
        deck = cls.parse(text)
        deck.path = path
        return deck

    @classmethod
    def parse(cls, text: str) -> "Deck":
        """The deck of a text."""
        deck = cls()
        waiting: list[str] = []
        goes_on = False
        for line in re.findall(r"[^\n]*\n|[^\n]+", text):
            if _is_comment(line):
                waiting.append(line)
            elif _is_keyword(line):
                deck.cards.append(Card(comments=waiting, head=[line]))
                waiting = []
                goes_on = line.rstrip().endswith(",")
            elif goes_on:
                deck.cards[-1].head += [*waiting, line]
                waiting = []
                goes_on = line.rstrip().endswith(",")
            elif deck.cards:
                deck.cards[-1].body += [*waiting, line]
                waiting = []
            else:
                raise ValueError(f"a deck begins with a keyword line such as *HEADING, not with {line.strip()[:60]!r}")
        deck.tail = waiting
        return deck

    @property
    def text(self) -> str:
        """The deck as a text."""
        return "".join([card.text for card in self.cards] + self.tail)

    def __repr__(self) -> str:
        """One line."""
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
        """The deck that an `*INCLUDE` card of this one names."""
        if not card.is_a("INCLUDE"):
            raise ValueError(f"{card!r} is no *INCLUDE")
        return Deck.read((self.path.parent if self.path else Path()) / str(card["INPUT"]))

    def write(self, path: str | os.PathLike) -> Path:
        """Write the deck; what it includes stays where it is, and is still found when the deck goes elsewhere."""
        path = Path(path)
        text = "".join([self._written(card, path.parent) for card in self.cards] + self.tail)
        try:
            path.write_bytes(text.encode("utf-8", errors="surrogateescape"))
        except OSError as error:
            raise FileError(f"cannot write {path}: {error.strerror}") from None
        return path

    def _written(self, card: Card, directory: Path) -> str:
        """A card as it goes into a directory: relative paths of other files are from there."""
        if self.path is None or not (card.is_a("INCLUDE") or card.is_a("MESH")) or "INPUT" not in card:
            return card.text
        home = self.path.parent.resolve()
        if home == directory.resolve() or Path(str(card["INPUT"])).is_absolute():
            return card.text
        moved = Card(card.comments, list(card.head), card.body)
        moved["INPUT"] = Path(os.path.relpath(home / str(card["INPUT"]), directory.resolve())).as_posix()
        return moved.text


def _head(name: str, parameters: dict[str, Any]) -> str:
    parts = [f"*{name.removeprefix('*')}"]
    for key, value in parameters.items():
        if value is None or value is False:
            continue
        parts.append(key if value is True else f"{key}={_quoted(to_text(value))}")
    return ", ".join(parts)


def _fits(card: Card, parameters: dict[str, Any]) -> bool:
    given = {re.sub(r"[\s_-]", "", name).upper(): value for name, value in card.parameters.items()}
    for name, wanted in parameters.items():
        value = given.get(re.sub(r"[\s_-]", "", name).upper())
        if value is None or squeezed(to_text(value)) != squeezed(to_text(wanted)):
            return False
    return True


def _is_comment(line: str) -> bool:
    text = line.lstrip(_BYTE_ORDER_MARK).strip()
    return not text or text.startswith("**")


def _is_keyword(line: str) -> bool:
    return not _is_comment(line) and line.lstrip(_BYTE_ORDER_MARK + " \t").startswith("*")


def _split(text: str) -> list[str]:
    """Fields between commas that stand outside of quotes."""
    return re.split(r',(?=(?:[^"]*"[^"]*")*[^"]*$)', text) if '"' in text else text.split(",")


def _parameter_value(text: str) -> Value:
    """What stands after the equals sign; a text in quotes is one, whatever it looks like."""
    text = text.strip()
    return text[1:-1] if len(text) > 1 and text[0] == text[-1] == '"' else from_text(text)


def _quoted(text: str) -> str:
    return f'"{text}"' if "," in text or text != text.strip() else text


def _line_end(lines: list[str]) -> str:
    return "\r\n" if any(line.endswith("\r\n") for line in lines) else "\n"
