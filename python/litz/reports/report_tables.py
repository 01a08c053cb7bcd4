"""The tables of the report."""

import html
from collections.abc import Callable, Iterable

import numpy as np

from ..base.quantities import engineering, in_brackets, per, with_unit
from ..base.table import Table
from ..results import Results
from ..results.contact_history import crossings_by_themselves, with_clean_currents
from ..results.contact_pressures import pressures_in_words
from ..results.surface_forces import joule_heat_on_surfaces
from ..wires.curves import arc_lengths

_MAX_CONTACTS = 8
_MAX_REMARKS = 12
_MAX_SETS = 20


def table(heads: Iterable[object], rows: Iterable[Iterable[object]], text: Iterable[int] = ()) -> str:
    """An HTML table; columns with the numbers in `text` are flush left, as the first one is."""
    left = set(text)

    def line(tag: str, cells: Iterable[object]) -> str:
        marks = (' class="text"' if column in left else "" for column in range(100))
        inside = "".join(
            f"<{tag}{mark}>{html.escape(str(cell))}</{tag}>" for cell, mark in zip(cells, marks, strict=False)
        )
        return f"<tr>{inside}</tr>"

    body = line("th", heads) + "".join(line("td", row) for row in rows)
    return f'<div class="wide"><table class="data">{body}</table></div>'


def amount(value: float, unit: str) -> str:
    """A number with a unit that suits it: 0.0012, "V" -> "1.2 mV"; "∞" without a unit."""
    if np.isinf(value):
        return "∞" if value > 0 else "-∞"
    factor, symbol = engineering(np.array([value]), unit)
    return f"{factor * value:.4g} {symbol}".strip()


def verdict(results: Results) -> str:
    """Whether the run came to its end, and how far."""
    n, status = int((results.steps > 0).sum()), results.status
    time = html.escape(with_unit(f"{results.times[-1]:g}", results.unit_labels["s"])) if n else ""
    work = f"{n} increment{'s' * (n != 1)}, {int(status['iterations'].sum())} iterations"
    if results.finished:
        return f'<p class="verdict">The run finished at time {time}: {work}.</p>'
    where = f"the last increment that converged is at time {time}" if n else "no increment has converged"
    return f'<p class="verdict bad">The run did not finish (or still runs): {where}; {work}.</p>'


def model(results: Results) -> str:
    """Sizes of the model."""
    nodes, elements = results.nodes, results.elements
    wires = results.wires
    _, lengths, _ = arc_lengths(nodes, elements, wires)
    radii = np.unique(results.radius)
    unit = results.unit_labels["m"]
    extent = " by ".join(amount(size, unit) for size in np.ptp(nodes, axis=0))
    rows = [
        ("nodes", len(nodes)),
        ("elements", len(elements)),
        ("wires", len(wires)),
        ("length of all wires", amount(lengths.sum(), unit)),
        ("lengths of elements", _range(lengths, unit)),
        ("radius" if len(radii) == 1 else "radii", _range(radii, unit)),
        ("extent along x, y, z", extent),
        ("node sets", _sets(results.node_sets)),
        ("element sets", _sets(results.element_sets)),
    ]
    return table(("model", ""), rows, text=[1])


def _range(values: np.ndarray, unit: str) -> str:
    low, high = amount(values.min(), unit), amount(values.max(), unit)
    return low if low == high else f"{low} to {high}"


def _sets(sets: dict[str, np.ndarray]) -> str:
    shown = [f"{name} ({len(members)})" for name, members in list(sets.items())[:_MAX_SETS]]
    more = [f"and {len(sets) - _MAX_SETS} more"] if len(sets) > _MAX_SETS else []
    return ", ".join(shown + more) or "none"


def balance(results: Results) -> str:
    """The worst figures of the audit, and where power and current go at the last increment."""
    if not len(results.times):
        return "<p>There is no increment.</p>"
    names = {
        "force_balance": "forces", "moment_balance": "moments", "current_balance": "currents",
        "power_balance": "power", "penetration_ratio": "penetration over radius",
    }  # fmt: skip
    rows = []
    for name, values in results.audit.items():
        k = int(np.argmax(values))
        rows.append((names.get(name, name), f"{values[k]:.2g}", f"{results.steps[k]}:{results.increments[k]}"))
    audit = table(("audit: what is left of a sum, over its largest part", "worst", "step:increment"), rows)
    return audit + _power(results) + _heat(results) + _energies(results)


def _power(results: Results) -> str:
    entering = results.field("reaction_current") + results.field("applied_current")
    potential = results.field("potential")
    wires, contacts = results.field("joule_heat").sum(), results.written_contacts_at(-1)["joule_heat"].sum()
    has_contacts = results.has_contacts()[-1]
    if not entering.any():
        return ""
    unit = results.unit_labels
    rows = [
        ("current in", amount(entering[entering > 0].sum(), unit["A"])),
        ("current out", amount(-entering[entering < 0].sum(), unit["A"])),
        ("electric power in", amount(potential @ entering, unit["W"])),
        ("Joule heat of the wires", amount(wires, unit["W"])),
        ("Joule heat of the contacts", amount(contacts, unit["W"]) if has_contacts else "not written (*CONTACT FILE)"),
    ]
    on_surfaces = joule_heat_on_surfaces(results.surface_contacts_at(-1)).sum()
    if on_surfaces:
        rows.append(("Joule heat on rigid surfaces", amount(on_surfaces, unit["W"])))
    return table(("current and power at the last increment", ""), rows)


def _heat(results: Results) -> str:
    """Where heat enters and leaves, in models that solve for temperatures."""
    if "temperature" not in results.fields:
        return ""
    temperature, supports, sides = (
        results.field(name) for name in ("temperature", "reaction_heat", "surface_heat")
    )  # fmt: skip
    kelvin, watt = results.units["temperature"], results.unit_labels["W"]
    rows = [
        ("lowest temperature", amount(temperature.min(), kelvin)),
        (f"highest temperature, at node {results.node_ids[temperature.argmax()]}", amount(temperature.max(), kelvin)),
        ("heat in at nodes", amount(results.field("applied_heat").sum(), watt)),
        ("heat out where temperatures are prescribed", amount(-supports.sum(), watt)),
        ("heat out by films and radiation", amount(sides.sum(), watt)),
    ]
    if "stored_heat" in results.fields and results.field("stored_heat").any():
        rows.append(("heat stored in the wires", amount(results.field("stored_heat").sum(), watt)))
    return table(("temperatures and heat at the last increment", ""), rows)


def _energies(results: Results) -> str:
    """Energies, where the deck asks for them (*ENERGY PRINT)."""
    meanings = {
        "ALLWK": "work of loads and supports", "ALLSE": "elastic energy of the wires", "ALLCCE": "energy of the contacts",
        "ALLFD": "heat of friction", "ALLPD": "dissipated by yielding", "ALLSD": "taken by stabilization",
        "ETOTAL": "what is left: should vanish",
    }  # fmt: skip
    history = results.history
    rows = [
        (f"{name}: {text}", amount(history[name][-1], history.units[name]))
        for name, text in meanings.items()
        if name in history and len(history[name])
    ]
    return table(("energies at the last increment", ""), rows) if rows else ""


def convergence(results: Results) -> str:
    """Increments, iterations, cut-backs and remarks."""
    status = results.status
    if not status.n_rows:
        return "<p>No increment has been tried.</p>"
    cut = np.array([remark.startswith("cut") for remark in status["remark"]])
    done = status["iterations"][~cut]
    rows = [
        ("increments that converged", int((~cut).sum())),
        ("iterations, those of tries that were cut included", int(status["iterations"].sum())),
        (
            "iterations of an increment",
            f"{done.min()} to {done.max()}, mean {done.mean():.3g}" if done.size else "none",
        ),
        ("tries that were cut back", int(cut.sum())),
        ("time increments", _range(status["time_increment"], status.units["time_increment"])),
    ]
    text = table(("steps of the solution", ""), rows)
    noted = [k for k, remark in enumerate(status["remark"]) if remark]
    if noted:
        columns = (status[name][noted[-_MAX_REMARKS:]] for name in ("step", "increment", "attempts", "time", "remark"))
        lines = [
            (f"{step}:{increment}", attempt, f"{time:g}", remark)
            for step, increment, attempt, time, remark in zip(*columns, strict=True)
        ]
        head = f"the last {len(lines)} of {len(noted)} remarks" if len(noted) > len(lines) else "remarks"
        text += table(("step:increment", "try", f"time{in_brackets(status.units['time'])}", head), lines, text=[3])
    return text


def run_warnings(results: Results) -> list[str]:
    """The warnings of the run; empty if there are none."""
    found = results.warnings
    if not found:
        return []
    rows = [
        (
            one.kind,
            one.message,
            ", ".join(map(str, one.elements)) or "-",
            one.first,
            one.last,
            one.count,
            with_unit(f"{one.worst:.4g}", one.unit) if one.worst is not None else "-",
        )
        for one in found
    ]
    heads = (f"warning{'s' * (len(found) > 1)}", "", "elements", "first", "last step:increment", "increments", "worst")
    return ["<h2>Warnings</h2>", table(heads, rows, text=[1])]


def failure(results: Results) -> list[str]:
    """The last try of a run that did not converge; empty for one that was not cut at its end."""
    status = results.status
    if results.finished or not status.n_rows or not status["remark"][-1].startswith("cut"):
        return []
    step, increment, tries = (int(status[name][-1]) for name in ("step", "increment", "attempts"))
    last = results.convergence
    last = last.where((last["step"] == step) & (last["increment"] == increment) & (last["attempt"] == tries))
    span = amount(status["time_increment"][-1], status.units["time_increment"])
    reason = status["remark"][-1].removeprefix("cut: ")
    reason = html.escape(
        f"Step {step}, increment {increment} was given up after {tries} {'try' if tries == 1 else 'tries'}, "
        f"the last with a time increment of {span}: {reason}."
    )
    if not last.n_rows:
        return ["<h2>What failed</h2>", f"<p>{reason}</p>"]
    fields = (
        ("force", "displacement", "node_u"),
        ("moment", "rotation", "node_phi"),
        ("current", "potential", "node_V"),
    )
    rows = [_last_residual(last, *names) for names in fields if last[names[0]].any()]
    heads = ("last iteration", "residual", "allowed", "met", "largest correction", "at node")
    return ["<h2>What failed</h2>", f"<p>{reason}</p>", table(heads, rows)]


def _last_residual(iterations: Table, residual: str, unknown: str, node: str) -> tuple:
    """Residual and largest correction of one field in the last of some iterations."""
    size, allowed = iterations[residual][-1], iterations[f"{residual}_allowed"][-1]
    unit = iterations.units[residual]
    met = "yes" if size <= allowed else "NO"
    correction = amount(iterations[unknown][-1], iterations.units[unknown])
    return (residual, amount(size, unit), amount(allowed, unit), met, correction, iterations[node][-1] or "-")


def contacts_of_iterate(last: Results) -> str:
    """The deepest contacts of the iterate that was given up."""
    ledger = last.contacts
    if not ledger.n_rows:
        return "<p>No wires touch each other in it.</p>"
    return _contact_table("deepest contacts", ledger, np.argsort(ledger["gap"])[:_MAX_CONTACTS], with_time=False)


def worst_contacts(results: Results) -> str:
    """The deepest contacts of the run, those with the largest forces, and those with the densest currents."""
    ledger = results.contacts
    missing = (~results.has_contacts()).sum()
    left_out = (
        f'<p class="note">{missing} increments have no contacts in the ledger (*CONTACT FILE).</p>' if missing else ""
    )
    if not ledger.n_rows:
        return left_out or "<p>No wires have touched each other.</p>"
    pressures = html.escape(pressures_in_words(results))
    note = left_out + (f'<p class="note">{pressures[0].upper()}{pressures[1:]}.</p>' if pressures else "")
    largest = np.abs(ledger["current"]).max()
    ledger = with_clean_currents(ledger.where(crossings_by_themselves(results)), largest)
    if not ledger.n_rows:
        return f"<p>All contact between wires is along lines.</p>{note}"
    measures = [("largest penetration", -ledger["gap"]), ("largest force", ledger["force"])]
    density = current_density(ledger)
    if density.any():
        measures.append(("largest current density in the spot", density))
    return note + "".join(
        _contact_table(name, ledger, _worst_of_each(ledger["id"], values)[:_MAX_CONTACTS]) for name, values in measures
    )


def line_contact(results: Results) -> list[str]:
    """The zones of line contact and the pairs of wires at the last increment; empty if there are none, or none written."""
    if not results.has_contacts()[-1]:
        return []
    zones = results.contact_zones()
    if not zones.n_rows:
        return []
    pairs = results.wire_pairs()
    pairs = pairs.where(pairs["zones"] > 0)
    heads = [
        "wires",
        "from",
        "to",
        "length",
        "force",
        "force per length",
        "largest",
        "current",
        "heat",
        "crossings in it",
    ]
    parts = [_headed(zones, "zones", heads, _zone_row)]
    heads = ["wires", "zones", "crossings", "length", "force", "current", "heat", "conductance"]
    parts.append(_headed(pairs, "pairs of wires", heads, _pair_row))
    return ["<h2>Contact along lines at the last increment</h2>", *parts]


def _headed(rows: Table, what: str, heads: list[str], line: Callable[[Table, int], list[str]]) -> str:
    """A table of those with the largest forces, and a note on how many more there are."""
    order = np.argsort(-rows["force"], kind="stable")[:_MAX_CONTACTS]
    text = table(heads, [line(rows, k) for k in order])
    if rows.n_rows > len(order):
        text += f'<p class="note">The {len(order)} {what} with the largest forces, of {rows.n_rows}.</p>'
    return text


def _zone_row(zones: Table, k: int) -> list[str]:
    names = (
        "arc_1_begin",
        "arc_1_end",
        "length",
        "force",
        "force_per_length",
        "max_force_per_length",
        "current",
        "joule_heat",
    )
    values = (amount(zones[name][k], zones.units[name]) for name in names)
    return [_wires(zones, k), *values, str(zones["crossings"][k])]


def _pair_row(pairs: Table, k: int) -> list[str]:
    values = (
        amount(pairs[name][k], pairs.units[name])
        for name in ("length", "force", "current", "joule_heat", "conductance")
    )
    return [_wires(pairs, k), str(pairs["zones"][k]), str(pairs["crossings"][k]), *values]


def _wires(rows: Table, k: int) -> str:
    """Both wires, counted from 1."""
    return f"{rows['wire_1'][k] + 1}, {rows['wire_2'][k] + 1}"


def current_density(ledger: Table) -> np.ndarray:
    """Current over the area of the spot of each row of the ledger [A/m^2]; 0 where there is no spot."""
    area = np.pi * ledger["semi_major"] * ledger["semi_minor"]
    return np.divide(np.abs(ledger["current"]), area, out=np.zeros(ledger.n_rows), where=area > 0)


def _worst_of_each(ids: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Rows in falling order of their values, only the first of each contact."""
    order = np.argsort(-values, kind="stable")
    return order[np.sort(np.unique(ids[order], return_index=True)[1])]


def _contact_table(name: str, ledger: Table, rows: np.ndarray, *, with_time: bool = True) -> str:
    density, unit = current_density(ledger), ledger.units
    heads = [name, "elements", "penetration", "force", "pressure", "current", "current density", "resistance", "angle"]
    # results of litz 0.1 have no pressures
    pressure = ledger["pressure"] if "pressure" in ledger else np.zeros(ledger.n_rows)
    heads += ["step:increment", f"time{in_brackets(unit['time'])}"] if with_time else []
    lines = []
    for k in rows:
        line = [
            f"contact {ledger['id'][k]}",
            f"{ledger['element_1'][k]}, {ledger['element_2'][k]}",
            amount(max(0.0, -ledger["gap"][k]), unit["gap"]),
            amount(ledger["force"][k], unit["force"]),
            amount(pressure[k], unit.get("pressure", "")),
            amount(ledger["current"][k], unit["current"]),
            amount(density[k], per(unit["current"], unit["semi_major"] and f"{unit['semi_major']}^2")),
            amount(ledger["resistance"][k], unit["resistance"]),
            f"{np.degrees(ledger['angle'][k]):.1f}°",
        ]
        if with_time:
            line += [f"{ledger['step'][k]}:{ledger['increment'][k]}", f"{ledger['time'][k]:g}"]
        lines.append(line)
    return table(heads, lines)
