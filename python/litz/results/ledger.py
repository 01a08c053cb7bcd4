"""The contact ledger from the file of contacts that a run writes for ParaView.

The text table beside it has the same numbers, and is many times slower to read: a million rows take 20 s.
"""

from pathlib import Path

import h5py
import numpy as np

from ..base.table import LateColumns, Table
from .text_tables import count_rows, old_names_of, read_csv, read_last_column, read_units

#: What numbers of the column `friction` stand for
_FRICTION = np.array(["none", "stick", "slip"])


def read_ledger(path: Path, steps: np.ndarray, increments: np.ndarray, times: np.ndarray, images: np.ndarray) -> Table:
    """The contact ledger of a text table: from the file of contacts beside it, where that has all of it.

    It has not where contacts are written more often than fields.

    Parameters
    ----------
    path : Path
        The text table.
    steps, increments, times : ndarray
        Of each increment in the result file that has its contacts in the ledger, (n_increments).
    images : ndarray
        Numbers of the elements whose contacts are left out.
    """
    units = read_units(path)
    try:
        columns = _columns(path, list(units), {"step": steps, "increment": increments, "time": times})
        ledger = Table(columns, units, old_names_of(columns))
    except (OSError, RuntimeError, KeyError):
        ledger = read_csv(path)
    if not len(images) or not ledger.n_rows:
        return ledger
    return ledger.where(~(np.isin(ledger["element_1"], images) | np.isin(ledger["element_2"], images)))


def _columns(path: Path, names: list[str], numbers: dict[str, np.ndarray]) -> LateColumns:
    """Columns by name, (n_rows) each, read when they are needed; `status`, which is text alone, is that of the text table."""
    n = len(numbers["step"])
    fields = path.with_suffix(".vtkhdf")
    with h5py.File(fields, "r", locking=False) as file:
        rows = file["VTKHDF/NumberOfPoints"][:][file["VTKHDF/Steps/PartOffsets"][:n]]
        if len(rows) < n:
            raise KeyError(f"{path} has more increments than the file of contacts")
        n_rows = int(rows.sum())
        for name in names:
            if name not in (*numbers, "status"):
                _column(file["VTKHDF/PointData"], name, 0)
    n_lines = count_rows(path)
    if n_lines > n_rows:
        raise KeyError(f"{path} has more rows than the file of contacts")

    def read(name: str) -> np.ndarray:
        if name == "status":
            texts = np.zeros(n_rows, dtype="U1")
            found = read_last_column(path)[:n_rows]
            return np.concatenate([found, texts[len(found) :]])
        if name in numbers:
            return np.repeat(numbers[name], rows)
        with h5py.File(fields, "r", locking=False) as file:
            return _column(file["VTKHDF/PointData"], name, n_rows)

    return LateColumns(names, read, n_rows)


def _column(fields: h5py.Group, name: str, n_rows: int) -> np.ndarray:
    """A field of the file, or a component of one that is a vector."""
    field, _, axis = name.rpartition("_")
    if name not in fields and axis in ("x", "y", "z") and field in fields:
        return fields[field][:n_rows, "xyz".index(axis)]
    values = fields[name][:n_rows]
    return _FRICTION[values] if name == "friction" else values
