"""Decks of Abaqus and CalculiX with steps as decks of litz: what litz has stays, the rest becomes comments with reasons."""

import re
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..base.program import program_path
from ..deck import Card, Deck
from ..deck.keyword_table import keywords, squeezed
from ..deck.lines import Value
from ..errors import FileError
from .abaqus_mesh import deck_cards, placed, rotated, round_section
from .materials import General, Material

#: Cards whose data lines begin with a node or an element, or the name of a set
_ON_NODES = ("BOUNDARY", "CLOAD", "CECURRENT", "CFLUX", "TEMPERATURE", "INITIAL CONDITIONS")
_ON_ELEMENTS = ("DLOAD", "DFLUX", "FILM", "RADIATE")
#: Cards that have no meaning where the instances are placed
_STRUCTURE = ("ASSEMBLY", "END ASSEMBLY")


@dataclass
class ConvertedDeck:
    """A deck of litz.

    Attributes
    ----------
    text : str
        The deck.
    left_out : list of str
        What became a comment, and why, and changes results.
    ignored : list of str
        What became a comment and changes no result, such as output.
    """

    text: str
    left_out: list[str] = field(default_factory=list)
    ignored: list[str] = field(default_factory=list)


def has_steps(path: Path) -> bool:
    """Whether the file is a deck that has a step, itself or in what it includes."""
    return (
        path.suffix.lower() == ".inp"
        and path.is_file()
        and any(card.is_a("STEP") for card in deck_cards(Deck.read(path)))
    )


def convert_deck(path: Path, dialect: str | None = None, units: dict[str, str] | None = None) -> ConvertedDeck:
    """Convert a whole deck: instances of parts at their places, all else card by card.

    Parameters
    ----------
    path : Path
        The deck.
    dialect : {"abaqus", "ccx"}, optional
        Whose it is; needed where it has round sections.
    units : dict, optional
        Labels of `*UNITS`, such as `{"LENGTH": "mm"}`, where the deck has none.

    Returns
    -------
    ConvertedDeck
        Numbers of nodes and elements are those of the deck, unless several instances have the same.
    """
    cards = list(deck_cards(Deck.read(path)))
    if any(card.is_a("PART") for card in cards):
        cards = list(_Instances(path, cards).flat())
    converted = ConvertedDeck("")
    materials = _materials(cards)
    chunks = [_converted(card, dialect, materials, path) for card in cards]
    commented: set[int] = set()
    for first, last in _steps(cards):
        reason = _reason_to_leave_out(cards[first : last + 1])
        if reason:
            name = cards[first].get("NAME", "")
            told = converted.ignored if _keeps_state(cards[first : last + 1]) else converted.left_out
            told.append(f"*STEP{f', NAME={name}' if name else ''}: {reason}")
            for i in range(first, last + 1):
                chunks[i] = _commented(cards[i], reason if i == first else "")
            commented |= set(range(first, last + 1))
    for i, card in enumerate(cards):
        if i not in commented and not _known(card.name):
            reason = _advice(card.name)
            # the program ignores cards that change no result, too
            (converted.ignored if reason.endswith("; ignored") else converted.left_out).append(reason)
            chunks[i] = _commented(card, reason)
    if units and not any(card.is_a("UNITS") for card in cards):
        at = 1 if cards and cards[0].is_a("HEADING") else 0
        chunks.insert(at, Card.make("UNITS", dict(units)).text)
    converted.text = "".join(chunk if chunk.endswith("\n") else chunk + "\n" for chunk in chunks)
    return converted


def _known(name: str) -> bool:
    return any(squeezed(name) == squeezed(known) for known in keywords())


def _advice(name: str) -> str:
    """What the program says about a keyword that it lacks."""
    done = subprocess.run([program_path(), "keywords", name], capture_output=True, text=True, check=False)
    return done.stderr.strip().removeprefix("error: ")


def _commented(card: Card, reason: str) -> str:
    """The card as comments, behind the reason."""
    lines = [line for line in "".join([*card.head, *card.body]).splitlines() if line.strip()]
    marked = [f"** {line}" if not line.startswith("**") else line for line in lines]
    return "".join(card.comments) + "".join(f"{line}\n" for line in [f"** {reason}:"] * bool(reason) + marked)


def _steps(cards: list) -> Iterator[tuple[int, int]]:
    """First and last card of each step."""
    first = None
    for i, card in enumerate(cards):
        if card.is_a("STEP"):
            first = i
        elif card.is_a("END STEP") and first is not None:
            yield first, i
            first = None


def _reason_to_leave_out(step: list[Card]) -> str:
    """Why litz cannot take the step: its procedure is another one. Empty: it can."""
    procedures = ("STATIC", "COUPLED THERMAL-ELECTRICAL", "COUPLED TEMPERATURE-DISPLACEMENT")
    if any(card.is_a(one) for card in step for one in procedures):
        return ""
    other = next((card.name for card in step[1:] if not _known(card.name)), None)
    return "" if other is None else _advice(other)


def _keeps_state(step: list[Card]) -> bool:
    """Whether the steps that follow are the same without this one: it only looks for eigenvalues."""
    return any(card.is_a(one) for card in step for one in ("FREQUENCY", "BUCKLE", "COMPLEX FREQUENCY"))


def _materials(cards: list[Card]) -> dict[str, Material]:
    """The elastic materials by name, in capitals."""
    found, name = {}, ""
    for card in cards:
        if card.is_a("MATERIAL"):
            name = str(card["NAME"])
        elif card.is_a("ELASTIC") and card.data and len(card.data[0]) > 1:
            young, poisson = (float(value or 0) for value in card.data[0][:2])
            found[name.upper()] = Material(name, young, poisson)
    return found


def _converted(card: Card, dialect: str | None, materials: dict[str, Material], path: Path) -> str:
    """The card in the dialect of litz."""
    if not (card.is_a("BEAM SECTION") or card.is_a("BEAM GENERAL SECTION")):
        return card.text
    shape = str(card.get("SECTION", "")).upper()
    # CalculiX looks at four letters
    if dialect == "ccx" and len(shape) > 4 and shape[:4] in ("RECT", "CIRC", "PIPE"):
        shape = shape[:4]
        card["SECTION"] = shape
    if shape != "CIRC":
        return card.text
    material = materials.get(str(card.get("MATERIAL", "")).upper())
    if material is None:
        raise ValueError(f"{path}: the material {card.get('MATERIAL')} of a *{card.name} has no *ELASTIC")
    section = round_section(path, dialect, card, material)
    if not isinstance(section, General):
        card[0, 0] = section.radius
        row = card.data[0][:1]
        card.data = [row, *card.data[1:]]
        return card.text
    shear = section.shear or (0.0, 0.0)
    card["SECTION"] = "GENERAL"
    card.data = [[section.area, section.i11, 0, section.i22, section.j], list(section.n1 or (0.0, 0.0, -1.0))]
    return card.text + Card.make("TRANSVERSE SHEAR STIFFNESS", {}, [list(shear)]).text


class _Instances:
    """Places the instances of parts: their nodes, elements, sets and sections as a flat deck has them."""

    def __init__(self, path: Path, cards: list[Card]):
        self.path, self.cards = path, cards
        self.parts: dict[str, list[Card]] = {}
        #: New numbers of nodes and elements, by instance in capitals and number
        self.nodes: dict[tuple[str, int], int] = {}
        self.elements: dict[tuple[str, int], int] = {}
        self.sets: set[str] = set()

    def flat(self) -> Iterator[Card]:
        """All cards, those of parts once for each instance."""
        part: list[Card] | None = None
        instance: Card | None = None
        for card in self.cards:
            if card.is_a("PART"):
                part = self.parts.setdefault(str(card["NAME"]).upper(), [])
            elif card.is_a("END PART"):
                part = None
            elif part is not None:
                part.append(card)
            elif card.is_a("INSTANCE"):
                instance = card
                for one in self._part_of(card):
                    yield self._placed(one, card)
            elif card.is_a("END INSTANCE"):
                instance = None
            elif instance is not None:
                yield self._placed(card, instance)
            elif not any(card.is_a(one) for one in _STRUCTURE):
                yield self._renumbered(card, str(card.get("INSTANCE", "")), "")

    def _part_of(self, instance: Card) -> list[Card]:
        part = self.parts.get(str(instance.get("PART", "")).upper())
        if part is None:
            raise FileError(f"{self.path}: *INSTANCE refers to the part {instance.get('PART')}, which does not exist")
        return part

    def _placed(self, card: Card, instance: Card) -> Card:
        """A card of a part, or of an instance with a mesh of its own, at the place of the instance."""
        name = str(instance["NAME"])
        copy = Card(list(card.comments), list(card.head), list(card.body))
        if copy.is_a("NODE"):
            rows = copy.data
            places = np.array([[float(value or 0) for value in [*row[1:4], 0, 0, 0][:3]] for row in rows])
            new = placed(places, instance, self.path).tolist()
            copy.data = [[row[0], *place] for row, place in zip(rows, new, strict=True)]
        elif (copy.is_a("BEAM SECTION") or copy.is_a("BEAM GENERAL SECTION")) and len(instance.data) > 1:
            self._turn_axis(copy, instance)
        elif copy.is_a("TRANSFORM"):
            self._place_axes(copy, instance)
        return self._renumbered(copy, name, f"{name}.")

    @staticmethod
    def _turn_axis(section: Card, instance: Card) -> None:
        """Turn the first axis of a section with its instance."""
        rows = section.data
        numbers = [float(value or 0) for value in instance.data[1]]
        a, b, angle = np.array(numbers[:3]), np.array(numbers[3:6]), numbers[6]
        n1 = np.array([[float(value or 0) for value in (rows[1] if len(rows) > 1 else [0, 0, -1])]])
        turned = rotated(n1, np.zeros(3), b - a, angle)
        section.data = [rows[0], turned[0].tolist(), *rows[2:]]

    def _place_axes(self, transform: Card, instance: Card) -> None:
        """Axes of nodes turn with their instance; those of a cylinder or a sphere are where its points are."""
        points = np.array([float(value or 0) for value in [*transform.data[0], 0, 0, 0, 0, 0][:6]]).reshape(2, 3)
        new = placed(points, instance, self.path)
        if str(transform.get("TYPE", "R")).upper() == "R":
            new -= placed(np.zeros((1, 3)), instance, self.path)
        transform.data = [new.ravel().tolist()]

    def _renumbered(self, card: Card, instance: str, prefix: str) -> Card:
        """Numbers and names as the flat deck has them."""
        if card.is_a("NODE") or card.is_a("ELEMENT"):
            self._define(card, instance)
        elif card.is_a("NSET") or card.is_a("ELSET"):
            self._collect(card, instance, prefix)
        elif any(card.is_a(one) for one in (*_ON_NODES, *_ON_ELEMENTS)):
            numbers = self.nodes if any(card.is_a(one) for one in _ON_NODES) else self.elements
            for i, row in enumerate(card.data):
                if row and row[0] is not None:
                    new = self._item(row[0], numbers, "")
                    if new != row[0]:
                        card[i, 0] = new
        for parameter in ("NSET", "ELSET", "TIE NSET", "PIN NSET"):
            if prefix and parameter in card:
                name = prefix + str(card[parameter])
                self.sets.add(name.upper())
                card[parameter] = name
        if "INSTANCE" in card:
            del card["INSTANCE"]
        return card

    def _define(self, card: Card, instance: str) -> None:
        """New numbers: those of the deck where they are free, and otherwise above all so far."""
        numbers = self.nodes if card.is_a("NODE") else self.elements
        taken = set(numbers.values())
        highest = max(taken, default=0)
        rows = card.data
        clash = any(row[0] in taken for row in rows)
        new_rows = []
        for row in rows:
            if not isinstance(row[0], int):
                raise FileError(f"{self.path}: a line of *{card.name} needs a whole number, not {row[0]!r}")
            highest += 1
            new = highest if clash else row[0]
            numbers[instance.upper(), row[0]] = new
            others = [self._item(node, self.nodes, instance) for node in row[1:]] if card.is_a("ELEMENT") else row[1:]
            new_rows.append([new, *others])
        card.data = new_rows

    def _collect(self, card: Card, instance: str, prefix: str) -> None:
        """Members of a set; ranges are written out, as numbers may have changed."""
        numbers = self.nodes if card.is_a("NSET") else self.elements
        members: list = []
        for row in card.data:
            if "GENERATE" in card:
                first, last, *step = (int(value) for value in row if value is not None)
                wanted = range(first, last + 1, *step)
                members += [numbers[instance.upper(), one] for one in wanted if (instance.upper(), one) in numbers]
            else:
                for value in row:
                    if isinstance(value, str) and f"{prefix}{value}".upper() in self.sets:
                        members.append(f"{prefix}{value}")
                    elif value is not None:
                        members.append(self._item(value, numbers, instance))
        if "GENERATE" in card:
            del card["GENERATE"]
        card.data = [members[i : i + 16] for i in range(0, len(members), 16)]
        if not prefix:
            self.sets.add(str(card.get("NSET", card.get("ELSET", ""))).upper())

    @staticmethod
    def _item(value: Value, numbers: dict[tuple[str, int], int], instance: str) -> Value:
        """A number as the flat deck has it: of the instance, or `instance.number`; or a name as it is."""
        key: tuple[str, int] = (instance.upper(), value) if isinstance(value, int) else ("", 0)
        named = re.fullmatch(r"(.+)\.(\d+)", str(value)) if isinstance(value, str) else None
        if named:
            key = (named[1].upper(), int(named[2]))
        return numbers.get(key, value)
