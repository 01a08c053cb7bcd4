"""A page of text about a run."""

import re
from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from ..base.quantities import with_unit
from ..base.table import Table
from ..errors import WarningEntry
from .contact_places import ContactPlaces, contact_places
from .contact_pressures import pressure_lines
from .contact_zones import contact_zones, wire_pairs
from .result_file import ResultFile
from .scalars import known_potential
from .surface_forces import joule_heat_on_surfaces, surface_forces

Values = TypeVar("Values", np.ndarray, float)

_MAX_ROWS = 30
_NOT_WRITTEN = "not written (*CONTACT FILE)"
_MAX_PAIRS = 12
#: Width of the names of numbers
_NAME_WIDTH = 25
# What is smaller beside the largest of its kind in the run is round-off, and what is smaller in SI units may be; the square of a
# current and what cancels in a balance of heat have their own
_ROUND_OFF, _SQUARED, _CANCELLED = 1e-12, 1e-24, 1e-9
_MAY_BE_ROUND_OFF = 1e-12


def summary(results: ResultFile) -> str:
    """What was run, the increments as a table, the largest pressures, and the last increment in numbers."""
    parts = [_origin(results), _increments(results)]
    found = results.warnings
    if found:
        parts.append("\n".join([f"{len(found)} warning{'s' * (len(found) > 1)}:", *map(_warning, found)]))
    pressures = pressure_lines(results)
    if pressures:
        of_all = (
            "over all increments" if results.has_contacts().all() else "over the increments with contacts in the ledger"
        )
        parts.append("\n".join([f"{of_all}:", *map(_tidy, pressures)]))
    if len(results.times):
        parts.append(_last_increment(results))
    return "\n\n".join(parts) + "\n"


def _origin(results: ResultFile) -> str:
    state = "finished" if results.finished else "NOT FINISHED"
    heading = results.heading.strip() or "(no heading)"
    return (
        f"{heading}\n{results.path}, litz {results.version}, {state}\n"
        f"{len(results.nodes)} nodes, {len(results.elements)} elements, {len(results.times)} increments in the file"
    )


def _warning(entry: "WarningEntry") -> str:
    return f"  {entry.kind}: {entry}" if entry.count > 1 else f"  {entry.kind}: {entry} ({entry.first})"


def _increments(results: ResultFile) -> str:
    """One line per line of the .sta file; the middle is left out of a long one."""
    status = results.status
    heads = ("step", "increment", "attempts", "iterations", "time", "time_increment", "force", "contacts", "remark")
    titles = tuple("residual" if head == "force" else head for head in heads)
    rows = [titles, tuple(f"[{status.units[head]}]" if status.units[head] else "" for head in heads)]
    picked: Sequence[int | None] = range(status.n_rows)
    if status.n_rows > _MAX_ROWS:
        half = _MAX_ROWS // 2
        picked = [*range(half), None, *range(status.n_rows - half, status.n_rows)]
    rows += [("...",) * len(heads) if i is None else tuple(_cell(status[head][i]) for head in heads) for i in picked]
    return _aligned(rows)


def _last_increment(results: ResultFile) -> str:
    size = np.linalg.norm(results.field("displacement"), axis=1)
    largest = _without_round_off(size.max(), _largest(results, "displacement", size.max()), _ROUND_OFF)
    potential = results.field("potential")
    potential = _without_round_off(potential, _largest(results, "potential", np.abs(potential).max()), _ROUND_OFF)
    known = potential[np.isfinite(known_potential(results, -1))]
    contacts = results.written_contacts_at(-1)
    has_contacts = bool(results.has_contacts()[-1])
    entering = results.field("reaction_current") + results.field("applied_current")
    unit = results.unit_labels
    places = contact_places(results, contacts)
    zones = contact_zones(places, unit)
    heat_wires, heat_contacts = results.field("joule_heat").sum(), contacts["joule_heat"].sum()
    heat_surfaces = joule_heat_on_surfaces(results.surface_contacts_at(-1)).sum()
    time = with_unit(f"{results.times[-1]:g}", unit["s"])
    lines = [
        f"at time {time} (step {results.steps[-1]}, increment {results.increments[-1]}):",
        f"  largest displacement   {largest:12.5g} {unit['m']:4}"
        + (f" at node {results.node_ids[size.argmax()]}" if largest else ""),
        f"  potential              {known.min():12.5g} {unit['V']:4} to {known.max():.5g} {unit['V']}",
    ]
    name = "contacts of wires" if results.rigid_surfaces else "contacts"
    lines += _contacts(places, zones, unit, name) if has_contacts else [f"  {name:22} {_NOT_WRITTEN:>12}"]
    lines += _on_surfaces(results)
    heat = heat_wires + heat_contacts + heat_surfaces
    if _without_round_off(heat, _largest(results, "joule_heat", heat) * len(results.elements), _SQUARED) > 0:
        of_contacts = f"{heat_contacts:.5g} {unit['W']}" if has_contacts else _NOT_WRITTEN
        of_surfaces = f", on rigid surfaces {heat_surfaces:.5g} {unit['W']}" if heat_surfaces else ""
        lines += [
            f"  electric power in      {potential @ entering:12.5g} {unit['W']}",
            (
                f"  Joule heat             {heat:12.5g} {unit['W']:4} {'' if has_contacts else 'without that of contacts '}"
                f"(wires {heat_wires:.5g} {unit['W']}, contacts {of_contacts}{of_surfaces})"
            ),
        ]
    lines += _heat(results)
    history = results.history
    lines += [
        f"  {name}  {history[name][-1]:.8g} {history.units[name]}" for name in history if name.startswith("resistance ")
    ]
    return "\n".join([_tidy(line) for line in lines] + _pairs(places, zones, unit))


def _largest(results: ResultFile, field: str, now: float) -> float:
    """Largest size of a value of a field in the run, where what is `now` may be round-off of it; else `now`."""
    if not 0 < now < _MAY_BE_ROUND_OFF:
        return now
    return max(float(np.abs(results.field(field, increment)).max()) for increment in range(len(results.times)))


def _without_round_off(values: Values, largest: float, share: float) -> Values:
    """Values with zeros in place of those that are below a share of the largest of their kind."""
    return values * (np.abs(values) > share * largest)


def _heat(results: ResultFile) -> list[str]:
    """Temperatures, and where the heat leaves the wires, in models that have temperatures."""
    if "temperature" not in results.fields:
        return []
    temperature, watt = results.field("temperature"), results.unit_labels["W"]
    flows = [-results.field("reaction_heat"), results.field("surface_heat")]
    supports, sides = (
        float(_without_round_off(flow.sum(), sum(np.abs(one).sum() for one in flows), _CANCELLED)) for flow in flows
    )
    hottest = results.node_ids[temperature.argmax()]
    lines = [f"  temperature            {_range(temperature, results.units['temperature'])} at node {hottest}"]
    contacts = results.written_contacts_at(-1)
    spots = contacts.get("temperature_max", np.zeros(0))
    if spots.any():
        lines.append(
            f"  hottest spot           {spots.max():12.5g} {results.units['temperature']:4} "
            f"in contact {contacts['id'][spots.argmax()]}"
        )
    if supports or sides:
        lines.append(
            f"  heat out               {supports + sides:12.5g} {watt:4} "
            f"(prescribed temperatures {supports:.5g} {watt}, films and radiation {sides:.5g} {watt})"
        )
    stored = _stored(results)
    if stored:
        lines.append(f"  heat stored            {stored:12.5g} {watt:4}")
    return lines


def _stored(results: ResultFile) -> float:
    """What the wires take up of the heat at the last increment; 0 where steps are steady."""
    return float(results.field("stored_heat").sum()) if "stored_heat" in results.fields else 0.0


def _contacts(places: ContactPlaces, zones: Table, unit: dict[str, str], name: str) -> list[str]:
    """Crossings with the range of their forces, zones of line contact with that of their forces per length.

    `name` is that of crossings where there are no zones.
    """
    force = places.ledger["force"]
    alone = force[places.zone < 0]
    lines = []
    if alone.size or not zones.n_rows:
        lines.append(f"  {'crossings' if zones.n_rows else name:23}{alone.size:12d}")
    if alone.size:
        lines.append(f"  contact forces         {_range(alone, unit['N'])}, sum {alone.sum():.5g} {unit['N']}")
    if zones.n_rows:
        length, force, mean, largest = (
            zones[name] for name in ("length", "force", "force_per_length", "max_force_per_length")
        )
        per_length = zones.units["force_per_length"]
        lines += [
            f"  zones of line contact  {zones.n_rows:12d}",
            f"  length of zones        {_range(length, unit['m'])}, sum {length.sum():.5g} {unit['m']}",
            f"  forces of zones        {_range(force, unit['N'])}, sum {force.sum():.5g} {unit['N']}",
            f"  forces per length      {_range(mean, per_length)}, largest {largest.max():.5g} {per_length}",
        ]
    return lines


def _tidy(line: str) -> str:
    """A line without the blanks of units that have no name: before a comma or at the end, and for all units are 4 wide."""
    name, rest = line[:_NAME_WIDTH], line[_NAME_WIDTH:]
    number = rest[: len(rest) - len(rest.lstrip())]
    return (name + number + re.sub(r"(?<=\S) +(?=[,;)]|$)", "", rest.lstrip())).rstrip()


def _range(values: np.ndarray, unit: str) -> str:
    return f"{values.min():12.5g} {unit:4} to {values.max():.5g} {unit}"


def _pairs(places: ContactPlaces, zones: Table, unit: dict[str, str]) -> list[str]:
    """The pairs of wires that touch along lines, those with the largest forces first."""
    if not zones.n_rows:
        return []
    pairs = wire_pairs(places, unit)
    pairs = pairs.where(pairs["zones"] > 0)
    shown = pairs.where(np.argsort(-pairs["force"], kind="stable")[:_MAX_PAIRS])
    heads = list(pairs)
    rows = [tuple(name.rstrip("_12").replace("_", " ") for name in heads)]
    rows.append(tuple(f"[{pairs.units[name]}]" if pairs.units[name] else "" for name in heads))
    # wires are counted from 1 where users read their numbers
    shown = Table({name: values + name.startswith("wire") for name, values in shown.items()}, shown.units)
    rows += [tuple(_cell(shown[name][i]) for name in heads) for i in range(shown.n_rows)]
    more = f"\n{pairs.n_rows - shown.n_rows} more pairs" if pairs.n_rows > shown.n_rows else ""
    return ["", "line contact by pairs of wires, numbered from 1 by their first elements:", _aligned(rows) + more]


def _on_surfaces(results: ResultFile) -> list[str]:
    """A line for each rigid surface: the resultant of the wires on it."""
    if not results.rigid_surfaces:
        return []
    table, unit = surface_forces(results), results.unit_labels
    now = table.where((table["step"] == results.steps[-1]) & (table["increment"] == results.increments[-1]))
    lines = []
    for k, name in enumerate(now["surface"]):
        parts = np.array([now[f"surface_force_{axis}"][k] for axis in "xyz"])
        size = float(np.linalg.norm(parts))
        parts = np.where(np.abs(parts) > 1e-9 * size, parts, 0.0)
        lines.append(
            f"  {'force on ' + name:22} {size:12.5g} {unit['N']:4} ({', '.join(f'{part:.5g}' for part in parts)}), "
            f"{now['contacts'][k]} elements touch it along {now['length'][k]:.4g} {unit['m']}"
        )
    return lines


def _cell(value: object) -> str:
    if isinstance(value, np.floating):
        return f"{value:.4g}"
    return str(value)


def _aligned(rows: list[tuple[str, ...]]) -> str:
    """Columns flush right, the last one flush left; without the row of units where none has a name."""
    rows = [row for row in rows if any(row)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join(
        "  ".join([*(cell.rjust(width) for cell, width in zip(row[:-1], widths[:-1], strict=True)), row[-1]]).rstrip()
        for row in rows
    )
