"""How contacts are shown on pictures of the wires: crossings and contacts with rigid surfaces as discs, zones as lines."""

from dataclasses import dataclass

import numpy as np

from ..base.quantities import engineering, label, per, with_unit
from ..base.table import Table
from ..results import Results
from ..results.contact_increments import NOT_WRITTEN_NOTE
from ..results.contact_places import contact_places
from ..results.ledger import rows_of
from ..results.zone_lines import ZoneLines, zone_lines
from ..wires.curves import hermite, hermite_slope

#: Points of the lines: more are not seen apart
_MAX_POINTS = 8_000
#: Discs below this part of the largest are round-off, and not drawn
_NOTHING = 1e-9
#: Wires seen along their axes: smallest sine of the angle between both
_LEAST_SINE = 0.3


@dataclass(frozen=True)
class Spots:
    """Where bodies touch.

    Attributes
    ----------
    places, normals : ndarray
        (m, 3) [m], and from the second body to the first, (m, 3).
    radii : ndarray
        Radii of the two wires, (m, 2) [m]; 0 for a rigid surface, which is the second.
    tangents : ndarray
        Unit tangents of their axes, (m, 2, 3).
    """

    places: np.ndarray
    normals: np.ndarray
    radii: np.ndarray
    tangents: np.ndarray

    @classmethod
    def none(cls) -> "Spots":
        """No contacts."""
        return cls(*(np.zeros((0, *shape)) for shape in ((3,), (3,), (2,), (2, 3))))

    @property
    def thinner(self) -> np.ndarray:
        """Radius of the thinner wire, (m) [m]."""
        return np.where(self.radii[:, 1] > 0, self.radii.min(axis=1, initial=np.inf), self.radii[:, 0])

    def where(self, chosen: np.ndarray) -> "Spots":
        """Some of them."""
        return Spots(self.places[chosen], self.normals[chosen], self.radii[chosen], self.tangents[chosen])

    def reach(self, toward: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """How far the two touching wires extend from their contact towards the viewer, near it, (m) [m].

        A line of sight at the angle b to the axis passes the front of a wire of the radius r at r / sin b before the axis, and
        meets the plane of its axis and the contact, of the normal n, at r |n . toward| / sin^2 b behind or before that; the
        last term is the slope of the axis over a radius.

        Parameters
        ----------
        toward : ndarray
            Unit vector towards the viewer, (3).
        radii : ndarray
            Drawn radii, (m, 2) [m].
        """
        along = np.abs(self.tangents @ toward)
        across = np.maximum(np.sqrt(np.maximum(1 - along**2, 0.0)), _LEAST_SINE)
        sided = np.stack([self.normals @ toward, -(self.normals @ toward)], axis=1)
        return np.max(radii / across * (1 + sided / across + along), axis=1, initial=0.0)


class ContactMarks:
    """Discs and lines of several increments, with one scale for all of them.

    Parameters
    ----------
    results : Results
    increments : list of int
        The increments that are shown.
    by : str, optional
        By what the discs are sized: "current" or "force"; "none": no contacts are shown.

    Attributes
    ----------
    line_limit : float
        Largest force per length [N/m].
    line_factor, line_title : float, str
        Factor that brings it into a suitable unit, and what the colours of the lines mean; empty where there are none.
    """

    def __init__(self, results: Results, increments: list[int], by: str | None):
        self._results = results
        ledgers = [] if by == "none" else [results.written_contacts_at(increment) for increment in increments]
        self._by = by or ("current" if any(ledger["current"].any() for ledger in ledgers) else "force")
        self._crossings, self._surfaces, self._lines = {}, {}, {}
        for increment, ledger in zip(increments, ledgers, strict=False):
            places = contact_places(results, ledger)
            lines = zone_lines(places, _MAX_POINTS)
            self._crossings[increment] = ledger.where(places.zone < 0)
            self._surfaces[increment] = results.surface_contacts_at(increment)
            self._lines[increment] = lines, ledger.where(lines.rows)
        self._largest = max((self._sizes(increment).max(initial=0.0) for increment in self._crossings), default=0.0)
        self.line_limit = max((lines.value.max(initial=0.0) for lines, _ in self._lines.values()), default=0.0)
        units = results.unit_labels
        self.line_factor, unit = engineering(np.array([self.line_limit]), per(units["N"], units["m"]))
        has_lines = any(len(lines.value) for lines, _ in self._lines.values())
        self.line_title = label("force per length", unit) if has_lines else ""

    def _sizes(self, increment: int) -> np.ndarray:
        """What sizes the discs: first of crossings, then of contacts with rigid surfaces."""
        surfaces = self._surfaces[increment]
        on_surfaces = surfaces[self._by] if surfaces.n_rows and self._by in surfaces else np.zeros(surfaces.n_rows)
        return np.concatenate([np.abs(self._crossings[increment][self._by]), np.abs(on_surfaces)])

    def spots(self, increment: int, curves: tuple[np.ndarray, np.ndarray]) -> tuple[Spots, np.ndarray]:
        """Places of the discs, and their drawn radii (m); their areas are proportional to current or force."""
        size = self._sizes(increment) if increment in self._crossings else np.zeros(0)
        if not len(size):
            return Spots.none(), np.zeros(0)
        crossings, on_surfaces = self._crossings[increment], self._surfaces[increment]
        drawn = self._is_drawn(size)
        spots = all_spots(self._results, crossings, on_surfaces, curves).where(drawn)
        part = size[drawn] / max(self._largest, np.finfo(float).tiny)
        return spots, spots.thinner * np.clip(0.85 * np.sqrt(part), 0.15, None)

    def _is_drawn(self, size: np.ndarray) -> np.ndarray:
        """Which discs of these sizes are more than round-off."""
        return size >= _NOTHING * self._largest

    def lines(self, increment: int, curves: tuple[np.ndarray, np.ndarray]) -> tuple[ZoneLines, Spots]:
        """The lines through the zones, and their points."""
        if increment not in self._lines:
            nothing = np.zeros(0, dtype=int)
            return ZoneLines(nothing, np.zeros(1, dtype=int), np.zeros(0), np.zeros(0, dtype=bool)), Spots.none()
        lines, rows = self._lines[increment]
        return lines, spot_places(self._results, rows, curves)

    def text(self, increment: int) -> str:
        """What discs and lines mean, and how many there are."""
        if increment not in self._lines:
            return ""
        drawn, zones = self._is_drawn(self._sizes(increment)), len(self._lines[increment][0].has_ends)
        discs, hidden = int(drawn.sum()), int((~drawn).sum())
        notes = [] if self._results.has_contacts()[increment] else [NOT_WRITTEN_NOTE]
        if discs:
            factor, unit = engineering(np.array([self._largest]), self._crossings[increment].units[self._by])
            largest = with_unit(f"{self._largest * factor:.3g}", unit)
            notes.append(
                f"{discs} contact{'s' if discs > 1 else ''}: disc area proportional to {self._by},\n"
                f"maximum {largest}" + (f" ({hidden} without {self._by})" if hidden else "")
            )
        if zones:
            notes.append(f"{zones} zone{'s' if zones > 1 else ''} of line contact, with dots at the ends")
        return "\n".join(notes)


def all_spots(results: Results, contacts: Table, on_surfaces: Table, curves: tuple[np.ndarray, np.ndarray]) -> Spots:
    """The places of `spot_places`, and behind them those of contacts with rigid surfaces."""
    spots = spot_places(results, contacts, curves)
    if not on_surfaces.n_rows:
        return spots
    others = _surface_places(results, on_surfaces, curves)
    return Spots(*(np.concatenate([getattr(one, name) for one in (spots, others)]) for name in Spots.__annotations__))


def _surface_places(results: Results, contacts: Table, curves: tuple[np.ndarray, np.ndarray]) -> Spots:
    """Where wires touch rigid surfaces, which have no thickness."""
    elements = rows_of(results.element_ids, contacts["element"])
    positions, slopes = curves
    normals = np.stack([contacts[f"normal_{axis}"] for axis in "xyz"], axis=1)
    radius = results.radius[elements]
    axis = hermite(positions[elements], slopes[elements], contacts["xi"])
    radii = np.stack([radius, np.zeros(len(radius))], axis=1)
    tangents = np.repeat(
        _unit(hermite_slope(positions[elements], slopes[elements], contacts["xi"]))[:, None], 2, axis=1
    )
    return Spots(axis - radius[:, None] * normals, normals, radii, tangents)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def spot_places(results: Results, contacts: Table, curves: tuple[np.ndarray, np.ndarray]) -> Spots:
    """Where wires touch.

    Parameters
    ----------
    results : Results
    contacts : Table
        Rows of the ledger, (m).
    curves : tuple of ndarray
        What `element_curves` gives.
    """
    barred, unbarred = (rows_of(results.element_ids, contacts[name]) for name in ("element_1", "element_2"))
    positions, slopes = curves
    point_bar = hermite(positions[barred], slopes[barred], contacts["xi_1"])
    point = hermite(positions[unbarred], slopes[unbarred], contacts["xi_2"])
    normals = np.stack([contacts[f"normal_{axis}"] for axis in "xyz"], axis=1)
    radius_bar, radius = results.radius[barred], results.radius[unbarred]
    share = (radius_bar / (radius_bar + radius))[:, None]
    tangents = [
        _unit(hermite_slope(positions[rows], slopes[rows], contacts[xi]))
        for rows, xi in ((barred, "xi_1"), (unbarred, "xi_2"))
    ]
    return Spots(
        point_bar + share * (point - point_bar),
        normals,
        np.stack([radius_bar, radius], axis=1),
        np.stack(tangents, axis=1),
    )
