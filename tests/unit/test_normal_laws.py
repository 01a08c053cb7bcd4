"""Normal laws: each that the program has, asked about a gap and about a force; derivatives, energy and inverse."""

import numpy as np
import pytest

from derivatives import derivative
from litz import _core
from litz.kernels.laws import NORMAL_FIELDS, NORMAL_LAWS, normal_law_data

WIRES = ([1e-3, 0.3e-3], [120e9, 70e9], [0.34, 0.2])
ANGLE = 0.7
PENALTY = 3e6
DATA = {law: np.full(max(1, len(fields)), PENALTY) for law, fields in NORMAL_FIELDS.items()}
LAWS = list(DATA)
DEPTHS = [1e-9, 1e-6, 1e-4]


def at_gap(law, gap, angle=ANGLE):
    """Force, dforce_dgap, dforce_dangle, energy, denergy_dangle, d2energy_dangle2."""
    values, info = _core.f2py_contact.normal_force(NORMAL_LAWS[law], DATA[law], gap, *WIRES, angle)
    assert info == 0
    return values


def at_force(law, force):
    """Overlap, stiffness, dstiffness_dforce."""
    values, info = _core.f2py_contact.normal_overlap(NORMAL_LAWS[law], DATA[law], force, *WIRES, ANGLE)
    assert info == 0
    return values


def test_the_laws_of_the_table():
    # their numbers are those of user elements
    assert NORMAL_LAWS.items() >= {"linear": 1, "hertz": 2}.items()
    assert NORMAL_FIELDS.items() >= {"linear": ["penalty", "eps_l"], "hertz": []}.items()


def test_the_penalty_is_force_over_overlap():
    assert tuple(at_gap("linear", -2e-6)) == pytest.approx((6.0, -3e6, 0.0, 6e-6, 0.0, 0.0), rel=1e-15)


def test_the_energy_of_hertz_is_two_fifths_of_force_times_overlap():
    force, _, _, energy, *_ = at_gap("hertz", -2e-6)
    assert energy == pytest.approx(0.4 * force * 2e-6, rel=1e-15)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("gap", [0.0, 1e-6])
def test_an_open_gap_has_no_force_and_no_energy(law, gap):
    assert not at_gap(law, gap).any()


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("angle", [0.02, 0.3, 1.0, 1.5, 2.5])
@pytest.mark.parametrize("depth", DEPTHS)
def test_derivatives_of_the_force(law, depth, angle):
    force, dforce_dgap, dforce_dangle, *_ = at_gap(law, -depth, angle)
    by_gap = derivative(lambda s: at_gap(law, -depth * (1 - s), angle)[0], 0.0, 4e-3)[0] / depth
    step = 4e-3 * min(1.0, angle)
    by_angle = derivative(lambda d: at_gap(law, -depth, angle + d)[0], 0.0, step)[0]
    assert dforce_dgap == pytest.approx(by_gap, rel=1e-10)
    # round-off of the force, over the step
    assert dforce_dangle == pytest.approx(by_angle, abs=1e-12 * force / step)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("wires", [WIRES, ([1e-3, 1e-3], [120e9, 70e9], [0.34, 0.2])], ids=["unequal", "equal radii"])
@pytest.mark.parametrize("angle", [0.02, 0.3, 1.0, 1.5, np.pi / 2 - 1e-4, np.pi / 2, 2.5])
def test_derivatives_of_the_energy_by_the_angle(law, wires, angle):
    def energies(d):
        values, info = _core.f2py_contact.normal_force(NORMAL_LAWS[law], DATA[law], -1e-6, *wires, angle + d)
        assert info == 0
        return values[[3, 4]]

    energy, by_angle, by_angle_twice = at_gap_of(law, wires, angle)
    step = 4e-3 * min(1.0, angle)
    first, second = derivative(energies, 0.0, step)
    assert by_angle == pytest.approx(first, abs=1e-12 * energy / step)
    assert by_angle_twice == pytest.approx(second, abs=1e-9 * energy / min(1.0, angle) ** 2)


def at_gap_of(law, wires, angle):
    """Energy and its two derivatives by the angle."""
    return _core.f2py_contact.normal_force(NORMAL_LAWS[law], DATA[law], -1e-6, *wires, angle)[0][3:]


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("depth", DEPTHS)
def test_the_energy_is_the_integral_of_the_force(law, depth):
    # Gauss with overlap = depth s^2, which makes polynomials of all forces that go with a half power
    s, weight = np.polynomial.legendre.leggauss(20)
    s, weight = (s + 1) / 2, weight / 2
    integral = sum(w * at_gap(law, -depth * x**2)[0] * 2 * depth * x for x, w in zip(s, weight, strict=True))
    assert at_gap(law, -depth)[3] == pytest.approx(integral, rel=1e-13)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("force", [1e-9, 1e-2, 1.0, 1e5])
def test_the_overlap_is_the_inverse_of_the_force(law, force):
    overlap, stiffness, _ = at_force(law, force)
    found, dforce_dgap, *_ = at_gap(law, -overlap)
    assert found == pytest.approx(force, rel=1e-14)
    assert -dforce_dgap == pytest.approx(stiffness, rel=1e-14)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("force", [1e-6, 1.0, 1e5])
def test_derivatives_of_the_overlap(law, force):
    _, stiffness, dstiffness_dforce = at_force(law, force)
    compliance = derivative(lambda s: at_force(law, force * (1 + s))[0], 0.0, 4e-3)[0] / force
    assert stiffness * compliance == pytest.approx(1, rel=1e-10)
    by_force = derivative(lambda s: at_force(law, force * (1 + s))[1], 0.0, 4e-3)[0] / force
    assert dstiffness_dforce == pytest.approx(by_force, abs=1e-10 * stiffness / force)


def test_hertz_has_no_stiffness_without_a_force():
    assert not at_force("hertz", 0.0).any()
    assert tuple(at_force("linear", 0.0)) == (0.0, PENALTY, 0.0)


def test_the_ellipse_of_parallel_wires_is_refused():
    for procedure, value in ((_core.f2py_contact.normal_force, -1e-6), (_core.f2py_contact.normal_overlap, 1.0)):
        values, info = procedure(NORMAL_LAWS["hertz"], [0.0], value, *WIRES, 0.0)
        assert info < 0
        assert not values.any()


def test_a_number_of_another_normal_law_is_refused():
    refused = normal_law_data
    with pytest.raises(ValueError, match='normal_value does not belong to normal_law="hertz"'):
        refused("hertz", eps_n=None, normal_value=1.0)
    with pytest.raises(ValueError, match="eps_n must be greater than 0"):
        refused("linear", eps_n=-1.0, normal_value=None)
