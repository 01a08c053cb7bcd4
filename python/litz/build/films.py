"""Films of straight nanowires between two electrodes."""

import math

import numpy as np
from numpy.typing import NDArray

from ..model import HERTZ_AND_HOLM, SILVER, Interaction, Material, Model, straight
from .geometry import end_distance, rounded, segment_distance

#: Random places tried for each wire before the film counts as full
_TRIES = 400
#: Minimum distance of the end of a wire from any other wire, seen from above [radii]
_MARGIN = 4.0


def nanowire_film(
    size: tuple[float, float],
    n_wires: int,
    *,
    length: float,
    radius: float,
    seed: int,
    clearance: float | None = None,
    smallest_angle: float = math.radians(15),
    n_elements: int = 12,
    material: Material = SILVER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
) -> Model:
    """Straight nanowires dropped at random on a plane, with an electrode at each end of the film.

    Centres and directions in the plane are uniform. Each wire comes to lie level, above all wires dropped before that it
    crosses; it does not sag. No end lies on another wire: it is four radii away, seen from above. Wires are cut where they
    leave the film; the cut ends at x = 0 and x = size[0] are the electrodes. All ends are held in the plane and follow a
    pressing according to their height (`model.press`).

    Parameters
    ----------
    size : tuple of float
        Length along x, between the electrodes, and width along y [m].
    n_wires : int
        Number of wires.
    length, radius : float
        Length of a wire that is not cut, and its radius [m].
    seed : int
        Seed of the random numbers: the same seed and arguments give the same model.
    clearance : float, optional
        Gap at the highest crossing below each wire [m]; a hundredth of the radius when left out.
    smallest_angle : float
        Wires that cross do so at this angle or more [rad], others are dropped anew: contacts are points.
    n_elements : int
        Elements of each wire.
    material, interaction, element
        What the wires are made of, the laws of their contacts, type of the elements.

    Returns
    -------
    Model
        Group FILM; node sets MINUS (x = 0) and PLUS (x = size[0]).

    Raises
    ------
    ValueError
        For arguments out of range, when the wires do not fit, and when an electrode touches no wire.

    Notes
    -----
    Wires that lie directly on each other touch first, others the later the more levels are between them: a film conducts
    well when it is pressed by 0.8 to 0.95 of `model.height`. Nearly flat it becomes stiff, and a run may give up.

    Spots of nanowires are smaller than the mean free path of the electrons, 53 nm in silver. Their resistance is then that of
    Sharvin, `4 rho l/(3 A)` for the area A, where the product of resistivity and free path, `rho l`, is a constant
    of the metal: 8.46e-16 ohm m^2 for silver (Gall, J. Appl. Phys. 119, 085101, 2016). That is the law of a film:
    `litz.FilmSpot(4 / 3 * 8.46e-16)`; `HertzSpot` alone gives a small part of it.

    Examples
    --------
    >>> import litz
    >>> spots = litz.Interaction("TOUCH", conductance=litz.FilmSpot(4 / 3 * 8.46e-16))
    >>> film = nanowire_film((20e-6, 20e-6), 40, length=10e-6, radius=30e-9, seed=1, interaction=spots)
    >>> step = film.press(0.9 * film.height, voltage=1e-3)
    """
    if n_wires < 1 or not radius > 0 or not length > 4 * radius or not min(size) > 4 * radius:
        raise ValueError("a film needs wires of positive radius; wires and film must be longer than two diameters")
    clearance = radius / 100 if clearance is None else clearance
    if not clearance > 0:
        raise ValueError(f"clearance must be greater than 0, not {clearance:g}")
    ends = _drop(np.random.default_rng(seed), n_wires, np.array(size, dtype=float), length, radius, smallest_angle)
    heights = _pile_up(ends, 2 * radius + clearance)
    model = Model(f"Film of {n_wires} nanowires, seed {seed}")
    axes = [
        rounded(straight([*start, z], [*end, z], n_elements), max(size))
        for (start, end), z in zip(ends, heights, strict=True)
    ]
    model.wires("FILM", axes, radius=radius, material=material, element=element)
    _hold(model, heights)
    model.height = float(heights.max())
    x = model.x
    cut = {
        name: [node for node in model.groups["FILM"].ends if abs(x[node - 1, 0] - wall) < 1e-6 * size[0]]
        for name, wall in (("MINUS", 0.0), ("PLUS", size[0]))
    }
    if not all(cut.values()):
        raise ValueError("no wire reaches one of the electrodes: use more or longer wires, or another seed")
    for name, nodes in cut.items():
        model.node_set(name, nodes)
    model.contact("FILM", interaction=interaction)
    return model


def _drop(
    rng: np.random.Generator, n_wires: int, size: NDArray, length: float, radius: float, smallest_angle: float
) -> NDArray[np.float64]:
    """Ends of the wires in the plane, (n_wires, 2, 2)."""
    placed = np.empty((n_wires, 2, 2))
    count = 0
    for _ in range(_TRIES * n_wires):
        middle, angle = rng.uniform(size=2) * size, rng.uniform(0, math.pi)
        half = length / 2 * np.array([math.cos(angle), math.sin(angle)])
        ends = _inside(middle, half, size)
        # what the wall leaves of a wire must reach beyond a crossing at both sides
        if np.linalg.norm(ends[1] - ends[0]) < 2 * _MARGIN * radius:
            continue
        others = placed[:count]
        first, second = (np.broadcast_to(end, (count, 2)) for end in ends)
        if (end_distance(first, second, others[:, 0], others[:, 1]) < _MARGIN * radius).any():
            continue
        turn = _cross(ends[1] - ends[0], others[:, 1] - others[:, 0])
        lengths = np.linalg.norm(ends[1] - ends[0]) * np.linalg.norm(others[:, 1] - others[:, 0], axis=1)
        if (_crosses(ends, others) & (np.abs(turn) < math.sin(smallest_angle) * lengths)).any():
            continue
        placed[count] = ends
        count += 1
        if count == n_wires:
            return placed
    raise ValueError(
        f"only {count} of {n_wires} wires fit into the film with crossings of the smallest angle, away from their ends"
    )


def _inside(middle: NDArray, half: NDArray, size: NDArray) -> NDArray[np.float64]:
    """The part of a wire that lies inside the film."""
    with np.errstate(divide="ignore"):
        walls = np.sort([-middle / half, (size - middle) / half], axis=0)
    first, last = max(-1.0, walls[0].max()), min(1.0, walls[1].min())
    return np.clip([middle + first * half, middle + last * half], 0, size)


def _pile_up(ends: NDArray, pitch: float) -> NDArray[np.float64]:
    """Height of each wire: one pitch above the highest wire below it, or on the ground."""
    level = np.zeros(len(ends), dtype=int)
    for wire in range(1, len(ends)):
        below = level[:wire][_near(ends[wire], ends[:wire], pitch)]
        level[wire] = below.max() + 1 if len(below) else 0
    return level * pitch


def _near(wire: NDArray, others: NDArray, distance: float) -> NDArray[np.bool_]:
    """Which of the others (n, 2, 2) come nearer to a wire (2, 2) than a distance, in the plane."""
    first, second = (np.broadcast_to(end, (len(others), 2)) for end in wire)
    return segment_distance(first, second, others[:, 0], others[:, 1]) < distance


def _crosses(wire: NDArray, others: NDArray) -> NDArray[np.bool_]:
    """Which of the others (n, 2, 2) a wire (2, 2) crosses in the plane."""

    def apart(a: NDArray, b: NDArray, first: NDArray, second: NDArray) -> NDArray:
        return _cross(b - a, first - a) * _cross(b - a, second - a) < 0

    first, last = wire
    return apart(first, last, others[:, 0], others[:, 1]) & apart(others[:, 0], others[:, 1], first, last)


def _cross(u: NDArray, v: NDArray) -> NDArray[np.float64]:
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def _hold(model: Model, heights: NDArray) -> None:
    """All ends in the plane, with heights that follow a pressing, and one spin of each wire."""
    group, x = model.groups["FILM"], model.x
    model.fix(model.node_set("ENDS", group.ends), "x", "y")
    top = max(heights.max(), np.finfo(float).tiny)
    for level, height in enumerate(np.unique(heights)):
        name = f"LEVEL{level}_ENDS"
        model.node_set(
            name, [node for wire, z in zip(group.wires, heights, strict=True) if z == height for node in wire.ends]
        )
        model.guides[name] = float(f"{height / top:.9g}")
    for wire in group.wires:
        along = np.abs(x[wire.nodes[-1] - 1] - x[wire.nodes[0] - 1])
        spin = 4 + int(np.argmax(along[:2]))
        model.fix(wire.nodes[0], spin)
