"""Random decks of wires that move against each other: a name makes the same deck every time: `deck_of("pile-7")`.

A family has the concrete decks of its list first, and random ones after them. Every deck is one that a user might write; what
litz cannot do it may refuse.
"""

import itertools
from dataclasses import dataclass, field

import numpy as np

FAMILIES = {}


def family(function):
    """Registers a function of a random generator and the number of the case, under its name."""
    FAMILIES[function.__name__] = function
    return function


def deck_of(name):
    """The text of the deck FAMILY-NUMBER."""
    kind, number = name.rsplit("-", 1)
    order = list(FAMILIES).index(kind)
    return FAMILIES[kind](np.random.default_rng([order, int(number)]), int(number))


def names(count, seed=0):
    """Names of `count` cases, the families in turn; another seed gives others."""
    kinds = list(FAMILIES)
    first = seed * count
    return [f"{kinds[k % len(kinds)]}-{(first + k) // len(kinds)}" for k in range(count)]


# Decks


@dataclass
class Wire:
    nodes: list[int]
    radius: float

    @property
    def ends(self):
        return [self.nodes[0], self.nodes[-1]]


@dataclass
class Deck:
    """Wires, what holds and moves them, and the laws of their contact."""

    title: str
    material: tuple[float, float] = (110e9, 0.3)
    law: str = "HERTZ"
    friction: float = 0.0
    axis: str = "HERMITE"
    lines: list[str] = field(default_factory=list)
    fixed: list[str] = field(default_factory=list)
    steps: list[str] = field(default_factory=list)
    pairs: list[str] = field(default_factory=list)
    wires: list[Wire] = field(default_factory=list)
    nodes: int = 0
    elements: int = 0

    def wire(self, points, radius, element="B33", closed=False, material=None):
        """A wire through points, an element set W1, W2, ... of its own."""
        name = f"W{len(self.wires) + 1}"
        first = self.nodes + 1
        self.lines.append(f"*NODE, NSET={name}")
        self.lines += [f" {first + k}, {x:.10g}, {y:.10g}, {z:.10g}" for k, (x, y, z) in enumerate(points)]
        n = len(points)
        self.lines.append(f"*ELEMENT, TYPE={element}, ELSET={name}")
        for k in range(n if closed else n - 1):
            self.elements += 1
            self.lines.append(f" {self.elements}, {first + k}, {first + (k + 1) % n}")
        young, poisson = material or self.material
        self.lines += [
            f"*MATERIAL, NAME=M{name}\n*ELASTIC\n {young:.6g}, {poisson}",
            f"*BEAM SECTION, ELSET={name}, MATERIAL=M{name}, SECTION=CIRC\n {radius:.10g}",
        ]
        self.nodes += n
        self.wires.append(Wire(list(range(first, first + n)), radius))
        return self.wires[-1]

    def fix(self, nodes, first, last):
        self.fixed += [f" {node}, {first}, {last}" for node in nodes]

    def step(self, moves, first=None, loads=(), smallest=None):
        """A step; `moves` are (nodes, direction, value), `first` its first increment, the default without one."""
        static = "" if first is None else f"\n {first:.6g}, 1." + (f", {smallest:g}" if smallest else "")
        lines = [f"*STEP, INC=300\n*STATIC{static}"]
        if moves:
            lines.append("*BOUNDARY")
            lines += [f" {node}, {d}, {d}, {value:.10g}" for nodes, d, value in moves for node in nodes]
        if loads:
            lines.append("*CLOAD")
            lines += [f" {node}, {d}, {value:.10g}" for nodes, d, value in loads for node in nodes]
        self.steps.append("\n".join([*lines, "*END STEP"]))

    def text(self):
        law = "HERTZ" if self.law == "HERTZ" else f"LINEAR\n {self.law}"
        laws = [f"*SURFACE INTERACTION, NAME=TOUCH, AXIS={self.axis}\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}"]
        if self.friction:
            laws.append(f"*FRICTION\n {self.friction:.3g}")
        sets = [f"*ELSET, ELSET=ALL\n W{k + 1}" for k in range(len(self.wires))]
        pairs = [f"*CONTACT PAIR, INTERACTION=TOUCH\n {pair}" for pair in (self.pairs or ["ALL"])]
        fixed = ["*BOUNDARY", *self.fixed] if self.fixed else []
        return "\n".join(["*HEADING", self.title, *self.lines, *sets, *laws, *pairs, *fixed, *self.steps, ""])


def pick(random, *choices):
    return choices[random.integers(len(choices))]


def laws(random, deck, radius):
    """Random laws of contact; penalties from soft to stiff against the radius, few of them too soft."""
    kind = random.uniform()
    if kind < 0.5:
        deck.law = "HERTZ"
    else:
        deck.law = f"{10 ** random.uniform(3.5, 7):.4g}"
    if random.uniform() < 0.3:
        deck.friction = random.uniform(0.05, 0.5)
    if random.uniform() < 0.2:
        deck.axis = "LINEAR"


def first_increment(random):
    return pick(random, None, None, 1.0, 0.5, 0.25, 0.1, 0.05)


def element(random):
    return pick(random, "B33", "B33", "B31")


def straight(start, end, n):
    return np.linspace(start, end, n + 1)


def direction(angle):
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def uneven(random, start, end, n):
    """Points on a line at unequal distances."""
    s = np.cumsum(random.uniform(0.5, 1.5, n))
    s = np.concatenate([[0], s / s[-1]])[:, None]
    return (1 - s) * np.asarray(start, float) + s * np.asarray(end, float)


def distance(a, b):
    """Least distance of two polylines, by trying."""

    def fine(points):
        s = np.linspace(0, 1, 12, endpoint=False)[:, None]
        return np.concatenate([*(p + s * (q - p) for p, q in itertools.pairwise(points)), points[-1:]])

    a, b = fine(np.asarray(a)), fine(np.asarray(b))
    step = max(np.linalg.norm(np.diff(a, axis=0), axis=1).max(), np.linalg.norm(np.diff(b, axis=0), axis=1).max())
    least = np.linalg.norm(a[:, None] - b[None], axis=-1).min()
    return np.sqrt(max(least**2 - step**2 / 2, 0))


def turned_by(points, centre, angle):
    """Displacements of points on a plane that turns about an upright axis."""
    arm = np.asarray(points) - centre
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * arm[:, 0] - s * arm[:, 1], s * arm[:, 0] + c * arm[:, 1], arm[:, 2]], 1) - arm


# Families


@family
def thread(random, number):
    """A thread, clamped at one end, is pushed aside by a crossing wire: meshes, first increments, laws."""
    listed = [
        (n, first, law)
        for n in (40, 10, 80, 20, 160, 30, 60, 120)
        for first in (0.1, 0.05, 0.25, 0.5, 1.0)
        for law in ("HERTZ", "1e4", "1e6")
    ]
    deck = Deck("a thread pushed by a crossing wire")
    length, at, shift = 0.163, 0.07335, -0.0394816
    if number < len(listed):
        n, first, deck.law = listed[number * 37 % len(listed)]
    else:
        n, first = int(random.integers(8, 60)), pick(random, None, 0.05, 0.1, 0.2, 0.5, 1.0)
        deck.law = pick(random, "HERTZ", f"{10 ** random.uniform(4, 7):.4g}")
        at, shift = random.uniform(0.04, 0.12), -random.uniform(0.02, 0.05)
    a = deck.wire(straight((0, 0, 0), (length, 0, 0), n), 0.4e-3)
    b = deck.wire([(at, 0.0031, -0.02), (at, 0.0031, 0.02)], 0.7e-3, material=(200e9, 0.28))
    deck.fix(a.nodes[:1], 1, 6)
    deck.fix(b.nodes, 1, 1)
    deck.fix(b.nodes, 3, 6)
    deck.step([(b.nodes, 2, shift)], first)
    return deck.text()


@family
def pile(random, number):
    """Straight and curved wires of random places in a box; their ends move at random by up to ten radii, in one or two steps."""
    deck = Deck(f"pile {number}", material=(10 ** random.uniform(9, 11), 0.3))
    radius = 10 ** random.uniform(-4.2, -3.3)
    laws(random, deck, radius)
    half, wanted = 50 * radius, int(random.integers(3, 9))
    placed = []
    for _ in range(400):
        if len(placed) == wanted:
            break
        r = radius * random.uniform(0.6, 1.4)
        middle = random.uniform(-1, 1, 3) * np.array([25, 25, 7]) * radius
        t = direction(random.uniform(0, np.pi)) + np.array([0, 0, random.uniform(-0.05, 0.05)])
        n = int(random.integers(4, 11))
        points = middle + uneven(random, -half * t, half * t, n)
        if random.uniform() < 0.3:
            sagitta = random.uniform(2, 15) * radius
            side = np.array([-t[1], t[0], 0])
            s = ((points - middle) @ t / half)[:, None]
            points = points + sagitta * (1 - s**2) * side
        if all(distance(points, other) > r + q for other, q in placed):
            placed.append((points, r))
    kind = element(random)
    wires = [deck.wire(points, r, kind) for points, r in placed]
    first, hinged = first_increment(random), random.uniform() < 0.3
    for _ in range(int(random.integers(1, 3))):
        moves = []
        for (points, _), wire in zip(placed, wires, strict=True):
            axis = (points[-1] - points[0]) / np.linalg.norm(points[-1] - points[0])
            for node in wire.ends:
                shift = random.uniform(-1, 1, 3) * np.array([4, 4, 10]) * radius
                shift -= axis * (axis @ shift)
                moves += [([node], d + 1, shift[d]) for d in range(3)]
                if not hinged:
                    moves += [([node], d, 0) for d in (4, 5, 6)]
        deck.step(moves, first)
    if hinged:
        # a wire on hinges must not spin
        deck.fix([wire.ends[0] for wire in wires], 4, 4)
        deck.fix([wire.ends[0] for wire in wires], 5, 5)
    return deck.text()


@family
def press(random, number):
    """Two wires cross at any angle from 0 to 90 degrees, are pressed together, and slid along or across each other."""
    deck = Deck(f"pressed {number}", material=(10 ** random.uniform(9.5, 11.3), 0.3))
    r, q = 10 ** random.uniform(-4, -3), 1.0
    q = r * random.uniform(0.4, 1.6)
    laws(random, deck, r)
    angle, half = np.radians(random.uniform(0, 90)), random.uniform(20, 60) * r
    gap = random.uniform(0, 3) * r
    n, m = (int(k) for k in random.integers(1, 15, 2))
    off = random.uniform(-0.4, 0.4, 2) * half
    a = deck.wire(uneven(random, (-half, 0, 0), (half, 0, 0), n), r, element(random))
    centre = np.array([off[0], 0, r + q + gap]) - off[1] * direction(angle)
    b = deck.wire(
        uneven(random, centre - half * direction(angle), centre + half * direction(angle), m), q, element(random)
    )
    deck.fix(a.ends, 1, 6)
    deck.fix(b.ends, 4, 6)
    first = first_increment(random)
    down = -(gap + random.uniform(0.2, 12) * r)
    deck.step([(b.ends, 1, 0), (b.ends, 2, 0), (b.ends, 3, down)], first)
    if random.uniform() < 0.6:
        slide = random.uniform(-0.6, 0.6, 2) * half
        deck.step([(b.ends, 1, slide[0]), (b.ends, 2, slide[1])], first_increment(random))
    return deck.text()


@family
def turn(random, number):
    """A wire above another is lowered and turned about the upright axis, also through parallel."""
    deck = Deck(f"turned {number}", material=(10 ** random.uniform(9.5, 11.3), 0.3))
    if number == 0:
        r = q = 0.5e-3
        start, end, half, gap, down, first, n, m = 11.5, 34.0, 25e-3, 1e-3, 2.5e-3, None, 10, 10
    elif number == 1:
        r = q = 0.5e-3
        start, end, half, gap, down, first, n, m = 40.0, -40.0, 25e-3, 0.1e-3, 1e-3, None, 10, 10
    elif number == 2:
        r, q = 0.5e-3, 0.5e-3
        start, end, half, gap, down, first, n, m = 10.0, 29.0, 25e-3, 2e-3, 9e-3, None, 8, 8
    else:
        r = 10 ** random.uniform(-4, -3)
        q = r * random.uniform(0.5, 1.5)
        laws(random, deck, r)
        start = random.uniform(0, 90)
        end = start + random.uniform(-120, 120)
        half, gap, down = random.uniform(20, 60) * r, random.uniform(0, 4) * r, 0.0
        down = gap + random.uniform(-1, 8) * r
        first = first_increment(random)
        n, m = (int(k) for k in random.integers(2, 13, 2))
    kind = element(random)
    a = deck.wire(straight((-half, 0, 0), (half, 0, 0), n), r, kind)
    centre = np.array([0, random.uniform(-0.2, 0.2) * half, r + q + gap])
    along = direction(np.radians(start))
    points = straight(centre - half * along, centre + half * along, m)
    b = deck.wire(points, q, kind)
    deck.fix(a.ends, 1, 6)
    deck.fix(b.ends, 4, 5)
    # small turns: the ends move on chords of the circle
    pieces = 1 if abs(end - start) < 60 else 2
    for k in range(pieces):
        angle = np.radians(end - start) * (k + 1) / pieces
        shift = turned_by(points, centre, angle)
        shift[:, 2] -= down * (k + 1) / pieces
        moves = [([node], d + 1, shift[at, d]) for node, at in zip(b.ends, (0, -1), strict=True) for d in range(3)]
        moves += [(b.ends, 6, angle)]
        deck.step(moves, first)
    return deck.text()


@family
def aside(random, number):
    """A wire held at one end or at both is pushed far aside by a crossing one: slopes, ends and meshes at random."""
    deck = Deck(f"pushed aside {number}", material=(10 ** random.uniform(10, 11.3), 0.3))
    r = 10 ** random.uniform(-3.7, -3)
    q = r * random.uniform(0.7, 2)
    laws(random, deck, r)
    length = random.uniform(100, 400) * r
    n = int(random.integers(4, 40))
    kind = element(random)
    a = deck.wire(uneven(random, (0, 0, 0), (length, 0, 0), n), r, kind)
    deck.fix(a.nodes[:1], 1, 6)
    if random.uniform() < 0.3:
        deck.fix(a.nodes[-1:], 2, 4)
    tilt = np.radians(random.uniform(-50, 50))
    along = np.array([np.sin(tilt), 0, np.cos(tilt)])
    at = np.array([random.uniform(0.3, 0.85) * length, r + q + random.uniform(0, 5) * r, 0])
    half = random.uniform(20, 60) * r
    b = deck.wire(
        straight(at - half * along, at + half * along, int(random.integers(1, 6))), q, kind, material=(200e9, 0.3)
    )
    deck.fix(b.ends, 3, 6)
    push = [(b.ends, 2, -random.uniform(0.1, 0.35) * length)]
    if random.uniform() < 0.4:
        push.append((b.ends, 1, random.uniform(-0.15, 0.15) * length))
    else:
        deck.fix(b.ends, 1, 1)
    deck.step(push, first_increment(random))
    return deck.text()


@family
def parallel(random, number):
    """Wires that are parallel or nearly so are pushed through each other, sideways or down."""
    deck = Deck(f"side by side {number}", material=(10 ** random.uniform(10, 11.3), 0.3))
    if number < 2:
        r = q = 1e-3
        angle, half, away, push, first, n = 0.0, 40e-3, 4e-3, 8e-3, None, 8 - 7 * number
        height = 0.0
    else:
        r = 10 ** random.uniform(-4, -3)
        q = r * random.uniform(0.6, 1.4)
        laws(random, deck, r)
        angle = np.radians(pick(random, 0, random.uniform(0, 3), random.uniform(3, 14)))
        half = random.uniform(20, 50) * r
        away = r + q + half * np.sin(angle) + random.uniform(0.2, 4) * r
        push = away + random.uniform(-2, 6) * r
        height, first, n = (
            pick(random, 0, random.uniform(-1, 1) * r),
            first_increment(random),
            int(random.integers(1, 12)),
        )
    kind = element(random)
    a = deck.wire(straight((-half, 0, 0), (half, 0, 0), n), r, kind)
    along = direction(angle)
    centre = np.array([0, away, height])
    b = deck.wire(straight(centre - half * along, centre + half * along, n), q, kind)
    deck.fix(a.ends, 1, 6)
    deck.fix(b.ends, 1, 1)
    deck.fix(b.ends, 3, 6)
    deck.step([(b.ends, 2, -push)], first)
    return deck.text()


@family
def kink(random, number):
    """Polylines, wires like a V, zigzags: pressed with a corner on a rod, or with a leg."""
    deck = Deck(f"kinked {number}", material=(10 ** random.uniform(10, 11.3), 0.3))
    r = 10 ** random.uniform(-3.7, -3)
    q = r * random.uniform(0.7, 1.5)
    laws(random, deck, r)
    deck.axis = pick(random, "LINEAR", "HERMITE")
    half = random.uniform(20, 50) * r
    rise = np.tan(np.radians(random.uniform(5, 50))) * half
    n = int(random.integers(1, 5))
    shape = pick(random, "v", "v", "zigzag")
    if number == 0:
        r = q = 0.5e-3
        half, rise, n, shape, deck.axis, deck.law = 20e-3, 10e-3, 3, "v", "HERMITE", "HERTZ"
    if shape == "v":
        points = np.concatenate([straight((-half, 0, rise), (0, 0, 0), n), straight((0, 0, 0), (half, 0, rise), n)[1:]])
    else:
        corners = np.array([(-half, 0, 0), (-half / 3, 0, rise / 3), (half / 3, 0, 0), (half, 0, rise / 3)])
        legs = [straight(p, s, n)[:-1] for p, s in itertools.pairwise(corners)]
        points = np.concatenate([*legs, corners[-1:]])
    kind = element(random)
    points[:, 2] += r + q + random.uniform(0, 2) * r - points[:, 2].min()
    a = deck.wire(points, r, kind)
    at = 0 if number == 0 else pick(random, 0, random.uniform(-0.1, 0.1), random.uniform(-0.6, 0.6)) * half
    tilt = np.radians(random.uniform(45, 135)) if number else np.pi / 2
    along = direction(tilt)
    b = deck.wire(
        straight(np.array([at, 0, 0]) - half * along, np.array([at, 0, 0]) + half * along, int(random.integers(1, 8))),
        q,
        kind,
    )
    deck.fix(b.ends, 1, 6)
    deck.fix(a.ends, 4, 6)
    deck.fix(a.ends, 2, 2)
    if random.uniform() < 0.5:
        deck.fix(a.ends, 1, 1)
        moves = [(a.ends, 3, -random.uniform(1, 25) * r)]
    else:
        moves = [(a.ends, 3, -random.uniform(1, 25) * r), (a.ends, 1, random.uniform(-0.3, 0.3) * half)]
    deck.step(moves, first_increment(random) if number else None)
    return deck.text()


@family
def ring(random, number):
    """Rings of few elements on a rod, at a node or between two."""
    deck = Deck(f"ring {number}", material=(10 ** random.uniform(10, 11.3), 0.3))
    r, q, n, turns, big = 0.5e-3, 0.5e-3, 16, 0.0, 10e-3
    push, first = -8e-3, None
    if number >= 3:
        r = 10 ** random.uniform(-3.7, -3)
        q, n = r * random.uniform(0.7, 1.5), int(random.integers(5, 33))
        turns, big = pick(random, 0, 0.5, random.uniform()), random.uniform(10, 40) * r
        push, first = -random.uniform(0.05, 1.2) * big, first_increment(random)
        laws(random, deck, r)
    deck.axis = pick(random, "LINEAR", "HERMITE") if number else "HERMITE"
    angle = 2 * np.pi * (np.arange(n) + turns) / n - np.pi / 2
    centre = np.array([0, 0, big + r + q + 0.1 * r])
    points = centre + big * np.stack([np.cos(angle), 0 * angle, np.sin(angle)], 1)
    kind = element(random)
    a = deck.wire(points, r, kind, closed=True)
    tilt = np.radians(random.uniform(60, 120)) if number >= 3 else np.pi / 2
    b = deck.wire(straight(-2 * big * direction(tilt), 2 * big * direction(tilt), int(random.integers(1, 9))), q, kind)
    deck.fix(b.ends, 1, 6)
    top = [a.nodes[int(np.argmax(points[:, 2]))]]
    deck.fix(top, 1, 2)
    deck.fix(top, 4, 6)
    deck.step([(top, 3, push)], first)
    return deck.text()


@family
def end(random, number):
    """Ends near other wires: pushed down beside them, over them, and along them until they fall off."""
    deck = Deck(f"end {number}", material=(10 ** random.uniform(9.5, 11), 0.3))
    r = 10 ** random.uniform(-3.7, -3)
    q = r * random.uniform(0.7, 1.5)
    laws(random, deck, r)
    length = random.uniform(40, 120) * r
    n = int(random.integers(2, 14))
    over = random.uniform(-2, 8) * r
    kind = element(random)
    # the end of a reaches beyond b by `over`
    a = deck.wire(uneven(random, (0, 0, 0), (length, 0, 0), n), r, kind)
    tilt = np.radians(random.uniform(30, 150))
    along = direction(tilt)
    half = random.uniform(15, 40) * r
    side = pick(random, -1, 1)
    at = np.array([length - over, 0, side * (r + q + random.uniform(0, 2) * r)])
    shift = pick(random, 0, 0, random.uniform(-0.95, 0.95)) * half * along
    b = deck.wire(straight(at + shift - half * along, at + shift + half * along, int(random.integers(1, 6))), q, kind)
    deck.fix(a.nodes[:1], 1, 6)
    deck.fix(b.ends, 4, 6)
    towards = -side * random.uniform(2, 20) * r
    deck.fix(b.ends, 2, 2)
    deck.step([(b.ends, 3, towards), (b.ends, 1, 0)], first_increment(random))
    deck.step([(b.ends, 1, random.uniform(-12, 12) * r)], first_increment(random))
    return deck.text()


@family
def tips(random, number):
    """Ends against ends: two cantilevers whose tips cross, the one pushed past the other; or sideways into it."""
    deck = Deck(f"tips {number}", material=(10 ** random.uniform(9.5, 11), 0.3))
    r = 10 ** random.uniform(-3.7, -3)
    q = r * random.uniform(0.7, 1.5)
    laws(random, deck, r)
    length, n = random.uniform(40, 100) * r, int(random.integers(2, 12))
    tilt = np.radians(random.uniform(20, 160))
    kind = element(random)
    a = deck.wire(straight((0, 0, 0), (length, 0, 0), n), r, kind)
    tip = np.array([length - random.uniform(-1, 10) * r, 0, 0]) + random.uniform(-1, 10) * r * direction(tilt)
    tip[2] = r + q + random.uniform(0.05, 2) * r
    b = deck.wire(straight(tip - length * direction(tilt), tip, n), q, kind)
    deck.fix(a.nodes[:1], 1, 6)
    deck.fix(b.nodes[:1], 4, 6)
    moves = [(b.nodes[:1], 3, -random.uniform(2, 25) * r)]
    if random.uniform() < 0.5:
        moves += [(b.nodes[:1], 1, random.uniform(-10, 10) * r), (b.nodes[:1], 2, random.uniform(-10, 10) * r)]
    else:
        deck.fix(b.nodes[:1], 1, 2)
    deck.step(moves, first_increment(random))
    return deck.text()


@family
def hairpin(random, number):
    """A hairpin, pushed with its bend or its legs across a wire, or closed until its legs touch."""
    deck = Deck(f"hairpin {number}", material=(10 ** random.uniform(9, 11), 0.3))
    r = 10 ** random.uniform(-3.7, -3)
    laws(random, deck, r)
    gap, leg = random.uniform(4, 10) * r, random.uniform(20, 60) * r
    n, m = int(random.integers(3, 9)), int(random.integers(4, 12))
    arc = np.linspace(np.pi / 2, -np.pi / 2, m + 1)
    bend = np.stack([leg + gap * np.cos(arc), gap * np.sin(arc), 0 * arc], 1)
    points = np.concatenate(
        [straight((0, gap, 0), (leg, gap, 0), n)[:-1], bend, straight((leg, -gap, 0), (0, -gap, 0), n)[1:]]
    )
    kind = element(random)
    a = deck.wire(points, r, kind)
    task = pick(random, "close", "cross", "bend") if number > 2 else ("close", "cross", "bend")[number]
    first = first_increment(random)
    deck.fix(a.ends, 3, 6)
    if task == "close":
        # the legs cross over each other or are pressed together
        deck.fix(a.ends, 1, 1)
        by = (gap - r) + random.uniform(0, 6) * r
        deck.fixed = [line for line in deck.fixed if not line.endswith("3, 6")]
        deck.fix(a.ends, 4, 6)
        lift = pick(random, 0, random.uniform(0.5, 2.5)) * r
        deck.step([(a.ends[:1], 3, lift), (a.ends[1:], 3, -lift), (a.ends[:1], 2, -by), (a.ends[1:], 2, by)], first)
        return deck.text()
    q = r * random.uniform(0.7, 1.5)
    if task == "cross":
        at = np.array([random.uniform(0.3, 1.02) * leg, 0, r + q + random.uniform(0, 2) * r])
        along = direction(np.radians(random.uniform(60, 120)))
        moves = [(3, -random.uniform(2, 20) * r), (1, 0), (2, 0)]
    else:
        at = np.array([leg + gap + r + q + random.uniform(0, 2) * r, random.uniform(-0.5, 0.5) * gap, 0])
        along = np.array([0, np.sin(0.3), np.cos(0.3)])
        moves = [(1, -random.uniform(2, 20) * r), (2, 0), (3, 0)]
    half = random.uniform(2, 4) * gap
    b = deck.wire(straight(at - half * along, at + half * along, int(random.integers(1, 8))), q, kind)
    deck.fix(a.ends, 1, 2)
    deck.fix(b.ends, 4, 6)
    deck.step([(b.ends, d, value) for d, value in moves], first)
    return deck.text()


@family
def loop(random, number):
    """A wire with a loop, that is pulled tight or pressed: it touches itself."""
    deck = Deck(f"loop {number}", material=(10 ** random.uniform(9, 11), 0.3))
    r = 10 ** random.uniform(-3.7, -3)
    laws(random, deck, r)
    big, n = random.uniform(12, 35) * r, int(random.integers(12, 40))
    rise = random.uniform(2.2, 5) * r
    leg = random.uniform(20, 40) * r
    arc = np.linspace(-np.pi / 2, 3 * np.pi / 2, n + 1)
    circle = np.stack([big * np.cos(arc), big + big * np.sin(arc), rise * np.linspace(-0.5, 0.5, n + 1)], 1)
    k = int(random.integers(2, 6))
    points = np.concatenate(
        [straight((-leg, 0, -rise / 2), circle[0], k)[:-1], circle, straight(circle[-1], (leg, 0, rise / 2), k)[1:]]
    )
    a = deck.wire(points, r, element(random))
    deck.fix(a.ends, 2, 2)
    deck.fix(a.ends, 4, 6)
    task = random.uniform()
    first = first_increment(random)
    if task < 0.5:
        pull = random.uniform(0.1, 1.5) * big
        deck.fix(a.ends, 3, 3)
        deck.step([(a.ends[:1], 1, -pull), (a.ends[1:], 1, pull)], first)
    else:
        press = rise / 2 + random.uniform(-1, 4) * r
        deck.fix(a.ends, 1, 1)
        deck.step([(a.ends[:1], 3, press), (a.ends[1:], 3, -press)], first)
    return deck.text()


@family
def knot(random, number):
    """A trefoil that is opened at one place, and pulled: an overhand knot."""
    deck = Deck(f"knot {number}", material=(10 ** random.uniform(9, 10.5), 0.3))
    n = int(random.integers(24, 60))
    s = np.linspace(0.12, 2 * np.pi - 0.12, n + 1) + np.pi / 3
    size = 1e-2
    points = size * np.stack(
        [np.sin(s) + 2 * np.sin(2 * s), np.cos(s) - 2 * np.cos(2 * s), -random.uniform(0.6, 1.2) * np.sin(3 * s)], 1
    )
    r = size * random.uniform(0.1, 0.25)
    laws(random, deck, r)
    deck.friction = 0.0
    a = deck.wire(points, r, element(random))
    deck.fix(a.ends, 4, 6)
    away = points[-1] - points[0]
    away /= np.linalg.norm(away)
    # the ends go away from each other and outwards
    out = (points[0] + points[-1]) / 2
    out /= np.linalg.norm(out)
    pull = random.uniform(1, 8) * r
    moves = []
    for node, side in zip(a.ends, (-1, 1), strict=True):
        shift = pull * (side * away + random.uniform(0, 1.5) * out)
        moves += [([node], d + 1, shift[d]) for d in range(3)]
    deck.step(moves, first_increment(random))
    return deck.text()


@family
def coil(random, number):
    """A coil, open or nearly closed, that is pressed together, bent over or twisted until its turns touch."""
    deck = Deck(f"coil {number}", material=(10 ** random.uniform(9, 11), 0.3))
    r = 10 ** random.uniform(-3.7, -3)
    laws(random, deck, r)
    if deck.law != "HERTZ":
        # turns touch along lines: a second number
        deck.law += f", {float(deck.law) / r * random.uniform(0.5, 5):.4g}"
    deck.axis = "HERMITE"
    size, gap = random.uniform(1.5, 8) * r, random.uniform(0.1, 1.5) * r
    n, turns = int(random.integers(19, 30)), random.uniform(1.5, 4)
    angle = np.linspace(0, 2 * np.pi * turns, int(n * turns) + 1)
    pitch = (2 * r + gap) / np.cos(np.arctan(2 * r / (2 * np.pi * size)))
    points = np.stack([size * np.cos(angle), size * np.sin(angle), pitch * angle / (2 * np.pi)], 1)
    a = deck.wire(points, r, element(random))
    first, last = a.ends
    deck.fix([first], 1, 6)
    close = random.uniform(0.3, 1.1) * gap * turns
    task = pick(random, "press", "bend", "twist")
    moves = [([last], 1, 0), ([last], 2, 0), ([last], 3, -close)]
    if task == "bend":
        moves = [([last], 1, random.uniform(0.5, 3) * r), ([last], 2, 0), ([last], 3, -0.7 * close)]
    turned = random.uniform(-1, 1) if task == "twist" else 0.0
    moves += [([last], 4, 0), ([last], 5, 0), ([last], 6, turned)]
    deck.step(moves, first_increment(random))
    return deck.text()


@family
def bent(random, number):
    """Coarse wires that bend strongly, and cross a straight one twice with one element."""
    deck = Deck(f"bent {number}", material=(10 ** random.uniform(9.5, 11), 0.3))
    r = 0.5e-3 if number == 0 else 10 ** random.uniform(-3.7, -3)
    q = r * random.uniform(0.6, 1.2)
    if number:
        laws(random, deck, r)
    deck.axis = "HERMITE"
    length = random.uniform(40, 90) * r
    n = int(random.integers(1, 4)) if number else 1
    angle = np.radians(random.uniform(20, 70)) if number else np.radians(46)
    kind = element(random)
    a = deck.wire(straight((-length / 2, 0, 0), (length / 2, 0, 0), n), r, kind)
    # the bow of a reaches through the straight wire below it, or comes down on it
    bow = length * angle / 8
    height = r + q + random.uniform(-0.6, 1.0) * bow
    height = max(height, r + q + 0.05 * r)
    skew = np.radians(random.uniform(0, 25)) if number else 0.0
    at = np.array([0, 0, -height])
    along = direction(skew)
    b = deck.wire(straight(at - 0.7 * length * along, at + 0.7 * length * along, int(random.integers(1, 6))), q, kind)
    deck.fix(b.ends, 1, 6)
    deck.fix(a.ends, 1, 4)
    deck.fixed = [line for line in deck.fixed if not (line.startswith(f" {a.ends[1]},") and "1, 4" in line)]
    deck.fix(a.ends[1:], 2, 4)
    deck.fix(a.ends, 6, 6)
    deck.step([(a.ends[:1], 5, angle / 2), (a.ends[1:], 5, -angle / 2)], first_increment(random))
    deck.step([(a.ends, 3, -random.uniform(0, 1.5) * bow)], first_increment(random))
    return deck.text()


@family
def soft(random, number):
    """Penalties that are too soft for the forces."""
    deck = Deck(f"soft {number}")
    r = 0.5e-3
    deck.law = ("10", "100", "1000")[number] if number < 3 else f"{10 ** random.uniform(0.5, 4.5):.4g}"
    half = random.uniform(15e-3, 40e-3)
    angle = np.radians(random.uniform(20, 90)) if number else np.pi / 2
    n = int(random.integers(1, 12))
    a = deck.wire(straight((-half, 0, 0), (half, 0, 0), n), r, element(random))
    centre = np.array([0.1 * half, 0, 2 * r + random.uniform(0, 1) * r])
    b = deck.wire(straight(centre - half * direction(angle), centre + half * direction(angle), n), r, element(random))
    deck.fix(a.ends, 1, 6)
    deck.fix(b.ends, 1, 2)
    deck.fix(b.ends, 4, 6)
    deck.step([(b.ends, 3, -random.uniform(1, 12) * r)], first_increment(random))
    return deck.text()


@family
def load(random, number):
    """Forces and moments press a cantilever against others."""
    deck = Deck(f"loaded {number}", material=(10 ** random.uniform(9.5, 11), 0.3))
    r = 10 ** random.uniform(-3.7, -3)
    laws(random, deck, r)
    length, n = random.uniform(40, 120) * r, int(random.integers(3, 14))
    kind = element(random)
    a = deck.wire(straight((0, 0, 0), (length, 0, 0), n), r, kind)
    below = -r
    for _ in range(int(random.integers(1, 4))):
        q = r * random.uniform(0.5, 1.5)
        tilt = np.radians(random.uniform(35, 145))
        below -= random.uniform(0.01, 3) * r + 2 * q
        at = np.array([random.uniform(0.25, 0.9) * length, 0, below + q])
        half = random.uniform(15, 40) * r
        b = deck.wire(
            straight(at - half * direction(tilt), at + half * direction(tilt), int(random.integers(1, 8))), q, kind
        )
        deck.fix(b.ends, 1, 6)
    deck.fix(a.nodes[:1], 1, 6)
    # the force that bends the cantilever by `way`
    stiffness = 3 * deck.material[0] * np.pi * r**4 / 4 / length**3
    force = -stiffness * random.uniform(2, 0.4 * length / r) * r
    loads = [(a.nodes[-1:], 3, force)]
    if random.uniform() < 0.4:
        loads.append((a.nodes[-1:], 2, force * random.uniform(-0.7, 0.7)))
    if random.uniform() < 0.3:
        loads.append((a.nodes[-1:], 5, force * length * random.uniform(-0.3, 0.3)))
    deck.step([], first_increment(random), loads)
    return deck.text()


@family
def weave(random, number):
    """Fabrics and mats of litz.build."""
    from litz import build

    if number == 0:
        model = build.woven_fabric(4, 4, pitch=2e-3, radius=0.25e-3)
    elif number % 2:
        model = build.woven_fabric(
            int(random.integers(2, 4)), int(random.integers(2, 4)), pitch=random.uniform(1.6e-3, 3e-3), radius=0.25e-3
        )
    else:
        model = build.fibre_mat(
            (6e-3, 6e-3),
            3,
            radius=0.1e-3,
            seed=number,
            n_layers=2,
            clearance=5e-6,
            n_elements=int(random.integers(4, 9)),
        )
    model.press(40e-6 if number == 0 else random.uniform(5e-6, 50e-6), voltage=1e-3)
    return model.to_deck()
