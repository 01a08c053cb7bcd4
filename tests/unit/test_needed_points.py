"""Which points of the wires a picture keeps: curves, colours and steps look as with all of them."""

import numpy as np
import pytest

from litz.pictures.needed_points import needed_points


def kept(points, value=None, radius=None, starts=None, limits=(0.0, 1.0)):
    n = len(points)
    rows, first = needed_points(
        points,
        np.array([0, n]) if starts is None else starts,
        np.ones(n) if radius is None else radius,
        np.zeros(n) if value is None else value,
        limits,
    )
    return rows.tolist(), first.tolist()


def straight(n):
    return np.stack([np.arange(n, dtype=float), np.zeros(n), np.zeros(n)], axis=1)


def test_a_straight_line_of_one_colour_needs_its_ends():
    assert kept(straight(100)) == ([0, 99], [0, 2])


def test_lines_keep_their_own_ends():
    assert kept(straight(100), starts=np.array([0, 40, 100])) == ([0, 39, 40, 99], [0, 2, 4])


def test_between_points_a_curve_turns_by_no_more_than_three_degrees():
    turn = np.linspace(0, np.pi, 721)
    rows, _ = kept(np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1))
    assert np.degrees(np.diff(turn[rows])).max() == pytest.approx(3.0, abs=0.26)


def test_a_kink_keeps_its_point_and_needs_no_others():
    points = straight(100)
    points[50:] = [49.0, 0, 0] + (points[50:] - [49.0, 0, 0])[:, [1, 0, 2]]
    assert kept(points)[0] == [0, 49, 99]


def test_colours_change_by_no_more_than_a_32nd_of_their_range():
    value = np.linspace(0, 1, 1001)
    rows, _ = kept(straight(1001), value)
    assert np.diff(value[rows]).max() <= 1 / 32 + 1e-12
    assert len(rows) < 40


def test_a_step_of_the_value_is_as_long_as_it_was():
    value = np.where(np.arange(100) < 50, 0.2, 0.21)
    assert kept(straight(100), value)[0] == [0, 49, 50, 99]


def test_a_step_to_no_value_is_as_long_as_it_was():
    value = np.where(np.arange(100) < 50, 0.2, np.nan)
    assert kept(straight(100), value)[0] == [0, 49, 50, 99]


def test_a_step_of_the_radius_is_as_long_as_it_was():
    assert kept(straight(100), radius=np.where(np.arange(100) < 50, 1.0, 2.0))[0] == [0, 49, 50, 99]
