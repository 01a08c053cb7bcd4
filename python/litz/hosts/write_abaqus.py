"""Input of Abaqus/Standard: beams of the program, contacts and conductors as its user elements U1 and U2."""

from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from ..errors import FileError
from .host_conditions import POTENTIAL
from .host_model import HostModel

#: Degree of freedom that stands for the potential
_VOLTAGE = 11
#: Conduction over the present length of an element
_PRESENT = "CURRENT LENGTH"


def abaqus_input(model: HostModel) -> str:
    """The input file: mesh, sections, user elements, supports, and one step."""
    return "\n".join([*_mesh(model), *_contacts(model), *_supports(model), *_step(model)]) + "\n"


def _numbers(values: Iterable[float]) -> str:
    return ", ".join(f"{value:.10g}" for value in values)


def _mesh(model: HostModel) -> Iterator[str]:
    yield from ("*HEADING", f" {model.heading}", "*NODE, NSET=ALL_NODES")
    for number, place in zip(model.node_numbers, model.x, strict=True):
        yield f" {number}, {_numbers(place)}"
    first_conductor = int(model.element_numbers.max())
    for place, (section, material) in enumerate(model.sections):
        members = np.flatnonzero(model.section_of == place)
        for kind in sorted(set(model.kinds[members])):
            yield f"*ELEMENT, TYPE={kind}, ELSET=WIRES_{place + 1}"
            for element in members[model.kinds[members] == kind]:
                yield f" {model.element_numbers[element]}, {_nodes(model, np.array([element]))}"
        yield from (
            f"*MATERIAL, NAME=MATERIAL_{place + 1}",
            "*ELASTIC",
            f" {_numbers([material.young, material.poisson])}",
        )
        yield f"*BEAM SECTION, ELSET=WIRES_{place + 1}, MATERIAL=MATERIAL_{place + 1}, SECTION=CIRC"
        yield from (f" {section.radius:.10g}", f" {_numbers(model.cross_direction(members))}")
    if not any(map(model.conducts, range(len(model.connectivity)))):
        return
    moves = any(section.conduction == _PRESENT for section, _ in model.sections)
    yield from (
        "*USER ELEMENT, TYPE=U2, NODES=2, COORDINATES=3, PROPERTIES=2, I PROPERTIES=1, VARIABLES=2",
        f" 1, 2, 3, {_VOLTAGE}" if moves else f" {_VOLTAGE}",
    )
    for place, (section, material) in enumerate(model.sections):
        if material.conductivity is None:
            continue
        yield f"*ELEMENT, TYPE=U2, ELSET=CONDUCTORS_{place + 1}"
        for element in np.flatnonzero(model.section_of == place):
            yield f" {first_conductor + model.element_numbers[element]}, {_nodes(model, np.array([element]))}"
        yield f"*UEL PROPERTY, ELSET=CONDUCTORS_{place + 1}"
        yield f" {_numbers([np.pi * section.radius**2, 1 / float(material.conductivity)])}, {int(section.conduction == _PRESENT)}"  # type: ignore[arg-type]


def _nodes(model: HostModel, elements: NDArray[np.int64]) -> str:
    return ", ".join(str(model.node_numbers[node]) for node in model.connectivity[elements].ravel())


def _contacts(model: HostModel) -> Iterator[str]:
    kinds = model.contact_kinds()
    if not kinds:
        return
    properties = {kind: _contact_properties(model, kind) for kind in kinds}
    longest = max(map(len, properties.values()))
    tables = {len(values) for kind, values in properties.items() if model.laws[kind[2]].has_table}
    if len(tables) > 1:
        raise FileError(
            "tables of resistances must have the same number of lines for Abaqus: they are of one element type"
        )
    yield (f"*USER ELEMENT, TYPE=U1, NODES=4, COORDINATES=3, PROPERTIES={longest}, I PROPERTIES=5, VARIABLES=6, UNSYMM")
    yield f" 1, 2, 3, 4, 5, 6, {_VOLTAGE}"
    number = 2 * int(model.element_numbers.max())
    for place, (kind, rows) in enumerate(kinds.items(), start=1):
        yield f"*ELEMENT, TYPE=U1, ELSET=CONTACTS_{place}"
        for pair in model.pairs[rows]:
            number += 1
            yield f" {number}, {_nodes(model, pair)}"
        laws = model.laws[kind[2]]
        values = properties[kind] + [0.0] * (longest - len(properties[kind]))
        data = [*(f"{value:.10g}" for value in values), *map(str, (laws.normal, laws.spot, laws.axis, laws.voltage, 0))]
        yield f"*UEL PROPERTY, ELSET=CONTACTS_{place}"
        for i in range(0, len(data), 8):
            yield f" {', '.join(data[i : i + 8])}"


def _contact_properties(model: HostModel, kind: tuple[int, int, int]) -> list[float]:
    """The properties in the order of the user element: a table stands behind the place of a single number."""
    wires, (penalty, *data) = model.contact_properties(kind)
    values = [*wires, penalty, *([0.0] if model.laws[kind[2]].has_table else []), *data]
    return values + [0.0] * (10 - len(values))


def _conditions(model: HostModel, values: dict[tuple[int, int], float], is_load: bool) -> Iterator[str]:
    for (row, dof), value in sorted(values.items()):
        place = _VOLTAGE if dof == POTENTIAL else dof
        yield f" {model.node_numbers[row]}, {place}, {'' if is_load else f'{place}, '}{value:.10g}"


def _supports(model: HostModel) -> Iterator[str]:
    yield from model.transforms("LOCAL_AXES")
    if model.supports:
        yield "*BOUNDARY"
        yield from _conditions(model, dict.fromkeys(model.supports, 0.0), is_load=False)


def _step(model: HostModel) -> Iterator[str]:
    yield from ("*STEP, NLGEOM=YES, UNSYMM=YES, INC=200", "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE")
    yield " 0.1, 1., 1e-6, 0.1"
    for name, values in (
        ("*BOUNDARY", model.prescribed),
        ("*CLOAD", _part(model, False)),
        ("*CFLUX", _part(model, True)),
    ):
        if values:
            yield name
            yield from _conditions(model, values, is_load=name != "*BOUNDARY")
    yield from ("*NODE PRINT, NSET=ALL_NODES", " U, NT, RF, RFL", "*OUTPUT, FIELD", "*NODE OUTPUT", " U, NT, RF, RFL")
    for place in range(1, len(model.contact_kinds()) + 1):
        yield from (f"*EL PRINT, ELSET=CONTACTS_{place}", " SDV")
    yield "*END STEP"


def _part(model: HostModel, currents: bool) -> dict[tuple[int, int], float]:
    """The loads that are currents, or those that are forces and moments."""
    return {key: value for key, value in model.loads.items() if (key[1] == POTENTIAL) == currents}
