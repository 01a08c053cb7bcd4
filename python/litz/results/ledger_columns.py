"""The columns of a contact ledger from the file of contacts that a run writes for ParaView, each when it is asked for.

The text table beside it has the same numbers, and is many times slower to read: a million rows take 20 s.
"""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import h5py
import numpy as np

#: What numbers of the column `friction` stand for
_FRICTION = np.array(["none", "stick", "slip"])
_NUMBERS = ("step", "increment", "time")


class LedgerColumns(Mapping):
    """Columns by name, (n_rows) each; `status`, which is text alone, from the text table.

    Parameters
    ----------
    path : Path
        The file of contacts.
    names : sequence of str
        Columns of the text table.
    numbers : dict of ndarray
        Step, increment and time of each increment, (n_increments).
    status : callable
        Reads the status of each row from the text table.
    """

    def __init__(
        self,
        path: Path,
        names: list[str],
        numbers: dict[str, np.ndarray],
        status: Callable[[], np.ndarray],
    ):
        self._path = path
        self._names = names
        self._status = status
        self._read: dict[str, np.ndarray] = {}
        with h5py.File(path, "r", locking=False) as file:
            parts = file["VTKHDF/Steps/PartOffsets"][: len(numbers["step"])]
            rows = file["VTKHDF/NumberOfPoints"][:][parts]
            present = set(file["VTKHDF/PointData"])
        missing = [name for name in names if not (name in (*_NUMBERS, "status") or _place(name, present)[0] in present)]
        if missing or len(rows) < len(numbers["step"]):
            raise KeyError(f"{path} does not have {missing or 'all increments'}")
        self.n_rows = int(rows.sum())
        self._read |= {name: np.repeat(values, rows) for name, values in numbers.items()}
        self._places = {name: _place(name, present) for name in names}

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._read:
            self._read[name] = self._column(name)
        return self._read[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def _column(self, name: str) -> np.ndarray:
        if name not in self._places:
            raise KeyError(name)
        if name == "status":
            return self._status()[: self.n_rows]
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
