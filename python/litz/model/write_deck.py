"""A model as the text of a deck."""

from collections.abc import Iterable, Iterator
from itertools import chain

from ..deck.lines import card_lines, data_line, number
from .loaded_model import LoadedModel
from .loading import Prescribed, degree_of_freedom, grouped
from .wires import WireGroup

#: Members of a set on one line
_MEMBERS_PER_LINE = 12


def deck_text(model: LoadedModel, mesh_file: str | None = None) -> str:
    """The deck of a model; with a mesh file, that stands for nodes, elements and sets."""
    if not model.groups:
        raise ValueError("the model has no wires: add one with model.wire()")
    lines = ["*HEADING", model.title, "**"]
    if model.comments:
        lines += [*(f"** {comment}".rstrip() for comment in model.comments), "**"]
    if model.units:
        lines += card_lines("UNITS", model.units)
    lines += _mesh(model) if mesh_file is None else card_lines("MESH", {"INPUT": mesh_file})
    lines.append("**")
    for material in model.materials:
        lines += _cards(material.cards())
    for group in model.groups.values():
        lines += _cards(group.section.cards(group.name, group.material.name))
    lines.append("**")
    for amplitude in model.amplitudes.values():
        lines += _cards(amplitude.cards())
    for surface in model.surfaces.values():
        lines += _cards(surface.cards())
    for interaction in model.interactions:
        lines += _cards(interaction.cards())
    for pair in model.contacts:
        lines += _cards(pair.cards())
    lines += _cards(model.cards)
    lines.append("**")
    lines += _cards(grouped("BOUNDARY", [*model.supports, *_ground(model)]))
    for step in model.steps:
        lines += _cards(step.all_cards())
    return "\n".join(lines) + "\n"


def _ground(model: LoadedModel) -> Iterator[Prescribed]:
    """The electrode at 0 V of conductors for which nothing else is prescribed: one that asks for no current has none."""
    potential = degree_of_freedom("potential")
    held = chain(model.supports, *(step.prescribed for step in model.steps))
    loads = chain.from_iterable(step.loads for step in model.steps)
    written = chain(model.cards, *(step.cards for step in model.steps))
    if (
        model.ground is not None
        and any(group.material.conductivity is not None for group in model.groups.values())
        and not any(one.first <= potential <= one.last for one in held)
        and not any(one.dof == potential for one in loads)
        and not any(name in ("BOUNDARY", "CECURRENT") for name, _, _ in written)
    ):
        yield Prescribed(model.ground, potential, potential)


def _cards(cards: Iterable) -> Iterator[str]:
    for card in cards:
        yield from card_lines(*card)


def _mesh(model: LoadedModel) -> Iterator[str]:
    positions = model.x
    for block in model.blocks:
        if isinstance(block, WireGroup):
            yield from card_lines("ELEMENT", {"TYPE": block.element, "ELSET": block.name})
            for element, (first, second) in zip(block.elements, block.connectivity.tolist(), strict=True):
                yield f" {element}, {first}, {second}"
        else:
            name, first, last = block
            yield from card_lines("NODE", {"NSET": name})
            for node, place in enumerate(positions[first - 1 : last].tolist(), start=first):
                yield f" {node}, " + ", ".join(map(number, place))
    for name, members in model.element_sets.items():
        yield from card_lines("ELSET", {"ELSET": name})
        yield from _members(members)
    for name, nodes in model.node_sets.items():
        yield from card_lines("NSET", {"NSET": name})
        yield from _members(nodes)


def _members(members: list) -> Iterator[str]:
    for start in range(0, len(members), _MEMBERS_PER_LINE):
        yield data_line(members[start : start + _MEMBERS_PER_LINE])
