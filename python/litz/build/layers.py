"""Layers of a strand or cable: their radius, and what fits where it does not."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .helices import Lay, neighbour_distance, touching_radius, widest_angle
from .winding import StraightAxis, WoundAxis

#: Neighbours may overlap by this share of their radius: round-off
_NOTHING = 1e-9


@dataclass(frozen=True)
class Layer:
    """A layer of a strand or cable.

    Attributes
    ----------
    count : int
        Number of members, wires or bundles.
    member : float
        Their radius [m].
    at : float
        Radius of the layer, up to the centre lines [m]; 0 for a core.
    lay_length : float
        Lay length [m]: positive right-handed, negative left-handed; infinite for a core.
    remark : str
        What a user should know about it; empty: nothing.
    turns : float
        Turns over the length of the cable, which each member then makes, whatever the length of what it is wound around;
        0: the lay length says.
    """

    count: int
    member: float
    at: float
    lay_length: float
    remark: str = ""
    turns: float = 0.0

    @property
    def outside(self) -> float:
        """Outer radius [m]."""
        return self.at + self.member

    def wound(self, core: StraightAxis | WoundAxis) -> list[StraightAxis | WoundAxis]:
        """Centre lines of its members about a curve."""
        if self.at == 0:
            return [core]
        step = 2 * math.pi / self.count
        lay = self.lay_length
        if self.turns > 0:
            lay = math.copysign(float(core.arc([core.length])[0]) / self.turns, lay)
        return [WoundAxis(core, self.at, lay, step * number) for number in range(self.count)]


def radius_of_layer(
    what: str, count: int, member: float, lay: Lay | None, inside: float, room: float, enlarge: bool
) -> Layer:
    """The layer whose members lie on what is inside, or on each other.

    Parameters
    ----------
    what : str
        The layer in words.
    count : int
        Number of members.
    member : float
        Their radius [m].
    lay : Lay, optional
        How they are laid; None: a straight core.
    inside : float
        Outer radius of what is inside [m]; 0: nothing.
    room : float
        Smallest gap [m].
    enlarge : bool
        Enlarge the layer where members would overlap each other; otherwise that is an error.
    """
    if lay is None:
        return Layer(count, member, 0.0, math.inf)
    if inside == 0:
        at = touching_radius(count, member, lay, room)
        return Layer(count, member, at, lay.hand * lay.length_at(at))
    at = inside + member + room
    wanted = 2 * member + room
    overlap = wanted - neighbour_distance(count, at, lay.length_at(at))
    remark = ""
    if overlap > _NOTHING * member:
        if count == 1:
            raise ValueError(f"the turns of {what} would overlap by {overlap:.3g} m: the lay is too short")
        free = touching_radius(count, member, lay, room)
        if not enlarge:
            raise ValueError(_remedies(what, count, member, lay, inside, at, free, overlap, wanted))
        remark = f"{what}: its members touch each other, {free - at:.3g} m off what is inside"
        at = free
    return Layer(count, member, at, lay.hand * lay.length_at(at), remark)


def _remedies(
    what: str, count: int, member: float, lay: Lay, inside: float, at: float, free: float, overlap: float, wanted: float
) -> str:
    """Error message for members that overlap each other, with what would fit."""
    angle = widest_angle(count, at, wanted)
    remedies = []
    if angle is not None:
        length = 2 * math.pi * at / math.tan(angle)
        remedies.append(f"lay it at {math.degrees(angle):.4g} degrees or less (lay length {length:.5g} m or more)")
    remedies += [
        f"make what is inside larger, of the radius {inside + free - at:.5g} m or more",
        f"use enlarge=True, which lays it {free - at:.3g} m off what is inside, so that neighbours touch each other",
    ]
    return (
        f"the {count} members of {what} would overlap each other by {overlap:.3g} m, that is "
        f"{100 * overlap / member:.2g} % of their radius, laid on the radius {inside:.5g} m at "
        f"{math.degrees(lay.angle_at(at)):.4g} degrees. Either {', or '.join(remedies)}."
    )
