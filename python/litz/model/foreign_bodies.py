"""Rigid bodies as other programs have them: of the elements of a set, or with a node for their rotations."""

from collections.abc import Iterator

from ..deck import Card
from .kinematic_couplings import free_name
from .mesh_of_cards import MeshOfCards

_ROTATIONS = {1: 4, 2: 5, 3: 6}


def foreign_bodies(cards: list[Card]) -> Iterator[str]:
    """Rewrite, in the list, rigid bodies of elements and those with a `ROT NODE`; what is to be said of each.

    In CalculiX degrees of freedom 1 to 3 of a `ROT NODE` are the rotations of a body, which are 4 to 6 of the reference node.
    """
    mesh = MeshOfCards(cards)
    for body in [card for card in cards if card.is_a("RIGID BODY")]:
        if "ELSET" in body and not any(name in body for name in ("NSET", "TIE NSET")):
            name = free_name(str(body["ELSET"]), {str(card["NSET"]).upper() for card in cards if "NSET" in card})
            cards.insert(cards.index(body), Card.make("NSET", {"NSET": name, "ELSET": body["ELSET"]}))
            del body["ELSET"]
            body["TIE NSET"] = name
            yield f"ELSET of *RIGID BODY is TIE NSET={name}, the nodes of its elements"
        rotations = mesh.nodes(body.get("ROT NODE")) if "ROT NODE" in body else []
        if len(rotations) == 1 and _move_rotations(cards, mesh, rotations[0], body):
            yield f"degrees of freedom 1 to 3 of ROT NODE={body['ROT NODE']} are 4 to 6 of REF NODE={body.get('REF NODE')}"
            del body["ROT NODE"]


def _move_rotations(cards: list[Card], mesh: MeshOfCards, node: int, body: Card) -> bool:
    """Give supports and loads of a node to the rotations of the reference node; false: there are others than 1 to 3."""
    found = [
        (card, i)
        for card in cards
        if card.is_a("BOUNDARY") or card.is_a("CLOAD")
        for i, row in enumerate(card.data)
        if row and mesh.nodes(row[0]) == [node]
    ]
    in_sets = [
        card
        for card in cards
        if card.is_a("BOUNDARY") or card.is_a("CLOAD")
        for row in card.data
        if row and node in mesh.nodes(row[0]) and mesh.nodes(row[0]) != [node]
    ]
    rows = [card.data[i] for card, i in found]
    last_of = [
        row[2] if card.is_a("BOUNDARY") and len(row) > 2 else None for (card, _), row in zip(found, rows, strict=True)
    ]
    degrees = [*(row[1] for row in rows), *(last for last in last_of if last is not None)]
    if in_sets or any(one not in _ROTATIONS for one in degrees):
        return False
    for (card, i), row, last in zip(found, rows, last_of, strict=True):
        card[i, 0], card[i, 1] = body["REF NODE"], _ROTATIONS[int(str(row[1]))]
        if last is not None:
            card[i, 2] = _ROTATIONS[int(str(last))]
    return True
