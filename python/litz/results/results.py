"""The results of a run as numpy arrays."""

from pathlib import Path

import numpy as np

from ..base.names import unknown_name
from ..base.notebook import shown_by
from ..base.table import Table
from . import exports, network, summary
from .contact_places import ContactPlaces, contact_places
from .contact_zones import contact_zones, wire_pairs
from .result_file import ResultFile
from .surface_forces import surface_forces


class Results(ResultFile):
    """The results of a run; every array is read on demand.

    Parameters
    ----------
    path : path
        The result file `STEM.vtkhdf`, the same without suffix, the deck `STEM.inp` (the results beside it or in the
        current directory), or a directory with the results of one run.

    Notes
    -----
    An argument `increment` counts the increments in the file from 0, or from the end with -1, -2, ... as Python does;
    `index(step, increment)` finds the one of a given number.

    Examples
    --------
    After ``litz run inputs/01_crossed_wires.inp``:

    >>> import litz
    >>> results = litz.Results("01_crossed_wires.vtkhdf")
    >>> results.field("potential").shape                                # (n_nodes,) at the last increment
    (24,)
    >>> print(f"{results.field('potential').max():g} V")
    0.001 V
    >>> resistance = results.history["resistance PLUS to MINUS"]        # over time
    >>> print(f"{1e3 * resistance[-1]:.3f} mohm, {results.contacts_at(-1)['force'][0]:.2f} N")
    0.936 mohm, 0.90 N
    """

    def _repr_html_(self) -> str | None:
        """The viewer with its data inside, for notebooks; also for those that are opened later without litz."""
        return shown_by("viewer.inlined", self)

    @property
    def surface_forces(self) -> Table:
        """What each rigid surface feels of all wires, with friction: a row for each surface and increment.

        `force` is the sum of the contact forces, `surface_force` the resultant and `surface_moment` its moment about the
        reference node, or about the origin for a surface that is fixed in space. In balance they are what the
        loads on the reference node and its reactions do to it, reversed.
        """
        return surface_forces(self)

    def conductance(self, plus: str, minus: str, increment: int = -1) -> float:
        """Conductance between two electrodes: current over voltage [S].

        Parameters
        ----------
        plus, minus : str
            Node sets with prescribed potential, or with currents applied.
        increment : int
            Index of the increment.
        """
        for name in (plus, minus):
            if name not in self.node_sets:
                raise KeyError(unknown_name("node set", name, self.node_sets))
        return network.conductance(self, plus, minus, increment)

    def wire_currents(self, increment: int = -1) -> np.ndarray:
        """Largest current along each wire, with its sign, in the order of `wires`, (n_wires) [A]."""
        return network.wire_currents(self, increment)

    def contact_network(self, increment: int = -1, *, every_place: bool = False) -> network.ContactNetwork:
        """Wires and the closed contacts between them, as arrays; `to_csv` and `to_graphml` write them.

        Parameters
        ----------
        increment : int
            Index of the increment.
        every_place : bool
            Each place of a line contact is a contact of its own, as in the ledger; else a zone of line contact is one.
        """
        return network.contact_network(self, increment, every_place=every_place)

    def contact_zones(self, increment: int = -1) -> Table:
        """Contact along lines at an increment: a row for each zone, a stretch of two wires that touch without a break.

        Parameters
        ----------
        increment : int
            Index of the increment.

        Returns
        -------
        Table
            `id`: the lowest number of its contacts in the ledger; `wire_1`, `wire_2`: wires, counted from 0, the same for a
            wire that touches itself; `arc_1_begin`, `arc_1_end`, `arc_2_begin`, `arc_2_end`: where it begins and ends on
            either wire before deformation, to half a distance of places (on rings an arc may exceed the length of the
            wire); `begin_x` to `end_z`: its first and last place; `length`; `gap`: the smallest; `places` and `crossings`:
            rows of the ledger in it; `force`, `current` (from `wire_1` to `wire_2`), `joule_heat`, `conductance`: their
            sums; `force_per_length`, `current_per_length`, `heat_per_length`: the means, and `max_force_per_length` etc.
            the largest sizes at a place.
        """
        return contact_zones(self._places(increment), self.unit_labels)

    def wire_pairs(self, increment: int = -1) -> Table:
        """What passes between two wires in all at an increment: a row for each pair of wires that touch.

        Parameters
        ----------
        increment : int
            Index of the increment.

        Returns
        -------
        Table
            `wire_1`, `wire_2`: wires, counted from 0; `zones`: number of zones of line contact, with their `length`;
            `crossings`; `force`, `current` (from `wire_1` to `wire_2`), `joule_heat`, `conductance`: sums of all contacts.
        """
        return wire_pairs(self._places(increment), self.unit_labels)

    def _places(self, increment: int) -> ContactPlaces:
        return contact_places(self, self.contacts_at(increment))

    def export(self, to: str, directory: str | Path | None = None) -> Path:
        """Write the results for another program: "csv", "vtu", "xdmf" or "vtkhdf"; see `litz.export`."""
        return exports.export(self, to, directory)

    def summary(self) -> str:
        """A page of text about the run: what was run, how it went, and the last increment in numbers."""
        return summary.summary(self)
