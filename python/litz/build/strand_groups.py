"""Strands as groups of a model, where some are of another material, and what holds their ends."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import NDArray

from ..model import Material, Model
from ..model.wires import Wire

#: Of one or of all strands, or of each of those that are laid together
Materials = Material | Sequence[Material]


def add_strands(
    model: Model, name: str, axes: list[NDArray], *, radius: float, material: Materials, element: str, count: int
) -> list[Wire]:
    """Add strands as a group, or as a group for each of their materials; the strands in the order of their axes.

    Parameters
    ----------
    model, name
        The model, and the name of the group or, with several materials, of the element set of all; the groups are then
        called NAME_MATERIAL.
    axes : list of (n, 3) arrays
        Nodes along each strand [m].
    radius, element
        As those of `Model.wires`.
    material : Material or sequence of Material
        Of all strands, or of each of the `count` ones that are laid together, in turns.
    count : int
        Strands that are laid together.
    """
    if isinstance(material, Material):
        return list(model.wires(name, axes, radius=radius, material=material, element=element).wires)
    if len(material) != count:
        raise ValueError(f"{name} has {count} strands that are laid together, and {len(material)} materials for them")
    different = {one.name: one for one in material}
    if any(one != different[one.name] for one in material):
        raise ValueError(f"{name} has different materials of the same name")
    if len(different) == 1:
        return add_strands(model, name, axes, radius=radius, material=material[0], element=element, count=count)
    wires: dict[int, Wire] = {}
    groups = []
    for material_name, one in different.items():
        members = [k for k in range(len(axes)) if material[k % count].name == material_name]
        groups.append(f"{name}_{material_name}")
        group = model.wires(groups[-1], [axes[k] for k in members], radius=radius, material=one, element=element)
        wires |= dict(zip(members, group.wires, strict=True))
    model.element_set(name, groups)
    return [wires[k] for k in range(len(axes))]


def hold_ends(model: Model, ends: str) -> None:
    """Hold the lower ends, and the upper ones but for their motion along z, which is guided; sliding ones move across, too.

    Parameters
    ----------
    model : Model
        Wires along z; it gets the node sets MINUS and PLUS of their ends.
    ends : {"clamped", "sliding"}
    """
    if ends not in ("clamped", "sliding"):
        raise ValueError(f'ends must be "clamped" or "sliding" (of strands and cables also "periodic"), not {ends!r}')
    wires = [wire for group in model.groups.values() for wire in group.wires]
    model.node_set("MINUS", [wire.nodes[0] for wire in wires])
    model.node_set("PLUS", [wire.nodes[-1] for wire in wires])
    if ends == "clamped":
        model.fix("MINUS")
        model.fix("PLUS", "x", "y", "rotations")
    else:
        model.fix("MINUS", "z", "rotations")
        model.fix("PLUS", "rotations")
    model.guides["PLUS"] = 1.0
