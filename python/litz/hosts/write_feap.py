"""Input of FEAP and FEAPpv: beams of the program, conductors and contacts as its user elements 2 and 1."""

import math
from collections.abc import Iterator

import numpy as np

from ..errors import FileError
from .host_conditions import POTENTIAL
from .host_model import HostModel

#: Unknowns of a node: motions, rotations, voltage
_N_UNKNOWNS = 7
_MOST_PAIRS = 20
#: Increments of the one step
_INCREMENTS = 10


def feap_input(model: HostModel) -> str:
    """The input file: mesh, materials, supports, and one step in increments."""
    if model.local_axes:
        raise FileError("supports and loads along local axes (*TRANSFORM) cannot be exported to FEAP")
    factor = _shorter_unit(model)
    model = model.in_shorter_unit(factor)
    unit = f"! unit of length: {1 / factor:g} of the deck's; newtons, volts, amperes and ohms as there"
    return "\n".join([*_mesh(model, unit), *_materials(model), *_conditions(model), *_step()]) + "\n"


def _shorter_unit(model: HostModel) -> float:
    """How many units of FEAP make one of the deck: FEAP takes sections for degenerate whose inertia is below 1e-8."""
    thinnest = min(section.radius for section, _ in model.sections)
    return float(1000 ** max(0, math.ceil(math.log(0.1 / thinnest, 1000))))


def _number(value: float) -> str:
    """A number within FEAP's 15 columns."""
    return f"{value:.8e}" if value else "0"


def _line(*values: float | str) -> str:
    return "  " + ", ".join(value if isinstance(value, str) else _number(value) for value in values)


def _conductors(model: HostModel) -> list[int]:
    return [element for element in range(len(model.connectivity)) if model.conducts(element)]


def _mesh(model: HostModel, unit: str) -> Iterator[str]:
    conductors, kinds = _conductors(model), model.contact_kinds()
    n_sections = len(model.sections)
    n_elements = len(model.connectivity) + len(conductors) + len(model.pairs)
    yield f"FEAP * * {model.heading[:60]}"
    yield f"  {len(model.x)} {n_elements} {2 * n_sections + len(kinds)} 3 {_N_UNKNOWNS} 4"
    yield from ("", unit, "! nodes, numbered in the order of the deck", "COORdinates")
    for row, place in enumerate(model.x, start=1):
        yield f"  {row}, 0, {', '.join(map(_number, place))}"
    yield from ("", "! beams, conductors, contacts (barred 1, barred 2, 1, 2)", "ELEMents")
    number = 0
    for elements, first in ((range(len(model.connectivity)), 1), (conductors, n_sections + 1)):
        for element in elements:
            number += 1
            nodes = model.connectivity[element] + 1
            yield f"  {number}, 0, {model.section_of[element] + first}, {nodes[0]}, {nodes[1]}"
    for kind, rows in enumerate(kinds.values()):
        for pair in model.pairs[rows]:
            number += 1
            nodes = ", ".join(str(node + 1) for node in model.connectivity[pair].ravel())
            yield f"  {number}, 0, {2 * n_sections + 1 + kind}, {nodes}"


def _materials(model: HostModel) -> Iterator[str]:
    for place, (section, material) in enumerate(model.sections, start=1):
        area, inertia = np.pi * section.radius**2, np.pi * section.radius**4 / 4
        direction = model.cross_direction(np.flatnonzero(model.section_of == place - 1))
        yield from ("", f"MATErial,{place}", "  FRAMe", "    SMALl")
        yield f"    ELAStic ISOTropic, {_number(material.young)}, {_number(material.poisson)}"
        yield f"    CROSs SECTion, {', '.join(map(_number, [area, inertia, inertia, 0, 2 * inertia]))}"
        yield f"    REFErence VECTor, {', '.join(map(_number, direction))}"
    for place, (section, material) in enumerate(model.sections, start=1):
        resistivity = 1.0 if material.conductivity is None else 1 / float(material.conductivity)  # type: ignore[arg-type]
        yield from ("", f"MATErial,{len(model.sections) + place}", "  USER, 2")
        yield _line(np.pi * section.radius**2, resistivity, str(int(section.conduction == "CURRENT LENGTH")))
    for place, kind in enumerate(model.contact_kinds(), start=1):
        laws = model.laws[kind[2]]
        wires, (penalty, *data) = model.contact_properties(kind)
        pairs = [data[i : i + 2] for i in range(0, len(data), 2)] if laws.has_table else []
        if len(pairs) > _MOST_PAIRS:
            raise FileError(f"a table of resistances has at most {_MOST_PAIRS} pairs in FEAP, not {len(pairs)}")
        yield from ("", f"MATErial,{2 * len(model.sections) + place}", "  USER, 1")
        yield _line(*wires)
        yield _line(penalty, *([] if laws.has_table else data))
        yield f"  {laws.normal}, {laws.spot}, {laws.axis}, {laws.voltage}, {len(pairs)}"
        for pair in pairs:
            yield _line(*pair)


def _conditions(model: HostModel) -> Iterator[str]:
    for name, keys in (
        ("BOUNdary", dict.fromkeys([*model.supports, *model.prescribed], "1")),
        ("DISPlacements", {key: _number(value) for key, value in model.prescribed.items()}),
        ("FORCe", {key: _number(value) for key, value in model.loads.items()}),
    ):
        rows: dict[int, list[str]] = {}
        for (row, dof), value in keys.items():
            unknown = _N_UNKNOWNS if dof == POTENTIAL else dof
            if unknown <= _N_UNKNOWNS:
                rows.setdefault(row, ["0"] * _N_UNKNOWNS)[unknown - 1] = value
        if rows:
            yield from ("", name)
            for row in sorted(rows):
                yield f"  {row + 1}, 0, {', '.join(rows[row])}"
    yield from ("", "END")


def _step() -> Iterator[str]:
    yield from ("", "BATCh", "  PROP,,1", f"  DT,,{1 / _INCREMENTS:g}", "  TOL,,1.e-18", f"  LOOP,,{_INCREMENTS}")
    yield from ("    TIME", "    LOOP,,25", "      UTANg,,1", "    NEXT", "    STREss,ALL", "    DISPlacement,ALL")
    yield from ("    REACtion,ALL", "  NEXT", "END", "  1, 0, 0, 2, 0, 1", "", "STOP")
