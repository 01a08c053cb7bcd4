"""Charts of contact along lines: what passes per length, along the wires."""

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.legend import Legend

from ..base.quantities import engineering, label, per
from ..base.table import Table
from ..results import Results
from ..results.contact_history import contacts_over_time
from ..results.contact_increments import NOT_WRITTEN
from ..results.contact_places import ContactPlaces, contact_places
from ..results.contact_zones import per_length, stretch_along
from . import charts
from .chart_tools import equal_over_places, from_zero, legend_beside, name_of_group
from .charts import MAX_LINES, colour_of, marker, nothing_to_draw, time_label

_MAX_POINTS = 20_000
_NAMES = {"force_per_length": "force", "current_per_length": "current", "heat_per_length": "heat"}


def lines(figure: Figure, results: Results, increment: int, wire: int | None = None) -> None:
    """Force, current and heat per length along the wires, as far as there are any."""
    places = contact_places(results, results.contacts_at(increment))
    values = per_length(places)
    names = [name for name in _NAMES if values[name].any()] or ["force_per_length"]
    figure.set_figheight(1.2 + 2.6 * len(names))
    all_axes = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
    for axes, name in zip(all_axes, names, strict=True):
        along_wires(axes, results, places, name, wire)
    for axes in all_axes[:-1]:
        axes.set_xlabel("")
    legends = [axes.get_legend() for axes in all_axes if axes.get_legend()]
    # one is enough for all charts where it says the same of all
    if len({_what_it_says(legend) for legend in legends}) == 1:
        for legend in legends[1:]:
            legend.remove()


def _what_it_says(legend: Legend) -> tuple[object, ...]:
    """Texts, colours and dashes of a legend."""
    lines, texts = legend.get_lines(), legend.get_texts()
    each = zip(texts, lines, strict=True)
    return tuple((text.get_text(), line.get_color(), line.get_linestyle()) for text, line in each)


def force_along_wires(axes: Axes, results: Results, increment: int) -> None:
    """Force per length along the wires at an increment."""
    if not results.has_contacts()[increment]:
        nothing_to_draw(axes, NOT_WRITTEN)
        return
    along_wires(axes, results, contact_places(results, results.contacts_at(increment)), "force_per_length", None)


def along_wires(axes: Axes, results: Results, places: ContactPlaces, name: str, wire: int | None) -> None:
    """One quantity per length: a line for each zone over the arc of its first wire, or of the wire that is wanted."""
    axes.set_title(f"{_NAMES[name].capitalize()} per length of line contact")
    wanted = (places.zone >= 0) & (places.spacing > 0)
    if wire is not None:
        wanted &= (places.wires == wire).any(axis=1)
    if not wanted.any():
        nothing_to_draw(axes, "No wires touch along a line" + ("" if wire is None else f" of wire {wire + 1}"))
        return
    picked = places.where(wanted)
    picked.zone[:] = zone = np.unique(picked.zone, return_inverse=True)[1]
    sides = [stretch_along(picked, side) for side in (0, 1)]
    second = np.zeros(len(zone), dtype=int) if wire is None else (picked.wires[:, 0] != wire).astype(int)
    arc = np.stack([each.arc for each in sides], axis=1)[np.arange(len(zone)), second]
    order = np.lexsort((arc, zone))
    ends = np.flatnonzero(np.diff(zone[order], prepend=-1, append=-1))
    # some of very many places, with the ends of each zone
    kept = np.arange(len(order)) % max(1, len(order) // _MAX_POINTS) == 0
    kept[ends[:-1]] = kept[ends[1:] - 1] = True
    order = order[kept]
    units = results.unit_labels
    unit_of = {"force_per_length": units["N"], "current_per_length": units["A"], "heat_per_length": units["W"]}
    value = per_length(picked)[name]
    factor, unit = engineering(value, per(unit_of[name], units["m"]))
    length_factor, length_unit = engineering(arc, units["m"])
    points = np.stack([length_factor * arc[order], factor * value[order]], axis=1)
    pairs, pair = np.unique(picked.wires[order], axis=0, return_inverse=True)
    first = np.flatnonzero(np.diff(zone[order], prepend=-1))
    drawn = np.split(points, first[1:])
    if len(pairs) <= MAX_LINES:
        _few_pairs(axes, pairs, pair.ravel()[first], drawn)
    else:
        colours = np.array([mpl.colors.to_rgba(colour_of(i, len(pairs))) for i in range(len(pairs))])
        of_zone = colours[pair.ravel()[first]]
        axes.add_collection(LineCollection(drawn, colors=of_zone, linewidths=0.7))
        ends = np.concatenate([[one[0] for one in drawn], [one[-1] for one in drawn]])
        axes.scatter(*ends.T, s=4, c=np.tile(of_zone, (2, 1)), zorder=2.5)
        axes.autoscale_view()
    axes.axhline(0.0, color="#888888", linewidth=0.8, zorder=1)
    axes.set_xlabel(
        label(f"reference arc length of {'the first wire' if wire is None else f'wire {wire + 1}'}", length_unit)
    )
    axes.set_ylabel(label(name, unit))
    if len(pairs) <= MAX_LINES:
        legend_beside(axes, title="wires")


def _few_pairs(axes: Axes, pairs: np.ndarray, of_zone: np.ndarray, zones: list[np.ndarray]) -> None:
    """A curve for each pair of wires, with gaps between its zones and dots at their ends; equal ones are one curve."""
    curves = []
    for i in range(len(pairs)):
        own = sorted((zones[k] for k in np.flatnonzero(of_zone == i)), key=lambda one: one[0, 0])
        # a place without a value, which leaves the places in their order
        gaps = [[one[-1, 0], np.nan] for one in own]
        curves.append(np.concatenate([part for one, gap in zip(own, gaps, strict=True) for part in (one, [gap])])[:-1])
    groups = equal_over_places([curve[:, 0] for curve in curves], [curve[:, 1] for curve in curves])
    ends, colours = [], []
    for i, group in enumerate(groups):
        curve, colour = curves[group[0]], colour_of(i, len(groups))
        text = name_of_group([f"{pairs[one, 0] + 1}-{pairs[one, 1] + 1}" for one in group], "pair")
        axes.plot(*curve.T, linewidth=1.3, color=colour, label=text)
        own = [zones[k][[0, -1]] for k in np.flatnonzero(of_zone == group[0])]
        ends += own
        colours += [colour] * (2 * len(own))
    axes.scatter(*np.concatenate(ends).T, s=14, c=colours, zorder=2.5)


def forces_and_lengths_over_time(axes: Axes, results: Results, increment: int) -> None:
    """Sum of the contact forces of a run with contact along lines, and the largest force per length."""
    _forces_and_lengths(axes, results, contacts_over_time(results, results.steps, results.increments))


def _forces_and_lengths(axes: Axes, results: Results, table: Table) -> None:
    """Of what `contacts_over_time` tells."""
    axes.set_title(charts.between_wires("Contact forces", results))
    has = results.has_contacts()
    times, table = results.times[has], table.where(has)
    force = table["force_between_wires"]
    factor, unit = engineering(force, table.units["force"])
    axes.plot(times, factor * force, **marker(table.n_rows), color=colour_of(0, 3))
    axes.set_xlabel(time_label(results))
    axes.set_ylabel(label("sum of forces", unit), color=colour_of(0, 3))
    from_zero(axes)
    factor, unit = engineering(table["max_force_per_length"], table.units["max_force_per_length"])
    right = axes.twinx()
    right.grid(visible=False)
    right.plot(times, factor * table["max_force_per_length"], "--", **marker(table.n_rows), color=colour_of(1, 3))
    right.set_ylabel(label("largest force per length", unit), color=colour_of(1, 3))
    from_zero(right)


def contacts(figure: Figure, results: Results, increment: int) -> None:
    """Number, forces and heat of the contacts over time, and the force per length along the wires."""
    ((number, forces), (along, heat)) = figure.subplots(2, 2)
    table = contacts_over_time(results, results.steps, results.increments)
    charts.contact_number(number, results, table)
    _forces_and_lengths(forces, results, table)
    force_along_wires(along, results, increment)
    charts.contact_heat(heat, results)
