"""What holds the wires of a press: rigid plates of parallel bars, and guides at the ends of the wires."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..model import Material, Model, Wire, straight
from .geometry import clip_line


def parallel_bars(
    direction: ArrayLike, offsets: ArrayLike, size: ArrayLike, height: float, overhang: float, n_elements: int
) -> list[NDArray[np.float64]]:
    """Axes of parallel bars over a rectangle and beyond its edges.

    Parameters
    ----------
    direction : (2,) array
        Direction of the bars.
    offsets : (n,) array
        Distance of each bar from the centre of the rectangle, to the left of `direction` [m].
    size : (2,) array
        Sides of the rectangle from the origin [m].
    height : float
        z of the axes [m].
    overhang : float
        Length of each bar beyond the rectangle at both ends [m].
    n_elements : int
        Elements of each bar.
    """
    size = np.asarray(size, dtype=float)
    along = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
    left = np.array([-along[1], along[0]])
    ends = [clip_line(size / 2 + offset * left, along, size) for offset in np.asarray(offsets, dtype=float)]
    reach = overhang * along
    return [straight([*(start - reach), height], [*(end + reach), height], n_elements) for start, end in ends]


def add_plate(
    model: Model,
    name: str,
    bars: list[NDArray[np.float64]],
    *,
    radius: float,
    material: Material,
    share: float,
    rounding: Callable[[NDArray], NDArray],
) -> None:
    """Add a rigid plate: all nodes of its bars are held, and follow a pressing by `share`."""
    model.wires(name, [rounding(bar) for bar in bars], radius=radius, material=material)
    model.fix(name, "x", "y", "rotations")
    model.guides[name] = share


def hold_in_frame(model: Model, group: str, share: float) -> None:
    """Hold the ends of the wires of a group in a frame that follows a pressing by `share`.

    The ends keep their place in the plane, their height is given (`guides`), and one of them cannot spin about the wire;
    they are free to tilt. Nothing is left that could move freely, whether the wire touches others or not.
    """
    wires = model.groups[group].wires
    ends = f"{group}_ENDS"
    model.fix(model.groups[group].ends, "x", "y")
    model.guides[ends] = share
    for axis, dof in (("X", 4), ("Y", 5)):
        nodes = [wire.nodes[0] for wire in wires if _main_axis(model, wire) == axis]
        if nodes:
            model.fix(model.node_set(f"{group}_SPIN_{axis}", nodes), dof)


def evenly(width: float, count: int) -> NDArray[np.float64]:
    """`count` offsets from the middle that divide a width evenly, half a distance away from its edges [m]."""
    return (np.arange(count) + 0.5) / count * width - width / 2


def unit(angle: float) -> NDArray[np.float64]:
    """Direction at an angle from the x axis [rad] in the plane."""
    return np.array([math.cos(angle), math.sin(angle)])


def _main_axis(model: Model, wire: Wire) -> str:
    """The axis, X or Y, that a level wire runs along more than along the other."""
    direction = model.x[wire.nodes[-1] - 1] - model.x[wire.nodes[0] - 1]
    return "X" if abs(direction[0]) >= abs(direction[1]) else "Y"


def hold_ends(model: Model, group: str, height: float) -> None:
    """Hold the ends of all wires of a group in the plane, let their heights follow a pressing, and stop one spin of each wire.

    Each end follows by its height over `height`, that of the model [m].
    """
    of_group = model.groups[group]
    model.fix(model.node_set("ENDS", of_group.ends), "x", "y")
    heights: dict[float, list[int]] = {}
    for node in of_group.ends:
        heights.setdefault(float(model.x[node - 1, 2]), []).append(node)
    several = len(heights) < len(of_group.ends) / 2
    for level, (z, nodes) in enumerate(sorted(heights.items())):
        share = float(f"{z / max(height, np.finfo(float).tiny):.9g}")
        if several:
            model.guides[model.node_set(f"LEVEL{level}_ENDS", nodes).name] = share
        else:
            model.guides |= dict.fromkeys(nodes, share)
    x = model.x
    first, last = (np.array([wire.nodes[end] for wire in of_group.wires]) for end in (0, -1))
    axis = np.abs(x[last - 1] - x[first - 1]).argmax(axis=1)
    for number in np.unique(axis):
        model.fix(model.node_set(f"SPIN_{'XYZ'[number]}", first[axis == number]), 4 + int(number))


def electrodes_at_walls(model: Model, group: str, length: float) -> None:
    """Name the ends of wires at x = 0 MINUS and at x = length PLUS."""
    x = model.x
    for name, wall in (("MINUS", 0.0), ("PLUS", length)):
        nodes = [node for node in model.groups[group].ends if abs(x[node - 1, 0] - wall) < 1e-6 * length]
        if not nodes:
            raise ValueError("no wire reaches one of the electrodes: use more or longer wires, or another seed")
        model.node_set(name, nodes)
