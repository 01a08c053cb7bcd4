"""Closest points of bent wires whose tangents are parallel there: gap, normal and both variations, against numpy.

Nodes are moved by 0.3 % of the distance of the axes: the truncation of the differences is of sixth order, below 1e-9, and
their round-off about 1e-13.
"""

import numpy as np
import pytest

from derivatives import derivative, turned
from line_pair import hermite
from litz import _core

RADIUS, LENGTH, HERMITE, SPIN = np.array([0.1, 0.09]), np.array([1.0, 1.2]), 2, 0
STEP = 6e-4
#: Angles by which the tangents at the ends of the barred and of the unbarred wire lean out of the chord, in their plane
BOWS = {
    "a bow on a straight wire": (0.15, 0.0),
    "two bows": (0.12, -0.2),
    "a bow in a wider one": (0.3, 0.1),
}


def bows(barred, unbarred, shift=0.07, lift=1.0):
    """Two wires along x in one plane, the barred one above: nearest where both are parallel to x."""
    places = [(-0.5, 0.19), (0.5, 0.19), (shift - 0.6, 0.0), (shift + 0.6, 0.0)]
    x = np.array([(s, 0.0, lift * z) for s, z in places])
    t = np.array([(np.cos(a), 0.0, np.sin(a)) for a in (-barred, barred, -unbarred, unbarred)])
    # both wires are nearest at x = 0, off the middle of the unbarred one
    return x, t


def axis(x, t, beam, xi):
    """Place of an axis and its derivatives by xi."""
    nodes = [2 * beam, 2 * beam + 1]
    at = np.array([x[nodes[0]], t[nodes[0]], x[nodes[1]], t[nodes[1]]])
    return [shape @ at for shape in hermite(LENGTH[beam], xi, "hermite")]


def nearest(x, t):
    """Places (barred, unbarred) of the least distance, by Newton's method."""
    xi = np.zeros(2)
    for _ in range(50):
        (xb, xb1, xb2), (y, y1, y2) = (axis(x, t, beam, xi[beam]) for beam in (0, 1))
        w = xb - y
        matrix = np.array([[xb1 @ xb1 + w @ xb2, -xb1 @ y1], [-xb1 @ y1, y1 @ y1 - w @ y2]])
        step = np.linalg.solve(matrix, [w @ xb1, -w @ y1])
        xi -= step
        if np.abs(step).max() < 1e-14:
            break
    return xi


def kinematics(x, t, side=0):
    xi = nearest(x, t)
    return xi, _core.f2py_contact.contact_kinematics(x.T, t.T, LENGTH, HERMITE, RADIUS, *xi, side)


def moved(x, t, dq):
    q = dq.reshape(4, 6)
    return x + q[:, :3], turned(t, q[:, 3:])


@pytest.fixture(params=BOWS, ids=str)
def wires(request):
    return bows(*BOWS[request.param])


def test_the_normal_is_that_of_the_line_between_the_points(wires):
    x, t = wires
    xi, (values, normal, _, info) = kinematics(x, t)
    w = axis(x, t, 0, xi[0])[0] - axis(x, t, 1, xi[1])[0]
    assert info == 0
    assert values[2] < 1e-3
    assert normal == pytest.approx(w / np.linalg.norm(w), abs=1e-14)
    assert values[:2] == pytest.approx([np.linalg.norm(w), np.linalg.norm(w) - RADIUS.sum()], abs=1e-14)


def test_the_first_variations_are_those_of_gap_and_places(wires):
    x, t = wires
    _, (_, _, rows, _) = kinematics(x, t)

    def gap_and_places(dq):
        there = moved(x, t, dq)
        xi = nearest(*there)
        return np.array([np.linalg.norm(axis(*there, 0, xi[0])[0] - axis(*there, 1, xi[1])[0]), *xi])

    numeric = derivative(gap_and_places, np.zeros(24), STEP)
    for row, expected in zip(rows.T, numeric, strict=False):
        assert row == pytest.approx(expected, abs=1e-8 * np.abs(expected).max())


def test_the_second_variation_is_the_derivative_of_the_first(wires):
    x, t = wires
    force = 0.7
    xi, _ = kinematics(x, t)

    def mechanics(x, t, xi, side):
        k, r, info = _core.f2py_contact.contact_mechanics(
            x.T, t.T, LENGTH, HERMITE, RADIUS, *xi, side, force, 0.0, force, SPIN, 0.0
        )
        assert info == 0
        return k, r

    k, r = mechanics(x, t, xi, 0)

    def residual(dq):
        """-F dg in numpy, with the moments of spins: dw/dtheta = s t x n."""
        there = moved(x, t, dq)
        places = nearest(*there)
        w = axis(*there, 0, places[0])[0] - axis(*there, 1, places[1])[0]
        n = w / np.linalg.norm(w)
        result = np.zeros((4, 6))
        for node in range(4):
            beam, end = divmod(node, 2)
            shape = hermite(LENGTH[beam], places[beam], "hermite")[0][2 * end : 2 * end + 2] * (1 - 2 * beam)
            result[node] = -force * np.concatenate([shape[0] * n, shape[1] * np.cross(there[1][node], n)])
        return result.ravel()

    assert r == pytest.approx(residual(np.zeros(24)), abs=1e-13)
    numeric = derivative(residual, np.zeros(24), STEP)
    assert np.abs(k - numeric).max() < 1e-7 * np.abs(numeric).max()


def test_axes_that_lie_on_each_other_have_no_normal():
    x, t = bows(0.15, 0.0, lift=0.01)
    x[:2, 2] += 0.036
    # the bow is lowest in its middle, by L tan(a)/4: both axes meet there
    _, (_, _, _, info) = kinematics(x, t)
    assert info == -1


def test_straight_parallel_wires_have_no_closest_points():
    x, t = bows(0.0, 0.0)
    *_, info = _core.f2py_contact.contact_kinematics(x.T, t.T, LENGTH, HERMITE, RADIUS, 0.0, 0.0, 0)
    assert info == -2
