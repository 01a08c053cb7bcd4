"""Ends of a cell of a cable: both move alike, as those of one piece of many that follow each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..model import Model
from .beyond_ends import Passage
from .layers import Layer
from .winding import StraightAxis, WoundAxis

#: Largest part of a lay length by which it is changed so that ends fit
_CHANGE = 0.1
#: Distance of ends from those of the next piece, in radii of the wires, that is round-off
_FIT = 1e-3
#: What the stretch of the cell is prescribed at, a node of no element
STRETCH = "STRETCH"


def whole_turns(stages: list[list[Layer]], length: float, alike: Sequence[Sequence[int]]) -> list[list[Layer]]:
    """Layers with lay lengths by which a cable looks at its upper end as at its lower one.

    Parameters
    ----------
    stages : list of lists of Layer
        Layers of each stage, from the first.
    length : float
        Length of the cable [m].
    alike : sequence of sequences of int
        Parts of a turn of each layer after which it looks as before: the number of its members if these are all alike, 1 if not.
    """
    fitted: list[list[Layer]] = []
    axis: StraightAxis | WoundAxis = StraightAxis(length)
    for number in range(len(stages) - 1, -1, -1):
        layers, arc = stages[number], float(axis.arc([length])[0])
        if number > 0 and len(layers) > 1:
            raise ValueError(
                f"periodic ends need stages of one layer of bundles, stage {number + 1} has {len(layers)}: bundles of different "
                "layers are of different lengths, and their wires do not turn alike"
            )
        fitted.insert(
            0, [_fitted(layer, arc, parts, number) for layer, parts in zip(layers, alike[number], strict=True)]
        )
        axis = fitted[0][0].wound(axis)[0]
    return fitted


def _fitted(layer: Layer, arc: float, parts: int, number: int) -> Layer:
    """A layer that turns by a whole number of parts of a turn over an arc."""
    if layer.at == 0:
        return layer
    wanted = parts * arc / abs(layer.lay_length)
    whole = max(1, round(wanted))
    change = wanted / whole - 1
    if abs(change) > _CHANGE:
        shorter, longer = max(1, math.floor(wanted)) / wanted, math.ceil(wanted) / wanted
        over = f" over {parts}" if parts > 1 else ""
        raise ValueError(
            f"stage {number + 1} with its lay of {abs(layer.lay_length):.5g} m turns by {wanted / parts:.4g} turns from end to "
            f"end; periodic ends need a whole number of turns{over}: its lay would be changed by {100 * change:.2g} %, more "
            f"than {100 * _CHANGE:.0f} %. A length of {shorter:.4g} or {longer:.4g} times this one fits"
        )
    return replace(layer, lay_length=math.copysign(arc * parts / whole, layer.lay_length), turns=whole / parts)


def tie_ends(model: Model, length: float) -> list[Passage]:
    """Let each upper end of a wire move and turn as the lower end does that it goes on in, but for a stretch along z.

    Parameters
    ----------
    model : Model
        Wires along z; it gets the node sets MINUS and PLUS of their ends, and STRETCH of a node whose displacement along z is
        the lengthening of the cell. One wire is held at its lower end, so that the cell neither moves nor turns as a whole.
    length : float
        Length of the cable [m].

    Returns
    -------
    list of Passage
        As which wire each one goes on.
    """
    wires = [(name, group.radius, wire) for name, group in model.groups.items() for wire in group.wires]
    lower = np.array([model.x[wire.nodes[0] - 1] for _, _, wire in wires])
    upper = np.array([model.x[wire.nodes[-1] - 1] for _, _, wire in wires]) - (0, 0, length)
    nearest = np.linalg.norm(upper[:, None] - lower[None], axis=2)
    goes_on = nearest.argmin(axis=1)
    for k, (name, radius, _) in enumerate(wires):
        away = float(nearest[k, goes_on[k]])
        if away > _FIT * radius or wires[goes_on[k]][0] != name:
            raise ValueError(
                f"wire {k + 1} ends {away / radius:.2g} radii beside where one of {name} begins: its bundles differ too much in "
                "length for periodic ends; choose another length or other lays"
            )
    model.node_set("MINUS", [wire.nodes[0] for _, _, wire in wires])
    model.node_set("PLUS", [wire.nodes[-1] for _, _, wire in wires])
    stretch = model.nodes([(0.0, 0.0, length)])
    model.node_set(STRETCH, stretch)
    for (_, _, wire), next_one in zip(wires, goes_on.tolist(), strict=True):
        end, start = wire.nodes[-1], wires[next_one][2].nodes[0]
        for direction in ("x", "y", "rx", "ry", "rz"):
            model.equation((end, direction, 1.0), (start, direction, -1.0))
        model.equation((end, "z", 1.0), (start, "z", -1.0), (STRETCH, "z", -1.0))
    held = wires[0][2].nodes[0]
    model.fix(held, "x", "y", "rz")
    model.fix(held, "z")
    model.guides[STRETCH] = 1.0
    return [
        Passage(model.groups[name], wire, wires[next_one][2])
        for (name, _, wire), next_one in zip(wires, goes_on.tolist(), strict=True)
    ]


def leave_to_jacket(model: Model) -> None:
    """Hold a cell with periodic ends along its axis only: a jacket holds it across."""
    if STRETCH not in model.node_sets:
        return
    held = next(iter(model.groups.values())).wires[0].nodes[0]
    model.supports = [one for one in model.supports if one.target != held]
    model.fix(held, "z")
