"""The files of a run, read when they are asked for."""

import contextlib
import warnings
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import h5py
import numpy as np

from ..base.names import unknown_field, unknown_name
from ..base.table import Table
from ..errors import FileError, WarningEntry
from .contact_increments import contacts_written, refuse_missing
from .found_files import find_result_file
from .hdf5_values import n_steps, numbers_of, text_of
from .ledger import at_ends, of_the_cell, read_ledger
from .result_mesh import ResultMesh
from .run_warnings import read_warnings
from .text_tables import read_aligned, read_csv, read_units

if TYPE_CHECKING:
    import pandas as pd


_FORMAT_VERSION = 1
_AUDIT = ("force_balance", "moment_balance", "current_balance", "power_balance", "penetration_ratio")
_GROUPS = ("PointData", "CellData")


class ResultFile(ResultMesh):
    """The files of a run; `Results` adds what follows from them.

    Attributes
    ----------
    path : Path
        The result file of the wires.
    """

    def __init__(self, path: str | PathLike[str]):
        super().__init__(find_result_file(Path(path)))
        self._tables: dict[tuple[str, str], tuple[int, Table]] = {}
        self._kept_count: int | None = None
        self._kept_places: dict[str, tuple[h5py.Dataset, np.ndarray, int]] = {}
        with self._open() as file:
            version = int(file["litz"].attrs["format_version"])
            if version > _FORMAT_VERSION:
                raise FileError(
                    f"{self.path} was written by a newer litz: "
                    f"it has format {version}, this litz reads up to {_FORMAT_VERSION}"
                )
        if not self.finished:
            end = f"ends at time {self.times[-1]:g}" if len(self.times) else "has no increment"
            restart = self.path.with_suffix(".restart.h5")
            more = f"; continue with litz run DECK --restart {restart} -o DIR" if restart.exists() else ""
            warnings.warn(f"{self.path}: the run did not finish (or still runs); it {end}{more}", stacklevel=2)

    def __repr__(self) -> str:
        """File, sizes and whether the run finished."""
        state = "finished" if self.finished else "not finished"
        sizes = f"{len(self.nodes)} nodes, {len(self.elements)} elements, {len(self.times)} increments"
        return f"<Results {self.path}: {sizes}, {state}>"

    @contextlib.contextmanager
    def kept_open(self) -> Iterator[None]:
        """Within this block the file stays open, which is faster where much is read; what a run adds meanwhile is not seen."""
        if self._kept is not None:
            yield
            return
        with self._open() as file:
            self._kept = file
            try:
                yield
            finally:
                self._kept = self._kept_count = None
                self._kept_places.clear()

    # Where the results come from

    @property
    def finished(self) -> bool:
        """Whether the run was completed."""
        with self._open() as file:
            return bool(file["litz"].attrs["finished"])

    @cached_property
    def heading(self) -> str:
        """The ``*HEADING`` of the deck."""
        with self._open() as file:
            return text_of(file["litz"].attrs["heading"])

    @cached_property
    def version(self) -> str:
        """The version of litz that wrote the results."""
        with self._open() as file:
            return text_of(file["litz"].attrs["version"])

    @cached_property
    def deck(self) -> str:
        """The text of the deck, with its included files."""
        with self._open() as file:
            return text_of(file["litz/deck"][()])

    # Time

    @property
    def times(self) -> np.ndarray:
        """Total time of each increment, (n_increments) [s]."""
        with self._open() as file:
            return file["VTKHDF/Steps/Values"][: self._n_whole(file)]

    @property
    def steps(self) -> np.ndarray:
        """Number of the step of each increment, (n_increments)."""
        return self._increment_table("step")

    @property
    def increments(self) -> np.ndarray:
        """Number of each increment in its step, (n_increments)."""
        return self._increment_table("increment")

    @property
    def audit(self) -> dict[str, np.ndarray]:
        """Worst figures of the audit of each increment, (n_increments) [-].

        Residuals of sums that should vanish, relative to the largest force, moment, current or power in them:
        `force_balance`, `moment_balance`, `current_balance`, `power_balance`; and `penetration_ratio`, the deepest
        overlap over the smaller radius.
        """
        return {name: self._increment_table(name) for name in _AUDIT}

    @property
    def warnings(self) -> list[WarningEntry]:
        """The warnings of the run so far, in the order of their occurrence."""
        return read_warnings(self.path)

    def _increment_table(self, name: str) -> np.ndarray:
        with self._open() as file:
            return file[f"litz/increments/{name}"][: self._n_whole(file)]

    def index(self, step: int, increment: int) -> int:
        """Index of an increment, given the numbers of its step and of itself in the step."""
        found = np.flatnonzero((self.steps == step) & (self.increments == increment))
        if not len(found):
            raise KeyError(f"increment {increment} of step {step} is not in {self.path}")
        return int(found[0])

    # Fields

    @cached_property
    def fields(self) -> dict[str, str]:
        """Description of each field by its name."""
        return {name: attributes.get("description", "") for name, attributes in self._attributes.items()}

    @cached_property
    def units(self) -> Mapping[str, str]:
        """Unit of each field by its name; of the columns of tables: `history.units` and the like."""
        return {name: attributes.get("unit", "") for name, attributes in self._attributes.items()}

    @cached_property
    def unit_labels(self) -> dict[str, str]:
        """What the units of the deck are called (`*UNITS`), by their SI symbols: m, N, s, A, V, N m, W, ohm, J."""
        fields, ledger = self.units, self.contact_units
        return {
            "m": fields["displacement"],
            "N": fields["reaction_force"],
            "s": ledger["time"],
            "A": fields["reaction_current"],
            "V": fields["potential"],
            "N m": fields["reaction_moment"],
            "W": fields["joule_heat"],
            "ohm": ledger["resistance"],
            "J": ledger["dissipation"],
        }

    def unit(self, name: str) -> str:
        """Unit of a field, or of a column of the contacts or the history; "1" where it has none.

        Examples
        --------
        >>> results.unit("displacement"), results.unit("resistance")    # doctest: +SKIP
        ('m', 'ohm')
        """
        for units in (self.units, self.contact_units, self.history.units):
            if name in units:
                return units[name] or "1"
        known = [*self.units, *self.contact_units, *self.history.units]
        raise KeyError(unknown_name("field or column", name, known))

    @cached_property
    def point_fields(self) -> frozenset[str]:
        """Names of the fields over nodes; the others are over elements."""
        with self._open() as file:
            return frozenset(file["VTKHDF/PointData"])

    @cached_property
    def vector_fields(self) -> frozenset[str]:
        """Names of the fields that are vectors; the others are scalars."""
        with self._open() as file:
            return frozenset(
                name for group in _GROUPS for name, data in file["VTKHDF"][group].items() if data.ndim == 2
            )

    @cached_property
    def _attributes(self) -> dict[str, dict[str, str]]:
        with self._open() as file:
            return {
                name: {key: text_of(value) for key, value in dataset.attrs.items()}
                for group in _GROUPS
                for name, dataset in file["VTKHDF"][group].items()
            }

    def field(self, name: str, increment: int | None = -1) -> np.ndarray:
        """A field over nodes or elements.

        Parameters
        ----------
        name : str
            One of `fields`.
        increment : int, optional
            Index of the increment; None: all of them, stacked along a new first axis.

        Returns
        -------
        ndarray
            (n_nodes or n_elements) for a scalar, (..., 3) for a vector, in the unit that `units` has for it.
        """
        if name not in self._attributes:
            raise KeyError(unknown_field(name, self._attributes))
        with self._open() as file:
            data, starts, n_rows = self._place_of(name, file)
            if increment is not None:
                start = starts[self._checked(increment, file)]
                return data[start : start + n_rows]
            return np.array([data[start : start + n_rows] for start in starts[: self._n_whole(file)]])

    def _place_of(self, name: str, file: h5py.File) -> tuple[h5py.Dataset, np.ndarray, int]:
        """A field of all increments, its first row at each, and its number of rows."""
        if file is self._kept and name in self._kept_places:
            return self._kept_places[name]
        group, n_rows = (
            ("PointData", len(self.nodes)) if name in self.point_fields else ("CellData", len(self.elements))
        )
        found = file["VTKHDF"][group][name], file[f"VTKHDF/Steps/{group}Offsets/{name}"][:], n_rows
        if file is self._kept:
            self._kept_places[name] = found
        return found

    def positions(self, increment: int = -1) -> np.ndarray:
        """Current positions of the nodes, (n_nodes, 3) [m]."""
        return self.nodes + self.field("displacement", increment)

    def _checked(self, increment: int, file: h5py.File) -> int:
        n = self._n_whole(file)
        if not -n <= increment < n:
            raise IndexError(f"increment {increment} is not in {self.path}, which has {n} increments")
        return increment % n

    # Tables

    @property
    def history(self) -> Table:
        """The columns requested in the deck, over all increments."""
        return self._whole(self._table("_history.csv", read_csv))

    @property
    def contacts(self) -> Table:
        """The contact ledger: a row for each contact at each increment that has its own there.

        A contact across the periodic ends of a cell is there once, between the two wires that touch; it enters the one that
        reaches beyond the cell at its end.
        """
        return self._whole(self._table("_contacts.csv", self._ledger_on_wires))

    def conductor_contacts_at(self, increment: int = -1) -> Table:
        """The contacts at one increment as `contacts_at` has them, those across the ends of a cell on `conducting_images`."""
        refuse_missing(self.path, self.steps, self.increments, self.has_contacts(), increment)
        return self._at(self._whole(self._table("_contacts.csv", self._read_ledger)), increment)

    def _read_ledger(self, path: Path) -> Table:
        has = self.has_contacts()
        ledger = read_ledger(path, self.steps[has], self.increments[has], self.times[has])
        return of_the_cell(ledger, self.element_ids, self.images, self.conducting_images)

    def _ledger_on_wires(self, path: Path) -> Table:
        ledger = self._table("_contacts.csv", self._read_ledger)
        return at_ends(ledger, self.element_ids, self.images, *self._ends_of_images)

    def has_contacts(self, steps: np.ndarray | None = None, increments: np.ndarray | None = None) -> np.ndarray:
        """Whether the contacts of each increment (default: those in the file) are in the ledger: `*CONTACT FILE`."""
        if steps is None or increments is None:
            steps, increments = self.steps, self.increments
        with self._open() as file:
            return contacts_written(file, steps, increments)

    @cached_property
    def contact_units(self) -> dict[str, str]:
        """Unit of each column of the contact ledger, without reading its rows."""
        return read_units(self._beside("_contacts.csv")[0])

    @property
    def surface_contacts(self) -> Table:
        """The contacts with rigid surfaces, if there are any: a row for each element that touches one, at each increment."""
        if not self.rigid_surfaces:
            return Table({}, {})
        return self._whole(self._table("_surfaces.csv", read_csv))

    def surface_contacts_at(self, increment: int = -1) -> Table:
        """The contacts with rigid surfaces at one increment."""
        return self._at(self.surface_contacts, increment)

    def contacts_at(self, increment: int = -1) -> Table:
        """The contacts at one increment, which has to have them in the ledger (`has_contacts`)."""
        rows = self.written_contacts_at(increment)
        refuse_missing(self.path, self.steps, self.increments, self.has_contacts(), increment)
        return rows

    def written_contacts_at(self, increment: int = -1) -> Table:
        """The contacts at one increment; no rows where the ledger has none of it."""
        return self._at(self.contacts, increment)

    def _at(self, table: Table, increment: int) -> Table:
        """The rows of one increment."""
        with self._open() as file:
            increment = self._checked(increment, file)
        if not table.n_rows:
            return table
        here = (table["step"] == self.steps[increment]) & (table["increment"] == self.increments[increment])
        return table.where(here)

    def contact(self, contact_id: int) -> Table:
        """One contact over its life."""
        ledger = self.contacts
        rows = ledger.where(ledger["id"] == contact_id)
        if not rows.n_rows:
            raise KeyError(f"there is no contact {contact_id}; there are {np.unique(ledger['id'])}")
        return rows

    @property
    def status(self) -> Table:
        """The .sta table: a row per increment, also of those that were cut back."""
        return self._table(".sta", read_aligned)

    @property
    def convergence(self) -> Table:
        """The .cvg table: a row per iteration."""
        return self._table(".cvg", read_aligned)

    # A run writes the fields of an increment first, then the tables, and finally its line of the .sta table. An increment
    # without a line there is not (or, after a kill, will never be) complete in all files.

    def _last_whole(self, file: h5py.File) -> tuple[int, int] | None:
        """Step and increment of the last increment that is complete in all files; None: all of them."""
        if file["litz"].attrs["finished"] or not self.path.with_suffix(".sta").exists():
            return None
        status = self.status
        done = [k for k in range(status.n_rows) if not status["remark"][k].startswith("cut")]
        if done:
            return int(status["step"][done[-1]]), int(status["increment"][done[-1]])
        return numbers_of(file, 0) if n_steps(file) else None

    def _n_whole(self, file: h5py.File) -> int:
        """Number of increments in the result file that are complete in all files."""
        if file is self._kept and self._kept_count is not None:
            return self._kept_count
        n, last = n_steps(file), self._last_whole(file)
        while last is not None and n > 1 and numbers_of(file, n - 1) > last:
            n -= 1
        if file is self._kept:
            self._kept_count = n
        return n

    def _whole(self, table: Table) -> Table:
        """The rows of a table up to the last increment that is complete in all files."""
        with self._open() as file:
            last = self._last_whole(file)
        if last is None or not table.n_rows:
            return table
        later = (table["step"] > last[0]) | ((table["step"] == last[0]) & (table["increment"] > last[1]))
        return table.where(~later) if later.any() else table

    def _table(self, ending: str, read: Callable[[Path], Table]) -> Table:
        """A table beside the result file; read again when it has grown, as during a run."""
        path, size = self._beside(ending)
        key = (ending, read.__name__)
        if self._tables.get(key, (None, None))[0] != size:
            self._tables[key] = (size, read(path))
        return self._tables[key][1]

    def _beside(self, ending: str) -> tuple[Path, int]:
        """A file beside the result file, and its size."""
        path = self.path.with_name(self.path.stem + ending)
        try:
            return path, path.stat().st_size
        except OSError as error:
            raise FileError(f"cannot read {path}: {error.strerror}") from None

    def to_pandas(self, table: str = "history") -> "pd.DataFrame":
        """A table as a data frame of pandas; needs pandas.

        Parameters
        ----------
        table : str
            "history", "contacts", "surface_contacts", "status" or "convergence".
        """
        tables = ("history", "contacts", "surface_contacts", "status", "convergence")
        if table not in tables:
            raise ValueError(unknown_name("table", table, tables))
        return getattr(self, table).to_pandas()
