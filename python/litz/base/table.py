"""Tables: numpy arrays by column name, with units."""

import html
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from .names import unknown_name
from .packages import optional

if TYPE_CHECKING:
    import pandas as pd

#: Printed tables: maximum number of rows, rows shown at each end of longer tables, maximum width of cells and of lines
_MAX_ROWS = 20
_ROWS_AT_END = 5
_MAX_CELL_WIDTH = 48
_WIDTH = 120


class LateColumns(Mapping):
    """Columns that are read when they are first asked for."""

    def __init__(self, names: Iterable[str], read: Callable[[str], np.ndarray], n_rows: int):
        self._known: dict[str, np.ndarray | None] = dict.fromkeys(names)
        self._read, self.n_rows = read, n_rows

    def __getitem__(self, name: str) -> np.ndarray:
        """Values of a column (n_rows)."""
        values = self._known[name]
        if values is None:
            values = self._known[name] = self._read(name)
        return values

    def __contains__(self, name: object) -> bool:
        """Whether there is such a column, without reading it."""
        return name in self._known

    def __iter__(self) -> Iterator[str]:
        """Names of the columns."""
        return iter(self._known)

    def __len__(self) -> int:
        """Number of columns."""
        return len(self._known)

    def where(self, mask: np.ndarray) -> "LateColumns":
        """Some of the rows, of columns that are still read late."""
        mask = np.asarray(mask)
        rows = np.flatnonzero(mask) if mask.dtype == bool else mask.copy()
        return LateColumns(self._known, lambda name: self[name][rows], len(rows))


class Table(Mapping):
    """Columns of equal length, by name: `table["time"]`.

    Attributes
    ----------
    units : dict of str
        Unit of each column, "" where it has none.
    n_rows : int
    """

    def __init__(
        self, columns: Mapping[str, np.ndarray], units: Mapping[str, str], old_names: Mapping[str, str] | None = None
    ):
        self._columns = columns if isinstance(columns, LateColumns) else dict(columns)
        self.units = dict(units)
        self._old_names = dict(old_names or {})
        self.n_rows = columns.n_rows if isinstance(columns, LateColumns) else len(next(iter(columns.values()), ()))

    def __getstate__(self) -> dict:
        """With all columns: another process may not have the file that they are read from."""
        return {**self.__dict__, "_columns": dict(self._columns)}

    def __getitem__(self, name: str) -> np.ndarray:
        """Values of a column (n_rows); a `KeyError` suggests similar names."""
        if name in self._old_names and name not in self._columns:
            warnings.warn(f"the column {name!r} is now {self._old_names[name]!r}", DeprecationWarning, stacklevel=2)
            name = self._old_names[name]
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(unknown_name("column", name, self._columns)) from None

    def __contains__(self, name: object) -> bool:
        """Whether there is a column of this name, present or old, without reading it."""
        return name in self._columns or name in self._old_names

    def __iter__(self) -> Iterator[str]:
        """Names of the columns."""
        return iter(self._columns)

    def __len__(self) -> int:
        """Number of columns; that of the rows is `n_rows`."""
        return len(self._columns)

    def __repr__(self) -> str:
        """The part of the table that fits on a page, and the names of the other columns."""
        columns = list(zip(*self._page(), strict=True))
        widths = [max(map(len, column)) for column in columns]
        used = np.cumsum([width + 2 for width in widths])
        n_shown = len(columns) if not widths or used[-1] <= _WIDTH else max(1, int((used <= _WIDTH - 5).sum()))
        cells = [[cell.rjust(width) for cell in column] for column, width in zip(columns, widths, strict=True)]
        shown = cells[:n_shown] + ([["..."] * len(columns[0])] if n_shown < len(columns) else [])
        lines = ["  ".join(row).rstrip() for row in zip(*shown, strict=True)]
        hidden = list(self)[n_shown:]
        lines.append(self._sizes() + (f"; not shown: {', '.join(hidden)}" if hidden else ""))
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        """The table as HTML for notebooks."""
        rows = [[html.escape(cell) for cell in row] for row in self._page()]
        heads = ["<tr>" + "".join(f"<th>{cell}</th>" for cell in row) + "</tr>" for row in rows[:2]]
        body = ["<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows[2:]]
        return (
            '<div style="overflow-x: auto"><table style="white-space: nowrap">'
            f"<thead>{''.join(heads)}</thead><tbody>{''.join(body)}</tbody></table></div><p>{self._sizes()}</p>"
        )

    def _sizes(self) -> str:
        return f"{self.n_rows} rows, {len(self)} columns"

    def _page(self) -> list[list[str]]:
        """Names, units and rows; long tables are abbreviated to their first and last rows."""
        picked: list[int | None] = list(range(self.n_rows))
        if self.n_rows > _MAX_ROWS:
            picked = [*range(_ROWS_AT_END), None, *range(self.n_rows - _ROWS_AT_END, self.n_rows)]
        units = [f"[{self.units[name]}]" if self.units.get(name) else "" for name in self]
        return [
            list(self),
            units,
            *(["..." if row is None else _cell(values[row]) for values in self._columns.values()] for row in picked),
        ]

    def to_array(self) -> np.ndarray:
        """The rows as a structured array."""
        rows = np.empty(self.n_rows, [(name, values.dtype) for name, values in self._columns.items()])
        for name, values in self._columns.items():
            rows[name] = values
        return rows

    def to_pandas(self) -> "pd.DataFrame":
        """The rows as a data frame of pandas, with the units in `attrs["units"]`; needs pandas."""
        pd = optional("pandas")
        frame = pd.DataFrame({name: np.asarray(values) for name, values in self._columns.items()})
        frame.attrs["units"] = dict(self.units)
        return frame

    def with_column(self, name: str, values: np.ndarray) -> "Table":
        """The same table with other values (n_rows) in one of its columns; columns that are read late still are."""
        if isinstance(self._columns, LateColumns):
            late = LateColumns(self._columns, lambda other: values if other == name else self[other], self.n_rows)
            return Table(late, self.units, self._old_names)
        return Table({**self._columns, name: values}, self.units, self._old_names)

    def where(self, mask: np.ndarray) -> "Table":
        """The rows for which `mask` (n_rows) is true, or those it names by index."""
        if isinstance(self._columns, LateColumns):
            return Table(self._columns.where(mask), self.units, self._old_names)
        return Table({name: values[mask] for name, values in self._columns.items()}, self.units, self._old_names)


def _cell(value: object) -> str:
    """A value as a short text."""
    if isinstance(value, float | np.floating):
        return f"{value:.6g}"
    text = " ".join(str(value).split())
    return text if len(text) <= _MAX_CELL_WIDTH else text[: _MAX_CELL_WIDTH - 4] + " ..."
