"""The contacts of a run over time: crossings, and zones of contact along lines."""

import numpy as np

from ..base.table import Table
from .contact_places import contact_places
from .contact_zones import contact_zones
from .result_file import ResultFile


def contacts_over_time(results: ResultFile, steps: np.ndarray, increments: np.ndarray) -> Table:
    """Numbers of crossings by themselves and of zones, the sum of all forces, and the largest force per length.

    Parameters
    ----------
    results : ResultFile
    steps, increments : (n,) arrays of int
        The increments of the rows.
    """
    ledger = results.contacts
    place = np.lexsort((ledger["increment"], ledger["step"]))
    largest = int(ledger["increment"].max(initial=0)) + 1
    key = ledger["step"][place] * largest + ledger["increment"][place]
    wanted = np.where(increments < largest, steps * largest + increments, -1)
    first, last = (np.searchsorted(key, wanted, side) for side in ("left", "right"))
    has_lines = "spacing" in ledger and ledger["spacing"].any()
    columns = {name: np.zeros(len(steps), dtype=int) for name in ("crossings", "zones")}
    columns |= {name: np.zeros(len(steps)) for name in ("force", "max_force_per_length")}
    for row, (begin, end) in enumerate(zip(first, last, strict=True)):
        rows = place[begin:end]
        columns["force"][row] = ledger["force"][rows].sum()
        columns["crossings"][row] = len(rows)
        if has_lines and len(rows):
            places = contact_places(results, ledger.where(rows))
            zones = contact_zones(places, results.unit_labels)
            columns["crossings"][row], columns["zones"][row] = (places.zone < 0).sum(), zones.n_rows
            columns["max_force_per_length"][row] = zones["max_force_per_length"].max(initial=0.0)
    units = results.unit_labels
    return Table(
        columns,
        {"crossings": "", "zones": "", "force": units["N"], "max_force_per_length": f"{units['N']}/{units['m']}"},
    )
