"""The closed forms give the published or independently computed numbers they stand for."""

import math

import numpy as np
import pytest

from litz import closed_forms as cf

COPPER = {"radius": 1e-3, "young": 120e9, "poisson": 0.34, "resistivity": 1.7e-8}
COPPER_WIRE = cf.Wire(radius=1e-3, length=0.1, young=120e9, poisson=0.34, resistivity=1.7e-8)
UNIT = {"radius": 1.0, "young": 2.0, "poisson": 0.0, "resistivity": 1.0}


# ---- Elliptic integrals


@pytest.mark.parametrize("m", [0.0, 1e-12, 0.3, 0.9, 0.999999])
def test_complete_integrals_agree_with_an_arbitrary_precision_library(m):
    mpmath = pytest.importorskip("mpmath")
    k, e, d = cf.complete_elliptic(m)
    with mpmath.workdps(40):
        exact_k, exact_e = mpmath.ellipk(mpmath.mpf(m)), mpmath.ellipe(mpmath.mpf(m))
        exact_d = (exact_k - exact_e) / mpmath.mpf(m) if m else mpmath.pi / 4
    # relative round-off of a dozen operations
    assert [k, e, d] == pytest.approx([float(exact_k), float(exact_e), float(exact_d)], rel=1e-14)


@pytest.mark.parametrize(("phi", "m"), [(0.3, 0.2), (1.1, 0.7), (math.pi / 2, 0.5), (1.4, 0.99)])
def test_incomplete_integrals_agree_with_an_arbitrary_precision_library(phi, m):
    mpmath = pytest.importorskip("mpmath")
    # Carlson's series is cut where its error is below 1e-4^6
    assert cf.incomplete_elliptic(phi, m) == pytest.approx(
        (float(mpmath.ellipf(phi, m)), float(mpmath.ellipe(phi, m))), rel=1e-14
    )


# ---- The contact spot


@pytest.mark.parametrize(
    ("angle", "ratio", "a", "b", "approach", "pressure", "resistance"),
    [
        (90, 1.0, 0.9085602964, 0.9085602964, 0.8254818122, 0.5784074491, 0.5503212081),
        (60, 0.4826277811, 1.349960659, 0.6515285177, 0.7739655026, 0.5428587523, 0.5159770017),
        (45, 0.3134388680, 1.750307007, 0.5486142468, 0.7055505594, 0.4972331485, 0.4703670396),
        (30, 0.1805651153, 2.480958468, 0.4479745519, 0.5995553054, 0.4296042296, 0.3997035370),
        (20, 0.1080053783, 3.467076289, 0.3744628863, 0.4984602126, 0.3677639947, 0.3323068084),
    ],
)
def test_unit_cylinders_have_the_ellipse_of_an_independent_computation(
    angle, ratio, a, b, approach, pressure, resistance
):
    spot = cf.hertz_contact(1.0, **UNIT, angle=math.radians(angle))
    # ten digits are given
    assert spot.semi_minor / spot.semi_major == pytest.approx(ratio, rel=1e-9)
    assert spot[:5] == pytest.approx((a, b, approach, pressure, resistance), rel=1e-9)


@pytest.mark.parametrize("force", [1e-3, 1.0, 100.0])
@pytest.mark.parametrize("angle", [12.0, 30.0, 75.0, 90.0])
def test_resistance_and_stiffness_obey_barbers_identity(force, angle):
    # J. R. Barber, Proc. R. Soc. A 459 (2003) 53-66: R_c dF/ddelta = E* (rho1 + rho2)/2 for any contact
    spot = cf.hertz_contact(
        force,
        radius=(1e-3, 3e-3),
        young=(120e9, 70e9),
        poisson=(0.34, 0.3),
        resistivity=(1.7e-8, 2.8e-8),
        angle=math.radians(angle),
    )
    e_star = cf.reduced_modulus((120e9, 70e9), (0.34, 0.3))
    assert spot.resistance * spot.stiffness == pytest.approx(e_star * (1.7e-8 + 2.8e-8) / 2, rel=1e-13)


def test_force_from_approach_inverts_approach_from_force():
    approach = cf.hertz_contact(7.0, **COPPER, angle=0.6).approach
    assert cf.hertz_force(approach, **COPPER, angle=0.6) == pytest.approx(7.0, rel=1e-13)


def test_the_law_of_the_paper_has_a_smaller_spot_and_a_larger_resistance_than_hertz():
    hertz = cf.hertz_contact(1.0, **COPPER)
    radius, resistance = cf.paper_contact(1.0, **COPPER)
    # r* = r/2 in place of r, under a cube root
    assert radius / hertz.semi_major == pytest.approx(0.5 ** (1 / 3), rel=1e-12)
    assert resistance / hertz.resistance == pytest.approx(2 ** (1 / 3), rel=1e-12)


# ---- Wires that press each other


@pytest.mark.parametrize(
    ("support", "position", "stiffness_factor"),
    [("clamped", 0.5, 192.0), ("supported", 0.5, 48.0), ("cantilever", 1.0, 3.0), ("cantilever", 0.5, 24.0)],
)
def test_textbook_beam_stiffnesses(support, position, stiffness_factor):
    assert cf.beam_compliance(2.0, 3.0, support, position) == pytest.approx(27.0 / (2.0 * stiffness_factor), rel=1e-14)


@pytest.mark.parametrize("support", ["clamped", "supported", "cantilever"])
def test_deflections_are_reciprocal_and_solve_the_beam_equation(support):
    a, h = 0.4, 1e-3
    assert cf.beam_compliance(1, 1, support, 0.2, 0.7) == cf.beam_compliance(1, 1, support, 0.7, 0.2)

    def w(x):
        return cf.beam_compliance(1.0, 1.0, support, a, x)

    def shear(x):
        # third derivative, exact for the cubic on either side of the load
        return (w(x + 3 * h) - 3 * w(x + h) + 3 * w(x - h) - w(x - 3 * h)) / (8 * h**3)

    # the shear force jumps by the unit load; cancellation leaves 1e-17/1e-9
    assert shear(0.6) - shear(0.2) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize(
    ("support", "u", "force", "approach", "radius", "resistance", "current", "voltage"),
    [
        ("clamped", 1e-5, 0.0895789530, 9.935197e-8, 9.967546e-6, 8.5276758e-4, 71.741447, 0.061178780),
        ("clamped", 5e-5, 0.4497536300, 2.913101e-7, 1.706781e-5, 4.9801350e-4, 96.233395, 0.047925530),
        ("clamped", 1e-4, 0.9005913909, 4.627975e-7, 2.151273e-5, 3.9511491e-4, 106.810024, 0.042202233),
        ("supported", 1e-5, 0.0225299249, 3.958637e-8, 6.291770e-6, 1.3509712e-3, 52.851384, 0.071400699),
        ("supported", 1e-4, 0.2257784636, 1.840041e-7, 1.356481e-5, 6.2662132e-4, 85.634905, 0.053660658),
    ],
)
def test_crossed_copper_wires_as_computed_independently(
    support, u, force, approach, radius, resistance, current, voltage
):
    compliance = cf.beam_compliance(COPPER_WIRE.bending_stiffness, COPPER_WIRE.length, support)
    f = cf.crossed_beams(u, (compliance, compliance), **COPPER)
    spot = cf.hertz_contact(f, **COPPER)
    arm = COPPER_WIRE.resistance(0.5)
    crossing = cf.crossed_wires_network(((0.1, None), (0.0, None)), ((arm, arm), (arm, arm)), spot.resistance)
    # the digits given
    assert f == pytest.approx(force, rel=1e-8)
    assert spot.approach == pytest.approx(approach, rel=2e-7)
    assert spot.semi_major == pytest.approx(radius, rel=2e-7)
    assert spot.resistance == pytest.approx(resistance, rel=2e-8)
    assert crossing.current == pytest.approx(current, rel=2e-8)
    assert crossing.voltage == pytest.approx(voltage, rel=2e-8)


def test_a_penalty_is_a_spring_in_series():
    assert cf.crossed_beams(3.0, (1.0, 2.0), penalty=0.25) == pytest.approx(3.0 / 7.0, rel=1e-15)


def test_a_grid_of_one_crossing_is_a_pair_of_crossed_beams():
    compliance = cf.beam_compliance(COPPER_WIRE.bending_stiffness, COPPER_WIRE.length, "clamped")
    assert cf.wire_grid(1e-4, [0.5], COPPER_WIRE)[0, 0] == pytest.approx(
        cf.crossed_beams(1e-4, (compliance, compliance), **COPPER), rel=1e-12
    )


def test_a_wide_grid_touches_at_its_corners_and_in_its_middle_only():
    force = cf.wire_grid(1e-4, (0.2, 0.4, 0.6, 0.8), COPPER_WIRE)
    touching = force > 0
    assert touching.tolist() == [
        [(i in (0, 3) and j in (0, 3)) or (i in (1, 2) and j in (1, 2)) for j in range(4)] for i in range(4)
    ]


# ---- Current


def test_a_balanced_bridge_carries_no_contact_current():
    crossing = cf.crossed_wires_network(((3.0, 0.0), (2.0, 0.0)), ((2.0, 1.0), (1.0, 1.0)), 0.7)
    assert crossing.potentials == pytest.approx((1.0, 1.0), rel=1e-15)
    assert crossing.current == pytest.approx(0.0, abs=1e-15)


def test_a_grid_of_one_crossing_is_three_resistances_in_series():
    current = cf.grid_network(1.0, [0.3], COPPER_WIRE, [[2e-3]])
    assert 1.0 / current == pytest.approx(2e-3 + 2 * COPPER_WIRE.resistance(0.3), rel=1e-13)


# ---- Large bending


@pytest.mark.parametrize(
    ("load", "deflection", "shortening", "angle"),
    [
        (0.2, 0.0663644821, 0.0026465483, 0.0996361630),
        (1.0, 0.3017207738, 0.0564332363, 0.4613519497),
        (5.0, 0.7137915236, 0.3876283607, 1.215368118),
        (10.0, 0.8106090249, 0.5549955978, 1.430285539),
    ],
)
def test_elastica_has_the_published_digits(load, deflection, shortening, angle):
    # K. Mattiasson, Int. J. Numer. Methods Eng. 17 (1981) 145-153, table 1, has the first five of them
    tip = cf.cantilever_elastica(load)
    assert tip == pytest.approx((deflection, shortening, angle), rel=2e-8, abs=1e-10)


def test_a_rolled_up_wire_ends_where_it_began():
    assert cf.roll_up(2 * math.pi) == pytest.approx((0.0, 1.0, 2 * math.pi), abs=1e-15)
    assert np.hypot(*np.subtract(cf.roll_up(math.pi)[:2], (0, 1))) == pytest.approx(2 / math.pi, rel=1e-15)
