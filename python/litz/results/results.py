"""The results of a run as numpy arrays."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from ..base.names import unknown_name
from ..base.notebook import shown_by
from ..base.table import Table
from . import along_cable, exports, interstrand, network, summary
from .circuit import Circuit, build_circuit
from .contact_history import contacts_over_time
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
    def contacts_over_time(self) -> Table:
        """Numbers of contacts and sums of their forces: a row for each increment in the file.

        `contacts` are `crossings` by themselves, `zones` of contact along lines, and elements `on_surfaces`, which are rigid;
        `force` is the sum of `force_between_wires` and `force_on_surfaces`, of their sizes and not their resultant;
        `max_force_per_length` is the largest of the wires that touch along lines. At increments without contacts in the
        ledger (`has_contacts`) what counts those of wires is nan.
        """
        return contacts_over_time(self, self.steps, self.increments)

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

    def interstrand_resistance(
        self,
        increment: int = -1,
        *,
        at: float = 0.0,
        superconducting: bool | None = None,
        bundles: Sequence[str] | Mapping[str, Sequence[int]] | None = None,
    ) -> interstrand.InterstrandResistance:
        """Resistance between any two wires, from a circuit of all contacts and of the metal between them; needs SciPy.

        It is what a measurement would give whose current enters one wire and leaves another, at the contacts, temperatures and
        resistivities of this increment. Terminals, potentials and equations of the deck take no part, and rigid
        surfaces neither: wires that only a plate joins have an infinite one.

        Parameters
        ----------
        increment : int
            Index of the increment.
        at : float
            Where the current enters the wires: 0 at their first nodes, 1 at the last ones, 0.5 in the middle.
        superconducting : bool, optional
            Which wires have no resistance along them: None those with superconducting filaments, at currents below the
            critical one; True all; False none.
        bundles : sequence of str or dict, optional
            Element sets that are bundles of wires, or the wires (counted from 0) of each by name, for the stage of each pair.
            Default: those that `litz.build.cable` makes.

        Returns
        -------
        InterstrandResistance
            `matrix` [ohm], `table()`, `stages()` with means and medians within and between the
            stages, of pairs that are joined, and how many are not, `between("BUNDLE1", "BUNDLE2")`.

        Examples
        --------
        >>> found = results.interstrand_resistance()                                    # doctest: +SKIP
        >>> found.matrix[0, 1]                                                          # doctest: +SKIP
        """
        return interstrand.interstrand_resistance(
            self, increment, at=at, superconducting=superconducting, bundles=bundles
        )

    def redistribution_lengths(self, increment: int = -1, *, superconducting: bool | None = None) -> np.ndarray:
        """Lengths along the wires over which unequal currents even out, the longest first, (n_wires - 1) [m]; needs SciPy.

        Differences between the currents of n wires that conduct into each other all along decay with exp(-x/l) in n - 1
        modes: 1/l^2 are the eigenvalues of resistance times conductance per length, those of the whole model taken as spread
        evenly. Two wires: 1/l^2 = (r_1 + r_2) g. Infinite where wires do not touch or have no resistance.

        Parameters
        ----------
        increment, superconducting
            As those of `interstrand_resistance`.
        """
        return interstrand.redistribution_lengths(self, increment, superconducting=superconducting)

    def circuit(self, increment: int = -1, *, superconducting: bool | None = None) -> Circuit:
        """Pieces of wire and all places of contacts as resistances between points, for programs that solve circuits.

        `to_csv`, `to_graphml` and `to_networkx` write it. Parameters as those of `interstrand_resistance`.
        """
        return build_circuit(self, increment, superconducting=superconducting)[0]

    def current_shares(self, increment: int = -1, count: int = 201) -> along_cable.CurrentShares:
        """Currents of all wires at places along a cable, and their shares of the whole.

        The axis of the cable leads from one end of the wires to the other; between the nodes of a wire its current is taken as
        linear.

        Parameters
        ----------
        increment : int
            Index of the increment.
        count : int
            Number of places, evenly from one end to the other, as far as all wires reach.

        Returns
        -------
        CurrentShares
            `place` (m) [m]; `current` (n_wires, m) [A] and `share`, in the order of `wires`; `total` (m) [A].
        """
        return along_cable.current_shares(self, increment, count)

    def along_cable(self, increment: int = -1, count: int = 20) -> Table:
        """Contact forces, conductances and heat per length of a cable: a row for each of `count` slices across it.

        Returns
        -------
        Table
            `place`: middle of the slice along the axis; `force_per_length`, `conductance_per_length`,
            `contact_heat_per_length`: sums of all contacts between wires in it over its thickness; `wire_heat_per_length`;
            where currents enter rigid surfaces `heat_on_surfaces_per_length`, of both halves of these contacts.
        """
        return along_cable.along_cable(self, increment, count)

    def wire_heat(self, increment: int = -1) -> Table:
        """Joule heat of each wire: a row for each, in the order of `wires`.

        Returns
        -------
        Table
            `wire`, counted from 0; `length`; `along`: heat of the currents along the wire; `contacts`: half of the heat of
            each of its contacts, those with rigid surfaces among them; `total`, and `per_length`.
        """
        return along_cable.wire_heat(self, increment)

    def along_wires(self, increment: int = -1) -> Table:
        """Results of the elements along the wires: a row for each element, in the order of wires and along each.

        Returns
        -------
        Table
            `wire`, counted from 0; `element`: its number in the deck; `arc`: middle of the element along the wire before
            deformation; `x`, `y`, `z` after it; and all scalar fields of elements, such as `axial_strain`, `strain_max`
            and `strain_min` where a step asks for them; currents count along the wire.
        """
        return along_cable.along_wires(self, increment)

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
