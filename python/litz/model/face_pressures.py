"""Loads P1 and P2 of `*DLOAD`: forces per length in Abaqus and litz, pressures on the faces of the section in CalculiX."""

from pathlib import Path

from ..deck import Card
from .mesh_of_cards import MeshOfCards

#: Label, and which side of a rectangle is across its direction
_ACROSS = {"P1": 1, "P2": 0}


def pressures_as_forces(cards: list[Card], dialect: str | None, path: Path) -> list[str]:
    """Change the pressures of a deck of CalculiX on rectangular sections into forces per length.

    Parameters
    ----------
    cards : list of Card
        Of a flat deck.
    dialect : {"abaqus", "ccx"}, optional
        Whose deck it is.
    path : Path
        The deck, for messages.

    Returns
    -------
    list of str
        What has become comments, and why.
    """
    loads = [card for card in cards if card.is_a("DLOAD") and any(_label(row) in _ACROSS for row in card.data)]
    if not loads or dialect == "abaqus":
        return []
    if dialect is None:
        raise ValueError(
            f"{path}: P1 and P2 of *DLOAD are forces per length in Abaqus, but pressures in CalculiX: which of them is meant"
            " must be told by --dialect abaqus or --dialect ccx (in Python dialect='abaqus' or dialect='ccx')"
        )
    mesh = MeshOfCards(cards)
    sections = [(mesh.elements(str(card["ELSET"])), card) for card in cards if _is_section(card)]
    left_out = []
    for load in loads:
        kept = []
        for row in load.data:
            label = _label(row)
            if label in _ACROSS:
                found = [card for elements, card in sections if elements & mesh.elements(row[0])]
                reason = _reason(found, label)
                if reason:
                    text = f"*DLOAD, {row[0]}, {label}: {reason}"
                    left_out.append(text)
                    load.comments.append(f"** {text}: {', '.join(str(value) for value in row)}\n")
                    continue
                row[2] = float(row[2] or 0) * _width(found[0], label)
            kept.append(row)
        load.data = kept
    return left_out


def _label(row: list) -> str:
    return str(row[1]).upper() if len(row) > 2 else ""


def _is_section(card: Card) -> bool:
    return (card.is_a("BEAM SECTION") or card.is_a("BEAM GENERAL SECTION")) and "ELSET" in card


def _width(section: Card, label: str) -> float:
    """Of the face on which the pressure acts; a second side that is left out is like the first."""
    sides = [value for value in section.data[0][:2] if value is not None]
    return float(sides[min(_ACROSS[label], len(sides) - 1)])


def _reason(sections: list[Card], label: str) -> str:
    """Why a pressure has no force per length that is the same; empty: it has."""
    if not sections:
        return "a pressure in CalculiX, on elements without *BEAM SECTION"
    if any(not str(card.get("SECTION", "")).upper().startswith("RECT") for card in sections):
        return "a pressure in CalculiX, of which litz knows the force per length on SECTION=RECT only"
    if any(float(card.get(name, 0)) != 0 for card in sections for name in ("OFFSET1", "OFFSET2")):
        return "a pressure in CalculiX, which acts on the section beside the nodes; loads of litz act along these"
    if len({_width(card, label) for card in sections}) > 1:
        return "a pressure in CalculiX, on sections of several widths: write a line for each"
    return ""
