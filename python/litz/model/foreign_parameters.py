"""Parameters of keywords that litz has, but other programs alone: what they do there is told as they are taken away."""

from collections.abc import Iterator
from typing import NamedTuple

from ..deck import Card


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

    Contact that is hard is contact by Hertz's law from there on.
    """
    for card in cards:
        for keyword, name, value in _AS_IN_LITZ:
            if card.is_a(keyword) and str(card.get(name, "")).upper() == value:
                del card[name]
        for keywords, parameters, reason, matters in _FOREIGN:
            if any(card.is_a(keyword) for keyword in keywords):
                for name in [name for name in parameters if name in card]:
                    del card[name]
                    yield f"{name} of *{card.name}: {reason}", matters
        if card.is_a("SURFACE BEHAVIOR") and str(card.get("PRESSURE-OVERCLOSURE", "")).upper() == "HARD":
            card["PRESSURE-OVERCLOSURE"] = "HERTZ"
            yield "PRESSURE-OVERCLOSURE=HARD of *SURFACE BEHAVIOR is HERTZ: wires flatten where they touch", True
