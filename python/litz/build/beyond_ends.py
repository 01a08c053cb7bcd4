"""Wires of a cell that go on beyond its ends, so that no contact is one of the end of a wire."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..model import General, Interaction, Linear, Material, Model, WireGroup
from ..model.wires import Wire
from ..wires import BEYOND

#: Elements of each wire beyond each end
_ELEMENTS = 2
#: Their stiffness, and that of contacts which others stand for, over those of the wires
SLENDER, _FAINT = 1e-5, 1e-6


@dataclass(frozen=True)
class Passage:
    """A wire of a group, and the one of the same group as which it goes on at the lower end of the cell."""

    group: WireGroup
    wire: Wire
    following: Wire


def own_groups(model: Model) -> list[WireGroup]:
    """The groups of a model without what goes on beyond the ends of a cell."""
    return [group for group in model.groups.values() if not group.name.startswith(BEYOND)]


def go_on_beyond(model: Model, passages: Sequence[Passage], stretch: str, interaction: Interaction) -> None:
    """Let wires go on a little beyond both ends of a cell, as images of those that they go on as, and touch there.

    A contact across an end is there twice, across the upper and across the lower end, one beyond an end a second time within
    the cell. Those across the upper end have the laws of the cell, the others next to no force. So forces are those of wires
    without ends, wherever along the cell a contact is, and pass from one end to the other without a jump.

    Parameters
    ----------
    model : Model
        A cell whose ends are tied, with the wires WIRES.
    passages : sequence of Passage
        Of all wires.
    stretch : str
        The node set whose displacement along z is the lengthening of the cell.
    interaction : Interaction
        The laws of the contacts.
    """
    beyond: dict[str, list[str]] = {name: [] for name in BEYOND}
    for group in own_groups(model):
        area, inertia = math.pi * group.radius**2 * SLENDER, math.pi * group.radius**4 / 4 * SLENDER
        section = General(area, inertia, inertia, 2 * inertia, contact_radius=group.radius)
        own = group.material
        metal = Material(f"BEYOND_{own.name}", own.young, own.poisson, expansion=own.expansion)
        for name, sense in zip(BEYOND, (1, -1), strict=True):
            chains = [_images(model, one, stretch, sense) for one in passages if one.group is group]
            beyond[name].append(f"{name}_{group.name}")
            pairs = np.concatenate(chains)
            model.elements(beyond[name][-1], pairs, section=section, material=metal, element=group.element)
    for name, groups in beyond.items():
        model.element_set(name, groups)
    upper, lower = BEYOND
    softest = min(group.material.young for group in own_groups(model))
    thinnest = min(group.radius for group in own_groups(model))
    faint = Interaction("BEYOND", Linear(_FAINT * softest * thinnest, line_penalty=_FAINT * softest))
    model.contact("WIRES", upper, interaction=interaction)
    model.contact(upper, interaction=faint)
    model.contact(lower, ["WIRES", upper, lower], interaction=faint)


def _images(model: Model, passage: Passage, stretch: str, sense: int) -> NDArray[np.int64]:
    """Nodes beyond an end of a wire that move as those that they are images of; pairs of nodes of their elements (n, 2)."""
    end, start = passage.wire.nodes[-1], passage.following.nodes[0]
    if sense > 0:
        joint, tied, imaged = end, start, list(passage.following.nodes[1 : _ELEMENTS + 1])
    else:
        joint, tied, imaged = start, end, list(passage.wire.nodes[-2 : -_ELEMENTS - 2 : -1])
    numbers = [joint, *model.nodes(model.x[[node - 1 for node in imaged]] + model.x[joint - 1] - model.x[tied - 1])]
    for number, node in zip(numbers[1:], imaged, strict=True):
        for direction in ("x", "y", "rx", "ry", "rz"):
            model.equation((number, direction, 1.0), (node, direction, -1.0))
        model.equation((number, "z", 1.0), (node, "z", -1.0), (stretch, "z", -float(sense)))
    return np.array([numbers[:-1], numbers[1:]])[::sense].T
