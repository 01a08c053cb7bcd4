"""The lines of a deck: keyword lines, data lines, and the values in them."""

import re
from collections.abc import Iterable, Iterator, Sequence
from numbers import Integral, Real
from typing import Any

import numpy as np

#: A value on a data line; None for an empty field
Value = int | float | str | None
#: Keyword, parameters, data lines
CardSpec = tuple[str, dict[str, Any], Sequence[Sequence[Value]]]
#: Some editors put it before the first line
BYTE_ORDER_MARK = "\ufeff"


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
    """A value as written on a data line."""
    if value is None:
        return ""
    return number(value) if isinstance(value, Real) and not isinstance(value, bool) else str(value)


def from_text(text: str) -> Value:
    """The value of a field: a number if possible, None for an empty field."""
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
    yield head_line(name, parameters)
    for row in rows:
        yield data_line(row)


def data_line(row: Sequence[Value]) -> str:
    """A data line; empty fields at its end are omitted."""
    texts = [to_text(value) for value in row]
    while len(texts) > 1 and not texts[-1]:
        texts.pop()
    return " " + ", ".join(texts)


def head_line(name: str, parameters: dict[str, Any]) -> str:
    """The keyword line of a card, without its end."""
    parts = [f"*{name.removeprefix('*')}"]
    for key, value in parameters.items():
        if value is None or value is False:
            continue
        parts.append(key if value is True else f"{key}={quoted(to_text(value))}")
    return ", ".join(parts)


def is_comment(line: str) -> bool:
    """Whether a line is blank or a comment."""
    text = line.lstrip(BYTE_ORDER_MARK).strip()
    return not text or text.startswith("**")


def is_keyword(line: str) -> bool:
    """Whether a line begins a card."""
    return not is_comment(line) and line.lstrip(BYTE_ORDER_MARK + " \t").startswith("*")


def split_fields(text: str) -> list[str]:
    """Fields between commas that stand outside of quotes."""
    return re.split(r',(?=(?:[^"]*"[^"]*")*[^"]*$)', text) if '"' in text else text.split(",")


def parameter_value(text: str) -> Value:
    """The value after the equals sign; a quoted value is always a text."""
    text = text.strip()
    return text[1:-1] if len(text) > 1 and text[0] == text[-1] == '"' else from_text(text)


def quoted(text: str) -> str:
    """A parameter's value, in quotes where it needs them."""
    return f'"{text}"' if "," in text or text != text.strip() else text


def line_end(lines: list[str]) -> str:
    """The line ending: CRLF if any of the lines has it."""
    return "\r\n" if any(line.endswith("\r\n") for line in lines) else "\n"
