"""What a picture of the wires shows, in metres, and the camera that looks at it."""

import re
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..base.quantities import engineering, label
from ..results import Results
from ..results.scalars import (
    colours_and_limits,
    default_scalar,
    end_values,
    find_scalar,
    scalar_values,
    values_of_wires,
)
from ..results.surface_patches import surface_patches
from ..wires.chains import Wire
from ..wires.curves import element_curves, hermite
from .colours import without_value
from .contact_marks import ContactMarks, Spots
from .prisms import Frames, first_axes, lines_of_one_section

_MAX_POINTS = 60_000
# Shapes of sections
_SHAPE = re.compile(r"^\*BEAM *(?:GENERAL *)?SECTION\b[^\n]*, *SECTION *= *(\w+)", re.IGNORECASE | re.MULTILINE)
AS_CIRCLES = "sections are drawn as circles"
#: Directions to the viewer that have a name
VIEWS = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "-x": (-1, 0, 0), "-y": (0, -1, 0), "-z": (0, 0, -1),
         "iso": (1, -1, 0.8)}  # fmt: skip


@dataclass
class Scene:
    """Everything that is seen, in metres, before the camera comes in.

    Attributes
    ----------
    points, radius, value : ndarray
        Along all wires: positions (n, 3), radius (n), colour value (n).
    starts : ndarray
        First point of each wire, and n at the end.
    reference, reference_starts : ndarray
        The axes before any deformation; empty when they are not wanted.
    surface_points, surface_quads, surface_rim : ndarray
        Of the rigid surfaces: corners (k, 3), rows of them at the corners of each face (l, 4), and at the ends of each line
        along the edges (j, 2).
    spots, spot_radius : Spots, ndarray
        Places and drawn radii (m) [m] of the discs that stand for the contact spots.
    lines, line_pieces, line_value : Spots, ndarray, ndarray
        Zones of contact along lines: points (k), pieces between two of them (p, 2), and force per length (k).
    line_ends : ndarray
        Rows of the points at the ends of the zones.
    line_title : str
        What the colours of the zones mean; empty where there are none at the increments that are shown.
    line_limit : float
        Largest force per length; the colours begin at 0.
    title, spot_text : str
        What the colours and the spots mean, with units.
    shape_text : str
        What is to be said of the shape of the wires; empty where they are as they look.
    grey_text : str
        What is to be said of wires without a value; empty where all have one.
    limits : tuple of float
        Range of the colours.
    colours : str
        Name of the colour map.
    length_unit : str
        Unit of all places and radii.
    frames : dict
        Section axes and outlines of the wires that are not drawn as tubes, by their numbers.
    """

    points: np.ndarray
    radius: np.ndarray
    value: np.ndarray
    starts: np.ndarray
    reference: np.ndarray
    reference_starts: np.ndarray
    surface_points: np.ndarray
    surface_quads: np.ndarray
    surface_rim: np.ndarray
    spots: Spots
    spot_radius: np.ndarray
    lines: Spots
    line_pieces: np.ndarray
    line_value: np.ndarray
    line_ends: np.ndarray
    line_title: str
    line_limit: float
    title: str
    spot_text: str
    shape_text: str
    limits: tuple[float, float]
    colours: str
    length_unit: str
    frames: dict[int, Frames] = field(default_factory=dict)
    grey_text: str = ""

    @property
    def reach(self) -> float:
        """How far anything reaches from its axis [m]."""
        return max([float(self.radius.max()), *(frames.reach for frames in self.frames.values())])

    @property
    def outline(self) -> np.ndarray:
        """Points (n, 3) between which everything lies, apart from the radii [m]."""
        return np.concatenate([self.points, self.reference, self.surface_points])


@dataclass
class Camera:
    """A parallel projection: unit vectors of the picture, its centre, and half its width and height [m]."""

    right: np.ndarray
    up: np.ndarray
    toward: np.ndarray
    centre: np.ndarray
    half_width: float
    half_height: float

    def project(self, points: np.ndarray) -> np.ndarray:
        """Picture coordinates and depth, (n, 3), zero at the centre."""
        return self.turn(points - self.centre)

    def turn(self, vectors: np.ndarray) -> np.ndarray:
        """Components of vectors (n, 3) to the right, upwards and toward the viewer."""
        return vectors @ np.stack([self.right, self.up, self.toward], axis=1)


class SceneMaker:
    """Scenes of several increments, with one unit, one range of colours and one size of spots for all of them.

    Parameters
    ----------
    results : Results
    increments : list of int
        The increments that are shown.
    field, scale, spots, reference
        As `litz.plot` has them.
    """

    def __init__(
        self, results: Results, increments: list[int], field: str | None = None, scale: float = 1.0,
        spots: str | None = None, reference: bool = True,
    ):  # fmt: skip
        self._results, self._scale, self._reference = results, scale, reference
        self._choose_colours(field, increments)
        self._marks = ContactMarks(results, increments, spots)
        self._patches = surface_patches(results, increments)
        self._shape_text = shape_text(results)
        self._wires, self._sections = lines_of_one_section(results)
        self._rest = self._curves(np.zeros_like(results.nodes), np.zeros_like(results.nodes))

    def _choose_colours(self, field: str | None, increments: list[int]) -> None:
        """What the colours mean, and their range."""
        results = self._results
        self._scalar = find_scalar(results, field or default_scalar(results, increments[-1]))
        values = [
            values_of_wires(results, self._scalar, scalar_values(results, self._scalar, increment))
            for increment in increments
        ]
        lowest, highest = min(np.nanmin(one) for one in values), max(np.nanmax(one) for one in values)
        self._factor, unit = engineering(np.array([lowest, highest]), self._scalar.unit)
        self._title = label(self._scalar.text, unit)
        self._colours, self._limits = colours_and_limits(
            self._factor * lowest, self._factor * highest, self._scalar.is_length
        )

    def recoloured(self, scene: Scene, increment: int, field: str | None) -> Scene:
        """A scene of one increment with the colours of another field."""
        self._choose_colours(field, [increment])
        values = end_values(self._results, self._scalar, increment)
        return replace(scene, **self._coloured(values))

    def _coloured(self, values: np.ndarray) -> dict[str, Any]:
        """What of a scene depends on the values at the ends of the elements that colour it."""
        n = self._per_element
        return {
            "value": along_wires(self._factor * values, self._wires, n),
            "title": self._title,
            "limits": self._limits,
            "colours": self._colours,
            "grey_text": without_value(self._scalar.text) if np.isnan(values).any() else "",
        }

    @property
    def _per_element(self) -> int:
        """Points of each element."""
        return int(np.clip(_MAX_POINTS // len(self._results.elements), 1, 24))

    def _curves(self, displacement: np.ndarray, rotation: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        results = self._results
        return element_curves(results.nodes, displacement, rotation, results.wires, len(results.elements))

    def scene(self, increment: int) -> Scene:
        """What is seen of one of the increments."""
        results, wires = self._results, self._wires
        n = self._per_element
        displacement = results.field("displacement", increment)
        rotation = results.field("rotation", increment)
        now = self._curves(displacement, rotation)
        positions, slopes = (
            before + self._scale * (after - before) for before, after in zip(self._rest, now, strict=True)
        )
        points, starts = sample_wires(positions, slopes, wires, n)
        has_reference = self._reference and np.abs(self._scale * displacement).max() > 0.2 * results.radius.min()
        values = end_values(results, self._scalar, increment)
        spots, sizes = self._marks.spots(increment, (positions, slopes))
        lines, on_lines = self._marks.lines(increment, (positions, slopes))
        corners, quads, rim = self._surfaces(increment)
        return Scene(
            points=points,
            starts=starts,
            radius=along_wires(np.repeat(results.radius[:, None], 2, axis=1), wires, n),
            reference=sample_wires(*self._rest, wires, n)[0] if has_reference else np.zeros((0, 3)),
            reference_starts=starts if has_reference else np.zeros(0, dtype=int),
            surface_points=corners,
            surface_quads=quads,
            surface_rim=rim,
            spots=spots,
            spot_radius=sizes,
            lines=on_lines,
            line_pieces=lines.pieces,
            line_value=self._marks.line_factor * lines.value,
            line_ends=lines.ends.ravel(),
            line_title=self._marks.line_title,
            line_limit=self._marks.line_factor * self._marks.line_limit,
            spot_text=self._marks.text(increment),
            shape_text=self._shape_text,
            length_unit=results.unit_labels["m"],
            frames=self._frames(rotation, starts, n),
            **self._coloured(values),
        )

    def _frames(self, rotation: np.ndarray, starts: np.ndarray, n: int) -> dict[int, Frames]:
        """Section axes of the lines that have an outline, at the points of `sample_wires`."""
        outlines = self._results.section_outlines
        if not outlines:
            return {}
        rest, now = (first_axes(self._results, turn) for turn in (np.zeros_like(rotation), rotation))
        ends = rest + self._scale * (now - rest)
        axes = np.stack([along_wires(ends[:, :, axis], self._wires, n) for axis in range(3)], axis=1)
        return {
            number: Frames(outlines[section].corners, axes[starts[number] : starts[number + 1]], int(line.signs[0]))
            for number, (line, section) in enumerate(zip(self._wires, self._sections, strict=True))
            if section
        }

    def surface_points(self, increments: list[int]) -> list[np.ndarray]:
        """Corners of the rigid surfaces at increments, each (k, 3) [m]."""
        return [self._surfaces(increment)[0] for increment in increments]

    def _surfaces(self, increment: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Corners, faces and edges of the rigid surfaces."""
        points, quads, rims = [np.zeros((0, 3))], [np.zeros((0, 4), dtype=int)], [np.zeros((0, 2), dtype=int)]
        first = 0
        for patch in self._patches:
            points.append(patch.moved(self._results, increment, self._scale))
            quads.append(first + patch.quads)
            rims.append(first + patch.rim)
            first += len(patch.points)
        return np.concatenate(points), np.concatenate(quads), np.concatenate(rims)


def shape_text(results: Results) -> str:
    """What is to be said of sections that are not round."""
    try:
        deck = results.deck
    except (KeyError, OSError):
        # not from this program
        return ""
    shapes = {shape.upper() for shape in _SHAPE.findall(deck)} - {"CIRC", "PIPE"}
    if shapes and not results.section_outlines:
        return AS_CIRCLES
    told = ["general sections are drawn as circles"] if "GENERAL" in shapes else []
    if not results.section_outlines:
        return "; ".join(told)
    outlined = results.element_ids[np.isin(results.sections, list(results.section_outlines))]
    contacts, on_surfaces = results.contacts, results.surface_contacts
    touching = [contacts[name] for name in ("element_1", "element_2")] if contacts.n_rows else []
    touching += [on_surfaces["element"]] if on_surfaces.n_rows else []
    if any(np.isin(elements, outlined).any() for elements in touching):
        told.append("wires touch as round ones")
    return "; ".join(told)


def sample_wires(positions: np.ndarray, slopes: np.ndarray, wires: list[Wire], n: int) -> tuple[np.ndarray, np.ndarray]:
    """Points along all wires, n per element and one at the end, and the first of each wire."""
    xi = np.linspace(-1, 1, n + 1)
    points, starts = [], [0]
    for wire in wires:
        inner = hermite(
            np.repeat(positions[wire.elements], n, axis=0),
            np.repeat(slopes[wire.elements], n, axis=0),
            (wire.signs[:, None] * xi[:-1]).ravel(),
        )
        last = wire.elements[-1:]
        points += [inner, hermite(positions[last], slopes[last], wire.signs[-1:] * xi[-1:])]
        starts.append(starts[-1] + n * len(wire.elements) + 1)
    return np.concatenate(points), np.array(starts)


def along_wires(ends: np.ndarray, wires: list[Wire], n: int) -> np.ndarray:
    """Values at the points of `sample_wires`, linear between the two ends (n_elements, 2) of each element."""
    fraction = np.arange(n) / n
    values = []
    for wire in wires:
        pairs = np.where(wire.signs[:, None] < 0, ends[wire.elements][:, ::-1], ends[wire.elements])
        values += [(pairs[:, :1] * (1 - fraction) + pairs[:, 1:] * fraction).ravel(), pairs[-1:, 1]]
    return np.concatenate(values)


def aim(shown: np.ndarray, margin: float, aspect: float, view: tuple[float, float, float] | None = None) -> Camera:
    """A camera that fills a picture of the given width over height with points (n, 3) and a margin around them [m].

    Without a `view` (the direction towards the viewer) the longest axis of the model lies across, the shortest points
    to the viewer, and the picture is tilted a little.
    """
    if view is None:
        extent = np.ptp(shown, axis=0)
        order = np.argsort(-extent, kind="stable")
        if extent[order[0]] < 1.5 * extent[order[1]]:
            order[:2] = np.sort(order[:2])
        across, along, _ = np.eye(3)[order]
        towards = np.cross(across, along)
        toward = towards - 0.55 * along + 0.3 * across
        up = along
    else:
        toward = np.asarray(view, dtype=float)
        if not np.linalg.norm(toward) > 0:
            raise ValueError("the view is the direction to the viewer: three numbers that are not all zero")
        steep = np.hypot(*toward[:2]) <= 1e-3 * np.linalg.norm(toward)
        up = np.array([0.0, 1.0, 0.0] if steep else [0.0, 0.0, 1.0])
    toward = toward / np.linalg.norm(toward)
    right = np.cross(up, toward)
    right /= np.linalg.norm(right)
    up = np.cross(toward, right)
    flat = shown @ np.stack([right, up, toward], axis=1)
    low, high = flat.min(axis=0) - margin, flat.max(axis=0) + margin
    half_width, half_height = 1.04 * (high - low)[:2] / 2
    half_height = max(half_height, half_width / aspect)
    centre = (low + high) / 2 @ np.stack([right, up, toward])
    return Camera(right, up, toward, centre, half_height * aspect, half_height)
