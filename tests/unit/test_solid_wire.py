"""The exact deflection of solid wires, to which contacts along them are compared: against its limits."""

import numpy as np
import pytest
from verification.references.end_in_half_space import force_of_lens
from verification.references.solid_wire import (
    approach_in_half_space,
    approach_of_strips,
    deflection,
    less_than_half_space,
)

POISSON = 0.34


@pytest.mark.parametrize(("n", "k", "wave"), [(0, 400.0, 400.0), (3, 400.0, 400.0), (400, 0.5, 400.0)])
def test_short_waves_deflect_a_wire_as_a_half_space(n, k, wave):
    assert deflection(n, np.array([k]), POISSON)[0] == pytest.approx((1 - POISSON) / wave, rel=5e-3)


def test_an_even_pressure_makes_a_wire_thinner_whose_ends_are_free():
    assert deflection(0, np.array([1e-3]), POISSON)[0] == pytest.approx((1 - POISSON) / (2 * (1 + POISSON)), rel=1e-5)


@pytest.mark.parametrize("n", [2, 5])
def test_waves_round_a_long_wire_are_those_of_the_plane(n):
    """Michell: of a disc under p cos(n theta) in plane strain, u = p r (2 (1 - nu) n - 1 + 2 nu)/(2 G (n^2 - 1))."""
    plane = (2 * (1 - POISSON) * n + 2 * POISSON - 1) / (2 * (n**2 - 1))
    assert deflection(n, np.array([1e-3]), POISSON)[0] == pytest.approx(plane, rel=1e-5)


def test_short_strips_deflect_a_half_space_and_long_ones_the_section():
    width = 0.1
    short, long, endless = approach_of_strips([0.05, 1.0, 4.0], POISSON, width)
    assert short == pytest.approx(approach_in_half_space(0.05, width), rel=0.07)
    assert long == pytest.approx(endless, rel=0.01)
    assert approach_in_half_space(4.0, width) > 1.3 * endless


def test_far_along_a_wire_nothing_of_the_deflection_is_left():
    distance = np.array([2.0, 4.0, 7.0])
    assert less_than_half_space(distance, POISSON) == pytest.approx(1 / distance, rel=0.02)


def test_the_section_counts_the_more_the_longer_a_lens_is():
    ratios = [
        force_of_lens(length / 0.1, 0.01, 40) / force_of_lens(length / 0.1, 0.0, 40) for length in (0.1, 0.5, 2.0)
    ]
    assert 1 < ratios[0] < ratios[1] < ratios[2]
    assert ratios[0] < 1.1
    assert ratios[2] > 1.4
