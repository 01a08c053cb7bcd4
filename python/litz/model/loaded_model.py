"""What a deck says: wires, contacts, supports and steps."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from ..base.names import nearest_name
from ..deck.keyword_table import check_card, keyword, squeezed
from ..deck.lines import CardSpec
from .interactions import ContactPair, Interaction
from .laws import Friction, GapConductance, Hertz, Linear, NamedBehaviour, _Spot
from .loading import Amplitude, Direction, Prescribed, Target, degree_of_freedom, ranges_of
from .names import AnyNodes
from .steps import Step
from .surface_model import Reference, SurfaceModel
from .surfaces import RigidSurface
from .wires import WireGroup

#: Parameters of *UNITS that are those of SI
_SI_LABELS = {
    "SYSTEM": "SI", "LENGTH": "m", "FORCE": "N", "TIME": "s", "CURRENT": "A", "VOLTAGE": "V", "TEMPERATURE": "K",
}  # fmt: skip
#: Maximum number of groups and steps in the description of a model
_MAX_LISTED = 12


class LoadedModel(SurfaceModel):
    """Wires with their contacts, supports and steps; `Model` writes and runs them."""

    def __init__(self, title: str, comments: Iterable[str] = (), *, units: str | Mapping[str, str] | None = None):
        super().__init__()
        self.title = title
        self.comments = list(comments)
        self.contacts: list[ContactPair] = []
        self.supports: list[Prescribed] = []
        self.guides: dict[Target, float] = {}
        self.height: float | None = None
        self.ground: str | None = None
        self.steps: list[Step] = []
        self.cards: list[CardSpec] = []
        self._unit_labels = None if units is None else _unit_labels(units)

    @property
    def units(self) -> dict[str, str]:
        """Parameters of `*UNITS`; empty: the model does not say what its units are."""
        in_si = [material.name for material in self.materials if material.units == "SI"]
        if self._unit_labels is None:
            return {"SYSTEM": "SI"} if in_si else {}
        others = [f"{name}={label}" for name, label in self._unit_labels.items() if label != _SI_LABELS.get(name)]
        if in_si and others:
            raise ValueError(
                f"{in_si[0]} is in SI, and the model has {', '.join(others)}: give a litz.Material in the units of the model"
            )
        return dict(self._unit_labels)

    def __repr__(self) -> str:
        """Short description."""
        lines = [f"<Model {self.title!r}: {len(self._points)} nodes, {self._n_elements} elements"]
        lines += _shortened([repr(group) for group in self.groups.values()])
        lines += _shortened([f"{one.shape.lower()} {one.name}" for one in self.surfaces.values()])
        for pair in self.contacts[:_MAX_LISTED]:
            among = f"contact {pair.first} with {pair.second}" if pair.second else f"contact among {pair.first}"
            lines.append(f"{among}: {pair.interaction.name}")
        lines += _shortened([repr(step) for step in self.steps])
        return "\n  ".join(lines) + ">"

    def contact(
        self,
        first: WireGroup | str | Sequence[WireGroup | str],
        second: WireGroup | RigidSurface | str | Sequence[WireGroup | str] | None = None,
        *,
        behaviour: Hertz | Linear | NamedBehaviour | None = None,
        conductance: _Spot | None = None,
        friction: Friction | float | None = None,
        axis: str = "HERMITE",
        heat: GapConductance | None = None,
        name: str | None = None,
        interaction: Interaction | None = None,
        interference_fit: bool = False,
    ) -> ContactPair:
        """Let wires touch: those of `first` and those of `second`, or those of `first` among each other.

        Parameters
        ----------
        first, second : WireGroup, str, or sequence of them
            Groups or element sets; of several an element set is made. `second` can be a rigid surface, on which wires
            lie along lines: current and heat pass to its reference node by laws with `per_length=True`.
        behaviour : Hertz, Linear or NamedBehaviour, optional
            Contact force over penetration; Hertz when left out.
        conductance : HertzSpot, PaperSpot, PlasticSpot, FilmSpot, SharvinSpot, ClusterSpot, ConstantSpot or TableSpot, optional
            Resistance of the spots; without it no current crosses.
        friction : Friction or float, optional
            Friction, or its coefficient [-]; without it the wires slide freely.
        axis : {"HERMITE", "LINEAR"}
            Interpolation of the axes that touch.
        heat : GapConductance, optional
            Heat through the contacts; without it heat passes where a current can.
        name : str, optional
            Name of the interaction.
        interaction : Interaction, optional
            All the laws at once, in place of the arguments above.
        interference_fit : bool
            Initial overlaps of the wires are intended.
        """
        laws = {"behaviour": behaviour, "conductance": conductance, "friction": friction, "heat": heat}
        given = [law for law, value in laws.items() if value is not None]
        if interaction is not None and (given or name is not None):
            raise ValueError(f"contact takes interaction, or {' and '.join(given or ['name'])}, not both")
        if interaction is None:
            behaviour = Hertz() if behaviour is None else behaviour
            interaction = self._named(Interaction("TOUCH", behaviour, conductance, friction, axis, heat), name)
        elif any(known.name == interaction.name and known != interaction for known in self.interactions):
            raise ValueError(f"there is another interaction of the name {interaction.name}")
        if self._surface_of(first) is not None:
            raise ValueError(f"the wires come first, then the rigid surface that they touch, not {first!r}")
        surface = self._surface_of(second)
        if surface is not None:
            _check_surface_laws(surface, interaction, interference_fit)
        sets = [self._joined(elements) for elements in (first, surface or second) if elements is not None]
        if any({known.first, known.second or known.first} == set(sets) for known in self.contacts):
            raise ValueError(f"there is a contact of {' with '.join(sets)} already")
        pair = ContactPair(interaction, sets[0], sets[1] if len(sets) > 1 else None, interference_fit)
        self.contacts.append(pair)
        return pair

    def _named(self, laws: Interaction, name: str | None) -> Interaction:
        """The laws under a unique name; equal laws share it."""
        known = {one.name: one for one in self.interactions}

        def of_name(name: str) -> Interaction:
            return replace(laws, name=name)

        if name is not None:
            if known.get(name, of_name(name)) != of_name(name):
                raise ValueError(f"there is another interaction of the name {name}")
            return of_name(name)
        names = ["TOUCH", *(f"TOUCH{number}" for number in range(2, len(known) + 3))]
        return next(of_name(one) for one in names if known.get(one, of_name(one)) == of_name(one))

    def _surface_of(self, partner: object) -> RigidSurface | None:
        """The rigid surface that a partner of wires is, by itself or by its name."""
        if isinstance(partner, RigidSurface):
            return self._own_surface(partner)
        names = {squeezed(name): surface for name, surface in self.surfaces.items()}
        return names.get(squeezed(partner)) if isinstance(partner, str) else None

    def _joined(self, elements: WireGroup | RigidSurface | str | Sequence[WireGroup | str]) -> str:
        """One element set for groups and sets; the name of a rigid surface."""
        if isinstance(elements, RigidSurface):
            return elements.name
        if isinstance(elements, str | WireGroup):
            return self.element_set_of(elements)
        names = [self.element_set_of(one) for one in elements]
        if len(names) == 1:
            return names[0]
        for known, members in self.element_sets.items():
            if members == names:
                return known
        name = "_".join(names) if len(names) <= 3 else f"{names[0]}_TO_{names[-1]}"
        return self.element_set(name, names)

    def fix(self, nodes: AnyNodes, *directions: Direction) -> None:
        """Hold degrees of freedom at zero from the start, before the first step.

        Parameters
        ----------
        nodes : int, str, Nodes, WireGroup or sequence
            Where.
        *directions : str or int
            "x", "y", "z", "rx", "ry", "rz", "potential" or their numbers; "pinned" (all displacements), "rotations" (all
            rotations), "encastre" (both), which is also the default.
        """
        target = self.target(nodes)
        self.supports += [Prescribed(target, first, last) for first, last in ranges_of(directions)]

    def initial_temperature(self, value: float, nodes: AnyNodes | None = None) -> None:
        """Set the temperature before the first step, of some nodes or of all wires [K]."""
        targets = [self.target(group) for group in self.groups.values()] if nodes is None else self.with_images(nodes)
        if not targets:
            raise ValueError("the model has no wires yet: add them with model.wire() before their temperature")
        self.card("INITIAL CONDITIONS", {"TYPE": "TEMPERATURE"}, [[target, value] for target in targets])

    def physical_constants(self, *, absolute_zero: float | None = None, stefan_boltzmann: float | None = None) -> None:
        """Set absolute zero on the scale of the temperatures, and the Stefan-Boltzmann constant [W/(m^2 K^4)]."""
        values = {"ABSOLUTE ZERO": absolute_zero, "STEFAN BOLTZMANN": stefan_boltzmann}
        self.card("PHYSICAL CONSTANTS", {name: value for name, value in values.items() if value is not None})

    def rigid_body(self, reference: Reference, *, tie: AnyNodes | None = None, pin: AnyNodes | None = None) -> int:
        """Let nodes move with a reference node as one rigid body.

        Parameters
        ----------
        reference : int, Nodes or (3) array
            The reference node, or the position of a new one [m].
        tie : int, str, Nodes, WireGroup or sequence, optional
            Nodes whose displacements and rotations follow.
        pin : int, str, Nodes, WireGroup or sequence, optional
            Nodes whose displacements follow; their rotations are free.

        Returns
        -------
        int
            Number of the reference node: hold, move, turn or load it.

        Examples
        --------
        >>> import litz
        >>> model = litz.Model("a twisted pair")
        >>> copper = model.material("COPPER", young=120e9, poisson=0.34)
        >>> axes = [[(0, y, 0), (0.05, y, 0), (0.1, y, 0)] for y in (-1e-3, 1e-3)]
        >>> pair = model.wires("PAIR", axes, radius=0.5e-3, material=copper)
        >>> model.fix(model.rigid_body((0, 0, 0), tie=pair.start))
        >>> clamp = model.rigid_body((0.1, 0, 0), tie=pair.end)
        >>> step = model.step("TWIST", increment=0.05)
        >>> step.move(clamp, "rx", 6.28)
        """
        if tie is None and pin is None:
            raise ValueError("a rigid body needs nodes that follow its reference node: tie, pin, or both")
        node = self._reference_node(reference, "a rigid body")
        sets = {"TIE NSET": tie, "PIN NSET": pin}
        named = {key: self.node_set_of(nodes) for key, nodes in sets.items() if nodes is not None}
        self.card("RIGID BODY", {"REF NODE": node, **named})
        return node

    def equation(self, *terms: tuple[AnyNodes, Direction, float]) -> None:
        """Let a sum of coefficient times degree of freedom be zero, as `*EQUATION` does.

        Parameters
        ----------
        *terms : tuple of nodes, direction and coefficient
            Node or nodes, degree of freedom as that of `Step.boundary`, and its coefficient. The first is eliminated: it can be
            loaded, but not prescribed, and is in no other equation. Several nodes stand for an equation for each of them, in
            the order of their numbers.

        Examples
        --------
        >>> import litz
        >>> model = litz.Model("both ends of a wire move and turn alike but for a stretch")
        >>> wire = model.wire("WIRE", (0, 0, 0), (0.01, 0, 0), radius=1e-4, material=litz.STEEL, elements=4)
        >>> stretch = model.nodes([(0, 0, 0)])
        >>> model.equation((wire.end, "x", 1), (wire.start, "x", -1), (stretch, "x", -1))
        >>> for direction in ("y", "z", "rx", "ry", "rz"):
        ...     model.equation((wire.end, direction, 1), (wire.start, direction, -1))
        >>> model.fix(wire.start, "pinned", "rx")
        >>> model.step(increment=0.1).move(stretch, "x", 1e-4)
        """
        values: list[Any] = []
        for nodes, direction, factor in terms:
            values += [self.target(nodes), degree_of_freedom(direction), float(factor)]
        rows = [values[i : i + 15] for i in range(0, len(values), 15)]
        self.card("EQUATION", {}, [[len(terms)], *rows])

    def local_axes(
        self, nodes: AnyNodes, a: ArrayLike, b: ArrayLike, system: Literal["rectangular", "cylindrical", "spherical"]
    ) -> None:
        """Let directions of supports, loads and equations at nodes be those of a system of their own, as `*TRANSFORM` does.

        Results are along the global axes.

        Parameters
        ----------
        nodes : int, str, Nodes, WireGroup or sequence
            The nodes.
        a, b : (3) array
            Two points [m]. Rectangular: x points from the origin to `a`, and `b` is in the plane of x and y. Cylindrical: x is
            radial, y tangential, and z along the axis from `a` to `b`. Spherical: x is radial from `a`, y along the circle of
            latitude, and z along the meridian, towards the pole on the side of `b`.
        system : {"rectangular", "cylindrical", "spherical"}
            Kind of the system.

        Examples
        --------
        >>> import litz
        >>> model = litz.Model("an end on an inclined plane")
        >>> wire = model.wire("WIRE", (0, 0, 0), (0.1, 0, 0), radius=1e-3, material=litz.STEEL, elements=8)
        >>> model.fix(wire.start)
        >>> model.local_axes(wire.end, (1, 1, 0), (-1, 1, 0), "rectangular")
        >>> model.fix(wire.end, "y")
        >>> model.step().force(wire.end, "x", 1.0)
        """
        kinds = ("rectangular", "cylindrical", "spherical")
        if system not in kinds:
            raise ValueError(f"system must be one of {', '.join(kinds)}, not {system!r}")
        points = [float(value) for point in (a, b) for value in np.asarray(point, dtype=float).reshape(3)]
        self.card("TRANSFORM", {"NSET": self.node_set_of(nodes), "TYPE": system[0].upper()}, [points])

    def amplitude(self, name: str, t: Sequence[float], a: Sequence[float], time: str = "STEP TIME") -> Amplitude:
        """Define a factor `a` [-] over the times `t` [s] of the step, or with `time="TOTAL TIME"` of all steps."""
        if name in self.amplitudes:
            raise ValueError(f"there is an amplitude {name} already")
        amplitude = Amplitude(name, tuple(t), tuple(a), time)
        self.amplitudes[name] = amplitude
        return amplitude

    def step(self, name: str | None = None, **options: Any) -> Step:
        """Add a step.

        Parameters
        ----------
        name : str, optional
            Name of the step.
        total : float
            Time of the step [s]; 1 when left out.
        increment : float
            First and largest increment [s]; the whole step when left out.
        first, smallest, largest : float
            The increments one by one [s], in place of `increment` where they are given.
        inc : int
            Maximum number of increments; default: ten times as many as the largest increment needs, at least 100.
        direct : bool
            Increments of the fixed size `first`.
        procedure : {"STATIC", "COUPLED THERMAL-ELECTRICAL", "COUPLED TEMPERATURE-DISPLACEMENT"}
            What is solved for: motions and potentials, potentials and temperatures, or all three.
        steady_state : bool
            Temperatures that no longer change; otherwise wires store heat, and the time of the step is real.
        electrical : bool
            A coupled temperature-displacement step solves for potentials, too.
        deltmx : float
            Largest change of a temperature in an increment of a step over time [K], which then chooses the increments;
            without it and `error` all of them are as large as the first.
        error : float
            Largest error that an increment of a step over time may add to a temperature [K], which then chooses the increments,
            the first one the smallest unless it is given.
        steady_rate : float
            A step over time ends as soon as no temperature changes faster [K/s].
        boundary_op, cload_op, cecurrent_op, dload_op, lorentz_op : {"MOD", "NEW"}
            NEW removes what earlier steps have prescribed or loaded.
        """
        name = f"STEP{len(self.steps) + 1}" if name is None else name
        if any(squeezed(step.name) == squeezed(name) for step in self.steps):
            raise ValueError(f"there is a step {name} already")
        allowed = list(Step.__init__.__kwdefaults__ or ())
        unknown = set(options) - set(allowed)
        if unknown:
            option = sorted(unknown)[0]
            raise ValueError(f"a step has no {option}{nearest_name(option, allowed)}; there are: {', '.join(allowed)}")
        step = Step(self, name, **options)
        self.steps.append(step)
        return step

    def press(self, displacement: float, *, voltage: float | None = None, name: str = "PRESS", **options: Any) -> Step:
        """Add a step that moves the guided nodes of a generated model down, along -z.

        Parameters
        ----------
        displacement : float
            Displacement at the end of the step of the nodes with factor 1 [m]; at most `height`.
        voltage : float, optional
            Between the node sets PLUS and MINUS, with MINUS at 0 V [V]; None: the step prescribes no potential. Where
            nothing else in the model prescribes a potential or a current, MINUS is written at 0 V, so that none flows.
        name : str
            Name of the step.
        **options
            As those of `step`; `increment` is a tenth of the step when left out.

        Notes
        -----
        Where wires rub or snap, damping helps a run to its end: `model.press(...).controls("STABILIZE")`; the summary of
        the run says how much energy that took.
        """
        if not self.guides:
            raise ValueError("this model has no guides for pressing; set model.guides")
        if self.height is not None and 0 < self.height < displacement:
            raise ValueError(
                f"pressed by {displacement:g} m, this model of {self.height:g} m height would be turned upside down: "
                "press by less than its height"
            )
        options.setdefault("increment", 0.1 * options.get("total", 1.0))
        step = self.step(name, **options)
        for target, share in self.guides.items():
            step.move(target, "z", -displacement * share)
        if voltage is not None:
            step.potential("PLUS", voltage)
            step.potential("MINUS", 0.0)
            step.electrode_print("PLUS", "MINUS")
        elif "MINUS" in self.node_sets:
            self.ground = "MINUS"
        return step

    def card(self, name: str, parameters: dict[str, Any] | None = None, rows: list | None = None) -> None:
        """Add any card of the model part that the keyword table has; it is written before the first step."""
        spec = (name.removeprefix("*").upper(), parameters or {}, rows or [])
        if keyword(name)["place"] in ("step", "begins step"):
            raise ValueError(f"*{spec[0]} belongs in a step: use Step.card")
        check_card(*spec)
        self.cards.append(spec)

    @property
    def interactions(self) -> list[Interaction]:
        """The interactions in the order of their first use."""
        return list(dict.fromkeys(pair.interaction for pair in self.contacts))


def _check_surface_laws(surface: RigidSurface, laws: Interaction, interference_fit: bool) -> None:
    """What a contact with a rigid surface cannot have."""
    passed = {"current": laws.conductance, "heat": laws.heat}
    for flow, law in passed.items():
        if law is None:
            continue
        if not getattr(law, "per_length", False):
            words = "ConstantSpot and TableSpot" if flow == "current" else "GapConductance('CONSTANT') and ('TABLE')"
            raise ValueError(
                f"{flow} passes to the rigid surface {surface.name} along a line: possible are {words} with per_length=True, "
                f"not {law!r}"
            )
        if surface.node is None:
            raise ValueError(
                f"{flow} passes to the reference node of the rigid surface {surface.name}: give it a reference"
            )
    if isinstance(laws.behaviour, Linear) and laws.behaviour.line_penalty is None:
        raise ValueError(f"a wire touches the rigid surface {surface.name} along a line: Linear needs its line_penalty")
    if interference_fit:
        raise ValueError("interference_fit is for wires; move a rigid surface against the wires by its reference node")


def _unit_labels(units: str | Mapping[str, str]) -> dict[str, str]:
    """Parameters of *UNITS."""
    if isinstance(units, str):
        if units.upper() != "SI":
            raise ValueError(f'units must be "SI" or labels such as {{"length": "mm", "force": "mN"}}, not {units!r}')
        return {"SYSTEM": "SI"}
    labels = {name.upper(): label for name, label in units.items()}
    check_card("UNITS", labels)
    return labels


def _shortened(lines: list[str]) -> list[str]:
    if len(lines) <= _MAX_LISTED:
        return lines
    return [*lines[:_MAX_LISTED], f"... {len(lines) - _MAX_LISTED} more"]
