"""Contact spot and normal law: tables of exact values, identities, derivatives, bad input."""

import mpmath
import numpy as np
import pytest
from verification.references import greenwood

from derivatives import derivative
from litz import _core
from litz.kernels import contact_spot
from litz.kernels.spot import _LAW_VALUES, _SPOT_LAWS

DEGREE = np.pi / 180
COPPER = dict(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
UNEQUAL = dict(radius=[1e-3, 0.3e-3], young=[120e9, 70e9], poisson=[0.34, 0.2], resistivity=[1.7e-8, 5e-8])
FILM = dict(law="film", film_resistivity=1e-13)
TABLE = dict(law="table", table=[[0.01, 0.1, 1.0, 30.0], [4e-3, 1e-3, 9e-4, 1e-4]])
LAWS = [
    dict(law="hertz"),
    dict(law="paper"),
    dict(law="plastic", hardness=1e9),
    FILM,
    dict(law="constant", resistance=1e-3),
    TABLE,
    dict(law="sharvin", law_value=1e-15),
    dict(law="sharvin", law_value=[1e-13, 1e-13]),
    dict(law="cluster", law_value=[1e9, 7]),
]
# laws that are new are tested unasked
LAWS += [
    dict(law=name, **({"law_value": 1e-6} if name in _LAW_VALUES else {}))
    for name in _SPOT_LAWS
    if name not in {"none", *(law["law"] for law in LAWS)}
]
ANGLES = [90, 89.9, 75, 60, 45, 30, 20, 10, 5, 2, 1, 150]


def modulus(young, poisson, **_):
    young, poisson = np.broadcast_to(young, 2), np.broadcast_to(poisson, 2)
    return 1 / ((1 - poisson**2) / young).sum()


@pytest.mark.parametrize(
    ("angle", "ratio", "a", "b", "delta", "resistance"),
    [
        (90, 1, 0.9085602964, 0.9085602964, 0.8254818122, 0.5503212081),
        (60, 0.4826277811, 1.349960659, 0.6515285177, 0.7739655026, 0.5159770017),
        (45, 0.3134388680, 1.750307007, 0.5486142468, 0.7055505594, 0.4703670396),
        (30, 0.1805651153, 2.480958468, 0.4479745519, 0.5995553054, 0.3997035370),
        (20, 0.1080053783, 3.467076289, 0.3744628863, 0.4984602126, 0.3323068084),
    ],
)
def test_unit_solution_of_equal_crossed_cylinders(angle, ratio, a, b, delta, resistance):
    # r = E* = F = rho = 1; values to 10 digits from an independent solution of Hertz's equations
    spot = contact_spot(1.0, radius=1.0, young=2.0, poisson=0.0, resistivity=1.0, angle=angle * DEGREE)
    values = [spot.semi_minor / spot.semi_major, spot.semi_major, spot.semi_minor, spot.approach, 1 / spot.conductance]
    assert values == pytest.approx([ratio, a, b, delta, resistance], rel=6e-10)


@pytest.mark.parametrize(
    ("force", "angle", "a", "b", "delta", "resistance", "stiffness"),
    [
        (1, 90, 2.2276806e-5, 2.2276806e-5, 4.9625607e-7, 3.8156279e-4, 3.0226331e6),
        (1, 60, 3.3099412e-5, 1.5974696e-5, 4.6528594e-7, 3.5775038e-4, 3.2238241e6),
        (1, 30, 6.0830117e-5, 1.0983797e-5, 3.6043551e-7, 2.7713269e-4, 4.1616321e6),
        (100, 90, 1.0339977e-4, 1.0339977e-4, 1.0691513e-5, 8.2205210e-5, 1.4029820e7),
    ],
)
def test_copper_wires_in_si_units(force, angle, a, b, delta, resistance, stiffness):
    spot = contact_spot(force, angle=angle * DEGREE, **COPPER)
    values = [spot.semi_major, spot.semi_minor, spot.approach, 1 / spot.conductance, 1.5 * force / spot.approach]
    assert values == pytest.approx([a, b, delta, resistance, stiffness], rel=5e-8)


@pytest.mark.parametrize("angle", [*ANGLES, 0.1, 0.01])
@pytest.mark.parametrize("radii", [(1.0, 1.0), (1.0, 0.3), (1.0, 100.0)])
def test_ellipse_solves_hertz_s_equations(angle, radii):
    # the equations as they stand in theory section 6, with 40 digits
    spot = contact_spot(2.0, radius=radii, young=[2.0, 3.0], poisson=[0.3, 0.1], resistivity=1.0, angle=angle * DEGREE)
    with mpmath.workdps(40):
        r, rb = map(mpmath.mpf, radii)
        psi = mpmath.mpf(angle * DEGREE)
        e_star = 1 / ((1 - mpmath.mpf(0.3) ** 2) / 2 + (1 - mpmath.mpf(0.1) ** 2) / 3)
        total = (1 / r + 1 / rb) / 2
        difference = mpmath.sqrt(1 / r**2 + 1 / rb**2 + 2 * mpmath.cos(2 * psi) / (r * rb)) / 2
        a_curvature, b_curvature = (total - difference) / 2, (total + difference) / 2

        def excess(log_ratio):
            m1 = mpmath.exp(2 * log_ratio)
            k, e = mpmath.ellipk(1 - m1), mpmath.ellipe(1 - m1)
            return mpmath.log((e / m1 - k) / (k - e) * a_curvature / b_curvature)

        ratio = mpmath.mpf(1)
        if difference / total > 1e-12:
            guess = mpmath.log(spot.semi_minor / spot.semi_major)
            ratio = mpmath.exp(mpmath.findroot(excess, (guess - 1e-3, guess - 2e-3)))
        m = 1 - ratio**2
        k, e = mpmath.ellipk(m), mpmath.ellipe(m)
        d = (k - e) / m if m > 0 else mpmath.pi / 4
        a = mpmath.cbrt(3 * 2 * d / (2 * mpmath.pi * a_curvature * e_star))
        exact = [a, ratio * a, 3 * 2 * k / (2 * mpmath.pi * a * e_star), 2 * mpmath.pi * a / (2 * k)]
        errors = [
            float(abs(mpmath.mpf(value) / reference - 1))
            for value, reference in zip(
                [spot.semi_major, spot.semi_minor, spot.approach, spot.conductance], exact, strict=True
            )
        ]
    assert max(errors) < 1e-12, errors


@pytest.mark.parametrize("wires", [COPPER, UNEQUAL])
@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("force", [1e-9, 1e-3, 1.0, 50.0, 1e6])
def test_barber_s_identity_links_conductance_and_contact_stiffness(wires, angle, force):
    # G = 2/(E* (rho1 + rho2)) dF/ddelta, both from the program: the spot law and the normal law
    wires = {key: np.broadcast_to(value, 2) for key, value in wires.items()}
    spot = contact_spot(force, angle=angle * DEGREE, **wires)
    properties = [wires[key] for key in ("radius", "young", "poisson")]
    (found, dforce_dgap, *_), info = _core.f2py_contact.normal_force(
        2, [0.0], -spot.approach, *properties, angle * DEGREE
    )
    assert info == 0
    assert found == pytest.approx(force, rel=1e-14)
    stiffness = spot.conductance * modulus(**wires) * wires["resistivity"].sum() / 2
    assert stiffness == pytest.approx(-dforce_dgap, rel=1e-14)


@pytest.mark.parametrize(
    ("ratio", "shape_factor"),
    [(1, 1), (2, 0.9707731117), (4, 0.8916515900), (10, 0.7439940668), (16, 0.6623987937), (100, 0.3814364242)],
)
def test_holm_resistance_of_an_ellipse_relative_to_the_circle_of_equal_area(ratio, shape_factor):
    # any ellipse is that of some angle: bisect for it
    def spot(angle):
        return contact_spot(1.0, radius=1.0, young=2.0, poisson=0.0, resistivity=1.0, angle=angle)

    low, high = 1e-4, np.pi / 2
    for _ in range(60):
        middle = (low + high) / 2
        s = spot(middle)
        low, high = (middle, high) if s.semi_major / s.semi_minor > ratio else (low, middle)
    s = spot(high)
    circle = 1 / (2 * np.sqrt(s.semi_major * s.semi_minor))
    assert 1 / s.conductance / circle == pytest.approx(shape_factor, rel=2e-10)


def test_paper_law_has_a_spot_21_percent_too_small_and_a_resistance_26_percent_too_large():
    paper, hertz = (contact_spot(3.0, angle=np.pi / 2, law=law, **COPPER) for law in ("paper", "hertz"))
    assert paper.semi_major / hertz.semi_major == pytest.approx(0.5 ** (1 / 3), rel=1e-14)
    assert hertz.conductance / paper.conductance == pytest.approx(2 ** (1 / 3), rel=1e-14)


def test_paper_law_is_the_formula_of_the_paper():
    r_star = 1e-3 * 0.3e-3 / 1.3e-3
    spot = contact_spot(2.0, angle=1.0, law="paper", **UNEQUAL)
    a = (3 * 2.0 * r_star / (4 * modulus(**UNEQUAL))) ** (1 / 3)
    assert spot.semi_major == spot.semi_minor == pytest.approx(a, rel=1e-15)
    assert 1 / spot.conductance == pytest.approx((1.7e-8 + 5e-8) / (4 * a), rel=1e-15)
    assert spot.approach == pytest.approx(a**2 / r_star, rel=1e-15)


@pytest.mark.parametrize("law", [dict(law="hertz"), dict(law="paper")])
def test_elastic_resistance_falls_with_the_cube_root_of_the_force(law):
    g = [contact_spot(f, angle=1.0, **law, **COPPER).conductance for f in (1.0, 1000.0)]
    assert g[1] / g[0] == pytest.approx(10, rel=1e-14)


def test_plastic_resistance_falls_with_the_square_root_of_the_force():
    spot = contact_spot(5.0, angle=1.0, law="plastic", hardness=1e9, **COPPER)
    assert np.pi * spot.semi_major**2 * 1e9 == pytest.approx(5.0, rel=1e-15)
    assert 1 / spot.conductance == pytest.approx(1.7e-8 / 2 * np.sqrt(np.pi * 1e9 / 5.0), rel=1e-14)
    assert spot.approach == 0


def test_film_is_in_series_to_the_constriction():
    bare, film = contact_spot(5.0, angle=0.6, **COPPER), contact_spot(5.0, angle=0.6, **FILM, **COPPER)
    r_film = 1e-13 / (np.pi * bare.semi_major * bare.semi_minor)
    assert 1 / film.conductance == pytest.approx(1 / bare.conductance + r_film, rel=1e-14)


def test_constant_resistance():
    spot = contact_spot(5.0, angle=0.6, law="constant", resistance=4.0, **COPPER)
    assert spot == (0, 0, 0, 0.25, 0, 0)


class TestTable:
    def resistance(self, force, table):
        return 1 / contact_spot(force, angle=1.0, law="table", table=table, **COPPER).conductance

    def test_goes_through_its_pairs(self):
        for force, resistance in zip(*TABLE["table"], strict=True):
            assert self.resistance(force, TABLE["table"]) == pytest.approx(resistance, rel=1e-14)

    def test_power_law_is_reproduced_within_and_beyond(self):
        forces = np.array([0.1, 0.3, 2.0, 7.0])
        for force in (1e-6, 0.05, 0.2, 1.0, 5.0, 1e4):
            assert self.resistance(force, [forces, 2e-3 * forces**-0.4]) == pytest.approx(2e-3 * force**-0.4, rel=1e-13)

    def test_monotone_where_the_table_is(self):
        forces = np.geomspace(1e-4, 1e4, 2000)
        values = [self.resistance(f, TABLE["table"]) for f in forces]
        assert (np.diff(values) < 0).all()

    def test_slope_is_continuous_at_the_pairs(self):
        for force in TABLE["table"][0]:
            slopes = [
                contact_spot(force * (1 + d), angle=1.0, **TABLE, **COPPER).dconductance_dforce for d in (-1e-9, 1e-9)
            ]
            assert slopes[0] == pytest.approx(slopes[1], rel=1e-7)

    def test_single_pair_is_a_constant(self):
        assert self.resistance(17.0, [[2.0], [0.3]]) == pytest.approx(0.3, rel=1e-15)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law["law"])
@pytest.mark.parametrize("wires", [COPPER, UNEQUAL])
@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("force", [0.003, 0.5, 60.0])
def test_derivatives_of_the_conductance(law, wires, angle, force):
    # in log(F) and angle; differences of sixth order, relative noise 1e-16/step, truncation at 1 degree 1e-10
    spot = contact_spot(force, angle=angle * DEGREE, **law, **wires)
    step = 4e-3
    by_log_force = derivative(
        lambda s: contact_spot(force * np.exp(s), angle=angle * DEGREE, **law, **wires).conductance, 0.0, step
    )[0]
    step = 4e-3 * min(1.0, np.sin(angle * DEGREE))
    by_angle = derivative(
        lambda d: contact_spot(force, angle=angle * DEGREE + d, **law, **wires).conductance, 0.0, step
    )[0]
    assert spot.dconductance_dforce * force == pytest.approx(by_log_force, abs=1e-10 * spot.conductance)
    assert spot.dconductance_dangle == pytest.approx(by_angle, abs=1e-12 * spot.conductance / step)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law["law"])
@pytest.mark.parametrize("force", [0.0, -1.0])
def test_nothing_conducts_without_a_force(law, force):
    assert contact_spot(force, angle=1.0, **law, **COPPER) == (0, 0, 0, 0, 0, 0)


@pytest.mark.parametrize("angle", [20, 70, 90, 130])
def test_only_the_acute_angle_matters(angle):
    one, other = (contact_spot(2.0, angle=a * DEGREE, **UNEQUAL) for a in (angle, 180 - angle))
    assert one[:5] == pytest.approx(other[:5], rel=1e-14)
    assert one.dconductance_dangle == pytest.approx(-other.dconductance_dangle, abs=1e-14 * one.conductance)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law["law"])
def test_the_order_of_the_wires_does_not_matter(law):
    swapped = {key: np.broadcast_to(value, 2)[::-1] for key, value in UNEQUAL.items()}
    assert contact_spot(2.0, angle=0.7, **law, **UNEQUAL) == pytest.approx(
        contact_spot(2.0, angle=0.7, **law, **swapped), rel=1e-14
    )


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (dict(law="herz"), 'law must be one of "none", "paper", "hertz"'),
        (dict(law=None), "law must be one of"),
        (dict(law="plastic"), "needs hardness"),
        (dict(law="film"), "needs film_resistivity"),
        (dict(law="constant"), "needs resistance"),
        (dict(law="table"), "needs table"),
        (dict(law="plastic", hardness=-1.0), "hardness must be greater than 0"),
        (dict(hardness=1e9), 'hardness belongs to the spot law "plastic"'),
        (dict(table=[[1.0], [1.0]]), "table belongs to"),
        (dict(law="table", table=[1.0, 2.0]), r"shape \(2, n\)"),
        (dict(law="table", table=[[1.0, 2.0], [1.0, -2.0]]), "positive"),
        (dict(law="table", table=[[2.0, 1.0], [1.0, 2.0]]), "ascend"),
        (dict(angle=0.0), "between 0 and pi"),
        (dict(angle=np.pi), "between 0 and pi"),
        (dict(angle=np.nan), "angle must be finite"),
        (dict(angle=1e-160), "close to parallel"),
        (dict(force=np.inf), "force must be finite"),
        (dict(radius=0.0), "radius must be greater than 0"),
        (dict(radius=[1.0, 2.0, 3.0]), r"radius must have shape \(2,\)"),
        (dict(young=[1.0, -1.0]), "young must be greater than 0"),
        (dict(resistivity=[0.0, 1.0]), "resistivity must be greater than 0"),
        (dict(poisson=0.5), "poisson must be between -1 and 0.5"),
        (dict(poisson=[0.3, -1.0]), "poisson must be between -1 and 0.5"),
    ],
)
def test_bad_input_is_refused_in_words(change, words):
    with pytest.raises(ValueError, match=words):
        contact_spot(**{"force": 1.0, "angle": 1.0, **COPPER, **change})


@pytest.mark.parametrize("film", [[], [1e-13]])
def test_sharvin_s_law_is_that_of_the_mean_free_path(film):
    """The data are the product of resistivity and mean free path, which both metals share."""
    product = 5e-14
    paths = product / np.broadcast_to(UNEQUAL["resistivity"], 2)
    found = contact_spot(0.3, angle=0.7, law="sharvin", law_value=[product, *film], **UNEQUAL)
    series = dict(law="film", film_resistivity=film[0]) if film else {}
    expected = contact_spot(0.3, angle=0.7, mean_free_path=paths, **series, **UNEQUAL)
    assert found == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("film", [[], [1e-13]])
def test_sharvin_s_law_takes_yielding_wires_and_either_path(film):
    wires = dict(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8, angle=0.7)
    path, yielding = 2e-6, dict(yield_stress=50e6, hardness=450e6, largest_force=0.5)
    series = dict(law="film", film_resistivity=film[0]) if film else dict(law="hertz")
    expected = contact_spot(0.3, mean_free_path=path, **series, **yielding, **wires)
    product = contact_spot(0.3, law="sharvin", law_value=[1.7e-8 * path, *film], **yielding, **wires)
    assert product == pytest.approx(expected, rel=1e-12)
    film_of = dict(film_resistivity=film[0]) if film else {}
    by_path = contact_spot(0.3, law="sharvin", mean_free_path=path, **film_of, **yielding, **wires)
    assert by_path == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("given", [{}, dict(law_value=1e-15, mean_free_path=1e-7)])
def test_sharvin_s_law_takes_the_path_or_its_product(given):
    with pytest.raises(ValueError, match="takes law_value, with rho_l, or mean_free_path"):
        contact_spot(0.3, angle=0.7, law="sharvin", **given, **UNEQUAL)


def test_the_film_of_a_cluster_lies_on_the_area_of_its_spots():
    clean = contact_spot(0.5, angle=0.7, law="cluster", law_value=[1e9, 20], **UNEQUAL)
    coated = contact_spot(0.5, angle=0.7, law="cluster", law_value=[1e9, 20, 1e-12], **UNEQUAL)
    # n spots of F/(n H)
    assert 1 / coated.conductance - 1 / clean.conductance == pytest.approx(1e-12 * 1e9 / 0.5, rel=1e-11)
    assert coated[:3] == clean[:3]
    step = 1e-6
    high, low = (
        contact_spot(0.5 * factor, angle=0.7, law="cluster", law_value=[1e9, 20, 1e-12], **UNEQUAL).conductance
        for factor in (1 + step, 1 - step)
    )
    # central difference: the third derivative leaves less than step^2, round-off 1e-10
    assert coated.dconductance_dforce == pytest.approx((high - low) / step, rel=1e-8)


def test_a_cluster_is_between_a_single_spot_and_the_whole_ellipse():
    one = contact_spot(0.5, angle=0.7, law="cluster", law_value=[1e9, 1], **UNEQUAL)
    single = contact_spot(0.5, angle=0.7, law="plastic", hardness=1e9, **UNEQUAL)
    assert one.conductance == pytest.approx(single.conductance, rel=1e-12)
    many = contact_spot(0.5, angle=0.7, law="cluster", law_value=[1e9, 1e16], **UNEQUAL)
    whole = contact_spot(0.5, angle=0.7, **UNEQUAL)
    assert many.conductance == pytest.approx(whole.conductance, rel=1e-4)
    assert (many.semi_major, many.semi_minor) == pytest.approx((whole.semi_major, whole.semi_minor))


@pytest.mark.slow
@pytest.mark.parametrize("n", [7, 37, 127, 500])
def test_a_cluster_is_that_of_greenwood_s_spots(n):
    """Equal spots evenly spread over the disc of Hertz: each raises the potential of the others as a point."""
    hardness, force = 20e9, 1.0
    cluster = contact_spot(force, angle=np.pi / 2, law="cluster", law_value=[hardness, n], **COPPER)
    a = np.sqrt(force / (n * np.pi * hardness))
    k = np.arange(n) + 0.5
    turn = np.pi * (3 - np.sqrt(5))
    places = cluster.semi_major * np.sqrt(k / n)[:, None] * np.column_stack([np.cos(turn * k), np.sin(turn * k)])
    expected = greenwood.together(places, np.full(n, a), COPPER["resistivity"])
    assert 1 / cluster.conductance == pytest.approx(expected, rel=0.03)


def test_a_cluster_has_one_spot_or_more():
    with pytest.raises(ValueError, match="law_value of"):
        contact_spot(0.5, angle=0.7, law="cluster", law_value=1e9, **UNEQUAL)
    with pytest.raises(ValueError, match="sigma_f, optional"):
        contact_spot(0.5, angle=0.7, law="sharvin", law_value=[1e-15, 1e-13, 1.0], **UNEQUAL)
