"""A judge of finished runs: did wires pass through each other, or overlap without a contact?

It knows the deck's geometry and what the result file says of nodes: positions and rotations at every saved increment, and the
places of the contacts of the ledger. Everything else it finds by trying: axes are cut into short straight pieces, every piece is
compared with every other, and between two saved increments the axes are moved in steps that are small against a radius.

Three things are found:

passage   Two axes went through each other between two increments. Pieces of axes are straight lines that move; they meet when
          the volume that they span is zero while they cut each other. Meetings have a sign, that of the change of this
          volume: a graze that comes back adds up to nothing, what is left has passed. Wires side by side span no volume:
          there the shortest way from one to the other has turned round after it was next to nothing. The way between two
          increments is not in the file. Two ways are tried, nodes straight on with tangents that turn evenly, and each
          point straight on; a passage is on both. What is on one of them alone, or may have gone round the end of a wire, is
          a doubt and no finding.
deep      Tubes (with round joints and ends) overlap by more than 5 % of the smaller radius, at a contact of the ledger.
unseen    Tubes overlap by more than 0.5 % of the smaller radius where the ledger has no contact.
"""

import csv
import re
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial.transform import Rotation

#: Straight pieces that stand for an element
PIECES = 16
#: Overlap over the smaller radius that is an error with a contact, and without one
DEEP, UNSEEN = 0.05, 0.005
#: Places of two wires that share a node are neighbours where they are nearer than this many radii of arc
NEIGHBOUR = 8.0
#: Places of one smooth wire are where they are nearer than half a circle of its radius, or the wire turns by less
#: between them: places that are nearest to each other have 180 degrees between them, and those of a line that tapers 15 less
HALF_CIRCLE, TURN = np.pi, np.radians(165)
#: Between two looks a piece moves by this much of a radius at most
STRIDE = 0.3
#: Axes nearer than this much of the sum of radii have met, where they are side by side
MET = 0.3
#: Halvings of the time between two increments at most
HALVINGS = 12
#: Elements that meet at a smaller angle are one smooth wire: docs/theory.md, section 3, and Abaqus' 20 degrees
CORNER = np.radians(20)
SIDE_BY_SIDE = np.sin(np.radians(15))
#: Below this sine the place of a crossing is chance
CROSSED = np.sin(np.radians(3))


@dataclass
class Pair:
    """A *CONTACT PAIR: masks of its elements, and what its interaction says."""

    first: np.ndarray
    second: np.ndarray
    linear: bool = False
    unlimited: bool = False
    fit: bool = False


@dataclass
class Motion:
    """Wires and their states, the first of them the reference.

    `contacts` has for each state the places (n, 2, 3) of the contacts on both axes and their elements (n, 2).
    """

    reference: np.ndarray
    elements: np.ndarray
    radius: np.ndarray
    displacement: np.ndarray
    rotation: np.ndarray
    pairs: list[Pair]
    contacts: list[tuple[np.ndarray, np.ndarray]]
    labels: list[str]
    element_ids: np.ndarray | None = None

    def __post_init__(self):
        if self.element_ids is None:
            self.element_ids = np.arange(1, len(self.elements) + 1)

    @cached_property
    def length(self):
        a, b = self.reference[self.elements].swapaxes(0, 1)
        return np.linalg.norm(b - a, axis=1)

    @cached_property
    def chords(self):
        a, b = self.reference[self.elements].swapaxes(0, 1)
        return (b - a) / self.length[:, None]

    @cached_property
    def elements_at(self):
        found = [[] for _ in self.reference]
        for e, nodes in enumerate(self.elements):
            for side, node in enumerate(nodes):
                found[node].append((e, side))
        return found

    @cached_property
    def smooth_nodes(self):
        """Where two elements meet nearly straight on: an end of each."""
        found = []
        for ends in self.elements_at:
            if len(ends) != 2:
                continue
            (e, i), (f, j) = ends
            sense = 1 if i != j else -1
            if sense * (self.chords[e] @ self.chords[f]) >= np.cos(CORNER):
                found.append((e, i, f, j))
        return found

    @cached_property
    def chain(self):
        """Number of the smooth wire of each element."""
        e, _, f, _ = np.reshape(self.smooth_nodes, (-1, 4)).astype(int).T
        n = len(self.elements)
        return connected_components(coo_matrix((np.ones(len(e)), (e, f)), shape=(n, n)), directed=False)[1]

    @cached_property
    def tangents(self):
        """Reference tangents at both ends of each element: smooth where two elements meet nearly straight on."""
        found = np.repeat(self.chords[:, None], 2, axis=1)
        smooth = np.zeros(self.elements.shape, bool)
        for e, i, f, j in self.smooth_nodes:
            sense = 1 if i != j else -1
            # the tangent of the parabola through three neighbours
            mean = self.chords[e] * self.length[f] + sense * self.chords[f] * self.length[e]
            mean /= np.linalg.norm(mean)
            found[e, i], found[f, j] = mean, sense * mean
            smooth[e, i] = smooth[f, j] = True
        for e in np.flatnonzero(smooth.sum(1) == 1):
            # at an end the circle goes on
            i = int(smooth[e, 1])
            known = found[e, i]
            found[e, 1 - i] = 2 * (known @ self.chords[e]) * self.chords[e] - known
        return found

    @cached_property
    def graph(self):
        a, b = self.elements.T
        n = len(self.reference)
        return coo_matrix((self.length, (a, b)), shape=(n, n)).tocsr()

    @cached_property
    def wire(self):
        """Number of the connected wire of each element."""
        return connected_components(self.graph, directed=False)[1][self.elements[:, 0]]

    @cached_property
    def way(self):
        """Shortest way between nodes along the wires, as far as it matters (n, n)."""
        return dijkstra(self.graph, directed=False, limit=40 * self.radius.max())

    @cached_property
    def free_way(self):
        """Shortest way along the wires from each node to a free end; none: inf."""
        ends = [node for node, found in enumerate(self.elements_at) if len(found) == 1]
        if not ends:
            return np.full(len(self.reference), np.inf)
        return dijkstra(self.graph, directed=False, indices=ends, min_only=True)

    @cached_property
    def sense(self):
        """+1 or -1: whether an element runs along its wire; the same for a whole chain."""
        found = np.zeros(len(self.elements), int)
        for start in range(len(self.elements)):
            if found[start]:
                continue
            found[start] = 1
            stack = [start]
            while stack:
                e = stack.pop()
                for side, node in enumerate(self.elements[e]):
                    for f, other in self.elements_at[node]:
                        if not found[f]:
                            found[f] = found[e] * (1 if side != other else -1)
                            stack.append(f)
        return found

    def end_distance(self, e, s):
        """Arc from the place s (0..1) of an element to the nearest free end of its wire."""
        a, b = self.elements[e].T
        return np.minimum(self.free_way[a] + s * self.length[e], self.free_way[b] + (1 - s) * self.length[e])

    def arc_between(self, e, s, f, u):
        """Arc along the wires between places of two elements; inf where they are not connected or far from each other."""
        total = np.full(np.broadcast(e, s, f, u).shape, np.inf)
        for i in (0, 1):
            for j in (0, 1):
                from_e = (s if i == 0 else 1 - s) * self.length[e]
                from_f = (u if j == 0 else 1 - u) * self.length[f]
                total = np.minimum(total, from_e + self.way[self.elements[e, i], self.elements[f, j]] + from_f)
        return np.where(e == f, np.abs(s - u) * self.length[e], total)

    def are_apart(self, e, s, f, u):
        """Whether places of two elements are so far apart along the wires that they do not overlap by construction."""
        radii = np.where(self.chain[e] == self.chain[f], HALF_CIRCLE, NEIGHBOUR)
        return self.arc_between(e, s, f, u) > radii * np.maximum(self.radius[e], self.radius[f])

    def come_back(self, curves, e, s, f, u):
        """Whether a wire turns far enough to come back between places of two elements, either way; true of two wires."""
        pieces = np.diff(curves, axis=1)
        within = np.zeros(pieces.shape[:2])
        within[:, 1:] = np.cumsum(angle_between(pieces[:, :-1], pieces[:, 1:]), axis=1)
        # a graph of the ends of the elements
        a, i, b, j = np.reshape(self.smooth_nodes, (-1, 4)).astype(int).T
        corner = angle_between((1 - 2 * i)[:, None] * pieces[a, -i], (2 * j - 1)[:, None] * pieces[b, -j])
        m = np.arange(len(curves))
        rows, columns = np.concatenate([2 * m, 2 * a + i]), np.concatenate([2 * m + 1, 2 * b + j])
        turns = coo_matrix((np.concatenate([within[:, -1], corner]) + 1e-12, (rows, columns)), shape=(2 * len(m),) * 2)
        asked, at = np.unique(e, return_inverse=True)
        way = dijkstra(turns.tocsr(), directed=False, indices=np.concatenate([2 * asked, 2 * asked + 1]), limit=TURN)
        least = np.full(len(e), np.inf)
        piece_e, piece_f = (np.clip((x * PIECES).astype(int), 0, PIECES - 1) for x in (s, u))
        for i in (0, 1):
            from_e = np.abs(within[e, -i] - within[e, piece_e])
            for j in (0, 1):
                from_f = np.abs(within[f, -j] - within[f, piece_f])
                least = np.minimum(least, from_e + way[at + i * len(asked), 2 * f + j] + from_f)
        return least >= TURN


def angle_between(u, v):
    return np.arctan2(np.linalg.norm(np.cross(u, v), axis=-1), (u * v).sum(-1))


@dataclass
class Finding:
    kind: str
    state: int
    text: str
    amount: float = 0.0
    doubt: bool = False
    place: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def __str__(self):
        return f"{self.kind}{' (doubt)' if self.doubt else ''}: {self.text}"


# Axes


def shape_functions():
    s = np.linspace(0, 1, PIECES + 1)[:, None]
    return (
        (1 + 2 * s) * (1 - s) ** 2,
        s * (1 - s) ** 2,
        s**2 * (3 - 2 * s),
        s**2 * (s - 1),
    )


SHAPES = shape_functions()
STRAIGHT = np.linspace(0, 1, PIECES + 1)[:, None]


def axes(motion, x, turned, linear, which=slice(None)):
    """Points of the axis of each element, (m, PIECES + 1, 3): the cubic of its nodal tangents, or the chord."""
    a, b = motion.elements[which].T
    if linear:
        return (1 - STRAIGHT) * x[a][:, None] + STRAIGHT * x[b][:, None]
    t = motion.tangents[which] * motion.length[which][:, None, None]
    ta, tb = turned[a].apply(t[:, 0])[:, None], turned[b].apply(t[:, 1])[:, None]
    return SHAPES[0] * x[a][:, None] + SHAPES[1] * ta + SHAPES[2] * x[b][:, None] + SHAPES[3] * tb


def segment_distance(p, u, q, v):
    """Distance of straight pieces p + s u and q + t v with 0 <= s, t <= 1, and the places s and t."""
    w = p - q
    a, e = (u * u).sum(-1), (v * v).sum(-1)
    b, c, f = (u * v).sum(-1), (u * w).sum(-1), (v * w).sum(-1)
    det = a * e - b * b
    parallel = det <= 1e-12 * a * e
    s = np.clip(np.where(parallel, 0.5, (b * f - c * e) / np.where(parallel, 1, det)), 0, 1)
    t = (b * s + f) / e
    s = np.where(t < 0, np.clip(-c / a, 0, 1), np.where(t > 1, np.clip((b - c) / a, 0, 1), s))
    t = np.clip(t, 0, 1)
    return np.linalg.norm(w + s[..., None] * u - t[..., None] * v, axis=-1), s, t


# Pairs


def element_pairs(motion, pair):
    """All pairs of elements that a contact pair names, each once."""
    named = np.outer(pair.first, pair.second)
    named |= named.T
    return np.argwhere(np.triu(named, 1))


def boxes(points):
    return points.min(axis=1), points.max(axis=1)


def apart(low, high, pairs, reach):
    i, j = pairs.T
    return ((low[i] > high[j] + reach) | (low[j] > high[i] + reach)).any(axis=1)


# Overlap at one state


@dataclass
class Overlaps:
    """Overlapping pieces: elements, places, depth over the smaller radius, middle and sine of the angle."""

    e: np.ndarray
    f: np.ndarray
    s: np.ndarray
    u: np.ndarray
    depth: np.ndarray
    middle: np.ndarray
    sine: np.ndarray

    def where(self, keep):
        return Overlaps(*(getattr(self, name)[keep] for name in self.__dataclass_fields__))


def overlaps(motion, curves, pairs):
    """Pieces that overlap by more than the smallest allowance, without what lies along one wire."""
    low, high = boxes(curves)
    reach = 2 * motion.radius.max()
    pairs = pairs[~apart(low, high, pairs, reach)]
    e, f = pairs.T
    if not len(pairs):
        empty = np.zeros(0)
        return Overlaps(empty.astype(int), empty.astype(int), empty, empty, empty, np.zeros((0, 3)), empty)
    parts = []
    # not all pairs at once: PIECES^2 vectors each
    for some in np.array_split(np.arange(len(e)), 1 + len(e) // 400):
        p, q = curves[e[some]], curves[f[some]]
        u, v = np.diff(p, axis=1), np.diff(q, axis=1)
        distance, s, t = segment_distance(p[:, :-1, None], u[:, :, None], q[:, None, :-1], v[:, None])
        radii = (motion.radius[e[some]] + motion.radius[f[some]])[:, None, None]
        least = np.minimum(motion.radius[e[some]], motion.radius[f[some]])[:, None, None]
        # a piece stands for an arc that is higher by its sagitta
        bow = sagitta(p)[:, :, None] + sagitta(q)[:, None]
        depth = (radii - distance - bow) / least
        k, i, j = np.nonzero(depth > UNSEEN)
        a, b, si, tj = p[k, i], q[k, j], s[k, i, j], t[k, i, j]
        middle = (a + si[:, None] * u[k, i] + b + tj[:, None] * v[k, j]) / 2
        cross = np.linalg.norm(np.cross(u[k, i], v[k, j]), axis=1)
        sine = cross / np.linalg.norm(u[k, i], axis=1) / np.linalg.norm(v[k, j], axis=1)
        parts.append((e[some][k], f[some][k], (i + si) / PIECES, (j + tj) / PIECES, depth[k, i, j], middle, sine))
    found = Overlaps(*(np.concatenate(column) for column in zip(*parts, strict=True)))
    found = found.where(motion.are_apart(found.e, found.s, found.f, found.u))
    return found.where(motion.come_back(curves, found.e, found.s, found.f, found.u))


def sagitta(points):
    """How far the arc through three neighbours rises above each piece, (m, PIECES)."""
    bend = np.linalg.norm(np.diff(points, 2, axis=1), axis=-1) / 8
    bend = np.concatenate([bend[:, :1], bend, bend[:, -1:]], axis=1)
    return np.maximum(bend[:, :-1], bend[:, 1:])


def local_minima(motion, curves, found):
    """One for each place where two wires are nearest: overlapping pieces with none deeper nearby."""
    keep = np.zeros(len(found.e), bool)
    order = np.argsort(-found.depth, kind="stable")
    p = points_on(curves, found.e, found.s)
    q = points_on(curves, found.f, found.u)
    piece = np.maximum(motion.length[found.e], motion.length[found.f]) / PIECES
    window = 1.5 * np.maximum(motion.radius[found.e] + motion.radius[found.f], piece)
    flank = np.zeros(len(found.e), bool)
    for k in order:
        if not flank[k]:
            keep[k] = True
        near = (np.linalg.norm(p - p[k], axis=1) < window) & (np.linalg.norm(q - q[k], axis=1) < window)
        # what is beside something deeper leads down to it, step by step
        flank |= near
    return keep


def points_on(curves, e, s):
    place = np.clip(s * PIECES, 0, PIECES - 1e-9)
    i = place.astype(int)
    rest = (place - i)[:, None]
    return (1 - rest) * curves[e, i] + rest * curves[e, i + 1]


def seen(motion, curves, state, found):
    """Whether the ledger has a contact of the same wires at the place, (n)."""
    places, elements = motion.contacts[state]
    answer = np.zeros(len(found.e), bool)
    if not len(places):
        return answer
    p, q = points_on(curves, found.e, found.s), points_on(curves, found.f, found.u)
    wires = motion.wire[elements]
    for k in range(len(found.e)):
        e, f = found.e[k], found.f[k]
        # of a curved axis the place of the nearest point is known to a piece
        reach = motion.radius[e] + motion.radius[f] + np.maximum(motion.length[e], motion.length[f]) / PIECES
        for first, second in ((0, 1), (1, 0)):
            same = (wires[:, first] == motion.wire[e]) & (wires[:, second] == motion.wire[f])
            near = np.linalg.norm(places[:, first] - p[k], axis=1) < reach
            near &= np.linalg.norm(places[:, second] - q[k], axis=1) < reach
            answer[k] |= (same & near).any()
    return answer


def judge_overlaps(motion, state, pair, curves, pairs, at_start):
    found = overlaps(motion, curves, pairs)
    if at_start is not None and len(found.e):
        along = np.isfinite(motion.arc_between(found.e, found.s, found.f, found.u))
        built = np.array([(e, f) in at_start for e, f in zip(found.e, found.f, strict=True)])
        found = found.where(~(along & built))
    if not len(found.e):
        return []
    found = found.where(local_minima(motion, curves, found))
    known = seen(motion, curves, state, found)
    findings = []
    for k in range(len(found.e)):
        kind = "unseen" if not known[k] else "deep"
        if (kind == "deep" or pair.unlimited) and (found.depth[k] < DEEP or pair.unlimited):
            continue
        e, f = found.e[k], found.f[k]
        where = []
        if found.sine[k] < SIDE_BY_SIDE:
            where.append("side by side")
        if min(motion.end_distance(e, found.s[k]), motion.end_distance(f, found.u[k])) < 1e-3 * motion.radius[e]:
            where.append("at an end")
        findings.append(
            Finding(
                kind,
                state,
                f"increment {motion.labels[state]}: elements {motion.element_ids[e]} and {motion.element_ids[f]} overlap by "
                f"{100 * found.depth[k]:.3g} % of the smaller radius"
                + ("" if known[k] else ", and the ledger has no contact there")
                + "".join(f", {words}" for words in where),
                found.depth[k],
                place=found.middle[k],
            )
        )
    return findings


# Passages between two states


class Way:
    """Axes between two states, at any time from 0 to 1."""

    def __init__(self, motion, state, linear, noise, even):
        self.motion, self.even = motion, even and not linear
        self.x = [motion.reference + motion.displacement[k] + noise for k in (state - 1, state)]
        turned = [Rotation.from_rotvec(motion.rotation[k]) for k in (state - 1, state)]
        self.ends = [axes(motion, self.x[k], turned[k], linear) for k in (0, 1)]
        self.spin = (turned[1] * turned[0].inv()).as_rotvec()
        angle = np.linalg.norm(self.spin, axis=1)
        pole = self.spin / np.where(angle > 0, angle, 1)[:, None]
        # each end of each element: (m, 2), (m, 2, 3)
        self.angle, self.pole = angle[motion.elements], pole[motion.elements]
        tangents = motion.tangents * motion.length[:, None, None]
        self.tangents = np.stack([turned[0][motion.elements[:, k]].apply(tangents[:, k]) for k in (0, 1)], axis=1)
        # how far a point departs at most from the straight way, when tangents turn by one radian
        self.departure = 0.15 * motion.length * (self.angle**2).sum(1) / 8 if self.even else 0 * motion.length

    def between(self, time, c0, c1, which):
        """Axes of some elements half-way between two times, the others are left alone."""
        middle = np.empty_like(c0)
        if not self.even:
            middle[which] = (c0[which] + c1[which]) / 2
            return middle
        a, b = self.motion.elements[which].T
        x = (1 - time) * self.x[0] + time * self.x[1]
        turn, pole, start = time * self.angle[which][..., None], self.pole[which], self.tangents[which]
        along = (pole * start).sum(-1, keepdims=True)
        t = start * np.cos(turn) + np.cross(pole, start) * np.sin(turn) + pole * along * (1 - np.cos(turn))
        ta, tb = t[:, 0, None], t[:, 1, None]
        middle[which] = SHAPES[0] * x[a][:, None] + SHAPES[1] * ta + SHAPES[2] * x[b][:, None] + SHAPES[3] * tb
        return middle


@dataclass
class Meeting:
    time: float
    e: int
    f: int
    s: float
    u: float
    sign: int
    sine: float
    place: np.ndarray


def meetings(motion, way, pairs):
    """Where axes cut each other on a way, with signs; and pieces that come close side by side: (e, i, f, j)."""
    crossed, beside = [], set()
    stack = [(0, 1, *way.ends, pairs, 0)]
    while stack:
        start, end, c0, c1, some, depth = stack.pop()
        of_pair, at = np.unique(some, return_inverse=True)
        i, j = at.reshape(-1, 2).T
        d0, d1 = c0[of_pair], c1[of_pair]
        # as seen from the first element of each pair, which moves with `drift`: what moves along with it stays
        moved = d1 - d0
        drift = moved.mean(axis=1)[i]
        margin = (way.departure[of_pair] * (end - start) ** 2)[:, None]
        (low0, high0), (low1, high1) = boxes(d0), boxes(d1)
        reach = MET * (motion.radius[of_pair][i] + motion.radius[of_pair][j])[:, None]
        low_i, high_i = np.minimum(low0[i], low1[i] - drift), np.maximum(high0[i], high1[i] - drift)
        low_j, high_j = np.minimum(low0[j], low1[j] - drift), np.maximum(high0[j], high1[j] - drift)
        reach = reach + margin[i] + margin[j]
        near = ~((low_i > high_j + reach) | (low_j > high_i + reach)).any(axis=1)
        if not near.any():
            continue
        some, i, j = some[near], i[near], j[near]
        slow, fast = boxes(moved)
        relative = np.linalg.norm(np.maximum(fast[i] - slow[j], fast[j] - slow[i]), axis=1)
        least = np.minimum(motion.radius[of_pair][i], motion.radius[of_pair][j])
        if (relative / least).max() > STRIDE and depth < HALVINGS:
            middle = (start + end) / 2
            c = way.between(middle, c0, c1, np.unique(some))
            stack += [(middle, end, c, c1, some, depth + 1), (start, middle, c0, c, some, depth + 1)]
            continue
        for part in np.array_split(some, 1 + len(some) // 200):
            look(motion, c0, c1, start, end, part, crossed, beside)
    return sorted(crossed, key=lambda meeting: meeting.time), beside


def look(motion, c0, c1, start, end, pairs, crossed, beside):
    """Meetings within a short time in which all points move straight on."""
    e, f = pairs.T
    drift = (c1[e] - c0[e]).mean(axis=1, keepdims=True)
    a0, a1, b0, b1 = c0[e], c1[e] - drift, c0[f], c1[f] - drift
    reach = MET * (motion.radius[e] + motion.radius[f])[:, None, None, None]
    low, high = zip(*(piece_boxes(p, q) for p, q in ((a0, a1), (b0, b1))), strict=True)
    near = low[0][:, :, None] <= high[1][:, None] + reach
    near &= low[1][:, None] <= high[0][:, :, None] + reach
    k, i, j = np.nonzero(near[..., 0] & near[..., 1] & near[..., 2])
    if not len(k):
        return
    far = motion.are_apart(e[k], (i + 0.5) / PIECES, f[k], (j + 0.5) / PIECES)
    k, i, j = k[far], i[far], j[far]
    if not len(k):
        return
    w0, w1 = b0[k, j] - a0[k, i], b1[k, j] - a1[k, i]
    u0, u1 = a0[k, i + 1] - a0[k, i], a1[k, i + 1] - a1[k, i]
    v0, v1 = b0[k, j + 1] - b0[k, j], b1[k, j + 1] - b1[k, j]
    e, f = e[k], f[k]
    look_beside(motion, e, i, f, j, (-w0, u0, 0, v0), beside)
    look_beside(motion, e, i, f, j, (-w1, u1, 0, v1), beside)
    dw, du, dv = w1 - w0, u1 - u0, v1 - v0

    def volume(a, b, c):
        return (a * np.cross(b, c)).sum(-1)

    coefficients = np.stack(
        [
            volume(dw, du, dv),
            volume(w0, du, dv) + volume(dw, du, v0) + volume(dw, u0, dv),
            volume(dw, u0, v0) + volume(w0, du, v0) + volume(w0, u0, dv),
            volume(w0, u0, v0),
        ],
        axis=1,
    )
    for n in range(len(e)):
        polynomial = coefficients[n]
        roots = np.roots(polynomial) if np.abs(polynomial).max() > 0 else []
        for root in roots:
            t = root.real
            if abs(root.imag) > 1e-9 or not 0 <= t < 1:
                continue
            w, u, v = w0[n] + t * dw[n], u0[n] + t * du[n], v0[n] + t * dv[n]
            normal = np.cross(u, v)
            square = normal @ normal
            if square == 0:
                continue
            s, r = np.cross(w, v) @ normal / square, np.cross(w, u) @ normal / square
            if not (0 <= s < 1 and 0 <= r < 1):
                continue
            sign = np.sign(np.polyval(np.polyder(polynomial), t)) * motion.sense[e[n]] * motion.sense[f[n]]
            crossed.append(
                Meeting(
                    start + t * (end - start),
                    e[n],
                    f[n],
                    (i[n] + s) / PIECES,
                    (j[n] + r) / PIECES,
                    int(sign),
                    np.sqrt(square / (u @ u) / (v @ v)),
                    (1 - t) * c0[e[n], i[n]] + t * c1[e[n], i[n]] + s * u,
                )
            )


def piece_boxes(p, q):
    """Corners of the boxes around the straight pieces of axes that move from p to q, (k, PIECES, 3) each."""
    low, high = np.minimum(p, q), np.maximum(p, q)
    return np.minimum(low[:, :-1], low[:, 1:]), np.maximum(high[:, :-1], high[:, 1:])


def look_beside(motion, e, i, f, j, lines, beside):
    p, u, q, v = lines
    distance, _, _ = segment_distance(p, u, q, v)
    sine = np.linalg.norm(np.cross(u, v), axis=1) / np.linalg.norm(u, axis=1) / np.linalg.norm(v, axis=1)
    met = (distance < MET * (motion.radius[e] + motion.radius[f])) & (sine < SIDE_BY_SIDE)
    beside.update(zip(*(array[met].tolist() for array in (e, i, f, j)), strict=True))


def clusters(motion, way, met):
    """Meetings that may be one and the same crossing, which went through and came back, or slid: lists of meetings."""
    found = []
    motionless = np.linalg.norm(way.ends[1] - way.ends[0], axis=-1)
    for meeting in met:
        for cluster in found:
            last = cluster[-1]
            same = {motion.wire[last.e], motion.wire[last.f]} == {motion.wire[meeting.e], motion.wire[meeting.f]}
            radii = motion.radius[meeting.e] + motion.radius[meeting.f]
            speed = motionless[meeting.e].max() + motionless[meeting.f].max()
            reach = 4 * radii + 3 * speed * (meeting.time - last.time) / max(meeting.sine, last.sine, CROSSED)
            if same and np.linalg.norm(meeting.place - last.place) < reach:
                cluster.append(meeting)
                break
        else:
            found.append([meeting])
    return found


def unit(vector):
    return vector / np.linalg.norm(vector)


def near_end(motion, way, meeting):
    """Whether what met may have gone round a free end: the end is near, or slid by on the way."""
    radii = motion.radius[meeting.e] + motion.radius[meeting.f]
    moved = {}
    for name, e, s in (("e", meeting.e, meeting.s), ("f", meeting.f, meeting.u)):
        place = min(int(s * PIECES), PIECES - 1)
        moved[name] = way.ends[1][e, place] - way.ends[0][e, place]
    relative = moved["e"] - moved["f"]
    for e, s in ((meeting.e, meeting.s), (meeting.f, meeting.u)):
        place = min(int(s * PIECES), PIECES - 1)
        # along the mean direction: what turns about a point does not slide
        along = sum(unit(curves[e, place + 1] - curves[e, place]) for curves in way.ends)
        slide = abs(relative @ along) / max(np.linalg.norm(along), 1e-3)
        if motion.end_distance(e, s) < radii + slide:
            return True
    return False


def crossings_passed(motion, way, met):
    """Meetings of which one direction is left: {wires: (meeting, firm)}."""
    passed = {}
    for cluster in clusters(motion, way, met):
        if sum(meeting.sign for meeting in cluster) == 0:
            continue
        meeting = max(cluster, key=lambda one: one.sine)
        firm = meeting.sine > CROSSED and not any(near_end(motion, way, one) for one in cluster)
        wires = tuple(sorted((motion.wire[meeting.e], motion.wire[meeting.f])))
        if wires not in passed or firm > passed[wires][1]:
            passed[wires] = (meeting, firm)
    return passed


def nearest_way(curves, elements, point):
    """The shortest way from a point to the axes of some elements: vector, element, place."""
    p = curves[elements][:, :-1].reshape(-1, 3)
    u = np.diff(curves[elements], axis=1).reshape(-1, 3)
    s = np.clip(((point - p) * u).sum(1) / (u * u).sum(1), 0, 1)
    vector = p + s[:, None] * u - point
    k = np.argmin((vector * vector).sum(1))
    return vector[k], elements[k // PIECES], (k % PIECES + s[k]) / PIECES


def beside_passed(motion, way, beside):
    """Wires side by side that are on the other side of each other: {wires: (meeting, firm)}."""
    passed = {}
    for e, i, f, _ in sorted(beside):
        wires = tuple(sorted((motion.wire[e], motion.wire[f])))
        if wires in passed:
            continue
        near = np.flatnonzero(motion.way[motion.elements[f, 0], motion.elements[:, 0]] < 20 * motion.radius[f])
        near = near[motion.wire[near] == motion.wire[f]]
        if motion.wire[e] == motion.wire[f]:
            near = near[np.abs(near - e) > 1]
        if not len(near):
            continue
        reach = motion.radius[e] + motion.radius[f]
        sides = []
        for state in (0, 1):
            curves = way.ends[state]
            point = curves[e, i : i + 2].mean(0)
            vector, g, place = nearest_way(curves, near, point)
            sides.append((vector, g, place))
        (w0, g0, s0), (w1, g1, s1) = sides
        if min(np.linalg.norm(w0), np.linalg.norm(w1)) < 0.5 * reach:
            continue
        turn = Rotation.from_rotvec(way.spin[motion.elements[g0, 0]])
        if turn.apply(w0) @ w1 > -0.5 * np.linalg.norm(w0) * np.linalg.norm(w1):
            continue
        s = (i + 0.5) / PIECES
        inside = min(motion.end_distance(e, s), motion.end_distance(g0, s0), motion.end_distance(g1, s1)) > reach
        if not inside:
            continue
        passed[wires] = (Meeting(0.5, e, f, s, s1, 0, 0.0, way.ends[1][e, i]), True)
    return passed


def in_contact(motion, state):
    """Wires between which the ledger has a contact: with PENETRATION=UNLIMITED they may sink in beyond their axes."""
    _, elements = motion.contacts[state]
    return {tuple(sorted(pair)) for pair in motion.wire[elements].tolist()}


def judge_passages(motion, state, pair, pairs, noise):
    findings = []
    verdicts = []
    for even in (True, False):
        way = Way(motion, state, pair.linear, noise, even)
        met, beside = meetings(motion, way, pairs)
        if even and not met and not beside:
            return []
        crossed = crossings_passed(motion, way, met)
        for wires, (meeting, firm) in beside_passed(motion, way, beside).items():
            if wires not in crossed or not crossed[wires][1]:
                crossed[wires] = (meeting, firm)
        verdicts.append(crossed)
    meant = in_contact(motion, state) if pair.unlimited else set()
    for wires in sorted((set(verdicts[0]) | set(verdicts[1])) - meant):
        both = [verdict[wires] for verdict in verdicts if wires in verdict]
        firm = len(both) == 2 and all(sure for _, sure in both)
        meeting = both[0][0]
        findings.append(
            Finding(
                "passage",
                state,
                f"increments {motion.labels[state - 1]} to {motion.labels[state]}: the axes of elements "
                f"{motion.element_ids[meeting.e]} and {motion.element_ids[meeting.f]} go through each other at "
                f"({', '.join(f'{c:.4g}' for c in meeting.place)})" + (", side by side" if meeting.sign == 0 else ""),
                doubt=not firm,
                place=meeting.place,
            )
        )
    return findings


def judge(motion):
    """All findings of a run, those of the first state included."""
    noise = 1e-5 * motion.radius.min() * np.random.default_rng(0).uniform(-1, 1, motion.reference.shape)
    findings = []
    for pair in motion.pairs:
        pairs = element_pairs(motion, pair)
        if not len(pairs):
            continue
        at_start = None
        for state in range(len(motion.labels)):
            x = motion.reference + motion.displacement[state]
            curves = axes(motion, x, Rotation.from_rotvec(motion.rotation[state]), pair.linear)
            if state == 0:
                first = overlaps(motion, curves, pairs)
                at_start = set(zip(first.e.tolist(), first.f.tolist(), strict=True))
            else:
                findings += judge_passages(motion, state, pair, pairs, noise)
            # the ledger begins with the first increment
            if not pair.fit and state > 0:
                findings += judge_overlaps(motion, state, pair, curves, pairs, at_start)
    return findings


# Files


def cards_of(deck):
    """Keyword, parameters and data lines of each card of a deck."""
    cards = []
    for line in deck.splitlines():
        if line.startswith("**") or not line.strip():
            continue
        if line.startswith("*"):
            name, *parameters = [word.strip().upper() for word in line[1:].split(",")]
            cards.append((name, dict((*word.split("="), "")[:2] for word in parameters), []))
            cards[-1] = (name, {k.strip(): v.strip() for k, v in cards[-1][1].items()}, [])
        elif cards:
            cards[-1][2].append([word.strip() for word in line.split(",")])
    return cards


def pairs_of(deck, sets, n_elements):
    """The contact pairs of a deck."""
    interactions, name, found = {}, None, []
    for card, parameters, rows in cards_of(deck):
        if card == "SURFACE INTERACTION":
            name = parameters["NAME"]
            interactions[name] = {"linear": parameters.get("AXIS") == "LINEAR", "unlimited": False}
        elif card == "SURFACE BEHAVIOR":
            interactions[name]["unlimited"] = parameters.get("PENETRATION") == "UNLIMITED"
        elif card == "CONTACT PAIR":
            for row in rows:
                masks = [np.isin(np.arange(n_elements), sets[word.upper()]) for word in row if word]
                laws = parameters["INTERACTION"], "INTERFERENCE FIT" in parameters
                found.append((masks[0], masks[-1], *laws))
    return [Pair(a, b, fit=fit, **interactions[name]) for a, b, name, fit in found]


def read(path):
    """The motion in a result file and the ledger beside it."""
    path = Path(path)
    with h5py.File(path, "r", locking=False) as file:
        data = file["VTKHDF/PointData"]
        reference = data["reference_position"][()]
        n = len(reference)
        rows = {}
        counts = int(file["VTKHDF/Steps"].attrs["NSteps"])
        for name in ("displacement", "rotation"):
            starts = file[f"VTKHDF/Steps/PointDataOffsets/{name}"][:counts]
            rows[name] = np.array([data[name][start : start + n] for start in starts]).reshape(counts, n, 3)
        elements = file["VTKHDF/Connectivity"][()].reshape(-1, 2)
        ids = file["VTKHDF/CellData/element_id"][()]
        radius = file["VTKHDF/CellData/radius"][()]
        place = {number: k for k, number in enumerate(ids.tolist())}
        sets = {
            key.replace("|", "/").upper(): [place[k] for k in members[()].tolist() if k in place]
            for key, members in file["litz/element_sets"].items()
        }
        deck = file["litz/deck"][()]
        deck = deck.decode() if isinstance(deck, bytes) else str(deck)
        step = file["litz/increments/step"][:counts]
        increment = file["litz/increments/increment"][:counts]
    labels = [f"{s}:{i}" for s, i in zip(step.tolist(), increment.tolist(), strict=True)]
    if labels[:1] != ["0:0"]:
        # the reference comes first, whether the file has it or not
        labels.insert(0, "0:0")
        rows = {name: np.concatenate([np.zeros((1, n, 3)), values]) for name, values in rows.items()}
    return Motion(
        reference,
        elements,
        radius,
        rows["displacement"],
        rows["rotation"],
        pairs_of(deck, sets, len(elements)),
        read_ledger(path.with_name(path.stem + "_contacts.csv"), labels, place),
        labels,
        ids,
    )


def read_ledger(path, labels, place):
    found = {label: ([], []) for label in labels}
    if path.exists():
        with path.open() as file:
            rows = csv.reader(file)
            columns = [re.sub(r" \[.*\]", "", name) for name in next(rows)]
            at = {name: columns.index(name) for name in columns}
            points = [[at[f"{name}_{c}"] for c in "xyz"] for name in ("point_1", "point_2")]
            for row in rows:
                label = f"{int(row[at['step']])}:{int(row[at['increment']])}"
                if label not in found or float(row[at["force"]]) <= 0:
                    continue
                found[label][0].append([[float(row[k]) for k in columns] for columns in points])
                found[label][1].append([place[int(row[at[name]])] for name in ("element_1", "element_2")])
    return [
        (np.array(points, float).reshape(-1, 2, 3), np.array(elements, int).reshape(-1, 2))
        for points, elements in (found[label] for label in labels)
    ]
