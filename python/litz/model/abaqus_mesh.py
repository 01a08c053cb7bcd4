"""Meshes in decks of Abaqus and CalculiX."""

import itertools
import warnings
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..deck import Card, Deck
from ..deck.instances import deck_cards
from ..deck.lines import Value
from ..deck.placement import placed
from ..errors import FileError
from .materials import Circular, General, Material, Section
from .mesh import FOREIGN_BEAMS, Mesh, element_types, unique_rows

#: Cards that a mesh does not lack
_NO_LOSS = ("HEADING", "PREPRINT", "ASSEMBLY", "END ASSEMBLY", "NORMAL", "ORIENTATION")
_CONDUCTIVITY = "ELECTRICAL CONDUCTIVITY"
#: Whose decks are read
DIALECTS = ("abaqus", "ccx")
#: Trusses, as which gmsh writes its lines: wires in a deck that has no beams
_TRUSSES = {"T3D2": 2, "T3D3": 3}
#: Number of a node or element in a deck, behind the name of the instance of a part that has it, in capitals
_Key = tuple[str, int]


class _DeckReader:
    """Collects the mesh of a deck, card by card."""

    def __init__(self, path: Path, dialect: str | None):
        self.path = path
        self.dialect = dialect
        self.row_of: dict[_Key, int] = {}
        self.places: list[list[float]] = []
        #: Nodes of the elements of litz, and their types; None: a truss
        self.pairs: list[tuple[_Key, _Key]] = []
        self.kinds: list[str | None] = []
        #: Rows of the elements of litz that each element of the deck became
        self.elements: dict[_Key, list[int]] = {}
        self.node_sets: dict[str, list[_Key]] = {}
        self.element_sets: dict[str, list[_Key]] = {}
        #: Data of materials by name, and by keyword
        self.materials: dict[str, dict[str, list[list[Value]]]] = {}
        self.sections: list[tuple[str, Card]] = []
        self.left_out: dict[str, int] = {}
        #: Names of the cards that are no mesh, in their order
        self.dropped: dict[str, None] = {}
        #: Cards of the parts
        self.parts: dict[str, list[Card]] = {}
        self._material = ""
        #: The instance that is read, and what its names begin with
        self._instance, self._prefix = "", ""
        self._part: list[Card] | None = None
        self._turn: tuple[int, Card] | None = None

    def read(self, card: Card) -> None:
        """Read a card; those that do not concern the mesh are kept by name."""
        if card.is_a("END PART"):
            self._part = None
        elif card.is_a("PART"):
            self._part = self.parts.setdefault(str(card["NAME"]).upper(), [])
        elif self._part is not None:
            self._part.append(card)
        elif card.is_a("INSTANCE"):
            self._begin_instance(card)
        elif card.is_a("END INSTANCE"):
            self._end_instance()
        elif card.is_a("NODE"):
            self._nodes(card)
        elif card.is_a("ELEMENT"):
            self._elements(card)
        elif card.is_a("NSET"):
            self._collect(self.node_sets, str(card["NSET"]), card)
        elif card.is_a("ELSET"):
            self._collect(self.element_sets, str(card["ELSET"]), card)
        else:
            self._read_property(card)

    def _read_property(self, card: Card) -> None:
        """Read a card of a section or a material; others are told of."""
        if card.is_a("MATERIAL"):
            self._material = str(card.get("NAME", ""))
        elif card.is_a("ELASTIC") or card.is_a(_CONDUCTIVITY):
            keyword = "ELASTIC" if card.is_a("ELASTIC") else _CONDUCTIVITY
            self.materials.setdefault(self._material, {})[keyword] = card.data
        elif card.is_a("BEAM SECTION"):
            self.sections.append((self._prefix, card))
        elif card.name not in _NO_LOSS:
            self.dropped[card.name] = None

    def mesh(self) -> Mesh:
        """The mesh that has been read."""
        self._take_or_leave_trusses()
        if self.left_out:
            types = ", ".join(f"{count} of type {kind or 'none'}" for kind, count in self.left_out.items())
            warnings.warn(f"{self.path}: elements that are not beams are ignored: {types}", stacklevel=5)
        if self.parts and not self.places:
            raise FileError(f"{self.path} has parts, but no *INSTANCE of them")
        try:
            rows = [(self.row_of[a], self.row_of[b]) for a, b in self.pairs]
        except KeyError as error:
            raise FileError(f"{self.path}: an element has the node {error.args[0][1]}, which does not exist") from None
        connectivity = np.array(rows, dtype=np.int64).reshape(-1, 2)
        mesh = Mesh(np.array(self.places).reshape(-1, 3), connectivity, np.array(self.kinds, dtype=str), path=self.path)
        for name, nodes in self.node_sets.items():
            mesh.node_sets[name] = unique_rows(self.row_of[node] for node in nodes if node in self.row_of)
        for name, elements in self.element_sets.items():
            mesh.element_sets[name] = unique_rows(row for element in elements for row in self.elements.get(element, ()))
        sections = list(_sections_of(self))
        mesh.sections = [(_spelt(name, mesh.element_sets), *properties) for name, *properties in sections]
        return mesh

    def _begin_instance(self, card: Card) -> None:
        """Read the part, once more for each instance of it."""
        part = str(card.get("PART", "")).upper()
        if part not in self.parts:
            raise FileError(f"{self.path}: *INSTANCE refers to the part {card.get('PART')}, which does not exist")
        self._instance, self._prefix = str(card["NAME"]).upper(), f"{card['NAME']}."
        self._turn = len(self.places), card
        for one in self.parts[part]:
            self.read(one)

    def _end_instance(self) -> None:
        """Move the instance to its place, by the data lines of its card: a shift, then a rotation about an axis."""
        if self._turn is not None:
            first, card = self._turn
            self.places[first:] = placed(np.array(self.places[first:]).reshape(-1, 3), card, self.path).tolist()
        self._instance, self._prefix, self._turn = "", "", None

    def _take_or_leave_trusses(self) -> None:
        """Trusses are wires where there are no beams."""
        if None not in self.kinds:
            return
        if all(kind is None for kind in self.kinds):
            self.kinds = [""] * len(self.kinds)
            return
        beams = [row for row, kind in enumerate(self.kinds) if kind is not None]
        new = {row: i for i, row in enumerate(beams)}
        for number, rows in list(self.elements.items()):
            self.elements[number] = [new[row] for row in rows if row in new]
            if not self.elements[number]:
                self.left_out["T3D2 or T3D3"] = self.left_out.get("T3D2 or T3D3", 0) + 1
        self.pairs = [self.pairs[row] for row in beams]
        self.kinds = [self.kinds[row] for row in beams]

    def _nodes(self, card: Card) -> None:
        rows = [(self._key(number, card), place) for number, *place in card.data]
        for key, place in rows:
            self.row_of[key] = len(self.places)
            self.places.append([float(value or 0) for value in [*place, 0, 0, 0][:3]])
        if "NSET" in card:
            self._set(self.node_sets, str(card["NSET"])).extend(key for key, _ in rows)

    def _elements(self, card: Card) -> None:
        kind = str(card.get("TYPE", "")).upper()
        if kind not in FOREIGN_BEAMS and kind not in _TRUSSES and kind not in element_types():
            self.left_out[kind] = self.left_out.get(kind, 0) + len(card.data)
            return
        ours, n_nodes = FOREIGN_BEAMS.get(kind) or ((None, _TRUSSES[kind]) if kind in _TRUSSES else (kind, 2))
        numbers = []
        for row in card.data:
            number, *nodes = (self._key(value, card) for value in row)
            # what follows the nodes along the beam is Abaqus's node for the orientation of the section
            first = len(self.pairs)
            self.pairs += itertools.pairwise(nodes[:n_nodes])
            self.kinds += [ours] * (len(self.pairs) - first)
            self.elements[number] = list(range(first, len(self.pairs)))
            numbers.append(number)
        if "ELSET" in card:
            self._set(self.element_sets, str(card["ELSET"])).extend(numbers)

    def _collect(self, sets: dict[str, list[_Key]], name: str, card: Card) -> None:
        """Members of a set: numbers, names of sets, ranges."""
        members = self._set(sets, name)
        if card.is_a("NSET") and "ELSET" in card:
            of_instance = _spelt(f"{card.get('INSTANCE')}.{card['ELSET']}", self.element_sets)
            name = of_instance if of_instance in self.element_sets else str(card["ELSET"])
            elements = self._set_named(self.element_sets, name)
            members += [
                node for element in elements for row in self.elements.get(element, ()) for node in self.pairs[row]
            ]
        for row in card.data:
            if "GENERATE" in card:
                first, last, *step = (self._key(value, card)[1] for value in row if value is not None)
                members += [self._key(number, card) for number in range(first, last + 1, *step)]
                continue
            for value in row:
                if isinstance(value, int):
                    members.append(self._key(value, card))
                elif value is not None:
                    members += self._set_named(sets, str(value))

    def _set(self, sets: dict[str, list[_Key]], name: str) -> list[_Key]:
        """The set of this name, made where there is none; capitals do not matter."""
        return sets.setdefault(_spelt(self._prefix + name, sets), [])

    def _set_named(self, sets: dict[str, list[_Key]], name: str) -> list[_Key]:
        """A set of this instance, or else of the whole deck; capitals do not matter."""
        for wanted in (_spelt(self._prefix + name, sets), _spelt(name, sets)):
            if wanted in sets:
                return list(sets[wanted])
        raise FileError(f"{self.path}: there is no set {name}, which another set has as a member")

    def _key(self, value: object, card: Card) -> _Key:
        if not isinstance(value, int):
            raise FileError(f"{self.path}: a line of *{card.name} needs a whole number, not {value!r}")
        return str(card.get("INSTANCE", self._instance)).upper(), value


def _spelt(name: str, names: Iterable[str]) -> str:
    """The name as the first of the others spells it: capitals do not matter in a deck."""
    return next((known for known in names if known.upper() == name.upper()), name)


def read_deck(path: Path, dialect: str | None = None) -> Mesh:
    """The beams, sets and sections of a deck; `dialect` is one of `DIALECTS`, needed where it has round sections."""
    reader = _reader_of(path, dialect)
    if reader.dropped:
        names = ", ".join(f"*{name}" for name in reader.dropped)
        warnings.warn(f"{path}: only the mesh is read, with sections and materials, not {names}", stacklevel=4)
    return reader.mesh()


def read_numbered_deck(path: Path, dialect: str) -> tuple[Mesh, NDArray[np.int64], NDArray[np.int64]]:
    """The same, with the numbers of the nodes and of the elements in the deck."""
    reader = _reader_of(path, dialect)
    mesh = reader.mesh()
    nodes = [number for _, number in reader.row_of]
    if len(set(nodes)) < len(nodes) or len({number for _, number in reader.elements}) < len(reader.elements):
        raise FileError(f"{path}: a number stands for several nodes or elements")
    numbers = np.zeros(len(mesh.connectivity), dtype=np.int64)
    halves = []
    for (_, number), (row, *others) in reader.elements.items():
        numbers[row] = number
        halves += others
    # second halves of quadratic beams
    numbers[halves] = numbers.max(initial=0) + 1 + np.arange(len(halves))
    return mesh, np.array(nodes, dtype=np.int64), numbers


def _reader_of(path: Path, dialect: str | None) -> _DeckReader:
    if dialect not in (None, *DIALECTS):
        raise ValueError(f"dialect must be {' or '.join(map(repr, DIALECTS))}, not {dialect!r}")
    reader = _DeckReader(path, dialect)
    for card in deck_cards(Deck.read(path)):
        if card.is_a("STEP"):
            reader.dropped["STEP"] = None
            break
        reader.read(card)
    return reader


def _sections_of(reader: _DeckReader) -> Iterator[tuple]:
    """Round sections whose material is there."""
    for prefix, card in reader.sections:
        shape, name = str(card.get("SECTION", "")).upper(), str(card.get("MATERIAL", ""))
        material = _material(name, reader.materials.get(_spelt(name, reader.materials), {}))
        if shape != "CIRC" or material is None:
            reason = (
                f"its material {name} has no *ELASTIC, or one that depends on temperature"
                if shape == "CIRC"
                else f"it is {shape or 'without a shape'}, and wires of a mesh are round (CIRC)"
            )
            warnings.warn(
                f"{reader.path}: the section of {card.get('ELSET')} is ignored: {reason}; a deck with a *STEP is converted"
                " with all its sections",
                stacklevel=6,
            )
            continue
        offsets = [one for one in ("OFFSET1", "OFFSET2") if float(card.get(one, 0))]
        if offsets:
            raise ValueError(
                f"{reader.path}: *BEAM SECTION, ELSET={card.get('ELSET')} has {' and '.join(offsets)}: the axes of wires of a"
                " mesh pass through their nodes; litz convert keeps the whole deck"
            )
        yield f"{prefix}{card['ELSET']}", round_section(reader.path, reader.dialect, card, material), material


def round_section(path: Path, dialect: str | None, card: Card, material: Material) -> Section:
    """What `SECTION=CIRC` means: the radius in Abaqus; the diameters of an ellipse along the section axes in CalculiX."""
    where = f"{path}: *BEAM SECTION, ELSET={card.get('ELSET')}, SECTION=CIRC"
    if dialect is None:
        raise ValueError(
            f"{where} is the radius in Abaqus, but the diameter in CalculiX: which of them is meant must be told by"
            " --dialect abaqus or --dialect ccx (in Python dialect='abaqus' or dialect='ccx')"
        )
    values = [value for value in (card.data or [[]])[0] if value is not None]
    if len(values) not in (1, 2)[: 1 + (dialect == "ccx")]:
        takes = "the radius" if dialect == "abaqus" else "one diameter, or two"
        raise ValueError(f"{where} has {len(values)} values on its first line; in the dialect {dialect} it is {takes}")
    if dialect == "abaqus":
        # parameters of litz
        conduction, stiffness = str(card.get("CONDUCTION", "REFERENCE LENGTH")), float(card.get("STIFFNESS", 1))
        return Circular(float(values[0]), card.get("CONTACT RADIUS"), conduction, stiffness)
    first, last = float(values[0]), float(values[-1])
    if first == last:
        return Circular(first / 2)
    n1 = [float(value or 0) for value in [*card.data[1], 0, 0, 0][:3]] if len(card.data) > 1 else [0.0, 0.0, -1.0]
    # the node is that many diameters from the middle
    arm = [-float(card.get(name, 0)) * diameter for name, diameter in (("OFFSET1", first), ("OFFSET2", last))]
    return _ellipse(first / 2, last / 2, (n1[0], n1[1], n1[2]), material, (arm[0], arm[1]))


def _ellipse(
    a: float, b: float, n1: tuple[float, float, float], material: Material, middle: tuple[float, float]
) -> General:
    """A solid ellipse of semi-axes `a` along the first axis and `b` along the second, its middle from the node.

    Second moments and torsion constant: Timoshenko and Goodier, Theory of Elasticity, 3rd edition, section 105. Shear
    factors: Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966), 335-340.
    """
    area, nu = np.pi * a * b, material.poisson
    torsion = np.pi * (a * b) ** 3 / (a**2 + b**2)

    def shear(along: float, across: float) -> float:
        """Shear stiffness for shear along the semi-axis `along`."""
        m = (along / across) ** 2
        factor = 12 * (1 + nu) * m * (3 * m + 1) / ((40 + 37 * nu) * m**2 + (16 + 10 * nu) * m + nu)
        return factor * area * material.young / (2 * (1 + nu))

    return General(
        area,
        area * b**2 / 4,
        area * a**2 / 4,
        torsion,
        n1=n1,
        shear=(shear(a, b), shear(b, a)),
        centroid=middle if any(middle) else None,
        shear_center=middle if any(middle) else None,
    )


def _material(name: str, cards: Mapping[str, list[list[Value]]]) -> Material | None:
    """A material of the data lines that have been read, whose last values are temperatures; None: it is none of litz."""
    elastic = [row[:2] for row in cards.get("ELASTIC", [])]
    if not elastic or any(row != elastic[0] for row in elastic) or len(cards["ELASTIC"][0]) > 3:
        return None
    if len(elastic[0]) < 2 or not all(isinstance(value, int | float) for value in elastic[0]):
        return None
    young, poisson = (float(value) for value in elastic[0] if isinstance(value, int | float))
    rows = [[float(value) for value in row if isinstance(value, int | float)] for row in cards.get(_CONDUCTIVITY, [])]
    if not all(len(row) > (len(rows) > 1) for row in rows):
        return None
    conductivity = rows[0][0] if len(rows) == 1 else [(row[0], row[-1]) for row in rows] or None
    return Material(name, young, poisson, conductivity)
