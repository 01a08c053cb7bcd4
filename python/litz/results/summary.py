"""A page of text about a run."""

from collections.abc import Sequence

import numpy as np

from ..errors import WarningEntry
from .result_file import ResultFile
from .surface_forces import surface_forces

_MAX_ROWS = 30


def summary(results: ResultFile) -> str:
    """What was run, the increments as a table, and the last increment in numbers."""
    parts = [_origin(results), _increments(results)]
    found = results.warnings
    if found:
        parts.append("\n".join([f"{len(found)} warning{'s' * (len(found) > 1)}:", *map(_warning, found)]))
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
    potential = results.field("potential")
    contacts = results.contacts_at(-1)
    entering = results.field("reaction_current") + results.field("applied_current")
    unit = results.unit_labels
    heat_wires, heat_contacts = results.field("joule_heat").sum(), contacts["joule_heat"].sum()
    lines = [
        f"at time {results.times[-1]:g} {unit['s']} (step {results.steps[-1]}, increment {results.increments[-1]}):",
        f"  largest displacement   {size.max():12.5g} {unit['m']:4} at node {results.node_ids[size.argmax()]}",
        f"  potential              {potential.min():12.5g} {unit['V']:4} to {potential.max():.5g} {unit['V']}",
        f"  contacts               {contacts.n_rows:12d}",
    ]
    if contacts.n_rows:
        force = contacts["force"]
        lines.append(
            f"  contact forces         {force.min():12.5g} {unit['N']:4} to {force.max():.5g} {unit['N']}, "
            f"sum {force.sum():.5g} {unit['N']}"
        )
    lines += _on_surfaces(results)
    if heat_wires + heat_contacts > 0:
        lines += [
            f"  electric power in      {potential @ entering:12.5g} {unit['W']}",
            (
                f"  Joule heat             {heat_wires + heat_contacts:12.5g} {unit['W']:4} "
                f"(wires {heat_wires:.5g} {unit['W']}, contacts {heat_contacts:.5g} {unit['W']})"
            ),
        ]
    history = results.history
    lines += [
        f"  {name}  {history[name][-1]:.8g} {history.units[name]}" for name in history if name.startswith("resistance ")
    ]
    return "\n".join(lines)


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
    """Columns flush right, the last one flush left."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join(
        "  ".join([*(cell.rjust(width) for cell, width in zip(row[:-1], widths[:-1], strict=True)), row[-1]]).rstrip()
        for row in rows
    )
