"""The graph of the contact network: which lines it has, how thick, and where the dots are."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from litz.pictures import network_chart
from litz.pictures.chart_tools import wire_names
from litz.pictures.network_chart import _repulsion, between_wires, layout, turned


def test_currents_of_the_contacts_of_two_wires_add_up_with_their_direction():
    graph = SimpleNamespace(
        id=np.arange(1, 5),
        wires=np.array([[0, 1], [1, 0], [1, 2], [0, 1]]),
        current=np.array([5.0, 2.0, -4.0, 1.0]),
        force=np.array([1.0, 2.0, 3.0, 4.0]),
    )
    pairs, current = between_wires(graph, "current")
    np.testing.assert_array_equal(pairs, [[0, 1], [1, 2]])
    np.testing.assert_allclose(current, [5 - 2 + 1, 4])
    np.testing.assert_allclose(between_wires(graph, "force")[1], [7, 3])


def test_a_line_for_each_pair_of_wires_and_a_dot_for_each_wire(results):
    figure = Figure()
    network_chart.network(figure, results, 1)
    axes = figure.axes[0]
    (lines,) = [one for one in axes.collections if isinstance(one, LineCollection)]
    (dots,) = [one for one in axes.collections if not isinstance(one, LineCollection)]
    graph = results.contact_network(1)
    assert len(lines.get_segments()) == len(np.unique(np.sort(graph.wires, axis=1), axis=0))
    assert len(dots.get_offsets()) == len(graph.wire_length)


def test_parts_that_no_line_joins_stay_together_and_apart():
    """Twelve chains of five wires, as clusters of a film below its threshold."""
    pairs = np.array([(5 * chain + k, 5 * chain + k + 1) for chain in range(12) for k in range(4)])
    places = layout(60, pairs)
    distance = np.linalg.norm(places[:, None] - places, axis=2) + 9 * np.eye(60)
    # of the width of the picture; they would have drifted apart until dots of a chain were one
    assert distance.min() > 0.04 * np.ptp(places, axis=0).max()


def test_without_contacts_the_wires_are_still_there(results):
    figure = Figure()
    network_chart.network(figure, results, 0)
    assert "2 wires, 0 contacts" in figure.get_suptitle()


def test_the_same_network_has_the_same_picture_and_no_two_dots_in_one_place():
    pairs = np.array([[i, 20 + j] for i in range(20) for j in range(0, 20, 3)])
    places = layout(40, pairs)
    np.testing.assert_array_equal(places, layout(40, pairs))
    apart = np.linalg.norm(places[:, None] - places[None], axis=2)[~np.eye(40, dtype=bool)]
    assert apart.min() > 0.02


def test_wires_that_touch_are_nearer_than_those_that_do_not():
    ring = np.array([[i, (i + 1) % 12] for i in range(12)])
    places = layout(12, ring)
    apart = np.linalg.norm(places[:, None] - places[None], axis=2)
    assert apart[ring[:, 0], ring[:, 1]].max() < apart[np.arange(6), np.arange(6) + 6].min()


def test_the_high_potential_is_on_the_left():
    rng = np.random.default_rng(1)
    places = rng.normal(size=(30, 2)) * [1, 4]
    potential = places[:, 1]
    flat = turned(places, potential)
    assert np.corrcoef(flat[:, 0], potential)[0, 1] < -0.99


def test_a_single_wire_is_a_dot_in_the_middle():
    """One wire without contacts, as of a cantilever."""
    places = layout(1, np.zeros((0, 2), dtype=int))
    assert turned(places, np.zeros(1)).shape == (1, 2)


def test_wires_have_the_name_of_their_own_element_set_or_a_number():
    wires = [SimpleNamespace(elements=np.array(rows)) for rows in ([0, 1], [3, 2], [4])]
    sets = {"ALL": np.arange(5), "LEFT": np.array([1, 0]), "AGAIN": np.array([0, 1]), "PART": np.array([2])}
    assert wire_names(SimpleNamespace(element_sets=sets), wires) == ["LEFT", "2", "3"]


def test_contacts_whose_force_is_round_off_are_not_in_the_network(results):
    graph = results.contact_network(1)
    force = graph.force.max() * np.where(np.arange(len(graph.id)) == 0, 1e-20, 1.0)
    pressed = network_chart.pressed_contacts(replace(graph, force=force))
    np.testing.assert_array_equal(pressed.id, graph.id[1:])
    assert len(pressed.wires) == len(pressed.current) == len(graph.id) - 1
    assert network_chart.pressed_contacts(graph) is graph


def test_dots_push_each_other_apart_by_the_inverse_distance():
    """More dots than are taken at once, against the sum over all pairs; dots nearer than 1e-3 push as if they were that far."""
    places = np.random.default_rng(1).uniform(-1, 1, (620, 2))
    places[-1] = places[0] + 1e-5
    apart = places[:, None] - places
    expected = np.sum(apart / np.maximum(np.sum(apart**2, axis=2), 1e-6)[:, :, None], axis=1)
    # the place times the sum of weights up to 1e6 cancels
    np.testing.assert_allclose(_repulsion(places), expected, rtol=1e-9, atol=1e-8)


def test_dots_are_off_the_lines_of_others():
    """A dot on the line of two others would seem to be joined to them: here four dots in a row, and one on a line exactly."""
    places = np.array([[-1.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.5, 0.01], [0.5, 1.0]])
    pairs = np.array([[0, 1], [2, 4], [3, 4]])
    moved = network_chart._off_lines(places, pairs)
    for dot in range(5):
        for first, last in pairs.tolist():
            if dot not in (first, last):
                along = moved[last] - moved[first]
                part = np.clip((moved[dot] - moved[first]) @ along / (along @ along), 0, 1)
                assert np.linalg.norm(moved[dot] - moved[first] - part * along) > 0.05
    # and those that are off stay
    np.testing.assert_allclose(network_chart._off_lines(places[[0, 1, 4]], pairs[:1]), places[[0, 1, 4]])
