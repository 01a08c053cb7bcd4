"""Axes of charts draw their marks, grid lines and numbers as those of matplotlib do."""

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from litz.pictures.chart_axes import ChartFigure
from litz.pictures.margins import arrange
from litz.pictures.plots import STYLE


def linear(figure):
    axes = figure.add_subplot()
    axes.plot([0, 1, 2], [3, 1, 2])
    axes.set_xlabel("time [s]")
    axes.set_ylabel("force [N]")


def logarithmic_with_names(figure):
    upper, lower = figure.subplots(2, 1)
    upper.semilogy([1, 2, 3], [1e-3, 1, 1e4])
    upper.yaxis.set_minor_locator(NullLocator())
    lower.bar([1, 2], [3.0, -1.0])
    lower.set_xticks([1, 2], ["LOWER", "UPPER"])
    lower.grid(visible=False, axis="x")
    lower.set_ylabel("current [A]")


def with_a_second_scale(figure):
    axes = figure.add_subplot()
    axes.plot([0, 1], [0, 5])
    right = axes.twinx()
    right.plot([0, 1], [700, 100])
    right.set_ylabel("temperature [K]")
    right.spines["right"].set_visible(True)


def of_numbers_with_an_offset(figure):
    figure.add_subplot().plot([0, 1], [1e6, 1e6 + 1e-3])


def with_labels_beside_the_numbers(figure):
    axes = figure.add_axes((0.3, 0.3, 0.5, 0.5))
    axes.plot([0, 1], [0, 1000])
    axes.set_xlabel("place")
    axes.set_ylabel("heat")


@pytest.mark.parametrize(
    "draw",
    [linear, logarithmic_with_names, with_a_second_scale, of_numbers_with_an_offset, with_labels_beside_the_numbers],
)
def test_a_chart_is_that_of_matplotlib(draw):
    pictures = []
    with mpl.rc_context(STYLE):
        for kind in (Figure, ChartFigure):
            figure = kind(figsize=(5, 4), dpi=100)
            draw(figure)
            arrange(figure)
            canvas = FigureCanvasAgg(figure)
            canvas.draw()
            pictures.append(np.asarray(canvas.buffer_rgba())[..., :3].astype(int))
    # grid lines of matplotlib end half a line before the edges of the axes
    assert np.abs(pictures[0] - pictures[1]).max() <= 60
    assert (np.abs(pictures[0] - pictures[1]).max(axis=2) > 30).sum() < 100


def test_an_axis_makes_a_single_mark():
    with mpl.rc_context(STYLE):
        figure = ChartFigure()
        linear(figure)
        arrange(figure)
        FigureCanvasAgg(figure).draw()
    assert len(figure.axes[0].xaxis.get_majorticklocs()) > 3
    assert len(vars(figure.axes[0].xaxis)["majorTicks"]) == 1
