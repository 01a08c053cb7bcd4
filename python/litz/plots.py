"""Pictures of results: `plot(results)` for an overview, `plot(results, "residuals")` and the like for one thing."""

import textwrap
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from . import charts
from .results import Results
from .run import FileError
from .tables import unknown_name
from .wire_picture import COLOURS, draw_frame, draw_wires, make_scene

_STYLE = {
    "font.size": 10,
    "font.family": "sans-serif",
    "axes.titlesize": 11,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
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
}
_DPI = 150


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
    view: tuple[float, float, float] | None = None,
) -> Path:
    """Draw results into a picture file.

    Parameters
    ----------
    results : Results or path
        What `Results` takes.
    kind : str
        "overview"    the wires and the main charts together
        "wires"       deformed wires as tubes coloured by a field, with the contact spots
        "resistance"  contact resistance over contact force, both logarithmic
        "residuals"   residual norms over the iterations of each increment, with the allowed values
        "contacts"    number, forces, spots and heat of the contacts over time
        "currents"    current of each wire, and along each wire
        "history"     the columns that the deck asked for, over time
    filename : path, optional
        The picture; its ending chooses the format. Default: `STEM_KIND.png` beside the results.
    increment : int
        Index of the increment that is shown, -1 the last.
    field : str, optional
        What colours the wires, one of `Results.fields`; default: the potential, or else the displacement.
    scale : float
        Factor on the displacements of the drawn wires.
    spots : str, optional
        "current" or "force": what the drawn size of the contact spots means; "none": no spots.
    reference : bool
        Show the axes before the deformation as thin lines.
    view : tuple of 3 float, optional
        Direction from the wires to the viewer; default: one that shows the model well.

    Returns
    -------
    Path
        The picture.
    """
    if kind not in _KINDS:
        raise ValueError(unknown_name("kind of plot", kind, _KINDS))
    if spots not in (None, "current", "force", "none"):
        raise ValueError(f'spots may be "current", "force" or "none", not {spots!r}')
    results = results if isinstance(results, Results) else Results(results)
    if not len(results.times):
        raise FileError(f"{results.path} has no increment yet: there is nothing to draw")
    path = Path(filename) if filename else results.path.with_name(f"{results.path.stem}_{kind}.png")
    seen = {"field": field, "scale": scale, "spots": spots, "reference": reference, "view": view}
    with mpl.rc_context(_STYLE):
        figure = _KINDS[kind](results, increment, seen)
        figure.savefig(path, dpi=_DPI)
    return path


def _title(results: Results, increment: int) -> str:
    heading = textwrap.shorten((results.heading.strip() or results.path.stem).splitlines()[0], 75, placeholder=" ...")
    return (
        f"{heading}\nstep {results.steps[increment]}, increment {results.increments[increment]}, "
        f"time {results.times[increment]:g} s"
    )


def _wires(results: Results, increment: int, seen: dict) -> Figure:
    figure = Figure(figsize=(10.0, 7.0), dpi=_DPI)
    _wires_into(figure, results, increment, seen, (0.01, 0.13, 0.98, 0.76))
    figure.text(0.03, 0.975, _title(results, increment), va="top", fontsize="large", linespacing=1.4)
    return figure


def _wires_into(figure: Figure, results: Results, increment: int, seen: dict, box: tuple) -> None:
    """The scene in a box (left, bottom, width, height) of a figure, colour bar and legend of the spots below it."""
    view = seen["view"]
    scene = make_scene(results, increment, seen["field"], seen["scale"], seen["spots"], seen["reference"])
    left, bottom, width, _ = box
    camera = draw_wires(figure.add_axes(box), scene, view)
    inch = 1.0 / figure.get_figheight()
    draw_frame(figure.add_axes((left, bottom - 0.75 * inch, width, 0.75 * inch)), camera)
    bar_axes = figure.add_axes((left + 0.04 * width, bottom - 0.30 * inch, 0.40 * width, 0.13 * inch))
    colours = mpl.cm.ScalarMappable(mpl.colors.Normalize(*scene.limits), COLOURS)
    bar = figure.colorbar(colours, cax=bar_axes, orientation="horizontal")
    bar.set_label(scene.title)
    bar.outline.set_visible(False)
    notes = [scene.spot_text] if scene.spot_text else []
    if len(scene.reference):
        notes.append("grey: axes before the deformation")
    if seen["scale"] != 1.0:
        notes.append(f"displacements times {seen['scale']:g}")
    figure.text(
        left + 0.48 * width, bottom - 0.17 * inch, "\n".join(notes), va="top", fontsize="small", linespacing=1.5
    )


def _chart(draw: Callable, size: tuple[float, float]) -> Callable[[Results, int, dict], Figure]:
    def make(results: Results, increment: int, seen: dict) -> Figure:
        figure = Figure(figsize=size, dpi=_DPI, layout="constrained")
        draw(figure, results, increment)
        return figure

    return make


def _overview(results: Results, increment: int, seen: dict) -> Figure:
    figure = Figure(figsize=(15.0, 8.5), dpi=_DPI)
    _wires_into(figure, results, increment, seen, (0.01, 0.115, 0.61, 0.79))
    figure.text(0.03, 0.98, _title(results, increment), va="top", fontsize="x-large", linespacing=1.4)
    boxes = [(0.70, bottom, 0.28, 0.225) for bottom in (0.73, 0.40, 0.07)]
    drawers = [charts.residual_of_last_increment]
    contacts = results.contacts
    drawers.append(charts.forces_over_time if contacts.n_rows else charts.displacement_over_time)
    has_resistances = contacts.n_rows > 0 and contacts["resistance"].any()
    has_currents = results.field("element_current", increment).any()
    drawers += [charts.resistance_over_force] if has_resistances else [charts.current_per_wire] if has_currents else []
    for box, draw in zip(boxes, drawers, strict=False):
        draw(figure.add_axes(box), results, increment)
    return figure


_KINDS: dict[str, Callable[[Results, int, dict], Figure]] = {
    "overview": _overview,
    "wires": _wires,
    "resistance": _chart(charts.resistance, (7.5, 5.5)),
    "residuals": _chart(charts.residuals, (8.0, 7.5)),
    "contacts": _chart(charts.contacts, (10.0, 7.0)),
    "currents": _chart(charts.currents, (10.0, 7.0)),
    "history": _chart(charts.history, (8.0, 4.0)),
}
