"""The contact network as a graph: wires are dots, the contacts between them are lines."""

from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from ..base.quantities import engineering, label, with_unit
from ..results import Results
from ..results.network import ContactNetwork, contact_network
from .chart_tools import has_force, wire_names
from .colours import scalar_colours, without_value
from .margins import bar_beside

_WIDEST_LINE = 7.0
_WIDEST_OF_MANY = 4.0
_THINNEST_LINE = 0.3
_MAX_NAMES = 60
_ROUNDS = 200
# Rounds of many dots: as many as this number of pairs, but not fewer
_WORK, _LEAST_ROUNDS = 4e8, 20
_ROWS_AT_ONCE = 500
# Dots keep this distance, in half of the extent, from the lines of others, in networks of so many dots times lines
_FROM_LINES, _MOST_CLEARED, _CLEARINGS = 0.07, 20_000, 60
# Pull towards the middle, relative to the push of all dots at unit distance from there
_INWARDS = 0.5
# Where a name begins below a dot, relative to its diameter
_BELOW = 0.65
# Lines do not cross names
_PLATE = {"facecolor": "white", "alpha": 0.85, "edgecolor": "none", "pad": 1.0}


def network(figure: Figure, results: Results, increment: int) -> None:
    """Wires as dots, coloured by their voltage; lines as thick as the current, or else the force, between two wires."""
    graph = pressed_contacts(contact_network(results, increment))
    n_wires = len(graph.wire_length)
    by = "current" if graph.current.any() else "force"
    pairs, size = between_wires(graph, by)
    known = np.isfinite(graph.wire_potential)
    places = turned(layout(n_wires, pairs), np.where(known, graph.wire_potential, 0.0))
    axes = figure.add_subplot()
    axes.set_axis_off()
    _draw_lines(axes, places, pairs, size)
    _draw_wires(axes, places, graph, wire_names(results, results.wires), results.unit_labels["V"])
    factor, unit = engineering(size, results.unit_labels[{"current": "A", "force": "N"}[by]])
    largest = f"; the thickest line is {with_unit(f'{size.max() * factor:.3g}', unit)}" if len(size) else ""
    counts = f"{_counted(n_wires, 'wire')}, {_counted(len(graph.id), 'contact')}"
    figure.suptitle(
        f"Contact network at time {with_unit(f'{results.times[increment]:g}', results.unit_labels['s'])}: {counts}",
        x=0.015, ha="left", fontsize="large", fontweight="bold",
    )  # fmt: skip
    grey = "" if known.all() else f"; {without_value('potential')}"
    axes.set_title(f"lines: {by} between two wires{largest}\ndots: wires, the larger the more contacts{grey}",
                   fontsize="small", fontweight="normal", color="#404040")  # fmt: skip


def pressed_contacts(graph: ContactNetwork) -> ContactNetwork:
    """The network without contacts whose force is only round-off."""
    pressed, n = has_force(graph.force), len(graph.id)
    of_contacts = ("wires", "id", "arc", "point", "length", "force", "gap", "angle", "resistance", "current",
                   "voltage_gap", "joule_heat")  # fmt: skip
    return (
        graph
        if pressed.all() or not n
        else replace(graph, **{one: getattr(graph, one)[pressed] for one in of_contacts})
    )


def _counted(n: int, what: str) -> str:
    return f"{n} {what}" + "s" * (n != 1)


def between_wires(graph: ContactNetwork, by: str) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of wires (m, 2) that touch, and the sum of current [A] or force [N] over the contacts of each, (m).

    A current counts from the first wire of a pair to the second, so that what flows to and fro cancels.
    """
    if not len(graph.id):
        return np.zeros((0, 2), dtype=int), np.zeros(0)
    ordered = np.sort(graph.wires, axis=1)
    sign = np.where(graph.wires[:, 0] == ordered[:, 0], 1.0, -1.0) if by == "current" else 1.0
    pairs, place = np.unique(ordered, axis=0, return_inverse=True)
    return pairs, np.abs(np.bincount(place.ravel(), weights=sign * getattr(graph, by), minlength=len(pairs)))


def layout(n: int, pairs: np.ndarray) -> np.ndarray:
    """Places of n dots in the plane, (n, 2): lines pull their ends together, dots push each other apart.

    The method of T. Fruchterman and E. Reingold (Software: Practice and Experience 21, 1991), from dots on a spiral, so
    that the same network has the same picture. Dots without a line stand in a row below.
    """
    tied = np.unique(pairs)
    loose = np.setdiff1d(np.arange(n), tied)
    number = np.full(n, -1)
    number[tied] = np.arange(len(tied))
    places = np.zeros((n, 2))
    if len(tied):
        places[tied] = _spread(len(tied), number[pairs])
    if len(loose):
        places[loose] = np.stack([np.linspace(-1, 1, len(loose) + 2)[1:-1], np.full(len(loose), -1.2)], axis=1)
    return places


def turned(places: np.ndarray, potential: np.ndarray) -> np.ndarray:
    """Places (n, 2) with the longest extent across, and the higher potential (n) [V] on the left."""
    centred = places - places.mean(axis=0)
    axes = np.linalg.eigh(centred.T @ centred)[1]
    flat = centred @ axes[:, ::-1]
    if flat[:, 0] @ (potential - potential.mean()) > 0:
        flat = -flat
    return flat


def _spread(n: int, pairs: np.ndarray) -> np.ndarray:
    angle = 2.4 * np.arange(n)
    places = np.sqrt((np.arange(n) + 0.5) / n)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    spacing = np.sqrt(np.pi / n)
    first, last = pairs.T.copy()
    for step in np.linspace(0.2, 0.002, int(np.clip(_WORK / n**2, _LEAST_ROUNDS, _ROUNDS))):
        # the pull towards the middle keeps parts together that no line joins
        push = spacing**2 * _repulsion(places) - _INWARDS * n * spacing**2 * places
        along = [place[last] - place[first] for place in places.T.copy()]
        distance = np.sqrt(along[0] ** 2 + along[1] ** 2)
        for axis in range(2):
            pull = along[axis] * distance / spacing
            push[:, axis] += np.bincount(first, pull, n)
            push[:, axis] -= np.bincount(last, pull, n)
        length = np.maximum(np.linalg.norm(push, axis=1, keepdims=True), 1e-12)
        places += push / length * np.minimum(length, step)
    places -= places.mean(axis=0)
    return _off_lines(places / np.abs(places).max(), pairs)


def _off_lines(places: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    """The places of few dots (n, 2), moved off the lines of others (m, 2), on which they would seem to be joined to them."""
    if len(places) * len(pairs) > _MOST_CLEARED:
        return places
    dots = np.arange(len(places))[:, None]
    others = (dots != pairs[:, 0]) & (dots != pairs[:, 1])
    for _ in range(_CLEARINGS):
        start, along = places[pairs[:, 0]], places[pairs[:, 1]] - places[pairs[:, 0]]
        square = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
        part = np.clip(((places[:, None] - start) * along).sum(axis=2) / square, 0.0, 1.0)
        away = places[:, None] - (start + part[..., None] * along)
        distance = np.linalg.norm(away, axis=2)
        near = others & (distance < _FROM_LINES)
        if not near.any():
            break
        across = np.stack([-along[:, 1], along[:, 0]], axis=1) / np.sqrt(square)[:, None]
        direction = np.where(distance[..., None] > 1e-9, away / np.maximum(distance, 1e-9)[..., None], across)
        step = np.where(near, _FROM_LINES - distance, 0.0)[..., None] * direction / 2
        places = places + step.sum(axis=1)
        # both ends of the line give way as well
        for end in (0, 1):
            for axis in range(2):
                places[:, axis] -= np.bincount(
                    pairs[:, end], weights=step[..., axis].sum(axis=0) / 2, minlength=len(places)
                )
    return places / np.abs(places).max()


def _repulsion(places: np.ndarray) -> np.ndarray:
    """Sum of the vectors to each place (n, 2) from all others, each over the square of its length."""
    push = np.empty_like(places)
    for rows in np.split(np.arange(len(places)), np.arange(_ROWS_AT_ONCE, len(places), _ROWS_AT_ONCE)):
        square = sum((places[rows, axis, None] - places[:, axis]) ** 2 for axis in range(2))
        weight = 1 / np.maximum(square, 1e-6)
        weight[np.arange(len(rows)), rows] = 0.0
        push[rows] = places[rows] * weight.sum(axis=1, keepdims=True) - weight @ places
    return push


def _draw_lines(axes: Axes, places: np.ndarray, pairs: np.ndarray, size: np.ndarray) -> None:
    if not len(pairs):
        return
    order = np.argsort(size)
    part = size[order] / max(size.max(), np.finfo(float).tiny)
    grey = 0.80 - 0.55 * part
    widest = _WIDEST_LINE if len(pairs) <= _MAX_NAMES else _WIDEST_OF_MANY
    axes.add_collection(
        LineCollection(
            places[pairs[order]], linewidths=_THINNEST_LINE + (widest - _THINNEST_LINE) * part,
            colors=np.stack([grey] * 3, axis=1), capstyle="round", zorder=1,
        )
    )  # fmt: skip


def _draw_wires(axes: Axes, places: np.ndarray, graph: ContactNetwork, names: list[str], unit_of_voltage: str) -> None:
    n = len(places)
    touching = np.bincount(graph.wires.ravel(), minlength=n)
    largest = 420 if n <= _MAX_NAMES else 160
    area = largest * (0.35 + 0.65 * touching / max(touching.max(), 1))
    known = graph.wire_potential[np.isfinite(graph.wire_potential)]
    has_voltage = np.ptp(known) > 0
    factor, unit = engineering(known, unit_of_voltage)
    value = factor * graph.wire_potential
    low, high = np.nanmin(value), np.nanmax(value)
    dots = axes.scatter(
        *places.T, s=area, c=value if has_voltage else "#2a6f97", cmap=scalar_colours("viridis") if has_voltage else None,
        edgecolors="white", linewidths=1.0, zorder=2, plotnonfinite=True,
    )  # fmt: skip
    if has_voltage:
        bar = bar_beside([axes], dots)
        bar.set_label(label("mean potential of the wire", unit))
        bar.outline.set_visible(False)
    if n <= _MAX_NAMES:
        for wire, (x, y) in enumerate(places):
            if not names[wire].isdigit():
                # a name is longer than a dot is wide
                axes.annotate(names[wire], (x, y), xytext=(0, -_BELOW * np.sqrt(area[wire])), textcoords="offset points",
                              ha="center", va="top", fontsize="small", zorder=3, color="#1b1b1b", bbox=_PLATE)  # fmt: skip
                continue
            bright = has_voltage and (not np.isfinite(value[wire]) or (value[wire] - low) > 0.6 * (high - low))
            axes.annotate(names[wire], (x, y), ha="center", va="center", fontsize="small", zorder=3,
                          color="#1b1b1b" if bright else "white")  # fmt: skip
    axes.margins(0.08)
