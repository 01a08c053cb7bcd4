"""What rigid surfaces feel of the wires."""

import numpy as np

from ..base.table import Table
from .result_file import ResultFile


def surface_forces(results: ResultFile) -> Table:
    """What each surface feels at each increment of the history: a row for each surface and increment."""
    if not results.rigid_surfaces:
        return Table({}, {})
    contacts, history = results.surface_contacts, results.history
    unit = results.unit_labels
    names = np.array(list(results.rigid_surfaces), dtype=str)
    keys = ("step", "increment", "time")
    columns = {key: np.repeat(history[key], len(names)) for key in keys}
    row_of = {key: row for row, key in enumerate(zip(history["step"], history["increment"], strict=True))}
    place_of = {name: place for place, name in enumerate(names)}
    rows = np.array(
        [
            row_of[step, increment] * len(names) + place_of[name]
            for step, increment, name in zip(contacts["step"], contacts["increment"], contacts["surface"], strict=True)
        ],
        dtype=int,
    )
    n = len(columns["time"])
    columns["contacts"] = np.bincount(rows, minlength=n)
    for name in ("length", "force", *_components("surface_force"), *_components("surface_moment"), "dissipation"):
        columns[name] = np.bincount(rows, contacts[name], minlength=n)
    columns["penetration"] = np.zeros(n)
    np.maximum.at(columns["penetration"], rows, -contacts["gap"])
    columns["surface"] = np.tile(names, history.n_rows)
    units = {**contacts.units, "time": unit["s"], "contacts": "", "penetration": unit["m"]}
    return Table(columns, {name: units.get(name, "") for name in columns})


def joule_heat_on_surfaces(contacts: Table) -> np.ndarray:
    """Heat of the currents in contacts with rigid surfaces, (n) [W]; files of earlier versions have none."""
    return contacts["joule_heat"] if "joule_heat" in contacts else np.zeros(contacts.n_rows)


def _components(name: str) -> list[str]:
    return [f"{name}_{axis}" for axis in "xyz"]
