"""Helical strands and cables of several stages."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..model import COPPER, HERTZ_AND_HOLM, Interaction, Material, Model
from .geometry import rounded, smallest_gap

#: Straight pieces per element in the search for overlaps
_PARTS = 4
#: Maximum number of attempts to lay a cable without overlaps, each with larger gaps
_TRIES = 20


def strand(
    layers: Sequence[int],
    *,
    radius: float,
    lay_length: float | Sequence[float],
    length: float,
    clearance: float | None = None,
    elements_per_lay: int = 16,
    material: Material = COPPER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
) -> Model:
    """Helical strand: a straight core wire, if the first layer has one wire, and layers of helices around it.

    A cable of one stage; see `cable`, where the layers, supports and sets are described.

    Examples
    --------
    >>> strand([1, 6], radius=0.1e-3, lay_length=4e-3, length=8e-3)
    <Model 'Cable of 7 wires': 231 nodes, 224 elements
      <7 wires WIRES: 224 B33 elements, radius 0.0001, COPPER>
      contact among WIRES: TOUCH>
    """
    return cable(
        [layers],
        radius=radius,
        lay_lengths=[lay_length],
        length=length,
        clearance=clearance,
        elements_per_lay=elements_per_lay,
        material=material,
        interaction=interaction,
        element=element,
    )


def cable(
    stages: Sequence[Sequence[int]],
    *,
    radius: float,
    lay_lengths: Sequence[float | Sequence[float]],
    length: float,
    clearance: float | None = None,
    elements_per_lay: int = 16,
    material: Material = COPPER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
) -> Model:
    """Cable of several stages along z: wires are laid to strands, strands to ropes, and so on.

    The first stage lays wires, every later one lays bundles of the stage before. The radius of each layer is the smallest
    at which its members keep the clearance from each other and from the layer inside; if wires still overlap,
    because curved bundles bend towards each other, the cable is laid again with larger gaps.

    Neighbouring wires of a layer are nearly parallel and touch along lines. litz models contacts of crossing wires as
    points and has no line contact: the geometry is correct, but a run reports the number of such
    pairs and ends when they touch.

    Parameters
    ----------
    stages : sequence of sequences of int
        Members of each layer of each stage, from the inside: `[[1, 6], [1, 6]]` is a 7 x 7 rope.
    radius : float
        Radius of the wires [m].
    lay_lengths : sequence
        Lay length of each stage [m], or a sequence of those of its layers; a layer of a single member in the middle has
        none. Positive: right-handed, negative: left-handed.
    length : float
        Length of the cable [m].
    clearance : float, optional
        Smallest gap between the surfaces of wires [m]; a fiftieth of the radius when left out.
    elements_per_lay : int
        Elements of a wire on each turn of the shortest lay.
    material, interaction, element
        What the wires are made of, the laws of their contacts, type of the elements.

    Returns
    -------
    Model
        Group WIRES; node sets MINUS (z = 0, clamped) and PLUS (z = length, free along z only, and guided:
        `model.press(-d)` pulls by d).

    Raises
    ------
    ValueError
        For arguments out of range, or a lay that is too short for the wires to fit.
    """
    if len(stages) != len(lay_lengths) or not stages:
        raise ValueError(f"a lay length is needed for each of the {len(stages)} stages, not {len(lay_lengths)}")
    if not radius > 0 or not length > 0 or elements_per_lay < 4:
        raise ValueError("a cable needs a positive radius and length, and 4 or more elements per lay")
    clearance = radius / 50 if clearance is None else clearance
    if not clearance > 0:
        raise ValueError(f"clearance must be greater than 0, not {clearance:g}")
    lays = [_lays_of(layers, lay) for layers, lay in zip(stages, lay_lengths, strict=True)]
    turning = [abs(lay) for stage in lays for lay in stage if math.isfinite(lay)]
    if not turning:
        raise ValueError("a cable needs at least one layer around a core")
    n_elements = max(1, math.ceil(length / min(turning) * elements_per_lay))
    room = clearance
    for _ in range(_TRIES):
        axes = _lay_cable(stages, lays, radius, room, np.linspace(0, length, n_elements + 1))
        model = Model("Cable of " + " x ".join(str(sum(layers)) for layers in reversed(stages)) + " wires")
        axes = [rounded(axis, length) for axis in axes]
        model.wires("WIRES", axes, radius=radius, material=material, element=element)
        gap = smallest_gap(model, within=2 * clearance, parts=_PARTS)
        if gap >= 0.5 * clearance:
            break
        room += clearance - gap
    else:
        raise ValueError("the wires overlap for any gap: the lay is too short")
    _hold_ends(model)
    model.contact("WIRES", interaction=interaction)
    return model


def _lays_of(layers: Sequence[int], lay: float | Sequence[float]) -> list[float]:
    """Lay length of every layer; infinite for one member in the middle."""
    if not layers or min(layers) < 1:
        raise ValueError("each layer needs at least one member")
    core = layers[0] == 1
    n_laid = len(layers) - core
    laid = (np.full(n_laid, lay, dtype=float) if np.ndim(lay) == 0 else np.asarray(lay, dtype=float)).tolist()
    if len(laid) != n_laid or not all(math.isfinite(value) and value != 0 for value in laid):
        raise ValueError(f"{n_laid} layers need a lay length other than 0 each; given are {laid}")
    return [math.inf] * core + laid


def _lay_cable(
    stages: Sequence[Sequence[int]], lays: list[list[float]], radius: float, room: float, z: NDArray
) -> list[NDArray[np.float64]]:
    """Axes of all wires at the heights `z`, a list of (n, 3)."""
    bundle_radius = radius
    offsets: list[list[tuple[float, float, float]]] = []
    for layers, stage_lays in zip(stages, lays, strict=True):
        members = []
        outer = 0.0
        for count, lay in zip(layers, stage_lays, strict=True):
            at = 0.0 if math.isinf(lay) else _layer_radius(count, bundle_radius, lay, outer, room)
            members += [(at, lay, 2 * math.pi * member / count) for member in range(count)]
            outer = at + bundle_radius
        offsets.append(members)
        bundle_radius = outer
    straight_axis = np.stack([np.zeros_like(z), np.zeros_like(z), z], axis=1)
    axes = [straight_axis]
    for members in reversed(offsets):
        axes = [_wind(axis, z, *member) for axis in axes for member in members]
    return axes


def _wind(axis: NDArray, z: NDArray, at: float, lay: float, phase: float) -> NDArray[np.float64]:
    """A helix of radius `at` around a curve, in its normal planes."""
    if at == 0:
        return axis
    tangent = np.gradient(axis, z, axis=0, edge_order=2)
    arc = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(axis, axis=0), axis=1))])
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    # the frame with minimum rotation about a curve close to z: x, made normal to the tangent
    first = np.array([1.0, 0.0, 0.0]) - tangent[:, :1] * tangent
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(tangent, first)
    angle = (2 * math.pi * arc / lay + phase)[:, None]
    return axis + at * (np.cos(angle) * first + np.sin(angle) * second)


def _layer_radius(count: int, member: float, lay: float, inner: float, room: float) -> float:
    """Smallest radius of a layer of helices that clear each other and the layer inside."""
    smallest = inner + member + room if inner > 0 else (member + room / 2) if count > 1 else 0.0
    wanted = 2 * member + room
    if count == 1:
        return smallest if inner > 0 else 0.0
    # neighbours: the difference in height at which two helices come nearest lies within half a lay
    heights = np.linspace(0, abs(lay) / 2, 4001)

    def nearest(at: float) -> float:
        turn = 2 * math.pi / count - 2 * math.pi * heights / abs(lay)
        return float(np.sqrt(2 * at**2 * (1 - np.cos(turn)) + heights**2).min())

    low, high = smallest, smallest
    while nearest(high) < wanted:
        low, high = high, 1.1 * high
        if high > 10 * abs(lay):
            raise ValueError(f"{count} members do not fit side by side into a layer of the lay length {lay:g} m")
    while high - low > 1e-9 * high:
        middle = (low + high) / 2
        low, high = (low, middle) if nearest(middle) >= wanted else (middle, high)
    return high


def _hold_ends(model: Model) -> None:
    """Clamp the lower ends; leave the upper ends free along z only."""
    wires = model.groups["WIRES"].wires
    model.node_set("MINUS", [wire.nodes[0] for wire in wires])
    model.node_set("PLUS", [wire.nodes[-1] for wire in wires])
    model.fix("MINUS")
    model.fix("PLUS", "x", "y", "rotations")
    model.guides["PLUS"] = 1.0
