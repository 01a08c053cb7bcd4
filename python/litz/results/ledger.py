"""The contact ledger from the file of contacts that a run writes for ParaView.

The text table beside it has the same numbers, and is many times slower to read: a million rows take 20 s.
"""

from collections.abc import Mapping
from pathlib import Path

import h5py
import numpy as np

from ..base.table import LateColumns, Table
from .text_tables import count_rows, old_names_of, read_csv, read_last_column, read_units

#: What numbers of the column `friction` stand for
_FRICTION = np.array(["none", "stick", "slip"])
#: Rows up to which all columns are read at once
_FEW_ROWS = 50_000


def read_ledger(path: Path, steps: np.ndarray, increments: np.ndarray, times: np.ndarray) -> Table:
    """The contact ledger of a text table: from the file of contacts beside it, where that has all of it.

    It has not where contacts are written more often than fields.

    Parameters
    ----------
    path : Path
        The text table.
    steps, increments, times : ndarray
        Of each increment in the result file that has its contacts in the ledger, (n_increments).
    """
    units = read_units(path)
    try:
        columns = _columns(path, list(units), {"step": steps, "increment": increments, "time": times})
        return Table(columns, units, old_names_of(columns))
    except (OSError, RuntimeError, KeyError):
        return read_csv(path)


def of_the_cell(ledger: Table, ids: np.ndarray, images: np.ndarray, counted: np.ndarray) -> Table:
    """A ledger in which each contact of a cell with periodic ends is once.

    Parameters
    ----------
    ledger : Table
        With the contacts of all elements.
    ids, images : (n_elements) arrays
        Number of each element, and whether it is an image of another one, beyond the ends of the cell.
    counted : (n_elements) array of bool
        Images whose contacts with elements of the cell count; others have these a second time.
    """
    if not images.any() or not ledger.n_rows:
        return ledger
    rows = [rows_of(ids, ledger[f"element_{side}"]) for side in (1, 2)]
    within = ~images[rows[0]] | ~images[rows[1]]
    return ledger.where(within & np.all([~images[row] | counted[row] for row in rows], axis=0))


def at_ends(ledger: Table, ids: np.ndarray, images: np.ndarray, end: np.ndarray, xi: np.ndarray) -> Table:
    """A ledger in which contacts on images are at the ends of the wires from which these go on.

    Parameters
    ----------
    ledger, ids, images
        As those of `of_the_cell`.
    end, xi : (n_elements) arrays
        Rows of the elements from which images go on, and at which end of them, -1 or 1.
    """
    if not images.any() or not ledger.n_rows:
        return ledger
    columns = {name: ledger[name] for name in ledger}
    for side in (1, 2):
        row = rows_of(ids, ledger[f"element_{side}"])
        beyond = images[row]
        columns[f"element_{side}"] = np.where(beyond, ids[end[row]], ledger[f"element_{side}"])
        columns[f"xi_{side}"] = np.where(beyond, xi[row], ledger[f"xi_{side}"])
    return Table(columns, ledger.units, old_names_of(columns))


def rows_of(ids: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Rows of elements or nodes, given the numbers of all and of those that are wanted."""
    order = np.argsort(ids)
    return order[np.searchsorted(ids, wanted, sorter=order)]


def _columns(path: Path, names: list[str], numbers: dict[str, np.ndarray]) -> Mapping[str, np.ndarray]:
    """Columns by name, (n_rows) each; `status`, which is text alone, is that of the text table.

    Many rows of a finished run are read when they are needed, if the files are still those of this run.
    """
    n = len(numbers["step"])
    fields = path.with_suffix(".vtkhdf")
    with h5py.File(fields, "r", locking=False) as file:
        rows = file["VTKHDF/NumberOfPoints"][:][file["VTKHDF/Steps/PartOffsets"][:n]]
        if len(rows) < n:
            raise KeyError(f"{path} has more increments than the file of contacts")
        n_rows = int(rows.sum())
        late = n_rows > _FEW_ROWS and bool(file["litz"].attrs.get("finished", 0))
        for name in names:
            if name not in (*numbers, "status"):
                _column(file["VTKHDF/PointData"], name, 0)
    n_lines = count_rows(path)
    if n_lines > n_rows:
        raise KeyError(f"{path} has more rows than the file of contacts")

    stamps = {file: _stamp(file) for file in (path, fields)}

    def read(name: str) -> np.ndarray:
        for file, stamp in stamps.items():
            if _stamp(file) != stamp:
                raise RuntimeError(
                    f"{file} has been written anew since these contacts were asked for: open the results again"
                )
        if name == "status":
            texts = np.zeros(n_rows, dtype="U1")
            found = read_last_column(path)[:n_rows]
            return np.concatenate([found, texts[len(found) :]])
        if name in numbers:
            return np.repeat(numbers[name], rows)
        with h5py.File(fields, "r", locking=False) as file:
            return _column(file["VTKHDF/PointData"], name, n_rows)

    return LateColumns(names, read, n_rows) if late else {name: read(name) for name in names}


def _stamp(path: Path) -> tuple[int, int, int]:
    """What changes when a file is written anew."""
    found = path.stat()
    return found.st_ino, found.st_size, found.st_mtime_ns


def _column(fields: h5py.Group, name: str, n_rows: int) -> np.ndarray:
    """A field of the file, or a component of one that is a vector."""
    field, _, axis = name.rpartition("_")
    if name not in fields and axis in ("x", "y", "z") and field in fields:
        return fields[field][:n_rows, "xyz".index(axis)]
    values = fields[name][:n_rows]
    return _FRICTION[values] if name == "friction" else values
