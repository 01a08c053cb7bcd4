"""Results as the viewer in the browser reads them: the model, and the data of one increment."""

import base64
import json
import math
from functools import cached_property

import matplotlib as mpl
import numpy as np

from ..base.table import Table
from ..pictures.scene import aim, all_spots
from ..results import Results
from ..results.scalars import Scalar, colours_and_limits, default_scalar, scalars
from ..results.surface_patches import Patch, surface_patches
from ..wires.curves import element_curves

_PLACE_IN_TIME = ("step", "increment", "time")
_COLOUR_MAPS = ("viridis", "coolwarm")
_DIGITS = 8


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
        """What holds for all increments."""
        results, picked = self._results, self.increments
        places = np.concatenate([results.positions(k) for k in (*picked[:: max(1, len(picked) // 20)], picked[-1])])
        margin = 1.5 * results.radius.max()
        shown = np.concatenate([results.nodes, places, *self._corners(picked)])
        camera = aim(shown, margin, 1.4)
        known = list(self._ranges.values())
        wanted = default_scalar(results, picked[-1])
        return _json(
            {
                "units": results.unit_labels,
                "heading": results.heading.strip(),
                "steps": results.steps[picked].tolist(),
                "increments": results.increments[picked].tolist(),
                "times": results.times[picked].tolist(),
                "n_nodes": len(results.nodes),
                "n_elements": len(results.elements),
                "elements": _base64(results.elements, np.int32),
                "radii": _base64(results.radius, np.float32),
                "rest": _base64(self._packed(self._rest), np.float32),
                "radius": float(np.linalg.norm(shown - self._centre, axis=1).max() + margin),
                "view": {
                    "toward": camera.toward.tolist(),
                    "up": camera.up.tolist(),
                    # what is seen around the middle of the model
                    "half": (np.abs(camera.turn(shown - self._centre))[:, :2].max(axis=0) + margin).tolist(),
                },
                "scalars": known,
                "scalar": wanted if wanted in self._ranges else next(iter(self._ranges)),
                "colours": {name: _colour_table(name) for name in _COLOUR_MAPS},
                "surfaces": [self._surface(patch) for patch in self._patches],
                "ledger": _described_columns(results.contacts),
                "surface_ledger": _described_columns(results.surface_contacts),
                "largest": {by: _largest(results, by) for by in ("force", "current")},
            }
        )

    def increment(self, place: int) -> str:
        """One of the increments, counted from 0 among those that can be looked at."""
        results, index = self._results, self.increments[place]
        displacement, rotation = (results.field(name, index) for name in ("displacement", "rotation"))
        curves = element_curves(results.nodes, displacement, rotation, self._wires, len(results.elements))
        contacts, on_surfaces = results.contacts_at(index), results.surface_contacts_at(index)
        fields = {name for scalar in self._ranges.values() for name in scalar["fields"]}
        now, normals, radii = all_spots(results, contacts, on_surfaces, curves)
        rest, _, _ = all_spots(results, contacts, on_surfaces, self._rest)
        return _json(
            {
                "curves": _base64(self._packed(curves), np.float32),
                "fields": {name: _base64(results.field(name, index), np.float32) for name in sorted(fields)},
                "spots": {
                    "rest": _base64(rest - self._centre, np.float32),
                    "now": _base64(now - self._centre, np.float32),
                    "normals": _base64(normals, np.float32),
                    "radii": _base64(radii, np.float32),
                },
                "contacts": _with_surfaces(contacts, on_surfaces),
                "surfaces": [
                    _base64(patch.moved(results, index) - self._centre, np.float32) for patch in self._patches
                ],
            }
        )

    @cached_property
    def _ranges(self) -> dict[str, dict]:
        """All scalars that are not the same everywhere in the whole run, with their colours and ranges."""
        known = scalars(self._results)
        fields = {field for scalar in known.values() for field in scalar.fields}
        limits = dict.fromkeys(known, (np.inf, -np.inf))
        for index in self.increments:
            values = {field: self._results.field(field, index) for field in fields}
            for name, scalar in known.items():
                one = scalar.of([values[field] for field in scalar.fields])
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
            "rest": _base64(patch.points - self._centre, np.float32),
            "quads": _base64(patch.quads, np.int32),
            "rim": _base64(patch.rim, np.int32),
        }

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


def _described_columns(table: Table) -> list[dict[str, str]]:
    return [{"name": name, "unit": unit} for name, unit in table.units.items() if name not in _PLACE_IN_TIME]


def _largest(results: Results, by: str) -> float:
    """The largest force or current of a contact in the whole run; no current passes to a rigid surface."""
    tables = [results.contacts, *([results.surface_contacts] if by == "force" and results.rigid_surfaces else [])]
    return max(float(np.abs(table[by]).max(initial=0.0)) for table in tables)


def _with_surfaces(contacts: Table, on_surfaces: Table) -> dict[str, list]:
    """Columns of the contacts between wires, and behind them of those with rigid surfaces; None where one has no value."""
    columns = {name: _column(values) for name, values in contacts.items()}
    if not on_surfaces.n_rows:
        return columns
    more = {name: _column(values) for name, values in on_surfaces.items()}
    elements, names = more["element"], more["surface"]
    more |= {"element_1": elements, "element_2": names, "current": [0.0] * len(names)}
    more["id"] = [f"{name}:{element}" for name, element in zip(names, elements, strict=True)]
    return {
        name: columns.get(name, [None] * contacts.n_rows) + more.get(name, [None] * on_surfaces.n_rows)
        for name in [*columns, *(name for name in more if name not in columns)]
    }


def _column(values: np.ndarray) -> list:
    if values.dtype.kind in "iU":
        return values.tolist()
    return [_number(value) for value in values.tolist()]


def _number(value: float) -> float | str | None:
    """JSON has no infinity: the viewer shows text unchanged, and a dash for None."""
    if math.isinf(value):
        return "∞" if value > 0 else "-∞"
    return None if math.isnan(value) else float(f"{value:.{_DIGITS}g}")


def _base64(values: np.ndarray, kind: type) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode()


def _colour_table(name: str) -> str:
    return _base64(mpl.colormaps[name](np.arange(256), bytes=True), np.uint8)


def _json(data: dict) -> str:
    return json.dumps(data, separators=(",", ":"), allow_nan=False)
