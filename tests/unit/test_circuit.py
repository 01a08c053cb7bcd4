"""Circuits of resistances between points, against networks that are solved by hand."""

import sys

import numpy as np
import pytest

import litz
from litz.results.circuit import Circuit
from litz.results.interstrand import InterstrandResistance, _stages

UNITS = {"m": "m", "ohm": "ohm", "N": "N"}


def circuit(points, resistance, n=None, coupled=(), mutual=()):
    """Resistances between points that are counted from 0."""
    points = np.array(points, dtype=int).reshape(-1, 2)
    n = int(points.max()) + 1 if n is None else n
    m = len(points)
    return Circuit(
        node=np.arange(1, n + 1), wire=np.zeros(n, dtype=int), arc=np.zeros(n), position=np.zeros((n, 3)), points=points,
        resistance=np.array(resistance, dtype=float), contact=np.zeros(m, dtype=int), force=np.zeros(m), length=np.zeros(m),
        coupled=np.array(coupled, dtype=int).reshape(-1, 2), mutual=np.array(mutual, dtype=float), unit=UNITS,
    )  # fmt: skip


def between(one, first, second, joined=None):
    return one.solver(joined).resistances(np.array([first, second]))[0, 1]


def test_a_bridge_out_of_balance():
    """Wheatstone: 1 and 2 ohm above, 3 and 4 below, 5 across. By loop currents 7/12 A and 5/12 A ... in short 2.0862 ohm."""
    bridge = circuit([(0, 1), (1, 3), (0, 2), (2, 3), (1, 2)], [1, 2, 3, 4, 5])
    # star for the triangle 0-1-2 of 1, 3 and 5 ohm: 1*3/9, 1*5/9 and 3*5/9 from its corners
    left = 3 / 9 + 1 / (1 / (5 / 9 + 2) + 1 / (15 / 9 + 4))
    assert between(bridge, 0, 3) == pytest.approx(left, rel=1e-14)


def test_an_endless_ladder_has_the_golden_ratio():
    rungs = 40
    points = [(k, k + 1) for k in range(rungs)] + [(k, rungs + 1) for k in range(1, rungs + 1)]
    ladder = circuit(points, np.ones(2 * rungs))
    # each rung brings it nearer by a factor 0.38^2
    assert between(ladder, 0, rungs + 1) == pytest.approx((1 + 5**0.5) / 2, rel=1e-14)


def test_corners_of_a_cube_all_at_once():
    corners = [(a, b) for a in range(8) for b in range(a) if bin(a ^ b).count("1") == 1]
    found = circuit(corners, np.ones(12)).solver().resistances(np.arange(8))
    apart = np.array([[bin(a ^ b).count("1") for b in range(8)] for a in range(8)])
    np.testing.assert_allclose(found, np.array([0, 7 / 12, 3 / 4, 5 / 6])[apart], atol=1e-14)


def test_parts_that_nothing_joins_are_infinitely_far():
    two = circuit([(0, 1), (2, 3), (3, 4)], [1, 2, np.inf], n=6)
    found = two.solver().resistances(np.array([0, 1, 2, 3, 4, 5]))
    expected = np.full((6, 6), np.inf)
    expected[:2, :2], expected[2:4, 2:4] = [[0, 1], [1, 0]], [[0, 2], [2, 0]]
    expected[4, 4] = expected[5, 5] = 0
    np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_no_resistance_is_one_point():
    loop = circuit([(0, 1), (1, 2), (2, 3), (0, 3)], [0, 4, 0, 12])
    assert between(loop, 0, 3) == pytest.approx(3, rel=1e-14)
    assert between(loop, 0, 1) == 0


def test_points_that_are_joined_share_the_current():
    star = circuit([(0, 4), (1, 4), (2, 4), (3, 4)], [1, 2, 3, 6])
    assert between(star, 0, 2, [np.array([0, 1]), np.array([2, 3])]) == pytest.approx(2 / 3 + 2, rel=1e-14)


@pytest.mark.parametrize("mutual", [-0.5, 0.5, 1.5])
def test_resistances_that_raise_each_others_voltage(mutual):
    """In parallel: the voltage 1 = [2 m; m 3] I."""
    pair = circuit([(0, 1), (0, 1), (1, 2)], [2, 3, 7], coupled=[(0, 1)], mutual=[mutual])
    currents = np.linalg.solve([[2, mutual], [mutual, 3]], [1, 1])
    assert between(pair, 0, 1) == pytest.approx(1 / currents.sum(), rel=1e-13)
    assert between(pair, 0, 2) == pytest.approx(7 + 1 / currents.sum(), rel=1e-13)


def test_the_sign_of_the_coupling_follows_the_direction_of_its_contacts():
    turned = circuit([(0, 1), (1, 0)], [2, 3], coupled=[(0, 1)], mutual=[-0.5])
    straight = circuit([(0, 1), (0, 1)], [2, 3], coupled=[(0, 1)], mutual=[0.5])
    assert between(turned, 0, 1) == pytest.approx(between(straight, 0, 1), rel=1e-14)


def test_without_scipy_the_error_says_what_is_needed(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy.sparse", None)
    with pytest.raises(litz.FileError, match=r"pip install scipy$"):
        circuit([(0, 1)], [1]).solver()


class TestStages:
    def test_bundles_within_bundles(self):
        """2 x 2 x 3: triplets, two of them in each bundle, and the cable."""
        bundles = {f"BUNDLE{i + 1}": np.arange(6 * i, 6 * i + 6) for i in range(2)}
        bundles |= {f"BUNDLE{i // 2 + 1}_{i % 2 + 1}": np.arange(3 * i, 3 * i + 3) for i in range(4)}
        stage = _stages(12, bundles)
        for i in range(12):
            for j in range(12):
                expected = 0 if i == j else 1 if i // 3 == j // 3 else 2 if i // 6 == j // 6 else 3
                assert stage[i, j] == expected

    def test_without_bundles_all_wires_are_laid_at_once(self):
        np.testing.assert_array_equal(_stages(3, {}), 1 - np.eye(3))

    def test_means_of_stages(self):
        matrix = np.array([[0, 1, 4, 4], [1, 0, 4, 4], [4, 4, 0, 3], [4, 4, 3, 0]], dtype=float)
        bundles = {"BUNDLE1": np.array([0, 1]), "BUNDLE2": np.array([2, 3])}
        network = circuit([(0, 1)], [1.0])
        found = InterstrandResistance(matrix, _stages(4, bundles), 0.5, np.arange(4), bundles, network)
        stages = found.stages()
        assert stages["pairs"].tolist() == [2, 4]
        assert stages["mean"].tolist() == [2, 4]
        assert (stages["smallest"].tolist(), stages["largest"].tolist()) == ([1, 4], [3, 4])
        assert stages["times_length"].tolist() == [1, 2]
        assert stages.units["times_length"] == "ohm m"
        assert repr(found) == "<InterstrandResistance: 4 wires; mean of each stage: 2, 4 ohm>"
        assert not stages["not_joined"].any()

    def test_pairs_that_nothing_joins_are_counted_and_left_out(self):
        """One wire of the second bundle lies apart; in a bundle of two apart there is no mean."""
        inf = np.inf
        matrix = np.array([[0, 1, 2, inf], [1, 0, 6, inf], [2, 6, 0, inf], [inf, inf, inf, 0]])
        bundles = {"BUNDLE1": np.array([0, 1]), "BUNDLE2": np.array([2, 3])}
        found = InterstrandResistance(matrix, _stages(4, bundles), 0.5, np.arange(4), bundles, circuit([(0, 1)], [1.0]))
        stages = found.stages()
        assert stages["pairs"].tolist() == [2, 4]
        assert stages["not_joined"].tolist() == [1, 2]
        assert stages["mean"].tolist() == stages["median"].tolist() == [1, 4]
        assert (stages["smallest"].tolist(), stages["largest"].tolist()) == ([1, 2], [1, 6])
        assert stages["times_length"].tolist() == [0.5, 2]
        assert repr(found) == (
            "<InterstrandResistance: 4 wires; mean of each stage: 1 (1 pairs not joined), 4 (2 pairs not joined) ohm>"
        )
        matrix[0, 1] = matrix[1, 0] = inf
        apart = InterstrandResistance(matrix, found.stage, 0.5, np.arange(4), bundles, found.circuit).stages()
        assert apart["not_joined"].tolist() == [2, 2]
        assert np.isinf(apart["mean"][0])
        assert np.isinf(apart["median"][0])
