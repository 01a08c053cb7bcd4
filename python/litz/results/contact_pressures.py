"""The largest pressures of elastic contacts, and those at which wires of common metals begin to yield."""

import math

import numpy as np

from ..base.quantities import with_unit
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
    """The largest pressures of the whole run and when they were, and what metals bear; empty without contacts."""
    ledger, time = results.contacts, results.unit_labels["s"]
    lines = []
    for worst, remark in _largest_pressures(ledger):
        value = f"{ledger['pressure'][worst]:12.5g} {ledger.units['pressure']:4}"
        lines.append(f"  largest pressure       {value} {_place(ledger, worst, time)}, {remark}")
        # numbers in unknown units cannot be compared
        if ledger.units["pressure"] and not wires_yield(ledger)[worst]:
            lines.append(f"    {onsets_in_words()}")
    return lines


def pressures_in_words(results: ResultFile) -> str:
    """What `pressure_lines` tells, in one line; empty without contacts."""
    return "; ".join(" ".join(line.split()) for line in pressure_lines(results))


def _largest_pressures(ledger: Table) -> list[tuple[int, str]]:
    """Rows of the largest pressure of wires that stay elastic, and of those that yield."""
    # results of litz 0.1 have no pressures
    if "pressure" not in ledger or not ledger.n_rows:
        return []
    yields = wires_yield(ledger)
    found = []
    for of_kind, remark in ((~yields, "if the wires stay elastic"), (yields, "of wires that yield")):
        pressure = np.where(of_kind, ledger["pressure"], 0.0)
        if pressure.any():
            found.append((int(np.argmax(pressure)), remark))
    return found


def _place(ledger: Table, row: int, unit: str) -> str:
    """Which contact, and when."""
    time = with_unit(f"{ledger['time'][row]:g}", unit)
    return f"in contact {ledger['id'][row]} at time {time} (step {ledger['step'][row]}, increment {ledger['increment'][row]})"
