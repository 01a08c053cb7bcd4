"""The contacts of a run over time: crossings, zones of contact along lines, and elements on rigid surfaces."""

from collections.abc import Iterator

import numpy as np

from ..base.quantities import per
from ..base.table import Table
from .contact_places import contact_places
from .contact_zones import contact_zones
from .result_file import ResultFile

#: Contact forces below this part of the largest are round-off
FORCE_ROUND_OFF = 1e-9
#: The same of currents
_CURRENT_ROUND_OFF = 1e-9


def with_clean_currents(ledger: Table, largest: float) -> Table:
    """The contacts (a ledger) with a current of zero where it is only round-off of the largest of the run [A]."""
    flows = np.abs(ledger["current"]) >= _CURRENT_ROUND_OFF * largest
    return ledger.with_column("current", np.where(flows, ledger["current"], 0.0))


def contacts_over_time(results: ResultFile, steps: np.ndarray, increments: np.ndarray) -> Table:
    """Numbers of contacts of each kind and of all, sums of their forces, and the largest force per length of wires.

    `crossings` by themselves and `zones` of line contact are between wires, with `force_between_wires`; each element that
    touches a rigid surface is one of `on_surfaces`, with `force_on_surfaces`; `contacts` and `force` are the sums. Contacts
    between wires whose force is only round-off do not count. What is of contacts between wires is nan where these are not in the
    ledger.

    Parameters
    ----------
    results : ResultFile
    steps, increments : (n,) arrays of int
        The increments of the rows.
    """
    ledger, units = results.contacts, results.unit_labels
    lines = has_lines(results)
    columns = {name: np.zeros(len(steps), dtype=int) for name in ("crossings", "zones")}
    columns |= {name: np.zeros(len(steps)) for name in ("force_between_wires", "max_force_per_length")}
    pressed = np.abs(ledger["force"]) >= FORCE_ROUND_OFF * np.abs(ledger["force"]).max(initial=0.0)
    for place, every in enumerate(_rows_of_increments(ledger, steps, increments)):
        rows = every[pressed[every]]
        columns["force_between_wires"][place] = ledger["force"][rows].sum()
        columns["crossings"][place] = len(rows)
        if lines and len(rows):
            places = contact_places(results, ledger.where(rows))
            zones = contact_zones(places, units)
            columns["crossings"][place], columns["zones"][place] = (places.zone < 0).sum(), zones.n_rows
            columns["max_force_per_length"][place] = zones["max_force_per_length"].max(initial=0.0)
    has = results.has_contacts(steps, increments)
    if not has.all():
        columns = {name: np.where(has, values, np.nan) for name, values in columns.items()}
    columns["on_surfaces"], columns["force_on_surfaces"] = _on_surfaces(results, steps, increments)
    columns["contacts"] = columns["crossings"] + columns["zones"] + columns["on_surfaces"]
    columns["force"] = columns["force_between_wires"] + columns["force_on_surfaces"]
    in_units = {name: units["N"] if name.startswith("force") else "" for name in columns}
    return Table(columns, in_units | {"max_force_per_length": per(units["N"], units["m"])})


def _on_surfaces(results: ResultFile, steps: np.ndarray, increments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number of elements that touch rigid surfaces, and sum of their forces, at each of the increments."""
    ledger = results.surface_contacts
    number, force = np.zeros(len(steps), dtype=int), np.zeros(len(steps))
    if ledger.n_rows:
        for place, rows in enumerate(_rows_of_increments(ledger, steps, increments)):
            number[place], force[place] = len(rows), ledger["force"][rows].sum()
    return number, force


def crossings_by_themselves(results: ResultFile) -> np.ndarray:
    """Which rows of the whole ledger are in no zone of line contact, (n_rows)."""
    ledger = results.contacts
    alone = np.ones(ledger.n_rows, dtype=bool)
    if has_lines(results):
        steps, increments = np.unique(np.stack([ledger["step"], ledger["increment"]]), axis=1)
        for rows in _rows_of_increments(ledger, steps, increments):
            alone[rows] = contact_places(results, ledger.where(rows)).zone < 0
    return alone


def has_lines(results: ResultFile) -> bool:
    """Wires have touched along a line."""
    ledger = results.contacts
    return bool("spacing" in ledger and ledger["spacing"].any())


def _rows_of_increments(ledger: Table, steps: np.ndarray, increments: np.ndarray) -> Iterator[np.ndarray]:
    """Rows of the ledger at each increment."""
    order = np.lexsort((ledger["increment"], ledger["step"]))
    largest = int(max(ledger["increment"].max(initial=0), increments.max(initial=0))) + 1
    key = ledger["step"][order] * largest + ledger["increment"][order]
    wanted = steps * largest + increments
    first, last = (np.searchsorted(key, wanted, side) for side in ("left", "right"))
    for begin, end in zip(first, last, strict=True):
        yield order[begin:end]
