"""The text tables of a run (.csv, .sta, .cvg) as tables."""

import re
from collections.abc import Iterable, Iterator
from itertools import islice
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
_BYTES_AT_ONCE = 2**20
_LINES_AT_ONCE = 10_000
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


def read_units(path: Path) -> dict[str, str]:
    """Unit of each column of a table with commas, "" where it has none; its rows are not read."""
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            return _table_of(path, [file.readline()], ",").units
    except OSError as error:
        raise FileError(f"cannot read {path}: {error.strerror}") from None


def read_last_column(path: Path) -> np.ndarray:
    """The last column of a table with commas, as text (n_rows)."""
    cells, rest = [], b""
    try:
        with path.open("rb") as file:
            while block := file.read(_BYTES_AT_ONCE):
                whole, end, rest = (rest + block).rpartition(b"\n")
                cells.append(_last_cells(whole + end))
    except OSError as error:
        raise FileError(f"cannot read {path}: {error.strerror}") from None
    found = np.concatenate(cells)[1:] if cells else np.zeros(0, dtype="S1")
    kinds, kind = np.unique(found, return_inverse=True)
    return np.array([one.decode("utf-8", errors="replace").strip() for one in kinds], dtype=str)[kind]


def _last_cells(text: bytes) -> np.ndarray:
    """What is behind the last comma of each line of whole lines that are no comments, as bytes."""
    letters = np.frombuffer(text, dtype=np.uint8)
    ends = np.flatnonzero(letters == ord("\n"))
    begins = np.append(0, ends[:-1] + 1)[: len(ends)]
    commas = np.flatnonzero(letters == ord(","))
    before = np.searchsorted(commas, ends) - 1
    last = np.where(before >= 0, commas[before], -1) if len(commas) else np.full(len(ends), -1)
    first = np.maximum(last + 1, begins)
    is_row = letters[begins] != ord("#")
    first, ends = first[is_row], ends[is_row]
    width = max(1, int((ends - first).max(initial=0)))
    places = first[:, None] + np.arange(width)
    cells = np.where(places < ends[:, None], letters[np.minimum(places, len(letters) - 1)], np.uint8(0))
    return np.ascontiguousarray(cells).view(f"S{width}").ravel()


def count_rows(path: Path) -> int:
    """Number of rows of a table, without those that are not complete."""
    n, before = -1, b"\n"
    try:
        with path.open("rb") as file:
            while block := file.read(_BYTES_AT_ONCE):
                n += block.count(b"\n") - (before + block).count(b"\n#")
                before = block[-1:]
    except OSError as error:
        raise FileError(f"cannot read {path}: {error.strerror}") from None
    return max(n, 0)


def _read(path: Path, separator: str | None) -> Table:
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            return _table_of(path, file, separator)
    except OSError as error:
        raise FileError(f"cannot read {path}: {error.strerror}") from None
    except ValueError as error:
        raise FileError(f"{path} is not a table written by litz: {error}") from None


def _table_of(path: Path, text: Iterable[str], separator: str | None) -> Table:
    lines = _whole_lines(text)
    head = next(lines, None)
    if head is None:
        raise FileError(f"{path} is empty: the run that wrote it ended before its first line")
    heads = [_name_and_unit(word) for word in head.split(separator)]
    names = [name for name, _ in heads]
    n_numbers = sum(name not in _TEXT_COLUMNS for name in names)
    # the text of a large table is not kept as a whole
    parts = [_columns(rows, separator, names, n_numbers) for rows in _batches(lines)]
    if "element_bar" in names:
        heads = [(_OLD_NAMES.get(name, name), unit) for name, unit in heads]
    columns = {name: np.concatenate(values) for (name, _), values in zip(heads, zip(*parts, strict=True), strict=True)}
    return Table(columns, dict(heads), old_names_of(columns))


def old_names_of(columns: Iterable[str]) -> dict[str, str]:
    """Names that columns of contact ledgers had in litz 0.1, with the present ones."""
    present = set(columns)
    return {old: new for old, new in _OLD_NAMES.items() if new in present}


def _whole_lines(file: Iterable[str]) -> Iterator[str]:
    """Lines that are no comments; text after the last line end is one that a running or killed program has not completed."""
    return (line for line in file if line.endswith("\n") and not line.startswith("#"))


def _batches(lines: Iterator[str]) -> Iterator[list[str]]:
    """Some lines at a time; at least one batch, which may be empty."""
    yield list(islice(lines, _LINES_AT_ONCE))
    while rows := list(islice(lines, _LINES_AT_ONCE)):
        yield rows


def _columns(rows: list[str], separator: str | None, names: list[str], n_numbers: int) -> list[np.ndarray]:
    """Values of each column."""
    numbers = np.empty((0, n_numbers))
    if rows:
        numbers = np.loadtxt(rows, delimiter=separator, usecols=range(n_numbers), ndmin=2, comments=None)
    columns = [
        numbers[:, i].astype(int) if name in _INTEGER_COLUMNS else numbers[:, i]
        for i, name in enumerate(_OLD_NAMES.get(name, name) for name in names[:n_numbers])
    ]
    cells = [row.split(separator, len(names) - 1) for row in rows] if n_numbers < len(names) else []
    texts = (
        np.array([row[i].strip() if len(row) > i else "" for row in cells], dtype=str)
        for i in range(n_numbers, len(names))
    )
    return [*columns, *texts]


def _name_and_unit(head: str) -> tuple[str, str]:
    match = re.fullmatch(r"(.*?)\s*\[(.*)\]", head.strip())
    return (match[1], match[2]) if match else (head.strip(), "")
