"""The largest pressures of elastic contacts, and those at which wires of common metals begin to yield."""

import math

import numpy as np

from ..base.table import Table
from .result_file import ResultFile

#: Poisson's ratio, and yield stresses of annealed and of hard metal [MPa], within some 30 %
_METALS = {
    "aluminium": (0.33, 30, 130),
    "copper": (0.34, 50, 300),
    "gold": (0.42, 30, 200),
    "silver": (0.37, 40, 250),
}


def onsets() -> dict[str, tuple[float, float]]:
    """Pressures at which annealed and hard metal begins to yield under a round spot [MPa] (theory, 15.1)."""
    return {
        name: (1.295 * math.exp(0.736 * poisson) * soft, 1.295 * math.exp(0.736 * poisson) * hard)
        for name, (poisson, soft, hard) in _METALS.items()
    }


def onsets_in_words() -> str:
    """From where on these metals yield."""
    ranges = (f"{name} {round(soft, -1):.0f} to {round(hard, -1):.0f}" for name, (soft, hard) in onsets().items())
    return f"soft to hard metal yields from (MPa): {', '.join(ranges)}"


def wires_yield(ledger: Table) -> np.ndarray:
    """Rows of contacts whose pressure is that of wires that yield (YIELD)."""
    return ledger.get("largest_force", np.zeros(ledger.n_rows)) > 0


def pressure_lines(results: ResultFile) -> list[str]:
    """The largest pressure at the last increment, and what metals bear; empty without contacts."""
    ledger = results.contacts_at(-1)
    # results of litz 0.1 have no pressures
    if "pressure" not in ledger or not ledger.n_rows or not ledger["pressure"].any():
        return []
    worst = int(np.argmax(ledger["pressure"]))
    unit = ledger.units["pressure"]
    largest = f"  largest pressure       {ledger['pressure'][worst]:12.5g} {unit:4} in contact {ledger['id'][worst]}"
    if wires_yield(ledger)[worst]:
        return [f"{largest}, of wires that yield"]
    # numbers in unknown units cannot be compared
    return [f"{largest}, if the wires stay elastic", *[f"    {onsets_in_words()}"] * bool(unit)]
