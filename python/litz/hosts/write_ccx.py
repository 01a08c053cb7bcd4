"""Input of CalculiX: the beams without their contacts, as far as that program has beams."""

from collections.abc import Iterable, Iterator

import numpy as np

from ..errors import FileError
from .host_conditions import POTENTIAL
from .host_model import HostModel

#: Elements: quadratic, which CalculiX takes for bricks of 20 nodes with reduced integration. Its linear ones (B31) lock
_TYPE = "B32R"


def ccx_input(model: HostModel) -> str:
    """The input file: mesh with nodes in the middle of the elements, sections, supports, and one step."""
    if any(kind == "S" for _, kind, _ in model.local_axes):
        raise FileError("CalculiX has no *TRANSFORM, TYPE=S; rectangular and cylindrical axes can be exported")
    missing = [f"** left out: {one}" for one in missing_in_ccx(model)]
    return "\n".join([*_mesh(model), *missing, *_supports(model), *_step(model)]) + "\n"


def _numbers(values: Iterable[float]) -> str:
    # CalculiX reads at most 20 characters of a number
    return ", ".join(f"{value:.12g}" for value in values)


def _mesh(model: HostModel) -> Iterator[str]:
    yield from ("*HEADING", model.heading, "*NODE, NSET=ALL_NODES")
    for number, place in zip(model.node_numbers, model.x, strict=True):
        yield f"{number}, {_numbers(place)}"
    middle = int(model.node_numbers.max()) + 1 + np.arange(len(model.connectivity))
    yield from ("** in the middle of the elements", "*NODE, NSET=MIDDLE_NODES")
    for number, place in zip(middle, model.x[model.connectivity].mean(axis=1), strict=True):
        yield f"{number}, {_numbers(place)}"
    for place, (section, material) in enumerate(model.sections, 1):
        members = np.flatnonzero(model.section_of == place - 1)
        yield f"*ELEMENT, TYPE={_TYPE}, ELSET=WIRES_{place}"
        for element in members:
            first, last = model.node_numbers[model.connectivity[element]]
            yield f"{model.element_numbers[element]}, {first}, {middle[element]}, {last}"
        yield from (f"*MATERIAL, NAME=MATERIAL_{place}", "*ELASTIC", _numbers([material.young, material.poisson]))
        yield from (
            "** diameters along both axes of the section, and its first axis",
            f"*BEAM SECTION, ELSET=WIRES_{place}, MATERIAL=MATERIAL_{place}, SECTION=CIRC",
            _numbers([2 * section.radius, 2 * section.radius]),
            _numbers(model.cross_direction(members)),
        )


def missing_in_ccx(model: HostModel) -> list[str]:
    """What the model has and CalculiX is not given, in words."""
    missing = []
    if n_pairs := len(model.pairs):
        pairs = "1 pair" if n_pairs == 1 else f"{n_pairs} pairs"
        missing.append(f"contact of {pairs} of elements, as CalculiX has none between beams")
    if any(map(model.conducts, range(len(model.connectivity)))):
        missing.append("potentials and currents, as beams of CalculiX conduct none")
    return missing


def _motions(values: dict[tuple[int, int], float]) -> dict[tuple[int, int], float]:
    return {key: value for key, value in sorted(values.items()) if key[1] != POTENTIAL}


def _boundary(model: HostModel, values: dict[tuple[int, int], float]) -> Iterator[str]:
    if values:
        yield "*BOUNDARY"
        for (row, dof), value in values.items():
            yield f"{model.node_numbers[row]}, {dof}, {dof}, {_numbers([value])}"


def _supports(model: HostModel) -> Iterator[str]:
    yield from model.transforms("LOCAL_AXES")
    yield from _boundary(model, _motions(dict.fromkeys(model.supports, 0.0)))


def _step(model: HostModel) -> Iterator[str]:
    yield from ("*STEP, NLGEOM, INC=1000", "*STATIC", "0.1, 1., 1e-6, 0.1")
    yield from _boundary(model, _motions(model.prescribed))
    loads = _motions(model.loads)
    if loads:
        yield "*CLOAD"
        for (row, dof), value in loads.items():
            yield f"{model.node_numbers[row]}, {dof}, {_numbers([value])}"
    yield from ("*NODE PRINT, NSET=ALL_NODES, GLOBAL=YES", "U, RF", "*NODE FILE", "U, RF", "*END STEP")
