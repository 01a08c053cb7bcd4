"""Distributing couplings, as Abaqus/CAE writes them: equations, where the reference node stays in the middle of its nodes."""

from collections.abc import Iterator

import numpy as np

from ..deck import Card
from ..deck.lines import Value
from .kinematic_couplings import influences_all, remove_spare_surfaces
from .mesh_of_cards import MeshOfCards

_SUPPORTS = {"PINNED": {1, 2, 3}, "ENCASTRE": {1, 2, 3, 4, 5, 6}}
#: Part of the size of a model by which a reference node may be beside the middle
_IN_THE_MIDDLE = 1e-6
#: Values on a line of `*EQUATION`: four terms
_ON_A_LINE = 12


def distributing_couplings_as_equations(cards: list[Card]) -> Iterator[tuple[str, bool]]:
    """Replace, in the list, the couplings that are equations; what is to be said, and whether results change.

    A distributing coupling spreads what acts on its reference node over other nodes by their weights. If the node is in the
    middle of nodes of equal weights, and nothing acts on its rotations, its displacement is the mean of theirs, and remains so
    under large rotations.
    """
    mesh = MeshOfCards(cards)
    moved = _moved_by_conditions(mesh, cards)
    surfaces = {str(card.get("NAME", "")).upper(): card for card in cards if card.is_a("SURFACE")}
    done = set()
    for place in range(len(cards) - 1, 0, -1):
        coupling, distributing = cards[place - 1 : place + 1]
        if not (coupling.is_a("COUPLING") and distributing.is_a("DISTRIBUTING")):
            continue
        surface = surfaces.get(str(coupling.get("SURFACE", "")).upper())
        what = f"*COUPLING of {coupling.get('REF NODE')} and {coupling.get('SURFACE')}"
        nodes = [] if surface is None else [node for row in surface.data for node in mesh.nodes(row[0])]
        reference = mesh.nodes(coupling.get("REF NODE"))
        reason = _reason_of_spread(coupling, distributing, surface, nodes) or _reason_of_motion(
            mesh, moved, reference, nodes
        )
        axes = {node for card in cards if card.is_a("TRANSFORM") for node in mesh.nodes(card.get("NSET"))}
        if axes & {*nodes, *reference}:
            reason = reason or "nodes with axes of their own (*TRANSFORM)"
        if reason:
            yield f"{what}: {reason}", True
            continue
        # the first one is eliminated, which must not be prescribed
        first = next(node for node in nodes if not moved.get(node))
        order = [first, *(node for node in nodes if node != first)]
        rows: list[list[Value]] = []
        for dof in (1, 2, 3):
            terms: list[Value] = [value for node in order for value in (node, dof, 1)]
            terms += [reference[0], dof, -len(order)]
            rows.append([len(order) + 1])
            rows += [terms[i : i + _ON_A_LINE] for i in range(0, len(terms), _ON_A_LINE)]
        new = Card.make("EQUATION", {}, rows)
        new.comments, new.line = coupling.comments, coupling.line
        cards[place - 1 : place + 1] = [new]
        done.add(str(coupling["SURFACE"]).upper())
        yield f"{what} is an *EQUATION: its displacement is the mean of theirs", False
    remove_spare_surfaces(cards, done)


def _reason_of_spread(coupling: Card, distributing: Card, surface: Card | None, nodes: list[int]) -> str:
    """Why the nodes of a coupling have no equal parts; empty: they have."""
    is_of_nodes = surface is not None and str(surface.get("TYPE", "")).upper() == "NODE"
    areas = {row[1] if len(row) > 1 else None for row in surface.data if row} if surface is not None else set()
    if not is_of_nodes or len(areas) > 1 or len(set(nodes)) != len(nodes):
        return "forces spread by areas: only nodes of equal weights (a surface of TYPE=NODE) are an *EQUATION"
    weights = str(distributing.get("WEIGHTING METHOD", "UNIFORM")).upper()
    is_usual = weights == "UNIFORM" and str(distributing.get("COUPLING", "CONTINUUM")).upper() == "CONTINUUM"
    if not influences_all(coupling) or not is_usual or "ORIENTATION" in coupling:
        return "weights by distance, rotations, a radius or axes of its own are not in an *EQUATION"
    return ""


def _reason_of_motion(mesh: MeshOfCards, moved: dict[int, set[int]], reference: list[int], nodes: list[int]) -> str:
    """Why the reference node does not move with the mean of the nodes; empty: it does."""
    if len(reference) != 1 or not nodes or any(node in mesh.nodes_of_elements for node in reference):
        return "it needs nodes, and a reference node that belongs to no element"
    size = np.ptp(np.array([*mesh.places.values()]), axis=0).max()
    middle = np.mean([mesh.places[node] for node in nodes], axis=0)
    if np.linalg.norm(mesh.places[reference[0]] - middle) > _IN_THE_MIDDLE * size:
        return "its reference node is beside the middle of its nodes, which turn it: a *RIGID BODY holds their distances, too"
    if moved.get(reference[0], set()) & {4, 5, 6}:
        return "a moment or a support of rotations at its reference node: a *RIGID BODY holds the distances of its nodes, too"
    return "" if any(not moved.get(node) for node in nodes) else "all its nodes are held"


def _moved_by_conditions(mesh: MeshOfCards, cards: list[Card]) -> dict[int, set[int]]:
    """Degrees of freedom of nodes that are prescribed, or loaded by a moment."""
    found: dict[int, set[int]] = {}
    for card in cards:
        is_load = card.is_a("CLOAD")
        for row in card.data if is_load or card.is_a("BOUNDARY") else ():
            degrees = {int(str(row[1]))} - {1, 2, 3} if is_load else _held(row)
            for node in mesh.nodes(row[0]):
                found.setdefault(node, set()).update(degrees)
    return found


def _held(row: list[Value]) -> set[int]:
    """Degrees of freedom on a line of a support."""
    first, last = [*row, None, None][1:3]
    if isinstance(first, str):
        # those of symmetry hold rotations
        return _SUPPORTS.get(first.upper(), {1, 2, 3, 4, 5, 6})
    first = int(first or 1)
    return set(range(first, (last if isinstance(last, int) else first) + 1))
