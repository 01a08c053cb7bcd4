"""The tables of the report about rigid surfaces."""

import numpy as np

from ..base.quantities import in_brackets
from ..base.table import Table
from ..results import Results
from .report_tables import amount, table

_MAX_CONTACTS = 8


def surfaces(results: Results) -> list[str]:
    """Rigid surfaces, what they feel at the last increment, and the worst contacts with them; empty without any."""
    if not results.rigid_surfaces:
        return []
    return ["<h2>Rigid surfaces</h2>", _shapes(results), _felt(results), _worst(results)]


def surface_contacts_of_iterate(last: Results) -> str:
    """The deepest contacts with surfaces of an iterate that was given up."""
    contacts = last.surface_contacts
    if not contacts.n_rows:
        return ""
    rows = np.argsort(contacts["gap"])[:_MAX_CONTACTS]
    return _contact_table("deepest contacts with rigid surfaces", contacts, rows, with_time=False)


def _shapes(results: Results) -> str:
    unit = results.unit_labels["m"]
    rows = [
        (
            name,
            one.shape.lower(),
            _vector(one.point, unit),
            " ".join(f"{part:.4g}" for part in one.direction),
            amount(one.radius, unit) if one.radius else "-",
            one.reference_node or "fixed in space",
        )
        for name, one in results.rigid_surfaces.items()
    ]
    return table(("surface", "shape", "point", "normal or axis", "radius", "reference node"), rows, text=[1])


def _felt(results: Results) -> str:
    """Forces of the wires on each surface at the last increment, and what its reference node is held with."""
    forces, unit = results.surface_forces, results.unit_labels
    now = forces.where((forces["step"] == results.steps[-1]) & (forces["increment"] == results.increments[-1]))
    rows = []
    for k, name in enumerate(now["surface"]):
        node = results.rigid_surfaces[name].reference_node
        reaction = "-"
        if node is not None:
            reaction = _vector(results.field("reaction_force")[results.node_ids == node][0], unit["N"])
        rows.append(
            (
                name,
                now["contacts"][k],
                amount(now["length"][k], unit["m"]),
                amount(now["penetration"][k], unit["m"]),
                amount(now["force"][k], unit["N"]),
                _vector([now[f"surface_force_{axis}"][k] for axis in "xyz"], unit["N"]),
                _vector([now[f"surface_moment_{axis}"][k] for axis in "xyz"], unit["N m"]),
                reaction,
            )
        )
    heads = ("at the last increment", "elements", "length", "penetration", "contact force", "force on it", "moment on it",
             "reaction of its node")  # fmt: skip
    return table(heads, rows)


def _vector(values: np.ndarray | list[float], unit: str) -> str:
    """Three components with one unit; what is round-off of the largest is 0."""
    largest = float(np.abs(values).max())
    shown = [value if abs(value) > 1e-9 * largest else 0.0 for value in map(float, values)]
    text = amount(largest, unit)
    number, _, symbol = text.partition(" ")
    factor = float(number) / largest if largest > 0 else 1.0
    return f"({', '.join(f'{factor * value:.4g}' for value in shown)}) {symbol}".strip()


def _worst(results: Results) -> str:
    contacts = results.surface_contacts
    if not contacts.n_rows:
        return "<p>No wires have touched a rigid surface.</p>"
    keys = np.char.add(contacts["element"].astype(str), contacts["surface"])
    measures = [("largest penetration", -contacts["gap"]), ("largest force", contacts["force"])]
    return "".join(
        _contact_table(f"{name} on a rigid surface", contacts, _worst_of_each(keys, values)[:_MAX_CONTACTS])
        for name, values in measures
    )


def _worst_of_each(keys: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Rows in falling order of their values, only the first of each element and surface."""
    order = np.argsort(-values, kind="stable")
    return order[np.sort(np.unique(keys[order], return_index=True)[1])]


def _contact_table(name: str, contacts: Table, rows: np.ndarray, *, with_time: bool = True) -> str:
    unit = contacts.units
    heads = [name, "wires", "surface", "penetration", "length", "force", "friction", "", "at"]
    heads += ["step:increment", f"time{in_brackets(unit['time'])}"] if with_time else []
    lines = []
    for k in rows:
        traction = float(np.linalg.norm([contacts[f"traction_{axis}"][k] for axis in "xyz"]))
        line = [
            f"element {contacts['element'][k]}",
            contacts["wires"][k],
            contacts["surface"][k],
            amount(max(0.0, -contacts["gap"][k]), unit["gap"]),
            amount(contacts["length"][k], unit["length"]),
            amount(contacts["force"][k], unit["force"]),
            amount(traction, unit["force"]) if traction > 0 else "-",
            contacts["friction"][k],
            _vector([contacts[f"point_{axis}"][k] for axis in "xyz"], unit["point_x"]),
        ]
        if with_time:
            line += [f"{contacts['step'][k]}:{contacts['increment'][k]}", f"{contacts['time'][k]:g}"]
        lines.append(line)
    return table(heads, lines, text=[1, 2])
