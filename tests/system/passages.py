"""Wires that passed through each other, or overlap without a contact: found in result files by trying everything.

Nothing of litz's search is used: the axes are cut into short straight pieces, and each piece of a wire is compared with
each of every other. The axes are the cubic curves of docs/theory.md, section 3, of wires that are straight in the reference.
"""

from itertools import combinations

import numpy as np

#: Straight pieces that stand for an element
PIECES = 8
#: Wires that cross under less than this are side by side, where litz models no contact
SMALLEST_SINE = np.sin(np.radians(10))


def wires_of(results):
    """Elements of each wire, in their order: chains of elements that share nodes."""
    elements = results.elements
    chains, last = [], None
    for e, (first, second) in enumerate(elements):
        if first == last:
            chains[-1].append(e)
        else:
            chains.append([e])
        last = second
    return chains


def rotated(vector, rotation):
    """A vector turned by a rotation vector (Rodrigues)."""
    angle = np.linalg.norm(rotation)
    if angle == 0:
        return vector
    axis = rotation / angle
    return (
        vector * np.cos(angle) + np.cross(axis, vector) * np.sin(angle) + axis * (axis @ vector) * (1 - np.cos(angle))
    )


def axes(results, increment):
    """Points along the axis of each wire."""
    reference, now = results.field("reference_position", increment), results.positions(increment)
    rotation, elements = results.field("rotation", increment), results.elements
    found = []
    for chain in wires_of(results):
        points = []
        for e in chain:
            a, b = elements[e]
            chord = reference[b] - reference[a]
            length = np.linalg.norm(chord)
            s = np.linspace(0, 1, PIECES, endpoint=False)[:, None]
            ta, tb = (rotated(chord / length, rotation[node]) for node in (a, b))
            points.append(
                (1 + 2 * s) * (1 - s) ** 2 * now[a] + s * (1 - s) ** 2 * length * ta
                + s**2 * (3 - 2 * s) * now[b] + s**2 * (s - 1) * length * tb
            )  # fmt: skip
        points.append(now[elements[chain[-1]][1]][None])
        found.append(np.concatenate(points))
    return found


def closest(a, b):
    """Of each piece of one wire and each of another: distance, the two places, sine of the angle, and whether the common
    perpendicular meets both."""
    p, q = a[:-1, None], b[None, :-1]
    u, v = np.diff(a, axis=0)[:, None], np.diff(b, axis=0)[None]
    uu, vv, uv = (u * u).sum(-1), (v * v).sum(-1), (u * v).sum(-1)
    w = p - q
    uw, vw = (u * w).sum(-1), (v * w).sum(-1)
    determinant = uu * vv - uv**2
    sine = np.sqrt(np.maximum(determinant, 0) / (uu * vv))
    safe = np.where(determinant > 0, determinant, 1)
    s, t = (uv * vw - vv * uw) / safe, (uu * vw - uv * uw) / safe
    meets = (sine > SMALLEST_SINE) & (s >= 0) & (s < 1) & (t >= 0) & (t < 1)
    # the end faces of wires touch nothing in litz: a crossing enters and leaves there
    meets[[0, -1], :] = meets[:, [0, -1]] = False
    return w + s[..., None] * u - t[..., None] * v, p + s[..., None] * u, u, v, meets


def crossings(a, b, reach):
    """Common perpendiculars of two wires that are shorter than `reach`: gap vector, place, side."""
    low_a, high_a, low_b, high_b = a.min(0) - reach, a.max(0) + reach, b.min(0), b.max(0)
    if (low_a > high_b).any() or (low_b > high_a).any():
        return []
    gap, place, u, v, meets = closest(a, b)
    found = []
    for i, j in zip(*np.nonzero(meets), strict=True):
        distance = np.linalg.norm(gap[i, j])
        if distance < reach:
            side = np.sign(np.dot(gap[i, j], np.cross(u[i, 0], v[0, j])))
            found.append((distance, place[i, j], side))
    return found


def overlaps_without_contact(results, increment, tolerance=0.02):
    """Pairs of wires whose surfaces overlap by more than `tolerance` of the smaller radius, with no contact of the ledger
    nearby: (wire, wire, overlap over the smaller radius)."""
    radius = results.radius
    chains = wires_of(results)
    wire_of = {results.element_ids[e]: w for w, chain in enumerate(chains) for e in chain}
    contacts = results.contacts_at(increment)
    touching = {}
    points = np.c_[contacts["point_bar_x"], contacts["point_bar_y"], contacts["point_bar_z"]]
    for k, (a, b) in enumerate(zip(contacts["element_bar"], contacts["element"], strict=True)):
        touching.setdefault(frozenset((wire_of[a], wire_of[b])), []).append(points[k])
    curves = axes(results, increment)
    found = []
    for m, n in combinations(range(len(chains)), 2):
        r = radius[chains[m][0]], radius[chains[n][0]]
        for distance, place, _ in crossings(curves[m], curves[n], sum(r) - tolerance * min(r)):
            near = touching.get(frozenset((m, n)), [])
            if not any(np.linalg.norm(place - point) < 4 * sum(r) for point in near):
                found.append((m, n, (sum(r) - distance) / min(r)))
    return found


def passages(results):
    """Pairs of wires with a single crossing before and after an increment, on one side before and on the other after:
    (increment, wire, wire)."""
    found = []
    before = {}
    for increment in range(len(results.times)):
        curves = axes(results, increment)
        now = {}
        for m, n in combinations(range(len(curves)), 2):
            # far apart on both sides, or with several crossings, sides cannot be told from each other
            met = crossings(curves[m], curves[n], 20 * results.radius.max())
            if len(met) == 1:
                now[m, n] = met[0][2]
                if before.get((m, n), met[0][2]) != met[0][2]:
                    found.append((increment, m, n))
        before = now
    return found
