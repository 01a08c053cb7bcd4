"""Kinematic couplings of a reference node with a surface, as Abaqus/CAE writes them: rigid bodies of its nodes."""

from collections.abc import Iterator

from ..deck import Card
from ..deck.lines import Value

_MOTIONS, _ROTATIONS = {1, 2, 3}, {4, 5, 6}


def couplings_as_rigid_bodies(cards: list[Card]) -> Iterator[str]:
    """Replace, in the list, the couplings that are rigid bodies, and surfaces of nodes that only they name; what is to be said.

    All six degrees of freedom are those of nodes that are tied, 1 to 3 those of nodes that are pinned. What couples others, or
    those of axes of its own, is left as it is.
    """
    yield from _couplings_of_nodes(cards)
    surfaces = {str(card.get("NAME", "")).upper(): card for card in cards if card.is_a("SURFACE")}
    of_nodes: dict[str, str] = {}
    for place in range(len(cards) - 1, 0, -1):
        coupling, kinematic = cards[place - 1 : place + 1]
        surface = surfaces.get(str(coupling.get("SURFACE", "")).upper())
        if not (coupling.is_a("COUPLING") and kinematic.is_a("KINEMATIC")) or surface is None:
            continue
        parameter, members = _kind_of_nodes(coupling, kinematic), _members(surface)
        if not parameter or not members:
            continue
        name = str(surface["NAME"])
        taken = {str(card["NSET"]).upper() for card in cards if "NSET" in card}
        nodes = of_nodes.get(name.upper()) or free_name(name, taken)
        body = Card.make("RIGID BODY", {"REF NODE": coupling["REF NODE"], parameter: nodes})
        body.comments, body.line = coupling.comments, coupling.line
        sets = [] if name.upper() in of_nodes else list(_node_sets(surface, nodes, members))
        of_nodes[name.upper()] = nodes
        cards[place - 1 : place + 1] = [*sets, body]
        yield f"*COUPLING of {coupling['REF NODE']} and {name} is a *RIGID BODY, {parameter}={nodes}"
    remove_spare_surfaces(cards, set(of_nodes))


def remove_spare_surfaces(cards: list[Card], names: set[str]) -> None:
    """Remove, from the list, surfaces of nodes that couplings named, unless others name them still."""
    named = {str(value).upper() for card in cards if card.is_a("CONTACT PAIR") for row in card.data for value in row}
    named |= {str(card["SURFACE"]).upper() for card in cards if "SURFACE" in card}
    cards[:] = [card for card in cards if not _is_spare(card, names - named)]


def influences_all(coupling: Card) -> bool:
    """Whether a coupling has all nodes of its surface."""
    return str(coupling.get("INFLUENCE RADIUS", "WHOLE SURFACE")).upper() == "WHOLE SURFACE"


def _kind_of_nodes(coupling: Card, kinematic: Card) -> str:
    """The parameter of `*RIGID BODY` that has the nodes; empty: these are no nodes of a rigid body."""
    if not influences_all(coupling) or "REF NODE" not in coupling:
        return ""
    return _kind(kinematic.data, "ORIENTATION" in coupling)


def _kind(rows: list[list[Value]], has_axes: bool) -> str:
    """The parameter of `*RIGID BODY` for nodes whose degrees of freedom are coupled from the first to the last on each line."""
    coupled: set[int] = set()
    for first, *rest in rows:
        last = first if not rest or rest[0] is None else rest[0]
        coupled |= set(range(int(first or 0), int(last or 0) + 1))
    if not coupled or coupled == _MOTIONS | _ROTATIONS:
        return "TIE NSET"
    return "PIN NSET" if coupled == _MOTIONS and not has_axes else ""


def _couplings_of_nodes(cards: list[Card]) -> Iterator[str]:
    """Replace, in the list, each `*KINEMATIC COUPLING` of nodes that are all tied, or all pinned."""
    for place in range(len(cards) - 1, -1, -1):
        card = cards[place]
        if not card.is_a("KINEMATIC COUPLING") or "REF NODE" not in card:
            continue
        kinds = {_kind([row[1:]] if len(row) > 1 else [], "ORIENTATION" in card) for row in card.data if row}
        if len(kinds) != 1 or not (parameter := kinds.pop()):
            continue
        name = free_name(
            f"{parameter[:3]}_{card['REF NODE']}", {str(one["NSET"]).upper() for one in cards if "NSET" in one}
        )
        nodes = Card.make("NSET", {"NSET": name}, [[row[0]] for row in card.data if row])
        nodes.comments = card.comments
        cards[place : place + 1] = [nodes, Card.make("RIGID BODY", {"REF NODE": card["REF NODE"], parameter: name})]
        yield f"*KINEMATIC COUPLING of {card['REF NODE']} is a *RIGID BODY, {parameter}={name}"


def _members(surface: Card) -> list[Value]:
    """Sets of nodes, or of elements without a side, that a surface has; empty: it has others."""
    is_of_nodes = str(surface.get("TYPE", "ELEMENT")).upper() == "NODE"
    rows = [row for row in surface.data if row]
    has_sides = not is_of_nodes and any(len(row) > 1 and row[1] is not None for row in rows)
    return [] if has_sides or any(not isinstance(row[0], str) for row in rows) else [row[0] for row in rows]


def _node_sets(surface: Card, name: str, members: list[Value]) -> Iterator[Card]:
    """The cards of a set of the nodes of a surface."""
    if str(surface.get("TYPE", "ELEMENT")).upper() == "NODE":
        yield Card.make("NSET", {"NSET": name}, [members])
        return
    for elements in members:
        yield Card.make("NSET", {"NSET": name, "ELSET": elements})


def free_name(name: str, taken: set[str]) -> str:
    """A name that no set has, given the names in capitals."""
    while name.upper() in taken:
        name += "_NODES"
    return name


def _is_spare(card: Card, names: set[str]) -> bool:
    """A surface of nodes that was named by couplings alone."""
    is_of_nodes = card.is_a("SURFACE") and str(card.get("TYPE", "")).upper() == "NODE"
    return is_of_nodes and str(card.get("NAME", "")).upper() in names
