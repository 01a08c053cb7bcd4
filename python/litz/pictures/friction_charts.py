"""Charts of friction: the loop of force over sliding, and the heat of it."""

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..base.quantities import engineering, label
from ..results import Results
from ..results.contact_history import FORCE_ROUND_OFF
from ..results.contact_increments import as_far_as_written
from ..wires.curves import arc_lengths, element_curves, hermite_slope
from .chart_tools import from_zero, legend_beside
from .charts import colour_of, nothing_to_draw, time_label

_MAX_LOOPS = 6


@dataclass(frozen=True)
class Loop:
    """Friction of one contact over its life, in the direction in which it has acted most.

    Attributes
    ----------
    id : int
        Number of the contact in the ledger.
    sliding : ndarray
        How far the unbarred wire has moved along the barred one since the first increment of the contact [m].
    force : ndarray
        Friction on the barred wire [N].
    """

    id: int
    sliding: np.ndarray
    force: np.ndarray


def has_friction(results: Results) -> bool:
    """A friction force has acted that is more than round-off of the contact forces."""
    ledger = results.contacts
    if not ledger.n_rows:
        return False
    largest = max(np.abs(ledger[f"traction_{axis}"]).max() for axis in "xyz")
    return bool(largest > FORCE_ROUND_OFF * np.abs(ledger["force"]).max())


def friction(figure: Figure, results: Results, increment: int) -> None:
    """Force over sliding, and the heat of friction over time."""
    loops, heat = figure.subplots(2, 1, height_ratios=(3, 2))
    force_over_sliding(loops, results, increment)
    heat_over_time(heat, results)


def force_over_sliding(axes: Axes, results: Results, increment: int) -> None:
    """The loops of the contacts with the most frictional heat."""
    axes.set_title("Friction over sliding")
    if not has_friction(results):
        nothing_to_draw(axes, as_far_as_written("No friction has acted", results.has_contacts()))
        return
    ids, place, counts = np.unique(results.contacts["id"], return_inverse=True, return_counts=True)
    heat = np.zeros(len(ids))
    np.maximum.at(heat, place, results.contacts["dissipation"])
    order = np.lexsort((ids, counts, heat))[::-1]
    drawn = friction_loops(results, np.sort(ids[order[counts[order] > 1]][:_MAX_LOOPS]).tolist())
    if not drawn:
        nothing_to_draw(axes, "No contact with friction has lasted two increments")
        return
    factor, unit = engineering(np.concatenate([loop.sliding for loop in drawn]), results.unit_labels["m"])
    force_factor, force_unit = engineering(np.concatenate([loop.force for loop in drawn]), results.unit_labels["N"])
    for number, loop in enumerate(drawn):
        colour = colour_of(number, len(drawn))
        axes.plot(factor * loop.sliding, force_factor * loop.force, ".-", markersize=4, linewidth=1.3, color=colour,
                  label=f"contact {loop.id}")  # fmt: skip
        axes.plot(factor * loop.sliding[-1:], force_factor * loop.force[-1:], "o", markersize=7, color=colour)
    axes.axhline(0, color="#888888", linewidth=0.8, zorder=1)
    axes.set_xlabel(label("sliding", unit))
    axes.set_ylabel(label("friction force", force_unit))
    if len(drawn) > 1:
        more = f"the {len(drawn)} with most heat, of {len(ids)}" if len(ids) > len(drawn) else None
        legend_beside(axes, title=more, title_fontsize="small")


def heat_over_time(axes: Axes, results: Results) -> None:
    """Frictional dissipation of all contacts."""
    axes.set_title("Heat of friction")
    if not has_friction(results):
        nothing_to_draw(axes, as_far_as_written("No friction has acted", results.has_contacts()))
        return
    ledger = results.contacts
    ids, place = np.unique(ledger["id"], return_inverse=True)
    latest, total = np.zeros(len(ids)), []
    has = results.has_contacts()
    for step, increment in zip(results.steps[has], results.increments[has], strict=True):
        now = (ledger["step"] == step) & (ledger["increment"] == increment)
        latest[place[now]] = ledger["dissipation"][now]
        total.append(latest.sum())
    factor, unit = engineering(np.array(total), results.unit_labels["J"])
    axes.plot(results.times[has], factor * np.array(total), color="#2a6f97", marker="o" if len(total) <= 40 else None,
              markersize=4)  # fmt: skip
    from_zero(axes)
    axes.set_xlabel(time_label(results))
    axes.set_ylabel(label("heat", unit))


def friction_loops(results: Results, ids: list[int]) -> list[Loop]:
    """Sliding and friction of contacts that have lasted at least two increments.

    Parameters
    ----------
    results : Results
    ids : list of int
        Numbers of the contacts in the ledger.

    Notes
    -----
    The point of contact moves along both axes; the wires slide on each other by the difference of these two paths,
    `ds_bar t_bar - ds t` with arc lengths before deformation and current unit tangents.
    """
    wires = results.wires
    arc_start, lengths, sign = arc_lengths(results.nodes, results.elements, wires)
    row = {int(element): row for row, element in enumerate(results.element_ids)}
    ledgers = {contact: results.contact(contact) for contact in ids}
    seen: dict[int, list] = {contact: [] for contact in ids}
    for index, (step, increment) in enumerate(zip(results.steps, results.increments, strict=True)):
        curves = None
        for contact, ledger in ledgers.items():
            for k in np.flatnonzero((ledger["step"] == step) & (ledger["increment"] == increment)):
                if curves is None:
                    displacement, rotation = (results.field(name, index) for name in ("displacement", "rotation"))
                    curves = element_curves(results.nodes, displacement, rotation, wires, len(results.elements))
                place = []
                for which in (1, 2):
                    element, xi = row[int(ledger[f"element_{which}"][k])], ledger[f"xi_{which}"][k]
                    positions, slopes = (part[[element]] for part in curves)
                    tangent = sign[element] * hermite_slope(positions, slopes, np.array([xi]))[0]
                    arc = arc_start[element] + (1 + sign[element] * xi) / 2 * lengths[element]
                    place.append((arc, tangent / np.linalg.norm(tangent)))
                traction = np.array([ledger[f"traction_{axis}"][k] for axis in "xyz"])
                seen[contact].append((place, traction))
    return [_loop(contact, history) for contact, history in seen.items() if len(history) > 1]


def _loop(contact: int, history: list) -> Loop:
    tractions = np.array([traction for _, traction in history])
    arcs = np.array([[bar[0], other[0]] for (bar, other), _ in history])
    tangents = np.array([[bar[1], other[1]] for (bar, other), _ in history])
    middle = (tangents[1:] + tangents[:-1]) / 2
    steps = np.diff(arcs, axis=0)[:, :, None] * middle
    sliding = np.concatenate([np.zeros((1, 3)), np.cumsum(steps[:, 0] - steps[:, 1], axis=0)])
    main = np.linalg.svd(tractions, full_matrices=False)[2][0]
    along = sliding @ main
    sign = -1.0 if along[np.argmax(np.abs(along))] < 0 else 1.0
    return Loop(int(contact), sign * along, sign * (tractions @ main))
