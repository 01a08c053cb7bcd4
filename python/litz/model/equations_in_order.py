"""Equations of sets whose members are in the order of the deck (`UNSORTED`), as equations of their nodes one by one."""

from collections.abc import Iterator

from ..deck import Card
from ..deck.keyword_table import squeezed
from .mesh_of_cards import MeshOfCards

#: Terms on a line, and values of each
_TERMS, _VALUES = 4, 3


def equations_in_order(cards: list[Card]) -> Iterator[str]:
    """Write equations of `UNSORTED` sets node by node, as litz takes members by their numbers; what is to be said of each card.

    Source: Abaqus, linear constraint equations: the members of sets are paired in the order of `UNSORTED` sets.
    """
    unsorted = {squeezed(str(card["NSET"])) for card in cards if card.is_a("NSET") and "UNSORTED" in card}
    if not unsorted:
        return
    mesh = MeshOfCards(cards)
    for card in cards:
        names = {squeezed(str(value)) for row in card.data for value in row} if card.is_a("EQUATION") else set()
        if not names & unsorted:
            continue
        equations = _equations(card)
        if equations is None:
            continue
        written = [_by_nodes(terms, mesh) for terms in equations]
        if any(one is None for one in written):
            continue
        rows: list[list] = []
        for terms in (terms for one in written for terms in one or ()):
            rows.append([len(terms)])
            rows += [[value for term in terms[i : i + _TERMS] for value in term] for i in range(0, len(terms), _TERMS)]
        card.data = rows
        yield f"*EQUATION of {', '.join(sorted(names & unsorted))} is one of each pair of nodes, in the order of UNSORTED sets"


def _equations(card: Card) -> list[list[list]] | None:
    """Terms (node or set, degree of freedom, factor) of each equation; None: the card has something else."""
    values = iter([list(row) for row in card.data if row])
    equations = []
    for head in values:
        if not isinstance(head[0], int) or len([one for one in head if one is not None]) != 1:
            return None
        flat: list = []
        while len(flat) < _VALUES * head[0]:
            row = next(values, None)
            if row is None:
                return None
            while row and row[-1] is None:
                row.pop()
            flat += row
        if len(flat) != _VALUES * head[0]:
            return None
        equations.append([flat[i : i + _VALUES] for i in range(0, len(flat), _VALUES)])
    return equations


def _by_nodes(terms: list[list], mesh: MeshOfCards) -> list[list[list]] | None:
    """One equation for each place of the sets; None: they have unlike numbers of nodes, or none."""
    nodes = [mesh.nodes(term[0]) for term in terms]
    count = max(map(len, nodes), default=0)
    if not all(len(one) in (1, count) for one in nodes):
        return None
    return [
        [[one[min(i, len(one) - 1)], *term[1:]] for one, term in zip(nodes, terms, strict=True)] for i in range(count)
    ]
