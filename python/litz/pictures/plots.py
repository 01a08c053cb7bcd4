"""Pictures of results: `plot(results)` for an overview, `plot(results, "residuals")` and the like for one thing."""

import itertools
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from ..base.names import unknown_name
from ..base.notebook import Picture
from ..base.output import writing
from ..base.quantities import with_unit
from ..errors import FileError
from ..results import Results
from ..results.contact_history import has_lines
from . import cable_charts, charts, friction_charts, network_chart, residual_charts, surface_charts, zone_charts
from .chart_axes import ChartFigure
from .colours import line_colours
from .kinds import INCHES, KINDS
from .margins import arrange, place_label, text_width
from .scene import AS_CIRCLES, VIEWS, Camera, Scene, SceneMaker, aim
from .wire_picture import WITHOUT_OPENGL, Drawn, begin_rendering, draw_frame, draw_wires, render

STYLE = {
    "font.size": 10,
    "font.family": "sans-serif",
    "axes.titlesize": 11,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    # as low as it gets: matplotlib would measure all labels to find out
    "axes.titley": 1.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.7,
    "legend.frameon": False,
    "legend.fontsize": "small",
    "lines.linewidth": 1.6,
    "savefig.facecolor": "white",
    # headings and names of decks are shown as they are, dollar signs too
    "text.parse_math": False,
    # pixels are small enough; to fit each letter to them takes a tenth of the time of a chart
    "text.hinting": "none",
}
_DPI = 150
_MIN_PIXELS = 200
#: Formats of pixels, and options of Pillow: the quality of WebP is of 100
_PIXEL_FORMATS: dict[str, dict[str, Any]] = {".png": {}, ".webp": {"quality": 80, "method": 2}}
#: Where the wires are in a picture of them: left, bottom, width, height
_WIRES_BOX = (0.01, 0.13, 0.98, 0.76)
#: Of what stands at the right of an overview, relative to its width
_RIGHT_EDGE = 0.99
#: Space around a cross-section [inches]
_INCHES = 0.1
#: Width that axes keep beside the longest texts, relative to their own
_LEAST_SHARE = 0.5


@dataclass(frozen=True)
class Look:
    """How the wires are shown; the attributes are those arguments of `plot`."""

    field: str | None = None
    scale: float = 1.0
    spots: str | None = None
    reference: bool = True
    view: tuple[float, float, float] | str | None = None
    wire: int | None = None
    place: float = 0.5

    def __post_init__(self) -> None:
        """Check the arguments."""
        if self.spots not in (None, "current", "force", "none"):
            raise ValueError(f'spots may be "current", "force" or "none", not {self.spots!r}')
        if isinstance(self.view, str) and self.view not in VIEWS:
            raise ValueError(unknown_name("view", self.view, VIEWS))
        if not 0 <= self.place <= 1:
            raise ValueError(f"place is from 0 to 1 along the cable, not {self.place:g}")

    @property
    def direction(self) -> tuple[float, float, float] | None:
        """Direction to the viewer; None: one that shows the model well."""
        return VIEWS[self.view] if isinstance(self.view, str) else self.view

    def scenes(self, results: Results, increments: list[int]) -> SceneMaker:
        """What is seen at increments."""
        return SceneMaker(results, increments, self.field, self.scale, self.spots, self.reference)


def plot(
    results: Results | str | Path,
    kind: str = "overview",
    filename: str | Path | None = None,
    *,
    increment: int = -1,
    field: str | None = None,
    scale: float = 1.0,
    spots: str | None = None,
    reference: bool = True,
    view: tuple[float, float, float] | str | None = None,
    size: tuple[int, int] | None = None,
    wire: int | None = None,
    place: float = 0.5,
) -> Picture:
    """Draw results into a picture file.

    Parameters
    ----------
    results : Results or path
        What `Results` takes.
    kind : str
        - "overview": the wires and the main charts together
        - "wires": deformed wires as tubes coloured by a field, with the contact spots
        - "resistance": contact resistance over contact force, both logarithmic
        - "residuals": residual norms over the iterations of each increment, with the allowed values
        - "contacts": number, forces, spots and heat of the contacts over time
        - "lines": force, current and heat per length of line contact, along the wires
        - "currents": current of each wire, and along each wire
        - "shares": share of each wire in the current along a cable, and contact force per length
        - "section": cross-section of a cable, coloured by the currents or by `field`, with the contacts near it
        - "network": wires as dots, the contacts between them as lines, as thick as their current
        - "friction": friction force over sliding, and the heat of friction over time
        - "surfaces": force on each rigid surface over time, and of each element on them
        - "history": the columns requested in the deck, over time
    filename : path, optional
        The picture; its ending chooses the format, without one it is PNG. Missing directories are created. Default:
        `STEM_KIND.png` beside the results.
    increment : int
        Index of the increment that is shown, -1 the last.
    field : str, optional
        What colours the wires, one of `litz.results.scalars.scalars(results)`: any field of the file, a vector by its length
        or as `displacement.x`, and `bending_moment` for both moments together; default: the potential, or else the
        displacement.
    scale : float
        Factor on the displacements of the drawn wires [-].
    spots : str, optional
        "current" or "force": what the drawn size of the contact spots means; "none": no spots.
    reference : bool
        Show the undeformed axes as thin lines.
    view : tuple of 3 float or str, optional
        Direction from the wires to the viewer, or "x", "y", "z", "-x", "-y", "-z", "iso"; default: one that shows
        the model well.
    size : tuple of 2 int, optional
        Width and height of the picture in pixels; text grows with the width.
    wire : int, optional
        For "lines": the wire, counted from 0, whose zones are drawn over its arc length; default: all zones, each over the
        arc length of its first wire.
    place : float
        For "section": the place along the cable, from 0 to 1.

    Returns
    -------
    Path
        The picture, which a notebook shows.
    """
    if kind not in KINDS:
        raise ValueError(unknown_name("kind of plot", kind, KINDS))
    look = Look(field, scale, spots, reference, view, wire, place)
    results = with_increments(results)
    if wire is not None and not 0 <= wire < len(results.wires):
        raise ValueError(f"there is no wire {wire}: there are {len(results.wires)}, counted from 0")
    path = Picture(filename or results.path.with_name(f"{results.path.stem}_{kind}.png"))
    if not path.suffix:
        path = Picture(f"{path}.png")
    with results.kept_open(), mpl.rc_context(STYLE):
        figure = new_figure(INCHES[kind], size)
        _DRAWERS[kind](figure, results, increment, look)
        with writing(path):
            _save(figure, path)
    return path


def begin_wires(
    results: Results, fields: list[str | None], paths: list[Path], size: tuple[int, int]
) -> Callable[[], None]:
    """Draw the wires at the last increment coloured by several fields, each into a picture; VTK is started once for all.

    VTK draws beside what this process does until it calls what is returned, which writes the pictures.
    """
    with results.kept_open(), mpl.rc_context(STYLE):
        figures = [new_figure(INCHES["wires"], size) for _ in fields]
        made = Look(fields[0]).scenes(results, [-1])
        first = made.scene(-1)
        scenes = [first, *(made.recoloured(first, -1, field) for field in fields[1:])]
        pixels = box_pixels(figures[0], _WIRES_BOX)
        camera = _camera(scenes[0], pixels, Look())
        drawn = begin_rendering(scenes, camera, pixels)

    def finish() -> None:
        with mpl.rc_context(STYLE):
            for figure, scene, path, one in zip(figures, scenes, paths, drawn(), strict=True):
                place_wires(figure, _WIRES_BOX, scene, camera, one, 1.0)
                figure.text(0.03, 0.975, title(results, -1), va="top", fontsize="large", linespacing=1.4)
                _save(figure, path)

    return finish


def _save(figure: Figure, path: Path) -> None:
    """Write a figure, whose layout is found once, and not again whenever it is drawn."""
    canvas = FigureCanvasAgg(figure)
    layout = figure.get_layout_engine()
    if layout is None:
        arrange(figure)
    else:
        for spine in (spine for axes in figure.axes for spine in axes.spines.values()):
            # the labels reach farther
            spine.set_in_layout(False)
        layout.execute(figure)
        figure.set_layout_engine("none")
    if path.suffix.lower() not in _PIXEL_FORMATS:
        figure.savefig(path, dpi="figure")
        return
    # `savefig` would go through the whole figure once more before
    canvas.draw()
    pixels = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    pixels.save(path, dpi=(figure.dpi, figure.dpi), **_PIXEL_FORMATS[path.suffix.lower()])


def with_increments(results: Results | str | Path) -> Results:
    """The results; an error if they have no increment."""
    results = results if isinstance(results, Results) else Results(results)
    if not len(results.times):
        raise FileError(f"{results.path} has no increment yet: there is nothing to draw")
    return results


def new_figure(inches: tuple[float, float], pixels: tuple[int, int] | None) -> Figure:
    """A figure as wide as usual in inches, with the number of pixels that is wanted."""
    if pixels is None:
        return ChartFigure(figsize=inches, dpi=_DPI)
    width, height = pixels
    if width < _MIN_PIXELS or height < _MIN_PIXELS:
        raise ValueError(f"a picture of {width} x {height} pixels is too small: at least {_MIN_PIXELS} each way")
    return ChartFigure(figsize=(inches[0], inches[0] * height / width), dpi=width / inches[0])


def title(results: Results, increment: int) -> str:
    """Two lines above a picture: what it is of, and which increment."""
    heading = textwrap.shorten((results.heading.strip() or results.path.stem).splitlines()[0], 82, placeholder=" ...")
    return (
        f"{heading}\nstep {results.steps[increment]}, increment {results.increments[increment]}, "
        f"time {with_unit(f'{results.times[increment]:g}', results.unit_labels['s'])}"
    )


def _wires(figure: Figure, results: Results, increment: int, look: Look) -> None:
    _still(figure, results, increment, look, _WIRES_BOX)
    figure.text(0.03, 0.975, title(results, increment), va="top", fontsize="large", linespacing=1.4)


def _still(figure: Figure, results: Results, increment: int, look: Look, box: tuple) -> None:
    """The wires at one increment in a box (left, bottom, width, height) of a figure."""
    scene = look.scenes(results, [increment]).scene(increment)
    pixels = box_pixels(figure, box)
    camera = _camera(scene, pixels, look)
    place_wires(figure, box, scene, camera, render([scene], camera, pixels)[0], look.scale)


def _camera(scene: Scene, pixels: np.ndarray, look: Look) -> Camera:
    return aim(scene.outline, scene.reach, pixels[0] / pixels[1], look.direction)


def box_pixels(figure: Figure, box: tuple[float, float, float, float]) -> np.ndarray:
    """Width and height of a box (left, bottom, width, height) of a figure, in pixels."""
    return figure.dpi * figure.get_size_inches() * np.array(box[2:])


def place_wires(figure: Figure, box: tuple, scene: Scene, camera: Camera, drawn: Drawn | None, scale: float) -> None:
    """The scene in a box of a figure, colour bar, notes, directions and scale below it."""
    left, bottom, width, _ = box
    draw_wires(figure.add_axes(box), scene, camera, drawn)
    inch = 1.0 / figure.get_figheight()
    draw_frame(figure.add_axes((left, bottom - 0.75 * inch, width, 0.75 * inch)), camera, scene.length_unit)
    bars: list[tuple[tuple[float, float], Any, str]] = [(scene.limits, scene.colours, scene.title)]
    if scene.line_title:
        bars.append(((0.0, scene.line_limit or 1.0), line_colours(), scene.line_title))
    share, gap = 0.42 / len(bars), 0.02 if len(bars) == 1 else 0.04
    room = 72 * (share - 0.01) * width * figure.get_figwidth()
    for place, (limits, colours, title) in enumerate(bars):
        start = left + (0.04 + place * share) * width
        bar_axes = figure.add_axes((start, bottom - 0.30 * inch, (share - gap) * width, 0.13 * inch))
        power = _power_of_ten(limits)
        in_powers = mpl.colors.Normalize(*(limit / 10.0**power for limit in limits))
        bar = figure.colorbar(mpl.cm.ScalarMappable(in_powers, colours), cax=bar_axes, orientation="horizontal")
        bar.locator = mpl.ticker.MaxNLocator(6 // len(bars))
        bar.formatter.set_powerlimits((-9, 9))
        text = _times_power(title, power)
        # the name of a scale stays within its share
        size = float(mpl.rcParams["font.size"])
        bar.set_label(text, size=size * min(1.0, room / text_width(text, size)))
        place_label(bar_axes.xaxis, 0.0)
        bar.outline.set_visible(False)
    notes = [scene.spot_text] if scene.spot_text else []
    if scene.grey_text:
        notes.append(scene.grey_text)
    if len(scene.reference) and (drawn is None or drawn.shows_reference):
        # wires are grey, too
        notes.append(f"{'thin ' if scene.grey_text else ''}grey lines: undeformed axes")
    if drawn is None and scene.frames:
        notes.append(AS_CIRCLES)
    elif scene.shape_text:
        notes.append(scene.shape_text)
    if scale != 1.0:
        notes.append(f"displacements times {scale:g}")
    if drawn is None:
        notes.append(WITHOUT_OPENGL)
    figure.text(
        left + 0.48 * width, bottom - 0.17 * inch, "\n".join(notes), va="top", fontsize="small", linespacing=1.4
    )


def _power_of_ten(limits: tuple[float, float]) -> int:
    """Power by which the numbers of a scale are divided: 0 where they are neither very small nor very large."""
    largest = max(map(abs, limits))
    power = int(np.floor(np.log10(largest))) if 0 < largest < np.inf else 0
    return 0 if -3 < power < 4 else power


def _times_power(text: str, power: int) -> str:
    """The name of a scale whose numbers have been divided by a power of ten: "heat [W]" -> "heat [1e-6 W]"."""
    if not power:
        return text
    return text.replace(" [", f" [1e{power} ") if text.endswith("]") else f"{text} [1e{power}]"


def _chart(draw: Callable) -> Callable:
    def make(figure: Figure, results: Results, increment: int, look: Look) -> None:
        draw(figure, results, increment)

    return make


def _contacts(figure: Figure, results: Results, increment: int) -> None:
    draw = zone_charts.contacts if has_lines(results) else charts.contacts
    draw(figure, results, increment)


def _lines(figure: Figure, results: Results, increment: int, look: Look) -> None:
    zone_charts.lines(figure, results, increment, look.wire)


def _section(figure: Figure, results: Results, increment: int, look: Look) -> None:
    figure.set_layout_engine("constrained", w_pad=_INCHES, h_pad=_INCHES)
    cable_charts.section(figure, results, increment, look.field, look.place)


def _overview(figure: Figure, results: Results, increment: int, look: Look) -> None:
    _still(figure, results, increment, look, (0.01, 0.115, 0.61, 0.79))
    figure.text(0.03, 0.98, title(results, increment), va="top", fontsize="x-large", linespacing=1.4)
    boxes = [(0.70, bottom, 0.28, 0.225) for bottom in (0.73, 0.40, 0.07)]
    drawers = [residual_charts.residual_of_last_increment]
    contacts, lines = results.contacts, has_lines(results)
    if results.rigid_surfaces:
        drawers.append(surface_charts.surface_forces_over_time)
    if lines:
        drawers.append(zone_charts.force_along_wires)
    else:
        drawers.append(charts.forces_over_time if contacts.n_rows else charts.displacement_over_time)
    has_resistances = contacts.n_rows > 0 and np.isfinite(contacts["resistance"]).any()
    has_currents = results.field("element_current", increment).any()
    if friction_charts.has_friction(results):
        drawers.append(friction_charts.force_over_sliding)
    elif lines:
        drawers.append(zone_charts.forces_and_lengths_over_time)
    elif has_resistances:
        drawers.append(charts.resistance_over_force)
    elif has_currents:
        drawers.append(charts.current_per_wire)
    places = [len(figure.axes)]
    for box, draw in zip(boxes, drawers, strict=False):
        draw(figure.add_axes(box), results, increment)
        places.append(len(figure.axes))
    for first, stop in itertools.pairwise(places):
        _narrow(figure, figure.axes[first:stop])


def _narrow(figure: Figure, drawn: list[Axes]) -> None:
    """Make room at the right edge of the figure for a legend or a second scale beside the first of some axes."""
    boxes = [axes.get_position() for axes in drawn]
    seen = [axes.get_tightbbox() for axes in drawn]
    over = max(box.x1 for box in seen if box is not None) / figure.bbox.width - _RIGHT_EDGE
    left = boxes[0].x0
    share = 1 - over / (max(box.x1 for box in boxes) - left)
    if not _LEAST_SHARE < share < 1:
        return
    for axes, box in zip(drawn, boxes, strict=True):
        axes.set_position((left + share * (box.x0 - left), box.y0, share * box.width, box.height))


_DRAWERS: dict[str, Callable[[Figure, Results, int, Look], None]] = {
    "overview": _overview,
    "wires": _wires,
    "resistance": _chart(charts.resistance),
    "residuals": _chart(residual_charts.residuals),
    "contacts": _chart(_contacts),
    "lines": _lines,
    "currents": _chart(charts.currents),
    "shares": _chart(cable_charts.shares),
    "section": _section,
    "network": _chart(network_chart.network),
    "friction": _chart(friction_charts.friction),
    "surfaces": _chart(surface_charts.surfaces),
    "history": _chart(charts.history),
}
