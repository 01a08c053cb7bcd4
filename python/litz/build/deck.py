"""A model as the text of a deck."""

from collections.abc import Iterable, Iterator

import numpy as np

from .model import Interaction, Load, Material, Model, Prescribed, Step, WireGroup

#: Members of a set on one line
_MEMBERS_PER_LINE = 12


def deck_text(model: Model, mesh_file: str | None = None) -> str:
    """The deck of a model; with a mesh file, that stands for nodes, elements and sets."""
    lines = ["*HEADING", model.title, "**", *(f"** {comment}".rstrip() for comment in model.comments), "**"]
    lines += _mesh_of(model) if mesh_file is None else [f"*MESH, INPUT={mesh_file}"]
    lines.append("**")
    for material in model.materials:
        lines += _material(material)
    for group in model.groups.values():
        lines += [
            f"*BEAM SECTION, ELSET={group.name}, MATERIAL={group.material.name}, SECTION=CIRC",
            f" {_number(group.radius)}",
        ]
    lines.append("**")
    for interaction in model.interactions:
        lines += _interaction(interaction)
    for pair in model.contacts:
        sets = pair.first if pair.second is None else f"{pair.first}, {pair.second}"
        fit = ", INTERFERENCE FIT" if pair.interference_fit else ""
        lines += [f"*CONTACT PAIR, INTERACTION={pair.interaction.name}{fit}", f" {sets}"]
    lines.append("**")
    if model.supports:
        lines += ["*BOUNDARY", *map(_prescribed, model.supports)]
    for step in model.steps:
        lines += _step(step)
    return "\n".join(lines) + "\n"


def _number(value: float) -> str:
    """The shortest decimal that reads back as the same number."""
    plain = np.format_float_positional(value, trim="-")
    scientific = np.format_float_scientific(value, trim="-", exp_digits=1).replace("e+", "e")
    return min(plain, scientific, key=len)


def _mesh_of(model: Model) -> Iterator[str]:
    positions = model.x
    for group in model.groups.values():
        yield from _mesh(group, positions)
    for name, groups in model.element_sets.items():
        yield f"*ELSET, ELSET={name}"
        yield from _members(groups)
    for name, nodes in model.node_sets.items():
        yield f"*NSET, NSET={name}"
        yield from _members(nodes)


def _mesh(group: WireGroup, positions) -> Iterator[str]:
    yield f"*NODE, NSET={group.name}"
    for wire in group.wires:
        for node in wire.nodes:
            yield f" {node}, " + ", ".join(map(_number, positions[node - 1]))
    yield f"*ELEMENT, TYPE={group.element}, ELSET={group.name}"
    for wire in group.wires:
        for element, node in zip(wire.elements, wire.nodes, strict=False):
            yield f" {element}, {node}, {node + 1}"


def _members(members: Iterable[int | str]) -> Iterator[str]:
    words = [str(member) for member in members]
    for start in range(0, len(words), _MEMBERS_PER_LINE):
        yield " " + ", ".join(words[start : start + _MEMBERS_PER_LINE])


def _material(material: Material) -> Iterator[str]:
    yield f"*MATERIAL, NAME={material.name}"
    yield "*ELASTIC"
    yield f" {_number(material.young)}, {_number(material.poisson)}"
    if material.conductivity is not None:
        yield "*ELECTRICAL CONDUCTIVITY"
        yield f" {_number(material.conductivity)}"


def _interaction(interaction: Interaction) -> Iterator[str]:
    yield f"*SURFACE INTERACTION, NAME={interaction.name}"
    if interaction.penalty is None:
        yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"
    else:
        yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"
        yield f" {_number(interaction.penalty)}"
    if interaction.spot_law is not None:
        yield f"*GAP ELECTRICAL CONDUCTANCE, LAW={interaction.spot_law}"
        for line in interaction.spot_data:
            yield " " + ", ".join(map(_number, line))


def _prescribed(item: Prescribed) -> str:
    value = f", {_number(item.value)}" if item.value else ""
    last = f", {item.last}" if item.last != item.first or value else ""
    return f" {item.target}, {item.first}{last}{value}"


def _loads(keyword: str, loads: list[Load]) -> Iterator[str]:
    if loads:
        yield keyword
        for load in loads:
            yield f" {load.target}, {load.dof}, {_number(load.value)}"


def _step(step: Step) -> Iterator[str]:
    yield f"*STEP, NAME={step.name}, INC={step.most_increments}"
    yield "*STATIC"
    yield " " + ", ".join(map(_number, step.increments))
    if step.boundary:
        yield "*BOUNDARY"
        yield from map(_prescribed, step.boundary)
    yield from _loads("*CLOAD", [load for load in step.loads if load.dof != 9])
    yield from _loads("*CECURRENT", [load for load in step.loads if load.dof == 9])
    for node_set, quantity in step.node_totals:
        yield f"*NODE PRINT, NSET={node_set}, TOTALS=ONLY"
        yield f" {quantity}"
    for plus, minus in step.electrodes:
        yield "*ELECTRODE PRINT"
        yield f" {plus}, {minus}"
    if step.frequency > 1:
        yield f"*NODE FILE, FREQUENCY={step.frequency}"
    yield "*END STEP"
