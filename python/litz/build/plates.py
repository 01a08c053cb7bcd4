"""Rigid plates that press the wires of a model."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..model import Friction, Hertz, Linear, Model, NamedBehaviour, WireGroup
from ..model.surfaces import RigidSurface
from ..wires.chains import find_wires
from ..wires.curves import element_curves, hermite
from .beyond_ends import own_groups

#: Places on each element at which its distance from the plates is measured
_PLACES = 17


def press_plates(
    model: Model,
    wires: WireGroup | str | Sequence[WireGroup | str] | None = None,
    *,
    axis: str = "z",
    clearance: float = 0.0,
    behaviour: Hertz | Linear | NamedBehaviour | None = None,
    friction: Friction | float | None = None,
) -> tuple[RigidSurface, RigidSurface]:
    """Add two rigid plates that just touch the wires of a model from both sides.

    The lower one, `PLATE_1`, is fixed in space. The upper one, `PLATE_2`, can only move along the axis: move it, or load it, in a
    step.

    Parameters
    ----------
    model : Model
        A model with wires.
    wires : WireGroup, str, or sequence of them, optional
        Groups or element sets that the plates touch; all groups when left out.
    axis : {"x", "y", "z"}
        Direction in which they press.
    clearance : float
        Distance of each plate from the wires [m].
    behaviour, friction
        As those of `Model.contact`.

    Returns
    -------
    tuple of RigidSurface
        The lower and the upper plate.

    Examples
    --------
    >>> import litz
    >>> model = litz.build.strand([1, 6], radius=[0.52e-3, 0.5e-3], lay_length=45e-3, length=20e-3)
    >>> lower, upper = litz.build.press_plates(model, axis="x", friction=0.2)
    >>> step = model.step("PRESS", increment=0.25)
    >>> step.move(upper, "x", -2e-6)
    >>> step.potential("MINUS", 0)
    >>> step.node_print(upper, "RF")
    """
    if axis not in ("x", "y", "z"):
        raise ValueError(f'axis must be "x", "y" or "z", not {axis!r}')
    if not clearance >= 0:
        raise ValueError(f"clearance must not be negative, found {clearance:g}")
    if not model.groups:
        raise ValueError("the model has no wires that plates could press")
    chosen = list(own_groups(model)) if wires is None else wires
    along = np.eye(3)["xyz".index(axis)]
    points, radius = axes_of(model, chosen)
    heights = points @ along
    low, high = float((heights - radius).min()) - clearance, float((heights + radius).max()) + clearance
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    beside = middle - along * (middle @ along)
    lower = model.plane("PLATE_1", beside + low * along, along)
    upper = model.plane("PLATE_2", beside + high * along, -along, reference=(beside + high * along).tolist())
    for plate in (lower, upper):
        model.contact(chosen, plate, behaviour=behaviour, friction=friction)
    model.fix(upper, *(name for name in "xyz" if name != axis), "rotations")
    return lower, upper


def axes_of(model: Model, wires: WireGroup | str | Sequence[WireGroup | str]) -> tuple[np.ndarray, np.ndarray]:
    """Points along the axes of wires (n, 3) and the radius there (n) [m]."""
    names = [wires] if isinstance(wires, str | WireGroup) else list(wires)
    rows = np.unique([number - 1 for name in names for number in model.elements_of(name)])
    still = np.zeros_like(model.x)
    everywhere = find_wires(model.connectivity)
    positions, slopes = element_curves(model.x, still, still, everywhere, len(model.connectivity))
    xi = np.linspace(-1, 1, _PLACES)
    points = [hermite(positions[rows], slopes[rows], np.full(len(rows), place)) for place in xi]
    radii = np.concatenate([np.full(len(group.elements), group.radius) for group in model.groups.values()])
    return np.concatenate(points), np.tile(radii[rows], _PLACES)
