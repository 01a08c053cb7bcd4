"""The columns of a contact ledger from the file of contacts that a run writes for ParaView, each when it is asked for.

The text table beside it has the same numbers, and is many times slower to read: a million rows take 20 s.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path

import h5py
import numpy as np

from ..base.table import Table
from .text_tables import read_csv, read_last_column, read_units

#: What numbers of the column `friction` stand for
_FRICTION = np.array(["none", "stick", "slip"])


def read_ledger(path: Path, steps: np.ndarray, increments: np.ndarray, times: np.ndarray) -> Table:
    """The contact ledger of a text table: from the file of contacts beside it, where that has all of it.

    Parameters
    ----------
    path : Path
        The text table.
    steps, increments, times : ndarray
        Of each increment of the run, (n_increments).
    """
    units = read_units(path)
    try:
        return Table(_LedgerColumns(path, list(units), {"step": steps, "increment": increments, "time": times}), units)
    except (OSError, RuntimeError, KeyError):
        return read_csv(path)


class _LedgerColumns(Mapping):
    """Columns by name, (n_rows) each; `status`, which is text alone, is that of the text table."""

    def __init__(self, path: Path, names: list[str], numbers: dict[str, np.ndarray]):
        self._path, self._text = path.with_suffix(".vtkhdf"), path
        self._names = names
        self._read: dict[str, np.ndarray] = {}
        with h5py.File(self._path, "r", locking=False) as file:
            parts = file["VTKHDF/Steps/PartOffsets"][: len(numbers["step"])]
            rows = file["VTKHDF/NumberOfPoints"][:][parts]
            present = set(file["VTKHDF/PointData"])
        self._places = {name: _place(name, present) for name in names if name not in (*numbers, "status")}
        missing = [name for name, (field, _) in self._places.items() if field not in present]
        if missing or len(rows) < len(numbers["step"]):
            raise KeyError(f"{self._path} does not have {missing or 'all increments'}")
        self.n_rows = int(rows.sum())
        self._read |= {name: np.repeat(values, rows) for name, values in numbers.items()}

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._read:
            self._read[name] = self._column(name)
        return self._read[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def _column(self, name: str) -> np.ndarray:
        if name == "status" and name in self._names:
            return read_last_column(self._text)[: self.n_rows]
        field, component = self._places[name]
        with h5py.File(self._path, "r", locking=False) as file:
            data = file["VTKHDF/PointData"][field]
            values = data[: self.n_rows] if component is None else data[: self.n_rows, component]
        return _FRICTION[values] if name == "friction" else values


def _place(name: str, present: set[str]) -> tuple[str, int | None]:
    """Field of the file, and component of it where that is a vector."""
    field, _, axis = name.rpartition("_")
    if name not in present and axis in ("x", "y", "z") and field in present:
        return field, "xyz".index(axis)
    return name, None
