"""Critical current densities against the published fits, the law of filaments and metal in parallel, and its element."""

import numpy as np
import pytest
from scipy.optimize import brentq

from litz.kernels import critical_table, nb3sn, nbti, parallel_field, superconductor

#: A strand of the ITER production: C = 19922 A T of a strand of 0.82 mm that is half copper
STRAND = dict(
    C=19922 / (0.5 * np.pi / 4 * 0.82e-3**2), Bc20=32.97, Tc0=16.06, p=0.63, q=2.1, Ca1=44.48, Ca2=0.0, e0=2.56e-3
)
#: With all parameters of the strain function
SKEWED = STRAND | dict(Ca1=50.0, Ca2=12.0, em=-0.6e-3)
LHC = dict(jref=3e9, C0=27.04, Bc20=14.5, Tc0=9.2, alpha=0.57, beta=0.9, gamma=2.32)


def iter_2008(temperature, field, strain, *, C, Bc20, Tc0, p, q, Ca1, Ca2, e0, em=0.0):
    """The parametrization as published, of arguments that may be complex."""
    e = strain - em
    shift = Ca2 * e0 / np.sqrt(Ca1**2 - Ca2**2)
    s = 1 + (Ca1 * (np.sqrt(shift**2 + e0**2) - np.sqrt((e - shift) ** 2 + e0**2)) - Ca2 * e) / (1 - Ca1 * e0)
    t = temperature / (Tc0 * s ** (1 / 3))
    b = field / (Bc20 * s * (1 - t**1.52))
    return C / field * s * (1 - t**1.52) * (1 - t**2) * b**p * (1 - b) ** q


def bottura(temperature, field, *, jref, C0, Bc20, Tc0, alpha, beta, gamma):
    """The fit as published, of arguments that may be complex."""
    u = 1 - (temperature / Tc0) ** 1.7
    b = field / (Bc20 * u)
    return jref * C0 / field * b**alpha * (1 - b) ** beta * u**gamma


def by_complex_steps(function, place):
    """Derivatives by all arguments."""
    step = 1e-30
    return [function(*(x + 1j * step * (i == j) for j, x in enumerate(place))).imag / step for i in range(len(place))]


@pytest.mark.parametrize(
    ("temperature", "density"), [(4.75, 692348194.774593), (6.251, 495889332.08959526)], ids=["4.75 K", "6.251 K"]
)
def test_nb3sn_has_the_critical_current_density_of_an_independent_implementation(temperature, density):
    """Values of the systems code PROCESS (UKAEA, test_superconductors.py), at 13 T and 0.16 %, of the same strand."""
    found = nb3sn(temperature, 13.008974843466492, 0.001601605753441172, **STRAND)
    assert found.value == pytest.approx(density, rel=1e-9)


@pytest.mark.parametrize("parameters", [STRAND, SKEWED], ids=["even in the strain", "skewed"])
@pytest.mark.parametrize("place", [(4.2, 12.0, -5e-3), (6.0, 11.3, 2e-3), (1.8, 5.0, 0.0), (9.0, 2.0, -3e-3)])
def test_nb3sn_and_its_derivatives_are_those_of_the_published_fit(parameters, place):
    found = nb3sn(*place, **parameters)
    assert found.value == pytest.approx(iter_2008(*place, **parameters), rel=1e-13)
    slopes = by_complex_steps(lambda *x: iter_2008(*x, **parameters), place)
    assert [found.by_temperature, found.by_field, found.by_strain] == pytest.approx(slopes, rel=1e-11)


@pytest.mark.parametrize("place", [(4.2, 5.0), (1.9, 8.33), (6.5, 2.0)])
def test_nbti_and_its_derivatives_are_those_of_the_published_fit(place):
    found = nbti(*place, **LHC)
    assert found.value == pytest.approx(bottura(*place, **LHC), rel=1e-13)
    slopes = by_complex_steps(lambda *x: bottura(*x, **LHC), place)
    assert [found.by_temperature, found.by_field] == pytest.approx(slopes, rel=1e-11)
    assert found.by_strain == 0


def test_nbti_is_normalised_at_4_2_k_and_5_t():
    """The published constants have three digits: within 3 % of the reference."""
    assert nbti(4.2, 5.0, **LHC).value == pytest.approx(LHC["jref"], rel=0.03)


@pytest.mark.parametrize("place", [(17.0, 1.0, 0.0), (4.2, 40.0, 0.0), (4.2, 12.0, 0.05)], ids=["Tc", "Bc2", "strain"])
def test_nothing_superconducts_beyond_the_critical_surface(place):
    assert nb3sn(*place, **STRAND) == (0, 0, 0, 0)
    assert nbti(10.0, 1.0, **LHC) == nbti(4.2, 15.0, **LHC) == (0, 0, 0, 0)


def test_a_flux_density_of_less_than_a_thousandth_of_the_critical_one_counts_as_that():
    assert nb3sn(4.2, 0.0, 0.0, **STRAND).value == pytest.approx(iter_2008(4.2, 0.03297, 0.0, **STRAND), rel=1e-13)
    assert nbti(4.2, 0.0, **LHC).value == pytest.approx(bottura(4.2, 0.0145, **LHC), rel=1e-13)
    assert nb3sn(4.2, 0.01, 0.0, **STRAND).by_field == nbti(4.2, 0.01, **LHC).by_field == 0


def test_a_table_is_bilinear_inside_and_constant_outside():
    temperatures, fields = [4.0, 5.0, 9.0], [0.0, 3.0, 8.0]
    # a bilinear function is found exactly
    rows = [(1e10 - 1e9 * t - 1e9 * b + 0.1e9 * t * b, t, b) for t in temperatures for b in fields]
    found = critical_table(4.3, 5.5, rows[::-1])
    assert found.value == pytest.approx(1e10 - 4.3e9 - 5.5e9 + 0.43e9 * 5.5, rel=1e-14)
    assert [found.by_temperature, found.by_field] == pytest.approx([-1e9 + 0.55e9, -1e9 + 0.43e9], rel=1e-13)
    assert critical_table(2.0, 20.0, rows) == (rows[2][0], 0, 0, 0)
    assert critical_table(2.0, 20.0, [(7e8, 0.0, 0.0)]) == (7e8, 0, 0, 0)


LAW = dict(conductivity=3e9, critical=8e8, exponent=30.0)


def current(field, *, conductivity, critical, exponent, criterion=1e-4):
    """J(E), the law itself."""
    return conductivity * field + critical * (field / criterion) ** (1 / exponent)


@pytest.mark.parametrize("exponent", [1.0, 5.0, 30.0, 200.0])
def test_the_field_of_a_current_inverts_the_law_over_a_hundred_decades(exponent):
    law = LAW | dict(exponent=exponent)
    for field in np.logspace(-90, 10, 101):
        j = current(field, **law)
        found = parallel_field(j, **law)
        # the relative round-off of J is n times larger in E
        assert found.value == pytest.approx(field, rel=4e-14 * exponent)
        slope = law["conductivity"] + (j - law["conductivity"] * field) / (exponent * field)
        assert found.by_current == pytest.approx(1 / slope, rel=4e-14 * exponent)
        # dE at a given J, of the law differentiated
        share = (field / 1e-4) ** (1 / exponent)
        assert found.by_conductivity == pytest.approx(-field / slope, rel=4e-14 * exponent)
        assert found.by_critical == pytest.approx(-share / slope, rel=4e-14 * exponent)


def test_the_field_is_odd_and_vanishes_with_the_current():
    assert parallel_field(-9e8, **LAW)[:2] == (-parallel_field(9e8, **LAW).value, parallel_field(9e8, **LAW).by_current)
    assert parallel_field(-9e8, **LAW).by_critical == -parallel_field(9e8, **LAW).by_critical > 0
    assert parallel_field(0.0, **LAW) == parallel_field(1e-12, **LAW) == (0, 0, 0, 0)


def test_without_filaments_it_is_ohms_law():
    assert parallel_field(6e8, **LAW | dict(critical=0.0))[:2] == pytest.approx((0.2, 1 / 3e9), rel=1e-15)


WIRE = dict(area=0.5e-6, resistivity=2e-10, fraction=0.4, critical=2e9, exponent=30.0)


def test_the_element_is_the_law_linearised_about_its_current():
    """R is linear in V; where V is the voltage of the current it is the current, with the slope of the law."""
    law = dict(conductivity=0.6 / 2e-10, critical=8e8, exponent=30.0)
    field = parallel_field(380 / 0.5e-6, **law)
    at = superconductor(380.0, [0.0, 0.0], 0.01, **WIRE)
    assert at.field == pytest.approx(field.value, rel=1e-14)
    # rho_0 = 1e-9 rho
    series = 1e-9 * 2e-10
    assert at.drop == pytest.approx(0.01 * (field.value + series * 380 / 0.5e-6), rel=1e-14)
    assert at.K[0] == pytest.approx(
        [0.5e-6 / (0.01 * (field.by_current + series)) * sign for sign in (1, -1)], rel=1e-14
    )
    np.testing.assert_allclose(superconductor(380.0, [at.drop, 0.0], 0.01, **WIRE).R, [380, -380], rtol=1e-13)
    for v in (np.array([1e-6, -2e-6]), np.array([-3e-7, 0.0])):
        np.testing.assert_allclose(superconductor(380.0, v, 0.01, **WIRE).R, at.R + at.K @ v, rtol=1e-12)


def test_newtons_method_converges_quadratically():
    """Two wires in parallel, one twice as good as the other, share an imposed current from a state of far less."""
    pair = [WIRE, WIRE | dict(critical=4e9)]
    imposed, length = 1150.0, 0.01
    present, v = np.array([10.0, 10.0]), np.zeros(2)
    voltages = []
    for _ in range(12):
        flows = [superconductor(i, v, length, **wire) for i, wire in zip(present, pair, strict=True)]
        conductances = np.array([flow.K[0, 0] for flow in flows])
        step = (imposed - sum(flow.R[0] for flow in flows)) / conductances.sum()
        v[0] += step
        present = [flow.R[0] for flow in flows] + conductances * step
        voltages.append(v[0])
    assert present.sum() == pytest.approx(imposed, rel=1e-14)
    # the exact one: the root of the sum of both laws
    laws = [dict(conductivity=0.6 / 2e-10, critical=0.4 * wire["critical"], exponent=30.0) for wire in pair]
    excess = lambda x: sum(0.5e-6 * current(np.exp(x), **law) for law in laws) - imposed  # noqa: E731
    exact = length * np.exp(brentq(excess, -60, 10, xtol=1e-15, rtol=1e-15))
    # of the small resistance in series of each wire
    assert v[0] == pytest.approx(exact, rel=1e-5)
    errors = np.abs(np.array(voltages) / v[0] - 1)
    near = [k for k in range(len(errors) - 1) if 1e-7 < errors[k] < 0.1]
    assert len(near) >= 2
    # the constant of Newton's method, at most n for a power n
    assert all(errors[k + 1] < 30 * errors[k] ** 2 for k in near)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (dict(fraction=1.0), "fraction must be less than 1, not 1"),
        (dict(exponent=0.5), "exponent must be 1 or more, not 0.5"),
        (dict(critical=-1.0), "critical must not be negative"),
        (dict(resistivity=0.0), "resistivity must be greater than 0"),
    ],
)
def test_bad_numbers_are_refused(change, message):
    with pytest.raises(ValueError, match=message):
        superconductor(1.0, [0.0, 0.0], 0.01, **WIRE | change)


def test_bad_parameters_of_the_fits_are_refused():
    with pytest.raises(ValueError, match="Ca1 must be more than Ca2 and less than 1/e0"):
        nb3sn(4.2, 12.0, **STRAND | dict(Ca2=50.0))
    with pytest.raises(ValueError, match="must not be negative"):
        nbti(-1.0, 5.0, **LHC)
    with pytest.raises(ValueError, match="every temperature at every flux density"):
        critical_table(4.2, 5.0, [(1e9, 4.0, 5.0), (1e9, 5.0, 6.0)])
