"""Rutherford cables: flat, of strands in two layers that change from one to the other at the edges."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..model import COPPER, HERTZ_AND_HOLM, Interaction, Model
from .geometry import rounded, smallest_gap
from .strand_groups import Materials, add_strands, hold_ends

#: Strands may overlap by this share of their radius where their axes are interpolated between the nodes
OVERLAP = 2e-4
#: Elements by default: length in radii, and largest turn [rad] at the edges
_LENGTH, _TURN = 3.0, 0.1
#: By how much the length of elements may change over a length along the strand
_GRADE = 0.2
#: Pieces per element in the search for overlaps, points along a pitch, and attempts to lay the cable without overlaps
_PARTS, _POINTS, _TRIES = 4, 4000, 40
_FEWEST = 6
#: Strands that are at an edge at a time. More would overlap those of the faces
_AT_EDGE = 0.8


def rutherford(
    strands: int,
    *,
    radius: float,
    pitch: float,
    length: float,
    clearance: float = 0.0,
    element_length: float | None = None,
    material: Materials = COPPER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
    ends: str = "clamped",
) -> Model:
    """Rutherford cable along z: a flat cable of two layers of strands, x across its width and y through its thickness.

    Each strand runs aslant over one face, turns round the edge and runs back over the other face; all strands are the same
    curve, one after the other along the cable. Within a layer strands lie side by side, between the layers they cross. At each
    edge one strand at a time changes from one layer to the other.

    Parameters
    ----------
    strands : int
        Number of strands, 6 or more.
    radius : float
        Of the strands [m].
    pitch : float
        Length of cable over which a strand comes back to its place [m]; positive: strands of the upper face (y > 0) run
        towards positive x, negative: towards negative x.
    length : float
        Length of the cable [m].
    clearance : float
        Smallest gap between the surfaces of strands [m]; 0: some just touch.
    element_length : float, optional
        Length of the elements along the strands, at most [m]; they are shorter at the edges. Default: three radii.
    material : Material or sequence of Material
        Of all strands, or of each; several make a group for each material, STRANDS_COPPER etc.
    interaction, element, ends
        As those of `strand`.

    Returns
    -------
    Model
        Group STRANDS; element set WIRES with all; node sets MINUS (z = 0, clamped) and PLUS (z = length, free along z
        only, and guided: `model.press(-d)` pulls by d).

    Raises
    ------
    ValueError
        For arguments out of range, and where strands overlap for any gap.

    Notes
    -----
    In the cross-section the strands follow two straight lines and half circles round the edges, faster round the edges: a strand
    goes round an edge in 0.8 of the time in which the others move on by one place. Where the smooth axes of the elements overlap,
    all gaps are enlarged until they do not. The edges of real cables are pressed flat by rolling: `compact` with
    `shape="square"`, or planes that are moved, press the cable.

    Examples
    --------
    >>> rutherford(8, radius=0.4e-3, pitch=40e-3, length=10e-3)
    <Model 'Rutherford cable of 8 strands': 102 nodes, 94 elements
      <8 wires STRANDS: 94 B33 elements, radius 0.0004, COPPER>
      contact among WIRES: TOUCH>
    """
    if strands < _FEWEST:
        raise ValueError(f"a Rutherford cable has {_FEWEST} strands or more, not {strands}")
    if not radius > 0 or not length > 0 or not clearance >= 0:
        raise ValueError("a cable needs a positive radius and length, and a clearance of 0 or more")
    if not abs(pitch) > 0 or not math.isfinite(pitch):
        raise ValueError(f"the pitch must not be {pitch:g}")
    longest = _LENGTH * radius if element_length is None else element_length
    if not longest > 0:
        raise ValueError(f"element_length must be greater than 0, not {longest:g}")
    room, allowed = clearance, OVERLAP * radius
    for _ in range(_TRIES):
        path = _Path(strands, radius, pitch, room)
        model = _meshed(path, length, longest, material, element)
        gap = smallest_gap(model, within=2 * clearance + allowed, parts=_PARTS)
        if gap >= clearance - allowed:
            break
        room += clearance - gap
    else:
        raise ValueError(f"the strands overlap for any gap: the pitch of {pitch:g} m is too short")
    hold_ends(model, ends)
    model.contact("WIRES", interaction=interaction)
    return model


@dataclass(frozen=True)
class _Path:
    """The way of a strand round the cross-section, over the time from 0 to 1 in which it comes back to its place.

    It begins in the middle of the right edge, at the largest x, and goes over the lower face first.
    """

    strands: int
    radius: float
    pitch: float
    room: float

    @property
    def edge(self) -> float:
        """Radius of the half circles [m]: half of the distance of the layers."""
        return self.radius + self.room / 2

    @property
    def face(self) -> float:
        """Length of each straight line [m]: strands side by side, at a distance that grows with their slope."""
        apart, places = 2 * self.radius + self.room, self.strands / 2 - _AT_EDGE
        # strands at the distance d across the cable, with the slope n d/pitch, are d/sqrt(1 + slope^2) apart
        share = self.strands * apart / abs(self.pitch)
        if share >= 1:
            raise ValueError(
                f"{self.strands} strands of the radius {self.radius:g} m do not fit into the pitch of {self.pitch:g} m: "
                f"it must be longer than {self.strands * apart:.4g} m"
            )
        return places * apart / math.sqrt(1 - share**2)

    def travelled(self, time: NDArray) -> NDArray:
        """Way along the lines and half circles at a time (n) [m]: a mean over the time for which an edge takes."""
        half = _AT_EDGE / (2 * self.strands)
        return (self._integral(time + half) - self._integral(time - half)) / (2 * half)

    def _integral(self, time: NDArray) -> NDArray:
        """Integral of the way that has one speed along the faces and another one round the edges."""
        edge = _AT_EDGE / self.strands
        face = 0.5 - edge
        # half an edge, a face, an edge, a face, half an edge
        times = np.cumsum([0.0, edge / 2, face, edge, face, edge / 2])
        turn = math.pi * self.edge
        ways = np.cumsum([0.0, turn / 2, self.face, turn, self.face, turn / 2])
        areas = np.concatenate([[0.0], np.cumsum((ways[1:] + ways[:-1]) / 2 * np.diff(times))])
        round_ = np.floor(time)
        part = time - round_
        k = np.clip(np.searchsorted(times, part, "right") - 1, 0, len(times) - 2)
        speed = np.diff(ways) / np.diff(times)
        into = part - times[k]
        within = areas[k] + ways[k] * into + speed[k] * into**2 / 2
        # each turn before adds its way: n turns and a part of another
        return within + round_ * areas[-1] + ways[-1] * (round_ * (round_ - 1) / 2 + round_ * part)

    def place(self, time: NDArray) -> NDArray:
        """Places in the cross-section, (n, 2) [m]."""
        half, turn = self.face / 2, math.pi * self.edge
        way = np.mod(self.travelled(time), 2 * (self.face + turn))
        angle = np.zeros_like(way)
        x = np.zeros_like(way)
        starts = np.cumsum([0.0, turn / 2, self.face, turn, self.face])
        ends = [*starts[1:], np.inf]
        for k, (start, end) in enumerate(zip(starts, ends, strict=True)):
            here = (way >= start) & (way < end)
            into = way[here] - start
            if k in (1, 3):
                x[here] = (half - into) * (1 if k == 1 else -1)
                angle[here] = math.pi / 2 if k == 1 else 3 * math.pi / 2
            else:
                x[here] = half if k != 2 else -half
                angle[here] = (into / self.edge) + (0.0, 0.0, math.pi / 2, 0.0, 3 * math.pi / 2)[k]
        return np.stack([x + self.edge * np.cos(angle), -self.edge * np.sin(angle)], axis=1)

    def points(self, z: NDArray, number: int) -> NDArray:
        """Axis of a strand at heights z (n), (n, 3) [m]."""
        flat = self.place(np.abs(z / self.pitch) + number / self.strands)
        if self.pitch < 0:
            flat[:, 0] = -flat[:, 0]
        return np.column_stack([flat, z])


def _meshed(path: _Path, length: float, longest: float, material: Materials, element: str) -> Model:
    """Strands whose elements are as short as their length and their turns want it."""
    model = Model(f"Rutherford cable of {path.strands} strands")
    n = max(2, math.ceil(_POINTS * length / abs(path.pitch)))
    z = np.linspace(0.0, length, n + 1)
    axes = []
    for number in range(path.strands):
        points = path.points(z, number)
        chords = np.diff(points, axis=0)
        size = np.linalg.norm(chords, axis=1)
        tangents = chords / size[:, None]
        turns = np.linalg.norm(np.diff(tangents, axis=0), axis=1)
        turns = (np.append(turns, 0.0) + np.append(0.0, turns)) / 2
        wanted = np.minimum(longest, _TURN * size / np.maximum(turns, 1e-12))
        upto = np.concatenate([[0.0], np.cumsum(size / _graded(wanted, np.cumsum(size)))])
        elements = max(1, math.ceil(upto[-1] * (1 - 1e-12)))
        nodes = np.interp(np.linspace(0.0, upto[-1], elements + 1), upto, z)
        axes.append(rounded(path.points(nodes, number), path.radius))
    add_strands(model, "STRANDS", axes, radius=path.radius, material=material, element=element, count=path.strands)
    model.element_set("WIRES", list(model.groups))
    return model


def _graded(size: NDArray, along: NDArray) -> NDArray:
    """Lengths of elements that change by little along a curve, `size` (n) [m] at most; `along`: places on it (n) [m]."""
    rising = np.minimum.accumulate(size - _GRADE * along) + _GRADE * along
    falling = np.minimum.accumulate((size + _GRADE * along)[::-1])[::-1] - _GRADE * along
    return np.minimum(rising, falling)
