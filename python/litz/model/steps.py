"""Load steps: prescribed values, loads, output requests, solution controls."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

from numpy.typing import ArrayLike

from ..deck.keyword_table import check_card, keyword, squeezed
from ..deck.lines import CardSpec
from .increments import SMALLEST_FRACTION, first_and_largest, procedure_parameters
from .loading import (
    Amplitude,
    Direction,
    ElementLoad,
    Load,
    Prescribed,
    Temperature,
    degree_of_freedom,
    degrees_of_freedom,
    directions_of,
    field_rows,
    grouped,
    ranges_of,
)
from .names import AnyNodes, Names
from .wires import WireGroup

#: Default of INC: its ratio to the number of increments without cut-backs, and its minimum
_INC_RATIO = 10
_MIN_INC = 100


class Step:
    """A load step, made by `Model.step`.

    Prescribed values change linearly from those at the start of the step to the given ones, or follow an amplitude.
    Values, loads and controls of earlier steps remain in force unless they are changed.

    Attributes
    ----------
    name : str
        Name in the deck.
    prescribed : list of Prescribed
        Prescribed displacements, rotations and potentials.
    loads : list of Load
        Forces, moments, currents and heat.
    temperatures : list of Temperature
        Temperatures of a step in which they are no unknowns.
    element_loads : list of ElementLoad
        Forces on the length of wires.
    cards : list of tuple
        Controls, solver and requests: keyword, parameters, data lines.
    """

    def __init__(
        self,
        model: Names,
        name: str,
        *,
        total: float = 1.0,
        increment: float | None = None,
        first: float | None = None,
        smallest: float | None = None,
        largest: float | None = None,
        inc: int | None = None,
        direct: bool = False,
        procedure: str = "STATIC",
        steady_state: bool = False,
        electrical: bool = True,
        deltmx: float | None = None,
        error: float | None = None,
        steady_rate: float | None = None,
        boundary_op: str = "MOD",
        cload_op: str = "MOD",
        cecurrent_op: str = "MOD",
        dload_op: str = "MOD",
        lorentz_op: str = "MOD",
    ):
        self._model = model
        self.name = name
        self.prescribed: list[Prescribed] = []
        self.loads: list[Load] = []
        self.temperatures: list[Temperature] = []
        self.element_loads: list[ElementLoad] = []
        self.cards: list[CardSpec] = []
        first, largest = first_and_largest(total, increment, first, smallest, largest, error is not None)
        times: list[float | None] = [first, total, smallest, largest]
        self._static: CardSpec = (
            procedure.upper(),
            procedure_parameters(procedure, direct, steady_state, electrical, {"DELTMX": deltmx, "ERROR": error}),
            [times],
        )
        check_card(*self._static)
        if direct:
            largest = first
            times[2:] = []
        elif _is_over_time(self._static) and deltmx is None and error is None:
            # increments of a step over time are all as large as the first
            largest = first
            times[2:] = [smallest] if smallest is not None else []
        else:
            smallest = min(SMALLEST_FRACTION * total, first) if smallest is None else smallest
            times[2:] = [smallest, largest]
            if not smallest <= first <= largest:
                raise ValueError(
                    f"increments must satisfy smallest <= first <= largest, not {smallest:g}, {first:g}, {largest:g}"
                )
        if steady_rate is not None:
            self._static[1]["END"] = "SS"
            times += [None] * (4 - len(times)) + [steady_rate]
            check_card(*self._static)
        if first > total:
            raise ValueError(f"the first increment, {first:g} s, is larger than the step, {total:g} s")
        needed = math.ceil(total / largest * (1 - 1e-9))
        if inc is None:
            inc = max(_MIN_INC, _INC_RATIO * needed)
        self._step: CardSpec = ("STEP", {"NAME": name, "INC": inc}, [])
        check_card(*self._step)
        if needed > inc:
            raise ValueError(f"the step needs at least {needed} increments, but inc allows {inc}")
        self._ops = {"BOUNDARY": boundary_op, "CLOAD": cload_op, "CECURRENT": cecurrent_op, "DLOAD": dload_op}
        self._ops["LORENTZ"] = lorentz_op
        for op in self._ops.values():
            check_card("BOUNDARY", {"OP": op}, [[1, 1]])

    def __repr__(self) -> str:
        """Short description."""
        first, total = self._static[2][0][:2]
        parts = [f"time {total:g}, first increment {first:g}"]
        parts += [f"{len(self.prescribed)} prescribed"] if self.prescribed else []
        parts += [f"{len(self.loads)} loads"] if self.loads else []
        parts += [", ".join(dict.fromkeys(card[0] for card in self.cards))] if self.cards else []
        return f"<Step {self.name}: {'; '.join(parts)}>"

    # Prescribed values

    def boundary(
        self,
        nodes: AnyNodes,
        first: Direction,
        last: Direction | None = None,
        value: float = 0.0,
        amplitude: Amplitude | str | None = None,
    ) -> None:
        """Prescribe a value as `*BOUNDARY` does.

        Parameters
        ----------
        nodes : int, str, Nodes, WireGroup or sequence
            Where.
        first, last : int or str
            First and last degree of freedom, as name ("x", "rx", "potential", ...) or number (`litz keywords BOUNDARY`).
        value : float
            Value at the end of the step [m, rad, V].
        amplitude : Amplitude or str, optional
            Factor over time.
        """
        first = degree_of_freedom(first)
        last = first if last is None else degree_of_freedom(last)
        if last < first:
            raise ValueError(f"the last degree of freedom, {last}, comes before the first, {first}")
        item = Prescribed(self._model.target(nodes), first, last, value, self._amplitude(amplitude))
        check_card("BOUNDARY", {}, [[item.target, first, last, value]])
        self.prescribed.append(item)

    def move(
        self, nodes: AnyNodes, direction: Direction, value: float, amplitude: Amplitude | str | None = None
    ) -> None:
        """Prescribe a displacement [m] or rotation [rad], counted from the start of the first step.

        Parameters
        ----------
        nodes : int, str, Nodes, WireGroup or sequence
            Where.
        direction : {"x", "y", "z", "rx", "ry", "rz"} or their numbers
            Direction.
        value : float
            Value at the end of the step [m, rad].
        amplitude : Amplitude or str, optional
            Factor over time.
        """
        self.boundary(
            nodes, degree_of_freedom(direction, directions_of("CLOAD", "dof").values()), None, value, amplitude
        )

    def hold(self, nodes: AnyNodes, *directions: Direction) -> None:
        """Prescribe zeros, as `Model.fix` does from the start: all displacements and rotations without directions."""
        for first, last in ranges_of(directions):
            self.boundary(nodes, first, last)

    def hold_here(self, nodes: AnyNodes, *directions: Direction) -> None:
        """Hold nodes where they are when the step begins, as `*BOUNDARY, FIXED` does; directions as those of `hold`."""
        self.prescribed += [Prescribed(self._model.target(nodes), *dofs, fixed=True) for dofs in ranges_of(directions)]

    def potential(self, nodes: AnyNodes, value: float, amplitude: Amplitude | str | None = None) -> None:
        """Prescribe a potential [V]."""
        self.boundary(nodes, degree_of_freedom("potential"), None, value, amplitude)

    def temperature(self, nodes: AnyNodes, value: float, amplitude: Amplitude | str | None = None) -> None:
        """Prescribe a temperature [K].

        In a step that solves for temperatures it is held there (`*BOUNDARY`, degree of freedom 11); in another one it is what
        wires expand by (`*TEMPERATURE`).
        """
        if self._static[0] == "STATIC":
            items = [Temperature(one, value, self._amplitude(amplitude)) for one in self._model.with_images(nodes)]
            check_card("TEMPERATURE", {}, [item.row() for item in items])
            self.temperatures += items
        else:
            self.boundary(nodes, degree_of_freedom("temperature"), None, value, amplitude)

    # Loads

    def heat(self, nodes: AnyNodes, value: float, amplitude: Amplitude | str | None = None) -> None:
        """Heat [W] into the wire at each of the nodes."""
        self._load(
            "CFLUX",
            Load(self._model.target(nodes), degree_of_freedom("temperature"), value, self._amplitude(amplitude)),
        )

    def body_heat(self, elements: str | WireGroup, value: float, amplitude: Amplitude | str | None = None) -> None:
        """Heat per volume [W/m^3] in all of these elements."""
        self._element_heat("DFLUX", elements, ["BF", value], AMPLITUDE=amplitude)

    def film(
        self,
        elements: str | WireGroup,
        surroundings: float,
        coefficient: float,
        amplitude: Amplitude | str | None = None,
        film_amplitude: Amplitude | str | None = None,
    ) -> None:
        """Heat that passes from the sides of wires to their surroundings.

        Parameters
        ----------
        elements : str or WireGroup
            Where.
        surroundings : float
            Temperature of the surroundings [K].
        coefficient : float
            Heat transfer coefficient [W/(m^2 K)].
        amplitude, film_amplitude : Amplitude or str, optional
            Factors over time: of the temperature of the surroundings, and of the coefficient.
        """
        given = {"AMPLITUDE": amplitude, "FILM AMPLITUDE": film_amplitude}
        self._element_heat("FILM", elements, ["F", surroundings, coefficient], **given)

    def radiate(
        self,
        elements: str | WireGroup,
        surroundings: float,
        emissivity: float,
        amplitude: Amplitude | str | None = None,
    ) -> None:
        """Heat that the sides of wires radiate to surroundings of this temperature [K].

        Needs the Stefan-Boltzmann constant of `Model.physical_constants`. The amplitude is a factor of the temperature.
        """
        self._element_heat("RADIATE", elements, ["R", surroundings, emissivity], AMPLITUDE=amplitude)

    def _element_heat(
        self, name: str, elements: str | WireGroup, values: list[Any], **amplitudes: Amplitude | str | None
    ) -> None:
        """Heat on the length of elements, whose values may follow amplitudes."""
        names = {parameter: self._amplitude(amplitude) for parameter, amplitude in amplitudes.items()}
        given = {parameter: found for parameter, found in names.items() if found is not None}
        self.card(name, given, [[self._model.element_set_of(elements), *values]])

    def cload(self, nodes: AnyNodes, dof: Direction, value: float, amplitude: Amplitude | str | None = None) -> None:
        """A force [N] or moment [N m] of fixed direction at each of the nodes; `dof` as the direction of `move`."""
        dof = degree_of_freedom(dof, directions_of("CLOAD", "dof").values())
        self._load("CLOAD", Load(self._model.target(nodes), dof, value, self._amplitude(amplitude)))

    def force(
        self, nodes: AnyNodes, direction: Direction, value: float, amplitude: Amplitude | str | None = None
    ) -> None:
        """A force [N] along "x", "y" or "z" at each of the nodes."""
        self.cload(nodes, degree_of_freedom(direction, degrees_of_freedom("displacement")), value, amplitude)

    def moment(
        self, nodes: AnyNodes, direction: Direction, value: float, amplitude: Amplitude | str | None = None
    ) -> None:
        """A moment [N m] about "x", "y" or "z" at each of the nodes."""
        about = f"r{direction}" if direction in ("x", "y", "z") else direction
        self.cload(nodes, degree_of_freedom(about, degrees_of_freedom("rotation")), value, amplitude)

    def dload(
        self,
        elements: str | WireGroup | None,
        label: str,
        value: float,
        direction: Sequence[float] | None = None,
        amplitude: Amplitude | str | None = None,
    ) -> None:
        """A load on the length of wires, as `*DLOAD` gives it.

        Parameters
        ----------
        elements : str, WireGroup or None
            Where; None: weight of all wires.
        label : {"PX", "PY", "PZ", "P1", "P2", "GRAV"}
            Force per length along a global axis or along a section axis, with which it turns; or weight.
        value : float
            Force per reference length [N/m]; for GRAV the acceleration [m/s^2].
        direction : (3) array, optional
            That of GRAV, of any length.
        amplitude : Amplitude or str, optional
            Factor over time.
        """
        row: list = [label.upper(), float(value), *(float(x) for x in direction or ())]
        self._element_load("DLOAD", elements, row, amplitude)

    def gravity(
        self,
        acceleration: Sequence[float] = (0.0, 0.0, -9.81),
        elements: str | WireGroup | None = None,
        amplitude: Amplitude | str | None = None,
    ) -> None:
        """Weight of all wires, or of some, by an acceleration `(3)` [m/s^2]; materials need their density."""
        self.dload(elements, "GRAV", math.hypot(*acceleration), acceleration, amplitude)

    def lorentz(
        self,
        elements: str | WireGroup,
        field: ArrayLike,
        gradient: Sequence[Sequence[float]] | None = None,
        amplitude: Amplitude | str | None = None,
        along: str | None = None,
        places: Sequence[float] | Sequence[Sequence[float]] | None = None,
    ) -> None:
        """Force of a magnetic field on the currents in wires, as `*LORENTZ` gives it.

        Parameters
        ----------
        elements : str or WireGroup
            Where.
        field : (3), (n, 3) or (n, m, 3) array
            Flux density at the origin [T], or at each of the `places`, linear between them.
        gradient : (3, 3) array, optional
            Its derivatives [T/m]: row `i` holds those of component `i` by x, y and z. The trace must be zero.
        amplitude : Amplitude or str, optional
            Factor over time.
        along, places : {"x", "y", "z"} and (n) array, optional
            Axis, and rising places along it [m] about the middles of all elements; the field along the axis stays the same.
            Or {"xy", "xz", "yz"} and a pair of an (n) and an (m) array: a map over a plane, the same along the third axis.
        """
        table = len(self.element_loads) if along else 0
        for row in field_rows(field, gradient, along, places):
            self._element_load("LORENTZ", elements, row, amplitude, along, table)

    def _element_load(
        self,
        card: str,
        elements: Any,
        row: list,
        amplitude: Amplitude | str | None,
        along: str | None = None,
        table: int = 0,
    ) -> None:
        target = None if elements is None else self._model.element_set_of(elements)
        load = ElementLoad(card, target, tuple(row), self._amplitude(amplitude), along and along.upper(), table)
        check_card(card, {"ALONG": load.along} if along else {}, [load.row()])
        self.element_loads.append(load)

    def current(self, nodes: AnyNodes, value: float, amplitude: Amplitude | str | None = None) -> None:
        """A current [A] into the body at each of the nodes."""
        target = self._model.target(nodes)
        self._load("CECURRENT", Load(target, degree_of_freedom("potential"), value, self._amplitude(amplitude)))

    cecurrent = current

    def _load(self, keyword_name: str, load: Load) -> None:
        check_card(keyword_name, {}, [load.row()])
        self.loads.append(load)

    def _amplitude(self, amplitude: Amplitude | str | None) -> str | None:
        return self._model.amplitude_name(amplitude)

    # Requests

    def node_print(self, nodes: AnyNodes, *quantities: str, totals: str = "NO") -> None:
        """Request quantities of nodes in the history.

        Parameters
        ----------
        nodes : str, Nodes or WireGroup
            Where.
        *quantities : str
            U, UR, RF, RM, CF, CM, EPOT, NT, RCURR, RFL, CECUR, CFL.
        totals : {"NO", "YES", "ONLY"}
            Sums over the set (means of U, UR, EPOT): not at all, besides the nodes, or alone.
        """
        parameters = {"NSET": self._model.node_set_of(nodes)}
        if totals != "NO":
            parameters["TOTALS"] = totals
        self.card("NODE PRINT", parameters, [list(quantities)] if quantities else [])

    def el_print(self, elements: str | WireGroup, *quantities: str, totals: str = "NO") -> None:
        """Request quantities of elements in the history (`litz keywords "EL PRINT"`); arguments as those of `node_print`."""
        parameters = {"ELSET": self._model.element_set_of(elements)}
        if totals != "NO":
            parameters["TOTALS"] = totals
        self.card("EL PRINT", parameters, [list(quantities)] if quantities else [])

    def electrode_print(self, plus: AnyNodes, minus: AnyNodes) -> None:
        """Request voltage, current and resistance between two electrodes in the history."""
        self.card("ELECTRODE PRINT", {}, [[self._model.node_set_of(plus), self._model.node_set_of(minus)]])

    def energy_print(self) -> None:
        """Request energies in the history."""
        self.card("ENERGY PRINT")

    def contact_print(self) -> None:
        """Request a line about each contact at every increment in the terminal."""
        self.card("CONTACT PRINT")

    def node_file(self, frequency: int = 1) -> None:
        """Write the fields of every n-th increment."""
        self.card("NODE FILE", {"FREQUENCY": frequency})

    def el_file(self, *quantities: str) -> None:
        """Write fields of elements that are there on request only: SFN, SE, SK, E11 or S11 (all of them for any)."""
        self.card("EL FILE", {}, [list(quantities)])

    def contact_file(self, frequency: int = 1) -> None:
        """Write the contacts of every n-th increment, and of the last one; 0: of none."""
        self.card("CONTACT FILE", {"FREQUENCY": frequency})

    def restart(self, frequency: int = 1) -> None:
        """Keep every n-th increment for a restart."""
        self.card("RESTART", {"WRITE": True, "FREQUENCY": frequency})

    # Solution

    def controls(self, parameters: str, **values: float) -> None:
        """Set convergence and increments, as `*CONTROLS` does.

        Parameters
        ----------
        parameters : {"FIELD", "TIME INCREMENTATION", "ROTATION", "STABILIZE"}
            What is set.
        **values
            The values by their names in the deck, in either case: `r_n=1e-6`, `i_c=25`, `cap=0.3`, `factor=1e-8`.
        """
        description = keyword("CONTROLS")
        left = {name.upper(): value for name, value in values.items()}
        forms = [form for form in description["data"] if squeezed(form["when"]) == squeezed(f"PARAMETERS={parameters}")]
        if not forms:
            check_card("CONTROLS", {"PARAMETERS": parameters})
        rows = [[left.pop(value["name"].upper(), None) for value in form["values"]] for form in forms]
        if left:
            names = [value["name"].lower() for form in forms for value in form["values"] if "unused" not in value]
            raise ValueError(f"*CONTROLS, PARAMETERS={parameters} has no {next(iter(left)).lower()}; there is {names}")
        while rows and all(value is None for value in rows[-1]):
            rows.pop()
        self.card("CONTROLS", {"PARAMETERS": parameters.upper()}, rows)

    def solver(self, name: str, coupling: str | None = None) -> None:
        """Choose the solver ("BLOCK", "UMFPACK", "SKYLINE", "MUMPS") and coupling ("MONOLITHIC", "UPDATED", "FULL")."""
        parameters = {"NAME": name.upper()}
        if coupling is not None:
            parameters["COUPLING"] = coupling.upper()
        self.card("SOLVER", parameters)

    def solution_technique(self, name: str, reform_kernel: int | None = None) -> None:
        """Choose "NEWTON" or "MODIFIED NEWTON", whose factors last for `reform_kernel` more iterations at most."""
        parameters: dict[str, Any] = {"TYPE": name.upper()}
        if reform_kernel is not None:
            parameters["REFORM KERNEL"] = reform_kernel
        self.card("SOLUTION TECHNIQUE", parameters)

    def card(self, name: str, parameters: dict[str, Any] | None = None, rows: list | None = None) -> None:
        """Add any card of a step that the keyword table has."""
        spec = (name.removeprefix("*").upper(), parameters or {}, rows or [])
        if keyword(name)["place"] == "model":
            raise ValueError(f"*{spec[0]} belongs in the model part, not in a step: use Model.card")
        check_card(*spec)
        self.cards.append(spec)

    def all_cards(self) -> Iterator[CardSpec]:
        """All cards of the step, in the order of the deck."""
        yield self._step
        yield self._static
        card_of = {degree_of_freedom("potential"): "CECURRENT", degree_of_freedom("temperature"): "CFLUX"}
        yield from grouped("BOUNDARY", self.prescribed, self._ops["BOUNDARY"])
        yield from grouped("TEMPERATURE", self.temperatures)
        for name in ("CLOAD", "CECURRENT", "CFLUX"):
            loads = [load for load in self.loads if card_of.get(load.dof, "CLOAD") == name]
            yield from grouped(name, loads, self._ops.get(name, "MOD"))
        for name in ("DLOAD", "LORENTZ"):
            yield from grouped(name, [load for load in self.element_loads if load.card == name], self._ops[name])
        yield from self.cards
        yield "END STEP", {}, []


def _is_over_time(procedure: CardSpec) -> bool:
    """Heat is stored in the step, so that its time is real."""
    return procedure[0] != "STATIC" and "STEADY STATE" not in procedure[1]
