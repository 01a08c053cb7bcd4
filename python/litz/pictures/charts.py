"""The charts of results, each drawn into matplotlib axes or a figure that the caller has made."""

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator, StrMethodFormatter

from ..base.quantities import engineering, label, with_unit
from ..base.table import Table
from ..results import Results
from ..results.contact_history import contacts_over_time
from ..results.contact_increments import NOT_WRITTEN, as_far_as_written
from ..results.surface_forces import joule_heat_on_surfaces
from .chart_tools import (
    equal_curves,
    equal_over_places,
    from_zero,
    has_force,
    legend_beside,
    name_of_group,
    power_of_ten,
    wire_names,
)
from .margins import bar_beside, text_width

Colour = str | tuple[float, float, float, float]

_ONE_COLOUR = "#2a6f97"
# More lines than this have one colour or become a band
MAX_LINES = 12
# Forces that differ by less, relatively, are the same force: what an iteration leaves
_SAME_FORCE = 1e-6
# Largest over smallest value of a logarithmic axis with plain numbers
_FEW_DECADES = 200


def resistance(figure: Figure, results: Results, increment: int) -> None:
    """Contact resistance over contact force."""
    resistance_over_force(figure.add_subplot(), results, increment)


def contacts(figure: Figure, results: Results, increment: int) -> None:
    """Number, forces, spots and heat of the contacts over time."""
    ((number, forces), (spots, heat)) = figure.subplots(2, 2)
    contact_number(number, results, contacts_over_time(results, results.steps, results.increments))
    forces_over_time(forces, results, increment)
    spot_sizes(spots, results, increment)
    contact_heat(heat, results)


def currents(figure: Figure, results: Results, increment: int) -> None:
    """Current of each wire, and along the wires."""
    upper, lower = figure.subplots(2, 1)
    current_per_wire(upper, results, increment)
    current_along_wires(lower, results, increment)


def history(figure: Figure, results: Results, increment: int) -> None:
    """The columns requested in the deck, a chart for each quantity."""
    table = results.history
    names = [name for name in table if name not in ("step", "increment", "time")]
    if not names:
        nothing_to_draw(figure.add_subplot(), "The deck asks for no history (*NODE PRINT, *EL PRINT, *ELECTRODE PRINT)")
        return
    groups: dict[tuple[str, str], list[str]] = {}
    for name in names:
        groups.setdefault((_quantity(name), table.units[name]), []).append(name)
    figure.set_figheight(1.0 + 1.8 * len(groups))
    all_axes = figure.subplots(len(groups), 1, sharex=True, squeeze=False)[:, 0]
    for axes, ((quantity, unit), members) in zip(all_axes, groups.items(), strict=True):
        _history_of_one_quantity(axes, table, members, quantity, unit)
    all_axes[-1].set_xlabel(time_label(results))


def _quantity(column: str) -> str:
    """Quantity of a column of the history: its identifier, or a common name of related ones."""
    symbol = column.split(maxsplit=1)[0].rstrip("123")
    if symbol.startswith("ALL") or symbol == "ETOTAL":
        return "energy"
    return {"N": "section force", "Q": "section force", "T": "section moment", "M": "section moment"}.get(
        symbol, symbol
    )


def _history_of_one_quantity(axes: Axes, table: Table, names: list[str], quantity: str, unit: str) -> None:
    factor, symbol = engineering(np.concatenate([table[name] for name in names]), unit)
    groups = equal_curves([table[name] for name in names])
    for i, group in enumerate(groups):
        legend = name_of_group([names[one] for one in group], "column") if i < MAX_LINES else None
        axes.plot(
            table["time"], factor * table[names[group[0]]], **marker(table.n_rows), color=colour_of(i, len(groups)),
            label=legend,
        )  # fmt: skip
    if len(groups) > MAX_LINES:
        axes.plot([], [], " ", label=f"and {len(groups) - MAX_LINES} more")
    axes.set_ylabel(label(quantity, symbol))
    legend_beside(axes)


def resistance_over_force(axes: Axes, results: Results, increment: int) -> None:
    """All contacts at all increments; straight lines show the powers that exact laws have.

    Of few contacts the history is seen: where metal yields, or spots remember, the way back is another one than the way up.
    """
    ledger = results.contacts
    axes.set_title("Contact resistance")
    shown = ledger.where((ledger["resistance"] < np.inf) & (ledger["force"] > 0) & has_force(ledger["force"]))
    if not shown.n_rows:
        nothing_to_draw(axes, as_far_as_written("No current can pass a contact", results.has_contacts()))
        return
    force_factor, force_unit = engineering(shown["force"], results.unit_labels["N"])
    factor, unit = engineering(shown["resistance"], results.unit_labels["ohm"])
    force, ohms = force_factor * shown["force"], factor * shown["resistance"]
    axes.set_xscale("log")
    axes.set_yscale("log")
    ids, loading = np.unique(shown["id"]), np.ones(shown.n_rows, dtype=bool)
    if len(ids) <= MAX_LINES:
        for i, contact in enumerate(ids):
            one = np.flatnonzero(shown["id"] == contact)
            way_up = _loading_and_return(axes, force[one], ohms[one], colour_of(i, len(ids)), f"contact {contact}")
            loading[one[~way_up]] = False
        if len(ids) > 1:
            legend_beside(axes)
    else:
        angle = np.degrees(shown["angle"])
        if np.ptp(angle) > 1:
            dots = axes.scatter(force, ohms, c=angle, s=10, cmap="viridis", edgecolors="none")
            bar_beside([axes], dots).set_label("crossing angle [°]")
        else:
            axes.scatter(force, ohms, s=10, color=_ONE_COLOUR, edgecolors="none")
    axes.margins(0.08)
    for axis in (axes.xaxis, axes.yaxis):
        number_log_axis(axis)
    # where nothing makes room for both, the scale of colours is beside the data: these fall from one corner to the other
    inside = axes.get_subplotspec() is None and len(ids) > MAX_LINES
    _power_lines(axes, force[loading], ohms[loading], inside=inside)
    axes.set_xlabel(label("contact force", force_unit))
    axes.set_ylabel(label("resistance", unit))


def _loading_and_return(axes: Axes, force: np.ndarray, ohms: np.ndarray, colour: Colour, name: str) -> np.ndarray:
    """The history of one contact: dots where the force is the largest so far, which are returned, circles below it."""
    largest = np.maximum.accumulate(force)
    way_up = force >= largest * (1 - _SAME_FORCE)
    axes.plot(force[way_up], ohms[way_up], "o-", markersize=4, color=colour, label=name)
    # each way back begins at the dot before it, and ends at the dot at which the loading goes on
    ends = np.flatnonzero(np.diff(np.concatenate([[True], way_up, [True]]).astype(int)))
    for first, last in zip(ends[::2], ends[1::2], strict=True):
        rows = np.arange(max(first - 1, 0), last)
        rows = rows[np.argsort(force[rows])]
        axes.plot(force[rows], ohms[rows], "--", linewidth=1.0, color=colour)
        below = rows[~way_up[rows]]
        axes.plot(force[below], ohms[below], "o", markersize=4, markerfacecolor="white", color=colour)
    if not way_up.all():
        text = "below the largest force so far"
        if text not in axes.get_legend_handles_labels()[1]:
            axes.plot([], [], "o--", markersize=4, markerfacecolor="white", linewidth=1.0, color=colour, label=text)
    return way_up


def number_log_axis(axis: Axis) -> None:
    """Plain numbers, several in each decade, where there are few decades; else powers of ten.

    As text and not as formulas, whose parsing takes longer than all else of a chart.
    """
    low, high = axis.get_view_interval()
    axis.set_minor_formatter(NullFormatter())
    # each mark costs as much as a curve
    axis.set_minor_locator(NullLocator())
    if high / low < _FEW_DECADES:
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high / low > 10 else (1, 1.5, 2, 3, 4, 5, 6, 8)))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    else:
        axis.set_major_formatter(FuncFormatter(lambda value, _: power_of_ten(value)))


def _power_lines(axes: Axes, force: np.ndarray, ohms: np.ndarray, *, inside: bool) -> None:
    """R ~ F^(-1/3), elastic spots, and F^(-1/2), plastic ones, through the middle of the data; the legend inside or beside."""
    if force.max() < 1.5 * force.min():
        return
    middle, there = np.exp(np.log(force).mean()), np.exp(np.log(ohms).mean())
    ends = np.array([force.min(), force.max()])
    limits = axes.get_ylim()
    for power, text, style in ((-1 / 3, "−1/3 (Hertz)", "--"), (-1 / 2, "−1/2 (plastic)", ":")):
        axes.plot(
            ends,
            there * (ends / middle) ** power,
            style,
            color="#888888",
            linewidth=1.0,
            zorder=1,
            label=f"slope {text}",
        )
    axes.set_ylim(limits)
    if inside:
        axes.legend(loc="upper right")
    else:
        legend_beside(axes)


def gradient() -> mpl.colors.Colormap:
    """Viridis without its palest part, which is hard to see on white."""
    return mpl.colors.ListedColormap(mpl.colormaps["viridis"](np.linspace(0.0, 0.88, 256)))


def between_wires(text: str, results: Results) -> str:
    """A title of what is of contacts between wires, which says so where there are rigid surfaces, too."""
    return f"{text} between wires" if results.rigid_surfaces else text


def contact_number(axes: Axes, results: Results, table: Table) -> None:
    """Number of contacts over time, of what `contacts_over_time` tells."""
    axes.set_title(between_wires("Number of contacts", results))
    has = results.has_contacts()
    times, table = results.times[has], table.where(has)
    counts = table["crossings"] + table["zones"]
    if table["zones"].any():
        axes.set_title(between_wires("Number of crossings and zones", results))
    axes.plot(
        times, counts, drawstyle="steps-post" if len(times) > 1 else "default", **marker(len(times)), color=_ONE_COLOUR
    )
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    from_zero(axes)
    axes.set_xlabel(time_label(results))


def contact_heat(axes: Axes, results: Results) -> None:
    """Heat of all contacts, on rigid surfaces, and that of the wires, over time."""
    axes.set_title("Joule heat")
    has, times = results.has_contacts(), results.times
    spots = _per_increment(results, results.contacts, results.contacts["joule_heat"], has)
    touching = results.surface_contacts
    on_surfaces = _per_increment(results, touching, joule_heat_on_surfaces(touching), np.ones(len(times), dtype=bool))
    wires = results.field("joule_heat", None).sum(axis=1)
    if not (spots.any() or on_surfaces.any() or wires.any()):
        nothing_to_draw(axes, "No current flows")
        return
    factor, unit = engineering(np.concatenate([spots, on_surfaces, wires]), results.unit_labels["W"])
    axes.plot(times[has], factor * spots, **marker(len(spots)), color=colour_of(1, 3), label="contacts")
    if on_surfaces.any():
        axes.plot(times, factor * on_surfaces, **marker(len(times)), color=colour_of(2, 3), label="on rigid surfaces")
    axes.plot(results.times, factor * wires, **marker(len(times)), color=colour_of(0, 3), label="wires")
    axes.set_xlabel(time_label(results))
    axes.set_ylabel(label("heat", unit))
    legend_beside(axes)


def forces_over_time(axes: Axes, results: Results, increment: int) -> None:
    """Force of each contact over time, or of many the range and the median."""
    ledger = results.contacts
    axes.set_title(between_wires("Contact forces", results))
    axes.set_xlabel(time_label(results))
    if not ledger.n_rows:
        nothing_to_draw(axes, as_far_as_written("No wires touch each other", results.has_contacts()))
        return
    factor, unit = engineering(ledger["force"], results.unit_labels["N"])
    axes.set_ylabel(label("force", unit))
    ids = np.unique(ledger["id"])
    if len(ids) <= MAX_LINES:
        has = results.has_contacts()
        times = results.times[has]
        # an open contact is not in the ledger: its force is zero
        forces = [
            _per_increment(results, ledger, np.where(ledger["id"] == one, ledger["force"], 0.0), has) for one in ids
        ]
        groups = equal_curves(forces)
        for i, group in enumerate(groups):
            text = name_of_group([f"contact {ids[one]}" for one in group], "contact")
            axes.plot(
                times, factor * forces[group[0]], **marker(len(times)), color=colour_of(i, len(groups)), label=text
            )
        if len(ids) > 1:
            legend_beside(axes)
    else:
        times = np.unique(ledger["time"])
        spread = np.array(
            [np.percentile(factor * ledger["force"][ledger["time"] == t], (0, 25, 50, 75, 100)) for t in times]
        )
        axes.fill_between(times, spread[:, 0], spread[:, 4], color=_ONE_COLOUR, alpha=0.15, linewidth=0, label="all")
        axes.fill_between(
            times, spread[:, 1], spread[:, 3], color=_ONE_COLOUR, alpha=0.35, linewidth=0, label="half of them"
        )
        axes.plot(times, spread[:, 2], **marker(len(times)), color=_ONE_COLOUR, label="median")
        legend_beside(axes)
    from_zero(axes)


def spot_sizes(axes: Axes, results: Results, increment: int) -> None:
    """Semi-axes of the spots over force, at the increment that is shown."""
    now = results.written_contacts_at(increment)
    axes.set_title(f"Spots at time {with_unit(f'{results.times[increment]:g}', results.unit_labels['s'])}")
    if not results.has_contacts()[increment]:
        nothing_to_draw(axes, NOT_WRITTEN)
        return
    if not now.n_rows or not now["semi_major"].any():
        nothing_to_draw(axes, "There are no spots")
        return
    force_factor, force_unit = engineering(now["force"], results.unit_labels["N"])
    factor, unit = engineering(now["semi_major"], results.unit_labels["m"])
    force = force_factor * now["force"]
    # rings around dots: both are seen where the spot is a circle
    axes.plot(
        force, factor * now["semi_major"], "o", markersize=8, fillstyle="none", color=colour_of(0, 3), label="longer"
    )
    axes.plot(force, factor * now["semi_minor"], "o", markersize=4, color=colour_of(1, 3), label="shorter")
    axes.margins(0.08)
    from_zero(axes)
    axes.set_xlabel(label("force", force_unit))
    axes.set_ylabel(label("semi-axis", unit))
    legend_beside(axes)


def displacement_over_time(axes: Axes, results: Results, increment: int) -> None:
    """Largest displacement over time."""
    size = np.linalg.norm(results.field("displacement", None), axis=2).max(axis=1)
    factor, unit = engineering(size, results.unit_labels["m"])
    axes.plot(results.times, factor * size, **marker(len(size)), color=_ONE_COLOUR)
    axes.set_title("Largest displacement")
    axes.set_xlabel(time_label(results))
    axes.set_ylabel(label("displacement", unit))


def current_per_wire(axes: Axes, results: Results, increment: int) -> None:
    """Mean current of each wire as a bar; a line shows its range along the wire."""
    wires = results.wires
    current = results.field("element_current", increment)
    factor, unit = engineering(current, results.unit_labels["A"])
    along = [factor * wire.signs * current[wire.elements] for wire in wires]
    mean, low, high = (np.array([f(one) for one in along]) for f in (np.mean, np.min, np.max))
    place = np.arange(1, len(wires) + 1)
    if len(wires) <= 60:
        axes.bar(place, mean, width=0.75, color=_ONE_COLOUR)
    else:
        # bars side by side, in one piece
        axes.stairs(mean, np.append(place, len(wires) + 1) - 0.5, fill=True, color=_ONE_COLOUR)
    axes.vlines(place, low, high, color="#1b1b1b", linewidth=1.2 if len(wires) <= 60 else 0.5)
    axes.axhline(0, color="#888888", linewidth=0.8)
    axes.set_title("Current per wire: mean, and range along it")
    names = wire_names(results, wires) if len(wires) <= MAX_LINES else []
    # a tenth is between them
    room = 0.9 * 72 * axes.get_position().width * axes.figure.get_size_inches()[0]
    if names and sum(text_width(name, mpl.rcParams["font.size"]) for name in names) < room:
        axes.set_xticks(place, names)
    else:
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.grid(visible=False, axis="x")
    axes.set_xlabel("wire")
    axes.set_ylabel(label("current", unit))


def current_along_wires(axes: Axes, results: Results, increment: int) -> None:
    """Current over the arc length of each wire; it jumps where current crosses a contact."""
    wires = results.wires
    current = results.field("element_current", increment)
    factor, unit = engineering(current, results.unit_labels["A"])
    length_factor, length_unit = engineering(np.ptp(results.nodes, axis=0), results.unit_labels["m"])
    few = len(wires) <= MAX_LINES
    along, values = [], []
    for wire in wires:
        length = np.linalg.norm(np.diff(results.nodes[wire.nodes], axis=0), axis=1)
        along.append(length_factor * np.concatenate(([0.0], np.cumsum(length))))
        values.append(factor * wire.signs * current[wire.elements])
    if few:
        names = wire_names(results, wires)
        groups = equal_over_places(along, values)
        for i, group in enumerate(groups):
            text = name_of_group([f"wire {names[one]}" for one in group], "wire")
            axes.stairs(values[group[0]], along[group[0]], baseline=None, color=colour_of(i, len(groups)),
                        linewidth=1.6, label=text)  # fmt: skip
    else:
        # a collection: matplotlib takes a second for every thousand steps of patches
        steps = zip(along, values, strict=True)
        lines = [np.stack([np.repeat(place, 2)[1:-1], np.repeat(value, 2)], axis=1) for place, value in steps]
        colours = gradient()(np.linspace(0.0, 1.0, len(wires)))
        axes.add_collection(LineCollection(lines, colors=colours, alpha=0.5, linewidths=0.8))
        axes.autoscale_view()
    axes.set_title("Current along the wires")
    axes.set_xlabel(label("reference arc length", length_unit))
    axes.set_ylabel(label("current", unit))
    if few and len(wires) > 1:
        legend_beside(axes)


def _per_increment(results: Results, ledger: Table, values: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """The sum of a quantity over the contacts at each of the increments that are wanted."""
    if not ledger.n_rows:
        return np.zeros(int(wanted.sum()))
    sums = [
        values[(ledger["step"] == s) & (ledger["increment"] == i)].sum()
        for s, i in zip(results.steps[wanted], results.increments[wanted], strict=True)
    ]
    return np.array(sums)


def colour_of(i: int, n: int) -> Colour:
    """Colour-blind safe colours for few lines, a gradient for many."""
    few = ["#2a6f97", "#e8502a", "#5b8e3e", "#8e5ba6", "#c99700", "#4d4d4d"]
    return few[i] if n <= len(few) else gradient()(i / max(1, n - 1))


def marker(n: int) -> dict:
    """Marker of a line: none if the points are too dense."""
    return {"marker": "o", "markersize": 4} if n <= 40 else {}


def time_label(results: Results) -> str:
    """Label of an axis of time."""
    return label("time", results.unit_labels["s"])


def nothing_to_draw(axes: Axes, text: str) -> None:
    """State in an empty chart why it is empty."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color="#666666")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(visible=False)
