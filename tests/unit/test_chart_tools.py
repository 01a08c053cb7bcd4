"""What charts share: equal curves drawn as one, round-off, legends beside the data."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from litz.pictures.chart_tools import equal_curves, has_force, legend_beside, name_of_group


def test_curves_that_differ_by_what_an_iteration_leaves_are_one():
    curve = np.array([0.0, 1.0, 2.0])
    assert equal_curves([curve, curve * (1 + 1e-8), curve + 1e-4, curve[:2], -curve]) == [[0, 1], [2], [3], [4]]


def test_small_curves_are_compared_on_the_scale_of_the_largest():
    assert equal_curves([np.array([1e3]), np.array([1e-20]), np.array([-1e-19])]) == [[0], [1, 2]]


def test_gaps_of_curves_are_compared_too():
    gap = np.array([np.nan, 1.0])
    assert equal_curves([gap, gap, np.array([0.0, 1.0]), np.array([np.inf, 1.0])]) == [[0, 1], [2], [3]]


@pytest.mark.parametrize(
    ("n", "text"),
    [(1, "contact 1"), (3, "3 equal contacts: 1, 2, 3"), (8, "8 equal contacts: 1, 2, ... 8")],
)
def test_a_legend_says_how_many_curves_are_one(n, text):
    assert name_of_group([f"contact {k}" for k in range(1, n + 1)], "contact") == text


def test_forces_are_round_off_compared_with_the_largest():
    assert has_force(np.array([2.0, 1e-20, 1e-8, 0.0])).tolist() == [True, False, True, False]
    assert has_force(np.zeros(0)).tolist() == []


def test_a_legend_is_beside_the_axes():
    figure = Figure()
    axes = figure.add_axes((0.1, 0.1, 0.5, 0.8))
    axes.plot([0, 1], [1, 0], label="force")
    legend = legend_beside(axes)
    figure.draw_without_rendering()
    assert legend.get_window_extent().x0 >= axes.get_window_extent().x1
