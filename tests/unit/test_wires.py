"""The wires behind the elements, and their smooth axes."""

import numpy as np
import pytest

from litz.wires.chains import find_wires
from litz.wires.curves import element_curves, end_tangents, hermite, rotate


def as_lists(wire):
    return list(wire.nodes), list(wire.elements), list(wire.signs)


class TestFindWires:
    def test_a_chain_in_any_order_and_direction_of_its_elements(self):
        wires = find_wires(np.array([[2, 1], [0, 1], [2, 3]]))
        assert [as_lists(wire) for wire in wires] == [([3, 2, 1, 0], [2, 0, 1], [-1, 1, -1])]

    def test_a_branch_ends_wires(self):
        wires = find_wires(np.array([[0, 1], [1, 2], [1, 3], [3, 4]]))
        assert [as_lists(wire) for wire in wires] == [
            ([0, 1], [0], [1]),
            ([1, 2], [1], [1]),
            ([1, 3, 4], [2, 3], [1, 1]),
        ]

    def test_a_ring_is_closed(self):
        assert [as_lists(wire) for wire in find_wires(np.array([[0, 1], [1, 2], [2, 0]]))] == [
            ([0, 1, 2, 0], [0, 1, 2], [1, 1, 1])
        ]

    def test_two_elements_between_the_same_nodes(self):
        assert [as_lists(wire) for wire in find_wires(np.array([[0, 1], [1, 0]]))] == [([0, 1, 0], [0, 1], [1, 1])]

    def test_every_element_is_in_one_wire(self):
        elements = np.random.default_rng(1).permuted(np.stack([np.arange(30), np.arange(1, 31)], axis=1), axis=1)
        elements = elements[elements[:, 0] % 7 != 0]
        found = np.concatenate([wire.elements for wire in find_wires(elements)])
        np.testing.assert_array_equal(np.sort(found), np.arange(len(elements)))


class TestAxes:
    def arc(self, n):
        angle = np.linspace(0, np.pi / 2, n + 1)
        nodes = np.stack([np.sin(angle), 1 - np.cos(angle), np.zeros(n + 1)], axis=1)
        tangents = np.stack([np.cos(angle), np.sin(angle), np.zeros(n + 1)], axis=1)
        return nodes, tangents, np.stack([np.arange(n), np.arange(1, n + 1)], axis=1)

    def test_tangents_of_a_circle_are_exact_also_at_its_free_ends(self):
        nodes, tangents, elements = self.arc(6)
        found = end_tangents(nodes, find_wires(elements))
        np.testing.assert_allclose(found[:, 0], tangents[:-1], atol=1e-14)
        np.testing.assert_allclose(found[:, 1], tangents[1:], atol=1e-14)

    def test_tangents_of_a_circle_are_exact_with_elements_of_unequal_lengths(self):
        angle = np.array([0.0, 0.02, 0.12, 0.15, 0.35])
        nodes = np.stack([np.sin(angle), 1 - np.cos(angle), np.zeros(5)], axis=1)
        found = end_tangents(nodes, find_wires(np.stack([np.arange(4), np.arange(1, 5)], axis=1)))
        # a chord is turned from the tangent by half its angle: to first order the mean of two chords, each with the
        # length of the other, is the tangent
        middle = np.arctan2(found[1:, 0, 1], found[1:, 0, 0])
        np.testing.assert_allclose(middle, angle[1:-1], atol=2e-5)

    def test_a_sharp_corner_stays_sharp(self):
        nodes = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0]])
        found = end_tangents(nodes, find_wires(np.array([[0, 1], [1, 2]])))
        np.testing.assert_allclose(found[0, 1], [1, 0, 0])
        np.testing.assert_allclose(found[1, 0], [0, 1, 0])

    @pytest.mark.parametrize("reverse", [False, True])
    def test_the_curve_follows_the_circle_whichever_way_the_elements_point(self, reverse):
        nodes, _, elements = self.arc(6)
        elements[1::2] = elements[1::2, ::-1] if reverse else elements[1::2]
        still = np.zeros_like(nodes)
        curves = element_curves(nodes, still, still, find_wires(elements), len(elements))
        middle = hermite(*curves, np.zeros(len(elements)))
        # a chord would miss it by 1 - cos(7.5 degrees) = 8.6e-3
        np.testing.assert_allclose(np.linalg.norm(middle - [0, 1, 0], axis=1), 1, atol=1e-3)
        np.testing.assert_allclose(hermite(*curves, -np.ones(len(elements))), nodes[elements[:, 0]], atol=1e-15)

    def test_tangents_turn_with_the_nodes(self):
        nodes = np.array([[0.0, 0, 0], [2, 0, 0]])
        quarter = np.array([[0.0, 0, np.pi / 2]] * 2)
        _, slopes = element_curves(nodes, np.zeros((2, 3)), quarter, find_wires(np.array([[0, 1]])), 1)
        np.testing.assert_allclose(slopes[0], [[0, 1, 0], [0, 1, 0]], atol=1e-15)

    def test_rotations_of_any_size(self):
        turned = rotate(np.eye(3), np.array([[0.0, 0, 0], [0, 0, np.pi], [2 * np.pi, 0, 0]]))
        np.testing.assert_allclose(turned, [[1, 0, 0], [0, -1, 0], [0, 0, 1]], atol=1e-15)
