"""Texts around charts have room in the picture, and do not cover each other."""

import itertools

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from litz.pictures.chart_tools import legend_beside
from litz.pictures.margins import arrange, bar_beside, text_width
from litz.pictures.plots import STYLE


@pytest.fixture(autouse=True)
def style():
    with mpl.rc_context(STYLE):
        yield


@pytest.fixture
def figure():
    figure = Figure(figsize=(8, 6), dpi=100)
    FigureCanvasAgg(figure)
    return figure


def boxes(figure, charts):
    """What charts and their texts cover [pixels]."""
    figure.canvas.draw()
    return [axes.get_tightbbox(figure.canvas.get_renderer()) for axes in charts]


def check_inside(figure, charts, slack=2.0):
    """Nothing is beyond the picture: hinted letters are a pixel wider or narrower than unhinted ones."""
    for box in boxes(figure, charts):
        assert box.x0 >= -slack
        assert box.y0 >= -slack
        assert box.x1 <= figure.bbox.width + slack
        assert box.y1 <= figure.bbox.height + slack


def check_apart(figure, charts):
    for one, other in itertools.combinations(boxes(figure, charts), 2):
        assert one.x1 <= other.x0 or other.x1 <= one.x0 or one.y1 <= other.y0 or other.y1 <= one.y0


@pytest.mark.parametrize(
    "text", ["−0.0125", "force per length [N/m]", "10⁻¹²", "WWWW", "first line\nthe longer second line"]
)
@pytest.mark.parametrize("bold", [False, True])
def test_the_width_of_a_text_is_what_is_drawn(figure, text, bold):
    drawn = figure.text(0.1, 0.5, text, fontsize=30, fontweight="bold" if bold else "normal")
    width = drawn.get_window_extent(figure.canvas.get_renderer()).width
    # letters end before their advance; how far they are rounded to pixels depends on their size
    assert 0.98 * width <= text_width(text, 30, bold=bold) * 100 / 72 <= 1.07 * width + 6


@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (3, 1), (2, 2)])
def test_charts_with_long_numbers_labels_and_legends(figure, rows, columns):
    charts = figure.subplots(rows, columns, squeeze=False).ravel()
    for number, axes in enumerate(charts):
        axes.plot([0, 1], [1e5 * (number + 1), 1e5 * (number + 1) + 12345], label=f"a curve of chart {number}")
        axes.set(xlabel="time [s]", ylabel="some quantity [kN/m]", title="Title of the chart")
        legend_beside(axes)
    arrange(figure)
    check_inside(figure, charts)
    check_apart(figure, charts)


def test_labels_in_a_column_are_in_line(figure):
    upper, lower = figure.subplots(2, 1, sharex=True)
    upper.plot([0, 1], [0, 1e6])
    lower.plot([0, 1], [0, 1])
    for axes in (upper, lower):
        axes.yaxis.set_major_formatter("{x:g}")
        axes.set_ylabel("quantity")
    arrange(figure)
    figure.canvas.draw()
    one, other = (axes.yaxis.label.get_window_extent() for axes in (upper, lower))
    assert one.x0 == pytest.approx(other.x0)


def test_a_second_scale_at_the_right(figure):
    axes = figure.subplots()
    axes.plot([0, 1], [0, 1])
    right = axes.twinx()
    right.plot([0, 1], [0, 123456])
    right.set_ylabel("the other quantity")
    arrange(figure)
    check_inside(figure, [axes, right])


def test_a_scale_of_colours_is_as_high_as_all_charts_and_beside_their_legends(figure):
    upper, lower = figure.subplots(2, 1)
    for axes in (upper, lower):
        axes.plot([0, 1], [0, 1], label="a curve with a long name")
        legend_beside(axes)
    bar = bar_beside([upper, lower], mpl.cm.ScalarMappable(mpl.colors.Normalize(0, 1e6)))
    bar.set_label("what the colours mean")
    arrange(figure)
    check_inside(figure, [upper, lower, bar.ax])
    check_apart(figure, [upper, lower, bar.ax])
    places = [axes.get_position() for axes in (upper, lower, bar.ax)]
    assert places[2].y0 == pytest.approx(places[1].y0)
    assert places[2].y1 == pytest.approx(places[0].y1)


def test_a_heading_over_the_charts(figure):
    axes = figure.subplots()
    axes.set_axis_off()
    axes.set_title("two lines\nabove the chart")
    heading = figure.suptitle("A heading", x=0.015, ha="left")
    arrange(figure)
    figure.canvas.draw()
    assert axes.title.get_window_extent().y1 <= heading.get_window_extent().y0


def test_axes_keep_a_part_of_the_picture_beside_very_long_names(figure):
    axes = figure.subplots()
    axes.plot(np.arange(3.0), label="a very long name " * 20)
    legend_beside(axes)
    arrange(figure)
    assert axes.get_position().width > 0.25
