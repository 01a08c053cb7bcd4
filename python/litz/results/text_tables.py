"""The text tables of a run (.csv, .sta, .cvg) as tables."""

import re
from pathlib import Path

import numpy as np

from ..base.table import Table
from ..errors import FileError

_INTEGER_COLUMNS = frozenset(
    [
        "step",
        "increment",
        "attempt",
        "attempts",
        "iteration",
        "iterations",
        "id",
        "element",
        "element_1",
        "element_2",
        "node_u",
        "node_phi",
        "node_V",
        "active",
        "new",
        "lost",
        "negative_pivots",
        "contacts",
    ]
)
#: Columns of contact ledgers in litz 0.1, and their present names
_OLD_NAMES = {
    "element_bar": "element_1",
    "element": "element_2",
    "xi_bar": "xi_1",
    "xi": "xi_2",
    **{f"point_bar_{axis}": f"point_1_{axis}" for axis in "xyz"},
    **{f"point_{axis}": f"point_2_{axis}" for axis in "xyz"},
}
#: The last columns of a table may contain text
_TEXT_COLUMNS = frozenset(["friction", "status", "remark", "wires", "surface"])


def read_csv(path: Path) -> Table:
    """A table with commas between the columns and units in brackets after their names."""
    return _read(path, ",")


def read_aligned(path: Path) -> Table:
    """A table with blanks between the columns; a remark in the last column may contain blanks.

    Lines that begin with # are comments.
    """
    return _read(path, None)


def _read(path: Path, separator: str | None) -> Table:
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise FileError(f"cannot read {path}: {error.strerror}") from None
    # text after the last line end is a line that a running or killed program has not completed
    lines = [line for line in text[: text.rfind("\n") + 1].splitlines() if not line.startswith("#")]
    if not lines:
        raise FileError(f"{path} is empty: the run that wrote it ended before its first line")
    heads = [_name_and_unit(head) for head in lines[0].split(separator)]
    if "element_bar" in dict(heads):
        heads = [(_OLD_NAMES.get(name, name), unit) for name, unit in heads]
    names = [name for name, _ in heads]
    rows = lines[1:]

    columns: dict[str, np.ndarray] = {}
    n_numbers = sum(name not in _TEXT_COLUMNS for name in names)
    numbers = np.empty((0, n_numbers))
    try:
        if rows:
            numbers = np.loadtxt(rows, delimiter=separator, usecols=range(n_numbers), ndmin=2, comments=None)
    except ValueError as error:
        raise FileError(f"{path} is not a table written by litz: {error}") from None
    for i, name in enumerate(names[:n_numbers]):
        columns[name] = numbers[:, i].astype(int) if name in _INTEGER_COLUMNS else numbers[:, i]
    cells = [row.split(separator, len(names) - 1) for row in rows]
    for i, name in enumerate(names[n_numbers:], start=n_numbers):
        columns[name] = np.array([row[i].strip() if len(row) > i else "" for row in cells], dtype=str)
    old_names = {old: new for old, new in _OLD_NAMES.items() if new in columns}
    return Table(columns, dict(heads), old_names)


def _name_and_unit(head: str) -> tuple[str, str]:
    match = re.fullmatch(r"(.*?)\s*\[(.*)\]", head.strip())
    return (match[1], match[2]) if match else (head.strip(), "")
