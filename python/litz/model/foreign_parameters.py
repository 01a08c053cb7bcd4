"""Parameters of keywords that litz has, but other programs alone: what they do there is told as they are taken away."""

from collections.abc import Iterator
from typing import NamedTuple

from ..deck import Card
from ..deck.keyword_table import squeezed


class _Foreign(NamedTuple):
    """Parameters that other programs alone have."""

    #: The keywords that have them
    keywords: tuple[str, ...]
    #: Their names
    parameters: tuple[str, ...]
    #: Why litz has none of them
    reason: str
    #: Whether results change without
    matters: bool = False


_SECTIONS = ("BEAM SECTION", "BEAM GENERAL SECTION")
_CONTACT = "wires touch at points, which may slide any distance"
_FOREIGN = (
    _Foreign(_SECTIONS, ("TEMPERATURE", "ROTARY INERTIA"), "temperatures are the same over a section, without inertia"),
    _Foreign(_SECTIONS, ("POISSON", "LUMPED"), "sections do not change as wires are stretched"),
    _Foreign(("STEP",), ("UNSYMM", "EXTRAPOLATION", "CONVERT SDI", "SOLVER"), "litz chooses automatically"),
    _Foreign(("STATIC",), ("SOLVER",), "litz chooses automatically; *SOLVER, NAME=... names one"),
    _Foreign(
        ("STATIC",), ("STABILIZE", "ALLSDTOL", "FACTOR", "CONTINUE"),
        "without it; *CONTROLS, PARAMETERS=STABILIZE damps what snaps or is held by contacts alone", True,
    ),
    _Foreign(("SURFACE BEHAVIOR",), ("PENALTY", "AUGMENTED LAGRANGE", "DIRECT"), "the law is satisfied exactly"),
    _Foreign(("FRICTION",), ("SLIP TOLERANCE", "LAGRANGE"), "contacts that stick are as stiff as their metal (Mindlin)"),
    _Foreign(("FRICTION",), ("TAUMAX",), "friction has no largest stress", True),
    _Foreign(("CONTACT PAIR",), ("TYPE", "TRACKING", "MECHANICAL CONSTRAINT", "EXTENSION ZONE"), _CONTACT),
    _Foreign(("CONTACT PAIR",), ("SMALL SLIDING",), _CONTACT, True),
    _Foreign(("CONTACT PAIR",), ("ADJUST",), "nodes stay where they are; INTERFERENCE FIT resolves overlaps", True),
    _Foreign(("NSET", "ELSET"), ("UNSORTED",), "members are in the order of their numbers"),
    _Foreign(("RIGID BODY",), ("POSITION",), "the reference node stays where it is", True),
    _Foreign(("RIGID BODY",), ("ISOTHERMAL",), "temperatures are those of the nodes"),
)  # fmt: skip
#: Keywords with parameters that other programs alone have, and the values that say what litz does anyway
_AS_IN_LITZ = (
    ("AMPLITUDE", "VALUE", "RELATIVE"),
    ("BOUNDARY", "TYPE", "DISPLACEMENT"),
    ("STEP", "AMPLITUDE", "RAMP"),
    ("RIGID BODY", "POSITION", "INPUT"),
)


def remove_foreign_parameters(cards: list[Card]) -> Iterator[tuple[str, bool]]:
    """Take away what other programs alone have, for each kind once: what is to be said, and whether results change.

    Contact that is hard, or a pressure over the overlap, is contact by Hertz's law from there on.
    """
    unsorted = [card for card in cards if card.is_a("NSET") and "UNSORTED" in card]
    for card in unsorted:
        if _is_in_equation(str(card["NSET"]), cards):
            reason = "*EQUATION takes the members of sets by their numbers; write an equation for each of its nodes"
            yield f"UNSORTED of *NSET, NSET={card['NSET']}: {reason}", True
    for card in cards:
        for keyword, name, value in _AS_IN_LITZ:
            if card.is_a(keyword) and str(card.get(name, "")).upper() == value:
                del card[name]
        for keywords, parameters, reason, matters in _FOREIGN:
            if any(card.is_a(keyword) for keyword in keywords):
                for name in [name for name in parameters if name in card]:
                    del card[name]
                    yield f"{name} of *{card.name}: {reason}", matters
        if card.is_a("SURFACE BEHAVIOR"):
            yield from _as_hertz(card)


def _as_hertz(card: Card) -> Iterator[tuple[str, bool]]:
    """Wires flatten where they touch, whatever surfaces of solids are told to do."""
    law = str(card.get("PRESSURE-OVERCLOSURE", "")).upper()
    told = f"PRESSURE-OVERCLOSURE={law} of *SURFACE BEHAVIOR is HERTZ: wires flatten where they touch"
    if law == "HARD":
        card["PRESSURE-OVERCLOSURE"] = "HERTZ"
        yield told, True
    elif law == "LINEAR" and not _is_penalty_of_litz(card):
        card.comments += [f"** {line.strip()}\n" for line in (*card.head, *card.body) if line.strip()]
        card["PRESSURE-OVERCLOSURE"] = "HERTZ"
        card.data = []
        yield f"{told}; LINEAR is a pressure over the overlap there, and a force over it in litz", True


def _is_penalty_of_litz(card: Card) -> bool:
    """Whether the card can only be litz's: a force, or a force per length, over the overlap."""
    return "PENETRATION" in card or any(row and row[0] is None for row in card.data)


def _is_in_equation(name: str, cards: list[Card]) -> bool:
    return any(
        isinstance(value, str) and squeezed(value) == squeezed(name)
        for card in cards
        if card.is_a("EQUATION")
        for row in card.data
        for value in row
    )
