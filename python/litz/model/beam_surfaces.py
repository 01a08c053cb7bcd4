"""Surfaces of elements, which other programs name in contact pairs, as the element sets that pairs of litz name."""

from collections.abc import Iterator

from ..deck import Card

#: Sides of a wire, which are no places of their own
_ENDS = ("END1", "END2")


def surfaces_as_sets(cards: list[Card]) -> Iterator[tuple[int, Card | None, str]]:
    """For each `*SURFACE` its place, the set that it becomes, and what is to be said where it becomes none.

    A surface of beams without a side is that around them. Where an element set has its name already and other members, the new
    set has a name of its own, also in the contact pairs, which are changed.
    """
    taken = {str(card["ELSET"]).upper() for card in cards if "ELSET" in card}
    for place, card in enumerate(cards):
        if not card.is_a("SURFACE"):
            continue
        name = str(card.get("NAME", ""))
        reason = _reason(card)
        members = [row[0] for row in card.data if row]
        if reason or not name or not members:
            yield place, None, f"*SURFACE, NAME={name}: {reason or 'it has no elements'}"
            continue
        if name.upper() in taken:
            if [str(member).upper() for member in members] == [name.upper()]:
                yield place, None, ""
                continue
            name = _free_name(name, taken)
            _rename_in_pairs(cards, str(card["NAME"]), name)
        taken.add(name.upper())
        rows = [members[first : first + 16] for first in range(0, len(members), 16)]
        yield place, Card.make("ELSET", {"ELSET": name}, rows), ""


def _reason(card: Card) -> str:
    """Why a surface cannot be a set of elements; empty: it can."""
    if str(card.get("TYPE", "ELEMENT")).upper() != "ELEMENT":
        return f"a surface of TYPE={card['TYPE']} is none of elements, with which wires touch"
    if "COMBINE" in card or "CROP" in card:
        return "write out the elements of combined surfaces"
    sides = [str(row[1]).upper() for row in card.data if len(row) > 1 and row[1] is not None]
    if any(side in _ENDS for side in sides):
        return "the ends of wires are no surfaces of their own: they touch as parts of their wires"
    if sides:
        return f"the side {sides[0]} is one of solids or shells: wires touch all around"
    return ""


def _free_name(name: str, taken: set[str]) -> str:
    new = f"{name}_SURFACE"
    while new.upper() in taken:
        new += "_"
    return new


def _rename_in_pairs(cards: list[Card], old: str, new: str) -> None:
    for card in cards:
        if card.is_a("CONTACT PAIR"):
            for row, line in enumerate(card.data):
                for column, value in enumerate(line):
                    if str(value).upper() == old.upper():
                        card[row, column] = new
