"""Rigid jackets that shrink around the wires of a cable, to a void fraction."""

from __future__ import annotations

import math

import numpy as np

from ..model import Friction, Hertz, Linear, Model, NamedBehaviour, Step, WireGroup
from ..model.surfaces import RigidSurface
from .beyond_ends import SLENDER, own_groups
from .periodic_ends import leave_to_jacket
from .plates import axes_of

#: Contact force over penetration
Behaviour = Hertz | Linear | NamedBehaviour
#: Names of the four planes of a square jacket, and their normals towards the wires
_SIDES = {"JACKET_X1": (1, 0), "JACKET_X2": (-1, 0), "JACKET_Y1": (0, 1), "JACKET_Y2": (0, -1)}


def compact(
    model: Model,
    void_fraction: float,
    *,
    shape: str = "round",
    behaviour: Behaviour | None = None,
    friction: Friction | float | None = None,
    damping: float = 1e-4,
    increments: int = 20,
    total: float = 1.0,
) -> Step:
    """Add a rigid jacket around the wires along z of a model, and a step in which it shrinks to a void fraction.

    At first the jacket just touches the outermost wires. Its section in the end is that of the wires, by their volume as they
    are laid, over one minus the void fraction.

    Parameters
    ----------
    model : Model
        A cable or strand along z, with ends that are free across it: `cable(..., ends="sliding")`, or "periodic", which are then
        held along z only. No step has been added.
    void_fraction : float
        Part of the section of the jacket that is not metal, at the end of the step.
    shape : {"round", "square"}
        A bore (`JACKET`) whose radius shrinks, or four planes that move inwards (`JACKET_X1`, `JACKET_X2`, `JACKET_Y1`,
        `JACKET_Y2`).
    behaviour, friction
        Of the contacts with the jacket, as those of `Model.contact`.
    damping : float
        Of `*CONTROLS, PARAMETERS=STABILIZE`: wires are loose until others hold them, and snap into gaps.
    increments : int
        Number of equal increments at first; they become smaller where they must.
    total : float
        Time of the step [s].

    Returns
    -------
    Step
        The step `COMPACT`.

    Raises
    ------
    ValueError
        For a void fraction that is not below that of the jacket at first, or that round wires cannot have (0.0931, of wires side
        by side in a hexagonal array).

    Examples
    --------
    >>> import litz
    >>> triplet = litz.build.cable([[3]], radius=0.41e-3, lay_lengths=[80e-3], length=20e-3, ends="sliding")
    >>> step = litz.build.compact(triplet, 0.34)
    >>> triplet.surfaces["JACKET"].shape
    'BORE'

    Notes
    -----
    Wires are elastic, and overlap by 5 % of their radius at most: cables of several stages come to void fractions of about
    0.45.

    The forces of damping are those of the last increment: without friction between the wires, a triplet that is pressed in two
    increments has 3 % too much force, with friction 0.1 %. A step after it that changes nothing, and does not damp, settles
    that: `model.step("SETTLE").controls("STABILIZE", factor=0)`.
    """
    if shape not in ("round", "square"):
        raise ValueError(f'shape must be "round" or "square", not {shape!r}')
    if model.steps:
        raise ValueError("a cable is compacted before anything else; this model has a step already")
    wires = own_groups(model)
    points, radius = axes_of(model, list(wires))
    metal = _section_of_metal(model, wires)
    if shape == "round":
        size = float((np.hypot(points[:, 0], points[:, 1]) + radius).max())
        filled = math.pi * size**2
    else:
        size = float((np.abs(points[:, :2]).max(axis=1) + radius).max())
        filled = 4 * size**2
    loosest, densest = 1 - metal / filled, 1 - math.pi / (2 * math.sqrt(3))
    if not densest < void_fraction < loosest:
        raise ValueError(
            f"void_fraction must be between {densest:.4f} (round wires cannot be denser) and {loosest:.4f} "
            f"(that of the jacket around the wires as they are laid), not {void_fraction:g}"
        )
    shrunk = math.sqrt((1 - loosest) / (1 - void_fraction))
    leave_to_jacket(model)
    surfaces = [_bore(model, size, shrunk, total)] if shape == "round" else _planes(model, size)
    for surface in surfaces:
        model.contact(list(wires), surface, behaviour=behaviour, friction=friction)
    step = model.step("COMPACT", increment=total / increments, total=total)
    if shape == "square":
        for surface, (x, y) in zip(surfaces, _SIDES.values(), strict=True):
            step.move(surface, "x" if x else "y", size * (1 - shrunk) * (x + y))
    # it refers to the smallest stiffness of all elements, those beyond the ends of a cell among them
    step.controls("STABILIZE", factor=damping if len(wires) == len(model.groups) else damping / SLENDER)
    if "MINUS" in model.node_sets:
        model.ground = "MINUS"
    return step


def _section_of_metal(model: Model, wires: list[WireGroup]) -> float:
    """Volume of the wires [m^3] over the length of the cable, which is that of each: their ends are in slanted planes."""
    ends = np.array([wire.ends for group in wires for wire in group.wires])
    length = float(np.mean(np.abs(np.diff(model.x[ends - 1, 2]))))
    volume = 0.0
    for group in wires:
        lengths = np.linalg.norm(np.diff(model.x[group.connectivity - 1], axis=1)[:, 0], axis=1)
        volume += math.pi * group.radius**2 * float(lengths.sum())
    return volume / length


def _bore(model: Model, size: float, shrunk: float, total: float) -> RigidSurface:
    """A bore whose radius shrinks by a factor."""
    amplitude = model.amplitude("JACKET", [0, total], [1, shrunk], time="TOTAL TIME")
    return model.bore("JACKET", (0, 0, 0), (0, 0, 1), size, radius_amplitude=amplitude)


def _planes(model: Model, size: float) -> list[RigidSurface]:
    """Four planes that can move inwards, and in no other way."""
    planes = []
    for name, (x, y) in _SIDES.items():
        place = (-size * x, -size * y, 0.0)
        planes.append(model.plane(name, place, (x, y, 0), reference=place))
        model.fix(planes[-1], *("yz" if x else "xz"), "rotations")
    return planes
