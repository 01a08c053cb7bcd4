"""Charts of cables: shares of the current along them, and their cross-section."""

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Ellipse

from ..base.quantities import engineering, label
from ..results import Results
from ..results.along_cable import CableAxis, cable_axis
from ..results.contact_increments import NOT_WRITTEN_NOTE
from ..results.ledger import rows_of
from ..results.scalars import colours_and_limits, find_scalar, scalar_values
from .chart_tools import equal_curves, from_zero, legend_beside, name_of_group, wire_names
from .charts import MAX_LINES, colour_of, nothing_to_draw
from .colours import scalar_colours, without_value

# Wires with numbers in them, and with large ones, at most
_MAX_NUMBERS, _MAX_LARGE = 100, 12
# Area of the dot of the largest force [points^2]
_LARGEST_DOT = 160.0
_SURFACE = "#555555"
# Width over thickness of a flat cable
_FLAT = 1.8
# Weights of red, green and blue in what looks bright (Rec. 709)
_LUMINANCE = (0.2126, 0.7152, 0.0722)
# Directions that differ by less than this cosine from the axis are across it
_ACROSS = 0.01


def shares(figure: Figure, results: Results, increment: int) -> None:
    """Share of each wire in the current along the cable, and the contact force per length."""
    upper, lower = figure.subplots(2, 1, sharex=True)
    shares_along(upper, results, increment)
    force_along(lower, results, increment)
    upper.set_xlabel("")


def shares_along(axes: Axes, results: Results, increment: int) -> None:
    """Share of each wire, or where they sum up to nothing its current, over the place along the cable."""
    found = results.current_shares(increment)
    if not found.current.any():
        axes.set_title("Currents along the cable")
        nothing_to_draw(axes, "No current flows")
        return
    values, text, unit = found.share, "share of the current", ""
    axes.set_title("Share of each wire in the current")
    if np.isnan(values).any():
        factor, unit = engineering(found.current, results.unit_labels["A"])
        values, text = factor * found.current, "current"
        axes.set_title("Current of each wire")
    length_factor, length_unit = engineering(found.place, results.unit_labels["m"])
    few = len(values) <= MAX_LINES
    groups = equal_curves(list(values)) if few else [[i] for i in range(len(values))]
    names = wire_names(results, results.wires) if few else []
    for i, group in enumerate(groups):
        name = name_of_group([f"wire {names[one]}" for one in group], "wire") if few else None
        axes.plot(length_factor * found.place, values[group[0]], color=colour_of(i, len(groups)),
                  linewidth=1.6 if few else 0.8, alpha=1.0 if few else 0.6, label=name)  # fmt: skip
    if not unit:
        axes.axhline(1 / len(values), color="#888888", linewidth=0.8, linestyle=":", label="equal shares")
        # shares that are nearly equal look so
        axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0] if values.min() < 0 else 0.0))
    axes.set_xlabel(label("place along the cable", length_unit))
    axes.set_ylabel(label(text, unit))
    legend_beside(axes)


def force_along(axes: Axes, results: Results, increment: int) -> None:
    """Sum of the contact forces in slices across the cable, per length."""
    table = results.along_cable(increment)
    axes.set_title("Contact force between the wires, per length of the cable")
    factor, unit = engineering(table["force_per_length"], table.units["force_per_length"])
    length_factor, length_unit = engineering(table["place"], table.units["place"])
    half = table["place"][0]
    edges = length_factor * np.append(table["place"] - half, table["place"][-1] + half)
    axes.stairs(factor * table["force_per_length"], edges, fill=True, color=colour_of(0, 3), alpha=0.35)
    axes.stairs(factor * table["force_per_length"], edges, color=colour_of(0, 3))
    from_zero(axes)
    axes.set_xlabel(label("place along the cable", length_unit))
    axes.set_ylabel(label("force per length", unit))


def section(figure: Figure, results: Results, increment: int, field: str | None, place: float) -> None:
    """The wires where a plane cuts them, coloured by their currents or by a field; dots are contacts near it."""
    axis = cable_axis(results, increment)
    at = place * axis.length
    cut = _Cut(results, increment, axis, at)
    axes = figure.add_subplot()
    axes.set_aspect("equal")
    axes.grid(visible=False)
    values, text, unit = _values(results, increment, field, cut)
    factor, unit = engineering(values, unit)
    colours, limits = colours_and_limits(factor * np.nanmin(values), factor * np.nanmax(values), one_sided=False)
    scale, length_unit = engineering(np.abs(cut.centre) + cut.long[:, None], results.unit_labels["m"])
    patches = [
        Ellipse(tuple(scale * centre), 2 * scale * long, 2 * scale * short, angle=np.degrees(angle))
        for centre, long, short, angle in zip(cut.centre, cut.long, cut.short, cut.angle, strict=True)
    ]
    norm = mpl.colors.Normalize(*limits)
    discs = PatchCollection(
        patches, cmap=scalar_colours(colours), norm=norm, edgecolors="white", linewidths=0.6, zorder=2
    )
    discs.set_array(factor * values)
    axes.add_collection(discs)
    if len(values) <= _MAX_NUMBERS:
        text_size = "large" if len(values) <= _MAX_LARGE else "x-small"
        for wire, centre, value in zip(cut.wires, cut.centre, factor * values, strict=True):
            bright = np.dot(_LUMINANCE, discs.cmap(norm(value))[:3]) > 0.5
            axes.annotate(str(wire + 1), scale * centre, ha="center", va="center", fontsize=text_size,
                          color="#1b1b1b" if bright else "white", zorder=4)  # fmt: skip
    note = _draw_contacts(axes, results, increment, cut, scale)
    if np.isnan(values).any():
        note = f"{note}; {without_value(text)}".removeprefix("; ")
    axes.autoscale_view()
    axes.margins(0.06)
    _draw_surfaces(axes, results, increment, cut, scale)
    # below a cable that is flat
    size = np.ptp(cut.centre, axis=0) + 2 * cut.short.max()
    side = "bottom" if size[0] > _FLAT * size[1] else "right"
    bar = figure.colorbar(discs, ax=axes, shrink=0.85, pad=0.02, aspect=30, location=side)
    bar.formatter.set_powerlimits((-3, 4))
    bar.set_label(label(text, unit))
    bar.outline.set_visible(False)
    length_factor, unit_along = engineering(np.array([axis.length]), results.unit_labels["m"])
    figure.suptitle(
        f"Cross-section at {length_factor * at:.4g} of {length_factor * axis.length:.4g} {unit_along}, time "
        f"{results.times[increment]:g} {results.unit_labels['s']}",
        x=0.015, ha="left", fontsize="large", fontweight="bold",
    )  # fmt: skip
    axes.set_title(note, fontsize="small", fontweight="normal", color="#404040")
    axes.set_xlabel(label(cut.names[0], length_unit))
    axes.set_ylabel(label(cut.names[1], length_unit))


class _Cut:
    """Where a plane across a cable cuts its wires.

    Attributes
    ----------
    wires : (n) array of int
        Those that reach it.
    element : (n) array of int
        Rows of their elements there.
    part : (n) array
        Where it is in these, from 0 at the first node to 1.
    centre : (n, 2) array
        Centres of the cuts in the plane, from the axis [m].
    long, short, angle : (n) arrays
        Half-axes of the ellipses [m], and the direction of the longer one [rad].
    """

    def __init__(self, results: Results, increment: int, axis: CableAxis, at: float):
        self.axis, self.at = axis, at
        self.basis, self.names = _basis(axis.direction)
        position = results.positions(increment)
        found = []
        for number, (wire, along) in enumerate(zip(results.wires, axis.along, strict=True)):
            if not along[0] - 1e-9 * axis.length <= at <= along[-1] + 1e-9 * axis.length:
                continue
            k = int(np.clip(np.searchsorted(along, at, "right") - 1, 0, len(wire.elements) - 1))
            part = (at - along[k]) / (along[k + 1] - along[k])
            row = len(wire.elements) - 1 - k if axis.turned[number] else k
            forward = (wire.signs[row] > 0) != axis.turned[number]
            found.append((number, wire.elements[row], part if forward else 1 - part))
        self.wires, self.element = (np.array([one[i] for one in found], dtype=int) for i in (0, 1))
        self.part = np.array([one[2] for one in found])
        first, second = position[results.elements[self.element]].transpose(1, 0, 2)
        self.centre = self.flat(first + self.part[:, None] * (second - first))
        tangent = (second - first) / np.linalg.norm(second - first, axis=1)[:, None]
        across = tangent @ self.basis.T
        self.short = results.radius[self.element]
        self.long = self.short / np.abs(tangent @ axis.direction)
        self.angle = np.arctan2(across[:, 1], across[:, 0])

    def flat(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 3) as seen along the axis, (n, 2) [m]."""
        return (points - self.origin) @ self.basis.T

    @property
    def origin(self) -> np.ndarray:
        """Along a coordinate axis coordinates stay what they are."""
        along_one = np.abs(self.axis.direction).max() > 1 - 1e-6
        return np.zeros(3) if along_one else self.axis.origin


def _basis(direction: np.ndarray) -> tuple[np.ndarray, tuple[str, str]]:
    """Two directions across the axis, (2, 3), right-handed, and their names."""
    nearest = int(np.argmax(np.abs(direction)))
    start = np.eye(3)[(nearest + 1) % 3]
    first = start - (start @ direction) * direction
    first /= np.linalg.norm(first)
    second = np.cross(direction, first)
    names = ("xyz"[(nearest + 1) % 3], "xyz"[(nearest + 2) % 3])
    return np.stack([first, second]), names if abs(direction[nearest]) > 1 - 1e-6 else ("across", "across")


def _values(results: Results, increment: int, field: str | None, cut: _Cut) -> tuple[np.ndarray, str, str]:
    """What colours the wires: values (n), their name and unit."""
    if field == "element_current" or (field is None and results.field("element_current", increment).any()):
        found = results.current_shares(increment)
        current = [np.interp(cut.at, found.place, one) for one in found.current[cut.wires]]
        return np.array(current), "current along the cable", results.unit_labels["A"]
    if field is None:
        field = next((name for name in ("strain_max", "axial_strain") if name in results.fields), "axial_force")
    scalar = find_scalar(results, field)
    values = scalar_values(results, scalar, increment)
    if scalar.at_nodes:
        first, second = values[results.elements[cut.element]].T
        return first + cut.part * (second - first), scalar.text, scalar.unit
    return values[cut.element], scalar.text, scalar.unit


def _draw_contacts(axes: Axes, results: Results, increment: int, cut: _Cut, scale: float) -> str:
    """Contacts that lie within a radius of the plane, as dots; what they mean, in words."""
    if not results.has_contacts()[increment]:
        return NOT_WRITTEN_NOTE
    ledger = results.contacts_at(increment)
    points = [np.stack([ledger[f"point_{side}_{name}"] for name in "xyz"], axis=1) for side in (1, 2)]
    rows = [rows_of(results.element_ids, ledger[f"element_{side}"]) for side in (1, 2)]
    near = np.abs(cut.axis.place((points[0] + points[1]) / 2) - cut.at) <= results.radius[rows[1]]
    near &= ledger["force"] > 0
    if not near.any():
        return "no contact within a radius of it"
    pairs = np.sort(np.stack([results.wire_arcs.wire[row[near]] for row in rows], axis=1), axis=1)
    pairs, pair = np.unique(pairs, axis=0, return_inverse=True)
    force = np.bincount(pair.ravel(), ledger["force"][near])
    inward = (
        results.radius[rows[1][near], None] / (results.radius[rows[0][near]] + results.radius[rows[1][near]])[:, None]
    )
    middle = cut.flat(points[1][near] + inward * (points[0][near] - points[1][near]))
    place = np.stack([np.bincount(pair.ravel(), middle[:, i]) / np.bincount(pair.ravel()) for i in (0, 1)], axis=1)
    axes.scatter(*(scale * place.T), s=_LARGEST_DOT * force / force.max(), color="#e8502a", edgecolors="white",
                 linewidths=0.5, zorder=3)  # fmt: skip
    factor, unit = engineering(force, results.unit_labels["N"])
    return (
        f"dots: contacts within a radius of the plane, areas by their forces, {factor * force.max():.3g} {unit} at most"
    )


def _draw_surfaces(axes: Axes, results: Results, increment: int, cut: _Cut, scale: float) -> None:
    """Jackets and plates around the wires."""
    for surface in results.rigid_surfaces.values():
        centre = surface.moved(results, surface.point[None], increment)
        ahead = surface.moved(results, (surface.point + surface.direction)[None], increment)
        direction = (ahead - centre)[0]
        direction /= np.linalg.norm(direction)
        lengthwise = abs(direction @ cut.axis.direction)
        point = scale * cut.flat(centre)[0]
        if surface.shape != "PLANE" and lengthwise > 1 - _ACROSS:
            radius = scale * surface.radius_at(results, increment)
            axes.add_patch(Circle(tuple(point), radius, fill=False, edgecolor=_SURFACE, linewidth=1.2))
            axes.autoscale_view()
        elif surface.shape == "PLANE" and lengthwise < _ACROSS:
            across, up = direction @ cut.basis.T
            limits = axes.axis()
            axes.axline(tuple(point), (point[0] - up, point[1] + across), color=_SURFACE, linewidth=1.2)
            axes.axis(limits)
