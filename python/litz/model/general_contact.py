"""General contact of all exterior surfaces, as Abaqus/CAE writes it: a contact pair of all wires with each other."""

from ..deck import Card

_SET = "ALL_EXTERIOR"


def general_contact(cards: list[Card]) -> dict[int, list[Card]]:
    """What takes the place of the cards of general contact; empty where there is none, or where it is not that of all with all.

    Parameters
    ----------
    cards : list of Card
        Of a flat deck.

    Returns
    -------
    dict
        By the place of a card those that replace it: none, or the set of all elements and the pair.
    """
    end = next((place for place, card in enumerate(cards) if card.is_a("STEP")), len(cards))
    places = {name: [place for place in range(end) if cards[place].is_a(name)] for name in (
        "CONTACT", "CONTACT INCLUSIONS", "CONTACT EXCLUSIONS", "CONTACT PROPERTY ASSIGNMENT")}  # fmt: skip
    includes, assigns = places["CONTACT INCLUSIONS"], places["CONTACT PROPERTY ASSIGNMENT"]
    if (
        len(includes) != 1
        or len(assigns) != 1
        or places["CONTACT EXCLUSIONS"]
        or "ALL EXTERIOR" not in cards[includes[0]]
    ):
        return {}
    rows = cards[assigns[0]].data
    if len(rows) != 1 or len(rows[0]) != 3 or rows[0][:2] != [None, None]:
        return {}
    elements = [row[0] for card in cards if card.is_a("ELEMENT") for row in card.data if row]
    taken, name = {str(card.get("ELSET", "")).upper() for card in cards}, _SET
    while name in taken:
        name += "_"
    members = [elements[first : first + 16] for first in range(0, len(elements), 16)]
    pair = Card.make("CONTACT PAIR", {"INTERACTION": str(rows[0][2])}, [[name]])
    return {place: [] for place in (*places["CONTACT"], *includes)} | {
        assigns[0]: [Card.make("ELSET", {"ELSET": name}, members), pair]
    }
