"""A model in words, for notebooks."""

from __future__ import annotations

import html
from collections.abc import Iterator, Sequence
from dataclasses import MISSING, Field, fields
from typing import Any

import numpy as np

from ..base.quantities import engineering, with_unit
from .interactions import Interaction
from .loaded_model import LoadedModel
from .loading import Load, Prescribed, Target, direction_names, unit_of
from .materials import Circular, Material
from .wires import WireGroup

#: Colours of the groups, those of matplotlib's map of this name in turn
COLOUR_MAP = "tab10"
COLOURS = ("#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2", "#7f7f7f", "#bcbd22", "#17becf")
N_COLOURS = len(COLOURS)
#: Lines of each kind at most
_MAX_LINES = 12
#: Units of the properties of materials
_UNITS = {
    "young": "Pa", "conductivity": "S/m", "expansion": "1/K", "thermal_conductivity": "W/(m K)",
    "density": "kg/m^3", "specific_heat": "J/(kg K)",
}  # fmt: skip
#: What loads are called, and their units
_LOADS = {
    **{f"r{axis}": (f"moment {axis}", "N m") for axis in "xyz"},
    "potential": ("current", "A"),
    "temperature": ("heat", "W"),
}


def described(model: LoadedModel, picture: str | None) -> str:
    """What a notebook shows: the picture, if there is one, and beside it what the model has."""
    rows = "".join(
        f'<tr><td style="text-align: left; vertical-align: top; white-space: nowrap"><b>{name}</b></td>'
        f'<td style="text-align: left">{"<br>".join(lines)}</td></tr>'
        for name, lines in _rows(model)
        if lines
    )
    size = f"{_count(len(model.x), 'node')}, {_count(len(model.connectivity), 'element')}"
    return (
        '<div style="display: flex; flex-wrap: wrap; align-items: flex-start; gap: 1em">'
        f"<div>{picture or ''}</div><div><b>{html.escape(model.title)}</b><br>{size}<table>{rows}</table></div></div>"
    )


def _rows(model: LoadedModel) -> Iterator[tuple[str, list[str]]]:
    """Names of rows, and their lines as HTML."""
    unit = length_unit(model)
    groups = enumerate(model.groups.values())
    yield "wires", _listed([_swatch(number) + html.escape(_wires(group, unit)) for number, group in groups])
    is_si = unit == "m"
    yield "materials", _escaped([_material(one, is_si) for one in model.materials])
    yield "rigid surfaces", _escaped([f"{one.name}: {one.shape.lower()}" for one in model.surfaces.values()])
    yield "contacts", _escaped([_contact(pair.first, pair.second, pair.interaction) for pair in model.contacts])
    yield "supports", _escaped(_supports(model.supports))
    for step in model.steps:
        title = repr(step).partition(": ")[2].rstrip(">")
        values = [_prescribed(one, is_si) for one in step.prescribed] + [_load(one, is_si) for one in step.loads]
        yield html.escape(step.name), _escaped([title, *values])


def length_unit(model: LoadedModel) -> str:
    """What the unit of lengths is called; empty where the model does not say, or contradicts itself."""
    try:
        units = model.units
    except ValueError:
        return ""
    return "m" if units.get("SYSTEM") == "SI" else units.get("LENGTH", "")


def _swatch(number: int) -> str:
    return f'<span style="color: {COLOURS[number % N_COLOURS]}">&#9632;</span> '


def _wires(group: WireGroup, length_unit: str) -> str:
    section = group.section
    if isinstance(section, Circular):
        size = f"radius {_quantity(section.radius, length_unit)}"
    else:
        size = f"area {with_unit(f'{section.area:g}', length_unit and length_unit + '^2')}"
    elements = _count(len(group.connectivity), f"{group.element} element")
    return f"{group.name}: {_count(len(group.wires), 'wire')}, {elements}, {size}, {group.material.name}"


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def _material(material: Material, is_si: bool) -> str:
    parts = []
    for name, value in _given(material):
        if name in ("name", "units"):
            continue
        words = name.replace("_", " ")
        if isinstance(value, float | int):
            parts.append(f"{words} {_quantity(value, _UNITS.get(name, '') if is_si else '')}")
        else:
            parts.append(f"{words} by temperature" if name in _UNITS else words)
    return f"{material.name}: {', '.join(parts)}"


def _contact(first: str, second: str | None, laws: Interaction) -> str:
    among = f"{first} with {second}" if second else f"among {first}"
    given = [laws.behaviour, laws.conductance, laws.heat]
    friction = laws.friction if isinstance(laws.friction, float | int | None) else laws.friction.mu
    parts = [_law(law) for law in given if law is not None] + ([f"friction {friction:g}"] if friction else [])
    return f"{among}: {', '.join(parts)}" + ("" if laws.conductance else "; no current")


def _law(law: Any) -> str:
    """The name of a law and what differs from its defaults."""
    values = [f"{name}={value!r}" for name, value in _given(law)]
    return f"{type(law).__name__}({', '.join(values)})"


def _given(item: Any) -> Iterator[tuple[str, Any]]:
    """Names and values of the fields that are not left at their defaults."""
    for one in fields(item):
        value = getattr(item, one.name)
        if value is not None and value != _default(one):
            yield one.name, value


def _default(one: Field) -> Any:
    return one.default_factory() if one.default_factory is not MISSING else one.default


def _directions(item: Prescribed) -> str:
    return " ".join(direction_names(range(item.first, item.last + 1)))


def _supports(items: Sequence[Prescribed]) -> list[str]:
    """A line for each target."""
    held: dict[Target, list[str]] = {}
    for item in items:
        held.setdefault(item.target, []).append(_directions(item))
    return [f"{target}: {' '.join(directions)}" for target, directions in held.items()]


def _prescribed(item: Prescribed, is_si: bool) -> str:
    value = _quantity(item.value, unit_of(item.first) if is_si else "")
    return f"{item.target}: {_directions(item)} = {value}{_over_time(item)}"


def _load(load: Load, is_si: bool) -> str:
    direction = direction_names([load.dof])[0]
    what, unit = _LOADS.get(direction, (f"force {direction}", "N"))
    return f"{load.target}: {what} = {_quantity(load.value, unit if is_si else '')}{_over_time(load)}"


def _over_time(item: Prescribed | Load) -> str:
    return f" times {item.amplitude}" if item.amplitude else ""


def _quantity(value: float, unit: str) -> str:
    factor, prefixed = engineering(np.array([value]), unit)
    # without the sign of a zero
    return with_unit(f"{value * factor + 0.0:.6g}", prefixed)


def _escaped(lines: Sequence[str]) -> list[str]:
    return _listed([html.escape(line) for line in lines])


def _listed(lines: list[str]) -> list[str]:
    return lines if len(lines) <= _MAX_LINES else [*lines[:_MAX_LINES], f"... {len(lines) - _MAX_LINES} more"]
