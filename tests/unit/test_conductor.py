"""The two-node conductor."""

import numpy as np
import pytest

from derivatives import derivative
from litz import kernels

configurations = pytest.mark.parametrize("seed", range(50))
STEP = 1e-3


class Configuration:
    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        self.x = rng.normal(size=(2, 3))
        self.v = rng.normal(size=2)
        self.length = rng.uniform(0.5, 2)
        self.area, self.resistivity = rng.uniform(0.5, 2, size=2)

    def __call__(self, x=None, v=None, **options):
        return kernels.conductor(
            self.x if x is None else x,
            self.v if v is None else v,
            self.length,
            area=self.area,
            resistivity=self.resistivity,
            **options,
        )


def test_copper_wire_of_one_square_millimetre():
    """One metre, 1 mm^2, 1.7241e-8 ohm m (annealed copper, IEC 60028) under 1 mV: 17.241 milliohm, 58.0 mA."""
    wire = kernels.conductor([[0, 0, 0], [9, 0, 0]], [1e-3, 0], 1.0, area=1e-6, resistivity=1.7241e-8)
    assert wire.current == pytest.approx(1e-3 / 17.241e-3, rel=1e-14)
    assert wire.heat == pytest.approx(1e-6 / 17.241e-3, rel=1e-14)


@configurations
@pytest.mark.parametrize("current_length", [False, True])
class TestEitherLength:
    def test_current_follows_ohm(self, seed, current_length):
        case = Configuration(seed)
        length = np.linalg.norm(case.x[1] - case.x[0]) if current_length else case.length
        resistance = case.resistivity * length / case.area
        assert case(current_length=current_length).current == pytest.approx(
            (case.v[0] - case.v[1]) / resistance, rel=1e-14
        )

    def test_what_leaves_the_first_node_enters_the_second(self, seed, current_length):
        result = Configuration(seed)(current_length=current_length)
        assert result.R[0] == result.current
        assert result.R.sum() == 0

    def test_heat_is_current_times_voltage_and_not_negative(self, seed, current_length):
        case = Configuration(seed)
        result = case(current_length=current_length)
        assert result.heat == pytest.approx(case.v @ result.R, rel=1e-14)
        assert result.heat >= 0

    def test_tangent_by_the_potentials(self, seed, current_length):
        case = Configuration(seed)
        result = case(current_length=current_length)
        numeric = derivative(lambda v: case(v=v, current_length=current_length).R, case.v, STEP)
        assert np.abs(result.K - numeric).max() < 1e-11 * np.abs(numeric).max()
        assert np.array_equal(result.K, result.K.T)

    def test_tangent_by_the_positions(self, seed, current_length):
        case = Configuration(seed)
        result = case(current_length=current_length)
        numeric = derivative(lambda x: case(x=x, current_length=current_length).R, case.x, STEP).reshape(2, 6)
        assert np.abs(result.K_me - numeric).max() <= 1e-10 * np.abs(numeric).max()
        assert np.any(result.K_me) == current_length


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"x": np.ones((2, 3))}, "x: the two nodes coincide"),
        ({"x": np.ones(3)}, r"x must have shape \(2, 3\)"),
        ({"v": [1, 2, 3]}, r"v must have shape \(2,\)"),
        ({"v": [1, np.nan]}, "v must be finite"),
        ({"length": 0}, "length must be greater than 0"),
        ({"area": -1}, "area must be greater than 0, not -1"),
        ({"resistivity": 0}, "resistivity must be greater than 0"),
        ({"resistivity": np.inf}, "resistivity must be finite"),
    ],
)
def test_refusals(changes, message):
    good = {"x": [[0, 0, 0], [1, 0, 0]], "v": [1, 0], "length": 1, "area": 1, "resistivity": 1}
    with pytest.raises(ValueError, match=message):
        kernels.conductor(**(good | changes))


def chain(xi, current, resistance):
    """Potentials at the places of a chain of resistors between two ends at zero, by Kirchhoff's laws."""
    lengths = np.diff(np.concatenate([[-1.0], xi, [1.0]])) / 2
    conductances = 1 / (resistance * lengths)
    matrix = np.diag(conductances[:-1] + conductances[1:])
    matrix -= np.diag(conductances[1:-1], 1) + np.diag(conductances[1:-1], -1)
    return np.linalg.solve(matrix, current)


@configurations
def test_currents_within_a_conductor_raise_the_potential_as_in_a_chain_of_its_pieces(seed):
    rng = np.random.default_rng(seed)
    xi = np.sort(rng.uniform(-1, 1, size=1 + seed % 7))
    current = rng.normal(size=xi.size)
    rise = kernels.potential_rise(xi, current, 0.7, area=0.3, resistivity=2.0)
    np.testing.assert_allclose(rise, chain(xi, current, 2.0 * 0.7 / 0.3), rtol=1e-9, atol=1e-12)


def test_currents_at_one_place_and_at_the_ends():
    np.testing.assert_allclose(
        kernels.potential_rise([-1, 0, 0, 1], [5, 1, 2, 7], 1.0, area=1, resistivity=1), [0, 0.75, 0.75, 0], atol=1e-15
    )
    assert kernels.potential_rise([], [], 1.0, area=1, resistivity=1).size == 0
    with pytest.raises(ValueError, match="ascend"):
        kernels.potential_rise([0.5, 0.2], [1, 1], 1.0, area=1, resistivity=1)
