"""Steps of other programs whose loads are there at once, as steps of litz with an amplitude that is 1."""

from collections.abc import Iterator

from ..deck import Card
from ..deck.keyword_table import squeezed

#: Loads that follow the amplitude of their step where they have none of their own
_LOADS = ("BOUNDARY", "CLOAD", "DLOAD", "CECURRENT", "CFLUX", "DFLUX", "TEMPERATURE")


def steps_at_once(cards: list[Card]) -> Iterator[str]:
    """Give loads of steps with `AMPLITUDE=STEP` an amplitude; what is to be said of each step."""
    found = at_once = False
    taken = {squeezed(str(card["NAME"])) for card in cards if card.is_a("AMPLITUDE") and "NAME" in card}
    name = next(one for one in ("AT_ONCE", *(f"AT_ONCE_{i}" for i in range(len(taken)))) if squeezed(one) not in taken)
    for card in cards:
        if card.is_a("STEP"):
            at_once = str(card.get("AMPLITUDE", "")).upper() == "STEP"
            if at_once:
                del card["AMPLITUDE"]
                found = True
        elif at_once and any(map(card.is_a, _LOADS)) and not any(one in card for one in ("AMPLITUDE", "FIXED")):
            card["AMPLITUDE"] = name
    if found:
        first = next(i for i, card in enumerate(cards) if card.is_a("STEP"))
        cards.insert(first, Card.make("AMPLITUDE", {"NAME": name}, [[0.0, 1.0, 1.0, 1.0]]))
        yield f"AMPLITUDE=STEP of *STEP is *AMPLITUDE, NAME={name} of its loads, which are there from the first increment"
