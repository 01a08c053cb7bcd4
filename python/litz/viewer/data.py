"""Results as the viewer in the browser reads them: the model, and the data of one increment."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import matplotlib as mpl
import numpy as np

from ..base.table import Table
from ..pictures.colours import line_colours
from ..pictures.contact_marks import all_spots, spot_places
from ..pictures.prisms import first_axes, reach_of_sections, triangles_of
from ..pictures.scene import aim, shape_text
from ..results import Results
from ..results.contact_history import with_clean_currents
from ..results.contact_increments import NOT_WRITTEN_NOTE
from ..results.contact_places import ContactPlaces, contact_places
from ..results.contact_zones import contact_zones
from ..results.scalars import (
    Scalar,
    colours_and_limits,
    default_scalar,
    scalar_field,
    scalars,
    values_of_wires,
)
from ..results.surface_patches import Patch, surface_patches
from ..results.zone_lines import ZoneLines, largest_force_per_length, zone_lines
from ..wires.curves import element_curves
from .packed import Numbers, as_part, as_text, resolution

_PLACE_IN_TIME = ("step", "increment", "time")
_COLOUR_MAPS = ("viridis", "coolwarm")
_DIGITS = 8
# What can be seen of the thinnest wire, in its radius
_VISIBLE = 1 / 200
# Largest power of ten that floating-point numbers have exactly
_EXACT_POWER = 22
# Components of directions that can be told from each other
_TURN = 1 / 1024
# Columns of contacts that the table of the viewer has
_TABLE_COLUMNS = ("id", "element_1", "element_2", "gap", "force", "current")
# Largest whole number that the script of a page has exactly
_MAX_EXACT = 2**24
# Radii of the lines of contact and of the marks at their ends, in radii of the thinner wire
_LINE_RADIUS, _END_RADIUS = 0.3, 0.55
# Length of a mark, in distances of places
_END_PART = 0.6
# How much nearer to the viewer the lines of contact are drawn, in radii of the thicker wire
_WIRES_BEFORE = 2.2


@dataclass(frozen=True)
class Detail:
    """How exactly a page has an increment.

    Attributes
    ----------
    digits : int
        Of the numbers of contacts.
    columns : tuple of str, optional
        What is told of contacts; default: everything.
    parts : int
        Parts of the largest value that are told apart in a field.
    parts_moved : int
        The same of displacements.
    coarser : float
        Factor on the smallest lengths and turns that can be seen.
    """

    digits: int = 5
    columns: tuple[str, ...] | None = None
    parts: int = 2**14
    parts_moved: int = 2**15
    coarser: float = 1.0


#: Of increments of many contacts: colours that look the same, and all of each contact in three digits
PLAIN = Detail(3, None, 64, 512, 10.0)
#: The same, with no more of a contact than the table shows
SHORT = replace(PLAIN, columns=_TABLE_COLUMNS)


class WebData:
    """What the viewer asks for, as JSON; places are relative to the middle of the model.

    Parameters
    ----------
    results : Results
        A run with at least one increment.
    increments : list of int, optional
        The increments that can be looked at; default: all.
    """

    def __init__(self, results: Results, increments: list[int] | None = None):
        self._results = results
        self.increments = list(range(len(results.times))) if increments is None else increments
        self._wires = results.wires
        self._centre = (results.nodes.min(axis=0) + results.nodes.max(axis=0)) / 2
        still = np.zeros_like(results.nodes)
        self._rest = element_curves(results.nodes, still, still, self._wires, len(results.elements))
        self._patches = surface_patches(results, self.increments)

    def model(self) -> str:
        """What holds for all increments, with all digits."""
        return as_text(self._model())

    def increment(self, place: int) -> str:
        """One of the increments, counted from 0 among those that can be looked at, with all digits."""
        return as_text(self._increment(place, _DIGITS))

    def packed_model(self) -> str:
        """The model as a page has it inside."""
        return as_part(self._model())

    def packed_increment(self, place: int, detail: Detail | None = None) -> str:
        """An increment as a page has it inside: displacements of wires, spots and lines instead of their places."""
        detail = detail or Detail()
        data = self._increment(place, detail.digits, detail.columns)
        data["curves"] = self._moved(data["curves"], self._packed(self._rest), detail)
        for part in (data["spots"], data["lines"]):
            part["now"] = self._moved(part["now"], part["rest"].values, detail)
            part |= {
                name: replace(part[name], step=detail.coarser * part[name].step)
                for name in ("rest", "normals", "tangents")
                if name in part
            }
        data["fields"] = {name: replace(values, parts=detail.parts) for name, values in data["fields"].items()}
        data["contacts"] = {name: _in_bytes(column) for name, column in data["contacts"].items()}
        return as_part(data)

    def _moved(self, now: Numbers, rest: np.ndarray, detail: Detail) -> Numbers:
        moved = np.asarray(now.values, dtype=float) - rest
        return Numbers(moved, step=resolution(moved, self._visible, detail.parts_moved))

    @cached_property
    def _visible(self) -> float:
        """The smallest length that can be seen."""
        radii = self._results.radius
        return float(_VISIBLE * radii[radii > 0].min(initial=math.inf)) if (radii > 0).any() else 0.0

    def _places(self, points: np.ndarray) -> Numbers:
        return Numbers(points, step=self._visible)

    def _model(self) -> dict:
        results, picked = self._results, self.increments
        places = np.concatenate([results.positions(k) for k in (*picked[:: max(1, len(picked) // 20)], picked[-1])])
        margin = 1.5 * reach_of_sections(results)
        shown = np.concatenate([results.nodes, places, *self._corners(picked)])
        camera = aim(shown, margin, 1.4)
        known = list(self._ranges.values())
        wanted = default_scalar(results, picked[-1])
        return {
            "units": results.unit_labels,
            "heading": results.heading.strip(),
            "steps": results.steps[picked].tolist(),
            "increments": results.increments[picked].tolist(),
            "times": results.times[picked].tolist(),
            "n_nodes": len(results.nodes),
            "n_elements": len(results.elements),
            "elements": Numbers(results.elements, np.int32, 1.0),
            "radii": Numbers(results.radius),
            "rest": self._places(self._packed(self._rest)),
            "outlines": self._outlines(),
            "shape_text": shape_text(results),
            "contact_texts": ["" if has else NOT_WRITTEN_NOTE for has in results.has_contacts()[picked]],
            "frames": self._frames(np.zeros_like(results.nodes)),
            "radius": float(np.linalg.norm(shown - self._centre, axis=1).max() + margin),
            "view": {
                "toward": camera.toward.tolist(),
                "up": camera.up.tolist(),
                # what is seen around the middle of the model
                "half": (np.abs(camera.turn(shown - self._centre))[:, :2].max(axis=0) + margin).tolist(),
            },
            "scalars": known,
            "scalar": wanted if wanted in self._ranges else next(iter(self._ranges)),
            "colours": {name: _colour_table(mpl.colormaps[name]) for name in _COLOUR_MAPS}
            | {"zones": _colour_table(line_colours())},
            "surfaces": [self._surface(patch) for patch in self._patches],
            "ledger": _described_columns(results.contact_units),
            "surface_ledger": _described_columns(results.surface_contacts.units),
            "largest": self._largest(),
            "zones": {
                "columns": _described_columns(self._zone_units),
                "title": "force per length",
                "unit": self._zone_units["force_per_length"],
                "limits": [0.0, largest_force_per_length(results)],
            },
        }

    def _increment(self, place: int, digits: int, columns: tuple[str, ...] | None = None) -> dict:
        """An increment; of the contacts these columns, all when left out."""
        results, index = self._results, self.increments[place]
        displacement, rotation = (results.field(name, index) for name in ("displacement", "rotation"))
        curves = element_curves(results.nodes, displacement, rotation, self._wires, len(results.elements))
        ledger, on_surfaces = results.written_contacts_at(index), results.surface_contacts_at(index)
        places = contact_places(results, ledger)
        contacts = ledger.where(places.zone < 0)
        zones = contact_zones(places, results.unit_labels)
        fields = {name for scalar in self._ranges.values() for name in scalar["fields"]}
        now, rest = (all_spots(results, contacts, on_surfaces, each) for each in (curves, self._rest))
        return {
            "curves": self._places(self._packed(curves)),
            "frames": self._frames(rotation),
            "fields": {name: Numbers(scalar_field(results, name, index)) for name in sorted(fields)},
            "spots": {
                "rest": self._places(rest.places - self._centre),
                "now": self._places(now.places - self._centre),
                "normals": Numbers(now.normals, step=_TURN),
                "radii": Numbers(now.radii),
                "tangents": Numbers(now.tangents, step=_TURN),
            },
            "contacts": _with_surfaces(
                with_clean_currents(contacts, self._largest_current), on_surfaces, digits, columns
            ),
            "surfaces": [self._places(patch.moved(results, index) - self._centre) for patch in self._patches],
            "zones": {name: _column(_counted_from_one(name, values), digits) for name, values in zones.items()},
            "lines": self._lines(places, curves),
        }

    def _lines(self, places: ContactPlaces, curves: tuple[np.ndarray, np.ndarray]) -> dict:
        """The pieces of the zones: their curves, values at both ends, radii, and the row of the zone of each."""
        lines = zone_lines(places)
        rows = places.ledger.where(lines.rows)
        now, rest = (spot_places(self._results, rows, each) for each in (curves, self._rest))
        radius = now.thinner
        pieces, ends = lines.pieces, _collars(lines)
        first, second = np.concatenate([pieces, ends[:, :2].astype(int)]).T
        # what marks an end is a short, thick piece
        part = np.concatenate([np.ones(len(pieces)), ends[:, 2]])[:, None]
        size = np.concatenate([np.full(len(pieces), _LINE_RADIUS), np.full(len(ends), _END_RADIUS)])
        value = lines.value

        def straight(points: np.ndarray) -> Numbers:
            begin, along = points[first] - self._centre, part * (points[second] - points[first])
            return self._places(np.stack([begin, begin + along, along / 2, along / 2], axis=1))

        return {
            "rest": straight(rest.places),
            "now": straight(now.places),
            "values": Numbers(np.stack([value[first], value[second]], axis=1)),
            "radii": Numbers(size * radius[first]),
            "zones": Numbers(lines.zone[first], np.int32, 1.0),
            # the marks are between two wires, whose fronts are not farther away than this
            "before": float(_WIRES_BEFORE * now.radii.max(initial=0.0)),
        }

    @cached_property
    def _zone_units(self) -> dict[str, str]:
        nothing = self._results.contacts.where(np.zeros(0, dtype=int))
        return contact_zones(contact_places(self._results, nothing), self._results.unit_labels).units

    @cached_property
    def _largest_current(self) -> float:
        """Through a contact between wires, in the whole run."""
        return float(np.abs(self._results.contacts["current"]).max(initial=0.0))

    def _largest(self) -> dict[str, float]:
        """Largest force and current of crossings and, without currents, of contacts with rigid surfaces in the whole run."""
        ledger, on_surfaces = self._results.contacts, self._results.surface_contacts
        crosses = ledger["length"] == 0 if "length" in ledger else np.ones(ledger.n_rows, dtype=bool)
        force, current = (float(np.abs(ledger[by][crosses]).max(initial=0.0)) for by in ("force", "current"))
        if on_surfaces.n_rows:
            force = max(force, float(on_surfaces["force"].max()))
        return {"force": force, "current": current}

    @cached_property
    def _ranges(self) -> dict[str, dict]:
        """All scalars that are not the same everywhere in the whole run, with their colours and ranges."""
        known = scalars(self._results)
        fields = {field for scalar in known.values() for field in scalar.fields}
        limits = dict.fromkeys(known, (np.inf, -np.inf))
        for index in self.increments:
            values = {field: scalar_field(self._results, field, index) for field in fields}
            for name, scalar in known.items():
                one = values_of_wires(self._results, scalar, scalar.of([values[field] for field in scalar.fields]))
                low, high = limits[name]
                limits[name] = (np.fmin(low, np.nanmin(one)), np.fmax(high, np.nanmax(one)))
        return {
            name: _described(known[name], float(low), float(high))
            for name, (low, high) in limits.items()
            if np.isfinite([low, high]).all() and (low < high or name == "potential")
        }

    def _corners(self, picked: list[int]) -> list[np.ndarray]:
        """Corners of the rigid surfaces at the first and the last increment."""
        return [patch.moved(self._results, index) for patch in self._patches for index in (picked[0], picked[-1])]

    def _surface(self, patch: Patch) -> dict:
        return {
            "name": patch.surface.name,
            "rest": self._places(patch.points - self._centre),
            "quads": Numbers(patch.quads, np.int32, 1.0),
            "rim": Numbers(patch.rim, np.int32, 1.0),
        }

    def _outlines(self) -> list[dict]:
        """Of each section that is not round its elements, its corners, and the triangles that fill it."""
        results = self._results
        return [
            {
                "elements": Numbers(np.flatnonzero(results.sections == section), np.int32, 1.0),
                "corners": self._places(outline.corners),
                "caps": Numbers(triangles_of(outline.corners), np.int32, 1.0),
            }
            for section, outline in results.section_outlines.items()
        ]

    def _frames(self, rotation: np.ndarray) -> Numbers:
        """First section axes at both ends of the elements that have an outline, in the order of `_outlines`."""
        results = self._results
        rows = [np.flatnonzero(results.sections == section) for section in results.section_outlines]
        if not rows:
            return Numbers(np.zeros((0, 2, 3)), step=_TURN)
        return Numbers(first_axes(results, rotation)[np.concatenate(rows)], step=_TURN)

    def _packed(self, curves: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        """Both ends of each element and both slopes, (n_elements, 4, 3)."""
        positions, slopes = curves
        return np.concatenate([positions - self._centre, slopes], axis=1)


def _described(scalar: Scalar, low: float, high: float) -> dict:
    colours, limits = colours_and_limits(low, high, scalar.is_length)
    return {
        "name": scalar.name, "text": scalar.text, "unit": scalar.unit, "at_nodes": scalar.at_nodes,
        "fields": scalar.fields, "component": scalar.component, "colours": colours, "limits": limits,
    }  # fmt: skip


def _described_columns(units: dict[str, str]) -> list[dict[str, str]]:
    return [{"name": name, "unit": unit} for name, unit in units.items() if name not in _PLACE_IN_TIME]


def _with_surfaces(contacts: Table, on_surfaces: Table, digits: int, wanted: tuple[str, ...] | None) -> dict[str, list]:
    """Columns of the crossings, and behind them of the contacts with rigid surfaces; None where one has no value."""
    columns = {name: _column(contacts[name], digits) for name in contacts if wanted is None or name in wanted}
    if not on_surfaces.n_rows:
        return columns
    more = {name: _column(values, digits) for name, values in on_surfaces.items()}
    elements, names = more["element"], more["surface"]
    more |= {"element_1": elements, "element_2": names, "current": [0.0] * len(names)}
    more["id"] = [f"{name}:{element}" for name, element in zip(names, elements, strict=True)]
    return {
        name: columns.get(name, [None] * contacts.n_rows) + more.get(name, [None] * on_surfaces.n_rows)
        for name in [*columns, *(name for name in more if name not in columns)]
        if wanted is None or name in wanted
    }


def _collars(lines: ZoneLines) -> np.ndarray:
    """For each end of a zone its point, the next one, and the part of the way between them that is marked, (e, 3)."""
    first, last = lines.ends.T
    long_enough = last > first
    first, last = first[long_enough], last[long_enough]
    to_first, to_last = (
        np.stack([end, end + step, np.full(len(end), _END_PART)], axis=1) for end, step in ((first, 1), (last, -1))
    )
    return np.concatenate([to_first, to_last])


def _counted_from_one(name: str, values: np.ndarray) -> np.ndarray:
    return values + 1 if name.startswith("wire_") else values


def _column(values: np.ndarray, digits: int) -> list:
    """Numbers with few digits; JSON has no infinity: the viewer shows text unchanged, and a dash for None."""
    if values.dtype.kind in "iU":
        return values.tolist()
    column = _rounded(values, digits).tolist()
    for row in np.flatnonzero(~np.isfinite(values)).tolist():
        column[row] = None if math.isnan(column[row]) else "∞" if column[row] > 0 else "-∞"
    return column


def _in_bytes(column: list) -> list | Numbers:
    """Whole numbers of a page take fewer bytes than letters, and so does a column of zeros."""
    kinds = set(map(type, column))
    if kinds == {float} and not any(column):
        return Numbers(np.zeros(len(column)), np.int32, 1.0)
    if kinds <= {int} and min(column, default=0) > -_MAX_EXACT and max(column, default=0) < _MAX_EXACT:
        return Numbers(column, np.int32, 1.0)
    return column


def _rounded(values: np.ndarray, digits: int) -> np.ndarray:
    """Numbers rounded to significant digits, which is how many Python writes of them.

    A whole number times or over a power of ten that is exact is the number nearest to its decimals; numbers so small or large
    that the power is not are left as they are.
    """
    known = np.isfinite(values) & (values != 0)
    size = np.log10(np.abs(values), out=np.zeros(len(values)), where=known)
    shift = digits - 1 - np.floor(size)
    known &= np.abs(shift) <= _EXACT_POWER
    shift = np.where(known, shift, 0.0)
    up, down = 10.0 ** np.maximum(shift, 0), 10.0 ** np.maximum(-shift, 0)
    return np.where(known, np.rint(values * up / down) / up * down, values)


def _colour_table(colours: mpl.colors.Colormap) -> Numbers:
    return Numbers(colours(np.arange(256), bytes=True), np.uint8, 1.0)
