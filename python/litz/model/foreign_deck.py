"""Decks of Abaqus and CalculiX with steps as decks of litz: what litz has stays, the rest becomes comments with reasons."""

import re
import subprocess
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from ..base.program import program_path
from ..deck import Card, Deck
from ..deck.blank_axis import write_blank_axis
from ..deck.instances import deck_cards, flat_cards
from ..deck.keyword_table import check_card, keywords, squeezed
from ..errors import InputError, LitzError
from ..runs import check
from .abaqus_mesh import round_section
from .beam_surfaces import surfaces_as_sets
from .distributing_couplings import distributing_couplings_as_equations
from .equations_in_order import equations_in_order
from .face_pressures import pressures_as_forces
from .foreign_bodies import foreign_bodies
from .foreign_parameters import remove_foreign_parameters
from .general_contact import general_contact
from .history_requests import history_requests_as_prints
from .kinematic_couplings import couplings_as_rigid_bodies
from .materials import General, Material
from .multi_point_constraints import constraints_as_rigid_bodies
from .smooth_steps import smooth_steps_as_tables
from .steps_at_once import steps_at_once
from .unused_definitions import unused_definitions
from .velocities import velocities_as_displacements
from .weights_of_steps import keep_weights_of_earlier_steps

_CONTROLS = "*CONTROLS: increments and iterations are controlled otherwise (`litz keywords CONTROLS`); ignored"

#: How the program begins to tell of a keyword that it lacks
_LACKS = ("error: litz has no *", "error: unknown keyword")
#: How reasons begin to tell of cards that join nodes, and what the program then says of a node that only these move
_JOINS = tuple(
    f"litz has no *{name}:"
    for name in ("COUPLING", "KINEMATIC COUPLING", "DISTRIBUTING COUPLING", "MPC", "TIE", "EMBEDDED ELEMENT")
)
_OF_NO_ELEMENT = " belongs to no element"
#: Elements without stiffness, and the cards that give their masses
_MASSES = ("MASS", "ROTARYI", "ROTARY INERTIA")

# Of decks that are a mesh with its sections
_OUTLINE = "** Supports, contacts and loads must be added.\n*STEP\n*STATIC\n*END STEP\n"


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

    def tell(self, changes: Iterable[tuple[str, bool]]) -> None:
        """Note what is to be said, and whether results change."""
        for reason, matters in changes:
            (self.left_out if matters else self.ignored).append(reason)


def has_steps(path: Path) -> bool:
    """Whether the file is a deck that has a step, itself or in what it includes."""
    return (
        path.suffix.lower() == ".inp"
        and path.is_file()
        and any(card.is_a("STEP") for card in deck_cards(Deck.read(path)))
    )


def has_materials(path: Path) -> bool:
    """Whether the file is a deck with materials."""
    return path.suffix.lower() == ".inp" and any(card.is_a("ELASTIC") for card in deck_cards(Deck.read(path)))


def _comment_what_litz_lacks(
    cards: list[Card], chunks: list[str], commented: set[int], converted: ConvertedDeck
) -> None:
    """Make comments of cards that litz does not have, but those that are comments by now."""
    has_weight = any(
        str(value).upper() == "GRAV" for card in cards if card.is_a("DLOAD") for row in card.data for value in row
    )
    for i, card in enumerate(cards):
        reason = "" if i in commented else _reason_for_comment(card, has_weight)
        if reason and i and cards[i - 1].is_a("COUPLING") and (card.is_a("KINEMATIC") or card.is_a("DISTRIBUTING")):
            # it says how the coupling joins, of which all is told
            chunks[i] = _commented(card, "")
        elif reason:
            # the program ignores cards that change no result, too
            (converted.ignored if reason.endswith("; ignored") else converted.left_out).append(reason)
            chunks[i] = _commented(card, reason)


def sections_of(path: Path) -> dict[str, str]:
    """Shape of each section of a deck, by its element set; none of files of other kinds."""
    if path.suffix.lower() != ".inp":
        return {}
    return {
        str(card.get("ELSET", "")): str(card.get("SECTION", "")).upper()
        for card in deck_cards(Deck.read(path))
        if card.is_a("BEAM SECTION") or card.is_a("BEAM GENERAL SECTION")
    }


def convert_deck(path: Path, dialect: str | None = None, units: dict[str, str] | None = None) -> ConvertedDeck:
    """Convert a whole deck: instances of parts at their places, all else card by card.

    Parameters
    ----------
    path : Path
        The deck.
    dialect : {"abaqus", "ccx"}, optional
        Whose it is; needed where it has round sections, loads P1 or P2, or GRAV in several steps.
    units : dict, optional
        Labels of `*UNITS`, such as `{"LENGTH": "mm"}`, where the deck has none.

    Returns
    -------
    ConvertedDeck
        Numbers of nodes and elements are those of the deck, unless several instances have the same.

    Raises
    ------
    InputError
        If a card lacks what the program needs of it, too, with what the program says.
    """
    try:
        return _converted_deck(path, dialect, units)
    except (ValueError, TypeError, LookupError) as error:
        # what names the deck is told already
        said = "" if str(path) in str(error) else refusal(path)
        if not said:
            raise
        # conversion is there for what litz lacks
        wrong = [one for one in re.split(r"^(?=error: )", said, flags=re.MULTILINE) if not one.startswith(_LACKS)]
        raise InputError(
            f"{path} cannot be converted before it is mended; `litz check` says:\n{''.join(wrong) or said}".rstrip()
        ) from error


def _converted_deck(path: Path, dialect: str | None, units: dict[str, str] | None) -> ConvertedDeck:
    cards = flat_cards(path)
    converted = ConvertedDeck("")
    materials = _materials(cards)
    converted.ignored += [*couplings_as_rigid_bodies(cards), *foreign_bodies(cards)]
    for change in (distributing_couplings_as_equations(cards), constraints_as_rigid_bodies(cards, dialect, path)):
        converted.tell(change)
    converted.ignored += equations_in_order(cards)
    converted.tell(remove_foreign_parameters(cards))
    converted.ignored += keep_weights_of_earlier_steps(cards, dialect, path)
    converted.ignored += smooth_steps_as_tables(cards)
    # before amplitudes that steps give their loads: velocities are there at once anyway
    converted.tell(velocities_as_displacements(cards))
    converted.ignored += [*steps_at_once(cards), *history_requests_as_prints(cards)]
    converted.left_out += pressures_as_forces(cards, dialect, path)
    surfaces = list(surfaces_as_sets(cards))
    chunks = [_converted(card, dialect, materials, path) for card in cards]
    commented = {place for place, _, _ in surfaces}
    for place, new, reason in surfaces:
        chunks[place] = "".join(cards[place].comments) + new.text if new else _commented(cards[place], reason)
        if reason:
            converted.left_out.append(reason)
    commented |= _replace_general_contact(cards, chunks, converted)
    steps = [(first, last, _reason_to_leave_out(cards[first : last + 1])) for first, last in _steps(cards)]
    has_step = any(not reason for *_, reason in steps)
    for first, last, reason in steps:
        if reason:
            name = cards[first].get("NAME", "")
            told = converted.ignored if has_step and _keeps_state(cards[first : last + 1]) else converted.left_out
            told.append(f"*STEP{f', NAME={name}' if name else ''}: {reason}")
            for i in range(first, last + 1):
                chunks[i] = _commented(cards[i], reason if i == first else "")
            commented |= set(range(first, last + 1))
    if steps and not has_step:
        converted.left_out.append("no *STEP is left: write one with *STATIC")
    for i in _outside_of_steps(cards):
        if i - 1 not in commented:
            converted.left_out.append(f"*{cards[i].name} after *END STEP: it is in no step, and CalculiX ends there")
        chunks[i] = _commented(cards[i], "")
        commented.add(i)
    _comment_what_litz_lacks(cards, chunks, commented, converted)
    if units and not any(card.is_a("UNITS") for card in cards):
        at = 1 if cards and cards[0].is_a("HEADING") else 0
        chunks.insert(at, Card.make("UNITS", dict(units)).text)
    if not steps:
        chunks.append(_OUTLINE)
    converted.text = "".join(chunk if chunk.endswith("\n") else chunk + "\n" for chunk in chunks)
    _comment_unused_definitions(converted)
    return converted


def refusal(deck: Path) -> str:
    """What the program says about a deck that it does not take; empty: it takes it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            check(deck)
        except LitzError as error:
            return str(error)
    return ""


def refusal_by_itself(deck: Path, left_out: list[str]) -> str:
    """What the program says about a converted deck; what follows from joints that became comments is said in a line."""
    said = refusal(deck)
    if not any(reason.startswith(_JOINS) for reason in left_out):
        return said
    errors = [one for one in re.split(r"^(?=error: )", said, flags=re.MULTILINE) if one]
    others = [one for one in errors if _OF_NO_ELEMENT not in one]
    if len(others) < len(errors):
        others.append("nodes that belong to no element have loads or supports: the joints above would move them")
    return "".join(others).rstrip("\n")


def _comment_unused_definitions(converted: ConvertedDeck) -> None:
    """Make comments of definitions that nothing uses, or that only comments use by now."""
    deck = Deck.parse(converted.text)
    comments = {}
    for cards, reason in unused_definitions(deck):
        converted.ignored.append(reason)
        comments.update({id(card): _commented(card, reason if card is cards[0] else "") for card in cards})
    if comments:
        converted.text = "".join([comments.get(id(card), card.text) for card in deck] + deck.tail)


def _replace_general_contact(cards: list[Card], chunks: list[str], converted: ConvertedDeck) -> set[int]:
    """Make comments of the cards of general contact, and a pair; the places of these cards."""
    general = general_contact(cards)
    for place, pair in general.items():
        chunks[place] = _commented(cards[place], "") + "".join(card.text for card in pair)
    if general:
        converted.ignored.append("*CONTACT INCLUSIONS, ALL EXTERIOR is a *CONTACT PAIR of all wires with each other")
    return set(general)


def _known(name: str) -> bool:
    return any(squeezed(name) == squeezed(known) for known in keywords())


def _reason_for_comment(card: Card, has_weight: bool) -> str:
    """Why litz cannot take the card; empty: it has the keyword, whose parameters and values it checks itself."""
    if any(map(card.is_a, _MASSES)) or (card.is_a("ELEMENT") and str(card.get("TYPE", "")).upper() in _MASSES):
        return f"masses at nodes: {'their weight is missing' if has_weight else 'there is no inertia; ignored'}"
    if card.is_a("CONTROLS") and not _is_taken(card):
        return _CONTROLS
    return "" if _known(card.name) else _advice(card.name)


def _is_taken(card: Card) -> bool:
    """Whether the program takes the card as it is."""
    rows = [list(row) for row in card.data]
    for row in rows:
        while row and row[-1] is None:
            row.pop()
    try:
        check_card(card.name, card.parameters, rows)
    except ValueError:
        return False
    return True


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


def _outside_of_steps(cards: list) -> Iterator[int]:
    """What stands behind the end of a step, before the next one."""
    outside = False
    for i, card in enumerate(cards):
        if card.is_a("STEP"):
            outside = False
        elif outside:
            yield i
        elif card.is_a("END STEP"):
            outside = True


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
    if card.is_a("DLOAD") and not card.data and "OP" not in card:
        # all its loads have become comments
        return _commented(card, "")
    if not (card.is_a("BEAM SECTION") or card.is_a("BEAM GENERAL SECTION")):
        return card.text
    if card.is_a("BEAM SECTION") and len(card.data) > 2:
        # numbers of integration points
        card.data = card.data[:2]
    write_blank_axis(card)
    shape = str(card.get("SECTION", "")).upper()
    # CalculiX looks at four letters
    if dialect == "ccx" and len(shape) > 4 and shape[:4] in ("RECT", "CIRC", "PIPE"):
        shape = shape[:4]
        card["SECTION"] = shape
    has_own_moduli = dialect == "abaqus" and card.is_a("BEAM GENERAL SECTION") and "MATERIAL" not in card
    if shape != "CIRC" or has_own_moduli:
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
    card["SECTION"] = "GENERAL"
    for name in ("OFFSET1", "OFFSET2"):
        if name in card:
            del card[name]
    (_, _, data), *more = section.cards("ANY", material.name)
    card.data = data
    return card.text + "".join(Card.make(*one).text for one in more)
