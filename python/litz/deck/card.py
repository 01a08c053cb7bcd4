"""A card of a deck: a keyword line with its data lines, and the comments before it."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from numbers import Real
from typing import Any

from .keyword_table import squeezed
from .lines import (
    BYTE_ORDER_MARK,
    Value,
    data_line,
    from_text,
    head_line,
    is_comment,
    is_keyword,
    line_end,
    parameter_value,
    quoted,
    split_fields,
    to_text,
)


@dataclass(eq=False)
class Card:
    r"""A keyword line with its data lines and the preceding comments.

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
    line : int
        Number of the keyword line in its file; 0: the card was made by hand.
    is_generated : bool
        Whether its data lines are others than those of the file.
    is_included : bool
        Whether it is of another file, and its line that of the `*INCLUDE`.

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
    line: int = 0
    is_generated: bool = False
    is_included: bool = False

    @classmethod
    def make(cls, name: str, parameters: dict[str, Any] | None = None, rows: Iterable[Sequence[Value]] = ()) -> "Card":
        """A card from a keyword, its parameters and its data."""
        card = cls(head=[head_line(name, parameters or {}) + "\n"])
        card.data = rows
        return card

    @classmethod
    def parse(cls, text: str) -> "Card":
        """The one card that a text has."""
        cards = parse_cards(text)[0]
        if len(cards) != 1:
            raise ValueError(f"one card is expected, the text has {len(cards)}")
        return cards[0]

    @property
    def text(self) -> str:
        """The card as it stands in the deck."""
        return "".join([*self.comments, *self.head, *self.body])

    def __repr__(self) -> str:
        """Short description."""
        head = " ".join(line.strip() for line in self.head)
        n_rows = len(self._data_lines())
        return f"<Card {head}: {n_rows} data line{'s' * (n_rows != 1)}>"

    @property
    def name(self) -> str:
        """The keyword in upper case, such as "BEAM SECTION"."""
        return " ".join(self._fields()[0].lstrip(BYTE_ORDER_MARK + " \t")[1:].split()).upper()

    def is_a(self, name: str) -> bool:
        """Whether the keyword is this one, however it is written."""
        return squeezed(self.name) == squeezed(name.removeprefix("*"))

    # Parameters

    @property
    def parameters(self) -> dict[str, Any]:
        """Parameters by name in upper case: text or number, True for a flag."""
        return dict(self._parameters())

    def get(self, name: str, default: Any = None) -> Any:
        """A parameter, or the default if the card does not have it."""
        for known, value in self.parameters.items():
            if squeezed(known) == squeezed(name):
                return value
        return default

    def __contains__(self, name: str) -> bool:
        """Whether the card has a parameter."""
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
        return split_fields("".join(line.strip("\r\n") for line in self.head if not is_comment(line)))

    def _parameters(self) -> Iterator[tuple[str, Any]]:
        for one in self._fields()[1:]:
            if one.strip():
                name, equals, value = one.partition("=")
                yield " ".join(name.split()).upper(), parameter_value(value) if equals else True

    def _set_parameter(self, key: str, value: Any) -> None:
        if value is None or value is False:
            raise ValueError(f"a parameter has a text, a number or True; del card[{key!r}] removes it")
        text = key if value is True else f"{key}={quoted(to_text(value))}"
        fields = self._fields()
        for i, one in enumerate(fields[1:], start=1):
            if one.strip() and squeezed(one.split("=")[0]) == squeezed(key):
                blanks = one[: len(one) - len(one.lstrip())]
                name = one.split("=")[0].strip()
                fields[i] = blanks + (name if value is True else f"{name}={quoted(to_text(value))}")
                break
        else:
            fields = [one for one in fields if one.strip()] + [f" {text}"]
        self._write_head(fields)

    def _write_head(self, fields: list[str]) -> None:
        self.head = [",".join(fields) + line_end(self.head)]

    # Data

    @property
    def data(self) -> list[list[Value]]:
        """The values of the data lines: numbers, texts, None for places left empty.

        A copy: set `data`, or `card[row, column]`, to change them.
        """
        return [[from_text(one) for one in split_fields(line)] for line in self._data_lines()]

    @data.setter
    def data(self, rows: Iterable[Sequence[Value]]) -> None:
        rows = [[row] if isinstance(row, str | Real) else list(row) for row in rows]
        end = line_end(self.head)
        if self.head and not self.head[-1].endswith("\n"):
            self.head[-1] += end
        self.body = [data_line(row) + end for row in rows]

    def _data_lines(self) -> list[str]:
        return [line.strip() for line in self.body if not is_comment(line)]

    def _set_value(self, row: int, column: int, value: Value) -> None:
        places = [i for i, line in enumerate(self.body) if not is_comment(line)]
        if not -len(places) <= row < len(places):
            raise IndexError(f"*{self.name} has {len(places)} data lines, no index {row}")
        line = self.body[places[row]]
        end = line[len(line.rstrip()) :]
        fields = split_fields(line.rstrip())
        if column < 0:
            column += len(fields)
        if column < 0:
            raise IndexError(f"a data line of *{self.name} has {len(fields)} values")
        fields += [" "] * (column + 1 - len(fields))
        old = fields[column]
        blanks = old[: len(old) - len(old.lstrip())] or (" " if column or line[:1] in " \t" else "")
        fields[column] = blanks + to_text(value)
        self.body[places[row]] = ",".join(fields) + end


def parse_cards(text: str, *, goes_on: bool = False) -> tuple[list[Card], list[str]]:
    """Parse a text: its cards, and the comment and blank lines after the last card.

    `goes_on`: it may begin with data lines of a card before it, which are a first card without a keyword line.
    """
    cards: list[Card] = []
    waiting: list[str] = []
    head_goes_on = False
    for number, line in enumerate(re.findall(r"[^\n]*\n|[^\n]+", text), 1):
        if is_comment(line):
            waiting.append(line)
        elif is_keyword(line):
            cards.append(Card(comments=waiting, head=[line], line=number))
            waiting = []
            head_goes_on = line.rstrip().endswith(",")
        elif head_goes_on:
            cards[-1].head += [*waiting, line]
            waiting = []
            head_goes_on = line.rstrip().endswith(",")
        elif cards or goes_on:
            if not cards:
                cards.append(Card(line=number))
            cards[-1].body += [*waiting, line]
            waiting = []
        else:
            raise ValueError(f"a deck begins with a keyword line such as *HEADING, not with {line.strip()[:60]!r}")
    return cards, waiting
