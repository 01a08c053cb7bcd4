"""Regular crossings: a grid of straight wires, and a plain-woven fabric between two plates."""

import itertools
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..model import COPPER, HERTZ_AND_HOLM, Interaction, Material, Model, straight
from .frame import add_plate
from .geometry import rounded, smooth_axis

#: Largest ratio of crimp to pitch at which yarns touch at crossings only: 1/(pi sqrt(2)), with a margin
_MAX_CRIMP = 0.22
#: Angles between elements: smallest angle of a kink, and largest angle of a fabric by default [rad]
_KINK, _TURN_OF_DEFAULT = math.radians(20), math.radians(15)


def wire_grid(
    n_x: int,
    n_y: int,
    *,
    pitch: float,
    radius: float,
    clearance: float = 0.0,
    elements_per_pitch: int = 2,
    supports: str = "between",
    material: Material = COPPER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
) -> Model:
    """Straight wires along y that lie on straight wires along x, to be pressed together.

    All ends are clamped, one end of each wire may move along it. Crossings lie at nodes when `elements_per_pitch` is even,
    half a pitch away from the ends. `model.press` lowers the supports of the upper wires; those of the lower wires stay.

    Parameters
    ----------
    n_x, n_y : int
        Number of wires along x and along y.
    pitch : float
        Distance of neighbouring wires [m], more than a diameter.
    radius : float
        Radius of all wires [m].
    clearance : float
        Gap between upper and lower wires at the start [m].
    elements_per_pitch : int
        Elements of each wire between two crossings.
    supports : {"between", "ends"}
        Where the heights of wires are given: also halfway between any two crossings, as ribs of two plates would do, so that
        all crossings are pressed, and with the same force; or at the ends alone, so that the wires bend away from each
        other in the middle, where wires of many crossings are not pressed: of 80 x 80 only those near the edges touch.
    material, interaction, element
        What the wires are made of, the laws of their contacts, type of the elements.

    Returns
    -------
    Model
        Groups LOWER (along x) and UPPER (along y); node sets MINUS and PLUS: the first ends of the wires of each.
    """
    _check_counts(n_x, n_y, elements_per_pitch)
    if not pitch > 2 * radius > 0:
        raise ValueError("a grid needs a positive radius and a pitch of more than a diameter")
    if clearance < 0:
        raise ValueError(f"clearance must be 0 or greater, not {clearance:g}")
    if supports not in ("between", "ends"):
        raise ValueError(f'supports must be "between" or "ends", not {supports!r}')
    model = Model(f"Grid of {n_x} x {n_y} wires")
    height, across = 2 * radius + clearance, [(index + 0.5) * pitch for index in range(max(n_x, n_y))]

    def axis(start: tuple, end: tuple, count: int) -> NDArray:
        return rounded(straight(start, end, count * elements_per_pitch), max(n_x, n_y) * pitch)

    wires: dict[str, Any] = {"radius": radius, "material": material, "element": element}
    model.wires("LOWER", [axis((0, y, 0), (n_y * pitch, y, 0), n_y) for y in across[:n_x]], **wires)
    upper = [axis((x, 0, height), (x, n_x * pitch, height), n_x) for x in across[:n_y]]
    model.wires("UPPER", upper, **wires)
    for name, along in (("LOWER", 1), ("UPPER", 2)):
        starts, ends = zip(*(wire.ends for wire in model.groups[name].wires), strict=True)
        for which, nodes in (("STARTS", starts), ("ENDS", ends)):
            model.node_set(f"{name}_{which}", nodes)
            fixed = [dof for dof in (1, 2, 4, 5, 6) if dof != along or which == "STARTS"]
            model.fix(f"{name}_{which}", *fixed)
            model.guides[f"{name}_{which}"] = 1.0 if name == "UPPER" else 0.0
        inner = [
            node for wire in model.groups[name].wires for node in wire.nodes[elements_per_pitch:-1:elements_per_pitch]
        ]
        if supports == "between" and inner:
            model.guides[model.node_set(f"{name}_BETWEEN", inner).name] = 1.0 if name == "UPPER" else 0.0
    model.node_set("PLUS", "UPPER_STARTS")
    model.node_set("MINUS", "LOWER_STARTS")
    model.element_set("WIRES", ["LOWER", "UPPER"])
    model.contact("LOWER", "UPPER", interaction=interaction)
    return model


def woven_fabric(
    n_warp: int,
    n_weft: int,
    *,
    pitch: float,
    radius: float,
    clearance: float | None = None,
    elements_per_pitch: int | None = None,
    plates: bool = True,
    bar_radius: float | None = None,
    material: Material = COPPER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
) -> Model:
    """Plain weave of round wires, to be pressed along z between two plates.

    The axes of the yarns are cosines, `z = +-a cos(pi s/pitch)`, which pass each other at every crossing with the clearance,
    in the middle of an element of each.
    The plates conduct: each is a row of rigid wires, straight and diagonal, one over each diagonal of
    crests, which it crosses at 45 degrees; at each crest it has an element of two radii, whose nodes
    have the potential of the plate. The ends of the yarns are held across the yarn and follow the pressing by
    half, the middles are held along the yarn: yarns may become longer as their crimp is pressed out.

    Parameters
    ----------
    n_warp, n_weft : int
        Number of warp yarns (along x) and weft yarns (along y).
    pitch : float
        Distance of neighbouring yarns [m], more than 2.3 diameters: yarns must not touch beside the crossings.
    radius : float
        Radius of the yarns [m].
    clearance : float, optional
        Gap at the crossings and between plates and yarns [m], a fiftieth of the radius when left out.
    elements_per_pitch : int
        Elements of each yarn between two crossings, an even number; when left out, as many as turn by less than 15 degrees
        from one to the next, 4 at least. At 20 degrees a yarn would have a kink, and be no smooth wire.
    plates : bool
        With the two plates; without them `model.guides` has the ends of the yarns alone.
    bar_radius : float, optional
        Radius of the wires of the plates [m]; that of the yarns when left out.
    material, interaction, element
        What yarns and bars are made of, the laws of their contacts, type of the elements.

    Returns
    -------
    Model
        Groups WARP and WEFT, with plates PLATE_BOTTOM and PLATE_TOP; node sets PLUS (top plate, or the first ends of the
        warp) and MINUS (bottom plate, or the first ends of the weft).
    """
    _check_counts(n_warp, n_weft, 2 if elements_per_pitch is None else elements_per_pitch)
    if elements_per_pitch is not None and elements_per_pitch % 2:
        raise ValueError(f"elements_per_pitch must be even, not {elements_per_pitch}")
    clearance = radius / 50 if clearance is None else clearance
    if not radius > 0 or not clearance >= 0:
        raise ValueError("a fabric needs a positive radius, and a clearance of 0 or more")
    crimp = radius + clearance / 2
    if crimp > _MAX_CRIMP * pitch:
        raise ValueError(f"pitch must be at least {crimp / _MAX_CRIMP:g} m, so that yarns touch at crossings only")
    if elements_per_pitch is None:
        fine = (n for n in itertools.count(4, 2) if _largest_turn(crimp, pitch, n) < _TURN_OF_DEFAULT)
        elements_per_pitch = next(fine)
    elif _largest_turn(crimp, pitch, elements_per_pitch) >= _KINK:
        raise ValueError(
            f"with {elements_per_pitch} elements_per_pitch the yarns have kinks of "
            f"{math.degrees(_largest_turn(crimp, pitch, elements_per_pitch)):.1f} degrees, where they are no smooth wires: "
            "use more elements, so that they are below 20 degrees"
        )
    amplitude = _amplitude(crimp, pitch, elements_per_pitch)
    model = Model(f"Plain weave of {n_warp} x {n_weft} yarns")
    size = np.array([n_weft, n_warp]) * pitch
    yarns: dict[str, Any] = {"radius": radius, "material": material, "element": element}
    for name, count, crossed, along in (("WARP", n_warp, n_weft, 0), ("WEFT", n_weft, n_warp, 1)):
        axes = []
        for index in range(count):
            # crossings, at halves, lie in the middles of elements
            inner = (np.arange(crossed * elements_per_pitch) + 0.5) / elements_per_pitch
            s = np.array([0, *inner, crossed])
            points = np.empty((len(s), 3))
            points[:, along] = s * pitch
            points[:, 1 - along] = (index + 0.5) * pitch
            points[:, 2] = (-1) ** (index + along) * amplitude * np.cos(math.pi * (s - 0.5))
            axes.append(rounded(points, size.max()))
        model.wires(name, axes, **yarns)
        _hold_yarns(model, name, along)
    model.contact("WARP", "WEFT", interaction=interaction)
    electrodes = {name: model.groups[yarn].start for name, yarn in (("PLUS", "WARP"), ("MINUS", "WEFT"))}
    if plates:
        height = crimp + radius + clearance + (radius if bar_radius is None else bar_radius)
        bars = {"radius": radius if bar_radius is None else bar_radius, "material": material}
        _add_diagonal_plates(model, (n_warp, n_weft), pitch, height, pitch, bars)
        for plate, yarn in itertools.product(("PLATE_BOTTOM", "PLATE_TOP"), ("WARP", "WEFT")):
            model.contact(plate, yarn, interaction=interaction)
        model.height = 2 * height
        electrodes = {"PLUS": model.groups["PLATE_TOP"].nodes, "MINUS": model.groups["PLATE_BOTTOM"].nodes}
    for name, nodes in electrodes.items():
        model.node_set(name, nodes)
    model.element_set("WIRES", list(model.groups))
    return model


def _largest_turn(crest: float, pitch: float, elements_per_pitch: int) -> float:
    """Largest angle between neighbouring elements of a yarn [rad]."""
    s = (np.arange(4 * elements_per_pitch) + 0.5) / elements_per_pitch
    slope = np.diff(crest * np.cos(math.pi * (s - 0.5))) / np.diff(s * pitch)
    return float(np.abs(np.diff(np.arctan(slope))).max())


def _amplitude(crest: float, pitch: float, elements_per_pitch: int) -> float:
    """Amplitude of the cosine through the nodes of a yarn whose smooth axis is to have its crests at a height [m]."""
    s = (np.arange(5 * elements_per_pitch) + 0.5) / elements_per_pitch
    rows = np.arange(len(s) - 1)
    elements = np.stack([rows, rows + 1], axis=1)
    amplitude = crest
    # the error of the interpolation is a small fraction of the amplitude, of which each turn leaves that fraction
    for _ in range(6):
        nodes = np.stack([s * pitch, np.zeros_like(s), amplitude * np.cos(math.pi * (s - 0.5))], axis=1)
        height = smooth_axis(nodes, elements, 2)[:, 1, 2]
        amplitude *= crest / height[np.argmin(np.abs(s[:-1] - 2.5 + 0.5 / elements_per_pitch))]
    return amplitude


def _hold_yarns(model: Model, name: str, along: int) -> None:
    """Ends across the yarn and in height, middles along it and against spin."""
    group = model.groups[name]
    middles = [wire.nodes[len(wire.nodes) // 2] for wire in group.wires]
    model.fix(group.ends, 2 - along)
    model.fix(model.node_set(f"{name}_MIDDLES", middles), 1 + along, 4 + along)
    model.guides[f"{name}_ENDS"] = 0.5


def _add_diagonal_plates(
    model: Model, counts: tuple[int, int], pitch: float, height: float, overhang: float, bars: dict
) -> None:
    """A bar along every diagonal of crossings, below and above."""
    n_warp, n_weft = counts
    size = max(counts) * pitch
    for name, z, share in (("PLATE_BOTTOM", -height, 0.0), ("PLATE_TOP", height, 1.0)):
        axes = []
        for difference in range(1 - n_weft, n_warp):
            # crossings (i, j) of weft i and warp j with j - i = difference; only nodes have the potential of the plate
            first = max(0, -difference)
            count = min(n_weft - first, n_warp - max(0, difference))
            start = np.array([first + 0.5, max(0, difference) + 0.5]) * pitch
            crests = np.arange(count)[:, None] * pitch + np.array([-1, 1]) * bars["radius"] / math.sqrt(2)
            along = np.array([-overhang, *crests.ravel(), (count - 1) * pitch + overhang])
            axes.append(np.column_stack([start + along[:, None], np.full(len(along), z)]))
        add_plate(model, name, axes, **bars, share=share, rounding=lambda x: rounded(x, size))


def _check_counts(n_first: int, n_second: int, elements_per_pitch: int) -> None:
    if min(n_first, n_second, elements_per_pitch) < 1:
        raise ValueError("the numbers of wires, and of elements per pitch, must be 1 or more")
