"""Multi-point constraints (`*MPC`) of Abaqus that join nodes: rigid bodies, or equations where nodes lie apart."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..deck import Card
from ..deck.lines import Value
from .kinematic_couplings import free_name
from .mesh_of_cards import MeshOfCards

_JOINTS = ("BEAM", "TIE", "PIN")
#: Nodes whose distance is less than this part of the size of the model are in one place
_ONE_PLACE = 1e-9
_NODES_ON_A_LINE = 16
_REASONS = {
    "LINK": "a rod that keeps its length: write a thin beam between the nodes",
    "": "only BEAM, TIE and PIN join nodes as rigid bodies and equations can",
}


@dataclass(eq=False)
class _Joint:
    """Two nodes that are joined, the first of which depends on the second."""

    kind: str
    first: int
    second: int
    row: list[Value]


@dataclass(eq=False)
class _Body:
    """Nodes that move with a reference node."""

    reference: int
    tied: set[int] = field(default_factory=set)
    pinned: set[int] = field(default_factory=set)


def constraints_as_rigid_bodies(cards: list[Card], dialect: str | None, path: Path) -> Iterator[tuple[str, bool]]:
    """Replace, in the list, `*MPC` cards by what litz has; what is to be said, and whether results change.

    BEAM joins two nodes rigidly, TIE and PIN give them the same displacements, TIE the same rotations, too: nodes in one place
    are those of a rigid body, and equations do that where they lie apart. What is left of a card becomes a comment with all else
    that litz does not have.
    """
    mesh = MeshOfCards(cards)
    joints: list[_Joint] = []
    places = [place for place, card in enumerate(cards) if card.is_a("MPC")]
    for place in places:
        kept = []
        for row in cards[place].data:
            kind = str(row[0]).upper()
            pairs = _pairs(mesh, row[1:]) if kind in _JOINTS else []
            reason = _reason(kind, pairs, dialect, path)
            if reason:
                kept.append(row)
                yield f"*MPC, {', '.join(str(value) for value in row)}: {reason}", True
            joints += [_Joint(kind, *pair, row) for pair in pairs if not reason]
        cards[place].data = kept
    if not joints:
        return
    is_apart = [joint.kind != "BEAM" and not _in_one_place(mesh, joint) for joint in joints]
    apart, together = (
        [joint for joint, one in zip(joints, is_apart, strict=True) if one is way] for way in (True, False)
    )
    bodies, refused = _bodies(together)
    left = _unlike(joint.row for joint in refused)
    for row in left:
        yield f"*MPC, {', '.join(str(value) for value in row)}: a pin between two rigid bodies", True
    cards[places[-1]].data = [*cards[places[-1]].data, *left]
    for how, those in (("a *RIGID BODY", together), ("an *EQUATION", apart)):
        for row in _unlike(joint.row for joint in those):
            if not any(row is one for one in left):
                yield f"*MPC, {', '.join(str(value) for value in row)} is {how}; potentials are not joined", False
    new = [card for body in bodies for card in _body_cards(mesh, cards, body, joints)] + _equations(apart)
    if new:
        new[0].comments, cards[places[0]].comments = cards[places[0]].comments, []
        cards[places[0] : places[0]] = new
    cards[:] = [card for card in cards if not (card.is_a("MPC") and not card.data)]


def _pairs(mesh: MeshOfCards, values: list[Value]) -> list[tuple[int, int]]:
    """Nodes that a line joins: one to one, or all of a set with one; empty: it has others."""
    values = [value for value in values if value is not None]
    if len(values) != 2:
        return []
    first, second = (mesh.nodes(value) for value in values)
    if len(second) == 1:
        second = second * len(first)
    return list(zip(first, second, strict=True)) if len(first) == len(second) else []


def _reason(kind: str, pairs: list[tuple[int, int]], dialect: str | None, path: Path) -> str:
    """Why a line cannot be taken; empty: it can."""
    if kind not in _JOINTS:
        return _REASONS.get(kind, _REASONS[""])
    if kind == "BEAM" and dialect is None:
        raise ValueError(
            f"{path}: BEAM of *MPC joins two nodes rigidly in Abaqus, but keeps their distance alone in CalculiX: which of them"
            " is meant must be told by --dialect abaqus or --dialect ccx (in Python dialect='abaqus' or dialect='ccx')"
        )
    if kind == "BEAM" and dialect == "ccx":
        return _REASONS["LINK"]
    return "" if pairs else "it names two nodes, two sets with as many nodes each, or a set and a node"


def _in_one_place(mesh: MeshOfCards, joint: _Joint) -> bool:
    size = np.ptp(np.array(list(mesh.places.values())), axis=0).max()
    return float(np.linalg.norm(mesh.places[joint.first] - mesh.places[joint.second])) <= _ONE_PLACE * size


def _unlike(rows: Iterable[list[Value]]) -> list[list[Value]]:
    """Each row once."""
    return list({id(row): row for row in rows}.values())


def _groups(joints: list[_Joint]) -> list[list[int]]:
    """Nodes that joints connect; first those on which others depend only."""
    group_of: dict[int, list[int]] = {}
    for joint in joints:
        one, other = (group_of.setdefault(node, [node]) for node in (joint.second, joint.first))
        if one is not other:
            one += other
            group_of.update(dict.fromkeys(other, one))
    dependent = {joint.first for joint in joints}
    groups = {id(group): group for group in group_of.values()}
    return [sorted(group, key=lambda node: node in dependent) for group in groups.values()]


def _bodies(joints: list[_Joint]) -> tuple[list[_Body], list[_Joint]]:
    """The rigid bodies, and the pins that none of them can have."""
    bodies = [_Body(first, set(others)) for first, *others in _groups([one for one in joints if one.kind != "PIN"])]
    body_of = {node: body for body in bodies for node in (body.reference, *body.tied)}
    pins = [one for one in joints if one.kind == "PIN"]
    refused = []
    for group in _groups(pins):
        of_bodies = {id(body_of[node]): body_of[node] for node in group if node in body_of}
        if len(of_bodies) > 1:
            nodes = set(group)
            refused += [one for one in pins if one.first in nodes]
            continue
        free = [node for node in group if node not in body_of]
        if of_bodies:
            (body,) = of_bodies.values()
        else:
            body = _Body(free.pop(0))
            bodies.append(body)
        body.pinned |= set(free)
    return bodies, refused


def _body_cards(mesh: MeshOfCards, cards: list[Card], body: _Body, joints: list[_Joint]) -> Iterator[Card]:
    """A rigid body with its node sets: those of the deck where they have these nodes."""
    taken = {str(card["NSET"]).upper() for card in cards if "NSET" in card}
    as_sets = (
        one.row[2] for one in joints if one.second == body.reference and mesh.nodes(one.row[2]) == [body.reference]
    )
    parameters: dict[str, Value] = {"REF NODE": next(as_sets, body.reference)}
    for parameter, nodes in (("TIE NSET", body.tied), ("PIN NSET", body.pinned)):
        if not nodes:
            continue
        names = (joint.row[1] for joint in joints if isinstance(joint.row[1], str) and joint.first in nodes)
        name = next((str(one) for one in names if set(mesh.nodes(one)) == nodes), "")
        if not name:
            name = free_name(f"{parameter[:3]}_{body.reference}", taken)
            members = sorted(nodes)
            rows = [members[i : i + _NODES_ON_A_LINE] for i in range(0, len(members), _NODES_ON_A_LINE)]
            yield Card.make("NSET", {"NSET": name}, rows)
        parameters[parameter] = name
    yield Card.make("RIGID BODY", parameters)


def _equations(joints: list[_Joint]) -> list[Card]:
    """Equal displacements, and rotations where nodes are tied."""
    rows: list[list[Value]] = []
    for joint in joints:
        for dof in range(1, 7 if joint.kind == "TIE" else 4):
            rows += [[2], [joint.first, dof, 1.0, joint.second, dof, -1.0]]
    return [Card.make("EQUATION", {}, rows)] if rows else []
