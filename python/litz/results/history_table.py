"""The history of a run as a table to read."""

import re

import numpy as np

from ..base.table import Table
from .contact_history import contacts_over_time
from .contact_increments import NOT_WRITTEN_NOTE
from .result_file import ResultFile

_MAX_COLUMNS = 6
_MAX_ROWS = 40
#: Parts of the largest value below which there is only round-off: what the iteration leaves of the components of a vector,
#: the largest of which has seven digits here, and of other quantities, which may grow by many orders of magnitude
_OF_A_VECTOR, _OF_A_COLUMN = 1e-8, 1e-13


def history_table(results: ResultFile) -> str:
    """Contacts, contact force and the history of a run, a line per increment; long tables are thinned out.

    A zone of contact along a line counts as one contact, and so does each element that touches a rigid surface: the first
    line says which kinds of contacts there are.
    """
    history = results.history
    names = [name for name in history if name not in ("step", "increment", "time")]
    shown = names[:_MAX_COLUMNS]
    contacts = contacts_over_time(results, history["step"], history["increment"])
    clean = _without_round_off({name: history[name] for name in names})
    columns = [history["time"], contacts["contacts"], contacts["force"], *(clean[name] for name in shown)]
    heads = ["time", "contacts", "contact force", *shown]
    units = [results.unit_labels["s"], "", results.unit_labels["N"], *(history.units[name] for name in shown)]

    rows = np.unique(np.linspace(0, history.n_rows - 1, min(history.n_rows, _MAX_ROWS)).round().astype(int))
    cells = [heads, *[[f"[{unit}]" if unit else "" for unit in units]] * any(units)]
    has = ~np.isnan(contacts["contacts"])
    cells += [
        [f"{column[row]:.7g}" if has[row] or k not in (1, 2) else "-" for k, column in enumerate(columns)]
        for row in rows
    ]
    widths = [max(len(line[i]) for line in cells) for i in range(len(heads))]
    lines = _kinds(contacts.where(has))
    if not has[rows].all():
        lines.append(f"-: {NOT_WRITTEN_NOTE}")
    lines += ["  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)) for line in cells]
    if len(rows) < history.n_rows:
        lines.append(f"{len(rows)} of {history.n_rows} increments")
    if len(shown) < len(names):
        lines.append(f"{len(names) - len(shown)} more columns are in {results.path.stem}_history.csv")
    return "\n".join(lines) + "\n"


def _without_round_off(columns: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Zeros for what is round-off of the largest value over time, or of the largest component of the same vector."""
    vectors = {name: re.sub(r"^([A-Z]+)\d", r"\1", name) for name in columns}
    largest: dict[str, float] = {}
    for name, values in columns.items():
        size = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
        largest[vectors[name]] = max(largest.get(vectors[name], 0.0), size)
    clean = {}
    for name, values in columns.items():
        part = _OF_A_COLUMN if name == vectors[name] else _OF_A_VECTOR
        clean[name] = np.where(np.abs(values) < part * largest[vectors[name]], 0.0, values)
    return clean


def _kinds(contacts: Table) -> list[str]:
    """What the number of contacts and their force are the sums of, if not of crossings alone."""
    names = {
        "crossings": "crossings",
        "zones": "zones of contact along lines",
        "on_surfaces": "elements on rigid surfaces",
    }
    found = [text for name, text in names.items() if contacts[name].any()]
    if not found or found == ["crossings"]:
        return []
    kinds = " and ".join([", ".join(found[:-1])] * (len(found) > 1) + found[-1:])
    return [f"contacts: {kinds}; contact force: the sum of all their forces"]
