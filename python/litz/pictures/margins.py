"""Room for the texts around charts, from the widths of letters.

The layouts of matplotlib make all marks and texts several times over to measure them, which takes as long as to draw the charts.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.text import Text
from matplotlib.transforms import ScaledTranslation

# Around and between charts with their texts [points]
_PAD = 8.0
_POINTS_PER_INCH = 72.0
# Height of a line of text, in sizes of the font
_LINE = 1.17
# What letters are wider than drawn to scale, as they begin and end with pixels
_HINTED = 1.05
# At least for the axes, of the width and the height of a figure
_LEAST_SHARE = 0.3
# Of a scale of colours: width in points, and between it and what is at its left
_BAR, _BESIDE_BAR = 11.0, 10.0
_BAR_NAME = "scale of colours"


def text_width(text: str, size: float, *, bold: bool = False) -> float:
    """Width of the longest line of a text in a size of the font [points]."""
    return _HINTED * size * max(sum(_advance(letter, bold) for letter in line) for line in text.split("\n"))


@cache
def _advance(letter: str, bold: bool) -> float:
    """Width of a letter, in sizes of the font."""
    font = get_font(findfont(FontProperties(weight="bold" if bold else "normal")))
    font.set_size(_POINTS_PER_INCH, _POINTS_PER_INCH)
    return font.load_char(ord(letter)).linearHoriAdvance / 65536 / _POINTS_PER_INCH


def bar_beside(axes: Iterable[Axes], colours: ScalarMappable) -> Colorbar:
    """A scale of colours at the right of charts, for which `arrange` makes room."""
    first, *_ = axes = list(axes)
    if first.get_subplotspec() is None:
        return first.figure.colorbar(colours, ax=axes, pad=0.02, aspect=40)
    place = first.figure.add_axes((0.9, 0.1, 0.02, 0.8), label=_BAR_NAME)
    return first.figure.colorbar(colours, cax=place)


@dataclass
class _Around:
    """What texts need at the sides of axes [points]."""

    left: float = 0.0
    right: float = 0.0
    bottom: float = 0.0
    top: float = 0.0


def arrange(figure: Figure) -> None:
    """Place the charts of a figure in its grid, so that there is room for their texts, and these where they are then."""
    charts = [axes for axes in figure.axes if axes.get_subplotspec() is not None]
    if not charts:
        return
    # the marks of a shorter axis may be others
    for _ in range(2):
        _place(figure, charts)
    _place_bars(figure, charts)


def _place(figure: Figure, charts: list[Axes]) -> None:
    grid = charts[0].get_subplotspec().get_gridspec()
    n_rows, n_columns = grid.get_geometry()
    cells = [[_Around() for _ in range(n_columns)] for _ in range(n_rows)]
    for axes in charts:
        spec, own = axes.get_subplotspec(), _around(axes)
        cell = cells[spec.rowspan.start][spec.colspan.start]
        for side, value in vars(own).items():
            setattr(cell, side, max(getattr(cell, side), value))
    across = [(max(row[k].left for row in cells), max(row[k].right for row in cells)) for k in range(n_columns)]
    down = [(max(cell.top for cell in row), max(cell.bottom for cell in row)) for row in cells]
    width, height = _POINTS_PER_INCH * figure.get_size_inches()
    bars = sum(_width_of_bar(bar) for bar in _bars(figure))
    heads = max(
        (_LINE * text.get_fontsize() + (1 - text.get_position()[1]) * height for text in figure.texts), default=0
    )
    left, right, wspace = _shares(across, width, 0.0, bars)
    top, bottom, hspace = _shares(down, height, heads, 0.0)
    figure.subplots_adjust(left=left, right=1 - right, bottom=bottom, top=1 - top, wspace=wspace, hspace=hspace)
    for axes in charts:
        columns = across[axes.get_subplotspec().colspan.start]
        for axis in (axes.xaxis, axes.yaxis):
            place_label(axis, columns[0])


def _shares(sides: list[tuple[float, float]], size: float, before: float, behind: float) -> tuple[float, float, float]:
    """What is before the first axes and behind the last, of a size [points], and between two, of the axes."""
    first, last = sides[0][0] + _PAD + before, sides[-1][1] + _PAD + behind
    between = max((one[1] + other[0] for one, other in pairwise(sides)), default=0.0) + _PAD
    n = len(sides)
    taken = first + last + (n - 1) * between
    # very long texts go beyond the picture
    shrunk = min(1.0, (1 - _LEAST_SHARE) * size / taken)
    first, last, between = shrunk * first, shrunk * last, shrunk * between
    return first / size, last / size, between * n / (size - first - last - (n - 1) * between)


def _around(axes: Axes) -> _Around:
    around = _Around(top=_LINE * mpl.rcParams["font.size"] / 2, right=_PAD / 2)
    width = axes.get_window_extent().width * _POINTS_PER_INCH / axes.figure.dpi
    if axes.axison:
        for axis in (axes.xaxis, axes.yaxis):
            side = axis.get_label_position()
            setattr(around, side, max(getattr(around, side), _beside(axis) + _label_height(axis)))
        if _has_numbers(axes.xaxis):
            over = [
                place * width + text_width(text, _size_of_numbers(axes.xaxis)) / 2
                for place, text in _numbers(axes.xaxis)
            ]
            around.right = max([around.right, *(one - width for one in over)])
    for text in (axes.get_title(loc) for loc in ("left", "center", "right")):
        if text:
            lines = text.count("\n") + 1
            around.top = max(around.top, mpl.rcParams["axes.titlepad"] + lines * _LINE * mpl.rcParams["axes.titlesize"])
    if legend := axes.get_legend():
        size = legend.get_texts()[0].get_fontsize() if legend.get_texts() else 0.0
        texts = [text_width(text.get_text(), size) for text in legend.get_texts()]
        frame = size * (legend.borderaxespad + 2 * legend.borderpad)
        entries = size * (legend.handlelength + legend.handletextpad) + max(texts, default=0.0)
        around.right = max(around.right, frame + max(entries, _width_of(legend.get_title())))
    return around


def _width_of(text: Text) -> float:
    return text_width(text.get_text(), text.get_fontsize())


def _has_numbers(axis: Axis) -> bool:
    shown = axis.get_tick_params()
    return any(shown.get(f"label{side}", False) for side in ("left", "right", "bottom", "top"))


def _size_of_numbers(axis: Axis) -> float:
    return FontProperties(size=mpl.rcParams[f"{axis.axis_name}tick.labelsize"]).get_size_in_points()


def _numbers(axis: Axis) -> list[tuple[float, str]]:
    """Numbers at the marks of an axis, and where they are, from 0 to 1 along it."""
    places = np.asarray(axis.get_majorticklocs())
    if not len(places):
        return []
    low, high = axis.get_transform().transform(np.sort(axis.get_view_interval()))
    share = (axis.get_transform().transform(places) - low) / ((high - low) or 1.0)
    texts = axis.get_major_formatter().format_ticks(places)
    return [(float(one), text) for one, text in zip(share, texts, strict=True) if -1e-9 < one < 1 + 1e-9]


def _beside(axis: Axis) -> float:
    """Room for the marks of an axis and their numbers, across it [points]."""
    name = f"{axis.axis_name}tick.major"
    marks = mpl.rcParams[f"{name}.size"] + mpl.rcParams[f"{name}.pad"]
    if not _has_numbers(axis):
        return 0.0
    numbers, size = _numbers(axis), _size_of_numbers(axis)
    if not numbers:
        return 0.0
    return marks + (_LINE * size if axis.axis_name == "x" else max(text_width(text, size) for _, text in numbers))


def _label_height(axis: Axis) -> float:
    text = axis.get_label_text()
    return axis.labelpad + _LINE * axis.label.get_fontsize() * (text.count("\n") + 1) if text else 0.0


def place_label(axis: Axis, left: float) -> None:
    """Put the label of an axis beside its numbers: at the left as far away as those of other charts in the column [points]."""
    if not axis.get_label_text():
        return
    axes, side = axis.axes, axis.get_label_position()
    away = axis.labelpad + _beside(axis)
    if side == "left":
        away = max(away, left - _label_height(axis) + axis.labelpad)
    across, up = {"left": (-away, 0.0), "right": (away, 0.0), "bottom": (0.0, -away), "top": (0.0, away)}[side]
    start = {"left": (0.0, 0.5), "right": (1.0, 0.5), "bottom": (0.5, 0.0), "top": (0.5, 1.0)}[side]
    shift = ScaledTranslation(across / _POINTS_PER_INCH, up / _POINTS_PER_INCH, axes.figure.dpi_scale_trans)
    axis.set_label_coords(*start, transform=axes.transAxes + shift)


def _bars(figure: Figure) -> list[Axes]:
    return [axes for axes in figure.axes if axes.get_label() == _BAR_NAME]


def _width_of_bar(bar: Axes) -> float:
    """With its numbers and its label [points]."""
    return _BESIDE_BAR + _BAR + _beside(bar.yaxis) + _label_height(bar.yaxis)


def _place_bars(figure: Figure, charts: list[Axes]) -> None:
    """Scales of colours at the right of everything, as high as all charts together."""
    width, _ = _POINTS_PER_INCH * figure.get_size_inches()
    boxes = [axes.get_position() for axes in charts]
    bottom, top = min(box.y0 for box in boxes), max(box.y1 for box in boxes)
    right = 1 - _PAD / width
    for bar in _bars(figure):
        start = right - (_width_of_bar(bar) - _BESIDE_BAR) / width
        bar.set_position((start, bottom, _BAR / width, top - bottom))
        place_label(bar.yaxis, 0.0)
        right = start - _BESIDE_BAR / width
