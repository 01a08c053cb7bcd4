"""Axes whose marks, grid lines and numbers are drawn with one mark.

matplotlib makes seven objects for each of them, which takes half of the time of a chart.
"""

from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis, XAxis, YAxis
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

# Places count as within the limits up to this part of their distance
_ROUND_OFF = 1e-10


class ChartFigure(Figure):
    """A figure whose charts have these axes."""

    def add_axes(self, *arguments: Any, **options: Any) -> Axes:
        """As of matplotlib."""
        return super().add_axes(*arguments, **{"axes_class": _ChartAxes, **options})

    def add_subplot(self, *arguments: Any, **options: Any) -> Axes:
        """As of matplotlib."""
        return super().add_subplot(*arguments, **{"axes_class": _ChartAxes, **options})


class _OneMark(Axis):
    """An axis that draws its first mark at all places, where it need not know what room the numbers take."""

    is_placed = False

    def set_label_coords(self, *place: Any, **options: Any) -> None:
        super().set_label_coords(*place, **options)
        self.is_placed = True

    def set_clip_path(self, *path: Any) -> None:
        # that of matplotlib would make marks, which lie outside anyway
        Artist.set_clip_path(self, *path)

    def set_tick_params(self, *arguments: Any, **options: Any) -> None:
        # to change how marks look would make some, which are made later as they should look
        none_yet = {"majorTicks", "minorTicks"} - vars(self).keys()
        for name in none_yet:
            setattr(self, name, [])
        super().set_tick_params(*arguments, **options)
        for name in none_yet:
            self.__dict__.pop(name, None)

    def draw(self, renderer: RendererBase) -> None:
        texts, places = self._numbers()
        is_simple = isinstance(self.get_minor_locator(), NullLocator) and not self.get_major_formatter().get_offset()
        if not is_simple or (self.get_label_text() and not self.is_placed):
            super().draw(renderer)
            return
        if not self.get_visible():
            return
        if len(places):
            self._draw_marks(renderer, places, texts)
        self.label.draw(renderer)
        self.stale = False

    def _numbers(self) -> tuple[list[str], np.ndarray]:
        """Texts of the marks within the limits, and where these are."""
        if isinstance(self.get_major_locator(), NullLocator):
            return [], np.zeros(0)
        places = np.asarray(self.get_majorticklocs())
        texts = self.get_major_formatter().format_ticks(places)
        change = self.get_transform().transform
        low, high = change(np.sort(self.get_view_interval()))
        allowed = _ROUND_OFF * (high - low)
        at = change(places) if len(places) else places
        inside = np.flatnonzero((at >= low - allowed) & (at <= high + allowed))
        return [texts[one] for one in inside], places[inside]

    def _draw_marks(self, renderer: RendererBase, places: np.ndarray, texts: list[str]) -> None:
        mark = self.get_major_ticks(1)[0]
        along = self.axis_name == "x"
        if mark.gridline.get_visible():
            lines = np.full((3 * len(places), 2), np.nan)
            lines[0::3], lines[1::3] = (
                np.stack([places, 0 * places], axis=1),
                np.stack([places, 0 * places + 1], axis=1),
            )
            _draw_at(mark.gridline, lines if along else lines[:, ::-1], renderer)
        for line, side in ((mark.tick1line, 0.0), (mark.tick2line, 1.0)):
            if line.get_visible():
                points = np.stack([places, np.full(len(places), side)], axis=1)
                _draw_at(line, points if along else points[:, ::-1], renderer)
        for number in (mark.label1, mark.label2):
            if number.get_visible():
                for place, text in zip(places, texts, strict=True):
                    (number.set_x if along else number.set_y)(place)
                    number.set_text(text)
                    number.draw(renderer)


def _draw_at(line: Line2D, points: np.ndarray, renderer: RendererBase) -> None:
    """Draw a line at other points than its own."""
    own = line.get_data()
    line.set_data(*points.T)
    line.draw(renderer)
    line.set_data(*own)


class _ChartXAxis(_OneMark, XAxis):
    pass


class _ChartYAxis(_OneMark, YAxis):
    pass


class _ChartAxes(Axes):
    """As those of matplotlib, with these axes."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        for spine in self.spines.values():
            # they find their places when marks are made, which an axis that is not seen never does
            spine.get_spine_transform()

    def _init_axis(self) -> None:
        self.xaxis, self.yaxis = _ChartXAxis(self, clear=False), _ChartYAxis(self, clear=False)
        for axis, sides in ((self.xaxis, ("bottom", "top")), (self.yaxis, ("left", "right"))):
            for side in sides:
                self.spines[side].register_axis(axis)
