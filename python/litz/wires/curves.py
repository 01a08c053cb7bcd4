"""The smooth axes of wires."""

from dataclasses import dataclass

import numpy as np

from .chains import Wire

#: Two elements that meet at a sharper angle than this are joined by a kink, not by a smooth curve, as in the program.
MAX_BEND = np.radians(20.0)


def arc_lengths(
    nodes: np.ndarray, elements: np.ndarray, wires: list[Wire]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where the elements are along their wires, before deformation.

    Returns
    -------
    start, length : ndarray
        Arc length at which each element begins along its wire, and its own length, (n_elements) [m].
    sign : ndarray
        +1 where the element points along its wire, -1 where against it, (n_elements).
    """
    length = np.linalg.norm(np.diff(nodes[elements], axis=1)[:, 0], axis=1)
    start, sign = np.zeros(len(length)), np.zeros(len(length))
    for wire in wires:
        start[wire.elements] = np.cumsum(length[wire.elements]) - length[wire.elements]
        sign[wire.elements] = wire.signs
    return start, length, sign


@dataclass(frozen=True, eq=False)
class WireArcs:
    """Where the elements are along their wires, before deformation.

    Attributes
    ----------
    wire : ndarray
        Wire of each element, counted from 0, (n_elements).
    start, length, sign : ndarray
        As `arc_lengths` gives them.
    wire_length : ndarray
        Length of each wire, (n_wires) [m].
    closed : ndarray of bool
        The wire is a ring, (n_wires).
    """

    wire: np.ndarray
    start: np.ndarray
    length: np.ndarray
    sign: np.ndarray
    wire_length: np.ndarray
    closed: np.ndarray


def wire_arcs(nodes: np.ndarray, elements: np.ndarray, wires: list[Wire]) -> WireArcs:
    """Where the elements are along their wires."""
    start, length, sign = arc_lengths(nodes, elements, wires)
    number = np.zeros(len(elements), dtype=int)
    own = np.zeros(len(elements), dtype=bool)
    for i, wire in enumerate(wires):
        number[wire.elements] = i
        own[wire.elements] = True
    closed = np.array([len(wire.elements) > 1 and wire.nodes[0] == wire.nodes[-1] for wire in wires], dtype=bool)
    return WireArcs(number, start, length, sign, np.bincount(number, own * length, len(wires)), closed)


def end_tangents(nodes: np.ndarray, wires: list[Wire]) -> np.ndarray:
    """Unit tangents of the reference axes at both ends of each element of wires, one wire after the other, along it, (n, 2, 3).

    At a node between two elements both share the tangent of the parabola through the node and its two neighbours; at a
    free end the tangent is that of the circle that continues the curve.
    """
    chords = nodes[_joined(wires, slice(1, None))] - nodes[_joined(wires, slice(-1))]
    length = np.linalg.norm(chords, axis=1)
    chords /= length[:, None]
    counts = np.array([len(wire.elements) for wire in wires], dtype=int)
    last = np.cumsum(counts) - 1
    first = last - counts + 1
    closed = np.array([len(wire.elements) > 2 and wire.nodes[0] == wire.nodes[-1] for wire in wires], dtype=bool)
    after = np.arange(1, len(chords) + 1)
    after[last] = np.where(closed, first, -1)
    before = np.flatnonzero(after >= 0)
    after = after[before]
    smooth = np.sum(chords[before] * chords[after], axis=1) >= np.cos(MAX_BEND)
    before, after = before[smooth], after[smooth]
    mean = chords[before] * length[after, None] + chords[after] * length[before, None]
    tangents = np.repeat(chords[:, None], 2, axis=1)
    tangents[before, 1] = tangents[after, 0] = mean / np.linalg.norm(mean, axis=1, keepdims=True)
    for row, end in ((first[~closed], 0), (last[~closed], 1)):
        inner = tangents[row, 1 - end]
        tangents[row, end] = 2 * np.sum(chords[row] * inner, axis=1, keepdims=True) * chords[row] - inner
    return tangents


def _joined(wires: list[Wire], part: slice) -> np.ndarray:
    """A part of the nodes of each wire, one wire after the other."""
    return np.concatenate([wire.nodes[part] for wire in wires]) if wires else np.zeros(0, dtype=int)


def rotate(vectors: np.ndarray, rotations: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) turned by rotation vectors (n, 3)."""
    if not rotations.any():
        return vectors
    angle = np.linalg.norm(rotations, axis=1, keepdims=True)
    axis = np.divide(rotations, angle, out=np.zeros_like(rotations), where=angle > 0)
    along = np.sum(axis * vectors, axis=1, keepdims=True) * axis
    return along + np.cos(angle) * (vectors - along) + np.sin(angle) * np.cross(axis, vectors)


def element_curves(
    nodes: np.ndarray, displacement: np.ndarray, rotation: np.ndarray, wires: list[Wire], n_elements: int
) -> tuple[np.ndarray, np.ndarray]:
    """What the Hermite axis of each element needs, in the element's own direction.

    Returns
    -------
    positions, slopes : ndarray
        Current positions of the two ends and their derivatives with respect to xi, (n_elements, 2, 3).
    """
    positions, slopes = np.zeros((n_elements, 2, 3)), np.zeros((n_elements, 2, 3))
    if not wires:
        return positions, slopes
    pairs = np.stack([_joined(wires, slice(-1)), _joined(wires, slice(1, None))], axis=1)
    elements, signs = (np.concatenate([getattr(wire, name) for wire in wires]) for name in ("elements", "signs"))
    half_length = np.linalg.norm(nodes[pairs[:, 1]] - nodes[pairs[:, 0]], axis=1)[:, None, None] / 2
    tangents = end_tangents(nodes, wires)
    turned = rotate(tangents.reshape(-1, 3), rotation[pairs.ravel()]).reshape(tangents.shape) * half_length
    current = (nodes + displacement)[pairs]
    against = (signs < 0)[:, None, None]
    positions[elements] = np.where(against, current[:, ::-1], current)
    slopes[elements] = np.where(against, -turned[:, ::-1], turned)
    return positions, slopes


def hermite(positions: np.ndarray, slopes: np.ndarray, xi: np.ndarray) -> np.ndarray:
    """Points of cubic curves, one xi in [-1, 1] for each: (n, 2, 3), (n, 2, 3), (n) -> (n, 3)."""
    xi = np.asarray(xi, dtype=float)[:, None]
    h1, h2 = (2 - 3 * xi + xi**3) / 4, (2 + 3 * xi - xi**3) / 4
    g1, g2 = (1 - xi - xi**2 + xi**3) / 4, (-1 - xi + xi**2 + xi**3) / 4
    return h1 * positions[:, 0] + h2 * positions[:, 1] + g1 * slopes[:, 0] + g2 * slopes[:, 1]


def hermite_slope(positions: np.ndarray, slopes: np.ndarray, xi: np.ndarray) -> np.ndarray:
    """Derivatives of the curves of `hermite` with respect to xi: (n, 2, 3), (n, 2, 3), (n) -> (n, 3)."""
    xi = np.asarray(xi, dtype=float)[:, None]
    h2 = 0.75 * (1 - xi**2)
    g1, g2 = (-1 - 2 * xi + 3 * xi**2) / 4, (-1 + 2 * xi + 3 * xi**2) / 4
    return h2 * (positions[:, 1] - positions[:, 0]) + g1 * slopes[:, 0] + g2 * slopes[:, 1]
