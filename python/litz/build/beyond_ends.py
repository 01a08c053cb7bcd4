"""Wires of a cell that go on beyond its ends, so that no contact is one of the end of a wire."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..model import Circular, Interaction, Linear, Material, Model, WireGroup
from ..model.wires import Wire
from ..wires import BEYOND

#: Elements of each wire beyond each end at least, and their length at least over the radius: contacts in the plane of an end,
#: and what they press in beside them, are not those of the end of a wire
_ELEMENTS, _REACH = 2, 2.5
#: Their stiffness, and that of contacts which others stand for, over those of the wires
SLENDER, _FAINT = 1e-5, 1e-6
#: Their mass over that of the wires
_WEIGHTLESS = 1e-9


@dataclass(frozen=True)
class Passage:
    """A wire of a group, and the one of the same group as which it goes on at the lower end of the cell."""

    group: WireGroup
    wire: Wire
    following: Wire


def own_groups(model: Model) -> list[WireGroup]:
    """The groups of a model without what goes on beyond the ends of a cell."""
    return [group for group in model.groups.values() if not group.name.startswith(BEYOND)]


def go_on_beyond(
    model: Model,
    passages: Sequence[Passage],
    stretch: str,
    interaction: Interaction,
    bundles: int,
    wrapped: Interaction | None,
) -> None:
    """Let wires go on a little beyond both ends of a cell, as images of those that they go on as, and touch there.

    A contact across an end is there twice, across the upper and across the lower end, one beyond an end a second time within
    the cell. Those across the upper end have the laws of the cell, the others next to no force. So forces are those of wires
    without ends, wherever along the cell a contact is, and pass from one end to the other without a jump.

    An image moves as what it is an image of, and conducts as a part of the wire that it goes on from: what flows across the
    upper end enters the wires of the cell at their ends.

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
    bundles : int
        Number of bundles, element sets BUNDLE1, BUNDLE2, ...
    wrapped : Interaction, optional
        The laws between the bundles, if they have others.
    """
    own = own_groups(model)
    beyond: dict[str, list[str]] = {name: [] for name in BEYOND}
    of_wires: dict[int, list[int]] = {}
    for group in own:
        section = Circular(group.radius, stiffness=SLENDER)
        metal = _image_of(group.material)
        for name, sense in zip(BEYOND, (1, -1), strict=True):
            mine = [one for one in passages if one.group is group]
            chains = [_images(model, one, stretch, sense) for one in mine]
            beyond[name].append(f"{name}_{group.name}")
            images = model.elements(
                beyond[name][-1], np.concatenate(chains), section=section, material=metal, element=group.element
            )
            if sense > 0:
                parts = np.split(np.array(images.elements), len(mine))
                of_wires |= {one.wire.elements[0]: part.tolist() for one, part in zip(mine, parts, strict=True)}
    for name, groups in beyond.items():
        model.element_set(name, groups)
    upper, lower = BEYOND
    softest = min(group.material.young for group in own)
    thinnest = min(group.radius for group in own)
    faint = Interaction("BEYOND", Linear(_FAINT * softest * thinnest, line_penalty=_FAINT * softest))
    model.contact("WIRES", upper, interaction=interaction)
    if wrapped is not None:
        _wrap_beyond(model, of_wires, bundles, wrapped)
    model.contact(upper, interaction=faint)
    model.contact(lower, ["WIRES", upper, lower], interaction=faint)


def _image_of(material: Material) -> Material:
    """A material that touches and conducts as another one does, and weighs and stores nothing."""
    weight = None if material.density is None else material.density * _WEIGHTLESS
    return replace(material, name=f"BEYOND_{material.name}", density=weight)


def _wrap_beyond(model: Model, of_wires: dict[int, list[int]], bundles: int, wrapped: Interaction) -> None:
    """Let bundles touch what the others have beyond the upper end by the laws between them.

    Parameters
    ----------
    model, bundles, wrapped
        As those of `go_on_beyond`.
    of_wires : dict of list of int
        Elements beyond the upper end, by the first element of the wire that they belong to.
    """
    names = []
    for number in range(1, bundles + 1):
        members = set(model.element_sets[f"BUNDLE{number}"])
        images = [image for first, some in of_wires.items() if first in members for image in some]
        names.append(model.element_set(f"{BEYOND[0]}_BUNDLE{number}", images))
    for number in range(bundles):
        model.contact(f"BUNDLE{number + 1}", names[:number] + names[number + 1 :], interaction=wrapped)


def _images(model: Model, passage: Passage, stretch: str, sense: int) -> NDArray[np.int64]:
    """Nodes beyond an end of a wire that move as those that they are images of; pairs of nodes of their elements (n, 2)."""
    end, start = passage.wire.nodes[-1], passage.following.nodes[0]
    if sense > 0:
        joint, tied, along = end, start, list(passage.following.nodes[1:])
    else:
        joint, tied, along = start, end, list(passage.wire.nodes[-2::-1])
    points = model.x[[node - 1 for node in (tied, *along)]]
    ways = np.linalg.norm(np.diff(points, axis=0), axis=1).cumsum()
    reaching = int(np.searchsorted(ways, _REACH * passage.group.radius)) + 1
    imaged = along[: max(_ELEMENTS, reaching)]
    numbers = [joint, *model.nodes(model.x[[node - 1 for node in imaged]] + model.x[joint - 1] - model.x[tied - 1])]
    model.images |= dict(zip(numbers[1:], imaged, strict=True))
    for number, node in zip(numbers[1:], imaged, strict=True):
        for direction in ("x", "y", "rx", "ry", "rz"):
            model.equation((number, direction, 1.0), (node, direction, -1.0))
        model.equation((number, "z", 1.0), (node, "z", -1.0), (stretch, "z", -float(sense)))
    return np.array([numbers[:-1], numbers[1:]])[::sense].T
