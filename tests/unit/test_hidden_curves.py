"""Curves that coincide to the width of a line are all seen."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from litz.pictures.chart_tools import legend_beside

X = np.linspace(0, 1, 50)
COLOURS = ("#ff0000", "#0000ff", "#00aa00", "#aa00aa")


def drawn(*curves, steps=False, log=False, **style):
    """The axes with curves and a legend, and how many pixels each colour has."""
    figure = Figure(figsize=(6, 3), dpi=100)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0.1, 0.1, 0.6, 0.8))
    for colour, (x, y) in zip(COLOURS, curves, strict=False):
        if steps:
            axes.stairs(y, x, baseline=None, color=colour, linewidth=1.6, label=colour)
        else:
            axes.plot(x, y, color=colour, linewidth=1.6, label=colour, **style)
    if log:
        axes.set_yscale("log")
    legend = legend_beside(axes)
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[:, 60:420, :3].astype(int)
    wanted = [[int(colour[k : k + 2], 16) for k in (1, 3, 5)] for colour in COLOURS[: len(curves)]]
    return axes, legend, [int((np.abs(pixels - one).sum(axis=2) < 120).sum()) for one in wanted]


def is_dashed(axes):
    return [artist.get_linestyle() != "-" for artist in axes.lines]


@pytest.mark.parametrize("n", [2, 3, 4])
def test_all_of_nearly_equal_curves_are_seen(n):
    axes, legend, seen = drawn(*((X, X**2 + 1e-3 * k) for k in range(n)))
    assert is_dashed(axes) == [False] + [True] * (n - 1)
    # the fourth has an eighth of its length, and a little less where its dashes end
    assert min(seen) > 0.05 * max(seen)
    # the legend has the same dashes
    assert [line.get_linestyle() for line in legend.get_lines()] == [line.get_linestyle() for line in axes.lines]


def test_curves_that_differ_by_more_than_their_width_stay_as_they_are():
    axes, _, seen = drawn((X, X), (X, X + 0.05), (X, 1 - X))
    assert is_dashed(axes) == [False] * 3
    assert min(seen) > 200


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_what_coincides_does_not_depend_on_the_scale_of_the_curves(scale):
    axes, _, _ = drawn((scale * X, scale * X), (scale * X, scale * (1 - X)), (scale * X, scale * (X + 1e-4)))
    assert is_dashed(axes) == [False, False, True]


def test_curves_that_part_are_not_hidden():
    """Equal up to a third of the way; and a short curve upon a long one is hidden."""
    axes, _, _ = drawn((X, X), (X, X + np.maximum(0, X - 0.3)))
    assert is_dashed(axes) == [False, False]
    axes, _, _ = drawn((X, X), (X[10:20], X[10:20]))
    assert is_dashed(axes) == [False, True]


def test_steep_curves_are_as_near_as_they_look():
    """Two steps a hundredth of the width apart: at equal places they differ by all of the height."""
    steep = [(X, np.tanh(60 * (X - 0.5 - shift))) for shift in (0, 0.002)]
    assert is_dashed(drawn(*steep)[0]) == [False, True]


def test_other_places_and_scales_are_compared_as_they_are_drawn():
    fine = np.linspace(0, 1, 333)
    assert is_dashed(drawn((X, X), (fine, fine))[0]) == [False, True]
    # on a logarithmic axis these are far apart
    small = [(X, np.full(50, 1e-6)), (X, np.full(50, 1e-3)), (X, np.full(50, 1.0))]
    assert is_dashed(drawn(*small, log=True)[0]) == [False, False, False]
    assert is_dashed(drawn(*small)[0]) == [False, True, False]


def test_steps_and_markers():
    edges = np.linspace(0, 1, 21)
    axes, _, seen = drawn((edges, np.sin(5 * edges[:-1])), (edges, np.sin(5 * edges[:-1]) + 1e-3), steps=True)
    assert [patch.get_linestyle() == "solid" or patch.get_linestyle() == "-" for patch in axes.patches] == [True, False]
    assert min(seen) > 0.2 * max(seen)
    axes, _, _ = drawn((X, X), (X, X), marker="o", markersize=4)
    assert axes.lines[1].get_markersize() < axes.lines[0].get_markersize()


def test_gaps_and_loops():
    """Values that are missing cover nothing; a curve that goes back has no place from left to right."""
    missing = np.where(X < 0.8, np.nan, X)
    assert is_dashed(drawn((X, missing), (X, X))[0]) == [False, False]
    loop = np.concatenate([X, X[::-1]])
    assert is_dashed(drawn((loop, loop), (loop, loop))[0]) == [False, False]
