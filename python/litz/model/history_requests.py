"""Requests of Abaqus for values over time (`*OUTPUT, HISTORY`), as print cards of litz."""

from collections.abc import Iterator

from ..deck import Card

#: Quantities of litz by what they are called in Abaqus, where a name without a number has displacements and rotations
_OF_NODES: dict[str, tuple[str, ...]] = {
    "U": ("U", "UR"),
    "UT": ("U",),
    "UR": ("UR",),
    "RF": ("RF", "RM"),
    "RT": ("RF",),
    "RM": ("RM",),
    "CF": ("CF", "CM"),
    "CM": ("CM",),
}
_OF_ELEMENTS: dict[str, tuple[str, ...]] = {"SF": ("SF",), "SM": ("SF",), "SE": ("SE",), "SK": ("SK",)}
#: Card of litz, its parameter, and quantities, by the card of Abaqus
_REQUESTS: dict[str, tuple[str, str, dict[str, tuple[str, ...]]]] = {
    "NODE OUTPUT": ("NODE PRINT", "NSET", _OF_NODES),
    "ELEMENT OUTPUT": ("EL PRINT", "ELSET", _OF_ELEMENTS),
}


def history_requests_as_prints(cards: list[Card]) -> Iterator[str]:
    """Replace, in the list, requests for sets of nodes and elements; what is to be said of each."""
    in_history = False
    for place, card in enumerate(cards):
        if card.is_a("OUTPUT"):
            in_history = "HISTORY" in card
        request = next((_REQUESTS[name] for name in _REQUESTS if card.is_a(name)), None)
        if request is None or not in_history:
            continue
        keyword, parameter, names = request
        quantities = list(dict.fromkeys(one for row in card.data for value in row for one in _quantities(value, names)))
        if parameter not in card or not quantities:
            continue
        new = Card.make(keyword, {parameter: card[parameter]}, [quantities])
        new.comments, new.line = [*card.comments, *_commented(card)], card.line
        cards[place] = new
        yield f"*{card.name} of {card[parameter]} is *{keyword} with {', '.join(quantities)}"


def _quantities(value: object, names: dict[str, tuple[str, ...]]) -> tuple[str, ...]:
    """What litz has for a name: all of it, or the part that a component is of."""
    name = str(value).upper()
    kind = name.rstrip("0123456789")
    return names.get(kind, ())[: 1 if kind != name else None]


def _commented(card: Card) -> list[str]:
    return [f"** {line}" if not line.startswith("**") else line for line in [*card.head, *card.body] if line.strip()]
