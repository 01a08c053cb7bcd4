"""Closest points of two axes: against brute force, and every status."""

import numpy as np
import pytest

from derivatives import rotation
from litz.kernels import closest_points

ROUNDINGS = 100 * np.finfo(float).eps
STRAIGHT_LENGTH = np.array([2.0, 2.0])


def point_on_axis(x, t, length, axis, xi):
    """Point, first and second derivative of one element's axis, written out from theory section 3."""
    xi = np.asarray(xi)[..., None]
    s = length / 2
    if axis == "linear":
        return (1 - xi) / 2 * x[0] + (1 + xi) / 2 * x[1], (x[1] - x[0]) / 2 + 0 * xi, 0 * xi * x[0]
    h = [(2 - 3 * xi + xi**3) / 4, (2 + 3 * xi - xi**3) / 4]
    g = [s * (1 - xi - xi**2 + xi**3) / 4, s * (-1 - xi + xi**2 + xi**3) / 4]
    h1 = [(-3 + 3 * xi**2) / 4, (3 - 3 * xi**2) / 4]
    g1 = [s * (-1 - 2 * xi + 3 * xi**2) / 4, s * (-1 + 2 * xi + 3 * xi**2) / 4]
    h2 = [1.5 * xi, -1.5 * xi]
    g2 = [s * (-1 + 3 * xi) / 2, s * (1 + 3 * xi) / 2]
    return tuple(a[0] * x[0] + a[1] * x[1] + b[0] * t[0] + b[1] * t[1] for a, b in ((h, g), (h1, g1), (h2, g2)))


class Pair:
    """Two elements with random curvature, `bend` [rad] at most at each node, that cross somewhere near."""

    def __init__(self, seed, axis="hermite", bend=0.3, shift=1.0, apart=0.3):
        rng = np.random.default_rng(seed)
        self.axis = axis
        self.length = rng.uniform(0.5, 2.0, 2)
        angle = rng.uniform(0.2, np.pi - 0.2)
        directions = [np.array([1.0, 0, 0]), np.array([np.cos(angle), np.sin(angle), 0])]
        self.x, self.t = np.empty((4, 3)), np.empty((4, 3))
        for beam in (0, 1):
            middle = rng.uniform(-shift, shift)
            height = rng.uniform(-apart, apart)
            for end in (0, 1):
                node = 2 * beam + end
                self.x[node] = directions[beam] * self.length[beam] / 2 * (2 * end - 1 - middle)
                self.x[node, 2] += height
                self.t[node] = rotation(rng.uniform(-bend, bend, 3)) @ directions[beam]
        turn, origin = rotation(rng.normal(size=3)), rng.normal(size=3)
        self.x, self.t = self.x @ turn.T + origin, self.t @ turn.T

    def find(self, start=None):
        return closest_points(self.x, self.t, self.length, axis=self.axis, start=start)

    def bar(self, xi):
        return point_on_axis(self.x[:2], self.t[:2], self.length[0], self.axis, xi)

    def unbarred(self, xi):
        return point_on_axis(self.x[2:], self.t[2:], self.length[1], self.axis, xi)

    def distance(self, xi_bar, xi):
        return np.linalg.norm(self.bar(xi_bar)[0] - self.unbarred(xi)[0], axis=-1)

    def newton(self, xi_bar, xi):
        """Correction by one exact Newton step on the two conditions, and the lowest eigenvalue of its matrix."""
        (xb, xb1, xb2), (x, x1, x2) = self.bar(xi_bar), self.unbarred(xi)
        w = xb - x
        matrix = np.array([[xb1 @ xb1 + w @ xb2, -xb1 @ x1], [-xb1 @ x1, x1 @ x1 - w @ x2]])
        return -np.linalg.solve(matrix, [w @ xb1, -w @ x1]), np.linalg.eigvalsh(matrix)[0]

    def is_minimum(self, found):
        """Stationary to round-off, and a minimum."""
        correction, lowest = self.newton(found.xi_bar, found.xi)
        return np.abs(correction).max() < ROUNDINGS and lowest > 0

    def minima_by_brute_force(self, n=101):
        """Distances at all minima inside that a fine grid shows and Newton's method confirms."""
        s = np.linspace(-1, 1, n)
        d = np.linalg.norm(self.bar(s)[0][:, None, :] - self.unbarred(s)[0][None, :, :], axis=-1)
        inner = d[1:-1, 1:-1]
        offsets = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
        lower = np.all([inner < d[1 + i : n - 1 + i, 1 + j : n - 1 + j] for i, j in offsets], axis=0)
        distances = []
        for start in zip(*(s[1:-1][k] for k in np.nonzero(lower)), strict=True):
            xi = np.array(start)
            for _ in range(30):
                correction, lowest = self.newton(*xi)
                xi = xi + correction
                if np.abs(xi).max() > 1:
                    break
            if np.abs(xi).max() <= 1 and np.abs(correction).max() < 1e-9 and lowest > 0:
                distances.append(self.distance(*xi))
        return distances


@pytest.mark.slow
@pytest.mark.parametrize("axis", ["linear", "hermite"])
@pytest.mark.parametrize("bend", [0.05, 0.5, 1.2])
def test_against_brute_force(axis, bend):
    counts = dict.fromkeys(("inside", "beyond"), 0)
    for seed in range(120):
        pair = Pair(seed, axis, bend, shift=1.4)
        found = pair.find()
        counts[found.status] += 1
        minima = pair.minima_by_brute_force()
        if found.status == "inside":
            assert pair.is_minimum(found), seed
            assert max(abs(found.xi_bar), abs(found.xi)) <= 1, seed
            assert all(pair.distance(found.xi_bar, found.xi) <= d + ROUNDINGS for d in minima), seed
        else:
            assert not minima, seed
            assert max(abs(found.xi_bar), abs(found.xi)) > 1, seed
    assert min(counts.values()) >= 20, counts


@pytest.mark.parametrize("seed", range(30))
def test_beyond_gives_the_closest_points_of_the_continued_axes(seed):
    # a crossing at a known place, up to 1.5 from the middle
    rng = np.random.default_rng(seed)
    place = np.array([rng.uniform(1.01, 1.45), rng.uniform(-1.45, 1.45)]) * rng.choice([-1, 1], 2)
    x = np.array([[-1, 0, 0.1], [1, 0, 0.1], [0, -1, 0], [0, 1, 0]], dtype=float)
    x[:2, 0] -= place[0]
    x[2:, 1] -= place[1]
    t = np.array([[1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]], dtype=float)
    for axis in ("linear", "hermite"):
        found = closest_points(x, t, STRAIGHT_LENGTH, axis=axis)
        assert found.status == "beyond"
        assert (found.xi_bar, found.xi) == pytest.approx(place, abs=1e-14)


def test_search_beyond_an_end_stops_at_the_limit():
    x = np.array([[5, 0, 0.1], [7, 0, 0.1], [0, -1, 0], [0, 1, 0]], dtype=float)
    found = closest_points(x, np.eye(3)[[0, 0, 1, 1]], STRAIGHT_LENGTH)
    assert found == (-1.5, 0.0, "beyond")


@pytest.mark.parametrize("axis", ["linear", "hermite"])
@pytest.mark.parametrize("overshoot", [-1e-11, 0.0, 1e-11])
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_crossing_at_a_node_is_inside_in_spite_of_round_off(axis, overshoot, sign):
    x = np.array([[-1, 0, 0.1], [1, 0, 0.1], [0, -1, 0], [0, 1, 0]], dtype=float)
    x[:2, 0] -= sign * (1 + overshoot)
    found = closest_points(x, np.eye(3)[[0, 0, 1, 1]], STRAIGHT_LENGTH, axis=axis)
    assert found.status == "inside"
    assert found.xi_bar == pytest.approx(sign * (1 + overshoot), abs=1e-15)


@pytest.mark.parametrize("axis", ["linear", "hermite"])
@pytest.mark.parametrize("seed", range(10))
def test_axes_that_meet(axis, seed):
    pair = Pair(seed, axis, bend=0.1, shift=0.5)
    first = pair.find()
    w = pair.bar(first.xi_bar)[0] - pair.unbarred(first.xi)[0]
    pair.x[2:] += w
    found = pair.find()
    assert found.status == "inside"
    assert pair.distance(found.xi_bar, found.xi) < 1e-14


@pytest.mark.parametrize("axis", ["linear", "hermite"])
@pytest.mark.parametrize("degrees", [90, 10, 5, 1, 0.1])
def test_small_crossing_angles(axis, degrees):
    # both points in the middle; the condition of the problem is 1/sin^2
    angle = degrees * np.pi / 180
    directions = np.array([[1, 0, 0], [np.cos(angle), np.sin(angle), 0]])
    x = np.array([-directions[0], directions[0], -directions[1], directions[1]])
    x[:2] += 0.2 * directions[0] + [0, 0, 0.1]
    x[2:] -= 0.3 * directions[1]
    found = closest_points(x, directions[[0, 0, 1, 1]], STRAIGHT_LENGTH, axis=axis)
    assert found.status == "inside"
    assert (found.xi_bar, found.xi) == pytest.approx((-0.2, 0.3), abs=1e-15 / np.sin(angle) ** 2)


@pytest.mark.parametrize("axis", ["linear", "hermite"])
@pytest.mark.parametrize("angle", [0.0, 1e-9, 5e-4, np.pi])
@pytest.mark.parametrize(
    ("shift", "apart", "least"),
    [(0.5, 0.1, 0.1), (0.0, 0.0, 0.0), (3.0, 0.0, 0.0)],
    ids=["side by side", "coincident", "one behind the other"],
)
def test_parallel(axis, angle, shift, apart, least):
    direction = np.array([np.cos(angle), np.sin(angle), 0])
    x = np.array([[-1, 0, apart], [1, 0, apart], -direction, direction], dtype=float)
    x[2:, 0] += shift
    t = np.array([[1, 0, 0], [1, 0, 0], direction, direction])
    found = closest_points(x, t, STRAIGHT_LENGTH, axis=axis)
    assert found.status == "parallel"
    bar = point_on_axis(x[:2], t[:2], 2.0, axis, found.xi_bar)[0]
    unbarred = point_on_axis(x[2:], t[2:], 2.0, axis, found.xi)[0]
    assert np.linalg.norm(bar - unbarred) == pytest.approx(least, abs=1e-3)


def parabola_and_upright(height, aside=0.0):
    """Barred element: the parabola y = x^2, x = xi, which Hermite axes hold exactly; the other stands along z.

    Seen from (0, h) the squared distance is xi^4 - (2 h - 1) xi^2 + h^2: one minimum in the middle below the centre of
    curvature, h < 1/2; above it a saddle there and two minima at xi = +-sqrt(h - 1/2).
    """
    slopes = np.array([[1, -2, 0], [1, 2, 0]]) / np.sqrt(5)
    x = np.array([[-1, 1, 0], [1, 1, 0], [aside, height, -0.5], [aside, height, 0.5]])
    return x, np.vstack([slopes, [[0, 0, 1], [0, 0, 1]]]), [2 * np.sqrt(5), 1.0]


def test_two_pairs_of_points_at_the_same_distance_are_not_unique():
    found = closest_points(*parabola_and_upright(0.75))
    assert found.status == "not_unique"
    assert abs(found.xi_bar) == pytest.approx(0.5, abs=1e-14)


def test_the_centre_of_curvature_is_not_unique():
    assert closest_points(*parabola_and_upright(0.5)).status == "not_unique"


@pytest.mark.parametrize("height", [0.0, 0.3, 0.49])
def test_below_the_centre_of_curvature_the_middle_is_unique(height):
    found = closest_points(*parabola_and_upright(height))
    assert found.status == "inside"
    assert found.xi_bar == pytest.approx(0, abs=1e-14)


@pytest.mark.parametrize("height", [0.501, 0.6, 0.75, 1.4])
def test_start_on_a_saddle_ends_in_a_minimum(height):
    found = closest_points(*parabola_and_upright(height), start=[0.0, 0.0])
    assert found.status == "inside"
    assert abs(found.xi_bar) == pytest.approx(np.sqrt(height - 0.5), abs=1e-12)


def test_start_chooses_the_minimum_next_to_it():
    pair = parabola_and_upright(0.75, aside=0.02)
    left, right = (closest_points(*pair, start=[s, 0.0]) for s in (-0.4, 0.4))
    assert left.status == right.status == "inside"
    assert left.xi_bar < -0.4 < 0.4 < right.xi_bar
    # without a start it is the closer one, on the side of the upright wire
    assert closest_points(*pair) == pytest.approx(right, abs=1e-14)


@pytest.mark.parametrize("seed", range(20))
def test_start_is_found_again(seed):
    pair = Pair(seed, bend=0.1, shift=0.7)
    found = pair.find()
    assert found.status == "inside"
    again = pair.find(start=[found.xi_bar + 0.05, found.xi - 0.05])
    assert again[:2] == pytest.approx(found[:2], abs=1e-13)


def test_not_converged_where_an_axis_has_no_tangent():
    x = np.array([[0, 0, 0], [0, 0, 0], [0, -1, 0.1], [0, 1, 0.1]], dtype=float)
    assert closest_points(x, np.eye(3)[[0, 0, 1, 1]], STRAIGHT_LENGTH, axis="linear").status == "not_converged"


@pytest.mark.parametrize("seed", range(20))
def test_far_from_the_origin(seed):
    # offsets that are representable: the positions keep 2^-33 of the offset
    pair = Pair(seed, bend=0.1, shift=0.7)
    pair.x = np.round(pair.x * 2**20) / 2**20
    near = pair.find()
    pair.x += 2.0**20
    assert pair.find() == near


@pytest.mark.parametrize("seed", range(20))
def test_swapping_the_beams_swaps_the_points(seed):
    pair = Pair(seed, bend=0.6)
    found = pair.find()
    order = [2, 3, 0, 1]
    swapped = closest_points(pair.x[order], pair.t[order], pair.length[::-1])
    assert swapped.status == found.status
    assert (swapped.xi, swapped.xi_bar) == pytest.approx(found[:2], abs=1e-12)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (dict(x=np.zeros((3, 4))), r"x must have shape \(4, 3\), not \(3, 4\)"),
        (dict(x=np.full((4, 3), np.nan)), "x must be finite"),
        (dict(t=np.zeros((4, 3))), r"t\[0\] must have unit length, not 0"),
        (dict(t=2 * np.eye(3)[[0, 0, 1, 1]]), r"t\[0\] must have unit length, not 2"),
        (dict(length=[1.0, 0.0]), "length must be greater than 0"),
        (dict(length=1.0), r"length must have shape \(2,\)"),
        (dict(axis="cubic"), 'axis must be one of "linear", "hermite"'),
        (dict(start=[0.0]), r"start must have shape \(2,\)"),
    ],
)
def test_bad_input_is_refused_in_words(change, words):
    x = np.array([[-1, 0, 0.1], [1, 0, 0.1], [0, -1, 0], [0, 1, 0]], dtype=float)
    with pytest.raises(ValueError, match=words):
        closest_points(**{"x": x, "t": np.eye(3)[[0, 0, 1, 1]], "length": STRAIGHT_LENGTH, **change})
