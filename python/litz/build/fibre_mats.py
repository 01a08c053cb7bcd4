"""Random mats of straight fibres between two electrodes."""

import itertools
import math
from collections.abc import Callable
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..model import COPPER, HERTZ_AND_HOLM, Interaction, Material, Model, straight
from .deposition import DEFAULT_ELEMENTS, SLACK, Piled, Rules, build, check_reach, deposit
from .frame import add_plate, evenly, hold_in_frame, parallel_bars, unit
from .geometry import clip_line, crossing_angle, end_distance, rounded, segment_distance, sides

#: Random fibres tried per placed fibre before the mat counts as full
_TRIES = 400
#: Of deposited fibres: reach, and distance of the ends from fibres that they come near to, seen from above [radii]
_REACH, _MARGIN = 15.0, 2.5
#: Length of the elements of a plate over the radius of its bars
_BAR_ELEMENT = 5.0


def fibre_mat(
    size: tuple[float, float, float] | tuple[float, float],
    n_fibres: int,
    *,
    radius: float,
    seed: int,
    orientation: Literal["layered", "isotropic", "deposited"] = "layered",
    length: float | None = None,
    reach: float | None = None,
    n_layers: int = 4,
    spread: float = math.radians(30),
    clearance: float | None = None,
    overlap: bool = False,
    smallest_angle: float = math.radians(20),
    n_elements: int | None = None,
    n_bars: int = 6,
    bar_radius: float | None = None,
    material: Material = COPPER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
) -> Model:
    """Random mat of fibres, to be pressed along z.

    Layered: `n_layers` layers of level fibres, each turned by 90 degrees against the one below with a random deviation
    up to `spread`; fibres of one layer do not touch. Below and above lie the electrodes, plates of parallel rigid bars
    of one potential.
    The ends of the fibres are held in a frame that follows the pressing according to their height: without friction,
    fibres with free ends would slide off each other. Fibres may touch those of the layers above and below; those of one
    layer do not touch at the start and are assumed not to touch later, as are those of layers that are not neighbours.

    Isotropic: lines of all directions in space, cut off by the walls of the box. The ends at the bottom and at the top
    are the electrodes. All ends follow the pressing according to their height and are held in the plane (they do not slide
    along the walls); there are no plates.

    Deposited: fibres of a length fall on a plane one after the other, as in paper, with random middles and directions. Each bends
    over those that it comes to lie on, so that any number fits. They are cut off at the edges; their ends at
    x = 0 and x = size[0] are the electrodes. All ends follow the pressing according to their height and are held in the plane;
    there are no plates.

    Parameters
    ----------
    size : tuple of float
        Sides of the box along x, y and z [m]. The height of a layered or deposited mat follows from its fibres: x and y only.
    n_fibres : int
        Number of fibres; in a layered mat that of each layer.
    radius : float
        Radius of the fibres [m].
    seed : int
        Seed of the random numbers: the same seed and arguments give the same model.
    orientation : {"layered", "isotropic", "deposited"}
        Kind of mat.
    length : float
        Length of the fibres of a deposited mat [m].
    reach : float, optional
        Length over which a deposited fibre bends down from what it lies on [m], at least ten radii; 15 radii when left out.
    n_layers : int
        Layers of a layered mat.
    spread : float
        Largest deviation of a fibre from the direction of its layer [rad], at most `(pi/2 - smallest_angle)/2`
        between neighbouring layers that turn by 90 degrees.
    clearance : float, optional
        Smallest gap between the surfaces of fibres [m]; a tenth of the radius when left out. In a layered mat also the
        gap between the layers, and between the layers and the bars.
    overlap : bool
        Fibres of an isotropic mat may overlap at the start; the contact pair is then an interference fit.
    smallest_angle : float
        Fibres that come within two radii of touching cross at this angle or more [rad]: contacts are points.
    n_elements : int, optional
        Elements of each fibre. Left out: 12; of deposited fibres as many as are not longer than half the reach.
    n_bars : int
        Bars of each plate of a layered mat.
    bar_radius : float, optional
        Radius of the bars [m]; that of the fibres when left out.
    material, interaction, element
        What fibres and bars are made of, the laws of their contacts, type of the elements.

    Returns
    -------
    Model
        Node sets PLUS (upper electrode) and MINUS (lower electrode); element set WIRES (all). Layered: groups LAYER1,
        LAYER2, ... from below, PLATE_BOTTOM and PLATE_TOP. Isotropic and deposited: group FIBRES. `model.press` adds the step.

    Raises
    ------
    ValueError
        For arguments out of range, and when the fibres do not fit without overlap.
    """
    box = sides(size, "xyz" if orientation == "isotropic" else "xy", f"a mat, {orientation}")
    if n_fibres < 1 or not radius > 0 or not min(box) > 4 * radius:
        raise ValueError("a mat needs fibres of positive radius in a box with sides of more than two diameters")
    clearance = radius / 10 if clearance is None else clearance
    if not (overlap or clearance > 0):
        raise ValueError(f"clearance must be greater than 0, not {clearance:g}")
    if orientation != "deposited" and not (length is reach is None):
        raise ValueError("length and reach are for deposited mats")
    rng = np.random.default_rng(seed)
    n_straight = DEFAULT_ELEMENTS if n_elements is None else n_elements
    fibre: dict[str, Any] = {"radius": radius, "material": material, "element": element}
    if orientation == "layered":
        _check_layers(n_layers, spread, smallest_angle, overlap)
        model = Model(f"Layered mat of {n_layers} x {n_fibres} fibres, seed {seed}")
        layers = {"n_layers": n_layers, "n_fibres": n_fibres, "spread": spread, "clearance": clearance}
        bars = {"number": n_bars, "radius": radius if bar_radius is None else bar_radius}
        _stack(model, rng, box, fibre, layers, bars, n_straight)
        model.element_set("WIRES", list(model.groups))
        names = ["PLATE_BOTTOM", *(f"LAYER{number}" for number in range(1, n_layers + 1)), "PLATE_TOP"]
        for pair in itertools.pairwise(names):
            model.contact(*pair, interaction=interaction)
    elif orientation == "isotropic":
        model = Model(f"Isotropic mat of {n_fibres} fibres, seed {seed}")
        distance = -math.inf if overlap else 2 * radius + clearance
        ends = _isotropic(rng, n_fibres, box, distance, 4 * radius, smallest_angle)
        model.wires("FIBRES", [rounded(straight(start, end, n_straight), max(box)) for start, end in ends], **fibre)
        _hold_isotropic(model, box[2])
        model.height = float(box[2])
        model.element_set("WIRES", list(model.groups))
        model.contact("WIRES", interaction=interaction, interference_fit=overlap)
    elif orientation == "deposited":
        length = _checked_length(length, radius, overlap)
        reach = _REACH * radius if reach is None else reach
        check_reach(reach, radius, length)
        rules = Rules(box, length, radius, smallest_angle, _MARGIN * radius)
        title = f"Deposited mat of {n_fibres} fibres, seed {seed}"
        model = _deposited(title, n_fibres, rules, reach, clearance, seed, n_elements, fibre, interaction)
    else:
        raise ValueError(f'orientation must be "layered", "isotropic" or "deposited", not {orientation!r}')
    return model


def _check_layers(n_layers: int, spread: float, smallest_angle: float, overlap: bool) -> None:
    """Refuse what layers cannot be."""
    if n_layers < 1:
        raise ValueError(f"n_layers must be 1 or more, not {n_layers}")
    if overlap:
        raise ValueError("a layered mat has no overlap")
    if not 0 <= 2 * spread <= math.pi / 2 - smallest_angle:
        raise ValueError("spread must be between 0 and half of (90 degrees minus the smallest angle)")


def _checked_length(length: float | None, radius: float, overlap: bool) -> float:
    """The length of deposited fibres [m]."""
    if length is None or not length > 4 * radius or overlap:
        raise ValueError("a deposited mat needs a length of more than two diameters; it has no overlap")
    return length


def _deposited(
    title: str, n_fibres: int, rules: Rules, reach: float, clearance: float, seed: int, n_elements: int | None,
    fibre: dict[str, Any], interaction: Interaction,
) -> Model:  # fmt: skip
    """Fibres that have fallen on each other."""

    def pile(gap: float) -> Piled:
        distance = 2 * rules.radius + gap
        return deposit(
            np.random.default_rng(seed), n_fibres, rules,
            distance=distance, slack=SLACK * clearance, reach=reach, n_elements=n_elements,
        )  # fmt: skip

    size = rules.size
    model = build(
        title, "FIBRES", pile, clearance=clearance, length=float(size[0]), rounding=float(size.max()),
        interaction=interaction, **fibre,
    )  # fmt: skip
    model.element_set("WIRES", ["FIBRES"])
    return model


def _layer(
    rng: np.random.Generator,
    angle: float,
    n_fibres: int,
    size: NDArray,
    spread: float,
    distance: float,
    below: NDArray,
    margin: float,
) -> NDArray[np.float64]:
    """Ends of the fibres of a layer, (n_fibres, 2, 2), at least `distance` apart.

    The ends of its fibres and of those `below` it stay away from each other's fibres by `margin`, so that no crossing
    slides off an end.
    """
    placed = np.empty((0, 2, 2))
    for _ in range(_TRIES * n_fibres):
        direction = unit(angle + rng.uniform(-spread, spread))
        ends = np.array(clip_line(rng.uniform(size=2) * size, direction, size))
        # what only cuts a corner is no fibre
        if np.linalg.norm(ends[1] - ends[0]) < size.min() / 2:
            continue
        if _among(segment_distance, ends, placed) < distance or _among(end_distance, ends, below) < margin:
            continue
        placed = np.append(placed, ends[None], axis=0)
        if len(placed) == n_fibres:
            return placed
    raise ValueError(f"only {len(placed)} of {n_fibres} fibres fit into a layer without touching")


def _among(measure: Callable[..., NDArray], ends: NDArray, others: NDArray) -> float:
    """Smallest distance of one segment (2, k) from others (n, 2, k)."""
    if not len(others):
        return math.inf
    first, second = (np.broadcast_to(end, others[:, 0].shape) for end in ends)
    return float(measure(first, second, others[:, 0], others[:, 1]).min())


def _direction_of_layer(number: int) -> float:
    return math.pi / 2 * (number % 2)


def _stack(
    model: Model, rng: np.random.Generator, size: NDArray, fibre: dict, layers: dict, bars: dict, n_elements: int
) -> None:
    """Plates and layers, one above the other."""
    radius, clearance, n_layers = fibre["radius"], layers["clearance"], layers["n_layers"]
    margin = 4 * radius
    first = bars["radius"] + clearance + radius
    pitch = 2 * radius + clearance
    top = 2 * first + (n_layers - 1) * pitch

    def to_decimals(x: NDArray) -> NDArray:
        return rounded(x, size.max())

    def plate(name: str, number: int, height: float, share: float) -> NDArray:
        along = unit(_direction_of_layer(number))
        offsets = evenly(size[0] if abs(along[1]) > 0.5 else size[1], bars["number"])
        # short elements: only the nodes of a bar have the potential of the plate
        n_bar_elements = math.ceil(size.max() / (_BAR_ELEMENT * bars["radius"]))
        axes = parallel_bars(along, offsets, size, height, 2 * margin, n_bar_elements)
        material = fibre["material"]
        add_plate(model, name, axes, radius=bars["radius"], material=material, share=share, rounding=to_decimals)
        return np.array([[axis[0, :2], axis[-1, :2]] for axis in axes])

    below = plate("PLATE_BOTTOM", 0, 0.0, 0.0)
    above = plate("PLATE_TOP", n_layers + 1, top, 1.0)
    for number in range(1, n_layers + 1):
        name, height = f"LAYER{number}", first + (number - 1) * pitch
        near = np.concatenate([below, above]) if number == n_layers else below
        below = _layer(
            rng,
            _direction_of_layer(number),
            layers["n_fibres"],
            size,
            layers["spread"],
            pitch,
            near,
            margin,
        )
        axes = [straight([*start, height], [*end, height], n_elements) for start, end in below]
        model.wires(name, [to_decimals(axis) for axis in axes], **fibre)
        hold_in_frame(model, name, float(f"{height / top:.9g}"))
    model.height = top
    model.node_set("PLUS", "PLATE_TOP")
    model.node_set("MINUS", "PLATE_BOTTOM")


def _isotropic(
    rng: np.random.Generator, n_fibres: int, size: NDArray, distance: float, near: float, smallest_angle: float
) -> NDArray[np.float64]:
    """Ends of lines of all directions through a box, (n_fibres, 2, 3)."""
    placed = np.empty((0, 2, 3))
    for _ in range(_TRIES * n_fibres):
        direction = rng.normal(size=3)
        ends = np.array(clip_line(rng.uniform(size=3) * size, direction / np.linalg.norm(direction), size))
        if np.linalg.norm(ends[1] - ends[0]) < size.min() / 2:
            continue
        if len(placed):
            first, second = (np.broadcast_to(end, (len(placed), 3)) for end in ends)
            distances = segment_distance(first, second, placed[:, 0], placed[:, 1])
            angles = crossing_angle(second - first, placed[:, 1] - placed[:, 0])
            if (distances < distance).any() or ((distances < near) & (angles < smallest_angle)).any():
                continue
        placed = np.append(placed, ends[None], axis=0)
        if len(placed) == n_fibres:
            return placed
    raise ValueError(f"only {len(placed)} of {n_fibres} fibres fit into the box without overlap")


def _hold_isotropic(model: Model, height: float) -> None:
    """Electrodes at the bottom and the top, guides at all ends, and one spin of each fibre."""
    x = model.x
    wires = model.groups["FIBRES"].wires
    ends = model.groups["FIBRES"].ends
    top = [node for node in ends if x[node - 1, 2] >= height * (1 - 1e-6)]
    bottom = [node for node in ends if x[node - 1, 2] <= height * 1e-6]
    if not (top and bottom):
        raise ValueError("no fibre reaches the bottom or the top of the box: use more fibres or another seed")
    for name, nodes in (("ENDS", ends), ("PLUS", top), ("MINUS", bottom)):
        model.node_set(name, nodes)
    model.fix("ENDS", "x", "y")
    for node in ends:
        model.guides[node] = float(f"{x[node - 1, 2] / height:.9g}")
    for wire in wires:
        spin = 4 + int(np.argmax(np.abs(x[wire.nodes[-1] - 1] - x[wire.nodes[0] - 1])))
        model.fix(wire.nodes[0], spin)
