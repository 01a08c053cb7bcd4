"""How contacts are shown on pictures of the wires: crossings and contacts with rigid surfaces as discs, zones as lines."""

import numpy as np

from ..base.quantities import engineering, label
from ..base.table import Table
from ..results import Results
from ..results.contact_places import contact_places, rows_of
from ..results.zone_lines import ZoneLines, zone_lines
from ..wires.curves import hermite

#: Points of the lines: more are not seen apart
_MAX_POINTS = 8_000
#: Discs below this part of the largest are round-off, and not drawn
_NOTHING = 1e-9


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
        ledgers = [] if by == "none" else [results.contacts_at(increment) for increment in increments]
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
        self.line_factor, unit = engineering(np.array([self.line_limit]), f"{units['N']}/{units['m']}")
        has_lines = any(len(lines.value) for lines, _ in self._lines.values())
        self.line_title = label("force per length", unit) if has_lines else ""

    def _sizes(self, increment: int) -> np.ndarray:
        """What sizes the discs: first of crossings, then of contacts with rigid surfaces, where no current passes."""
        surfaces = self._surfaces[increment]
        on_surfaces = surfaces["force"] if surfaces.n_rows and self._by == "force" else np.zeros(surfaces.n_rows)
        return np.concatenate([np.abs(self._crossings[increment][self._by]), on_surfaces])

    def spots(self, increment: int, curves: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Centres (m, 3), normals (m, 3) and drawn radii (m) of the discs; their areas are proportional to current or force."""
        size = self._sizes(increment) if increment in self._crossings else np.zeros(0)
        if not len(size):
            return np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0)
        crossings, on_surfaces = self._crossings[increment], self._surfaces[increment]
        drawn = self._is_drawn(size)
        centres, normals, thinner = (one[drawn] for one in all_spots(self._results, crossings, on_surfaces, curves))
        part = size[drawn] / max(self._largest, np.finfo(float).tiny)
        return centres, normals, thinner * np.clip(0.85 * np.sqrt(part), 0.15, None)

    def _is_drawn(self, size: np.ndarray) -> np.ndarray:
        """Which discs of these sizes are more than round-off."""
        return size >= _NOTHING * self._largest

    def lines(self, increment: int, curves: tuple[np.ndarray, np.ndarray]) -> tuple[ZoneLines, np.ndarray]:
        """The lines through the zones, and their points (n, 3)."""
        if increment not in self._lines:
            nothing = np.zeros(0, dtype=int)
            return ZoneLines(nothing, np.zeros(1, dtype=int), np.zeros(0), np.zeros(0, dtype=bool)), np.zeros((0, 3))
        lines, rows = self._lines[increment]
        return lines, spot_places(self._results, rows, curves)[0]

    def text(self, increment: int) -> str:
        """What discs and lines mean, and how many there are."""
        if increment not in self._lines:
            return ""
        drawn, zones = self._is_drawn(self._sizes(increment)), len(self._lines[increment][0].has_ends)
        discs, hidden = int(drawn.sum()), int((~drawn).sum())
        notes = []
        if discs:
            factor, unit = engineering(np.array([self._largest]), self._crossings[increment].units[self._by])
            notes.append(
                f"{discs} contact{'s' if discs > 1 else ''}: disc area proportional to {self._by},\n"
                f"maximum {self._largest * factor:.3g} {unit}" + (f" ({hidden} without {self._by})" if hidden else "")
            )
        if zones:
            notes.append(f"{zones} zone{'s' if zones > 1 else ''} of line contact, with dots at the ends")
        return "\n".join(notes)


def all_spots(
    results: Results, contacts: Table, on_surfaces: Table, curves: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The places, normals and radii of `spot_places`, and behind them those of contacts with rigid surfaces."""
    spots = spot_places(results, contacts, curves)
    if not on_surfaces.n_rows:
        return spots
    return tuple(map(np.concatenate, zip(spots, _surface_places(results, on_surfaces, curves), strict=True)))  # type: ignore[return-value]


def _surface_places(
    results: Results, contacts: Table, curves: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where wires touch rigid surfaces: places (m, 3) [m], normals (m, 3), and the radius of the wire (m) [m]."""
    elements = rows_of(results.element_ids, contacts["element"])
    positions, slopes = curves
    normals = np.stack([contacts[f"normal_{axis}"] for axis in "xyz"], axis=1)
    radius = results.radius[elements]
    axis = hermite(positions[elements], slopes[elements], contacts["xi"])
    return axis - radius[:, None] * normals, normals, radius


def spot_places(
    results: Results, contacts: Table, curves: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where contacts touch: places (m, 3) [m], normals (m, 3), and the smaller radius of the two wires (m) [m].

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
    return point_bar + share * (point - point_bar), normals, np.minimum(radius_bar, radius)
