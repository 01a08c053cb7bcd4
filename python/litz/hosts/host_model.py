"""What a deck has for another program: nodes, beams, conductors, pairs of elements that may touch, supports and loads."""

import os
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..deck import Card, Deck
from ..deck.instances import deck_cards, flat_deck
from ..errors import FileError
from ..kernels import closest_points, contact_search
from ..kernels.laws import NORMAL_LAWS, SPOT_FIELDS, SPOT_LAWS
from ..model.abaqus_mesh import read_numbered_deck
from ..model.materials import Circular, Material
from ..model.mesh import Mesh
from ..runs import check
from .host_conditions import POTENTIAL, HostConditions

#: Cards that are exported, or that another program does not need
_KNOWN = frozenset(
    """
    *HEADING *NODE *ELEMENT *NSET *ELSET *MATERIAL *ELASTIC *ELECTRICAL CONDUCTIVITY *BEAM SECTION *SURFACE INTERACTION
    *SURFACE BEHAVIOR *GAP ELECTRICAL CONDUCTANCE *CONTACT PAIR *BOUNDARY *CLOAD *CECURRENT *STEP *STATIC *END STEP
    *INCLUDE *AMPLITUDE *UNITS *NODE PRINT *EL PRINT *ENERGY PRINT *ELECTRODE PRINT *NODE FILE *EL FILE *OUTPUT
    *NODE OUTPUT *ELEMENT OUTPUT *RESTART *CONTROLS *SOLUTION TECHNIQUE *SOLVER *CONTACT PRINT *CONTACT FILE *PREPRINT
    *PART *END PART *INSTANCE *END INSTANCE *ASSEMBLY *END ASSEMBLY *TRANSFORM
    """.replace(" ", "")
    .replace("\n", "")
    .split("*")
)
#: Parameters of the cards of a contact that are exported, or that do not change the laws
_KNOWN_PARAMETERS = {
    "SURFACE BEHAVIOR": {"PRESSURE-OVERCLOSURE", "PENETRATION"},
    "GAP ELECTRICAL CONDUCTANCE": {"LAW", "VOLTAGE"},
    "CONTACT PAIR": {"INTERACTION"},
}
#: Powers of the length in numbers of spot laws: hardness, film resistance times area, resistivity times free path
_POWER_OF_LENGTH = {"H": -2, "sigma_f": 2, "rho_l": 2}
#: Numbers of the axes of the user element
_AXES = {"LINEAR": 1, "HERMITE": 2}
#: How near to a node a crossing is at it, in half lengths of the element
_AT_NODE = 1e-6
#: Elements of one wire that enclose a smaller angle are no candidates: they go on in each other [cosine]
_PARALLEL = np.cos(np.deg2rad(5.0))


@dataclass(frozen=True)
class Laws:
    """Laws of a contact, as the options and properties of the user element."""

    #: Numbers of the normal law and of the spot law; 0: no current
    normal: int
    spot: int
    #: Penalty [N/m], 0 of HERTZ
    penalty: float
    #: Numbers of the spot law, line after line
    data: tuple[float, ...] = ()
    #: 1: the linear voltage within an element is corrected
    voltage: int = 1
    #: Number of the axis between the nodes
    axis: int = _AXES["HERMITE"]

    @property
    def has_table(self) -> bool:
        """Whether the numbers are a table."""
        return self.spot == SPOT_LAWS["table"]

    def in_shorter_unit(self, factor: float) -> "Laws":
        """The same laws in a unit of length of which `factor` make one of the deck's."""
        name = next((law for law, number in SPOT_LAWS.items() if number == self.spot), None)
        fields = [] if name is None or self.has_table else SPOT_FIELDS[name]
        data = [
            value * factor ** _POWER_OF_LENGTH.get(field, 0) for value, field in zip(self.data, fields, strict=False)
        ]
        return replace(self, penalty=self.penalty / factor, data=self.data if self.has_table else tuple(data))


@dataclass
class HostModel:
    """A model for another program."""

    heading: str
    #: Numbers and positions of the nodes
    node_numbers: NDArray[np.int64]
    x: NDArray[np.float64]
    #: Numbers, rows of nodes, types and places in `sections` of the elements
    element_numbers: NDArray[np.int64]
    connectivity: NDArray[np.int64]
    kinds: NDArray[np.str_]
    section_of: NDArray[np.int64]
    #: Round sections and their materials
    sections: list[tuple[Circular, Material]]
    #: Rows of two elements that may touch, and the place of their laws
    pairs: NDArray[np.int64]
    laws_of: NDArray[np.int64]
    laws: list[Laws]
    #: By row of a node and degree of freedom of decks: zero all the time, prescribed at the end of the first step, loads
    supports: set[tuple[int, int]] = field(default_factory=set)
    prescribed: dict[tuple[int, int], float] = field(default_factory=dict)
    loads: dict[tuple[int, int], float] = field(default_factory=dict)
    #: Rows of nodes with local axes, with the type and the two points of a `*TRANSFORM`
    local_axes: list[tuple[NDArray[np.int64], str, list[float]]] = field(default_factory=list)

    def conducts(self, element: int) -> bool:
        """Whether the material of an element is a conductor."""
        return self.sections[self.section_of[element]][1].conductivity is not None

    def contact_kinds(self) -> dict[tuple[int, int, int], list[int]]:
        """Rows of `pairs` for each combination of both sections and the laws: the contacts of the same properties."""
        found: dict[tuple[int, int, int], list[int]] = {}
        for row, (pair, laws) in enumerate(zip(self.pairs, self.laws_of, strict=True)):
            barred, unbarred = self.section_of[pair]
            found.setdefault((int(barred), int(unbarred), int(laws)), []).append(row)
        return found

    def contact_properties(self, kind: tuple[int, int, int]) -> tuple[list[float], list[float]]:
        """Of one kind: the 8 properties of the wires, barred first, and penalty and numbers of the spot law."""
        barred, unbarred, place = kind
        (a, copper_a), (b, copper_b) = self.sections[barred], self.sections[unbarred]
        laws = self.laws[place]
        if any(section.surface_radius != section.radius for section in (a, b)):
            raise FileError(
                "a CONTACT RADIUS other than the radius of the wire cannot be exported: the contact element has one radius"
            )
        if laws.spot and (copper_a.conductivity is None or copper_b.conductivity is None):
            names = " and ".join(m.name for m in (copper_a, copper_b) if m.conductivity is None)
            raise FileError(f"a contact with a spot law needs *ELECTRICAL CONDUCTIVITY of {names}")
        # without a current the resistivity says nothing
        rho = [1.0 if m.conductivity is None else 1 / float(m.conductivity) for m in (copper_a, copper_b)]  # type: ignore[arg-type]
        wires = [a.radius, b.radius, copper_a.young, copper_b.young, copper_a.poisson, copper_b.poisson, *rho]
        return wires, [laws.penalty, *laws.data]

    def in_shorter_unit(self, factor: float) -> "HostModel":
        """The same model in a unit of length of which `factor` make one of the deck's; newtons, volts and amperes stay."""
        sections = [
            (
                replace(
                    section,
                    radius=section.radius * factor,
                    contact_radius=None if section.contact_radius is None else section.contact_radius * factor,
                ),
                replace(
                    material,
                    young=material.young / factor**2,
                    conductivity=None if material.conductivity is None else material.conductivity / factor,  # type: ignore[operator]
                ),
            )
            for section, material in self.sections
        ]
        return replace(
            self,
            x=self.x * factor,
            sections=sections,
            laws=[laws.in_shorter_unit(factor) for laws in self.laws],
            prescribed={key: value * factor if key[1] <= 3 else value for key, value in self.prescribed.items()},
            loads={key: value * factor if 4 <= key[1] <= 6 else value for key, value in self.loads.items()},
            local_axes=[(rows, kind, [value * factor for value in points]) for rows, kind, points in self.local_axes],
        )

    def transforms(self, prefix: str) -> Iterator[str]:
        """Cards of the local axes, with node sets of these names and numbers."""
        for place, (rows, kind, points) in enumerate(self.local_axes, 1):
            yield f"*NSET, NSET={prefix}_{place}"
            numbers = [str(number) for number in self.node_numbers[rows]]
            yield from (" " + ", ".join(numbers[i : i + 16]) for i in range(0, len(numbers), 16))
            yield f"*TRANSFORM, NSET={prefix}_{place}, TYPE={kind}"
            yield " " + ", ".join(f"{value:.10g}" for value in points)

    def cross_direction(self, elements: Iterable[int]) -> NDArray[np.float64]:
        """A direction that none of some elements has, for their section axes."""
        ends = self.x[self.connectivity[list(elements)]]
        along = ends[:, 1] - ends[:, 0]
        along /= np.linalg.norm(along, axis=1)[:, None]
        directions = np.array(
            [[0, 0, 1], [0, 1, 0], [1, 0, 0], [0.48, 0.6, 0.64], [-0.6, 0.64, 0.48], [0.64, -0.48, 0.6]]
        )
        steepest = np.abs(along @ directions.T).max(axis=0)
        return directions[int(np.argmin(steepest))]


def read_host_model(path: str | os.PathLike[str], reach: float | None = None) -> HostModel:
    """Read a deck, after the program has checked it.

    Parameters
    ----------
    path : path
        Deck of wires with round sections and linear material.
    reach : float, optional
        Pairs of elements are candidates where their surfaces come within this distance before loading [m]; default: the
        largest diameter.

    Returns
    -------
    HostModel
        A card that other programs are not given, such as `*FRICTION`, is a warning.
    """
    path = Path(path)
    check(path)
    with flat_deck(path) as flat:
        mesh, node_numbers, element_numbers = read_numbered_deck(flat, "abaqus")
        cards = list(deck_cards(Deck.read(flat)))
    if not len(mesh.connectivity):
        raise FileError(f"{path} has no beams")
    sections, section_of = _sections(mesh, path)
    radius = np.array([sections[place][0].radius for place in section_of])
    _warn_of_what_is_left_out(path, cards)
    reach = 2 * radius.max() if reach is None else reach
    near = _that_cross(mesh, contact_search(mesh.x, mesh.connectivity, radius, skin=reach))
    pairs, laws_of, laws = _candidates(path, cards, mesh.element_sets, near)
    model = HostModel(
        heading=_heading(cards, path),
        node_numbers=node_numbers,
        x=mesh.x,
        element_numbers=element_numbers,
        connectivity=mesh.connectivity,
        kinds=np.array([kind or "B33" for kind in mesh.kinds]),
        section_of=section_of,
        sections=sections,
        pairs=pairs,
        laws_of=laws_of,
        laws=laws,
    )
    conditions = HostConditions(cards, node_numbers, mesh.node_sets)
    model.supports, model.prescribed, model.loads = conditions.supports, conditions.prescribed, conditions.loads
    model.local_axes = conditions.local_axes
    _hold_potentials_of_insulators(model)
    _warn_of_crossings_at_nodes(path, model)
    return model


def _hold_potentials_of_insulators(model: HostModel) -> None:
    """The element has them as unknowns, and without a conductor nothing determines them."""
    conducting = [element for element in range(len(model.connectivity)) if model.conducts(element)]
    insulators = set(model.connectivity[model.pairs].ravel()) - set(model.connectivity[conducting].ravel())
    model.supports |= {(int(row), POTENTIAL) for row in insulators}


def _warn_of_crossings_at_nodes(path: Path, model: HostModel) -> None:
    """The elements that end there would all count the contact."""
    x = model.x[model.connectivity[model.pairs]].reshape(-1, 4, 3)
    if not len(x):
        return
    along = x[:, 1::2] - x[:, ::2]
    length = np.linalg.norm(along, axis=2)
    tangents = np.repeat(along / length[..., None], 2, axis=1)
    places = closest_points(x, tangents, length, axis="linear")
    far = np.maximum(np.abs(places.xi_bar), np.abs(places.xi))
    at_node = (np.abs(far - 1) < _AT_NODE) & np.isin(places.status, ("inside", "beyond"))
    if at_node.any():
        first, second = model.element_numbers[model.pairs[int(np.argmax(at_node))]]
        warnings.warn(
            f"{path}: elements {first} and {second} cross at a node ({at_node.sum()} pairs of elements do): all elements that "
            "end there count the contact in another program; move the nodes",
            stacklevel=3,
        )


def _heading(cards: list[Card], path: Path) -> str:
    first = cards[0] if cards else None
    lines = [line.strip() for line in first.body if line.strip()] if first is not None and first.is_a("HEADING") else []
    return next((line for line in lines if not line.startswith("**")), path.stem)


def _warn_of_what_is_left_out(path: Path, cards: list[Card]) -> None:
    steps = sum(card.is_a("STEP") for card in cards)
    names = {f"*{card.name}" for card in cards if card.name.replace(" ", "") not in _KNOWN}
    for card in cards:
        spare = set(card.parameters) - _KNOWN_PARAMETERS.get(card.name, set(card.parameters))
        names |= {f"{name} of *{card.name}" for name in spare}
    if steps > 1:
        names.add("all steps behind the first")
    if names:
        warnings.warn(f"{path}: not exported: {', '.join(sorted(names))}", stacklevel=3)


def _sections(mesh: Mesh, path: Path) -> tuple[list[tuple[Circular, Material]], NDArray[np.int64]]:
    """Round sections, and the place of that of each element."""
    section_of = np.full(len(mesh.connectivity), -1, dtype=np.int64)
    sections: list[tuple[Circular, Material]] = []
    for name, section, material in mesh.sections:
        if not isinstance(section, Circular) or not isinstance(material.conductivity, float | None):
            continue
        if (section, material) not in sections:
            sections.append((section, material))
        section_of[mesh.element_sets[name]] = sections.index((section, material))
    if any(section.stiffness != 1 for section, _ in sections):
        raise FileError(
            f"{path}: beams with a factor of their stiffness (STIFFNESS of *BEAM SECTION) cannot be exported"
        )
    if (section_of < 0).any():
        raise FileError(
            f"{path}: only wires with SECTION=CIRC and an elastic material that is constant can be exported"
        )
    return sections, section_of


def _that_cross(mesh: Mesh, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
    """Pairs without those of one wire that go on in each other: the element is that of a crossing."""
    part = np.arange(len(mesh.x))
    for _ in range(len(mesh.x)):
        least = part[mesh.connectivity].min(axis=1)
        before = part.copy()
        for end in (0, 1):
            np.minimum.at(part, mesh.connectivity[:, end], least)
        part = part[part]
        if np.array_equal(part, before):
            break
    along = mesh.x[mesh.connectivity[:, 1]] - mesh.x[mesh.connectivity[:, 0]]
    along /= np.linalg.norm(along, axis=1)[:, None]
    first, second = pairs.T
    is_one_wire = part[mesh.connectivity[first, 0]] == part[mesh.connectivity[second, 0]]
    goes_on = np.abs((along[first] * along[second]).sum(axis=1)) > _PARALLEL
    return pairs[~(is_one_wire & goes_on)]


def _candidates(
    path: Path, cards: list[Card], element_sets: dict[str, NDArray[np.int64]], near: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], list[Laws]]:
    """The near pairs that a `*CONTACT PAIR` names, and their laws; of several cards the last one holds."""
    by_name = _interactions(cards)
    laws: list[Laws] = []
    found: dict[tuple[int, int], int] = {}
    sets = {name.upper(): members for name, members in element_sets.items()}
    for card in cards:
        if not card.is_a("CONTACT PAIR"):
            continue
        one = by_name[str(card["INTERACTION"]).upper()]
        if one not in laws:
            laws.append(one)
        for names in card.data:
            members = [sets[key] for key in (str(name).upper() for name in names if name is not None) if key in sets]
            if len(members) < sum(name is not None for name in names):
                warnings.warn(f"{path}: not exported: contact with the rigid surface {names[-1]}", stacklevel=4)
                continue
            is_in = [np.isin(near, some) for some in (members[0], members[-1])]
            touches = (is_in[0][:, 0] & is_in[1][:, 1]) | (is_in[0][:, 1] & is_in[1][:, 0])
            found |= {(int(a), int(b)): laws.index(one) for a, b in near[touches]}
    pairs = np.array(sorted(found), dtype=np.int64).reshape(-1, 2)
    return pairs, np.array([found[a, b] for a, b in pairs.tolist()], dtype=np.int64), laws


def _interactions(cards: list[Card]) -> dict[str, Laws]:
    """Laws by the names of the surface interactions in capitals."""
    found: dict[str, Laws] = {}
    name = ""
    for card in cards:
        if card.is_a("SURFACE INTERACTION"):
            name = str(card["NAME"]).upper()
            found[name] = Laws(NORMAL_LAWS["hertz"], 0, 0.0, axis=_AXES[str(card.get("AXIS", "HERMITE")).upper()])
        elif card.is_a("SURFACE BEHAVIOR"):
            law = str(card["PRESSURE-OVERCLOSURE"]).lower()
            penalty = float(card[0, 0] or 0) if card.data and law == "linear" else 0.0
            if law == "linear" and not penalty:
                raise FileError(
                    f"the interaction {name} has a penalty per length only; the contact element is that of a crossing"
                )
            found[name] = replace(found[name], normal=NORMAL_LAWS[law], penalty=penalty)
        elif card.is_a("GAP ELECTRICAL CONDUCTANCE"):
            numbers = tuple(float(value) for row in card.data for value in row if isinstance(value, int | float))
            voltage = 0 if str(card.get("VOLTAGE", "")).upper() == "LINEAR" else 1
            spot = SPOT_LAWS[str(card["LAW"]).lower()]
            found[name] = replace(found[name], spot=spot, data=numbers, voltage=voltage)
    return found
