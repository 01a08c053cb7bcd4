"""The smooth axes of wires."""

from dataclasses import dataclass

import numpy as np

from .chains import Wire

# Two elements that meet at a sharper angle than this are joined by a kink, not by a smooth curve, as in the program.
_MAX_BEND = np.radians(20.0)


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
    for i, wire in enumerate(wires):
        number[wire.elements] = i
    closed = np.array([len(wire.elements) > 1 and wire.nodes[0] == wire.nodes[-1] for wire in wires], dtype=bool)
    return WireArcs(number, start, length, sign, np.bincount(number, length, len(wires)), closed)


def end_tangents(nodes: np.ndarray, wire: Wire) -> np.ndarray:
    """Unit tangents of the reference axis at both ends of each element of a wire, along the wire, (n, 2, 3).

    At a node between two elements both share the tangent of the parabola through the node and its two neighbours; at a
    free end the tangent is that of the circle that continues the curve.
    """
    chords = np.diff(nodes[wire.nodes], axis=0)
    length = np.linalg.norm(chords, axis=1)
    chords /= length[:, None]
    tangents = np.repeat(chords[:, None], 2, axis=1)
    closed = len(chords) > 2 and wire.nodes[0] == wire.nodes[-1]
    for before in range(len(chords) - (not closed)):
        after = (before + 1) % len(chords)
        if chords[before] @ chords[after] >= np.cos(_MAX_BEND):
            mean = chords[before] * length[after] + chords[after] * length[before]
            tangents[before, 1] = tangents[after, 0] = mean / np.linalg.norm(mean)
    if not closed:
        tangents[0, 0] = 2 * (chords[0] @ tangents[0, 1]) * chords[0] - tangents[0, 1]
        tangents[-1, 1] = 2 * (chords[-1] @ tangents[-1, 0]) * chords[-1] - tangents[-1, 0]
    return tangents


def rotate(vectors: np.ndarray, rotations: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) turned by rotation vectors (n, 3)."""
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
    current = nodes + displacement
    for wire in wires:
        pairs = np.stack([wire.nodes[:-1], wire.nodes[1:]], axis=1)
        half_length = np.linalg.norm(np.diff(nodes[wire.nodes], axis=0), axis=1)[:, None, None] / 2
        tangents = end_tangents(nodes, wire)
        turned = rotate(tangents.reshape(-1, 3), rotation[pairs.ravel()]).reshape(tangents.shape) * half_length
        against = wire.signs < 0
        positions[wire.elements] = np.where(against[:, None, None], current[pairs][:, ::-1], current[pairs])
        slopes[wire.elements] = np.where(against[:, None, None], -turned[:, ::-1], turned)
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
